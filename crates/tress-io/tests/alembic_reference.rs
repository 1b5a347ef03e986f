//! What is written as Alembic, as the C++ library reads it. Needs Python with `alembic3d` (the
//! package of that name); without it the tests say so and pass.

use std::path::Path;
use std::process::Command;

use glam::DVec3;
use tress_geometry::{Column, Groom, Strands, UpAxis};
use tress_io::{Frames, WriteError, WriteOptions, unreal, write_animation};

/// Prints what the file says, one fact a line.
const PRINT: &str = r#"
import sys
from alembic3d import Abc, AbcGeom
archive = Abc.IArchive(sys.argv[1])
top = archive.getTop().children[0]
transform = AbcGeom.IXform(archive.getTop(), top.getName()).getSchema()
print("identity", transform.isConstantIdentity())
user = transform.getUserProperties()
if user.valid():
    for header in user.propertyheaders:
        for kind in (Abc.IInt16Property, Abc.IStringProperty, Abc.IDoubleProperty):
            if kind.matches(header):
                value = kind(user, header.getName()).getValue(Abc.ISampleSelector(0))
                print("user", header.getName(), kind.__name__, value)
curves = AbcGeom.ICurves(top, "strands").getSchema()
print("variance", curves.getTopologyVariance())
times = curves.getTimeSampling()
for i in range(curves.getNumSamples()):
    sample = curves.getValue(Abc.ISampleSelector(times.getSampleTime(i)))
    print("sample", round(times.getSampleTime(i), 6), sample.getType(), sample.getBasis(),
          sample.getWrap(), *sample.getCurvesNumVertices())
    print("points", *[x for p in sample.getPositions() for x in (p.x, p.y, p.z)])
    print("bounds", sample.getSelfBounds())
first = Abc.ISampleSelector(0)
for name, parameter in (("width", curves.getWidthsParam()), ("uv", curves.getUVsParam())):
    if parameter.valid():
        print(name, parameter.getScope(), *parameter.getExpandedValue(first).getVals())
parameters = curves.getArbGeomParams()
kinds = [getattr(AbcGeom, f"I{kind}GeomParam") for kind in
         ("Int32", "Float", "V2f", "V3f", "V3i", "String")]
if parameters.valid():
    for header in parameters.propertyheaders:
        for kind in kinds:
            if kind.matches(header):
                parameter = kind(parameters, header.getName())
                values = parameter.getExpandedValue(first).getVals()
                print(header.getName(), kind.__name__, parameter.getScope(), *values)
"#;

/// What the C++ library says of a file, if it is there.
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn facts(path: &Path) -> Option<Vec<String>> {
    let found = Command::new("python3").args(["-c", "import alembic3d"]).output();
    if !found.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: python3 has no module alembic3d (pip install alembic3d)");
        return None;
    }
    let output =
        Command::new("python3").args(["-c", PRINT]).arg(path).output().expect("python3 runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    Some(lines.lines().map(str::to_owned).collect())
}

fn groom() -> Groom {
    let points = (0..5).map(|i| DVec3::new(f64::from(i), 0.25, -0.5)).collect();
    let strands = Strands::from_counts([3, 2], points).expect("five points");
    let mut groom = Groom::new(strands).in_space(Some(1.0), Some(UpAxis::Z));
    let mut insert = |name: &str, column| {
        groom.insert_strand_attribute(name, column).expect("a row a strand");
    };
    insert("group", Column::Int(vec![4, 5]));
    insert("guide", Column::Int(vec![1, 0]));
    insert("uv", Column::Float { components: 2, values: vec![0.0, 0.25, 0.5, 1.0] });
    insert("color", Column::Float { components: 3, values: vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0] });
    insert("closest_guides", Column::Float { components: 3, values: vec![0.0; 6] });
    insert("width", Column::scalar(vec![0.0001, 0.0002]));
    groom
}

#[test]
fn the_reference_library_reads_what_unreal_is_given() {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("h\u{e4}ir of hers.abc");
    unreal::write(&path, &groom(), &unreal::UnrealOptions::default()).expect("a file");
    let Some(facts) = facts(&path) else { return };
    let has = |fact: &str| assert!(facts.iter().any(|line| line == fact), "{fact}: {facts:#?}");
    has("identity True");
    has("user groom_version_major IInt16Property 1");
    has("user groom_version_minor IInt16Property 5");
    has("sample 0.0 kLinear kNoBasis kNonPeriodic 3 2");
    // In centimetres, Y up.
    has("points 0.0 -50.0 -25.0 100.0 -50.0 -25.0 200.0 -50.0 -25.0 300.0 -50.0 -25.0 \
         400.0 -50.0 -25.0");
    has("groom_group_id IInt32GeomParam kUniformScope 4 5");
    has("groom_group_name IStringGeomParam kUniformScope group_4 group_5");
    has("groom_guide IInt32GeomParam kUniformScope 1 0");
    has("groom_root_uv IV2fGeomParam kUniformScope V2f(0, 0.25) V2f(0.5, 1)");
    has("groom_color IV3fGeomParam kVertexScope V3f(1, 0, 0) V3f(1, 0, 0) V3f(1, 0, 0) \
         V3f(0, 1, 0) V3f(0, 1, 0)");
    has("groom_closest_guides IV3iGeomParam kUniformScope V3i(0, 0, 0) V3i(0, 0, 0)");
    let widths = facts.iter().find(|line| line.starts_with("width kVertexScope"));
    assert!(widths.is_some_and(|line| line.split(' ').count() == 2 + 5), "{facts:#?}");
}

#[test]
fn the_reference_library_reads_every_frame() {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("wind.abc");
    let frame = |i: u8| {
        let counts = if i == 3 { vec![1, 1] } else { vec![2] };
        // The first two frames are alike.
        let points = vec![DVec3::ZERO, DVec3::splat(i.saturating_sub(1).into())];
        Ok::<_, WriteError>(Groom::new(Strands::from_counts(counts, points).expect("two points")))
    };
    let grooms = (0..4).map(frame);
    write_animation(&path, Frames::default(), &WriteOptions::default(), grooms).expect("a file");
    let Some(facts) = facts(&path) else { return };
    let lines = |name: &str| -> Vec<&str> {
        let begins = facts.iter().filter_map(|line| line.strip_prefix(name));
        begins.map(str::trim).collect()
    };
    assert_eq!(lines("variance"), ["kHeterogenousTopology"]);
    assert_eq!(
        lines("sample"),
        [
            "0.041667 kLinear kNoBasis kNonPeriodic 2",
            "0.083333 kLinear kNoBasis kNonPeriodic 2",
            "0.125 kLinear kNoBasis kNonPeriodic 2",
            "0.166667 kLinear kNoBasis kNonPeriodic 1 1",
        ]
    );
    assert_eq!(
        lines("points"),
        [
            "0.0 0.0 0.0 0.0 0.0 0.0",
            "0.0 0.0 0.0 0.0 0.0 0.0",
            "0.0 0.0 0.0 1.0 1.0 1.0",
            "0.0 0.0 0.0 2.0 2.0 2.0",
        ]
    );
}
