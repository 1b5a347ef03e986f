//! A whole groom at once: every strand measured, and what is known along them.

use rayon::prelude::*;
use tress_geometry::{Groom, HelixGroom};

use crate::along::Along;
use crate::spectrum::Spectrum;
use crate::winding::{Spectra, Stations};
use crate::{GroomSummary, StrandMeasures, Switchback, Winding, switchbacks};

/// What there is to know of a groom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Analysis {
    /// One a strand; `None` for those that are no curves.
    pub strands: Vec<Option<StrandMeasures>>,
    /// Values along the strands, one a point (or one a joint, of super-helices).
    pub along: Along,
    /// All changes of hand, strand by strand.
    pub switchbacks: Vec<Switchback>,
    /// Power of the strands' directions by spatial frequency.
    pub spectrum: Spectrum,
}

/// Strands that one task works on.
const CHUNK: usize = 32;

impl Analysis {
    /// Of polylines, through whose points smooth curves are laid.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_analysis::Analysis;
    /// use tress_geometry::{Groom, Strands};
    ///
    /// // Six turns of a planar wave, and a straight strand.
    /// let wave = (0..=72).map(|i| DVec3::new(0.1, 0.0, 0.0) * f64::from(i)
    ///     + DVec3::Y * 0.3 * (f64::from(i) * std::f64::consts::TAU / 12.0).sin());
    /// let mut strands = Strands::default();
    /// strands.push(wave)?;
    /// strands.push([DVec3::ZERO, DVec3::X])?;
    /// let analysis = Analysis::of(&Groom::new(strands));
    /// let wave = analysis.strands[0].expect("a curve");
    /// assert!((wave.turns - 6.0).abs() < 0.8 && wave.is_wave());
    /// assert_eq!(analysis.strands[1].expect("a curve").turns, 0.0);
    /// assert_eq!(analysis.along.radius.len(), 75);
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[must_use]
    pub fn of(groom: &Groom) -> Self {
        Self::in_chunks(groom.strands().len(), |part, i, spectra| {
            let points = groom.strands().strand(i);
            match Stations::through(points) {
                Some((stations, arc_lengths)) => part.add(i, &stations, &arc_lengths, spectra),
                None => part.add_unknown(points.len()),
            }
        })
    }

    /// Of super-helices, whose places are their joints.
    #[must_use]
    pub fn of_helices(groom: &HelixGroom) -> Self {
        Self::in_chunks(groom.len(), |part, i, spectra| {
            let strand = groom.strand(i);
            let mut s = 0.0;
            let joints = strand.elements.iter().map(|element| {
                s += element.length;
                s
            });
            let arc_lengths: Vec<f64> = std::iter::once(0.0).chain(joints).collect();
            match Stations::of(&strand).filter(|_| groom.kept_polyline(i).is_none()) {
                Some(stations) => part.add(i, &stations, &arc_lengths, spectra),
                None => part.add_unknown(arc_lengths.len()),
            }
        })
    }

    /// Distributions over the strands.
    #[must_use]
    pub fn summary(&self) -> GroomSummary {
        GroomSummary::of(&self.strands)
    }

    fn in_chunks(n: usize, add: impl Fn(&mut Self, usize, &mut Spectra) + Sync) -> Self {
        let parts: Vec<Self> = (0..n.div_ceil(CHUNK))
            .into_par_iter()
            .map_init(Spectra::default, |spectra, chunk| {
                let mut part = Self::default();
                for i in chunk * CHUNK..n.min((chunk + 1) * CHUNK) {
                    add(&mut part, i, spectra);
                }
                part
            })
            .collect();
        let mut whole = Self::default();
        for part in parts {
            whole.strands.extend(part.strands);
            whole.along.append(part.along);
            whole.switchbacks.extend(part.switchbacks);
            whole.spectrum.append(&part.spectrum);
        }
        whole
    }

    fn add(&mut self, i: usize, stations: &Stations, places: &[f64], spectra: &mut Spectra) {
        let winding = Winding::with(stations, spectra);
        let (power, length) = stations.tangent_power(spectra);
        self.spectrum.add(power, length);
        let ends = [0, stations.positions.len() - 1].map(|end| stations.positions[end]);
        let measures = match &winding {
            Some(winding) => StrandMeasures::of(stations, winding, power),
            None => StrandMeasures::straight(length, ends[0].distance(ends[1])),
        };
        if let Some(winding) = &winding {
            self.switchbacks.extend(switchbacks(winding, i));
        }
        self.strands.push(Some(measures));
        let along = Along::at_stations(stations, winding.as_ref());
        self.along.append(along.at(stations.spacing, places));
    }

    fn add_unknown(&mut self, places: usize) {
        self.strands.push(None);
        self.along.append_unknown(places);
    }
}

#[cfg(test)]
mod tests;
