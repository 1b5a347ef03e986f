//! How wide strands are from root to tip.
//!
//! Strands of a procedural groom share one profile: widths at places even from root to tip, linear
//! between. Three places tell a hair that tapers; five follow whatever real grooms do.

use tress_geometry::{Column, Groom, names};

/// Places of a profile that is read off strands.
const PLACES: usize = 5;
/// Widths that differ by less, as a part of the greatest, are one.
const SAME: f64 = 1e-3;

/// The mean profile of a groom's strands: five widths, one where strands are as wide at the
/// tip as at the root, none where the groom has no widths.
pub(crate) fn of(groom: &Groom) -> Vec<f64> {
    let mut sums = [(0.0, 0.0); PLACES];
    let mut add = |place: usize, width: f64| {
        if width.is_finite() && 0.0 <= width {
            sums[place].0 += width;
            sums[place].1 += 1.0;
        }
    };
    if let Some(column) = groom.point_attributes().get(names::WIDTH) {
        let widths: Vec<f64> = column.first_components().collect();
        for i in 0..groom.strands().len() {
            let own = &widths[groom.strands().range(i)];
            for place in (0..PLACES).filter(|_| !own.is_empty()) {
                add(place, at(own, place as f64 / (PLACES - 1) as f64));
            }
        }
    } else if let Some(column) = groom.strand_attributes().get(names::WIDTH) {
        column.first_components().for_each(|width| (0..PLACES).for_each(|place| add(place, width)));
    }
    let profile: Vec<f64> = sums.iter().filter(|s| 0.0 < s.1).map(|(sum, n)| sum / n).collect();
    let greatest = profile.iter().copied().fold(0.0, f64::max);
    if profile.iter().all(|width| greatest - width <= SAME * greatest) {
        return profile.into_iter().take(1).collect();
    }
    profile
}

/// A column for `strands` strands of `points` points each that all have this profile.
///
/// # Panics
///
/// If the profile is empty.
pub(crate) fn column(profile: &[f64], strands: usize, points: usize) -> Column {
    let last = points.max(2) - 1;
    let one: Vec<f64> = (0..points).map(|j| at(profile, j as f64 / last as f64)).collect();
    Column::scalar(one.repeat(strands))
}

/// A profile at a part of the way from root to tip, linear between its places.
fn at(profile: &[f64], part: f64) -> f64 {
    let last = profile.len() - 1;
    let place = part * last as f64;
    let left = (0..last).take_while(|&k| (k + 1) as f64 <= place).count();
    let (a, b) = (profile[left], profile[usize::min(left + 1, last)]);
    a + (b - a) * (place - left as f64)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use tress_geometry::Strands;

    use super::*;

    /// Strands of 9, 3 and 0 points as wide as `width` says.
    fn groom(width: impl Fn(f64) -> f64) -> Groom {
        let counts = [9, 3, 0];
        let strands = Strands::from_counts(counts, vec![DVec3::ZERO; 12]).expect("12 points");
        let part = |n: usize| (0..n).map(move |j| j as f64 / (n as f64 - 1.0));
        let widths = counts.into_iter().flat_map(part).map(width).collect();
        let mut groom = Groom::new(strands);
        groom.insert_point_attribute(names::WIDTH, Column::scalar(widths)).expect("12 widths");
        groom
    }

    #[test]
    fn a_taper_comes_back_at_any_number_of_points() {
        let taper = groom(|part| 0.08 - 0.06 * part);
        let profile = of(&taper);
        assert_eq!(profile.len(), PLACES);
        let Column::Float { values, .. } = column(&profile, 2, 4) else { panic!("numbers") };
        for (value, expected) in values.iter().zip([0.08, 0.06, 0.04, 0.02].repeat(2)) {
            assert!((value - expected).abs() < 1e-12, "{value}, expected {expected}");
        }
        assert_eq!(values.len(), 8);
    }

    #[test]
    fn one_width_is_one_number() {
        assert_eq!(of(&groom(|_| 0.05)), [0.05]);
        let mut own = Groom::new(groom(|_| 0.0).strands().clone());
        let widths = Column::scalar(vec![1.0, f64::NAN, 3.0]);
        own.insert_strand_attribute(names::WIDTH, widths).expect("3 widths");
        assert_eq!(of(&own), [2.0]);
        assert_eq!(column(&[2.0], 1, 3), Column::scalar(vec![2.0; 3]));
    }

    #[test]
    fn grooms_without_widths_have_no_profile() {
        let bare = Groom::new(groom(|_| 0.0).strands().clone());
        assert_eq!(of(&bare), [0.0; 0]);
        assert_eq!(of(&groom(|_| f64::NAN)), [0.0; 0]);
    }
}
