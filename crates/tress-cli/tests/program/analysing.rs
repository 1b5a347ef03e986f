//! Analysis, comparison and reports.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::bench::Bench;

fn text(path: &Path) -> String {
    fs::read_to_string(path).expect("the file was written")
}

#[test]
fn analyze_says_and_writes_what_a_groom_is_like() {
    let bench = Bench::new();
    let line = "analyze groom.obj --unit cm --csv strands.csv --csv-along along.csv \
                --csv-plots plots.csv --plot plots.svg --quantity beta,radius";
    let json = bench.json(line);
    let radius = json["summary"]["coil_radius"]["median"].as_f64().expect("coils have a radius");
    assert!((0.4..0.7).contains(&radius), "coil radius {radius}");
    let millimetres = json["coil_diameter_mm"].as_f64().expect("the unit is known");
    assert!((millimetres - 20.0 * radius).abs() < 1e-9);
    let locked = json["wisps"]["phase_locked"]["median"].as_f64().expect("a share");
    assert!((0.05..1.0).contains(&locked), "strands of a wisp stray from each other: {locked}");

    let strands = text(&bench.path("strands.csv"));
    assert_eq!(strands.lines().count(), 21);
    let head = strands.lines().next().expect("a head");
    assert!(head.contains("coil_radius [cm]") && head.contains("turns"));
    let columns = head.split(',').count();
    assert!(strands.lines().all(|row| row.split(',').count() == columns));
    let points = bench.groom("groom.obj").strands().points().len();
    assert_eq!(text(&bench.path("along.csv")).lines().count(), points + 1);
    let plots = text(&bench.path("plots.csv"));
    assert!(plots.starts_with("plot,x_name,y_name,series,x,y\n") && !plots.contains("NaN"));
    let svg = text(&bench.path("plots.svg"));
    assert!(svg.contains("Coil diameter (mm)") && svg.contains("Beta") && !svg.contains("NaN"));
}

#[test]
fn wisps_are_as_many_as_the_guides_that_hairs_were_grown_on() {
    let bench = crate::growing::bench();
    bench.done("grow guides.obj hair.obj --scalp scalp.obj --count 200");
    let json = bench.json("analyze hair.obj");
    let wisps = &json["wisps"];
    let (many, inside) = (wisps["wisps"].as_u64(), wisps["strands_in_wisps"].as_u64());
    let (many, inside) = many.zip(inside).expect("numbers");
    assert!((7..=10).contains(&many) && 190 <= inside, "{wisps}");
}

#[test]
fn diff_says_how_far_two_grooms_are_apart() {
    let bench = Bench::new();
    let same = bench.json("diff groom.obj groom.obj");
    assert_eq!(same["comparison"]["nearest"]["greatest"], 0.0);
    assert_eq!(same["comparison"]["distributions"]["spectrum"], 0.0);
    bench.done("recoil groom.obj wider.obj --radius 1.3");
    let line = "diff groom.obj wider.obj --png sheet.png --html diff.html";
    let said = bench.done(line);
    for word in ["nearest", "by index", "Frechet", "coil radii", "spectra"] {
        assert!(said.contains(word), "{word:?} is missing in:\n{said}");
    }
    let first = fs::read(bench.path("sheet.png")).expect("the sheet was written");
    bench.done(line);
    assert_eq!(first, fs::read(bench.path("sheet.png")).expect("it was written again"));
    assert!(text(&bench.path("diff.html")).contains("<svg"));
}

#[test]
fn files_that_cannot_be_written_are_refused_before_any_work() {
    let bench = Bench::new();
    assert!(bench.fails("analyze groom.obj --html report.txt", 2).contains(".html"));
    assert!(bench.fails("analyze groom.obj --plot plot.pdf", 2).contains(".svg or .png"));
    assert!(bench.fails("analyze groom.obj --quantity colour", 2).contains("no quantity"));
    assert!(bench.fails("diff groom.obj groom.obj --png sheet.jpg", 2).contains(".png"));
    bench.fails("diff groom.obj missing.obj", 1);
}

/// A browser without a screen, where one is installed.
fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    names.into_iter().find(|name| {
        let version = Command::new(name).arg("--version").output();
        version.is_ok_and(|output| output.status.success())
    })
}

#[test]
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn a_browser_shows_the_report_whole() {
    let bench = Bench::new();
    bench.done("analyze groom.obj --unit cm --html report.html");
    let html = text(&bench.path("report.html"));
    // What is between the pictures' bytes.
    let words = html.split("base64,").map(|part| part.split_once('"').map_or(part, |(_, w)| w));
    let words: String = words.collect();
    assert!(!words.contains("NaN") && !html.contains("src=\"http"), "{words}");
    let Some(browser) = browser() else {
        eprintln!("no Chromium is installed: the report is not opened");
        return;
    };
    let url = format!("file://{}", bench.path("report.html").display());
    let profile = format!("--user-data-dir={}", bench.path("profile").display());
    let shot = format!("--screenshot={}", bench.path("shot.png").display());
    let always = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", &profile];
    let run = |extra: &[&str]| {
        let output = Command::new(browser).args(always).args(extra).arg(&url).output();
        let output = output.expect("the browser starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    // What the browser made of it: every figure is there and every table is.
    let dom = run(&["--dump-dom"]);
    for (tag, least) in [("<svg", 10), ("<img", 3), ("<table", 1), ("<figcaption", 13)] {
        assert!(least <= dom.matches(tag).count(), "{tag}: {}", dom.matches(tag).count());
    }
    assert!(dom.contains("In numbers") && dom.trim_end().ends_with("</html>"));
    run(&["--window-size=1280,1600", &shot]);
    let picture = fs::read(bench.path("shot.png")).expect("a screenshot");
    assert!(50_000 < picture.len(), "{} bytes is an empty page", picture.len());
}
