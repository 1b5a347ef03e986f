//! What the curvatures of a groom say: coil radius, turns, handedness, defects, clusters.
//!
//! Numbers come from super-helices, so they have units and do not depend on how finely a strand
//! was sampled, as curvatures measured on polylines do.
//!
//! ```
//! use tress_analysis::summarize;
//! use tress_geometry::{Element, Frame, HelixGroom, Strands};
//!
//! // One left-handed coil of radius 0.5, pitch 1, ten units long.
//! let coil = Element { length: 10.0, ..Element::coil(0.5, -1.0) };
//! let groom = HelixGroom::new(vec![Frame::IDENTITY], Strands::from_counts([1], vec![coil])?)?;
//! let summary = summarize(&groom);
//! assert_eq!((summary.left_handed, summary.right_handed), (1, 0));
//! assert!((summary.coil_radius.expect("it is coiled").median - 0.5).abs() < 5e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! This crate never reads a file; randomness comes from a seed that the caller gives.

mod agreement;
mod along;
mod analysis;
mod cluster;
mod compare;
mod darboux;
mod defects;
mod quantiles;
mod quantity;
mod smoothed;
mod spectrum;
mod strand;
mod summary;
mod switchback;
mod winding;
mod wisps;

pub use agreement::adjusted_rand;
pub use along::{Along, FLATTEST};
pub use analysis::Analysis;
pub use cluster::{ClusterError, Clusters, k_means, root_tip_features};
pub use compare::{
    ByIndex, Comparison, Distances, Distributions, compare, discrete_frechet, nearest_distances,
    wasserstein, wasserstein_of_shares,
};
pub use defects::{Defects, LONG_SEGMENT, defects};
pub use quantiles::Quantiles;
pub use quantity::{Quantity, QuantityValues, UnknownQuantity, quantity};
pub use smoothed::smoothed;
pub use spectrum::Spectrum;
pub use strand::{Hand, StrandMeasures, measure};
pub use summary::{GroomSummary, summarize};
pub use switchback::{Switchback, switchbacks};
pub use winding::Winding;
pub use wisps::Wisps;
