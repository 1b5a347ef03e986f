//! `switchback make` and `switchback insert`.

use std::fs;

use crate::bench::Bench;

#[test]
fn a_switchback_is_made_of_the_size_asked_for() {
    let bench = Bench::new();
    let report = bench.json("switchback make one.tress --frequency 0.4 --radius 0.5");
    assert!(0.0 < report["room"].as_f64().expect("a room"));
    let info = bench.json("info one.tress");
    assert_eq!(info["strands"], 1);
    let radius = info["summary"]["coil_radius"]["median"].as_f64().expect("a coil");
    assert!((radius - 0.5).abs() < 0.01, "{radius}");
    bench.done("switchback make s.obj --method double --frequency 0.6 --rest-twist 0.2");
    let text = bench.fails("switchback make t.obj --rest-twist 0.2", 1);
    assert!(text.contains("in even numbers only"), "{text}");
    let text = bench.done("switchback make published.obj --method ritz");
    assert!(text.contains("off by"), "{text}");
}

#[test]
fn strands_keep_their_length_and_root() {
    let bench = Bench::new();
    let line = "switchback insert groom.obj changed.obj --at 0.5";
    let report = bench.json(line);
    let placed = report["switchbacks"].as_array().expect("a list").len();
    assert!(0 < placed, "{report}");
    let (before, after) = (bench.groom("groom.obj"), bench.groom("changed.obj"));
    assert_eq!(after.strands().len(), before.strands().len());
    for (a, b) in before.strands().iter().zip(after.strands().iter()) {
        assert!(a[0].distance(b[0]) < 0.05);
        let length = tress::geometry::polyline::length;
        assert!((length(a) / length(b) - 1.0).abs() < 0.02, "{} {}", length(a), length(b));
    }
}

#[test]
fn the_seed_and_not_the_threads_decides() {
    let bench = Bench::new();
    let insert = |to: &str, options: &str| {
        let line = format!("switchback insert groom.obj {to} --density 0.05 {options}");
        bench.done(&line);
        fs::read(bench.path(to)).expect("the file was written")
    };
    let one = insert("a.hair", "--groups clusters:4 --seed 3 --threads 1");
    assert_eq!(one, insert("b.hair", "--groups clusters:4 --seed 3 --threads 3"));
    assert_ne!(one, insert("c.hair", "--groups clusters:4 --seed 4"));
}

#[test]
fn bad_input_is_told_in_one_line() {
    let bench = Bench::new();
    let text = bench.fails("switchback make a.obj --frequency 1.0", 1);
    assert!(text.contains("more than -1 and less than 1"), "{text}");
    let text = bench.fails("switchback make a.obj --frequency 0", 1);
    assert!(text.contains("not pulled"), "{text}");
    bench.fails("switchback make a.obj --radius -1", 2);
    bench.fails("switchback make a.obj --turns 1e9", 2);
    let text = bench.fails("switchback insert groom.obj a.obj --at 1.5", 1);
    assert!(text.contains("expected 0 to 1"), "{text}");
    let text = bench.fails("switchback insert groom.obj a.obj --at 0.5 --share 0", 1);
    assert!(text.contains("over 0 to 0.5"), "{text}");
    // A place without room is no failure: it is counted, with the room that was needed.
    let text = bench.done("switchback insert groom.obj a.obj --at 0.01");
    assert!(text.contains("on either side is enough"), "{text}");
}
