//! `tress groom`: built, edited, found, stopped and taken up again.

use std::fs;

use tress::geometry::{Column, names};

use crate::bench::Bench;

/// Options that end in a moment.
const QUICK: &str = "(
    guide: (steps: 3),
    parameters: (strands: 20, slices: 8, searches: 1, steps: 1, rounds: 1, patches: 2),
    numbers: (steps: 2),
)";

/// A folder with a groom in it, fitted.
fn fitted(more: &str) -> Bench {
    let bench = Bench::new();
    fs::write(bench.path("quick.ron"), QUICK).expect("a writable folder");
    bench.done(&format!(
        "groom fit groom.obj found.ron --operators clump,curl --guides 4 --points 40 \
         --options quick.ron {more}"
    ));
    bench
}

#[test]
fn a_groom_is_found_built_and_edited() {
    let bench = fitted("--report report.html");
    bench.done("groom build found.ron strands.obj");
    assert_eq!(bench.groom("strands.obj").strands().len(), 20);
    bench.done("groom build found.ron again.obj");
    let bytes = |name: &str| fs::read(bench.path(name)).expect("the file was written");
    assert_eq!(bytes("strands.obj"), bytes("again.obj"));
    let page = String::from_utf8(bytes("report.html")).expect("a page is text");
    assert!(page.contains("clump profile") && page.contains("<svg"));

    bench.done("groom edit found.ron edited.ron --set clump.profile=7.5");
    assert!(String::from_utf8(bytes("edited.ron")).expect("RON is text").contains("7.5"));
    bench.done("groom build edited.ron edited.obj");
    assert_ne!(bytes("strands.obj"), bytes("edited.obj"));
}

#[test]
fn strands_are_as_wide_as_the_guides_or_as_the_file_says() {
    let bench = Bench::new();
    let mut guides = bench.groom("groom.obj").select(&[0, 6, 12, 18]);
    let widths = Column::scalar(vec![0.25; guides.strands().points().len()]);
    guides.insert_point_attribute(names::WIDTH, widths).expect("one each");
    bench.write("guides.usda", &guides);
    bench.done("groom new guides.usda groom.ron --roots groom.obj --points 30");
    let built = || {
        bench.done("groom build groom.ron strands.usda");
        bench.groom("strands.usda").strand_values(names::WIDTH).expect("a width")
    };
    assert_eq!(built(), vec![0.25; 20]);
    change(&bench, "0.25,", "1.0, 0.5");
    assert!(built().iter().all(|width| (width - 0.75).abs() < 1e-6));
    change(&bench, "1.0, 0.5", "1.0, -0.5");
    let error = bench.fails("groom build groom.ron strands.usda", 1);
    assert!(error.contains("width 1 is -0.5, expected a number from 0"), "{error}");
}

#[test]
fn a_fit_goes_on_from_its_checkpoint_and_from_no_other() {
    let bench = fitted("--checkpoint work");
    let common = "--operators clump,curl --guides 4 --points 40 --options quick.ron";
    bench.done(&format!("groom fit groom.obj again.ron {common} --checkpoint work --resume"));
    let read = |name: &str| fs::read_to_string(bench.path(name)).expect("the file was written");
    assert_eq!(read("found.ron").replace("found", "again"), read("again.ron"));
    bench.done("ruffle groom.obj other.obj --probability 0.5");
    let line = format!("groom fit other.obj no.ron {common} --checkpoint work --resume");
    assert!(bench.fails(&line, 1).contains("another target"));
}

#[test]
fn what_cannot_be_is_said() {
    let bench = fitted("");
    let error = bench.fails("groom fit groom.obj no.ron --guides 500", 1);
    assert!(error.contains("500 guides cannot be found for 20 strands"), "{error}");
    bench.fails("groom fit groom.obj no.ron --operators curl,braid", 2);
    let error = bench.fails("groom edit found.ron no.ron --set braid.width=1", 1);
    assert!(error.contains("no operator \"braid\" in this groom: clump, curl"), "{error}");
    let error = bench.fails("groom edit found.ron no.ron --set curl.width=1", 1);
    assert!(error.contains("no parameter \"width\" of curl: radius, frequency"), "{error}");
    let error = bench.fails("groom edit found.ron no.ron --set clump.profile=-1", 1);
    assert!(error.contains("clump 0: profile is -1, expected 0 to 100"), "{error}");
    bench.fails("groom edit found.ron no.ron --set clump", 2);
    assert!(!bench.path("no.ron").exists());

    bench.fails("groom edit found.ron no.ron --neighbors 3", 2);
}

/// A procedural groom of four guides and twenty strands, its operators as written here.
fn begun(operators: &str) -> Bench {
    let bench = Bench::new();
    let guides = bench.groom("groom.obj").select(&[0, 6, 12, 18]);
    bench.write("guides.obj", &guides);
    bench.done("groom new guides.obj groom.ron --roots groom.obj --points 30");
    change(&bench, "operators: []", &format!("operators: [{operators}]"));
    bench
}

fn change(bench: &Bench, from: &str, to: &str) {
    let path = bench.path("groom.ron");
    let text = fs::read_to_string(&path).expect("the file was written");
    assert!(text.contains(from), "{text}");
    fs::write(path, text.replace(from, to)).expect("a writable folder");
}

#[test]
fn a_groom_is_begun_from_guides_and_its_operators_are_written_by_hand() {
    let bench = begun("Clump(profile: 2.0), Skip(probability: 0.5), Recoil(radius: 0.9)");
    bench.done("groom build groom.ron strands.obj");
    let strands = bench.groom("strands.obj");
    assert_eq!(strands.strands().len(), 20);
    assert!(strands.strands().counts().all(|n| n == 30));
    let roots = |groom: &tress::geometry::Groom| -> Vec<_> {
        groom.strands().iter().map(|points| points[0]).collect()
    };
    assert_eq!(roots(&strands), roots(&bench.groom("groom.obj")));
}

#[test]
fn what_is_wrong_in_a_groom_is_said() {
    let cases = [
        ("Curl(radius: -0.5)", "curl 0: radius is -0.5, expected 0 to inf"),
        ("Clump(), Bend(start: 1.5)", "bend 1: start is 1.5, expected 0 to 1"),
        ("Skip(probability: 1.5)", "skip 0: probability is 1.5, expected 0 to 1"),
        ("Frizz(amplitude: inf)", "frizz 0: amplitude is inf, expected 0 to inf"),
        ("Recoil(radius: 0.0)", "recoil 0: the factor of the radius is 0, expected a number"),
        ("Ruffle(probability: 7.0)", "ruffle 0: the probability of a ruffle is 7, expected 0 to"),
        ("Switchback(places: shares([2.0]))", "switchback 0: a share of the strand is 2, expected"),
    ];
    for (operators, what) in cases {
        let bench = begun(operators);
        let error = bench.fails("groom build groom.ron no.obj", 1);
        assert!(error.contains(what), "{operators}: {error}");
        assert!(!bench.path("no.obj").exists());
    }
    let bench = begun("Recoil(radius: 0.5)");
    let error = bench.fails("groom edit groom.ron no.ron --set recoil.radius=2", 1);
    assert!(error.contains("options of recoil are changed in the .ron file"), "{error}");
}

#[test]
fn unknown_names_in_a_groom_are_said_with_line_and_column() {
    // An error's place is that of the name, or right before it.
    for (operators, name) in [
        ("Clump(profile: 1.0),\n Clamp(profile: 2.0)", "Clamp"),
        ("Clump(profile: 1.0),\n\n   Bend(angle: 1.0)", "angle"),
        ("Skip(probability: 0.1, each: Twists)", "Twists"),
        ("Curl(radius: big)", "big"),
    ] {
        let bench = begun(operators);
        let text = fs::read_to_string(bench.path("groom.ron")).expect("the file was written");
        let (line, column) = (1..)
            .zip(text.lines())
            .find_map(|(i, line)| Some((i, 1 + line.find(name)?)))
            .expect("the name is there");
        for command in ["build groom.ron no.obj", "edit groom.ron no.ron --set clump.profile=1"] {
            let error = bench.fails(&format!("groom {command}"), 1);
            let places = [column - 1, column]
                .map(|column| format!("groom.ron: line {line}, column {column}: "));
            assert!(places.iter().any(|place| error.contains(place)), "{column}: {error}");
            assert!(name == "big" || error.contains(name), "{error}");
        }
        assert!(!bench.path("no.obj").exists() && !bench.path("no.ron").exists());
    }
}

#[test]
fn guides_that_do_not_fit_together_are_refused() {
    let bench = begun("");
    let error = bench.fails("groom new guides.obj no.ron --roots groom.obj", 1);
    assert!(error.contains("guides.obj: strand ") && error.contains(" points, expected "));
    let error = bench.fails("groom new groom.obj no.ron --roots guides.obj --points 9", 1);
    assert!(error.contains("4 roots are fewer than 20 guides"), "{error}");
    let error = bench.fails("groom new guides.obj no.ron --roots groom.obj --points 1", 1);
    assert!(error.contains("strands of 1 points, expected 2 or more"), "{error}");
    bench.fails("groom new guides.obj no.ron", 2);
    bench.fails("groom new guides.obj no.ron --roots groom.obj --count 7", 2);
    let error = bench.fails("groom edit groom.ron no.ron --set recoil.radius=2", 1);
    assert!(error.contains("no operator \"recoil\""), "{error}");
    assert!(!bench.path("no.ron").exists());
    // The arrays beside the file are looked at as well.
    let beside = bench.path("groom.safetensors");
    let bytes = fs::read(&beside).expect("the arrays");
    fs::write(&beside, &bytes[..bytes.len() / 2]).expect("a writable folder");
    let error = bench.fails("groom build groom.ron no.obj", 1);
    assert!(error.contains("groom.safetensors: not a safetensors file"), "{error}");
    fs::remove_file(&beside).expect("it is there");
    let error = bench.fails("groom build groom.ron no.obj", 1);
    assert!(error.contains("groom.safetensors"), "{error}");
}

#[test]
fn strands_are_blended_over_the_scalp() {
    let bench = begun("");
    let options = tress_fixtures::PatchOptions::default();
    let scalp = tress_fixtures::scalp(&options);
    let mut text = String::new();
    for x in scalp.positions() {
        text.push_str(&format!("v {} {} {}\n", x.x, x.y, x.z));
    }
    for [a, b, c] in scalp.triangles() {
        text.push_str(&format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    }
    fs::write(bench.path("scalp.obj"), text).expect("a writable folder");
    bench.done("groom edit groom.ron over.ron --scalp scalp.obj --neighbors 2 --sigma 3");
    let text = fs::read_to_string(bench.path("over.ron")).expect("the file was written");
    assert!(text.contains("Stored"), "{text}");
    bench.done("groom build over.ron over.obj");
    bench.done("groom build groom.ron strands.obj");
    assert_ne!(bench.groom("over.obj"), bench.groom("strands.obj"));
    bench.done("groom new guides.obj scattered.ron --scalp scalp.obj --count 50 --points 20");
    bench.done("groom build scattered.ron scattered.obj");
    assert_eq!(bench.groom("scattered.obj").strands().len(), 50);
    let error = bench.fails("groom edit groom.ron no.ron --scalp scalp.obj --sigma -1", 1);
    assert!(error.contains("the sigma of instancing is -1, expected a number above 0"), "{error}");
    bench.fails("groom edit groom.ron no.ron --scalp nowhere.obj", 1);
}

#[test]
fn json_holds_parameters_and_history() {
    let bench = fitted("");
    let line = "groom fit groom.obj found.ron --operators scale --guides 4 --options quick.ron";
    let json = bench.json(line);
    assert_eq!(json["strands"], 20);
    assert!(json["operators"][0]["Scale"]["random"].is_number());
    assert!(json["history"].as_array().is_some_and(|history| !history.is_empty()));
}
