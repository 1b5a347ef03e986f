//! One command over the frames of an animation.

use serde_json::Value;
use tress::geometry::UpAxis;
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
    let json = bench.json(line);
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

#[test]
fn a_file_that_all_frames_would_write_is_refused_by_every_command() {
    let bench = on_its_way();
    for line in [
        "convert g.%04d.obj one.hair",
        "fit g.%04d.obj one.tress",
        "ruffle g.%04d.obj one.obj",
        "recoil g.%04d.obj one.obj",
        "blend g.%04d.obj groom.obj one.obj",
        "armature g.%04d.obj one.ron",
        "sculpt g.%04d.obj one.obj --pose p.ron",
        "grow g.%04d.obj one.obj --roots groom.obj",
        "render g.%04d.obj one.png",
        "switchback insert g.%04d.obj one.obj --at 0.5",
        "helicoid fit g.%04d.obj one.ron",
        "helicoid trace g.%04d.ron one.obj",
        "helicoid wisp g.%04d.ron one.obj",
        "helicoid fill guides.ron one.obj --roots g.%04d.obj",
        "groom build g.%04d.ron one.usdc",
        "groom edit g.%04d.ron one.ron --set curl.radius=1",
        "groom fit g.%04d.obj one.ron --operators curl",
        "groom fit g.%04d.obj one.%04d.ron --operators curl --report one.html",
        "spectra g.%04d.obj one.tress-spectra",
        "scatter g.%04d.obj one.obj --count 3",
        "merge g.%04d.obj groom.obj one.obj",
        "analyze g.%04d.obj --csv one.csv",
        "analyze g.%04d.obj --png p.%04d.png --html one.html",
        "diff groom.obj g.%04d.obj --png one.png",
    ] {
        for number in [8, 9, 110] {
            std::fs::write(bench.path(&format!("g.{number:04}.ron")), "").expect("an empty file");
        }
        let said = bench.fails(line, 2);
        assert!(said.contains("one.") && said.contains("name one a frame"), "{line}: {said}");
    }
}

#[test]
fn analyses_without_a_file_run_on_every_frame() {
    let bench = on_its_way();
    assert!(bench.done("info g.%04d.obj").contains("3, of which 8 is shown here"));
    bench.done("analyze g.%04d.obj --csv t.%d.csv");
    assert!(bench.path("t.8.csv").exists() && bench.path("t.110.csv").exists());
}

/// The three frames as one file.
fn animated(bench: &Bench, name: &str) -> tress::io::Frames {
    let grooms = [8, 9, 110].map(|frame| {
        let groom = bench.groom(&format!("g.{frame:04}.obj"));
        Ok::<_, tress::io::WriteError>(groom.in_space(Some(0.01), Some(UpAxis::Z)))
    });
    let frames = tress::io::Frames { start: 5.0, rate: 25.0 };
    let options = tress::io::WriteOptions::default();
    tress::io::write_animation(bench.path(name), frames, &options, grooms).expect("written");
    frames
}

#[test]
fn animated_binary_usd_goes_through_commands_of_two_words() {
    let bench = on_its_way();
    let frames = animated(&bench, "wind.usdc");
    let line = "switchback insert wind.usdc changed.usdc --at 0.5 --elements 40 --animated";
    let said = bench.done(&format!("{line} --usd-curves catmull-rom"));
    assert!(said.contains("3 frames in changed.usdc"), "{said}");
    let animation = tress::io::Animation::open(bench.path("changed.usdc")).expect("readable");
    assert_eq!((animation.len(), animation.frames()), (3, frames));
    let (before, after) = (bench.groom("g.0110.obj"), animation.read(2).expect("the last frame"));
    assert_eq!((after.unit, after.up), (Some(0.01), Some(UpAxis::Z)));
    assert_eq!(after.strands().offsets(), before.strands().offsets());
    let roots = |groom: &tress::geometry::Groom| groom.strands().strand(3)[0];
    assert!(roots(&before).distance(roots(&after)) < 1e-4);
    let bytes = std::fs::read(bench.path("changed.usdc")).expect("a file");
    let said_curves = bytes.windows(10).any(|part| part == b"catmullRom");
    assert!(said_curves, "the choice of curves is kept");
}

#[test]
fn what_all_frames_cannot_become_is_refused_before_any_work() {
    let bench = on_its_way();
    animated(&bench, "wind.abc");
    let said = bench.fails("recoil wind.abc all.usda --radius 2 --animated", 2);
    assert!(said.contains("a .usda file holds one groom"), "{said}");
    let said = bench.fails("convert wind.abc all.abc --target unreal --animated", 2);
    assert!(said.contains("--target unreal writes one groom"), "{said}");
    // Nothing is read: the input is not there.
    let said = bench.fails("convert none.abc all.hair --animated", 2);
    assert!(said.contains("name one a frame, as in all.%04d.hair"), "{said}");
    bench.done("convert wind.abc one.%d.usda --animated");
    assert!(bench.path("one.5.usda").exists() && bench.path("one.7.usda").exists());
}

#[test]
fn a_second_animation_is_taken_frame_by_frame_and_holds_at_its_end() {
    let bench = on_its_way();
    animated(&bench, "a.abc");
    let still = bench.groom("g.0008.obj");
    let grooms = [still.clone(), still].map(Ok::<_, tress::io::WriteError>);
    let frames = tress::io::Frames { start: 100.0, rate: 24.0 };
    let options = tress::io::WriteOptions::default();
    tress::io::write_animation(bench.path("b.abc"), frames, &options, grooms).expect("written");
    bench.done("blend a.abc b.abc middle.abc --amount 0.5 --space position --animated");
    let middle = tress::io::Animation::open(bench.path("middle.abc")).expect("readable");
    assert_eq!(middle.len(), 3);
    assert_eq!(middle.frames().start.to_bits(), 5.0_f64.to_bits());
}
