//! `tress groom`: built, edited, found, stopped and taken up again.

use std::fs;

use serde_json::Value;

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

    let text = fs::read_to_string(bench.path("found.ron")).expect("the file was written");
    fs::write(bench.path("bad.ron"), text.replace("Clump(", "Clamp(")).expect("a writable folder");
    let error = bench.fails("groom build bad.ron no.obj", 1);
    assert!(error.contains("Clamp") && error.contains("line"), "{error}");
}

#[test]
fn json_holds_parameters_and_history() {
    let bench = fitted("");
    let line = "groom fit groom.obj found.ron --operators scale --guides 4 --options quick.ron";
    let json: Value = serde_json::from_str(&bench.done(&format!("{line} --json"))).expect("JSON");
    assert_eq!(json["strands"], 20);
    assert!(json["operators"][0]["Scale"]["random"].is_number());
    assert!(json["history"].as_array().is_some_and(|history| !history.is_empty()));
}
