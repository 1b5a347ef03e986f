//! Helicoids, as in [GH Figs. 1 to 8, 10, 13 and 14].

use tress::geometry::glam::{DMat3, DVec3};
use tress::geometry::{Frame as Root, Groom, Strands};
use tress::helicoid::{
    FillOptions, FitOptions, Helicoid, HelicoidGroom, PHelicoid, Piece, Pieces, Roll, Roots,
    Tracing, Waviness, WispOptions, fill, fit, normals_at, sample, wisps,
};
use tress::view::{ColorMap, Coloring, Panel, RenderOptions, RgbImage, Scale, View, sheet};
use tress_fixtures::{PatchOptions, scalp};

use crate::Outcome;
use crate::grooms;
use crate::suites::helicoid::{mean_of_points, resampled};

use super::{Frame, save};

pub(super) fn make() -> Outcome {
    fields()?;
    parameters()?;
    wisp_shapes()?;
    interpolation()?;
    fitted_pieces()?;
    reconstruction()
}

/// A field seen along `E_B`: lines of flow from a grid, coloured by `theta`, and the hair among
/// them.
fn fields() -> Outcome {
    let kinds = [(0.5, 0.0, 0.0, 0.0), (0.5, -0.2, 0.0, 0.0), (0.5, 0.0, 0.5, 1.0)];
    let mut lines = Vec::new();
    for (kt, kn, kb, alpha) in kinds {
        lines.push(field(Helicoid::new(kt, kn, kb, alpha))?);
    }
    let scale = Scale { min: -180.0, max: 180.0, map: ColorMap::Cyclic, ..Scale::default() };
    let frame = Frame::around(lines.iter().map(|(groom, _)| groom), View::Front, (560, 560), 0.03);
    let images: Vec<RgbImage> = lines
        .iter()
        .map(|(groom, theta)| frame.draw(groom, &Coloring::Points(theta, &scale)))
        .collect::<Outcome<_>>()?;
    let captions = ["k = (0.5, 0, 0, 0)", "k = (0.5, -0.2, 0, 0)", "k = (0.5, 0, 0.5, 1)"];
    let panels: Vec<Panel<'_>> =
        images.iter().zip(captions).map(|(image, caption)| Panel { image, caption }).collect();
    save("helicoid-field.png", &sheet(&panels, 3, RenderOptions::default().background)?)
}

/// Lines of flow and `theta` in degrees at each of their points.
fn field(k: Helicoid) -> Outcome<(Groom, Vec<f64>)> {
    let mut strands = Strands::default();
    let mut theta = Vec::new();
    let mut add = |offset: DVec3, length: f64, points: usize| -> Outcome {
        let pieces = [Piece { k, length }];
        let hair = PHelicoid { root: Root::IDENTITY, pieces: &pieces };
        let stops: Vec<f64> =
            (0..points).map(|i| length * i as f64 / (points - 1) as f64).collect();
        let mut line = vec![DVec3::ZERO; points];
        if hair.streamline(offset, &stops, Tracing::default(), &mut line).is_ok() {
            theta.extend(line.iter().map(|&p| k.theta(p).sin_cos()).map(|(s, c)| s.atan2(c)));
            strands.push(line)?;
        }
        Ok(())
    };
    for i in -6..=6 {
        for j in -6..=6 {
            add(0.5 * DVec3::new(f64::from(i), f64::from(j), 0.0), 0.42, 12)?;
        }
    }
    // The hair is a bundle, so that it stands out.
    for i in 0..24_u32 {
        let (sine, cosine) = (2.399963 * f64::from(i)).sin_cos();
        let r = 0.05 * (f64::from(i) / 24.0).sqrt();
        add(DVec3::new(0.0, r * cosine, r * sine), 3.5, 60)?;
    }
    let degrees = theta.into_iter().map(f64::to_degrees).collect();
    Ok((Groom::new(strands), degrees))
}

/// One hair with one parameter after the other changed.
fn parameters() -> Outcome {
    let at = |value: f64| {
        [
            (Helicoid::new(value, 0.0, 0.0, 0.3), "kT from -0.8 to 0.8"),
            (Helicoid::new(0.5, 0.4 * value, 0.0, 0.3), "kN from -0.3 to 0.3"),
            (Helicoid::new(0.5, 0.0, value, 1.0), "kB from -0.8 to 0.8"),
            (Helicoid::new(0.5, 0.0, 0.0, 2.0 * value), "alpha from -1.6 to 1.6"),
        ]
    };
    let values: Vec<f64> = (0..33).map(|i| f64::from(i) * 0.05 - 0.8).collect();
    let mut panels: [(Vec<Root>, Vec<Piece>, &str); 4] =
        std::array::from_fn(|_| Default::default());
    for &value in &values {
        for ((roots, pieces, name), (k, of)) in panels.iter_mut().zip(at(value)) {
            roots.push(upward(DVec3::ZERO));
            pieces.push(Piece { k, length: 3.6 });
            *name = of;
        }
    }
    let mut hairs = Vec::new();
    for (roots, pieces, name) in panels {
        let strands = Strands::from_counts(vec![1; roots.len()], pieces)?;
        let groom = sample(&HelicoidGroom::new(roots, strands)?, 60, Tracing::default())?;
        hairs.push((groom, name));
    }
    let scale = Scale { min: -0.8, max: 0.8, map: ColorMap::BlueRed, ..Scale::default() };
    let view = View::ThreeQuarter;
    let frame = Frame::around(hairs.iter().map(|(groom, _)| groom), view, (420, 460), 0.035);
    let images: Vec<RgbImage> = hairs
        .iter()
        .map(|(groom, _)| frame.draw(groom, &Coloring::Strands(&values, &scale)))
        .collect::<Outcome<_>>()?;
    let panels: Vec<Panel<'_>> =
        images.iter().zip(&hairs).map(|(image, (_, caption))| Panel { image, caption }).collect();
    save("helicoid-parameters.png", &sheet(&panels, 4, RenderOptions::default().background)?)
}

/// A root from which a hair grows upwards and bends to the right.
fn upward(position: DVec3) -> Root {
    Root { position, axes: DMat3::from_cols(DVec3::Y, DVec3::X, DVec3::NEG_Z) }
}

/// A root from which a hair hangs.
fn hanging(position: DVec3) -> Root {
    Root { position, axes: DMat3::from_cols(DVec3::NEG_Y, DVec3::X, DVec3::Z) }
}

/// Wisps of 256 hairs: of one piece, fanned out, to a point, with waves, and of four curly pieces.
fn wisp_shapes() -> Outcome {
    let piece = |kt, kn, kb, alpha, length| Piece { k: Helicoid::new(kt, kn, kb, alpha), length };
    let long = vec![piece(0.5, 0.0, 0.1, 0.3, 3.0), piece(-0.35, 0.0, 0.2, 0.5, 3.0)];
    let curly: Vec<Piece> =
        [0.9, 1.0, 0.8, 1.1].map(|a| piece(1.3 * a, 0.0, 0.09, 0.9, 3.0)).to_vec();
    let fanned = vec![piece(0.3, 0.35, 0.1, 0.3, 3.0), piece(-0.2, 0.1, 0.2, 0.5, 3.0)];
    let calm = WispOptions { radius: 0.22, points: 120, frizz: 0.006, ..WispOptions::default() };
    let waviness = Waviness { amplitude: 0.12, frequency: 5.0, fade_in: 1.5 };
    let mut grooms = Vec::new();
    for (pieces, options, caption) in [
        (&long, calm.clone(), "two pieces"),
        (&fanned, WispOptions { fanning: 0.03, ..calm.clone() }, "kN above 0"),
        (&long, WispOptions { profile: vec![1.0, 1.6, 0.1], ..calm.clone() }, "radius profile"),
        (&long, WispOptions { waviness, ..calm.clone() }, "waves"),
        (&curly, WispOptions { radius: 0.18, ..calm.clone() }, "four curly pieces"),
    ] {
        let strands = Strands::from_counts([pieces.len()], pieces.clone())?;
        let hairs = HelicoidGroom::new(vec![hanging(DVec3::ZERO)], strands)?;
        grooms.push((wisps(&hairs, &options, Tracing::default(), 3)?, caption));
    }
    let view = View::Front;
    let frame = Frame::around(grooms.iter().map(|(groom, _)| groom), view, (330, 330), 0.02);
    let panels: Vec<_> = grooms.iter().map(|(groom, caption)| (groom, *caption)).collect();
    frame.sheet("helicoid-wisps.png", panels.len(), &panels)
}

/// Between two guides on a line, by helicoids and by points; between four on a plane; on a scalp.
fn interpolation() -> Outcome {
    let k = Piece { k: Helicoid::new(1.0, -0.1, 0.3, 1.0), length: 3.0 };
    let turned = |root: Root| {
        let [t, n, b] = [root.axes.x_axis, root.axes.y_axis, root.axes.z_axis];
        Root { axes: DMat3::from_cols(t, -n, -b), ..root }
    };
    let ends = [upward(DVec3::ZERO), turned(upward(DVec3::new(7.0, 0.0, 0.0)))];
    let guides = HelicoidGroom::new(ends.to_vec(), Strands::from_counts([1, 1], vec![k; 2])?)?;
    let roots: Vec<DVec3> = (0..=70).map(|i| DVec3::new(0.1 * f64::from(i), 0.0, 0.0)).collect();
    let options = FillOptions::default();
    let line = fill(&guides, Roots::Points(&roots), &options)?;
    let line = sample(&line.hairs, 60, Tracing::default())?;
    let points = sample(&guides, 60, Tracing::default())?;
    let by_points = Groom::new(mean_of_points(&points, &roots, &options)?);
    let pair = Frame::around([&line, &by_points], View::ThreeQuarter, (760, 420), 0.035);
    let plane = plane()?;
    let head = on_scalp()?;
    let around = |groom, view, width| Frame::around([groom], view, (760, 520), width);
    let images = [
        pair.draw(&line, &Coloring::Natural)?,
        pair.draw(&by_points, &Coloring::Natural)?,
        around(&plane, View::ThreeQuarter, 0.03).draw(&plane, &Coloring::Natural)?,
        around(&head, View::Front, 0.06).draw(&head, &Coloring::Natural)?,
    ];
    let captions = [
        "two guides half a turn apart, helicoids mixed",
        "the same guides, points mixed",
        "four guides of three pieces on a plane",
        "nine guides on a scalp",
    ];
    let panels: Vec<Panel<'_>> =
        images.iter().zip(captions).map(|(image, caption)| Panel { image, caption }).collect();
    save("helicoid-fill.png", &sheet(&panels, 2, RenderOptions::default().background)?)
}

/// A guide of three pieces, straight where `curl` is 0.
fn guide(curl: f64) -> Vec<Piece> {
    let piece = |i: i32| {
        let kt = 0.15 + curl * (1.0 + 0.3 * f64::from(i));
        Piece { k: Helicoid::new(kt, 0.0, 0.1 * curl, 0.9), length: 1.2 + 0.5 * curl }
    };
    (0..3).map(piece).collect()
}

fn plane() -> Outcome<Groom> {
    let corner = |i: u32| DVec3::new(f64::from(i % 2) * 4.0, 0.0, f64::from(i / 2) * 4.0);
    let pieces: Vec<Piece> = [0.0, 0.5, 1.6, 1.0].into_iter().flat_map(guide).collect();
    let guides = HelicoidGroom::new(
        (0..4).map(|i| upward(corner(i))).collect(),
        Strands::from_counts([3; 4], pieces)?,
    )?;
    let at = |i: i32| DVec3::new(f64::from(i % 33), 0.0, f64::from(i / 33)) / 8.0;
    let roots: Vec<DVec3> = (0..33 * 33).map(at).collect();
    let filled = fill(&guides, Roots::Points(&roots), &FillOptions::default())?;
    Ok(sample(&filled.hairs, 60, Tracing::default())?)
}

/// Guides that get curlier from one side of a patch of scalp to the other.
fn on_scalp() -> Outcome<Groom> {
    let options = PatchOptions { patch_angle: 1.2, ..PatchOptions::default() };
    let mesh = scalp(&options);
    let density = tress::grow::Density::Even;
    let roots = tress::grow::scatter(&mesh, 4000, density, 1)?;
    let normals = normals_at(&mesh, &roots);
    let at = tress::grow::scatter(&mesh, 9, density, 2)?;
    let at_guides = normals_at(&mesh, &at);
    let widest = at.iter().fold(0.0, |most, p| f64::max(most, p.x.abs()));
    // They stand on the scalp and bend downwards.
    let frame = |(&position, &normal): (&DVec3, &DVec3)| {
        let down = DVec3::NEG_Y.reject_from_normalized(normal).normalize_or(DVec3::Z);
        Root { position, axes: DMat3::from_cols(normal, down, normal.cross(down)) }
    };
    let curls = at.iter().map(|p| 0.45 + 0.4 * p.x / widest);
    let pieces: Vec<Piece> = curls.flat_map(guide).collect();
    let strands = Strands::from_counts([3; 9], pieces)?;
    let guides = HelicoidGroom::new(at.iter().zip(&at_guides).map(frame).collect(), strands)?;
    let surface = Roots::Surface { positions: &roots, normals: &normals, at_guides: &at_guides };
    let filled = fill(&guides, surface, &FillOptions::default())?;
    Ok(sample(&filled.hairs, 60, Tracing::default())?)
}

/// Strands and the pieces of their fits.
fn fitted_pieces() -> Outcome {
    let whole = grooms::groom(COILS, 2000, 21)?;
    let some: Vec<usize> = (0..whole.strands().len()).step_by(110).collect();
    let groom = whole.select(&some);
    let fitted = fit(&groom, &FitOptions::default())?;
    let points = 90;
    let traced = sample(&fitted.hairs, points, Tracing::default())?;
    let mut values = Vec::new();
    for hair in fitted.hairs.iter() {
        let mut ends = hair.pieces.iter().scan(0.0, |s, piece| {
            *s += piece.length;
            Some(*s)
        });
        let ends: Vec<f64> = ends.by_ref().collect();
        let length = hair.length();
        let piece = |j: usize| {
            let s = length * j as f64 / (points - 1) as f64;
            ends.partition_point(|&end| end < s) % 6
        };
        values.extend((0..points).map(|j| piece(j) as f64));
    }
    let scale = Scale { min: 0.0, max: 6.0, map: ColorMap::Cyclic, ..Scale::default() };
    let frame = Frame::around([&groom, &traced], View::Front, (640, 820), 0.09);
    let strands = frame.draw(&groom, &Coloring::Natural)?;
    let pieces = frame.draw(&traced, &Coloring::Points(&values, &scale))?;
    let panels = [
        Panel { image: &strands, caption: "every 110th strand" },
        Panel { image: &pieces, caption: "its fit, a colour a piece" },
    ];
    save("helicoid-pieces.png", &sheet(&panels, 2, RenderOptions::default().background)?)
}

const COILS: &str = "digitalsalon_harolongo.data";
const STRAIGHT: &str = "yuksel_straight.hair";

/// Two heads, a tenth of their strands, and what comes back of them by helicoids and by points.
fn reconstruction() -> Outcome {
    let mut images = Vec::new();
    for (file, pieces, points, width, size) in
        [(COILS, 20, 21, 0.07, (280, 330)), (STRAIGHT, 8, 16, 0.22, (280, 250))]
    {
        let groom = grooms::groom(file, 2000, points)?;
        let groom = resampled(&groom, groom.strands().len(), points)?;
        let tenth: Vec<usize> = (0..groom.strands().len()).step_by(10).collect();
        let guides = groom.select(&tenth);
        let roll = Roll::Steady;
        let options = FitOptions { pieces: Pieces::Equal(pieces), roll, ..FitOptions::default() };
        let fitted = fit(&guides, &options)?;
        let roots: Vec<DVec3> = groom.strands().iter().map(|points| points[0]).collect();
        let options = FillOptions { hold: 4, ..FillOptions::default() };
        let filled = fill(&fitted.hairs, Roots::Points(&roots), &options)?;
        let fine = 4 * points;
        let ours = sample(&filled.hairs, fine, Tracing::default())?;
        let plain = mean_of_points(&resampled(&guides, tenth.len(), fine)?, &roots, &options)?;
        let frame = Frame::around([&groom], View::Front, size, width);
        for groom in [
            &resampled(&groom, groom.strands().len(), fine)?,
            &sample(&fitted.hairs, fine, Tracing::default())?,
            &ours,
            &Groom::new(plain),
        ] {
            images.push(frame.draw(groom, &Coloring::Natural)?);
        }
    }
    let captions = ["all strands", "fits of a tenth", "filled in", "the mean of points"];
    let panels: Vec<Panel<'_>> = images
        .iter()
        .zip(captions.into_iter().cycle())
        .map(|(image, caption)| Panel { image, caption })
        .collect();
    save("helicoid-tenth.png", &sheet(&panels, 4, RenderOptions::default().background)?)
}
