//! What is known along strands: a value of each quantity for each point or joint.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::winding::Stations;
use crate::{Winding, darboux};

/// Quantities along the strands of a groom, one value a place (a point of a polyline, a joint of a
/// super-helix), strand after strand. All are finite but for strands that are no curves, where all
/// are NaN.
///
/// They are those of the coil (see [`Winding`]): what is finer than an eighth of a turn, sampling
/// and frizz, is averaged out. For a helix they are its own: `curvature = R W^2`,
/// `twist = +-W advance` and [CSE 12].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Along {
    /// Arc length from the root.
    pub arc_length: Vec<f64>,
    /// Curvature of the coil, or of the strand itself where it does not wind.
    pub curvature: Vec<f64>,
    /// Twist: positive right-handed, negative left-handed, 0 for planar waves and straight hair.
    pub twist: Vec<f64>,
    /// Coil radius; 0 where the strand does not wind.
    pub radius: Vec<f64>,
    /// Advance along the centerline in one turn, negative for left-handed coils; 0 where the
    /// strand does not wind.
    pub pitch: Vec<f64>,
    /// Turns a unit of centerline, `|omega| / 2 pi` of [CSE 12]; finite where twist vanishes
    /// (a coil is not counted as flatter than [`FLATTEST`]), 0 where the strand does not wind.
    pub frequency: Vec<f64>,
    /// Beta [CSE 14] against the centerline of the [`Winding`].
    pub beta: Vec<f64>,
    /// Beta against the published centerline, [`tress_fit::fourier_centerline`]: the same on a coil
    /// about a straight line, less where the line bends faster than that low-pass can follow.
    pub beta_fourier: Vec<f64>,
    /// 1 right-handed coil, -1 left-handed coil, 0 planar wave or straight.
    pub circularity: Vec<f64>,
    /// The centerline; of a strand that nowhere winds, the strand itself.
    pub center: Vec<DVec3>,
}

/// Least advance of a centerline a unit of arc length that frequencies are told from: a coil with
/// a hundredth of its length in its pitch would lie on itself.
pub const FLATTEST: f64 = 0.01;

/// Of a strand that does not wind, curvature is the mean over so much of its length.
const WINDOW: f64 = 1.0 / 16.0;

impl Along {
    /// The columns of numbers by name, in the order of the fields, the arc length first.
    #[must_use]
    pub fn columns(&self) -> [(&'static str, &[f64]); 9] {
        [
            ("arc_length", &self.arc_length),
            ("curvature", &self.curvature),
            ("twist", &self.twist),
            ("radius", &self.radius),
            ("pitch", &self.pitch),
            ("frequency", &self.frequency),
            ("beta", &self.beta),
            ("beta_fourier", &self.beta_fourier),
            ("circularity", &self.circularity),
        ]
    }

    fn columns_mut(&mut self) -> [&mut Vec<f64>; 9] {
        [
            &mut self.arc_length,
            &mut self.curvature,
            &mut self.twist,
            &mut self.radius,
            &mut self.pitch,
            &mut self.frequency,
            &mut self.beta,
            &mut self.beta_fourier,
            &mut self.circularity,
        ]
    }

    /// Appends the places of other strands.
    pub(crate) fn append(&mut self, mut other: Self) {
        for (all, more) in self.columns_mut().into_iter().zip(other.columns_mut()) {
            all.append(more);
        }
        self.center.append(&mut other.center);
    }

    /// Appends places of which nothing is known.
    pub(crate) fn append_unknown(&mut self, places: usize) {
        for column in self.columns_mut() {
            column.resize(column.len() + places, f64::NAN);
        }
        self.center.resize(self.center.len() + places, DVec3::NAN);
    }

    /// Of one strand at its stations.
    pub(crate) fn at_stations(stations: &Stations, winding: Option<&Winding>) -> Self {
        let n = stations.positions.len();
        let arc_length = (0..n).map(|k| stations.spacing * k as f64).collect();
        let window = WINDOW * (n - 1) as f64;
        let bend = || darboux::bend(&stations.positions, stations.spacing, window);
        let none = || vec![0.0; n];
        let Some(w) = winding else {
            return Self {
                arc_length,
                curvature: bend(),
                twist: none(),
                radius: none(),
                pitch: none(),
                frequency: none(),
                beta: none(),
                beta_fourier: none(),
                circularity: none(),
                center: stations.positions.clone(),
            };
        };
        let straight = w.rate.contains(&0.0).then(bend);
        let curvature = |k: usize| match &straight {
            Some(bend) if w.rate[k] == 0.0 => bend[k],
            _ => w.radius[k] * w.rate[k] * w.rate[k],
        };
        let pitch = |k: usize| match w.rate[k] {
            0.0 => 0.0,
            rate => (TAU * w.advance[k] / rate).copysign(w.circularity[k]),
        };
        let frequency = |k: usize| w.rate[k] / (TAU * w.advance[k].max(FLATTEST));
        let [beta, beta_fourier] = darboux::betas(&stations.positions, w);
        Self {
            arc_length,
            curvature: (0..n).map(curvature).collect(),
            twist: (0..n).map(|k| w.circularity[k] * w.rate[k] * w.advance[k]).collect(),
            radius: w.radius.clone(),
            pitch: (0..n).map(pitch).collect(),
            frequency: (0..n).map(frequency).collect(),
            beta,
            beta_fourier,
            circularity: w.circularity.clone(),
            center: w.center.clone(),
        }
    }

    /// Between the stations that these are, at other arc lengths.
    pub(crate) fn at(&self, spacing: f64, arc_lengths: &[f64]) -> Self {
        let last = self.arc_length.len() - 2;
        let place = |s: f64| {
            let x = (s / spacing).max(0.0);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held")]
            let i = (x as usize).min(last);
            (i, (x - i as f64).min(1.0))
        };
        let places: Vec<(usize, f64)> = arc_lengths.iter().map(|&s| place(s)).collect();
        let mut at = Self::default();
        for (column, (_, from)) in at.columns_mut().into_iter().zip(self.columns()) {
            column.extend(places.iter().map(|&(i, f)| from[i] + (from[i + 1] - from[i]) * f));
        }
        at.arc_length.copy_from_slice(arc_lengths);
        at.center =
            places.iter().map(|&(i, f)| self.center[i].lerp(self.center[i + 1], f)).collect();
        at
    }
}
