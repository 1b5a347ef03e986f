//! Quantities that strands can be coloured and plotted by.

use std::str::FromStr;

use serde::{Deserialize, Serialize};
use tress_geometry::HelixGroom;

use crate::{Along, Analysis, Hand, StrandMeasures};

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
    /// Turns a unit of centerline along a strand.
    Frequency,
    /// Advance along the centerline in one turn, negative to the left.
    Pitch,
    /// Beta [CSE 14] along a strand: 1 right-handed coil, -1 left-handed coil, 0 planar wave.
    Beta,
    /// The same against the published centerline.
    BetaFourier,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Radius,
        Self::Turns,
        Self::Length,
        Self::Handedness,
        Self::Curvature,
        Self::Twist,
        Self::Frequency,
        Self::Pitch,
        Self::Beta,
        Self::BetaFourier,
    ];

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
            Self::Frequency => "frequency",
            Self::Pitch => "pitch",
            Self::Beta => "beta",
            Self::BetaFourier => "beta-fourier",
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
            Self::Frequency => "turns a length of centerline",
            Self::Pitch => "pitch (negative left, positive right)",
            Self::Beta => "beta (-1 left, 0 planar, 1 right)",
            Self::BetaFourier => "beta, Fourier centerline (-1 left, 0 planar, 1 right)",
        }
    }

    /// The power of length in its unit: 1 for a radius, -1 for a curvature.
    #[must_use]
    pub fn length_power(self) -> i32 {
        match self {
            Self::Radius | Self::Length | Self::Pitch => 1,
            Self::Turns | Self::Handedness | Self::Beta | Self::BetaFourier => 0,
            Self::Curvature | Self::Twist | Self::Frequency => -1,
        }
    }

    /// Whether values lie on both sides of 0, which is then the middle of a scale.
    #[must_use]
    pub fn is_signed(self) -> bool {
        let signed = [Self::Handedness, Self::Twist, Self::Pitch, Self::Beta, Self::BetaFourier];
        signed.contains(&self)
    }
}

/// Why a word is no quantity.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no quantity is called {0:?}; there is: radius, turns, length, handedness, curvature, twist, \
     frequency, pitch, beta, beta-fourier"
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
    /// One a point or joint, strand after strand (see [`HelixGroom::joint_range`]).
    Joints(Vec<f64>),
}

/// The values of a quantity on a groom of super-helices, see [`Analysis::values`].
#[must_use]
pub fn quantity(groom: &HelixGroom, quantity: Quantity) -> QuantityValues {
    Analysis::of_helices(groom).values(quantity)
}

impl Analysis {
    /// The values of a quantity, by the strand or by the place (a point of a polyline, a joint of a
    /// super-helix). NaN for strands that are no curves, and for the radius of those that do not
    /// coil.
    ///
    /// ```
    /// use tress_analysis::{Analysis, Quantity, QuantityValues};
    /// use tress_geometry::{Element, Frame, HelixGroom, Strands};
    ///
    /// let coil = Element { length: 9.0, ..Element::coil(0.5, 1.0) };
    /// let elements = Strands::from_counts([2], vec![coil; 2])?;
    /// let groom = HelixGroom::new(vec![Frame::IDENTITY], elements)?;
    /// let analysis = Analysis::of_helices(&groom);
    /// let QuantityValues::Joints(beta) = analysis.values(Quantity::Beta) else { panic!() };
    /// assert_eq!(beta.len(), 3);
    /// assert!((beta[1] - 1.0).abs() < 1e-2);
    /// let QuantityValues::Strands(radius) = analysis.values(Quantity::Radius) else { panic!() };
    /// assert!((radius[0] - 0.5).abs() < 1e-2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn values(&self, quantity: Quantity) -> QuantityValues {
        match self.along.values(quantity) {
            Some(values) => QuantityValues::Joints(values.to_vec()),
            None => QuantityValues::Strands(self.by_strand(quantity)),
        }
    }

    fn by_strand(&self, quantity: Quantity) -> Vec<f64> {
        let value = |measures: &StrandMeasures| match quantity {
            Quantity::Radius => measures.coil_radius.unwrap_or(f64::NAN),
            Quantity::Turns => measures.turns,
            Quantity::Length => measures.length,
            _ => match measures.hand {
                Hand::Right => 1.0,
                Hand::Left => -1.0,
                Hand::Neither => 0.0,
            },
        };
        self.strands.iter().map(|m| m.as_ref().map_or(f64::NAN, value)).collect()
    }
}

impl Along {
    /// The column of a quantity; `None` for one that strands have as a whole.
    #[must_use]
    pub fn values(&self, quantity: Quantity) -> Option<&[f64]> {
        match quantity {
            Quantity::Curvature => Some(&self.curvature),
            Quantity::Twist => Some(&self.twist),
            Quantity::Frequency => Some(&self.frequency),
            Quantity::Pitch => Some(&self.pitch),
            Quantity::Beta => Some(&self.beta),
            Quantity::BetaFourier => Some(&self.beta_fourier),
            Quantity::Radius | Quantity::Turns | Quantity::Length | Quantity::Handedness => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use tress_geometry::{Element, Frame, Strands};

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
        let QuantityValues::Strands(hands) = quantity(&groom, Quantity::Handedness) else {
            panic!("hands are the strands'");
        };
        assert!(hands[0] < 0.0 && hands[1].is_nan());
        assert!("colour".parse::<Quantity>().is_err());
    }
}
