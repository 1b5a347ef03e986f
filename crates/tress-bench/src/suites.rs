//! The measurements, one file a topic.

mod analysis;
mod droop;
mod fitting;
mod formats;
mod growing;
pub(crate) mod helicoid;
mod interchange;
mod pictures;
mod procedural;
mod sculpting;
mod switchback;

use std::path::PathBuf;
use std::time::Instant;

use crate::Outcome;
use crate::metric::{Figures, say};

/// A set of measurements: the names it may print, and what runs it.
struct Suite {
    /// What the names of its figures begin with.
    names: &'static [&'static str],
    run: fn(&mut Figures) -> Outcome,
}

const SUITES: &[Suite] = &[
    Suite { names: analysis::NAMES, run: analysis::run },
    Suite { names: fitting::NAMES, run: fitting::run },
    Suite { names: droop::NAMES, run: droop::run },
    Suite { names: formats::NAMES, run: formats::run },
    Suite { names: growing::NAMES, run: growing::run },
    Suite { names: helicoid::NAMES, run: helicoid::run },
    Suite { names: interchange::NAMES, run: interchange::run },
    Suite { names: pictures::NAMES, run: pictures::run },
    Suite { names: procedural::NAMES, run: procedural::run },
    Suite { names: sculpting::NAMES, run: sculpting::run },
    Suite { names: switchback::NAMES, run: switchback::run },
];

/// Runs the suites that have a figure whose name begins with one of the arguments, or all.
pub(crate) fn run(args: &[String]) -> Outcome {
    let mut names = Vec::new();
    let (mut json, mut baseline) = (None, None);
    let mut rest = args.iter();
    while let Some(arg) = rest.next() {
        match arg.as_str() {
            "--json" => json = rest.next().map(PathBuf::from),
            "--baseline" => baseline = rest.next().map(PathBuf::from),
            name => names.push(name),
        }
    }
    let mut figures = Figures::against(baseline.as_deref())?;
    let wanted = |suite: &&Suite| {
        let begins = |name: &&str| suite.names.iter().any(|n| n.starts_with(name));
        names.is_empty() || names.iter().any(begins)
    };
    for suite in SUITES.iter().filter(wanted) {
        (suite.run)(&mut figures)?;
    }
    figures.write(&json.unwrap_or_else(|| crate::grooms::root().join("target/bench.json")))?;
    match figures.missed() {
        0 => Ok(()),
        missed => {
            say(&format!("# {missed} figures missed their bars"));
            Ok(())
        }
    }
}

/// Seconds of the fastest of so many runs.
fn best_of<T, E>(times: usize, mut run: impl FnMut() -> Result<T, E>) -> Outcome<f64>
where
    Box<dyn std::error::Error>: From<E>,
{
    let mut best = f64::INFINITY;
    for _ in 0..times {
        let started = Instant::now();
        std::hint::black_box(run()?);
        best = best.min(started.elapsed().as_secs_f64());
    }
    Ok(best)
}
