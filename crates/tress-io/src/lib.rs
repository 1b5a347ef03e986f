//! Grooms in and out of the files that artists use.
//!
//! [`read()`] and [`write()`] choose the format by the file's extension; each format is a module
//! whose reader takes bytes and whose writer takes a stream.
//!
//! | extension | module | what a file holds beside positions |
//! |---|---|---|
//! | `.obj` | [`obj`] | nothing; 64-bit numbers as text |
//! | `.hair` | [`hair`] | width, opacity and colour a point |
//! | `.data` | [`data`] | nothing |
//! | `.bin` | [`ct2hair`] | a normal and a label a point |
//! | `.ply` | [`ply`] | 8-bit colours a point |
//! | `.tfx` | [`tfx`] | width and texture coordinates a strand, inverse mass a point |
//! | `.npy`, `.npz` | [`npy`], [`npz`] | nothing; everything |
//! | `.tress` | [`native`] | super-helices and everything that belongs to them, bit for bit |
//! | `.usda`, `.usdc`, `.usd` | [`usd`] | everything |
//! | `.abc` | [`alembic`] | everything |
//!
//! ```
//! use glam::DVec3;
//! use tress_geometry::{Groom, Strands};
//! use tress_io::{Loss, Model, WriteOptions};
//!
//! let dir = tempfile::tempdir()?;
//! let path = dir.path().join("two.hair");
//! let strands = Strands::from_counts([2, 1], vec![DVec3::ZERO, DVec3::X, DVec3::Y])?;
//! let groom = Groom::new(strands.clone()).in_space(Some(0.01), None);
//! let lost = tress_io::write(&path, &groom, &WriteOptions::default())?;
//! assert_eq!(lost, [Loss::Unit(0.01)]);
//! let Model::Polylines(read) = tress_io::read(&path)? else { panic!("a .hair holds polylines") };
//! assert_eq!(read, Groom::new(strands));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What a strand is made of is kept as it comes: strands of no, one or two points, repeated points,
//! NaN and infinite coordinates are data, not errors, as far as the format can express them; the
//! layers above count them. A file that is cut short, too long, or at odds with itself is an
//! error that says where, and no count in a file makes a reader allocate more than the file's own
//! size accounts for. Numbers in binary files are little-endian.
//!
//! This crate knows [`Groom`](tress_geometry::Groom) and
//! [`HelixGroom`](tress_geometry::HelixGroom) as plain data; it never resamples, never fits and
//! never starts a thread.

pub mod alembic;
mod animation;
mod basis_curves;
mod binary;
mod chain;
mod columns;
mod counts;
pub mod ct2hair;
pub mod data;
mod error;
mod format;
pub mod hair;
mod loss;
pub mod mesh;
mod named;
pub mod native;
pub mod npy;
pub mod npz;
pub mod obj;
pub mod ply;
mod read;
mod text;
pub mod tfx;
pub mod unreal;
pub mod usd;
mod widths;
mod write;

pub use animation::{Animation, Frames, write_animation};
pub use error::{EncodeError, ParseError, Place, Problem, ReadError, UnknownExtension, WriteError};
pub use format::{Carries, Columns, Format};
pub use loss::{Loss, losses};
pub use read::{Model, read};
pub use write::{UsdCurves, WriteOptions, write, write_bytes, write_helices};
