//! Prints the droop test's table: `cargo run --release --example droop -- BEFORE.obj AFTER.obj`.

use std::error::Error;

use glam::DVec3;
use tress_geometry::Strands;
use tress_optimize::SculptOptions;

#[expect(unreachable_pub, reason = "the same file is measured by benches")]
mod measure;

use measure::Scene;

#[expect(clippy::print_stdout, reason = "printing a table is what it is for")]
fn main() -> Result<(), Box<dyn Error>> {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let [before, after] = paths.as_slice() else {
        return Err("expected BEFORE.obj AFTER.obj".into());
    };
    let (before, after) = (read_lines(before)?, read_lines(after)?);
    let scene = Scene::new(&before, &after).ok_or("not the same strands")?;
    let options = SculptOptions::default();
    println!("| anchors a strand | sculpted | spline in position space |");
    println!("|---|---|---|");
    for m in [1, 2, 3, 5, 9] {
        let droop = scene.droop(m, &options)?;
        println!("| {m} | {:.4} | {:.4} |", droop.sculpted, droop.baseline);
    }
    let droop = scene.droop(1, &options)?;
    println!("\nmoved {:.4}, fit before {:.4}", droop.moved, droop.fitted);
    Ok(())
}

/// The polylines of an .obj file: `v` and `l` records.
fn read_lines(path: &str) -> Result<Strands<DVec3>, Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;
    let (mut points, mut strands) = (Vec::new(), Strands::default());
    for line in text.lines() {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut next = || words.next().unwrap_or("nothing").parse();
                points.push(DVec3::new(next()?, next()?, next()?));
            }
            Some("l") => {
                let at = |word: &str| {
                    let index: usize = word.parse().ok()?;
                    points.get(index.checked_sub(1)?).copied()
                };
                let line: Option<Vec<DVec3>> = words.map(at).collect();
                strands.push(line.ok_or("a line names a point that is not there")?)?;
            }
            _ => {}
        }
    }
    Ok(strands)
}
