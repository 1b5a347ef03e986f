//! Real files of other people's programs, where the folder with them is there.

use std::path::PathBuf;

use glam::DVec3;
use tress_geometry::{Column, Groom, names};
use tress_io::{Model, read};

/// The folder beside the workspace that holds grooms made by others; they are not ours to copy.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/grooms");

/// The groom of this name, if the folder is there.
fn groom(name: &str) -> Option<Groom> {
    let folder = PathBuf::from(FOLDER);
    if !folder.is_dir() {
        use std::io::Write;
        let _ = writeln!(std::io::stderr(), "{FOLDER} is not there: nothing to read");
        return None;
    }
    match read(folder.join(name)) {
        Ok(Model::Polylines(groom)) => Some(groom),
        other => panic!("{name}: {other:?}"),
    }
}

/// Strands, points, and the fewest and most points of a strand.
fn shape(groom: &Groom) -> (usize, usize, usize, usize) {
    let strands = groom.strands();
    let least = strands.counts().min().unwrap_or(0);
    let most = strands.counts().max().unwrap_or(0);
    (strands.len(), strands.points().len(), least, most)
}

#[test]
fn every_file_has_the_strands_it_should() {
    for (name, expected) in [
        ("curlycue/curlycue_guides_f00.obj", (98, 10_589, 93, 123)),
        ("curlycue/curlycue_guides_f70.obj", (98, 10_589, 93, 123)),
        ("curlycue/curlycue_swatch70_seed1337.obj", (3_176, 233_315, 40, 104)),
        ("curlycue/sideSwatchGuides.obj", (98, 98, 1, 1)),
        ("curlycue/sideSwatchScalp.obj", (3_176, 3_176, 1, 1)),
        ("yuksel_straight.hair", (10_000, 160_000, 16, 16)),
        ("digitalsalon_harolongo.data", (7_905, 166_005, 21, 21)),
        ("tressfx4_ratboy_mohawk.tfx", (2_228, 71_296, 32, 32)),
        ("hairutil/Curly_100.ply", (100, 2_528, 10, 47)),
        ("hairutil/Bangs_20.bin", (20, 235, 7, 21)),
    ] {
        let Some(groom) = groom(name) else { return };
        assert_eq!(shape(&groom), expected, "{name}");
    }
}

#[test]
fn one_groom_in_its_formats_reads_alike() {
    let Some(hair) = groom("hairutil/Bangs_100.hair") else { return };
    assert_eq!(shape(&hair), (100, 1_165, 5, 21));
    let same =
        |name: &str| assert_eq!(groom(name).as_ref().map(Groom::strands), Some(hair.strands()));
    for name in ["data", "bin"] {
        same(&format!("hairutil/Bangs_100.{name}"));
    }
    same("hairutil/Bangs_100_binary.ply");
    // Printed with nine digits, which 32 bits need.
    let ascii = groom("hairutil/Bangs_100_ascii.ply").expect("the folder is there");
    assert_eq!(ascii.strands().offsets(), hair.strands().offsets());
    let narrow = |p: &DVec3| p.as_vec3();
    let (a, b) = (ascii.strands().points().iter(), hair.strands().points().iter());
    assert!(a.map(narrow).eq(b.map(narrow)));
}

#[test]
fn hair_files_say_width_opacity_and_colour() {
    let Some(straight) = groom("yuksel_straight.hair") else { return };
    let first = |name: &str| {
        let column = straight.strand_attributes().get(name).expect("said by the header");
        column.first_components().next().expect("a strand")
    };
    assert!((first(names::WIDTH) - 0.1).abs() < 1e-7);
    assert!((first(names::OPACITY) - (1.0 - 0.355_777)).abs() < 1e-6);
    let colors = straight.point_attributes().get(names::COLOR).expect("an array");
    assert_eq!(colors.components(), 3);
    let bangs = groom("hairutil/Bangs_100.hair").expect("the folder is there");
    assert!(bangs.strand_attributes().is_empty() && bangs.point_attributes().is_empty());
}

#[test]
fn tressfx_strands_are_held_at_two_points_and_placed_on_the_head() {
    let Some(mohawk) = groom("tressfx4_ratboy_mohawk.tfx") else { return };
    assert!(mohawk.point_attributes().is_empty(), "inverse masses are as always");
    let uv = mohawk.strand_attributes().get(names::ROOT_UV);
    assert!(matches!(uv, Some(Column::Float { components: 2, .. })));
}
