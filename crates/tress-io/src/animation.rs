//! Files that hold a groom at several times: Alembic and USD.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use tress_geometry::Groom;

use crate::alembic::writer::{Names, Writer as AlembicWriter};
use crate::usd::binary::Writer as UsdWriter;
use crate::write::whole;
use crate::{
    EncodeError, Format, Loss, Model, ParseError, ReadError, WriteError, WriteOptions, alembic,
    losses, read, usd,
};

/// Frames at an even rate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Frames {
    /// The number of the first frame. Default 1.
    pub start: f64,
    /// Frames a second. Default 24.
    pub rate: f64,
}

impl Default for Frames {
    fn default() -> Self {
        Self { start: 1.0, rate: 24.0 }
    }
}

/// A file with a groom at each of several times.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Groom, Strands};
/// use tress_io::{Animation, Frames, WriteError, WriteOptions, write_animation};
///
/// let groom = |x: f64| {
///     let points = vec![DVec3::ZERO, DVec3::new(x, 1.0, 0.0)];
///     Groom::new(Strands::from_counts([2], points).expect("two points"))
/// };
/// let dir = tempfile::tempdir()?;
/// let path = dir.path().join("wind.abc");
/// let frames = Frames { start: 10.0, rate: 25.0 };
/// let grooms = [0.0, 0.5, 1.0].map(|x| Ok::<_, WriteError>(groom(x)));
/// write_animation(&path, frames, &WriteOptions::default(), grooms)?;
///
/// let animation = Animation::open(&path)?;
/// assert_eq!((animation.len(), animation.frames()), (3, frames));
/// assert_eq!(animation.read(1)?.strands(), groom(0.5).strands());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Frames are read one by one, and may be read side by side. What lies between them, and frames at
/// uneven times, are not looked at: frame `i` is the `i`th sample.
#[derive(Clone, Debug)]
pub struct Animation {
    path: PathBuf,
    contents: Contents,
}

#[derive(Clone, Debug)]
enum Contents {
    /// An archive, and the times of its samples in seconds.
    Alembic { bytes: Vec<u8>, seconds: Vec<f64> },
    /// A stage's times in its own time codes, and how many of those a second has.
    Usd { codes: Vec<f64>, rate: f64 },
    /// A file of another format, or one that does not change.
    Still(Groom),
}

impl Animation {
    /// Looks at when a file has grooms. A file that does not change has one frame.
    ///
    /// # Errors
    ///
    /// As for [`read()`](crate::read()); also if the file is a `.tress` file, which holds
    /// super-helices.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let parse = |source: ParseError| ReadError::Parse { path: path.into(), source };
        let changing = match Format::from_path(path)? {
            Format::Abc => {
                let bytes = std::fs::read(path)
                    .map_err(|source| ReadError::Open { path: path.into(), source })?;
                let seconds = alembic::times(&bytes).map_err(parse)?;
                (1 < seconds.len()).then_some(Contents::Alembic { bytes, seconds })
            }
            Format::Usda | Format::Usdc | Format::Usd => {
                let (codes, rate) = usd::times(path).map_err(parse)?;
                (1 < codes.len()).then_some(Contents::Usd { codes, rate })
            }
            _ => None,
        };
        let contents = match changing {
            Some(contents) => contents,
            None => match read(path)? {
                Model::Polylines(groom) => Contents::Still(groom),
                Model::Helices(_) => {
                    let problem = "a .tress file holds super-helices at one time".into();
                    let problem = crate::Problem::Unsupported(problem);
                    return Err(parse(problem.at(crate::Place::File)));
                }
            },
        };
        Ok(Self { path: path.into(), contents })
    }

    /// How many frames there are: at least one.
    #[expect(clippy::len_without_is_empty, reason = "there is always a frame")]
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.contents {
            Contents::Alembic { seconds, .. } => seconds.len(),
            Contents::Usd { codes, .. } => codes.len(),
            Contents::Still(_) => 1,
        }
    }

    /// The number of the first frame, and the rate, by the first two.
    #[must_use]
    pub fn frames(&self) -> Frames {
        match &self.contents {
            Contents::Usd { codes, rate } => Frames { start: codes[0], rate: *rate },
            Contents::Alembic { seconds, .. } => {
                let rate = 1.0 / (seconds[1] - seconds[0]);
                // Times are multiples of a step that is rounded.
                let near = |x: f64| if (x - x.round()).abs() < 1e-6 { x.round() } else { x };
                let rate = near(rate);
                Frames { start: near(seconds[0] * rate), rate }
            }
            Contents::Still(_) => Frames::default(),
        }
    }

    /// The groom of a frame, from 0; behind the last frame it stays as it is.
    ///
    /// # Errors
    ///
    /// If the file is broken there.
    pub fn read(&self, frame: usize) -> Result<Groom, ReadError> {
        let groom = match &self.contents {
            Contents::Alembic { bytes, .. } => alembic::read_sample(bytes, frame),
            Contents::Usd { codes, .. } => {
                usd::read_at(&self.path, codes[frame.min(codes.len() - 1)])
            }
            Contents::Still(groom) => Ok(groom.clone()),
        };
        groom.map_err(|source| ReadError::Parse { path: self.path.clone(), source })
    }
}

/// Writes grooms, one a frame, to one file: `.abc`, `.usdc` or `.usd`. Returns what of the first
/// groom the format has no place for.
///
/// Attributes are those of the first groom on every frame; counts of strands and of points may
/// change, though few tools follow.
///
/// # Errors
///
/// The first error that `grooms` gives. If the format holds one groom only, if there is no frame,
/// if a groom cannot be expressed or has other attributes than the first, or if the disk does not
/// take the file; what was there before is then as it was.
pub fn write_animation<E: From<WriteError>>(
    path: impl AsRef<Path>,
    frames: Frames,
    options: &WriteOptions,
    grooms: impl IntoIterator<Item = Result<Groom, E>>,
) -> Result<Vec<Loss>, E> {
    let path = path.as_ref();
    let format = Format::from_path(path).map_err(WriteError::from)?;
    let mut grooms = grooms.into_iter();
    let failed = |message: &str| WriteError::Encode {
        path: path.into(),
        source: EncodeError::Groom(message.into()),
    };
    let first = grooms.next().ok_or_else(|| failed("there is no frame to write"))??;
    let lost = losses(&first, format);
    let mut given: Result<(), E> = Ok(());
    // Ends at the first error of the caller, which is kept.
    let mut rest = std::iter::once(Ok(first)).chain(grooms).map_while(|groom| match groom {
        Ok(groom) => Some(groom),
        Err(error) => {
            given = Err(error);
            None
        }
    });
    let written = whole(path, |out| {
        let Some(first) = rest.next() else { return Ok(()) };
        match format {
            Format::Abc => {
                let mut writer = AlembicWriter::new(out, &first, frames, Names::Own)?;
                std::iter::once(first)
                    .chain(&mut rest)
                    .try_for_each(|groom| writer.push(&groom))?;
                writer.finish()?;
            }
            Format::Usdc | Format::Usd => {
                let mut writer = UsdWriter::new(out, &first, options.usd_curves, Some(frames))?;
                std::iter::once(first)
                    .chain(&mut rest)
                    .try_for_each(|groom| writer.push(&groom))?;
                writer.finish()?;
            }
            other => {
                return Err(EncodeError::Groom(format!(
                    "a {other} file holds one groom: write .abc or .usdc, or a file a frame"
                )));
            }
        }
        Ok(())
    });
    drop(rest);
    given?;
    written?;
    Ok(lost)
}
