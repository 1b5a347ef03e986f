//! Edits in curvature space.
//!
//! An edit takes super-helices and gives super-helices; positions follow. Every edit keeps the
//! number and order of strands, passes strands that are kept as polylines through, and draws its
//! random numbers from one stream a strand, so that the result depends on the seed alone.
//!
//! | function | what it does | source |
//! |---|---|---|
//! | [`ruffle`] | swaps elements between strands of a group | [CSE 4.3.1] |
//! | [`blend`], [`blend_positions`] | a groom between two grooms | [CSE Fig. 9] |
//! | [`recoil`] | tighter or looser, wider or narrower coils | [CSE 12] |
//! | [`groups`] | which strands belong together | [CSE 5.3] |

mod blend;
mod grouping;
mod random;
mod recoil;
mod ruffle;

pub use blend::{BlendError, BlendSpace, blend, blend_positions};
pub use grouping::{GroupError, Grouping, groups};
pub use random::strand_rng;
pub use recoil::{RecoilError, RecoilKeep, RecoilOptions, recoil};
pub use ruffle::{RuffleError, RuffleOptions, RuffleReport, ruffle};
