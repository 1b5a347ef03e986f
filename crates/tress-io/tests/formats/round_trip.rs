//! Every format gives back what it was given, bit for bit as far as it holds the bits.

use glam::DVec3;
use proptest::prelude::*;
use tress_geometry::{
    Attributes, Column, Element, Frame, Groom, HelixGroom, Kept, Strands, UpAxis, names,
};
use tress_io::{Format, losses, native};

use super::common::{FORMATS, decode, encode, full_groom};
use super::grooms::{bare, column, counts, equal_counts, number, short_number};

/// Equal bit for bit, any not-a-number being like another: `Debug` prints floats exactly.
fn same(a: &impl std::fmt::Debug, b: &impl std::fmt::Debug) -> Result<(), TestCaseError> {
    prop_assert_eq!(format!("{a:?}"), format!("{b:?}"));
    Ok(())
}

fn returns(format: Format, groom: &Groom) -> Result<(), TestCaseError> {
    let bytes = encode(format, groom).expect("a groom that the format can hold");
    let read = decode(format, &bytes).expect("what was just written");
    prop_assert_eq!(losses(groom, format), []);
    same(&read, groom)
}

fn with_point_columns(
    groom: impl Strategy<Value = Groom>,
    columns: &'static [(&'static str, usize)],
    number: fn() -> BoxedStrategy<f64>,
) -> impl Strategy<Value = Groom> {
    groom.prop_flat_map(move |groom| {
        let n = groom.strands().points().len();
        let columns: Vec<_> = columns
            .iter()
            .map(|&(name, components)| (Just(name), column(n, components, number())))
            .collect();
        // An empty column is as good as none where the file has no place for the difference.
        (Just(groom), columns).prop_map(|(mut groom, columns)| {
            for (name, column) in columns {
                groom.insert_point_attribute(name, column).expect("a row a point");
            }
            groom
        })
    })
}

fn short() -> BoxedStrategy<f64> {
    short_number().boxed()
}

/// A number whose difference from 1 is a 32-bit number, exactly.
fn opacity() -> BoxedStrategy<f64> {
    (0..=1024).prop_map(|i| f64::from(i) / 1024.0).boxed()
}

fn eight_bits() -> BoxedStrategy<f64> {
    any::<u8>().prop_map(|i| f64::from(i) / 255.0).boxed()
}

proptest! {
    #[test]
    fn obj(groom in bare(counts(1), || number().boxed())) {
        returns(Format::Obj, &groom)?;
    }

    #[test]
    fn data(groom in bare(counts(0), short)) {
        returns(Format::Data, &groom)?;
    }

    #[test]
    fn bin(groom in bare(counts(0), short)) {
        returns(Format::Bin, &groom)?;
    }

    #[test]
    fn bin_with_normals(
        groom in with_point_columns(bare(counts(1), short), &[("normal", 3), ("label", 1)], short)
    ) {
        let bytes = encode(Format::Bin, &groom).expect("counts are small");
        let read = decode(Format::Bin, &bytes).expect("what was just written");
        for (name, written) in groom.point_attributes().iter() {
            match read.point_attributes().get(name) {
                Some(read) => same(read, written)?,
                None => prop_assert!(written.first_components().all(|value| value == 0.0)),
            }
        }
    }

    #[test]
    fn hair(groom in bare(counts(1), short)) {
        returns(Format::Hair, &groom)?;
    }

    #[test]
    fn hair_with_arrays(
        groom in with_point_columns(bare(counts(1), short), &[("width", 1), ("color", 3)], short)
    ) {
        returns(Format::Hair, &groom)?;
    }

    #[test]
    fn hair_with_opacity(
        groom in with_point_columns(bare(counts(1), short), &[("opacity", 1)], opacity)
    ) {
        returns(Format::Hair, &groom)?;
    }

    #[test]
    fn ply(groom in bare(counts(1), short)) {
        returns(Format::Ply, &groom)?;
    }

    #[test]
    fn ply_with_colors(
        groom in with_point_columns(
            bare(counts(1), short), &[("color", 3), ("opacity", 1)], eight_bits
        )
    ) {
        returns(Format::Ply, &groom)?;
    }

    #[test]
    fn tfx(
        groom in bare(equal_counts(prop::sample::select(vec![4_usize, 8, 16])), short)
    ) {
        returns(Format::Tfx, &groom)?;
    }

    #[test]
    fn npy(groom in bare(equal_counts(1..9_usize), || number().boxed())) {
        returns(Format::Npy, &groom)?;
    }

    #[test]
    fn npz(
        groom in with_point_columns(
            bare(counts(0), || number().boxed()),
            &[("width", 1), ("a/b c", 2)],
            || number().boxed(),
        ),
        ids in prop::collection::vec(any::<i64>(), 6),
        unit in prop::option::of(number()),
        up in prop::option::of(prop::sample::select(vec![UpAxis::Y, UpAxis::Z])),
    ) {
        let mut groom = groom.in_space(unit, up);
        let ids = Column::Int(ids[..groom.strands().len()].to_vec());
        groom.insert_strand_attribute(names::GROUP, ids).expect("a row a strand");
        returns(Format::Npz, &groom)?;
    }

    #[test]
    fn tress(groom in helices()) {
        let mut bytes = Vec::new();
        native::write(&groom, &mut bytes).expect("memory takes all");
        let mut again = Vec::new();
        native::write(&groom, &mut again).expect("memory takes all");
        prop_assert_eq!(&bytes, &again);
        same(&native::read(&bytes).expect("what was just written"), &groom)?;
    }
}

/// Super-helices of up to four strands, of which one may be kept as a polyline of anything.
fn helices() -> impl Strategy<Value = HelixGroom> {
    let element = (prop::array::uniform3(-1e3..1e3), 0.0..1e3)
        .prop_map(|(q, length)| Element { curvature: DVec3::from_array(q), length });
    let direction = prop::array::uniform3(-1.0..1.0_f64);
    let strand = (prop::collection::vec(element, 0..5), direction);
    let strands = prop::collection::vec(strand, 0..5);
    let kept = prop::option::of(prop::collection::vec(prop::array::uniform3(number()), 0..3));
    let unit = prop::option::of(1e-6..1e3);
    (strands, kept, unit, any::<i64>()).prop_map(|(strands, kept, unit, id)| {
        let root = |t: &[f64; 3]| {
            let t = DVec3::from_array(*t);
            Frame::along(t * 7.0, t).unwrap_or(Frame::IDENTITY)
        };
        let mut roots: Vec<Frame> = strands.iter().map(|(_, t)| root(t)).collect();
        let mut elements = Strands::default();
        for (strand, _) in &strands {
            elements.push(strand.iter().copied()).expect("few elements");
        }
        let mut polylines = Kept::default();
        if let Some(points) = kept {
            polylines.strands = vec![u32::try_from(elements.len()).expect("few strands")];
            let n = points.len();
            let points: Vec<_> = points.into_iter().map(DVec3::from_array).collect();
            polylines.point_attributes = Attributes::new(n);
            let ids = Column::Int(vec![id; n]);
            polylines.point_attributes.insert("id", ids).expect("a row a point");
            polylines.polylines.push(points).expect("few points");
            elements.push([]).expect("few elements");
            roots.push(Frame { position: DVec3::NAN, ..Frame::IDENTITY });
        }
        let (n, joints) = (elements.len(), elements.len() + elements.points().len());
        let mut per_strand = Attributes::new(n);
        per_strand.insert(names::GROUP, Column::Int(vec![id; n])).expect("a row a strand");
        let mut per_joint = Attributes::new(joints);
        let uv = Column::Float { components: 2, values: vec![0.1; 2 * joints] };
        per_joint.insert("uv", uv).expect("a row a joint");
        HelixGroom::with_attributes(roots, elements, per_strand, per_joint, polylines)
            .expect("rows that match")
            .in_space(unit, Some(UpAxis::Z))
    })
}

#[test]
fn what_a_format_says_it_carries_comes_back() {
    for format in FORMATS {
        let groom = full_groom(format);
        let bytes = encode(format, &groom).expect("a groom made for the format");
        let read = decode(format, &bytes).expect("what was just written");
        for (mine, read) in [
            (groom.point_attributes(), read.point_attributes()),
            (groom.strand_attributes(), read.strand_attributes()),
        ] {
            assert_eq!(mine.iter().count(), read.iter().count(), "{format}");
            for ((name, mine), (_, read)) in mine.iter().zip(read.iter()) {
                let (mine, read) = (mine.first_components(), read.first_components());
                let far = mine.zip(read).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(far < 1e-7, "{format}: {name} is {far} off");
            }
        }
        assert_eq!(losses(&groom, format), [], "{format}");
    }
}

#[test]
fn columns_of_strands_reach_every_point_where_only_points_have_a_place() {
    let mut groom = full_groom(Format::Data);
    let widths = Column::scalar(vec![0.5, 0.25, 0.125]);
    groom.insert_strand_attribute(names::WIDTH, widths).expect("three strands");
    let read = decode(Format::Hair, &encode(Format::Hair, &groom).expect("small")).expect("whole");
    let spread = Column::scalar(vec![0.5, 0.5, 0.5, 0.25, 0.125, 0.125]);
    assert_eq!(read.point_attributes().get(names::WIDTH), Some(&spread));
    assert_eq!(losses(&groom, Format::Hair), []);
}

#[test]
fn a_width_that_all_strands_share_goes_to_the_header_of_a_hair_file() {
    let mut groom = full_groom(Format::Data);
    groom.insert_strand_attribute(names::WIDTH, Column::scalar(vec![0.5; 3])).expect("three");
    groom.insert_strand_attribute(names::OPACITY, Column::scalar(vec![0.25; 3])).expect("three");
    let bytes = encode(Format::Hair, &groom).expect("small");
    assert_eq!(bytes.len(), 128 + 3 * 2 + 6 * 12);
    assert_eq!(decode(Format::Hair, &bytes).expect("whole"), groom);
}
