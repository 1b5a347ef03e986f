//! A library of coils, ready to be laid along lines.

use glam::DVec2;
use tress_fit::{ReadSpectraError, Spectra};
use tress_geometry::Strands;
use tress_geometry::curves::hermite;

/// The spectra that ship with the crate, made by its example `default_spectra`.
const DEFAULT: &[u8] = include_bytes!("../presets/default.tress-spectra");

/// How many times finer than a spectrum's samples its offsets are kept. At five samples a turn, a
/// cubic between samples of the spectrum's own cuts a tenth off the coil; between these, 0.4 %.
const FINER: usize = 2;

/// Coils as sequences of offsets, to be read at any place.
///
/// ```
/// use tress_grow::Coils;
///
/// let coils = Coils::shipped()?;
/// assert_eq!(coils.len(), 192);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Coils {
    /// One period of each, `FINER` times as many as samples.
    offsets: Strands<DVec2>,
    /// Arc length between samples, 0 where it is not known.
    steps: Vec<f64>,
    radius: f64,
}

impl Coils {
    /// Takes a library's spectra back to offsets.
    #[must_use]
    pub fn new(spectra: &Spectra) -> Self {
        let n = spectra.len();
        let radii: f64 = (0..n).map(|i| spectra.radius(i)).sum();
        Self {
            offsets: spectra.offsets(FINER),
            steps: (0..n).map(|i| spectra.step(i)).collect(),
            radius: if n > 0 { radii / n as f64 } else { 0.0 },
        }
    }

    /// The library that ships with tress: 192 coils of random phase and hand from a generator of
    /// coily strands.
    ///
    /// Their radius and pitch wander and they are a little frizzy. They are no measured hair: no
    /// contact has bent them, and none changes its hand. Where a simulated or captured groom is at
    /// hand, a library of its own strands ([`Spectra::of`]) is the better one.
    ///
    /// # Errors
    ///
    /// If the shipped file is broken, which a test rules out.
    pub fn shipped() -> Result<Self, ReadSpectraError> {
        Ok(Self::new(&Spectra::from_bytes(DEFAULT)?))
    }

    /// How many coils there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether there are none: loose hairs then run straight.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Mean radius of all coils.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Coil `i`, made `scale` times as large; `step` is its samples' distance if its own is not
    /// known.
    pub(crate) fn coil(&self, i: usize, scale: f64, step: f64) -> Option<Coil<'_>> {
        let own = self.steps.get(i).copied()?;
        let step = if own > 0.0 { own * scale } else { step };
        let sound = 0.0 < step && 1 < self.offsets.strand(i).len();
        sound.then(|| Coil { offsets: self.offsets.strand(i), scale, rate: FINER as f64 / step })
    }
}

/// One coil, by arc length.
pub(crate) struct Coil<'a> {
    offsets: &'a [DVec2],
    scale: f64,
    /// Entries in a unit of arc length.
    rate: f64,
}

impl Coil<'_> {
    /// The offset at arc length `s`, 0 or more; past the last sample it begins again, as its
    /// transform does.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within the samples"
    )]
    pub(crate) fn at(&self, s: f64) -> DVec2 {
        let n = self.offsets.len();
        let x = (s * self.rate).max(0.0) % n as f64;
        let i = (x as usize).min(n - 1);
        let u = x - i as f64;
        let next = |i: usize| if i + 1 < n { i + 1 } else { 0 };
        let j = next(i);
        let [a, b, c, d] =
            [if i > 0 { i - 1 } else { n - 1 }, i, j, next(j)].map(|i| self.offsets[i]);
        let (m, k) = (0.5 * (c - a), 0.5 * (d - b));
        self.scale * hermite([b, c], [m, k], u)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_library_reads_and_coils() {
        let coils = Coils::shipped().expect("a whole file");
        assert!((0.4..0.7).contains(&coils.radius()), "{}", coils.radius());
        let coil = coils.coil(7, 2.0, 0.0).expect("a coil");
        let n = coil.offsets.len();
        let lengths = (0..n).map(|i| coil.at(i as f64 / coil.rate).length_squared());
        let rms = (lengths.sum::<f64>() / n as f64).sqrt();
        assert!((0.6..1.7).contains(&rms), "{rms}");
        // Round and round.
        assert!(coil.at(0.0).distance(coil.at(n as f64 / coil.rate)) < 1e-9);
        assert!(coil.at(1e300).is_finite());
    }

    #[test]
    fn an_empty_library_has_no_coils() {
        let none = Coils::new(&Spectra::default());
        assert!(none.is_empty() && none.coil(0, 1.0, 1.0).is_none());
    }
}
