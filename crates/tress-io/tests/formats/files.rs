//! Files on disk: chosen by extension, written whole or not at all, refused with one clear line.

use std::fs;
use std::path::Path;

use glam::DVec3;
use tempfile::tempdir;
use tress_geometry::{Column, Element, Frame, Groom, HelixGroom, Strands, UpAxis, names};
use tress_io::{Format, Loss, Model, WriteError, WriteOptions, read, write, write_helices};

use super::common::{FORMATS, full_groom, strands};

fn save(path: &Path, groom: &Groom) -> Result<Vec<Loss>, WriteError> {
    write(path, groom, &WriteOptions::default())
}

fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("utf-8"))
        .collect()
}

#[test]
fn every_format_is_chosen_by_its_extension() {
    let folder = tempdir().expect("a folder");
    for format in FORMATS {
        let path = folder.path().join(format!("groom.{}", format.extension().to_uppercase()));
        let groom = full_groom(format);
        assert_eq!(save(&path, &groom).expect("a groom made for the format"), []);
        let Model::Polylines(read) = read(&path).expect("whole") else { panic!("polylines") };
        assert_eq!(read.strands(), groom.strands(), "{format}");
    }
    assert_eq!(names_in(folder.path()).len(), FORMATS.len(), "nothing else is left behind");
}

#[test]
fn super_helices_go_to_the_native_file_alone() {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("groom.tress");
    let coil = Element { length: 2.0, ..Element::coil(0.5, -1.0) };
    let elements = Strands::from_counts([2, 1], vec![coil; 3]).expect("three");
    let groom = HelixGroom::new(vec![Frame::IDENTITY; 2], elements).expect("two roots");
    write_helices(&path, &groom).expect("a folder to write to");
    assert_eq!(read(&path).expect("whole"), Model::Helices(groom.clone()));
    let error = write_helices(folder.path().join("groom.obj"), &groom).expect_err("no polylines");
    assert!(error.to_string().contains("sample them first"), "{error}");
    let error = save(&path, &full_groom(Format::Obj)).expect_err("no helices");
    assert!(error.to_string().contains("fit them first"), "{error}");
    assert_eq!(read(&path).expect("the old file"), Model::Helices(groom));
}

#[test]
fn a_strand_that_cannot_be_written_leaves_the_old_file_and_nothing_else() {
    let folder = tempdir().expect("a folder");
    let broken = Groom::new(strands(&[2, 0]));
    for format in [Format::Obj, Format::Hair, Format::Ply, Format::Tfx, Format::Npy] {
        let path = folder.path().join(format!("groom.{}", format.extension()));
        fs::write(&path, b"old").expect("a folder to write to");
        let error = save(&path, &broken).expect_err("a strand without points");
        assert!(error.to_string().starts_with(&format!("{}: strand ", path.display())), "{error}");
        assert!(!error.to_string().contains('\n'));
        assert_eq!(fs::read(&path).expect("still there"), b"old");
    }
    assert_eq!(names_in(folder.path()).len(), 5);
}

#[test]
fn the_error_names_the_strand_that_does_not_fit() {
    let folder = tempdir().expect("a folder");
    let long = Groom::new(strands(&[2, 65_537]));
    let error = save(&folder.path().join("long.hair"), &long).expect_err("too long for 16 bits");
    assert!(error.to_string().contains("strand 1 has 65537 points"), "{error}");
    // All alike, the header says it with 32 bits; one shorter, the array says it with 16.
    for counts in [&[65_537, 65_537][..], &[65_536, 2]] {
        let groom = Groom::new(strands(counts));
        let path = folder.path().join("fits.hair");
        save(&path, &groom).expect("it fits");
        assert_eq!(read(&path).expect("whole"), Model::Polylines(groom));
    }
    let uneven = Groom::new(strands(&[8, 5]));
    let error = save(&folder.path().join("uneven.tfx"), &uneven).expect_err("uneven");
    assert!(error.to_string().contains("strand 1 has 5 points and strand 0 has 8"), "{error}");
    assert!(error.to_string().contains("--points 32"), "{error}");
}

#[test]
fn what_is_lost_is_told() {
    let folder = tempdir().expect("a folder");
    let mut groom = full_groom(Format::Data).in_space(Some(0.01), Some(UpAxis::Z));
    groom.insert_strand_attribute(names::GROUP, Column::Int(vec![1, 2, 3])).expect("three");
    groom.insert_strand_attribute(names::WIDTH, Column::scalar(vec![1.0; 3])).expect("three");
    groom.insert_point_attribute(names::WIDTH, Column::scalar(vec![2.0; 6])).expect("six");
    let colors = Column::Float { components: 3, values: vec![0.3; 18] };
    groom.insert_point_attribute(names::COLOR, colors).expect("six");
    let lost = save(&folder.path().join("groom.ply"), &groom).expect("it fits");
    let expected = [
        Loss::Unit(0.01),
        Loss::UpAxis(UpAxis::Z),
        Loss::PointAttribute("width".into()),
        Loss::StrandAttribute("group".into()),
        Loss::StrandAttribute("width".into()),
        Loss::ColorDepth,
    ];
    assert_eq!(lost, expected);
    let lost = save(&folder.path().join("groom.hair"), &groom).expect("it fits");
    assert_eq!(lost[2..], [expected[3].clone(), expected[4].clone()]);
    assert_eq!(save(&folder.path().join("groom.npz"), &groom).expect("it fits"), []);
}

#[test]
fn paths_that_are_no_files() {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("folder.obj");
    fs::create_dir(&path).expect("a folder to write to");
    let error = read(&path).expect_err("a folder").to_string();
    assert_eq!(error, format!("{}: is a directory, expected a file", path.display()));
    let error = save(&path, &full_groom(Format::Obj)).expect_err("a folder").to_string();
    assert_eq!(error, format!("{}: is a directory, expected a file", path.display()));
    let missing = folder.path().join("missing").join("groom.obj");
    let error = read(&missing).expect_err("missing").to_string();
    assert_eq!(error, format!("{}: no such file", missing.display()));
    let error = save(&missing, &full_groom(Format::Obj)).expect_err("missing").to_string();
    assert_eq!(error, format!("{}: no such folder", missing.display()));
    for name in ["groom.docx", "groom", "groom.", ".obj"] {
        let path = folder.path().join(name);
        fs::write(&path, b"").expect("a folder to write to");
        let error = read(&path).expect_err("unknown").to_string();
        assert!(error.contains("expected one of .obj .hair .data .bin"), "{error}");
        assert!(save(&path, &full_groom(Format::Obj)).is_err());
    }
}

#[test]
fn an_old_file_is_replaced_and_an_empty_one_is_refused() {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("groom.data");
    fs::write(&path, b"").expect("a folder to write to");
    let error = read(&path).expect_err("empty").to_string();
    assert!(error.contains("byte 0: the file is cut short"), "{error}");
    save(&path, &full_groom(Format::Data)).expect("the old file gives way");
    assert!(read(&path).is_ok());
    assert_eq!(names_in(folder.path()), ["groom.data"]);
}

#[cfg(unix)]
#[test]
fn permissions_are_those_of_any_new_file_and_links_stay_links() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempdir().expect("a folder");
    let mode = |name: &str| {
        let metadata = fs::metadata(folder.path().join(name)).expect("a file");
        metadata.permissions().mode() & 0o777
    };
    fs::write(folder.path().join("plain"), b"").expect("a folder to write to");
    let path = folder.path().join("groom.obj");
    save(&path, &full_groom(Format::Obj)).expect("it fits");
    assert_eq!(mode("groom.obj"), mode("plain"));
    fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).expect("my own file");
    symlink(&path, folder.path().join("link.obj")).expect("a link");
    save(&folder.path().join("link.obj"), &full_groom(Format::Npy)).expect("it fits");
    assert_eq!(mode("groom.obj"), 0o640);
    assert!(folder.path().join("link.obj").is_symlink());
    let Ok(Model::Polylines(groom)) = read(&path) else { panic!("polylines") };
    assert_eq!(groom.strands().len(), 2);
}

#[test]
fn points_that_are_not_finite_pass_through() {
    let points = vec![DVec3::NAN, DVec3::INFINITY, DVec3::NEG_INFINITY, DVec3::ZERO];
    let groom = Groom::new(Strands::from_counts([4], points).expect("four"));
    let folder = tempdir().expect("a folder");
    for format in FORMATS {
        let path = folder.path().join(format!("groom.{}", format.extension()));
        save(&path, &groom).expect("four points fit all");
        let Model::Polylines(read) = read(&path).expect("data") else { panic!("polylines") };
        assert!(read.strands().points()[0].is_nan(), "{format}");
        assert_eq!(read.strands().points()[1..], groom.strands().points()[1..], "{format}");
    }
}
