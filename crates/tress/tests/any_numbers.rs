//! Grooms of any numbers at all: no layer panics, hangs or loses a strand.

use proptest::prelude::*;
use proptest::{collection, num};
use tress::analysis::{Analysis, Quantity, Wisps, compare, defects, quantity, summarize};
use tress::edit::{
    BlendSpace, Grouping, RecoilKeep, RecoilOptions, RuffleOptions, blend, groups, recoil, ruffle,
};
use tress::fit::{Elements, FitOptions, Sampling, Spectra, fit, sample};
use tress::geometry::glam::DVec3;
use tress::geometry::{Element, Frame, Groom, HelixGroom, Mesh, Strands};
use tress::grow::{Coils, Density, GrowOptions, grow, scatter};
use tress::helicoid::{self, Helicoid, HelicoidGroom, Piece, Tracing};
use tress::io::{Format, Model, WriteOptions};
use tress::optimize::{
    ArmatureOptions, Control, SculptOptions, apply_pose, armature, hold_centerlines, sculpt,
};
use tress::procedural::fit::{Fitter, StageOptions, avoid_head};
use tress::procedural::{
    Chain, Clump, Curl, EvenStrands, Operator, ProceduralGroom, Roots, Scale, Surface,
};
use tress::switchback::{InsertOptions, Placing, insert};
use tress::view::{Coloring, RenderOptions, Size, render};

/// A coil of so many points, moved and stretched.
fn coil(n: u32, size: f64, at: DVec3) -> Vec<DVec3> {
    let point = |j: u32| {
        let angle = 0.6 * f64::from(j);
        at + size * DVec3::new(0.5 * angle.cos(), -0.1 * angle, 0.5 * angle.sin())
    };
    (0..n).map(point).collect()
}

/// Strands that no one should have, each between two that are well.
fn strange() -> Vec<(&'static str, Vec<DVec3>)> {
    let with = |j: usize, x: DVec3| {
        let mut points = coil(40, 1.0, DVec3::ONE);
        points[j] = x;
        points
    };
    vec![
        ("no point", vec![]),
        ("a point", vec![DVec3::ONE]),
        ("two points in one place", vec![DVec3::ONE; 2]),
        ("all points in one place", vec![DVec3::ONE; 40]),
        ("two points", coil(2, 1.0, DVec3::ONE)),
        ("three points", coil(3, 1.0, DVec3::ONE)),
        ("a straight line", (0..40).map(|j| DVec3::X * f64::from(j)).collect()),
        ("there and back", (0..40).map(|j| DVec3::X * f64::from(j % 2)).collect()),
        ("not a number", with(7, DVec3::new(0.0, f64::NAN, 0.0))),
        ("not a number at the root", with(0, DVec3::NAN)),
        ("endless", with(39, DVec3::X * f64::INFINITY)),
        ("very far", with(20, DVec3::splat(1e200))),
        ("the greatest number", with(20, DVec3::splat(-f64::MAX))),
        ("huge", coil(40, 1e150, DVec3::ZERO)),
        ("tiny", coil(40, 1e-170, DVec3::ZERO)),
        ("tiny and far off", coil(40, 1e-14, DVec3::splat(1e3))),
        ("subnormal", coil(40, 1e-310, DVec3::ZERO)),
    ]
}

/// Each strange strand between two coils, and all of them together.
fn grooms() -> Vec<(&'static str, Groom)> {
    let well = |i: u32| coil(40, 1.0, DVec3::X * f64::from(i));
    let groom = |all: Vec<Vec<DVec3>>| {
        let mut strands = Strands::default();
        all.into_iter().for_each(|points| strands.push(points).expect("few points"));
        Groom::new(strands)
    };
    let all = strange().into_iter().map(|(_, points)| points).collect();
    let mut grooms = vec![("nothing", groom(vec![])), ("all together", groom(all))];
    for (name, points) in strange() {
        grooms.push((name, groom(vec![well(0), points, well(1), well(2)])));
    }
    grooms
}

/// Super-helices with elements that no one should have, beside one that is well.
fn helices() -> Vec<(&'static str, HelixGroom)> {
    let well = Element { length: 0.3, ..Element::coil(0.5, 0.4) };
    let q = |x: f64| Element { curvature: DVec3::new(x, -x, x), length: 0.3 };
    let long = |length: f64| Element { length, ..well };
    let groom = |root: Frame, strange: Vec<Element>| {
        let mut elements = Strands::default();
        for strand in [vec![well; 60], strange, vec![well; 20]] {
            elements.push(strand).expect("few elements");
        }
        HelixGroom::new(vec![Frame::IDENTITY, root, Frame::IDENTITY], elements)
            .expect("a root each")
    };
    let at = |position: DVec3| Frame { position, ..Frame::IDENTITY };
    let mixed = |element: Element| [vec![well; 20], vec![element], vec![well; 20]].concat();
    vec![
        ("no element", groom(Frame::IDENTITY, vec![])),
        ("curvature not a number", groom(Frame::IDENTITY, mixed(q(f64::NAN)))),
        ("endless curvature", groom(Frame::IDENTITY, mixed(q(f64::INFINITY)))),
        ("huge curvature", groom(Frame::IDENTITY, mixed(q(1e200)))),
        ("tiny curvature", groom(Frame::IDENTITY, mixed(q(1e-200)))),
        ("no curvature", groom(Frame::IDENTITY, vec![q(0.0); 40])),
        ("length not a number", groom(Frame::IDENTITY, mixed(long(f64::NAN)))),
        ("endless", groom(Frame::IDENTITY, mixed(long(f64::INFINITY)))),
        ("huge", groom(Frame::IDENTITY, mixed(long(1e200)))),
        ("less than no length", groom(Frame::IDENTITY, mixed(long(-5.0)))),
        ("no length", groom(Frame::IDENTITY, vec![long(0.0); 40])),
        ("a root that is not a number", groom(at(DVec3::NAN), vec![well; 40])),
        ("a root far off", groom(at(DVec3::splat(1e300)), vec![well; 40])),
    ]
}

fn analyse_and_picture(name: &str, groom: &Groom) {
    let strands = groom.strands().len();
    let analysis = Analysis::of(groom);
    assert!(analysis.summary().strands <= strands, "{name}");
    assert_eq!(Wisps::of(groom, &analysis).wisp.len(), strands, "{name}");
    let _ = defects(groom);
    let _ = compare([groom, groom], [&analysis, &analysis]);
    for of in Quantity::ALL {
        let _ = analysis.values(of);
    }
    assert!(Spectra::of(groom.strands()).len() <= strands, "{name}");
    let options = RenderOptions { size: Size::new(64, 48), ..RenderOptions::default() };
    // A groom without a point that can be seen is an error, not a panic.
    let _ = render(groom, &Coloring::Natural, &options);
}

fn fit_and_sample(name: &str, groom: &Groom) {
    let counts: Vec<usize> = groom.strands().counts().collect();
    for elements in [FitOptions::default().elements, Elements::Count(12)] {
        let options = FitOptions { elements, ..FitOptions::default() };
        let fitted = fit(groom, &options).expect("sound options");
        assert_eq!(fitted.helices.len(), counts.len(), "{name}");
        let back = sample(&fitted.helices, &Sampling::Counts(&counts)).expect("as many");
        assert_eq!(back.strands().counts().collect::<Vec<_>>(), counts, "{name}");
    }
    let fitted = helicoid::fit(groom, &helicoid::FitOptions::default()).expect("sound");
    assert_eq!(fitted.hairs.len(), counts.len(), "{name}");
}

/// A groom that a format has no place for is refused; of some that are written the reader says what
/// is wrong.
fn write_and_read(name: &str, groom: &Groom) {
    let folder = tempfile::tempdir().expect("a folder");
    for format in Format::ALL {
        let path = folder.path().join("groom").with_extension(format.extension());
        if tress::io::write(&path, groom, &WriteOptions::default()).is_err() {
            continue;
        }
        if let Ok(Model::Polylines(read)) = tress::io::read(&path) {
            assert_eq!(read.strands().len(), groom.strands().len(), "{name}, {format:?}");
        }
    }
}

fn grow_and_begin(name: &str, groom: &Groom) {
    let roots: Vec<DVec3> =
        groom.strands().iter().filter_map(|points| points.first().copied()).collect();
    let coils = Coils::shipped().expect("the library that comes along");
    if let Ok(grown) = grow(groom.strands(), &roots, coils, &GrowOptions::default(), 1) {
        assert_eq!(grown.strands().len(), roots.len(), "{name}");
    }
    let (even, _) = EvenStrands::resampled(groom, 12).expect("points enough");
    let roots = Roots { positions: roots, uv: None };
    if let Ok(mut begun) = ProceduralGroom::new(even, roots) {
        begun.chain.operators = operators();
        begun.draw_missing();
        let _ = begun.build();
    }
    let chain = Chain { operators: operators(), ..Chain::default() };
    let options = StageOptions { guides: 2, points: Some(12), ..StageOptions::default() };
    if let Ok(mut fitter) = Fitter::new(groom, chain, options) {
        let _ = fitter.advance(&mut |_| {}).and_then(|_| fitter.advance(&mut |_| {}));
    }
}

fn operators() -> Vec<Operator> {
    let curl = Curl { radius: 0.3, frequency: 0.5, ..Curl::default() };
    vec![
        Operator::Scale(Scale { random: 0.2 }),
        Operator::Clump(Clump { profile: 1.0 }),
        Operator::Curl(curl),
    ]
}

fn edit(name: &str, groom: &HelixGroom) {
    assert_eq!(summarize(groom).strands, groom.len(), "{name}");
    for of in Quantity::ALL {
        let _ = quantity(groom, of);
    }
    let clusters = groups(groom, &Grouping::Clusters(2), 1).expect("more strands");
    let options = RuffleOptions { probability: 0.5, keep: 2, ..RuffleOptions::default() };
    let (ruffled, _) = ruffle(groom, &clusters, &options, 1).expect("sound options");
    for space in [BlendSpace::Curvature, BlendSpace::Darboux] {
        blend(groom, &ruffled, 0.5, space).expect("as many elements");
    }
    for keep in [RecoilKeep::Length, RecoilKeep::Turns, RecoilKeep::Advance] {
        let options = RecoilOptions { radius: 2.0, frequency: 0.5, keep };
        let mut wide = recoil(groom, &options).expect("sound options");
        let _ = hold_centerlines(groom, &mut wide);
    }
    let placing = Placing::Density(0.2);
    if let Ok((changed, _)) = insert(groom, &clusters, &placing, &InsertOptions::default(), 1) {
        assert_eq!(changed.len(), groom.len(), "{name}");
    }
    for how in [Sampling::Points(9), Sampling::PerTurn(8.0), Sampling::Spacing(0.1)] {
        if let Ok(points) = sample(groom, &how) {
            assert_eq!(points.strands().len(), groom.len(), "{name}");
        }
    }
    let _ = helicoid::from_helices(groom, &helicoid::FitOptions::default());
}

fn sculpt_all(name: &str, groom: &HelixGroom) {
    let n = groom.len();
    if let Ok(mut pose) = armature(groom, &ArmatureOptions::default()) {
        pose.clusters.blend = 0.5;
        for joint in pose.groups.iter_mut().flat_map(|group| &mut group.joints) {
            joint.translate = DVec3::X;
        }
        if let Ok(controls) = apply_pose(groom, &pose) {
            let mut moved = groom.clone();
            let _ = sculpt(&mut moved, &controls, &SculptOptions::default());
            assert_eq!(moved.len(), n, "{name}");
        }
    }
    let tip = |i: usize| Control::new(groom.strand(i).length(), DVec3::ONE);
    let controls = Strands::from_counts(vec![1; n], (0..n).map(tip).collect()).expect("one each");
    let _ = sculpt(&mut groom.clone(), &controls, &SculptOptions::default());
    for strand in groom.iter() {
        let here = [Control::new(0.0, strand.root.position)];
        let _ = tress::optimize::solve(&strand, &here, &SculptOptions::default());
    }
}

fn keep_in_a_file(name: &str, groom: &HelixGroom) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("groom.tress");
    tress::io::write_helices(&path, groom).expect("a writable folder");
    if let Ok(Model::Helices(read)) = tress::io::read(&path) {
        assert_eq!(read.len(), groom.len(), "{name}");
    }
}

fn grow_on(mesh: &Mesh) {
    for density in [Density::Even, Density::Vertices(&vec![0.5; mesh.positions().len()])] {
        if let Ok(roots) = scatter(mesh, 30, density, 1) {
            assert_eq!(roots.len(), 30);
        }
    }
    let guides = EvenStrands::new(2, vec![DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::ONE]);
    let roots = Roots { positions: vec![DVec3::ZERO, DVec3::splat(0.5), DVec3::X], uv: None };
    let groom = ProceduralGroom::new(guides.expect("whole strands"), roots);
    let mut groom = groom.expect("numbers that are well");
    if let Ok(scalp) = Surface::new(mesh) {
        groom.instance_over(&scalp, 2, 0.5).expect("a positive sigma");
    }
    let _ = avoid_head(&mut groom, mesh);
    assert_eq!(groom.build().expect("a groom").len(), 3);
}

#[test]
fn polylines_are_analysed_and_pictured() {
    grooms().iter().for_each(|(name, groom)| analyse_and_picture(name, groom));
}

#[test]
fn no_strand_is_lost_by_a_fit() {
    grooms().iter().for_each(|(name, groom)| fit_and_sample(name, groom));
}

#[test]
fn files_hold_all_strands_or_say_why_not() {
    grooms().iter().for_each(|(name, groom)| write_and_read(name, groom));
}

#[test]
fn hair_is_grown_and_grooms_begun_or_refused() {
    grooms().iter().for_each(|(name, groom)| grow_and_begin(name, groom));
}

#[test]
fn super_helices_are_edited() {
    helices().iter().for_each(|(name, groom)| edit(name, groom));
}

#[test]
fn super_helices_are_sculpted() {
    helices().iter().for_each(|(name, groom)| sculpt_all(name, groom));
}

#[test]
fn super_helices_come_back_from_their_file() {
    helices().iter().for_each(|(name, groom)| keep_in_a_file(name, groom));
}

/// Any number at all, ordinary ones more often than others.
fn number() -> impl Strategy<Value = f64> {
    let any = num::f64::ANY;
    prop_oneof![6 => -2.0..2.0, 1 => any, 1 => (-1e4..1e4_f64).prop_map(f64::round)]
}

fn vector() -> impl Strategy<Value = DVec3> {
    [number(), number(), number()].prop_map(DVec3::from_array)
}

fn any_groom() -> impl Strategy<Value = Groom> {
    let strand = prop_oneof![
        collection::vec(vector(), 0..30),
        (0..60_u32, number(), vector()).prop_map(|(n, size, at)| coil(n, size, at)),
    ];
    collection::vec(strand, 0..6).prop_map(|all| {
        let mut strands = Strands::default();
        all.into_iter().for_each(|points| strands.push(points).expect("few points"));
        Groom::new(strands)
    })
}

fn any_mesh() -> impl Strategy<Value = Mesh> {
    let corner = 0..12_u32;
    let triangles = collection::vec([corner.clone(), corner.clone(), corner], 0..20);
    (collection::vec(vector(), 12), triangles)
        .prop_map(|(positions, triangles)| Mesh::new(positions, triangles).expect("its corners"))
}

fn any_helices() -> impl Strategy<Value = HelixGroom> {
    let element =
        (vector(), number()).prop_map(|(curvature, length)| Element { curvature, length });
    let strand = (vector(), collection::vec(element, 0..12));
    collection::vec(strand, 2..6).prop_map(|strands| {
        let (roots, elements): (Vec<DVec3>, Vec<Vec<Element>>) = strands.into_iter().unzip();
        let at = |position: DVec3| Frame { position, ..Frame::IDENTITY };
        let mut all = Strands::default();
        elements.into_iter().for_each(|strand| all.push(strand).expect("few elements"));
        HelixGroom::new(roots.into_iter().map(at).collect(), all).expect("a root each")
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 40,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_polylines(groom in any_groom()) {
        analyse_and_picture("any", &groom);
        fit_and_sample("any", &groom);
        write_and_read("any", &groom);
        grow_and_begin("any", &groom);
    }

    #[test]
    fn any_meshes(mesh in any_mesh()) {
        grow_on(&mesh);
    }

    #[test]
    fn any_super_helices(groom in any_helices()) {
        edit("any", &groom);
        sculpt_all("any", &groom);
        keep_in_a_file("any", &groom);
    }
}

#[test]
fn helicoids_are_traced_or_refused() {
    let well = Helicoid::new(0.5, 0.2, 0.1, 0.3);
    for x in [0.0, 1e-300, 1e200, f64::INFINITY, f64::NAN, -1.0] {
        let pieces = [
            Piece { k: Helicoid { kt: x, ..well }, length: 1.0 },
            Piece { k: Helicoid { kn: x, ..well }, length: 1.0 },
            Piece { k: Helicoid { alpha: x, ..well }, length: 1.0 },
            Piece { k: well, length: x },
        ];
        for piece in pieces {
            let strands = Strands::from_counts([2], vec![piece; 2]).expect("two pieces");
            let Ok(hairs) = HelicoidGroom::new(vec![Frame::IDENTITY], strands) else { continue };
            for tracing in [Tracing::default(), Tracing::Euler(20)] {
                if let Ok(points) = helicoid::sample(&hairs, 9, tracing) {
                    assert_eq!(points.strands().len(), 1, "{piece:?}");
                }
            }
            let _ = helicoid::to_helices(&hairs, 4);
        }
    }
}
