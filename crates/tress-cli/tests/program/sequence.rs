//! One command over the frames of an animation.

use serde_json::Value;
use tress::geometry::glam::DVec3;

use crate::bench::Bench;

/// Three frames of a groom on its way, numbered as nobody would.
fn on_its_way() -> Bench {
    let bench = Bench::new();
    let groom = bench.groom("groom.obj");
    for frame in [8, 9, 110] {
        let by = DVec3::new(f64::from(frame) * 0.25, 0.0, 0.0);
        let points = groom.strands().points().iter().map(|&p| p + by).collect();
        let moved = groom.strands().with_points(points).expect("as many points");
        bench.write(&format!("g.{frame:04}.obj"), &tress::geometry::Groom::new(moved));
    }
    bench
}

#[test]
fn every_frame_gets_the_same_choices() {
    let bench = on_its_way();
    let line = "ruffle g.%04d.obj r%d.obj --elements 40 --probability 0.3 --groups clusters:3";
    let json: Value = serde_json::from_str(&bench.done(&format!("{line} --json"))).expect("JSON");
    let frames: Vec<_> = json["frames"].as_array().expect("frames").iter().collect();
    assert_eq!(frames.len(), 3);
    assert_eq!((&frames[0]["frame"], &frames[2]["frame"]), (&Value::from(8), &Value::from(110)));
    assert_eq!(frames[1]["report"]["output"], "r9.obj");
    let (first, last) = (bench.groom("r8.obj"), bench.groom("r110.obj"));
    let by = DVec3::new(102.0 * 0.25, 0.0, 0.0);
    for (a, b) in first.strands().points().iter().zip(last.strands().points()) {
        assert!(((*a + by) - *b).length() < 1e-3, "{a} became {b}");
    }
    assert!(bench.done(line).contains("3, of which 8 is shown here"));
}

#[test]
fn frames_can_be_chosen() {
    let bench = on_its_way();
    bench.done("convert g.%04d.obj c.%04d.hair --frames 9-200");
    let there = |name: &str| bench.path(name).exists();
    assert!(!there("c.0008.hair") && there("c.0009.hair") && there("c.0110.hair"));
}

#[test]
fn what_is_wrong_with_a_frame_is_said_with_its_number() {
    let bench = on_its_way();
    std::fs::write(bench.path("g.0009.obj"), "v 1 2\nl 1 2\n").expect("a broken frame");
    assert!(bench.fails("convert g.%04d.obj c.%04d.hair", 1).contains("frame 9: "));
    assert!(bench.fails("convert no.%04d.obj c.%04d.hair", 1).contains("no file of this sequence"));
    assert!(
        bench.fails("convert g.%04d.obj c.%04d.hair --frames 9-3", 2).contains("first to last")
    );
}
