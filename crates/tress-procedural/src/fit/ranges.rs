//! Where parameters may be, for strands of a certain length.

use glam::DVec3;

use super::courses::segments;
use crate::{EvenStrands, Operator};

/// The greatest clump that is looked for: tips are then within a hundredth of their distance. With
/// more, clump and scale grow without end together where guides are in error.
pub(super) const MOST_CLUMP: f64 = 5.0;
/// The greatest random scale that is looked for; with 1 some strands would have no length.
pub(super) const MOST_SCALE: f64 = 0.6;

/// A parameter that is looked for: which of which operator, and where it may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Handle {
    pub(super) operator: usize,
    pub(super) index: usize,
    pub(super) least: f64,
    pub(super) greatest: f64,
    /// Size of a step that shows.
    pub(super) step: f64,
    /// Whether candidates are spread evenly by ratio.
    pub(super) by_ratio: bool,
    /// How much more candidates its range needs than others': the loss has a narrow valley at the
    /// frequency of a curl.
    pub(super) fineness: usize,
}

/// Gives lengths and frequencies that begin at 0, where nothing else would show, a size: curls of
/// five turns a strand, frizz of ten cells.
pub(super) fn begin(operators: &mut [Operator], length: f64) {
    let unless_given = |value: &mut f64, size: f64| {
        if *value == 0.0 {
            *value = size;
        }
    };
    for operator in operators {
        match operator {
            Operator::Curl(curl) => {
                unless_given(&mut curl.radius, 0.03 * length);
                unless_given(&mut curl.frequency, 5.0 / (3.0 * length));
            }
            Operator::Frizz(frizz) => {
                unless_given(&mut frizz.amplitude, 0.01 * length);
                unless_given(&mut frizz.frequency, 10.0 / length);
            }
            _ => {}
        }
    }
}

/// The same operators with parameters of ordinary size: half of what is
/// [typical](crate::Parameter::typical), and lengths and frequencies as for those not given.
pub(super) fn ordinary(operators: &[Operator], length: f64) -> Vec<Operator> {
    let mut operators = operators.to_vec();
    for operator in &mut operators {
        let parameters = operator.parameters();
        for (parameter, value) in parameters.iter().zip(operator.values_mut()) {
            *value = if parameter.greatest.is_finite() { 0.5 * parameter.typical } else { 0.0 };
        }
    }
    begin(&mut operators, length);
    operators
}

/// The mean length of strands.
pub(super) fn mean_length(strands: &EvenStrands) -> f64 {
    let length = |strand: &[DVec3]| segments(strand).map(DVec3::length).sum::<f64>();
    strands.iter().map(length).sum::<f64>() / strands.len().max(1) as f64
}

/// Two parameters that can stand in for each other or show only together: frequency and radius of a
/// curl, angle and start of a bend, scale and clump.
pub(super) fn pairs(operators: &[Operator], handles: &[Handle]) -> Vec<[usize; 2]> {
    let find = |wanted: &dyn Fn(&Operator) -> bool, index: usize| {
        handles.iter().position(|h| wanted(&operators[h.operator]) && h.index == index)
    };
    let bend = |o: &Operator| matches!(o, Operator::Bend(_));
    let curl = |o: &Operator| matches!(o, Operator::Curl(_));
    let ends = [
        (find(&curl, 1), find(&curl, 0)),
        (find(&bend, 0), find(&bend, 1)),
        (
            find(&|o| matches!(o, Operator::Scale(_)), 0),
            find(&|o| matches!(o, Operator::Clump(_)), 0),
        ),
    ];
    ends.into_iter().filter_map(|(a, b)| Some([a?, b?])).collect()
}

/// The parameters, with ranges for strands of this mean length.
pub(super) fn handles(operators: &[Operator], length: f64, points_each: usize) -> Vec<Handle> {
    let m = points_each as f64;
    let mut handles = Vec::new();
    for (operator, o) in operators.iter().zip(0..) {
        let mut add = |index, least: f64, greatest: f64, step: f64, by_ratio| {
            let fineness = if matches!(operator, Operator::Curl(_)) && index == 1 { 3 } else { 1 };
            handles.push(Handle { operator: o, index, least, greatest, step, by_ratio, fineness });
        };
        match operator {
            Operator::Scale(_) => add(0, 0.0, MOST_SCALE, 0.01, false),
            Operator::Clump(_) => add(0, 0.05, MOST_CLUMP, 0.05, true),
            Operator::Bend(_) => {
                add(0, 0.0, 180.0, 4.0, false);
                add(1, 0.0, 1.0, 0.04, false);
            }
            Operator::Curl(_) => {
                // From a third of a turn a strand to a turn in four points; 3 omega turns a unit.
                let (few, many) = (0.1 / length, m / (12.0 * length));
                add(1, few, many, 0.01 / length, true);
                add(0, 0.002 * length, 0.25 * length, 0.002 * length, true);
                add(3, 0.0, 1.0, 0.04, false);
                add(2, 0.0, 0.5 * many, 0.02 / length, false);
            }
            Operator::Frizz(_) => {
                add(1, 0.0005 * length, 0.4 * length, 0.001 * length, true);
                add(0, 1.0 / length, m / (3.0 * length), 0.2 / length, true);
            }
            _ => {}
        }
    }
    // What shapes each strand first: scale and clump show when the rest is about right.
    handles.sort_by_key(|handle| {
        matches!(operators[handle.operator], Operator::Scale(_) | Operator::Clump(_))
    });
    handles
}

impl Handle {
    /// Its value among the operators'.
    pub(super) fn value(&self, operators: &[Operator]) -> f64 {
        operators[self.operator].values()[self.index]
    }

    /// Sets it, to the nearest value that it may have.
    pub(super) fn set(&self, operators: &mut [Operator], value: f64) {
        let clamped = value.clamp(self.least, self.greatest);
        if let Some(slot) = operators[self.operator].values_mut().into_iter().nth(self.index) {
            *slot = clamped;
        }
    }

    /// `count` values spread over its range.
    pub(super) fn spread(&self, count: usize) -> impl Iterator<Item = f64> {
        let Self { least, greatest, by_ratio, .. } = *self;
        (0..count).map(move |k| {
            let f = k as f64 / (count.max(2) - 1) as f64;
            if by_ratio && least > 0.0 {
                least * (greatest / least).powf(f)
            } else {
                least + f * (greatest - least)
            }
        })
    }

    /// The part of its range about a value: a quarter to either side, or a factor of 1.8.
    pub(super) fn about(&self, value: f64) -> Self {
        let reach = 0.25 * (self.greatest - self.least);
        let by_ratio = self.by_ratio && value > 0.0;
        let (low, high) =
            if by_ratio { (value / 1.8, value * 1.8) } else { (value - reach, value + reach) };
        Self { least: self.least.max(low), greatest: self.greatest.min(high), ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Clump, Frizz};

    #[test]
    fn sizes_of_nothing_begin_at_a_part_of_the_length() {
        let mut operators =
            vec![Operator::Frizz(Frizz::default()), Operator::Clump(Clump { profile: 0.0 })];
        begin(&mut operators, 20.0);
        assert_eq!(operators[0], Operator::Frizz(Frizz { frequency: 0.5, amplitude: 0.2 }));
        assert_eq!(operators[1], Operator::Clump(Clump { profile: 0.0 }));
    }

    #[test]
    fn values_are_spread_over_the_range_by_ratio_or_evenly() {
        let by_ratio = Handle {
            operator: 0,
            index: 0,
            least: 1.0,
            greatest: 16.0,
            step: 1.0,
            by_ratio: true,
            fineness: 1,
        };
        let near = |a: Vec<f64>, b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near(by_ratio.spread(3).collect(), [1.0, 4.0, 16.0]));
        let about = by_ratio.about(10.0);
        assert!((about.least - 10.0 / 1.8).abs() < 1e-12);
        assert!((about.greatest - 16.0).abs() < 1e-12);
        let even = Handle { by_ratio: false, ..by_ratio };
        assert!(near(even.spread(3).collect(), [1.0, 8.5, 16.0]));
        let mut operators = [Operator::Clump(Clump { profile: 0.0 })];
        even.set(&mut operators, 20.0);
        assert!((even.value(&operators) - 16.0).abs() < 1e-12);
    }
}
