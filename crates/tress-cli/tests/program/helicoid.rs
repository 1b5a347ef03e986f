//! `helicoid fit`, `trace`, `wisp` and `fill`.

use std::fs;

use serde_json::Value;
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, Strands};

use crate::bench::Bench;

/// Thirty arcs on a line, bent more and more.
fn bench() -> Bench {
    let bench = Bench::new();
    let mut strands = Strands::default();
    for i in 0..30 {
        let (x, radius) = (f64::from(i), 20.0 - 0.4 * f64::from(i));
        let at = |j: i32| {
            let angle = f64::from(j) * 0.5 / radius;
            DVec3::new(x, radius * angle.sin(), radius - radius * angle.cos())
        };
        strands.push((0..25).map(at)).expect("few points");
    }
    bench.write("arcs.obj", &Groom::new(strands));
    bench
}

#[test]
fn a_tenth_of_the_fits_fills_the_whole() {
    let bench = bench();
    let text = bench.done("helicoid fit arcs.obj arcs.ron --pieces 2");
    assert!(text.contains("30 strands, 60 pieces"), "{text}");
    let line = "helicoid fill arcs.ron full.obj --roots arcs.obj --keep 0.2 --points 25";
    let json = bench.json(line);
    assert_eq!((&json["guides_used"], &json["replaced"]), (&Value::from(6), &Value::from(0)));
    let (before, after) = (bench.groom("arcs.obj"), bench.groom("full.obj"));
    for (a, b) in before.strands().iter().zip(after.strands().iter()) {
        assert!(a[0].distance(b[0]) < 1e-5);
        assert!(a[24].distance(b[24]) < 1.5, "a tip {} away", a[24].distance(b[24]));
    }
    bench.done("helicoid fill arcs.ron full.ron --roots arcs.obj --published");
    bench.done("helicoid trace full.ron published.hair --points 9");
    assert_eq!(bench.groom("published.hair").strands().len(), 30);
}

#[test]
fn helicoids_become_polylines_and_super_helices() {
    let bench = bench();
    bench.done("helicoid fit arcs.obj arcs.ron");
    bench.done("helicoid trace arcs.ron back.obj --points 25");
    let (before, after) = (bench.groom("arcs.obj"), bench.groom("back.obj"));
    for (a, b) in before.strands().points().iter().zip(after.strands().points()) {
        assert!(a.distance(*b) < 0.02, "{}", a.distance(*b));
    }
    bench.done("helicoid trace arcs.ron arcs.tress --elements 4");
    bench.done("sample arcs.tress again.obj --points 25");
    assert_eq!(bench.groom("again.obj").strands().len(), 30);
    bench.done("helicoid trace arcs.ron euler.obj --euler 10");
}

#[test]
fn wisps_depend_on_the_seed_alone() {
    let bench = bench();
    bench.done("helicoid fit arcs.obj arcs.ron");
    let wisp = |to: &str, options: &str| {
        bench.done(&format!("helicoid wisp arcs.ron {to} --hairs 5 --frizz 2 {options}"));
        fs::read(bench.path(to)).expect("the file was written")
    };
    let one = wisp("a.hair", "--seed 1 --threads 1");
    assert_eq!(one, wisp("b.hair", "--seed 1 --threads 3"));
    assert_ne!(one, wisp("c.hair", "--seed 2"));
    assert_eq!(bench.groom("a.hair").strands().len(), 150);
}

#[test]
fn strands_that_are_none_are_kept_and_said() {
    let bench = bench();
    let mut strands = bench.groom("arcs.obj").strands().clone();
    strands.push([DVec3::ONE]).expect("few points");
    bench.write("stub.hair", &Groom::new(strands));
    let text = bench.done("helicoid fit stub.hair stub.ron");
    assert!(text.contains("1 strands of a single point"), "{text}");
    bench.done("helicoid trace stub.ron stub.obj");
    assert_eq!(bench.groom("stub.obj").strands().len(), 31);
}

#[test]
fn wrong_wishes_are_refused() {
    let bench = bench();
    bench.done("helicoid fit arcs.obj arcs.ron");
    bench.fails("helicoid fit arcs.obj arcs.obj", 2);
    assert!(bench.fails("helicoid fit arcs.obj b.ron --pieces 0", 1).contains("0 pieces"));
    bench.fails("helicoid fill arcs.ron full.obj", 2);
    bench.fails("helicoid fill arcs.ron full.obj --roots arcs.obj --keep 0", 2);
    let line = "helicoid fill arcs.ron full.obj --roots arcs.obj --exponent -1";
    assert!(bench.fails(line, 1).contains("exponent"));
    assert!(bench.fails("helicoid wisp arcs.ron w.obj --radius -1", 1).contains("radius"));
    let error = bench.fails("helicoid wisp arcs.ron w.obj --hairs 0", 1);
    assert!(error.contains("0 hairs a wisp"), "{error}");
    fs::write(bench.path("bad.ron"), "(roots: [], pieces: 3)").expect("room on the disk");
    assert!(bench.fails("helicoid trace bad.ron bad.obj", 1).contains("bad.ron"));
}
