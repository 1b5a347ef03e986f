//! Alembic curves in Ogawa archives (`.abc`), written and read.
//!
//! Knows curves and nothing of what they are curves of. Written are positions, counts, widths,
//! texture coordinates, any geometry parameters, user properties, transforms above the curves,
//! instances, and samples over time ([`Archive`]). Read are the objects and properties of any
//! archive, with their samples ([`Reader`]); what they mean is left to the caller.
//!
//! ```
//! use std::io::Cursor;
//! use tress_alembic::{Archive, CurvesSample, Kind, Numbers, Parameter, Scope, Values};
//!
//! let mut archive = Archive::new(Cursor::new(Vec::new()), "an example")?;
//! let time = archive.add_time(1.0 / 24.0, 1.0 / 24.0);
//! let head = archive.add_transform(archive.top(), "head", None)?;
//! archive.set_user_property(head, "made_by", Values::scalars(Numbers::Text(&["hand"])))?;
//! let hair = archive.add_curves(head, "hair", Kind::Linear, time)?;
//! for height in [0.5, 1.0] {
//!     let points = [[0.0, 0.0, 0.0], [0.0, height, 0.0], [1.0, 0.0, 0.0], [1.0, height, 0.0]];
//!     let ids = Parameter::new("id", Scope::Uniform, Values::scalars(Numbers::I32(&[7, 8])));
//!     let sample = CurvesSample {
//!         points: &points,
//!         counts: &[2, 2],
//!         widths: Some((Scope::Constant, &[0.1])),
//!         uvs: None,
//!         parameters: &[ids],
//!     };
//!     archive.write_curves(hair, &sample)?;
//! }
//! let bytes = archive.finish()?.into_inner();
//! assert!(bytes.starts_with(b"Ogawa\xff"));
//! # Ok::<(), tress_alembic::Error>(())
//! ```
//!
//! # What readers make of it
//!
//! Linear curves carry the basis `kNoBasis`: what the C++ library writes when nothing is said
//! (`kBezierBasis`) makes Blender's importer take every third point only. Bounds are written with
//! each sample. Equal samples are stored once, whatever properties they belong to, so an attribute
//! that does not change costs nothing in a sequence.
//!
//! # The file
//!
//! | from the bottom up | module |
//! |---|---|
//! | a tree of groups and data, each a length and its contents | `chunks` |
//! | 128-bit digests by which readers' caches know samples again | `digest` |
//! | values over time, and properties that hold them | `samples`, `property` |
//! | objects, the schemas `AbcGeom_Xform_v3` and `AbcGeom_Curve_v2` | `object`, `schema` |
//! | the arrays of a sample of curves | `curves` |
//! | header, time samplings, texts that headers share | `archive`, `texts` |
//!
//! The layout is that of Alembic 1.8's `AbcCoreOgawa`, followed byte by byte in archives of the C++
//! library. One thing differs: the digests of whole objects are made with `MurmurHash3`, as those
//! of samples, where that library uses `SpookyHash`. Readers compare them with each other only.

mod archive;
mod chunks;
mod curves;
mod digest;
mod error;
mod object;
mod property;
mod read;
mod samples;
mod schema;
mod texts;
mod values;

pub use archive::{Archive, Object, Time};
pub use error::Error;
pub use read::{MetaData, Property, ReadError, ReadObject, Reader, Sample};
pub use schema::{CurvesSample, Kind, Parameter, Scope};
pub use values::{Numbers, Values};
