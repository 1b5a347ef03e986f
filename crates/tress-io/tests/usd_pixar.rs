//! What is written as USD, as Pixar's own library reads it. Needs Python with `pxr` (the package
//! `usd-core`); without it the test says so and passes.

use std::path::Path;
use std::process::Command;

use glam::DVec3;
use tress_geometry::{Column, Groom, Strands, UpAxis};
use tress_io::{Frames, UsdCurves, WriteError, WriteOptions, write_animation};

/// Prints what the file says, one fact a line, numbers in full.
const PRINT: &str = r#"
import sys
from pxr import Usd, UsdGeom
stage = Usd.Stage.Open(sys.argv[1])
print("unit", UsdGeom.GetStageMetersPerUnit(stage))
print("up", UsdGeom.GetStageUpAxis(stage))
print("default", stage.GetDefaultPrim().GetPath())
prim = [p for p in stage.Traverse() if p.IsA(UsdGeom.BasisCurves)][0]
curves = UsdGeom.BasisCurves(prim)
print("type", curves.GetTypeAttr().Get(), curves.GetBasisAttr().Get(), curves.GetWrapAttr().Get())
print("counts", *curves.GetCurveVertexCountsAttr().Get())
print("points", *[repr(x) for p in curves.GetPointsAttr().Get() for x in p])
print("widths", curves.GetWidthsInterpolation(), *curves.GetWidthsAttr().Get())
print("normals", curves.GetNormalsAttr().HasAuthoredValue())
fits = UsdGeom.Boundable.ComputeExtentFromPlugins(curves, Usd.TimeCode.Default())
print("extent", all((a - b).GetLength() < 1e-5 for a, b in zip(fits, curves.GetExtentAttr().Get())))
for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues():
    print(primvar.GetPrimvarName(), primvar.GetTypeName(), primvar.GetInterpolation(),
          primvar.GetElementSize(), *primvar.Get())
try:
    from pxr import UsdValidation
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    for error in UsdValidation.ValidationContext(validators).Validate(stage):
        print("error", error.GetName(), error.GetMessage())
except ImportError:
    pass
"#;

#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn has_pixar() -> bool {
    let found = Command::new("python3").args(["-c", "import pxr"]).output();
    let found = found.is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("skipped: python3 has no module pxr (pip install usd-core)");
    }
    found
}

fn print(path: &Path) -> Vec<String> {
    let output =
        Command::new("python3").args(["-c", PRINT]).arg(path).output().expect("python3 runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect()
}

/// A hair's width in centimetres, which all strands are given that have none.
const GIVEN: &str = "constant 0.009999999776482582";

fn groom() -> Groom {
    let points: Vec<DVec3> =
        (0..60).map(|i| DVec3::new(0.1, 1e-7, -1.0 / 3.0) * f64::from(i)).collect();
    let strands = Strands::from_counts([57, 2, 1], points).expect("sixty");
    let mut groom = Groom::new(strands).in_space(Some(0.01), Some(UpAxis::Z));
    let insert = |groom: &mut Groom, name: &str, column| {
        groom.insert_strand_attribute(name, column).expect("a row a strand");
    };
    insert(&mut groom, "id", Column::Int(vec![1, -2, 1 << 40]));
    insert(&mut groom, "seven", Column::Float { components: 7, values: vec![0.5; 21] });
    insert(&mut groom, "uv", Column::Float { components: 2, values: vec![0.25; 6] });
    insert(&mut groom, "color", Column::Float { components: 3, values: vec![1.0; 9] });
    groom
}

#[test]
fn pixar_reads_what_was_written() {
    if !has_pixar() {
        return;
    }
    let mut groom = groom();
    for (name, kind, expected, widths) in [
        ("a.usda", UsdCurves::Linear, "type linear bezier nonperiodic", GIVEN),
        ("a.usdc", UsdCurves::Linear, "type linear bezier nonperiodic", "uniform 0.5 1.0 2.0"),
        ("a.usda", UsdCurves::CatmullRom, "type cubic catmullRom pinned", "uniform 0.5 1.0 2.0"),
        ("a.usdc", UsdCurves::CatmullRom, "type cubic catmullRom pinned", "uniform 0.5 1.0 2.0"),
    ] {
        let dir = tempfile::tempdir().expect("a folder");
        let path = dir.path().join(name);
        tress_io::write(&path, &groom, &WriteOptions { usd_curves: kind }).expect("a file");
        let facts = print(&path);
        let fact = |name: &str| {
            let line = facts.iter().find(|line| line.split(' ').next() == Some(name));
            line.map(|line| line[name.len()..].trim().to_owned()).unwrap_or_default()
        };
        assert!(facts.contains(&expected.to_owned()), "{facts:?}");
        assert_eq!(
            (fact("unit"), fact("up"), fact("default")),
            ("0.01".into(), "Z".into(), "/groom".into())
        );
        assert_eq!(fact("counts"), "57 2 1");
        assert_eq!((fact("normals"), fact("extent")), ("False".into(), "True".into()));
        let theirs: Vec<f64> =
            fact("points").split(' ').map(|number| number.parse().expect("a number")).collect();
        let ours = groom.strands().points().iter().flat_map(|point| point.as_vec3().to_array());
        assert!(ours.map(f64::from).eq(theirs), "{:?}", fact("points"));
        assert_eq!(fact("id"), "int64[] uniform 1 1 -2 1099511627776");
        assert!(fact("seven").starts_with("float[] uniform 7 0.5 0.5"));
        assert!(fact("st").starts_with("texCoord2f[] uniform 1 (0.25, 0.25)"));
        assert!(fact("displayColor").starts_with("color3f[] uniform 1 (1, 1, 1)"));
        assert_eq!(fact("widths"), widths);
        // One strand has a single point, which is no curve to USD; nothing else may be wrong.
        let errors: Vec<_> = facts.iter().filter(|line| line.starts_with("error")).collect();
        assert!(errors.iter().all(|error| error.contains("urve")), "{errors:?}");
        let width = Column::scalar(vec![0.5, 1.0, 2.0]);
        groom.insert_strand_attribute("width", width).expect("a row a strand");
    }
}

/// Prints the times and, at each, the counts and points.
const PRINT_FRAMES: &str = r#"
import sys
from pxr import Usd, UsdGeom
stage = Usd.Stage.Open(sys.argv[1])
print(stage.GetStartTimeCode(), stage.GetEndTimeCode(), stage.GetTimeCodesPerSecond())
curves = UsdGeom.BasisCurves(stage.GetPrimAtPath("/groom/strands"))
for time in curves.GetPointsAttr().GetTimeSamples():
    counts = curves.GetCurveVertexCountsAttr().Get(time)
    print(time, *counts, *[x for p in curves.GetPointsAttr().Get(time) for x in p])
"#;

#[test]
fn pixar_reads_every_frame_of_a_binary_file() {
    if !has_pixar() {
        return;
    }
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("wind.usdc");
    let frame = |i: u8| {
        let counts = if i == 2 { vec![1, 1] } else { vec![2] };
        let points = vec![DVec3::ZERO, DVec3::splat(i.into())];
        Ok::<_, WriteError>(Groom::new(Strands::from_counts(counts, points).expect("two points")))
    };
    let frames = Frames { start: 1.0, rate: 24.0 };
    let grooms = (0..3).map(frame);
    write_animation(&path, frames, &WriteOptions::default(), grooms).expect("a file");
    let output = Command::new("python3")
        .args(["-c", PRINT_FRAMES])
        .arg(&path)
        .output()
        .expect("python3 runs");
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    let expected = "1.0 3.0 24.0\n1.0 2 0.0 0.0 0.0 0.0 0.0 0.0\n2.0 2 0.0 0.0 0.0 1.0 1.0 1.0\n\
                    3.0 1 1 0.0 0.0 0.0 2.0 2.0 2.0\n";
    assert_eq!(lines, expected, "{}", String::from_utf8_lossy(&output.stderr));
}
