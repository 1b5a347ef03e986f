//! `grow`, `spectra` and `scatter`.

use std::fs;

use tress::geometry::Groom;
use tress::geometry::glam::DVec3;
use tress_fixtures::{PatchOptions, coily_patch, scalp};

use crate::bench::Bench;

/// Eight guides, forty roots between them, a scalp.
pub(crate) fn bench() -> Bench {
    let bench = Bench::new();
    let options = PatchOptions { wisps: 8, strands_per_wisp: 1, ..PatchOptions::default() };
    bench.write("guides.obj", &coily_patch(&options, 2));
    let mesh = scalp(&options);
    let mut text = String::new();
    for p in mesh.positions() {
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for [a, b, c] in mesh.triangles() {
        text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    fs::write(bench.path("scalp.obj"), text).expect("room on the disk");
    bench
}

fn firsts(groom: &Groom) -> Vec<DVec3> {
    groom.strands().iter().map(|points| points[0]).collect()
}

#[test]
fn roots_are_scattered_and_hairs_grow_on_them() {
    let bench = bench();
    bench.done("scatter scalp.obj roots.obj --count 40 --seed 2");
    let roots = bench.groom("roots.obj");
    assert!(roots.strands().len() == 40 && roots.strands().counts().all(|n| n == 1));
    let text = bench.done("grow guides.obj hairs.obj --roots roots.obj --preset long-coils");
    assert!(text.contains("40 hairs on "), "{text}");
    let hairs = bench.groom("hairs.obj");
    assert_eq!(firsts(&hairs), firsts(&roots));
    assert!(hairs.strands().counts().all(|n| n > 50));
    // The same in one step.
    bench.done("grow guides.obj both.obj --scalp scalp.obj --count 40 --seed 2");
    assert_eq!(firsts(&bench.groom("both.obj")), firsts(&roots));
}

#[test]
fn the_seed_and_not_the_threads_or_shares_decides() {
    let bench = bench();
    let grow = |to: &str, options: &str| {
        bench.done(&format!("grow guides.obj {to} --scalp scalp.obj --count 60 {options}"));
        fs::read(bench.path(to)).expect("the file was written")
    };
    let one = grow("a.hair", "--seed 3 --threads 1 --skip 0.3");
    assert_eq!(one, grow("b.hair", "--seed 3 --threads 3 --skip 0.3"));
    assert_ne!(one, grow("c.hair", "--seed 4 --skip 0.3"));
    grow("1.hair", "--seed 3 --skip 0.3 --shard 1/2");
    grow("2.hair", "--seed 3 --skip 0.3 --shard 2/2");
    bench.done("merge 1.hair 2.hair whole.hair");
    assert_eq!(one, fs::read(bench.path("whole.hair")).expect("the file was written"));
}

#[test]
fn libraries_are_made_and_used() {
    let bench = bench();
    let text = bench.done("spectra groom.obj coils.tress-spectra");
    assert!(text.contains("20 coils"), "{text}");
    let line = "grow guides.obj a.obj --scalp scalp.obj --count 9 --spectra coils.tress-spectra";
    bench.done(line);
    assert_eq!(bench.groom("a.obj").strands().len(), 9);
    bench.fails("spectra groom.obj coils.obj", 2);
    fs::write(bench.path("bad.tress-spectra"), "nothing").expect("room on the disk");
    let line = "grow guides.obj a.obj --scalp scalp.obj --count 9 --spectra bad.tress-spectra";
    assert!(bench.fails(line, 1).contains("bad.tress-spectra: no safetensors file"));
}

#[test]
fn groupings_and_options_are_read_and_refused_where_they_are_wrong() {
    let bench = bench();
    bench.done("scatter scalp.obj roots.obj --count 4");
    fs::write(bench.path("groups.csv"), "0,2\n\n1\n3\n").expect("room on the disk");
    bench.done("grow guides.obj hairs.npz --roots roots.obj --groups groups.csv");
    let hairs = bench.groom("hairs.npz");
    assert_eq!(hairs.strand_values("guide"), Some(vec![0.0, 2.0, 0.0, 3.0]));
    fs::write(bench.path("groups.csv"), "0,2\n1\n").expect("room on the disk");
    let line = "grow guides.obj hairs.obj --roots roots.obj --groups groups.csv";
    assert!(bench.fails(line, 1).contains("groups.csv: line 2: root 3 has no guide"));

    fs::write(bench.path("mine.ron"), "(skip: (probability: 0.5, each: Turns))").expect("room");
    bench.done("grow guides.obj hairs.obj --roots roots.obj --options mine.ron");
    fs::write(bench.path("mine.ron"), "(skips: 0.5)").expect("room on the disk");
    let line = "grow guides.obj hairs.obj --roots roots.obj --options mine.ron";
    assert!(bench.fails(line, 1).contains("mine.ron"));
    let line = "grow guides.obj hairs.obj --roots roots.obj --skip 1.5";
    assert!(bench.fails(line, 1).contains("skip.probability is 1.5"));
    bench.fails("grow guides.obj hairs.obj", 2);
    bench.fails("grow guides.obj hairs.obj --roots roots.obj --assign far", 2);
    assert!(bench.fails("scatter groom.obj roots.obj --count 4", 1).contains("faces"));
}

#[test]
fn a_sequence_grows_the_same_hairs_on_every_frame() {
    let bench = bench();
    let mut guides = bench.groom("guides.obj");
    for frame in 1..=3 {
        bench.write(&format!("guides.{frame:04}.obj"), &guides);
        guides.positions_mut().iter_mut().for_each(|p| p.x += 0.05 * (p.y - 9.0));
    }
    bench.done("scatter scalp.obj roots.obj --count 30");
    let line = "grow guides.%04d.obj hairs.%04d.obj --roots roots.obj";
    assert!(bench.json(line).is_object());
    let frames: Vec<Groom> = (1..=3).map(|i| bench.groom(&format!("hairs.{i:04}.obj"))).collect();
    for pair in frames.windows(2) {
        let (a, b) = (pair[0].strands(), pair[1].strands());
        assert_eq!(a.offsets(), b.offsets());
        let change = a.points().iter().zip(b.points()).map(|(p, q)| p.distance(*q));
        let greatest = change.fold(0.0, f64::max);
        assert!(0.01 < greatest && greatest < 2.0, "{greatest}");
    }
}
