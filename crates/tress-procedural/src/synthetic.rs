//! Seven grooms with known guides, parameters and numbers, in the manner of [IPG Fig. 7], to
//! measure fits against.
//!
//! The head is a ball of radius 9 (centimetres), hair grows on the upper cap. Guides leave the
//! scalp and fall, up to the style's length, and sway smoothly over the head. Strands are instanced
//! from 500 guides; every guide is an operator guide.

use glam::DVec3;

use crate::{
    Bend, BuildError, Chain, Clump, Curl, EvenStrands, Frizz, Instances, Instancing, Operator,
    ProceduralGroom, Roots, Scale,
};

/// A groom with known parameters, and where a fit of it is to begin.
#[derive(Clone, Debug)]
pub struct Known {
    /// What it is like.
    pub name: &'static str,
    /// The groom.
    pub groom: ProceduralGroom,
    /// The same operators with parameters far off.
    pub start: Chain,
}

impl Known {
    /// Mean distance of the points of `found`'s guides from the true guides, blended at their
    /// roots, in the groom's unit.
    ///
    /// ```
    /// use tress_procedural::synthetic::known;
    ///
    /// let known = known(4, 0.01)?;
    /// let mut moved = known.groom.clone();
    /// for guide in moved.guides.points_mut().chunks_mut(101) {
    ///     guide[1..].iter_mut().for_each(|x| x.y += 0.5);
    /// }
    /// let off = known.guides_off(&moved) - known.guides_off(&known.groom);
    /// assert!((0.3..0.6).contains(&off));
    /// # Ok::<(), tress_procedural::BuildError>(())
    /// ```
    #[must_use]
    pub fn guides_off(&self, found: &ProceduralGroom) -> f64 {
        let roots = found.guide_roots();
        let instances = Instances::by_distance(&self.groom.guide_roots(), &roots, NEIGHBORS, SIGMA);
        let blended = instances.instance(&self.groom.guides, &roots.positions);
        let pairs = blended.points().iter().zip(found.guides.points());
        pairs.map(|(a, b)| a.distance(*b)).sum::<f64>() / found.guides.points().len().max(1) as f64
    }
}

/// What the hair does before operators.
#[derive(Clone, Copy, Debug)]
struct Style {
    name: &'static str,
    strands: usize,
    length: f64,
    /// How much of the length it falls: 1 down, 0 out.
    fall: f64,
}

const POINTS: usize = 101;
const GUIDES: usize = 500;
const HEAD: f64 = 9.0;
/// Guides a strand is blended from, and how far each reaches in texture coordinates.
const NEIGHBORS: usize = 4;
const SIGMA: f64 = 0.02;

const STYLES: [Style; 7] = [
    Style { name: "wavy, chin", strands: 28_022, length: 20.0, fall: 0.9 },
    Style { name: "curly, shoulder", strands: 13_991, length: 30.0, fall: 1.0 },
    Style { name: "straight, short, up", strands: 30_000, length: 4.0, fall: 0.1 },
    Style { name: "straight, ear, out", strands: 28_022, length: 12.0, fall: 0.4 },
    Style { name: "straight, shoulder", strands: 13_991, length: 30.0, fall: 1.0 },
    Style { name: "coily, very short", strands: 21_325, length: 6.0, fall: 0.2 },
    Style { name: "bent far, shoulder", strands: 13_991, length: 25.0, fall: 0.9 },
];

fn operators(style: usize) -> Vec<Operator> {
    let scale = |random| Operator::Scale(Scale { random });
    let clump = |profile| Operator::Clump(Clump { profile });
    let bend = |angle_degrees, start| Operator::Bend(Bend { angle_degrees, start });
    let curl = |radius, frequency, random_frequency, start| {
        Operator::Curl(Curl { radius, frequency, random_frequency, start })
    };
    let frizz = |frequency, amplitude| Operator::Frizz(Frizz { frequency, amplitude });
    match style {
        0 => vec![scale(0.15), clump(1.2), curl(0.5, 0.06, 0.01, 0.3), frizz(0.6, 0.15)],
        1 => vec![scale(0.1), clump(2.0), curl(0.9, 0.1, 0.015, 0.15), frizz(0.5, 0.2)],
        2 => vec![scale(0.4), bend(35.0, 0.3), frizz(1.5, 0.08)],
        3 => vec![scale(0.25), bend(30.0, 0.4), frizz(0.8, 0.3)],
        4 => vec![scale(0.2), clump(1.5), frizz(0.3, 0.5)],
        5 => vec![scale(0.2), clump(1.0), curl(0.35, 0.5, 0.05, 0.1)],
        _ => vec![scale(0.15), bend(100.0, 0.5), frizz(0.4, 0.2)],
    }
}

/// Parameters far off: no clump, radius half as large again, frequencies a fifth.
fn far_off(operators: &[Operator]) -> Vec<Operator> {
    let far = |operator: &Operator| match operator {
        Operator::Scale(_) => Operator::Scale(Scale { random: 0.5 }),
        Operator::Clump(_) => Operator::Clump(Clump { profile: 0.0 }),
        Operator::Bend(_) => Operator::Bend(Bend { angle_degrees: 10.0, start: 0.9 }),
        Operator::Curl(curl) => Operator::Curl(Curl {
            radius: 1.5 * curl.radius,
            frequency: curl.frequency / 5.0,
            random_frequency: 0.0,
            start: 0.8,
        }),
        Operator::Frizz(frizz) => Operator::Frizz(Frizz {
            frequency: frizz.frequency / 5.0,
            amplitude: 3.0 * frizz.amplitude,
        }),
        other => other.clone(),
    };
    operators.iter().map(far).collect()
}

/// Points spread evenly over a cap (a sunflower's spiral) and their texture coordinates: the
/// direction from above, its angle for a radius.
fn cap(count: usize) -> Roots {
    let golden = std::f64::consts::TAU * (1.0 - 2.0 / (1.0 + 5_f64.sqrt()));
    let least = -0.2;
    let (mut positions, mut uv) = (Vec::new(), Vec::new());
    for i in 0..count {
        let y = 1.0 - (i as f64 + 0.5) / count as f64 * (1.0 - least);
        let (sine, cosine) = (golden * i as f64).sin_cos();
        let r = (1.0 - y * y).sqrt();
        positions.push(HEAD * DVec3::new(r * cosine, y, r * sine));
        let angle = y.acos() / 4.0;
        uv.push([0.5 + angle * cosine, 0.5 + angle * sine]);
    }
    Roots { positions, uv: Some(uv) }
}

/// A guide from a root: along the scalp's normal, then down, swaying.
fn guide(root: DVec3, style: &Style) -> impl Iterator<Item = DVec3> {
    let normal = root.normalize();
    let step = style.length / (POINTS - 1) as f64;
    let mut x = root;
    let style = *style;
    (0..POINTS).map(move |j| {
        let here = x;
        let f = j as f64 / POINTS as f64;
        let fallen = style.fall * (1.0 - (-4.0 * f * style.length / 12.0).exp());
        let sway = |axis: DVec3, rate: f64| (0.35 * root.dot(axis) + rate * f).sin();
        let aside = DVec3::new(sway(DVec3::Z, 3.0), 0.0, sway(DVec3::X, 4.0)) * (0.25 * f);
        // Hair that falls over the head keeps clear of it.
        let out = (x / HEAD).normalize() * (1.3 * HEAD / x.length()).powi(4) * 0.4;
        let direction = normal * (1.0 - fallen) + (DVec3::NEG_Y + out) * fallen + aside;
        x += direction.normalize() * step;
        here
    })
}

/// How many known grooms there are.
pub const COUNT: usize = STYLES.len();

/// Known groom `style` of [`COUNT`], with the strands of the paper's (at most 30,000) times
/// `share`.
///
/// ```
/// use tress_procedural::synthetic::known;
///
/// let known = known(4, 0.01)?;
/// assert_eq!(known.groom.build()?.len(), 139);
/// # Ok::<(), tress_procedural::BuildError>(())
/// ```
///
/// # Errors
///
/// If `share` is so small that nothing is left.
pub fn known(style: usize, share: f64) -> Result<Known, BuildError> {
    let index = style % COUNT;
    let style = STYLES[index];
    let wanted = style.strands as f64 * share;
    let strands = (1..=style.strands).take_while(|&n| n as f64 <= wanted).last().unwrap_or(1);
    let guide_roots = cap(GUIDES);
    let mut guides = EvenStrands::zeros(GUIDES, POINTS);
    for (strand, root) in guides.points_mut().chunks_exact_mut(POINTS).zip(&guide_roots.positions) {
        strand.iter_mut().zip(guide(*root, &style)).for_each(|(x, here)| *x = here);
    }
    let mut groom = ProceduralGroom::new(guides, cap(strands))?;
    groom.guide_uv = guide_roots.uv;
    groom.instancing = Instancing::Gaussian { neighbors: NEIGHBORS, sigma: SIGMA };
    groom.seed = 11;
    groom.unit = Some(0.01);
    groom.up = Some(tress_geometry::UpAxis::Y);
    groom.chain.operators = operators(index);
    groom.assign();
    groom.draw_missing();
    let start = Chain { operators: far_off(&groom.chain.operators), ..groom.chain.clone() };
    Ok(Known { name: style.name, groom, start })
}
