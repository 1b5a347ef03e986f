//! Recovers the seven synthetic grooms and prints truth, found and error of every parameter.
//!
//! `cargo run --release -p tress-procedural --example recover -- [SHARE] [GROOM...]`

#![allow(clippy::print_stdout, reason = "this is what the example is for")]

use std::error::Error;
use std::time::Instant;

use tress_procedural::fit::{Fitter, Stage, StageOptions};
use tress_procedural::synthetic::{COUNT, known};

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let share: f64 = args.next().map_or(Ok(0.2), |arg| arg.parse())?;
    let mut which: Vec<usize> = args.map(|arg| arg.parse()).collect::<Result<_, _>>()?;
    if which.is_empty() {
        which = (0..COUNT).collect();
    }
    for style in which {
        let known = known(style, share)?;
        let target = known.groom.build_groom()?;
        println!("{} ({} strands)", known.name, target.strands().len());
        let options = StageOptions { own_weights: false, ..StageOptions::default() };
        let mut fitter = Fitter::new(&target, known.start.clone(), options)?;
        while fitter.stage() != Stage::Numbers {
            let (stage, started) = (fitter.stage(), Instant::now());
            let (mut first, mut last, mut steps) = (None, 0.0, 0);
            fitter.advance(&mut |progress| {
                first.get_or_insert(progress.loss);
                last = progress.loss;
                steps += 1;
            })?;
            let seconds = started.elapsed().as_secs_f64();
            let first = first.unwrap_or_default();
            println!("  {stage:?}: {seconds:.1} s, {steps} steps, loss {first:.4} to {last:.4}");
        }
        let Some(groom) = fitter.groom() else { continue };
        println!("  guides {:.3} off", known.guides_off(groom));
        for (operator, fitted) in known.groom.chain.operators.iter().zip(&groom.chain.operators) {
            let values = operator.values().into_iter().zip(fitted.values());
            for (parameter, (truth, found)) in operator.parameters().iter().zip(values) {
                let error = 100.0 * (found - truth).abs() / truth;
                let name = format!("{}.{}", operator.name(), parameter.name);
                println!("  {name:<30} {truth:>9.4} {found:>9.4} {error:>6.1} %");
            }
        }
    }
    Ok(())
}
