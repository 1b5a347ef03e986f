use proptest::prelude::*;
use tress_geometry::{Column, Strands, names};

use super::*;
use crate::color::{lightness, luminance};
use crate::scale::ColorMap;

const LOW: f64 = 0.0;
const HIGH: f64 = 1.0;

fn groom(strands: &[Vec<DVec3>]) -> Groom {
    let points: Vec<DVec3> = strands.iter().flatten().copied().collect();
    let counts = strands.iter().map(Vec::len);
    Groom::new(Strands::from_counts(counts, points).expect("they match"))
}

/// A line along y at `x` and `z`, from -1 to 1.
fn upright(x: f64, z: f64) -> Vec<DVec3> {
    vec![DVec3::new(x, -1.0, z), DVec3::new(x, 1.0, z)]
}

/// A frame two units wide around the origin.
const FRAME: Bounds = Bounds { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) };

fn small(size: u32, width: f64) -> RenderOptions {
    let width = StrandWidth::Fixed(width);
    RenderOptions { size: Size::new(size, size), width, margin: 0.0, ..RenderOptions::default() }
}

/// Linear light that hair takes away from the background, by column.
fn taken(image: &RgbImage, background: Rgb) -> Vec<f32> {
    let full = luminance(decode(background));
    let column = |x| (0..image.height()).map(|y| full - luminance(decode(image[(x, y)].0))).sum();
    (0..image.width()).map(column).collect()
}

#[test]
fn a_hair_lands_where_the_camera_says() {
    let options = small(101, 0.01);
    // x = 0.4 of -1 to 1 is pixel 70.7 of 101.
    let image = render_within(&groom(&[upright(0.4, 0.0)]), FRAME, &Coloring::Natural, &options);
    let columns = taken(&image.expect("a picture"), options.background);
    let sum: f32 = columns.iter().sum();
    let mean =
        columns.iter().zip(0_u8..).map(|(&c, x)| c * (f32::from(x) + 0.5)).sum::<f32>() / sum;
    assert!((mean - 70.7).abs() < 0.02, "{mean}");
    assert_eq!(columns.iter().filter(|&&c| 0.0 < c).count(), 2, "{columns:?}");
}

#[test]
fn a_hair_below_a_pixel_takes_light_by_its_width() {
    let black = HairColor::Dyed([0; 3]);
    let white = [255; 3];
    let taken = |width: f64| {
        let options = RenderOptions { hair: black, background: white, ..small(200, width) };
        let groom = groom(&[upright(0.123, 0.0)]);
        let image = render_within(&groom, FRAME, &Coloring::Natural, &options).expect("a picture");
        taken(&image, white).iter().sum::<f32>()
    };
    let (thin, thick) = (taken(0.002), taken(0.004));
    // 0.2 and 0.4 pixels; the highlight of black hair gives a little back, by the width too.
    assert!((thick / thin - 2.0).abs() < 0.1, "{thin} {thick}");
    assert!(20.0 < thin && thin < 45.0, "{thin}");
}

#[test]
fn the_near_hair_hides_the_far_one_from_either_side() {
    // Two ribbons of hair: low values before, high values behind.
    let ribbon = |z: f64| (-20..20).map(move |i| upright(f64::from(i) / 20.0, z));
    let strands: Vec<_> = ribbon(0.5).chain(ribbon(-0.5)).collect();
    let values: Vec<f64> = (0..80).map(|i| if i < 40 { LOW } else { HIGH }).collect();
    let scale = Scale { min: LOW, max: HIGH, map: ColorMap::BlueRed, ..Scale::default() };
    let middle = |view| {
        let options = RenderOptions { view, ..small(100, 0.2) };
        let coloring = Coloring::Strands(&values, &scale);
        let image = render_within(&groom(&strands), FRAME, &coloring, &options).expect("a picture");
        image[(50, 40)].0
    };
    let ([r, _, b], [s, _, c]) = (middle(View::Front), middle(View::Back));
    assert!(r < b && c < s, "blue before, red behind: {r} {b}, {s} {c}");
}

#[test]
fn the_side_away_from_the_light_is_darker() {
    // A ball of short hairs in all directions, lit from the upper left.
    let hair = |i: i32| {
        let (a, z) = (f64::from(i) * 2.399_963, 1.0 - f64::from(i) / 2000.0);
        let r = (1.0 - z * z).sqrt();
        let out = DVec3::new(r * a.cos(), r * a.sin(), z);
        let across = DVec3::new(-a.sin(), a.cos(), 0.0) * 0.1;
        vec![out * 0.9 - across, out * 0.9 + across]
    };
    let ball = groom(&(0..4000).map(hair).collect::<Vec<_>>());
    let image = render_within(&ball, FRAME, &Coloring::Natural, &small(100, 0.04));
    let image = image.expect("a picture");
    let mean = |x: u32, y: u32| {
        let pixels = (0..100).map(|i| lightness(image[(x + i % 10, y + i / 10)].0));
        pixels.sum::<f32>() / 100.0
    };
    let (lit, shaded) = (mean(28, 22), mean(62, 70));
    assert!(shaded + 0.05 < lit, "{lit} {shaded}");
}

#[test]
fn views_show_the_side_they_name() {
    let one_sided = groom(&[upright(0.8, 0.0), upright(0.9, 0.0)]);
    let side = |view| {
        let options = RenderOptions { view, ..small(100, 0.05) };
        let image = render_within(&one_sided, FRAME, &Coloring::Natural, &options);
        let columns = taken(&image.expect("a picture"), options.background);
        columns[50..].iter().sum::<f32>() - columns[..50].iter().sum::<f32>()
    };
    assert!(0.0 < side(View::Front) && side(View::Back) < 0.0);
}

#[test]
fn the_number_of_threads_does_not_show() {
    let coil = |i: i32| {
        let point = |j: i32| {
            let (a, s) = (f64::from(j) * 1.1 + f64::from(i), f64::from(j) / 60.0);
            DVec3::new(
                f64::from(i % 20) / 10.0 - 1.0 + 0.05 * a.cos(),
                1.0 - 2.0 * s,
                0.05 * a.sin(),
            )
        };
        (0..60).map(point).collect()
    };
    let groom = groom(&(0..300).map(coil).collect::<Vec<_>>());
    let draw = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let options = RenderOptions { size: Size::new(300, 200), ..RenderOptions::default() };
        pool.install(|| render(&groom, &Coloring::Natural, &options)).expect("a picture")
    };
    let one = draw(1);
    assert!(one == draw(2) && one == draw(5));
    assert!(one.pixels().any(|pixel| lightness(pixel.0) < 0.5), "there is hair in the picture");
}

#[test]
fn hair_without_a_value_is_grey_and_the_legend_says_so() {
    let groom = groom(&[upright(-0.5, 0.0), upright(0.5, 0.0)]);
    let scale = Scale { title: "radius".into(), ..Scale::spanning([1.0, 2.0]) };
    let options = RenderOptions { size: Size::new(400, 400), ..small(400, 0.3) };
    let picture = |values: &[f64]| {
        render_within(&groom, FRAME, &Coloring::Strands(values, &scale), &options).expect("one")
    };
    let (whole, missing) = (picture(&[1.0, 2.0]), picture(&[f64::NAN, 2.0]));
    let hair = legend::height(options.size);
    let is_grey = |[r, g, b]: Rgb| r.abs_diff(g) <= 1 && g.abs_diff(b) <= 1;
    let row = (400 - hair) / 2;
    let at = |image: &RgbImage| {
        let left = (0..200).map(|x| image[(x, row)].0).filter(|p| *p != options.value_background);
        left.max_by(|a, b| lightness(*a).total_cmp(&lightness(*b))).expect("hair to the left")
    };
    assert!(is_grey(at(&missing)) && !is_grey(at(&whole)));
    let strip = |image: &RgbImage| {
        let rows = (400 - hair..400).flat_map(|y| (0..400).map(move |x| (x, y)));
        rows.map(|place| image[place].0).collect::<Vec<_>>()
    };
    assert_ne!(strip(&whole), strip(&missing));
}

#[test]
fn widths_come_from_the_groom_when_they_can_be_true() {
    let plain = groom(&[upright(0.0, 0.0), upright(0.5, 0.5)]);
    let camera = Camera::fit(FRAME.corners(), UpAxis::Y, View::Front, Size::new(200, 200), 0.0);
    let with = |width: f64| {
        let mut groom = plain.clone();
        let column = Column::scalar(vec![width, width]);
        groom.insert_strand_attribute(names::WIDTH, column).expect("two strands");
        radii(&groom, StrandWidth::Auto, &camera)
    };
    assert!(
        with(0.01).iter().all(|&r| (r - 0.5).abs() < 1e-6),
        "half of 0.01 at 100 pixels a unit"
    );
    let chosen = radii(&plain, StrandWidth::Auto, &camera);
    assert_eq!(with(5.0), chosen, "hair as wide as the head is not believed");
    assert_eq!(with(f64::NAN), chosen);
    let none = radii(&plain, StrandWidth::Fixed(f64::INFINITY), &camera);
    assert!(none.iter().all(|&r| r == 0.0));
}

#[test]
fn values_that_do_not_match_are_refused() {
    let groom = groom(&[upright(0.0, 0.0)]);
    let scale = Scale::default();
    let error = render(&groom, &Coloring::Points(&[1.0; 3], &scale), &RenderOptions::default());
    assert_eq!(error, Err(RenderError::Values { values: 3, of: "points", expected: 2 }));
    let huge = RenderOptions { size: Size::new(u32::MAX, u32::MAX), ..RenderOptions::default() };
    assert!(matches!(render(&groom, &Coloring::Natural, &huge), Err(RenderError::Size { .. })));
}

/// Coordinates as bad files have them.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -10.0..10.0_f64,
        1 => prop::num::f64::ANY,
        1 => prop_oneof![Just(0.0), Just(f64::NAN), Just(f64::INFINITY), Just(1e300), Just(1e-300)],
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn whatever_is_in_the_file_there_is_a_picture(
        strands in prop::collection::vec(
            prop::collection::vec(prop::array::uniform3(coordinate()), 0..6), 0..8),
        (width, height) in (1_u32..90, 1_u32..90),
        view in prop::sample::select(View::ALL.to_vec()),
        hair_width in coordinate(),
        by_value in any::<bool>(),
    ) {
        let strands: Vec<Vec<DVec3>> = strands
            .into_iter()
            .map(|strand| strand.into_iter().map(DVec3::from_array).collect())
            .collect();
        let groom = groom(&strands);
        let size = Size::new(width, height);
        for width in [StrandWidth::Auto, StrandWidth::Fixed(hair_width)] {
            let options = RenderOptions { size, view, width, ..RenderOptions::default() };
            let values: Vec<f64> = groom.strands().points().iter().map(|p| p.x).collect();
            let scale = Scale::spanning(values.iter().copied());
            let coloring =
                if by_value { Coloring::Points(&values, &scale) } else { Coloring::Natural };
            let image = render(&groom, &coloring, &options).expect("a picture");
            prop_assert_eq!(image.dimensions(), (size.width, size.height));
        }
    }
}
