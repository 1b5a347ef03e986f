//! Files cut at every byte and with bytes overwritten: an error or a groom, never a panic, and
//! never more memory than the size of the file accounts for.

mod common;

use peak_alloc::PeakAlloc;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tress_geometry::{Element, Frame, Groom, HelixGroom, Strands};
use tress_io::{Format, ParseError, native};

use common::{FORMATS, decode, encode, full_groom};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// What the tests of this file may hold at once, together: each file is some hundred bytes long,
/// and a count that is believed without a check asks for a thousand times this.
const MEMORY_LIMIT: usize = 64 << 20;
/// Files with bytes overwritten, for each format.
const CASES: usize = 4_000;

/// A reader that keeps nothing of what it read.
type Read = Box<dyn Fn(&[u8]) -> Result<(), ParseError>>;

/// A reader and a small whole file for it.
struct Case {
    name: String,
    file: Vec<u8>,
    read: Read,
}

impl Case {
    fn new(name: &str, file: impl Into<Vec<u8>>, format: Format) -> Self {
        let read = move |bytes: &[u8]| decode(format, bytes).map(|groom| check(&groom));
        Self { name: name.into(), file: file.into(), read: Box::new(read) }
    }

    /// Reads bytes; whether they are a groom.
    fn survives(&self, bytes: &[u8]) -> bool {
        let result = (self.read)(bytes);
        let (name, peak) = (&self.name, MEMORY.peak_usage());
        assert!(peak < MEMORY_LIMIT, "{name}: {peak} bytes for a file of {}", bytes.len());
        if let Err(error) = &result {
            let message = error.to_string();
            assert!(!message.is_empty() && !message.contains('\n'), "{name}: {message:?}");
            assert!(message.len() < 400, "{name}: {message}");
        }
        result.is_ok()
    }
}

fn cases() -> Vec<Case> {
    let read_helices = |bytes: &[u8]| native::read(bytes).map(|groom| check_helices(&groom));
    let tress = Case { name: "tress".into(), file: helices(), read: Box::new(read_helices) };
    let tfx = "version 2.0\nnumStrands 2\nis sorted 1\nstrand 0 numVerts 2 texcoord 0 0.5\n\
               0 0 0\n1 2 3\nstrand 1 numVerts 1 texcoord 0 0\n3, 4, 5\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
               property float z\nproperty list uchar int l\nelement edge 2\nproperty int vertex1\n\
               property int vertex2\nend_header\n0 0 0 1 9\n1 1 1 0\n2 2 2 0\n0 1\n1 2\n";
    let segments = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nl 1 2\nl 3 2\nl -1 3\np 4\n";
    let mut cases = vec![
        tress,
        Case::new("tfx text", tfx, Format::Tfx),
        Case::new("ply text", ply, Format::Ply),
        Case::new("obj segments text", segments, Format::Obj),
    ];
    cases.extend(FORMATS.map(|format| {
        let file = encode(format, &full_groom(format)).expect("a groom made for the format");
        Case::new(format.extension(), file, format)
    }));
    cases
}

/// A groom that was read holds together.
fn check(groom: &Groom) {
    let n: usize = groom.strands().counts().sum();
    assert_eq!(n, groom.strands().points().len());
}

fn check_helices(groom: &HelixGroom) {
    for (i, strand) in groom.iter().enumerate() {
        assert!(strand.length().is_finite() || groom.kept_polyline(i).is_some());
    }
}

fn helices() -> Vec<u8> {
    let coil = Element { length: 1.0, ..Element::coil(0.5, 1.0) };
    let elements = Strands::from_counts([2, 1], vec![coil; 3]).expect("three");
    let groom = HelixGroom::new(vec![Frame::IDENTITY; 2], elements).expect("two roots");
    let mut bytes = Vec::new();
    native::write(&groom, &mut bytes).expect("memory takes all");
    bytes
}

#[test]
fn files_cut_at_every_byte() {
    for case in cases() {
        let (name, file) = (&case.name, &case.file);
        assert!(case.survives(file), "{name}: the whole file");
        let whole = (0..file.len()).filter(|&end| case.survives(&file[..end])).count();
        // Text may lack its last line's end, or lose a digit or a strand and be text all the same.
        let is_text = name.contains("obj") || name.contains("text");
        assert!(is_text || whole == 0, "{name}: {whole} cuts passed for whole files");
    }
}

#[test]
fn files_with_bytes_overwritten() {
    for case in cases() {
        let mut random = Pcg64Mcg::seed_from_u64(0x7e55);
        for _ in 0..CASES {
            let mut broken = case.file.clone();
            for _ in 0..random.random_range(1..4) {
                let at = random.random_range(0..broken.len());
                // Bytes of large counts, of small ones, of digits, and any.
                broken[at] = match random.random_range(0..4) {
                    0 => 0xff,
                    1 => random.random_range(0..3),
                    2 => random.random_range(b'0'..=b'9'),
                    _ => random.random(),
                };
            }
            case.survives(&broken);
        }
    }
}

#[test]
fn counts_overwritten_whole() {
    for case in cases() {
        for at in 0..case.file.len() - 4 {
            for value in [u32::MAX, 0x7fff_ffff, 1 << 28, 0] {
                let mut broken = case.file.clone();
                broken[at..at + 4].copy_from_slice(&value.to_le_bytes());
                case.survives(&broken);
            }
        }
    }
}
