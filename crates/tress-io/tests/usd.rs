//! USD files read and written: what the parts of a stage become, and what broken ones do.

mod any_groom;
mod breakages;

use std::path::PathBuf;

use glam::DVec3;
use proptest::prelude::*;
use tress_geometry::{Column, Groom, Strands, UpAxis, names};
use tress_io::{Animation, Frames, UsdCurves, WriteError, WriteOptions, usd, write_animation};

use any_groom::{any_groom, without_given_width};

/// A stage in a folder of its own.
fn stage(name: &str, text: &str) -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join(name);
    std::fs::write(&path, text).expect("a file");
    (dir, path)
}

fn read(text: &str) -> Result<Groom, String> {
    let (_dir, path) = stage("hair.usda", &format!("#usda 1.0\n{text}"));
    usd::read(&path).map_err(|error| error.to_string())
}

/// One prim with these lines in it.
fn read_curves(lines: &str) -> Result<Groom, String> {
    read(&format!("def BasisCurves \"hair\"\n{{\n{lines}\n}}"))
}

fn written(groom: &Groom, curves: UsdCurves) -> String {
    let mut text = Vec::new();
    usd::write(groom, &WriteOptions { usd_curves: curves }, &mut text).expect("memory takes all");
    String::from_utf8(text).expect("text")
}

const FOUR: &str = "int[] curveVertexCounts = [4]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 1, 0), (3, 1, 0)]";

#[test]
fn types_bases_and_wraps() {
    let x = |lines: &str| -> Vec<f64> {
        let groom = read_curves(&format!("{FOUR}\n{lines}")).expect(lines);
        groom.strands().points().iter().map(|point| point.x).collect()
    };
    let linear = "uniform token type = \"linear\"";
    let catmull_rom = "uniform token basis = \"catmullRom\"";
    let b_spline = "uniform token basis = \"bspline\"";
    let pinned = "uniform token wrap = \"pinned\"";
    let periodic = "uniform token wrap = \"periodic\"";
    assert_eq!(x(linear), [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(x(&format!("{linear}\n{periodic}")), [0.0, 1.0, 2.0, 3.0, 0.0]);
    assert_eq!(x(catmull_rom), [1.0, 2.0]);
    assert_eq!(x(&format!("{catmull_rom}\n{pinned}")), [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(x(b_spline), [1.0, 1.25, 1.5, 1.75, 2.0]);
    let ends = x(&format!("{b_spline}\n{pinned}"));
    assert_eq!((ends.len(), ends[0], ends[12]), (13, 0.0, 3.0));
    // Cubic Bezier is what the schema falls back to.
    let bezier = x("");
    assert_eq!((bezier.len(), bezier[0], bezier[6], bezier[12]), (13, 0.0, 1.5, 3.0));
}

#[test]
fn every_kind_of_attribute_finds_its_column() {
    let groom = read_curves(
        "uniform token type = \"linear\"
        int[] curveVertexCounts = [2, 1]
        point3d[] points = [(0.1, 0, 0), (1, 0, 0), (2, 0, 0)]
        float[] widths = [0.5, 0.25] (
            interpolation = \"uniform\"
        )
        color3f[] primvars:displayColor = [(1, 0.5, 0)]
        float[] primvars:displayOpacity = [1, 0.5, 0] (
            interpolation = \"vertex\"
        )
        texCoord2f[] primvars:st = [(0, 1), (0.5, 0.25)] (
            interpolation = \"uniform\"
        )
        int[] primvars:strand_id = [7, -8] (
            interpolation = \"uniform\"
        )
        bool primvars:wet = true
        half[] primvars:curl = [2, 4] (
            interpolation = \"uniform\"
        )
        int[] primvars:curl:indices = [1, 0]
        float[] primvars:wide = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10] (
            elementSize = 5
            interpolation = \"uniform\"
        )
        string primvars:said = \"nothing\"",
    )
    .expect("a stage");
    assert_eq!(groom.strands().points()[0], DVec3::new(0.1, 0.0, 0.0), "doubles keep their bits");
    let strands = |name: &str| groom.strand_attributes().get(name).cloned();
    assert_eq!(strands(names::WIDTH), Some(Column::scalar(vec![0.5, 0.25])));
    let color = vec![1.0, 0.5, 0.0, 1.0, 0.5, 0.0];
    assert_eq!(strands(names::COLOR), Some(Column::Float { components: 3, values: color }));
    let uv = Column::Float { components: 2, values: vec![0.0, 1.0, 0.5, 0.25] };
    assert_eq!(strands(names::ROOT_UV), Some(uv));
    assert_eq!(strands("strand_id"), Some(Column::Int(vec![7, -8])));
    assert_eq!(strands("wet"), Some(Column::Int(vec![1, 1])));
    assert_eq!(strands("curl"), Some(Column::scalar(vec![4.0, 2.0])));
    assert_eq!(strands("wide").map(|column| (column.components(), column.rows())), Some((5, 2)));
    let opacity = groom.point_attributes().get(names::OPACITY);
    assert_eq!(opacity, Some(&Column::scalar(vec![1.0, 0.5, 0.0])));
    assert_eq!(
        (groom.strand_attributes().iter().len(), groom.point_attributes().iter().len()),
        (7, 1)
    );
}

#[test]
fn transforms_of_all_ancestors_apply_in_their_order() {
    let groom = read(
        "def Xform \"head\"
        {
            double3 xformOp:translate = (10, 0, 0)
            float xformOp:rotateZ = 90
            float3 xformOp:scale:bigger = (2, 2, 2)
            uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateZ\", \"xformOp:scale:bigger\"]
            def Scope \"not_a_place\"
            {
                double3 xformOp:translate = (1000, 0, 0)
                uniform token[] xformOpOrder = [\"xformOp:translate\"]
                def BasisCurves \"moved\"
                {
                    uniform token type = \"linear\"
                    int[] curveVertexCounts = [1]
                    point3f[] points = [(1, 0, 0)]
                    matrix4d xformOp:transform =
                        ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 3, 1))
                    uniform token[] xformOpOrder = [\"xformOp:transform\"]
                }
                def BasisCurves \"alone\"
                {
                    uniform token type = \"linear\"
                    int[] curveVertexCounts = [1]
                    point3f[] points = [(1, 0, 0)]
                    double3 xformOp:translate:pivot = (0, 1, 0)
                    quatf xformOp:orient = (0, 0, 0, 1)
                    uniform token[] xformOpOrder = [\"!resetXformStack!\", \"xformOp:translate:pivot\", \"xformOp:orient\", \"!invert!xformOp:translate:pivot\"]
                }
            }
        }",
    )
    .expect("a stage");
    let expected = [DVec3::new(10.0, 2.0, 6.0), DVec3::new(-1.0, 2.0, 0.0)];
    for (point, expected) in groom.strands().points().iter().zip(expected) {
        assert!(point.distance(expected) < 1e-14, "{point} {expected}");
    }
    assert_eq!(groom.strand_attributes().get(names::GROUP), Some(&Column::Int(vec![0, 1])));
}

#[test]
fn euler_angles_turn_in_the_order_of_their_letters() {
    let turned = |op: &str, angles: &str| {
        let lines = format!(
            "{FOUR}\nuniform token type = \"linear\"
            float3 xformOp:{op} = {angles}
            uniform token[] xformOpOrder = [\"xformOp:{op}\"]"
        );
        read_curves(&lines).expect("a stage").strands().points()[1]
    };
    // X stays where it is when it is turned about itself first, then goes to Y.
    assert!(turned("rotateXYZ", "(90, 0, 90)").distance(DVec3::Y) < 1e-15);
    // Turned about Z first it becomes Y, which the turn about X takes to Z.
    assert!(turned("rotateZYX", "(90, 0, 90)").distance(DVec3::Z) < 1e-15);
}

#[test]
fn the_first_sample_stands_for_animation() {
    let groom = read_curves(
        "uniform token type = \"linear\"
        int[] curveVertexCounts = [1]
        point3f[] points.timeSamples = {
            3: [(3, 0, 0)],
            24: [(9, 0, 0)],
        }
        double3 xformOp:translate.timeSamples = {
            3: (0, 1, 0),
            4: (0, 2, 0),
        }
        uniform token[] xformOpOrder = [\"xformOp:translate\"]",
    );
    assert_eq!(groom.expect("a stage").strands().points(), [DVec3::new(3.0, 1.0, 0.0)]);
}

#[test]
fn references_are_followed_and_what_is_inactive_is_not() {
    let (dir, path) = stage(
        "scene.usda",
        "#usda 1.0
        def Xform \"a\" (
            prepend references = @./hair.usda@
        )
        {
            double3 xformOp:translate = (0, 0, 5)
            uniform token[] xformOpOrder = [\"xformOp:translate\"]
        }
        def \"off\" (
            active = false
            prepend references = @./hair.usda@
        )
        {
        }
        over \"ghost\" (
            prepend references = @./missing.usda@
        )
        {
        }",
    );
    let hair = Groom::new(Strands::from_counts([1], vec![DVec3::X]).expect("one point"));
    std::fs::write(dir.path().join("hair.usda"), written(&hair, UsdCurves::Linear))
        .expect("a file");
    let groom = usd::read(&path).expect("a stage");
    assert_eq!(groom.strands().points(), [DVec3::new(1.0, 0.0, 5.0)]);
}

#[test]
fn unit_and_axis_are_read_where_they_are_and_unknown_elsewhere() {
    let space = |header: &str| {
        let groom = read(&format!("(\n{header}\n)\n")).expect("a stage without prims");
        (groom.unit, groom.up)
    };
    assert_eq!(space("metersPerUnit = 0.0254\nupAxis = \"Y\""), (Some(0.0254), Some(UpAxis::Y)));
    assert_eq!(space("metersPerUnit = 1\nupAxis = \"Z\""), (Some(1.0), Some(UpAxis::Z)));
    assert_eq!(space("metersPerUnit = 0"), (None, None));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn what_is_written_is_read_back(groom in any_groom(), is_cubic: bool) {
        let kind = if is_cubic { UsdCurves::CatmullRom } else { UsdCurves::Linear };
        let (_dir, path) = stage("hair.usda", &written(&groom, kind));
        let read = usd::read(&path).expect("our text");
        prop_assert_eq!(&without_given_width(read, &groom), &groom);
        let (_dir, path) = stage("hair.usdc", "");
        tress_io::write(&path, &groom, &WriteOptions { usd_curves: kind }).expect("a file");
        let read = usd::read(&path).expect("our binary");
        prop_assert_eq!(&without_given_width(read, &groom), &groom);
    }
}

#[test]
fn names_that_usd_cannot_spell_are_bent_and_stay_apart() {
    let strands = Strands::from_counts([1], vec![DVec3::ZERO]).expect("one point");
    let mut groom = Groom::new(strands);
    for (i, name) in ["a b", "a-b", "2nd", "\u{e9}", ""].into_iter().enumerate() {
        groom.insert_strand_attribute(name, Column::scalar(vec![i as f64])).expect("one row");
    }
    groom.insert_strand_attribute("both", Column::Int(vec![1])).expect("one row");
    groom.insert_point_attribute("both", Column::Int(vec![2])).expect("one row");
    let (_dir, path) = stage("hair.usda", &written(&groom, UsdCurves::Linear));
    let read = usd::read(&path).expect("our own file");
    let names: Vec<_> = read.strand_attributes().iter().map(|(name, _)| name.to_owned()).collect();
    assert_eq!(names, ["_", "_2nd", "__2", "a_b", "a_b_2", "both_strand", "width"]);
    assert_eq!(read.point_attributes().get("both"), Some(&Column::Int(vec![2])));
}

#[test]
fn hair_without_a_width_gets_a_tenth_of_a_millimetre() {
    let strands = Strands::from_counts([2], vec![DVec3::ZERO, DVec3::X * 40.0]).expect("two");
    let unknown = written(&Groom::new(strands.clone()), UsdCurves::Linear);
    assert!(unknown.contains("widths = [0.01]"), "{unknown}");
    let centimetres = Groom::new(strands).in_space(Some(0.01), None);
    let text = written(&centimetres, UsdCurves::Linear);
    assert!(text.contains("widths = [0.01]"), "{text}");
    assert!(text.contains("extent = [(-0.005, -0.005, -0.005), (40.005, 0.005, 0.005)]"), "{text}");
}

#[test]
fn nan_is_written_and_read() {
    let strands = Strands::from_counts([2], vec![DVec3::NAN, DVec3::X]).expect("two");
    let (_dir, path) = stage("hair.usda", &written(&Groom::new(strands), UsdCurves::Linear));
    let points = usd::read(&path).expect("our own file");
    assert!(points.strands().points()[0].is_nan());
}

#[test]
fn what_does_not_match_is_said_with_its_place() {
    let error = |lines: &str| read_curves(lines).expect_err(lines);
    for (lines, expected) in [
        (
            "int[] curveVertexCounts = [5]\npoint3f[] points = [(0, 0, 0)]",
            "/hair.points: expected 5 points, as the counts sum to, found 1",
        ),
        (
            "int[] curveVertexCounts = [-1]\npoint3f[] points = []",
            "/hair.curveVertexCounts: expected numbers of points, found a negative number",
        ),
        (
            "point3f[] points = [(0, 0, 0)]",
            "/hair.curveVertexCounts: expected an array of int, found nothing",
        ),
        (
            "int[] curveVertexCounts = [2147483647, 2147483647]\npoint3f[] points = []",
            "/hair.points: expected 4294967294 points, as the counts sum to, found 0",
        ),
        (
            "int[] curveVertexCounts = [1]\nfloat[] points = [1]",
            "/hair.points: expected an array of 3D points, found other numbers",
        ),
        (
            "int[] curveVertexCounts = [1]\npoint3f[] points = [(0, 0, 0)]\nfloat[] widths = [1, 2, 3]",
            "/hair.widths: 3 rows, where there are 1 curves, 1 knots and 1 control points",
        ),
        (
            "int[] curveVertexCounts = [1]\npoint3f[] points = [(0, 0, 0)]
            float[] primvars:x = [1]\nint[] primvars:x:indices = [1]",
            "/hair.primvars:x:indices: expected indices below 1, found one outside",
        ),
        (
            "int[] curveVertexCounts = []\npoint3f[] points = []\nuniform token type = \"wavy\"",
            "/hair.type: expected linear or cubic, found \"wavy\"",
        ),
        (
            "int[] curveVertexCounts = []\npoint3f[] points = []\nuniform token basis = \"sine\"",
            "/hair.basis: expected bezier, bspline or catmullRom, found \"sine\"",
        ),
        (
            "int[] curveVertexCounts = []\npoint3f[] points = []
            float xformOp:translate = 1\nuniform token[] xformOpOrder = [\"xformOp:translate\"]",
            "/hair.xformOp:translate: expected a translate, rotate, scale, orient or transform",
        ),
    ] {
        let message = error(lines);
        assert!(message.starts_with(expected), "{message}");
        assert!(!message.contains('\n'));
    }
    assert!(read_curves("").expect("an empty prim").strands().is_empty());
}

#[test]
fn files_that_are_not_what_they_are_called_say_so() {
    let message = |name: &str, text: &str| {
        let (_dir, path) = stage(name, text);
        usd::read(&path).expect_err(name).to_string()
    };
    assert!(message("a.usda", "PXR-USDC").contains("name it .usdc"));
    assert!(message("a.usdc", "#usda 1.0\n").contains("name it .usda"));
    assert!(message("a.usd", "PK\u{3}\u{4}").contains("unpack it"));
    assert!(message("a.usd", "").contains("which begins with #usda or PXR-USDC"));
    assert!(message("a.usdc", "PXR-USDC").contains("cut short"));
    let deep = format!("#usda 1.0\n{}", "def \"a\" {\n".repeat(100_000));
    assert!(message("a.usda", &deep).contains("deep in each other"));
    let crlf = "#usda 1.0\r\n(\r\n    upAxis = \"Z\"\r\n)\r\n";
    let (_dir, path) = stage("a.usda", crlf);
    assert_eq!(usd::read(&path).expect("CRLF").up, Some(UpAxis::Z));
}

/// Text and binary of one groom, the binary by openusd.
fn samples() -> [(&'static str, Vec<u8>); 2] {
    let points = (0..40).map(|i| DVec3::new(f64::from(i), f64::from(i % 5) * 0.25, 0.5)).collect();
    let strands = Strands::from_counts([10, 25, 5], points).expect("40 points");
    let mut groom = Groom::new(strands).in_space(Some(1.0), Some(UpAxis::Y));
    let widths = (0..40).map(|i| f64::from(i % 7)).collect();
    groom.insert_point_attribute("width", Column::scalar(widths)).expect("40 rows");
    groom.insert_strand_attribute("id", Column::Int(vec![1, 2, 3])).expect("3 rows");
    let text = written(&groom, UsdCurves::CatmullRom);
    // Time samples and dictionaries hold values within values.
    let text = text.replace(
        "def Xform \"groom\"\n{",
        "def Xform \"groom\" (
            customData = {
                dictionary maker = {
                    int[] versions = [1, 2, 3]
                }
            }
        )
        {
            double3 xformOp:translate.timeSamples = {
                1: (0, 0, 0),
                2: (0, 0, 1),
            }
            uniform token[] xformOpOrder = [\"xformOp:translate\"]",
    );
    let data = openusd::usda::parse(&text).expect("our own text");
    let (_dir, path) = stage("hair.usdc", "");
    openusd::usdc::CrateWriter::write_to_file(&data, &path).expect("a file");
    assert_eq!(usd::read(&path).expect("openusd's own file").strands(), groom.strands());
    [("hair.usda", text.into_bytes()), ("hair.usdc", std::fs::read(&path).expect("the file"))]
}

#[test]
fn broken_files_are_errors_or_other_grooms_but_never_a_panic() {
    for (name, bytes) in samples() {
        let (_dir, path) = stage(name, "");
        breakages::breakages(&bytes, 400, |broken| {
            std::fs::write(&path, broken).expect("a file");
            if let Err(error) = usd::read(&path) {
                let message = error.to_string();
                assert!(!message.is_empty() && !message.contains('\n'), "{message}");
            }
        });
    }
}

#[test]
fn curves_of_text_and_of_binary_are_equal() {
    let [(_, text), (_, binary)] = samples();
    let (dir, path) = stage("hair.usd", "");
    std::fs::write(&path, text).expect("a file");
    let from_text = usd::read(&path).expect("text by its contents");
    std::fs::write(&path, binary).expect("a file");
    assert_eq!(usd::read(&path).expect("binary by its contents"), from_text);
    drop(dir);
}

#[test]
fn frames_of_a_binary_file_are_read_one_by_one() {
    let frame = |i: usize| {
        let points = (0..6).map(|k| DVec3::new(f64::from(k), i as f64, 0.5)).collect();
        // The fourth frame has other strands.
        let counts = if i == 3 { vec![2, 4] } else { vec![3, 3] };
        let mut groom = Groom::new(Strands::from_counts(counts, points).expect("six points"));
        groom.insert_strand_attribute("id", Column::Int(vec![7, 8])).expect("two rows");
        groom.insert_strand_attribute("width", Column::scalar(vec![0.5; 2])).expect("two rows");
        groom.in_space(Some(0.01), Some(UpAxis::Z))
    };
    let (_dir, path) = stage("wind.usdc", "");
    let frames = Frames { start: 101.0, rate: 25.0 };
    let grooms = (0..5).map(|i| Ok::<_, WriteError>(frame(i)));
    write_animation(&path, frames, &WriteOptions::default(), grooms).expect("a file");
    let animation = Animation::open(&path).expect("our own file");
    assert_eq!((animation.len(), animation.frames()), (5, frames));
    for i in 0..5 {
        assert_eq!(animation.read(i).expect("a frame"), frame(i), "frame {i}");
    }
    assert_eq!(usd::read(&path).expect("the first frame"), frame(0));
}

#[test]
fn a_text_that_is_animated_has_frames() {
    let text = "#usda 1.0\n(timeCodesPerSecond = 30)\ndef BasisCurves \"hair\" {
        int[] curveVertexCounts = [1]
        uniform token type = \"linear\"
        point3f[] points.timeSamples = { 2: [(0, 0, 0)], 3: [(1, 0, 0)], 4: [(5, 0, 0)] }
    }";
    let (_dir, path) = stage("hair.usda", text);
    let animation = Animation::open(&path).expect("three frames");
    assert_eq!((animation.len(), animation.frames()), (3, Frames { start: 2.0, rate: 30.0 }));
    assert_eq!(animation.read(9).expect("the last").strands().points(), [DVec3::X * 5.0]);
}

#[test]
fn instances_and_groups_stand_where_they_are_as_often_as_they_are() {
    let text = "def Xform \"library\"
{
    double3 xformOp:translate = (100, 0, 0)
    uniform token[] xformOpOrder = [\"xformOp:translate\"]
    def Xform \"curls\"
    {
        def BasisCurves \"hair\"
        {
            int[] curveVertexCounts = [2, 1]
            point3f[] points = [(0, 0, 0), (0, 1, 0), (0.5, 0, 0)]
            uniform token type = \"linear\"
            int[] primvars:id = [7, 8] (interpolation = \"uniform\")
        }
    }
}
def Xform \"left\" (
    instanceable = true
    references = </library/curls>
)
{
    double3 xformOp:translate = (10, 0, 0)
    uniform token[] xformOpOrder = [\"xformOp:translate\"]
}
def Xform \"group\"
{
    double3 xformOp:translate = (-20, 0, 0)
    uniform token[] xformOpOrder = [\"xformOp:translate\"]
    def Xform \"right\" (
        instanceable = true
        references = </library/curls>
    )
    {
        double3 xformOp:translate = (1, 0, 0)
        uniform token[] xformOpOrder = [\"xformOp:translate\"]
    }
}
";
    let groom = read(text).expect("a stage");
    let roots: Vec<f64> = groom.strands().iter().map(|strand| strand[0].x).collect();
    assert_eq!(roots, [100.0, 100.5, 10.0, 10.5, -19.0, -18.5]);
    let column = |name: &str| groom.strand_attributes().get(name).cloned();
    assert_eq!(column("group"), Some(Column::Int(vec![0, 0, 1, 1, 2, 2])));
    assert_eq!(column("id"), Some(Column::Int(vec![7, 8, 7, 8, 7, 8])));
}

#[test]
fn frames_of_any_number_and_columns_are_read_back() {
    // The tables of a binary file are coded four entries a byte: all remainders, with and without
    // samples over time.
    for n_columns in 0..5 {
        for n_frames in 1..4 {
            let frame = |i: usize| {
                let points = vec![DVec3::X * i as f64, DVec3::Y];
                let mut groom = Groom::new(Strands::from_counts([1, 1], points).expect("two"));
                groom.insert_point_attribute("width", Column::scalar(vec![0.5; 2])).expect("two");
                for k in 0..n_columns {
                    let values = Column::Int(vec![k, k * i as i64]);
                    groom.insert_strand_attribute(format!("c{k}"), values).expect("two rows");
                }
                groom
            };
            let (_dir, path) = stage("frames.usdc", "");
            let grooms = (0..n_frames).map(|i| Ok::<_, WriteError>(frame(i)));
            write_animation(&path, Frames::default(), &WriteOptions::default(), grooms)
                .expect("a file");
            let animation = Animation::open(&path).expect("our own file");
            assert_eq!(animation.len(), n_frames, "{n_columns} columns");
            for i in 0..n_frames {
                let back = animation.read(i).expect("a frame");
                assert_eq!(back, frame(i), "{n_columns} columns, frame {i} of {n_frames}");
            }
        }
    }
}

#[test]
fn no_curves_and_curves_of_one_point_are_kept_in_text_and_binary() {
    for counts in [&[][..], &[0, 0], &[1], &[0, 1, 0, 2, 1]] {
        let n = counts.iter().sum::<usize>();
        let points = (0..n).map(|i| DVec3::Y * i as f64).collect();
        let groom = Groom::new(Strands::from_counts(counts.to_vec(), points).expect("as counted"));
        for name in ["a.usda", "a.usdc"] {
            let (_dir, path) = stage(name, "");
            tress_io::write(&path, &groom, &WriteOptions::default()).expect("a file");
            assert_eq!(usd::read(&path).expect("ours").strands(), groom.strands(), "{counts:?}");
        }
    }
}

#[test]
fn a_frame_may_have_no_strands_or_none_that_stand_anywhere() {
    let frame = |points: Vec<DVec3>| {
        let counts = [points.len()].into_iter().filter(|n| 0 < *n);
        let mut groom = Groom::new(Strands::from_counts(counts, points).expect("its own count"));
        let rows = groom.strands().len();
        groom.insert_strand_attribute("width", Column::scalar(vec![0.5; rows])).expect("rows");
        groom
    };
    for name in ["a.usdc", "a.abc"] {
        let frames = [vec![DVec3::X, DVec3::Y], vec![], vec![DVec3::INFINITY], vec![DVec3::Z]];
        let (_dir, path) = stage(name, "");
        let grooms = frames.iter().map(|points| Ok::<_, WriteError>(frame(points.clone())));
        write_animation(&path, Frames::default(), &WriteOptions::default(), grooms)
            .expect("all frames");
        let animation = Animation::open(&path).expect("our own file");
        for (i, points) in frames.iter().enumerate() {
            assert_eq!(animation.read(i).expect("a frame").strands().points(), points, "{name}");
        }
    }
}
