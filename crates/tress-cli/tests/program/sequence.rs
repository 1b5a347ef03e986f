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

#[test]
fn an_animated_file_becomes_an_animated_file() {
    let bench = on_its_way();
    let grooms = [8, 9, 110]
        .map(|frame| Ok::<_, tress::io::WriteError>(bench.groom(&format!("g.{frame:04}.obj"))));
    let frames = tress::io::Frames { start: 5.0, rate: 24.0 };
    let options = tress::io::WriteOptions::default();
    tress::io::write_animation(bench.path("wind.abc"), frames, &options, grooms).expect("written");
    let said = bench.done("recoil wind.abc wider.abc --radius 1.2 --elements 40 --animated");
    assert!(said.contains("3 frames in wider.abc"), "{said}");
    let animation = tress::io::Animation::open(bench.path("wider.abc")).expect("readable");
    assert_eq!((animation.len(), animation.frames()), (3, frames));
    bench.done("convert wind.abc still.%d.hair --animated");
    assert!(bench.path("still.5.hair").exists() && bench.path("still.7.hair").exists());
    assert!(bench.fails("convert wind.abc one.hair --animated", 2).contains("one.%04d.hair"));
    assert!(bench.fails("convert g.0008.obj one.abc --animated", 2).contains("more than one"));
    assert!(bench.fails("convert g.%04d.obj one.hair", 2).contains("one.%04d.hair"));
}
