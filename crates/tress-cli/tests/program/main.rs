//! The program as its users meet it: exit status, what is printed where, files.

mod analysing;
mod bench;
mod grooms;
mod growing;
mod helicoid;
mod interchange;
mod sequence;
mod switchback;

use std::fs;
use std::path::Path;

use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, Strands};
use tress::io::Model;

use crate::bench::Bench;

fn bytes(path: &Path) -> Vec<u8> {
    fs::read(path).expect("the file was written")
}

#[test]
fn the_demo_makes_all_that_it_names() {
    let bench = Bench::new();
    let text = bench.done("demo made");
    assert!(text.contains("660 strands"), "{text}");
    for file in ["before-after.png", "analysis.html", "sculpted.hair", "patch.tress"] {
        assert!(text.contains(file), "{file} is not named in:\n{text}");
        assert!(!bytes(&bench.path("made").join(file)).is_empty(), "{file}");
    }
    let before = bench.groom("made/patch.hair");
    for file in ["made/ruffled.hair", "made/sculpted.hair", "made/ruffled.usda"] {
        let after = bench.groom(file);
        assert!(before.strands().counts().eq(after.strands().counts()), "{file}");
        assert_ne!(before.strands().points(), after.strands().points(), "{file}");
    }
}

#[test]
fn info_says_what_a_groom_is_like() {
    let bench = Bench::new();
    let text = bench.done("info groom.obj");
    for word in ["strands", "turns", "coil radius", "handedness", "none found"] {
        assert!(text.contains(word), "{word:?} is missing in:\n{text}");
    }
    let json = bench.json("info groom.obj");
    assert_eq!(json["strands"], 20);
    let radius = json["summary"]["coil_radius"]["median"].as_f64().expect("coils have a radius");
    assert!((0.4..0.7).contains(&radius), "coil radius {radius}");
    let summary = &json["summary"];
    let hands =
        [&summary["left_handed"], &summary["right_handed"]].map(|n| n.as_u64().unwrap_or(0));
    assert_eq!(hands[0] + hands[1], 20, "every wisp of the fixture winds one way");
}

#[test]
fn the_way_to_super_helices_and_back_keeps_every_strand() {
    let bench = Bench::new();
    bench.done("fit groom.obj groom.tress");
    bench.done("sample groom.tress back.obj --points 60");
    let (before, after) = (bench.groom("groom.obj"), bench.groom("back.obj"));
    assert_eq!(after.strands().len(), before.strands().len());
    for (a, b) in before.strands().iter().zip(after.strands().iter()) {
        assert_eq!(b.len(), 60);
        assert!(a[0].distance(b[0]) < 0.05, "the root moved by {}", a[0].distance(b[0]));
    }
}

#[test]
fn ruffling_depends_on_the_seed_and_on_nothing_else() {
    let bench = Bench::new();
    let ruffle = |to: &str, options: &str| {
        bench.done(&format!("ruffle groom.obj {to} --probability 0.3 {options}"));
        bytes(&bench.path(to))
    };
    let one = ruffle("a.obj", "--seed 3 --threads 1");
    assert_eq!(one, ruffle("b.obj", "--seed 3 --threads 3"));
    assert_ne!(one, ruffle("c.obj", "--seed 4"));
    let counts = |name: &str| bench.groom(name).strands().counts().collect::<Vec<_>>();
    assert_eq!(counts("a.obj"), counts("groom.obj"));
}

#[test]
fn shares_joined_are_the_whole() {
    let bench = Bench::new();
    for command in ["ruffle groom.obj", "convert groom.obj", "sample groom.obj", "fit groom.obj"] {
        let end = if command.starts_with("fit") { "tress" } else { "hair" };
        bench.done(&format!("{command} whole.{end}"));
        for i in 1..=3 {
            bench.done(&format!("{command} part{i}.{end} --shard {i}/3"));
        }
        bench.done(&format!("merge part1.{end} part2.{end} part3.{end} joined.{end}"));
        let path = |name: &str| bench.path(&format!("{name}.{end}"));
        assert_eq!(bytes(&path("joined")), bytes(&path("whole")), "{command}");
        let strands = |file: &str, more: &str| {
            bench.json(&format!("info {file}.{end} {more}"))["strands"].as_u64()
        };
        let shares: Vec<_> = (1..=3).map(|i| strands("whole", &format!("--shard {i}/3"))).collect();
        assert_eq!(shares, ["part1", "part2", "part3"].map(|part| strands(part, "")));
    }
}

#[test]
fn strands_that_are_no_curves_pass_through_and_are_counted() {
    let bench = Bench::new();
    let nan = DVec3::new(f64::NAN, 1.0, 2.0);
    let mut strands = Strands::default();
    for strand in [
        vec![DVec3::ONE],
        vec![DVec3::ZERO, nan, DVec3::Y],
        vec![DVec3::X; 4],
        vec![DVec3::ZERO, DVec3::Y],
        vec![DVec3::ZERO, DVec3::Y, DVec3::Y, DVec3::new(1.0, 2.0, 0.0)],
    ] {
        strands.push(strand).expect("few points");
    }
    bench.write("odd.data", &Groom::new(strands));
    let text = bench.done("info odd.data");
    for word in ["of a single point", "not finite", "of no length", "the point before"] {
        assert!(text.contains(word), "{word:?} is missing in:\n{text}");
    }
    bench.done("ruffle odd.data out.data --keep 0 --probability 1");
    let (before, after) = (bench.groom("odd.data"), bench.groom("out.data"));
    assert_eq!(after.strands().len(), 5);
    for i in 0..3 {
        let points = before.strands().strand(i).iter().zip(after.strands().strand(i));
        assert!(points.into_iter().all(|(a, b)| a == b || (a.is_nan() && b.is_nan())));
    }
    bench.done("fit odd.data odd.tress");
    bench.done("convert odd.tress again.data --points 9");
    let counts: Vec<usize> = bench.groom("again.data").strands().counts().collect();
    assert_eq!(counts, [1, 3, 4, 9, 9]);
}

#[test]
fn mistakes_are_told_in_one_line_and_leave_files_alone() {
    let bench = Bench::new();
    fs::create_dir(bench.path("folder.obj")).expect("a folder");
    fs::create_dir(bench.path("folder")).expect("a folder");
    fs::write(bench.path("notes.docx"), "").expect("a file");
    fs::write(bench.path("broken.data"), [9, 0, 0, 0, 0xff]).expect("a file");
    fs::write(bench.path("old.hair"), "old").expect("a file");
    fs::write(bench.path("broken.ron"), "(joints: [])").expect("a file");
    fs::write(bench.path("empty.ron"), "()").expect("a file");
    fs::write(bench.path("none.obj"), "").expect("a file");
    for (line, status, word) in [
        ("info nowhere.obj", 1, "nowhere.obj: no such file"),
        ("info folder.obj", 1, "is a directory"),
        ("info folder", 1, "is a directory"),
        ("info notes.docx", 1, "unknown extension .docx"),
        ("info broken.data", 1, "broken.data: byte"),
        ("convert groom.obj groom.obj", 1, "--in-place"),
        ("convert groom.obj nowhere/out.hair", 1, "nowhere/out.hair: there is no folder nowhere"),
        (
            "ruffle nowhere.obj out.obj --target unreal",
            2,
            "out.obj: --target unreal writes an .abc",
        ),
        ("ruffle nowhere.obj out.tress --points 9", 2, "a .tress file has none"),
        ("scatter broken.data out.obj --count 9", 1, "meshes are read from .obj and .ply"),
        ("helicoid trace broken.data out.obj", 1, "broken.data: expected text, found bytes"),
        ("helicoid trace empty.ron out.obj", 1, "empty.ron: line 1, column"),
        ("groom fit groom.obj out.ron --options nowhere.ron", 1, "nowhere.ron: no such file"),
        ("groom fit groom.obj out.obj", 2, "procedural grooms are written to a .ron file"),
        ("groom fit groom.obj out.ron --report out.txt", 2, "written to a .html file"),
        ("groom build empty.ron out.tress", 2, "a .tress file holds super-helices"),
        ("render groom.obj out.jpg", 2, "pictures are written to a .png file"),
        ("groom fit groom.obj out.ron --guides 2 --points 99999999999", 1, "there is no memory"),
        ("groom fit groom.obj nowhere/out.ron", 1, "there is no folder nowhere"),
        ("groom new none.obj out.ron --roots groom.obj", 1, "none.obj: no strand is a guide"),
        ("convert groom.obj out.tfx", 1, "--points"),
        ("ruffle groom.obj out.obj --groups wisp", 1, "no attribute of strands is called"),
        ("ruffle groom.obj out.obj --groups clusters:21", 1, "21 clusters"),
        ("ruffle groom.obj out.obj --probability 2", 1, "expected 0 to 1"),
        ("blend groom.obj broken.data out.obj", 1, "broken.data"),
        ("fit groom.obj out.obj", 2, ".tress"),
        ("fit groom.obj out.tress --elements 0", 1, "0 elements"),
        ("fit groom.obj out.tress --tolerance -1", 2, "tolerance"),
        ("recoil groom.obj out.obj --radius -1", 1, "above 0"),
        ("armature groom.obj out.obj", 2, ".ron"),
        ("armature groom.obj out.ron --clusters 0", 1, "0 clusters"),
        ("sculpt groom.obj out.obj --pose nowhere.ron", 1, "nowhere.ron"),
        ("sculpt groom.obj out.obj --pose broken.ron", 1, "broken.ron: line 1, column"),
        ("sculpt groom.obj out.obj --pose empty.ron --stiffness -1", 1, "-1"),
        ("sample groom.obj out.obj --points 1", 1, "at least 2"),
        ("sample groom.obj out.obj --points 9 --spacing 1", 2, "cannot be used with"),
        ("info groom.obj --threads 0", 2, "1 to 1024"),
        ("info groom.obj --shard 3/2", 2, "I/N"),
        ("groom fit groom.obj out.ron --shard 1/2", 2, "needs all strands"),
        ("merge groom.obj out.obj --shard 1/2", 2, "needs all strands"),
        ("groom groom.obj", 2, "unrecognized subcommand"),
        ("", 2, "Usage"),
    ] {
        let errors = bench.fails(line, status);
        assert!(errors.contains(word), "tress {line}: {word:?} is missing in:\n{errors}");
    }
    assert_eq!(bytes(&bench.path("old.hair")), b"old");
    let made: Vec<_> = fs::read_dir(bench.path(""))
        .expect("the folder is there")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name"))
        .collect();
    assert!(made.iter().all(|name| !name.starts_with("out")), "{made:?}");
}

#[test]
fn a_write_that_fails_leaves_the_old_file() {
    let bench = Bench::new();
    bench.done("convert groom.obj kept.hair");
    let before = bytes(&bench.path("kept.hair"));
    // A strand without points has no place in a .hair file.
    let strands = Strands::from_counts([2, 0], vec![DVec3::ZERO, DVec3::Y]).expect("two points");
    bench.write("empty.data", &Groom::new(strands));
    bench.fails("convert empty.data kept.hair", 1);
    assert_eq!(bytes(&bench.path("kept.hair")), before);
}

#[test]
fn overwriting_the_input_needs_a_word() {
    let bench = Bench::new();
    let before = bytes(&bench.path("groom.obj"));
    bench.fails("ruffle groom.obj groom.obj", 1);
    assert_eq!(bytes(&bench.path("groom.obj")), before);
    bench.done("ruffle groom.obj groom.obj --in-place");
    assert_ne!(bytes(&bench.path("groom.obj")), before);
}

#[test]
fn quiet_says_nothing_and_json_says_one_object() {
    let bench = Bench::new();
    assert_eq!(bench.done("convert groom.obj a.hair --quiet"), "");
    for command in [
        "info groom.obj",
        "convert groom.obj a.hair",
        "fit groom.obj a.tress",
        "sample a.tress b.obj",
        "ruffle groom.obj c.obj",
        "blend groom.obj c.obj d.obj",
        "merge a.hair a.hair e.hair",
        "recoil groom.obj f.obj --radius 1.2",
        "armature groom.obj g.ron --clusters 2",
        "sculpt groom.obj h.obj --pose g.ron",
    ] {
        let json = bench.json(command);
        assert!(json.is_object() && json["seconds"].is_number(), "{command}: {json}");
    }
}

#[test]
fn half_way_between_a_groom_and_itself_is_itself() {
    let bench = Bench::new();
    bench.done("blend groom.obj groom.obj same.obj");
    bench.done("sample groom.obj sampled.obj --points 50");
    bench.done("blend groom.obj groom.obj same.obj --points 50");
    let (a, b) = (bench.groom("sampled.obj"), bench.groom("same.obj"));
    for (a, b) in a.strands().points().iter().zip(b.strands().points()) {
        assert!(a.distance(*b) < 1e-9);
    }
    bench.done("blend groom.obj groom.obj same.obj --space position");
    assert_eq!(bench.groom("same.obj"), bench.groom("groom.obj"));
}

#[test]
fn a_pose_moves_the_tips_of_its_cluster_and_no_length() {
    let bench = Bench::new();
    bench.done("fit groom.obj groom.tress --elements 60");
    bench.done("armature groom.tress pose.ron --clusters 1 --joints 1");
    let rest = fs::read_to_string(bench.path("pose.ron")).expect("the pose was written");
    let moved = rest.replacen("translate: (0.0, 0.0, 0.0)", "translate: (0.0, -1.0, 0.0)", 1);
    assert_ne!(rest, moved, "a joint can be moved by its translate:\n{rest}");
    fs::write(bench.path("moved.ron"), moved).expect("a file");
    bench.done("sculpt groom.tress down.tress --pose moved.ron");
    let json = bench.json("sculpt groom.tress down.tress --pose moved.ron");
    assert_eq!(json["sculpt"]["moved"], 20);
    let helices = |name: &str| match tress::io::read(bench.path(name)).expect("a file") {
        Model::Helices(helices) => helices,
        Model::Polylines(_) => panic!("{name} holds polylines"),
    };
    let (before, after) = (helices("groom.tress"), helices("down.tress"));
    for (a, b) in before.iter().zip(after.iter()) {
        let fall = b.tip().position - a.tip().position;
        assert!(fall.distance(DVec3::NEG_Y) < 0.05, "a tip moved by {fall}");
        assert!((a.length() - b.length()).abs() < 1e-12 * a.length());
    }
}

#[test]
fn wider_coils_keep_what_they_are_told_to() {
    let bench = Bench::new();
    bench.done("fit groom.obj groom.tress --elements 100");
    for (keep, kept) in [("length", "length"), ("turns", "turns")] {
        let line = format!("recoil groom.tress wide.tress --radius 1.3 --keep {keep}");
        let json = bench.json(&line);
        let median = |when: &str, of: &str| json[when][of]["median"].as_f64().expect("a number");
        let ratio = median("after", "coil_radius") / median("before", "coil_radius");
        assert!((1.2..1.4).contains(&ratio), "radius x {ratio}");
        let ratio = median("after", kept) / median("before", kept);
        assert!((ratio - 1.0).abs() < 0.02, "{kept} x {ratio}");
    }
    bench.done("recoil groom.tress wide.obj --radius 1.3 --keep centerline");
    assert_eq!(bench.groom("wide.obj").strands().len(), 20);
}
