//! Fits groom files and prints what came of it, a line of Markdown a file.
//!
//! `cargo run --release -p tress-fit --example grooms -- ELEMENTS PRIOR FILE...`, where `ELEMENTS`
//! is a number, or 0 for one a segment, and `PRIOR` that of the refinement.

use std::time::Instant;

use tress_fit::{Elements, FitOptions, Refine, fit};
use tress_io::Model;

#[expect(clippy::print_stdout, reason = "the table is what the program is for")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let n: usize = arguments.next().ok_or("how many elements?")?.parse()?;
    let prior: f64 = arguments.next().ok_or("which prior?")?.parse()?;
    let elements = if n == 0 { Elements::PerSegment } else { Elements::Count(n) };
    println!(
        "| file | strands | points | read | refined | fit | elements | rms | most | length | kept |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for path in arguments {
        let begin = Instant::now();
        let Model::Polylines(groom) = tress_io::read(&path)? else { continue };
        let read = begin.elapsed().as_secs_f64();
        for refine in [None, Some(Refine { prior, ..Refine::default() })] {
            let begin = Instant::now();
            let fitted = fit(&groom, &FitOptions { elements, refine, ..FitOptions::default() })?;
            let report = &fitted.report;
            let name = path.rsplit('/').next().unwrap_or(&path);
            println!(
                "|{name}|{}|{}| {read:.1} | {} | {:.2} | {} | {:.1e} | {:.1e} | {:.1e} | {:?} |",
                report.strands,
                groom.strands().points().len(),
                refine.is_some(),
                begin.elapsed().as_secs_f64(),
                report.elements,
                report.deviation.rms,
                report.deviation.greatest,
                report.deviation.length_change,
                report.kept
            );
        }
    }
    Ok(())
}
