//! Quantities that strands can be coloured and plotted by.

use std::str::FromStr;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::{Element, HelixGroom};

use crate::{Hand, measure, smoothed};

/// A quantity of strands or of places along them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Coil radius of a strand, in units of length.
    Radius,
    /// Turns of a strand from root to tip.
    Turns,
    /// Arc length of a strand.
    Length,
    /// Hand of a strand: 1 right, -1 left, 0 neither.
    Handedness,
    /// Curvature along a strand, in one over length.
    Curvature,
    /// Twist (torsion) along a strand, in one over length, positive to the right.
    Twist,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Radius, Self::Turns, Self::Length, Self::Handedness, Self::Curvature, Self::Twist];

    /// The name by which it is asked for.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Radius => "radius",
            Self::Turns => "turns",
            Self::Length => "length",
            Self::Handedness => "handedness",
            Self::Curvature => "curvature",
            Self::Twist => "twist",
        }
    }

    /// What a picture says it shows.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Radius => "coil radius",
            Self::Turns => "turns from root to tip",
            Self::Length => "arc length",
            Self::Handedness => "hand (-1 left, 1 right)",
            Self::Curvature => "curvature",
            Self::Twist => "twist (negative left, positive right)",
        }
    }

    /// The power of length in its unit: 1 for a radius, -1 for a curvature.
    #[must_use]
    pub fn length_power(self) -> i32 {
        match self {
            Self::Radius | Self::Length => 1,
            Self::Turns | Self::Handedness => 0,
            Self::Curvature | Self::Twist => -1,
        }
    }

    /// Whether values lie on both sides of 0, which is then the middle of a scale.
    #[must_use]
    pub fn is_signed(self) -> bool {
        matches!(self, Self::Handedness | Self::Twist)
    }
}

/// Why a word is no quantity.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no quantity is called {0:?}; there is: radius, turns, length, handedness, curvature, twist"
)]
pub struct UnknownQuantity(pub String);

impl FromStr for Quantity {
    type Err = UnknownQuantity;
    fn from_str(text: &str) -> Result<Self, UnknownQuantity> {
        let named = Self::ALL.into_iter().find(|quantity| quantity.name() == text);
        named.ok_or_else(|| UnknownQuantity(text.into()))
    }
}

/// The values of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub enum QuantityValues {
    /// One a strand.
    Strands(Vec<f64>),
    /// One a joint, strand after strand (see [`HelixGroom::joint_range`]).
    Joints(Vec<f64>),
}

/// The values of a quantity on a groom; NaN for strands that have none, such as the radius of a
/// straight strand and everything of strands kept as polylines.
///
/// ```
/// use tress_analysis::{Quantity, QuantityValues, quantity};
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
///
/// let element = |k2| Element { curvature: [0.0, 0.0, k2].into(), length: 1.0 };
/// let elements = Strands::from_counts([2], vec![element(1.0), element(3.0)])?;
/// let groom = HelixGroom::new(vec![Frame::IDENTITY], elements)?;
/// let values = quantity(&groom, Quantity::Curvature);
/// // Curvatures are averaged over a turn; this strand turns less than once.
/// assert_eq!(values, QuantityValues::Joints(vec![2.0, 2.0, 2.0]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn quantity(groom: &HelixGroom, quantity: Quantity) -> QuantityValues {
    match quantity {
        Quantity::Curvature => QuantityValues::Joints(joints(groom, Element::bending)),
        Quantity::Twist => QuantityValues::Joints(joints(groom, Element::twist)),
        _ => QuantityValues::Strands(strands(groom, quantity)),
    }
}

fn strands(groom: &HelixGroom, quantity: Quantity) -> Vec<f64> {
    let value = |i: usize| {
        if groom.kept_polyline(i).is_some() {
            return f64::NAN;
        }
        let measures = measure(&groom.strand(i));
        match quantity {
            Quantity::Radius => measures.coil_radius.unwrap_or(f64::NAN),
            Quantity::Turns => measures.turns,
            Quantity::Length => measures.length,
            _ => match measures.hand {
                Hand::Right => 1.0,
                Hand::Left => -1.0,
                Hand::Neither => 0.0,
            },
        }
    };
    (0..groom.len()).into_par_iter().map(value).collect()
}

/// At each joint the mean of the two elements that meet there, their curvatures averaged over a
/// turn, so that what is shown is the coil and not its sampling.
fn joints(groom: &HelixGroom, value: impl Fn(&Element) -> f64) -> Vec<f64> {
    let mut values = Vec::with_capacity(groom.elements().points().len() + groom.len());
    for elements in groom.elements().iter().map(smoothed) {
        let (Some(first), Some(last)) = (elements.first(), elements.last()) else {
            values.push(f64::NAN);
            continue;
        };
        values.push(value(first));
        values.extend(elements.windows(2).map(|pair| 0.5 * (value(&pair[0]) + value(&pair[1]))));
        values.push(value(last));
    }
    values
}

#[cfg(test)]
mod tests {
    use tress_geometry::{Frame, Strands};

    use super::*;

    #[test]
    fn every_quantity_is_found_by_its_name_and_has_a_value_for_each_place() {
        let coil = Element { length: 9.0, ..Element::coil(0.5, -1.0) };
        let elements = Strands::from_counts([1, 0], vec![coil]).expect("one element");
        let groom = HelixGroom::new(vec![Frame::IDENTITY; 2], elements).expect("two roots");
        for of in Quantity::ALL {
            assert_eq!(of.name().parse(), Ok(of));
            match quantity(&groom, of) {
                QuantityValues::Strands(values) => assert_eq!(values.len(), 2),
                QuantityValues::Joints(values) => {
                    assert_eq!(values.len(), 3);
                    assert!(values[2].is_nan() && values[0].is_finite());
                }
            }
        }
        assert_eq!(
            quantity(&groom, Quantity::Handedness),
            QuantityValues::Strands(vec![-1.0, 0.0])
        );
        assert!("colour".parse::<Quantity>().is_err());
    }
}
