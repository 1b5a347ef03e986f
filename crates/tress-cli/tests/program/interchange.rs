//! Files for other programs: Alembic, binary USD, Unreal.

use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, Strands};

use crate::bench::Bench;

#[test]
fn a_groom_goes_through_alembic_and_binary_usd() {
    let bench = Bench::new();
    bench.done("convert groom.obj groom.abc --unit cm --up y");
    bench.done("convert groom.abc groom.usdc");
    bench.done("convert groom.usdc back.obj");
    let (begin, end) = (bench.groom("groom.obj"), bench.groom("back.obj"));
    assert_eq!(begin.strands().offsets(), end.strands().offsets());
    let pairs = begin.strands().points().iter().zip(end.strands().points());
    assert!(pairs.clone().all(|(a, b)| a.distance(*b) <= 1e-6 * a.length()));
    let through = bench.groom("groom.usdc");
    assert_eq!(through.unit, Some(0.01));
}

#[test]
fn strands_too_long_for_unreal_are_resampled_and_the_error_is_said() {
    let bench = Bench::new();
    let coil = |i: i32| {
        let angle = f64::from(i) * 0.2;
        DVec3::new(0.5 * angle.cos(), 0.01 * f64::from(i), 0.5 * angle.sin())
    };
    let strands = Strands::from_counts([600, 20], (0..620).map(coil).collect()).expect("620");
    bench.write("long.npy.obj", &Groom::new(strands));
    let report = bench.done("convert long.npy.obj long.abc --target unreal --unit mm --up z");
    assert!(report.contains("1 strands to 255 points, at most 0.00"), "{report}");
    let groom = bench.groom("long.abc");
    assert_eq!(groom.strands().counts().collect::<Vec<_>>(), [255, 20]);
    assert_eq!(groom.unit, Some(0.01));
    let error = bench.fails("convert long.npy.obj long.usdc --target unreal", 2);
    assert!(error.contains("writes an .abc file"), "{error}");
}

#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
#[test]
fn a_full_disk_is_one_line_on_standard_error() {
    let bench = Bench::new();
    let disk = bench.path("disk");
    std::fs::create_dir(&disk).expect("a folder");
    let mount = |words: &[&str]| {
        let done = std::process::Command::new(words[0]).args(&words[1..]).arg(&disk).output();
        done.is_ok_and(|output| output.status.success())
    };
    if !mount(&["mount", "-t", "tmpfs", "-o", "size=8k", "tmpfs"]) {
        eprintln!("skipped: no small disk can be mounted here");
        return;
    }
    let outputs = ["npz", "abc", "usdc", "hair", "usda", "obj", "ply"]
        .map(|format| bench.run(&format!("convert groom.obj disk/groom.{format}")));
    mount(&["umount"]);
    for output in outputs {
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{errors}");
        assert!(errors.trim_end().ends_with("no space is left on the disk"), "{errors}");
        assert_eq!(errors.trim_end().lines().count(), 1, "{errors}");
    }
}
