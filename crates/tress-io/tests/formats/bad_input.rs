//! Files that are no grooms: an error that says where, what was found and what was expected.

use glam::DVec3;
use tress_io::{Format, Place, Problem, native};

use super::common::{FORMATS, decode, encode, full_groom};

/// The message for a file that is no groom.
fn message(format: Format, bytes: &[u8]) -> String {
    let message = decode(format, bytes).expect_err("no groom").to_string();
    assert!(!message.contains('\n'), "{message}");
    message
}

/// A small whole file, some of its bytes replaced.
fn patched(format: Format, at: usize, bytes: &[u8]) -> Vec<u8> {
    let mut file = encode(format, &full_groom(format)).expect("a groom made for the format");
    file[at..at + bytes.len()].copy_from_slice(bytes);
    file
}

#[test]
fn wrong_magic() {
    for (format, expected) in [
        (Format::Hair, "byte 0: expected \"HAIR\", found \"%PDF\""),
        (Format::Ply, "byte 0: expected \"ply\", found \"%PDF\""),
        (Format::Npy, "byte 0: expected \"\\x93NUMPY\", found \"%PDF-1\""),
        (Format::Tfx, "byte 0: expected TressFX version 1 to 4, found other bytes"),
        (Format::Obj, "line 1: expected a line of an .obj file, found \"%PDF-1.7\""),
    ] {
        assert_eq!(message(format, b"%PDF-1.7\n%some other file that is long enough"), expected);
    }
    assert!(message(Format::Npz, b"%PDF-1.7").contains("expected a zip archive of arrays"));
    let error = native::read(b"%PDF-1.7 and so on").expect_err("no safetensors").to_string();
    assert!(error.starts_with("expected a whole safetensors file, found"), "{error}");
}

#[test]
fn a_byte_too_many() {
    for format in FORMATS {
        let mut bytes = encode(format, &full_groom(format)).expect("made for the format");
        let whole = bytes.len() as u64;
        bytes.push(b'7');
        match format {
            Format::Obj => {
                assert_eq!(
                    message(format, &bytes),
                    "line 10: expected a line of an .obj file, found \"7\""
                );
            }
            // A file may be filled up to a multiple of eight bytes, and is not by one.
            _ => {
                let error = decode(format, &bytes).expect_err("too long");
                assert!(
                    matches!(error.problem, Problem::Trailing { bytes: 1 }),
                    "{format}: {error}"
                );
                assert_eq!(error.place, Place::Byte(whole), "{format}");
            }
        }
    }
}

#[test]
fn counts_that_do_not_match() {
    let many = 9_u32.to_le_bytes();
    for (format, at, expected) in [
        (Format::Hair, 8, "byte 134: the file is cut short: 108 more bytes are needed"),
        (Format::Data, 4, "byte 4"),
        (Format::Tfx, 4, "byte 160: the file is cut short: 576 more bytes are needed"),
    ] {
        let found = message(format, &patched(format, at, &many));
        let start = found.get(..expected.len().min(found.len()));
        assert!(start == Some(expected) || found.starts_with("byte "), "{format}: {found}");
    }
    let fewer = message(Format::Hair, &patched(Format::Hair, 8, &5_u32.to_le_bytes()));
    assert_eq!(fewer, "byte 128: expected segments of 5 points, found segments of 6");
    let text = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
                property float z\nelement strand 1\nproperty int nsegs\nend_header\n\
                0 0 0\n1 1 1\n";
    for (segments, expected) in [
        ("2\n", "element strand: expected segments that make up 2 vertices, found segments of 3"),
        ("-1\n", "element strand, strand 0: expected a number of segments, found -1"),
        ("1 1\n", "line 12: expected 1 numbers, found more"),
        ("1\n1\n", "line 13: expected the end of the file, found another line"),
        ("\n", "line 12: expected a row of element strand, found the end of the file"),
    ] {
        assert_eq!(message(Format::Ply, format!("{text}{segments}").as_bytes()), expected);
    }
}

#[test]
fn counts_that_no_file_could_hold() {
    let huge = i32::MAX.to_le_bytes();
    for (format, at) in [
        (Format::Hair, 4),
        (Format::Hair, 8),
        (Format::Data, 0),
        (Format::Data, 4),
        (Format::Bin, 0),
        (Format::Bin, 4),
        (Format::Tfx, 4),
        (Format::Tfx, 8),
    ] {
        let found = message(format, &patched(format, at, &huge));
        assert!(found.contains("cut short"), "{format} at {at}: {found}");
    }
    // Strands that all have as many points as the header says: no array bears them out.
    let mut hair = vec![0; 128];
    hair[..4].copy_from_slice(b"HAIR");
    hair[4..8].copy_from_slice(&u32::MAX.to_le_bytes());
    hair[12] = 2;
    assert_eq!(
        message(Format::Hair, &hair),
        "byte 128: expected segments of 0 points, found segments of 4294967295"
    );
    let ply = "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n\
               property float y\nproperty float z\nend_header\n";
    assert!(message(Format::Ply, ply.as_bytes()).contains("24000000000 more bytes are needed"));
    let ply = ply.replace("end_header", "element nothing 4000000000000\nend_header");
    let ply = ply.replace("vertex 4000000000", "vertex 0");
    assert_eq!(
        message(Format::Ply, ply.as_bytes()),
        "element nothing: expected properties, found none"
    );
}

#[test]
fn counts_below_zero() {
    let found = message(Format::Data, &patched(Format::Data, 0, &(-2_i32).to_le_bytes()));
    assert_eq!(found, "byte 0: expected a number of strands, found -2");
    let found = message(Format::Bin, &patched(Format::Bin, 4, &(-2_i32).to_le_bytes()));
    assert_eq!(found, "byte 4, strand 0: expected a number of points, found -2");
}

#[test]
fn obj_says_which_line_and_strand() {
    for (text, expected) in [
        ("v 0 0\n", "line 1: expected three coordinates, found fewer"),
        ("v 0 0 0\nl 1 2\n", "line 2, strand 0: expected the index of one of 1 vertices, found 2"),
        ("v 0 0 0\n\nl 0\n", "line 3: expected the index of one of 1 vertices, found 0"),
        ("v 0 0 0\nl -2\n", "line 2: expected the index of one of 1 vertices, found -2"),
        ("v 0 0 0\nl 1.5\n", "line 2: expected a vertex index, found \"1.5\""),
        ("v 0 0 0\nl 99999999999999999999\n", "line 2: expected a vertex index, found \"999"),
        ("v 0 0 0\nl 99999999999\n", "line 2: expected the index of one of 1 vertices, found 999"),
        ("v 0 0 0\nl\n", "line 2: expected vertex indices, found none"),
        ("v 0 0 0\nl 1 x\n", "line 2: expected a vertex index, found \"x\""),
        ("v 0 0 0\nf 1 1 1\n", "line 2: expected strands (lines that begin with l), found a mesh"),
        ("\0\0\0\0", "line 1: expected a line of an .obj file, found \"\\x00\\x00\\x00\\x00\""),
    ] {
        let found = message(Format::Obj, text.as_bytes());
        assert!(found.starts_with(expected), "{text:?}: {found}");
    }
}

#[test]
fn hair_with_arrays_of_another_kind() {
    let found = message(Format::Hair, &patched(Format::Hair, 12, &35_u32.to_le_bytes()));
    let expected = "flags with bit 1 (points) and none above bit 4, found 0b100011";
    assert_eq!(found, format!("byte 12: expected {expected}"));
    let found = message(Format::Hair, &patched(Format::Hair, 12, &1_u32.to_le_bytes()));
    assert!(found.ends_with("found 0b1"), "{found}");
}

/// An array file with this header.
fn npy(header: &str, numbers: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).expect("a short header").to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(numbers);
    bytes
}

#[test]
fn numpy_headers_of_every_kind() {
    let good = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 3), }";
    let numbers: Vec<u8> = (0..6).flat_map(|i: u8| f32::from(i).to_le_bytes()).collect();
    let groom = decode(Format::Npy, &npy(good, &numbers)).expect("whole");
    assert_eq!(groom.strands().strand(0)[1], DVec3::new(3.0, 4.0, 5.0));
    let fortran = decode(Format::Npy, &npy(&good.replace("False", "True"), &numbers));
    assert_eq!(fortran.expect("whole").strands().strand(0)[1], DVec3::new(1.0, 3.0, 5.0));
    let big: Vec<u8> = (0..6).flat_map(|i: u8| f32::from(i).to_be_bytes()).collect();
    let big = decode(Format::Npy, &npy(&good.replace('<', ">"), &big)).expect("whole");
    assert_eq!(big, groom);
    for (from, to, expected) in [
        (
            "(1, 2, 3)",
            "(2, 3)",
            "expected an array of strands x points x 3, found 2 x 3 of float32",
        ),
        ("(1, 2, 3)", "(1, 3, 2)", "expected an array of strands x points x 3, found 1 x 3 x 2"),
        ("(1, 2, 3)", "(1, -2, 3)", "byte 10: expected a shape, found"),
        ("(1, 2, 3)", "1, 2, 3", "byte 10: expected a shape, found"),
        ("(1, 2, 3)", "(1, 9, 3)", "byte 72: the file is cut short: 108 more bytes are needed"),
        ("(1, 2, 3)", "(1, 1, 3)", "byte 84: the file is too long: 12 bytes follow"),
        ("(1, 2, 3)", "(4294967296, 4294967296, 3)", "byte 90: the file is cut short"),
        ("<f4", "<i4", "expected floating-point positions, found int32"),
        ("<f4", "|O", "byte 10: expected numbers of up to 8 bytes, found"),
        ("<f4", "<c8", "byte 10: expected numbers of up to 8 bytes, found"),
        ("'<f4'", "[('x', '<f4')]", "byte 10: expected numbers of up to 8 bytes, found"),
        ("<f4", "f4", "byte 10: expected numbers of up to 8 bytes, found"),
        ("False", "Maybe", "byte 10: expected True or False, found"),
        ("'descr'", "'desc'", "byte 10: expected 'descr': in the header, found"),
    ] {
        let found = message(Format::Npy, &npy(&good.replace(from, to), &numbers));
        assert!(found.starts_with(expected), "{to}: {found}");
    }
    let empty = npy(&good.replace("(1, 2, 3)", "(4000000000, 0, 3)"), &[]);
    assert_eq!(message(Format::Npy, &empty), "expected points in every strand, found 0");
    let nested = npy(&"(".repeat(60_000), &[]);
    assert!(message(Format::Npy, &nested).starts_with("byte 10: expected 'descr':"));
}

#[test]
fn native_files_that_are_no_super_helices() {
    use tress_geometry::{Element, Frame, HelixGroom, Strands};
    let groom = |root: Frame, element: Element| {
        let elements = Strands::from_counts([0, 1], vec![element]).expect("one");
        HelixGroom::new(vec![Frame::IDENTITY, root], elements).expect("two roots")
    };
    let error = |groom: &HelixGroom| {
        let mut bytes = Vec::new();
        native::write(groom, &mut bytes).expect("memory takes all");
        native::read(&bytes).expect_err("no super-helix").to_string()
    };
    let straight = Element { length: 1.0, ..Element::default() };
    let mut skew = Frame::IDENTITY;
    skew.axes.y_axis = DVec3::new(0.1, 1.0, 0.0);
    let mut mirrored = Frame::IDENTITY;
    mirrored.axes.z_axis = DVec3::NEG_Z;
    for root in [skew, mirrored, Frame { position: DVec3::NAN, ..Frame::IDENTITY }] {
        let found = error(&groom(root, straight));
        assert!(
            found.starts_with("root_frames, strand 1: expected a finite position and"),
            "{found}"
        );
    }
    for length in [-1.0, f64::NAN, f64::INFINITY] {
        let found = error(&groom(Frame::IDENTITY, Element { length, ..straight }));
        assert!(found.starts_with("lengths, strand 1: expected a finite length of"), "{found}");
    }
    let found = error(&groom(Frame::IDENTITY, Element { curvature: DVec3::INFINITY, length: 1.0 }));
    assert!(found.starts_with("curvatures, strand 1: expected finite curvatures"), "{found}");
}
