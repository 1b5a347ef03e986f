//! A fit kept in a folder, to be taken up again.
//!
//! The folder holds the procedural groom so far and a record of which stage comes next, of all
//! losses, and of what the fit is of: fingerprints of the target's points, of the head's and of the
//! options.

use std::path::Path;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_geometry::Groom;

use super::{Fitter, FitterError, Record, Stage, StageOptions};
use crate::file::write_whole;
use crate::numbers::fingerprint;
use crate::{Chain, EvenStrands, ProceduralGroom};

/// What a checkpoint holds beside the groom.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct State {
    /// Of the target's points.
    pub(super) target: u64,
    /// Of the options and the operators to begin with.
    pub(super) options: u64,
    /// Of the head's points, where one was given.
    pub(super) head: Option<u64>,
    pub(super) stage: Stage,
    /// How often guides and parameters have been found.
    pub(super) round: usize,
    pub(super) history: Vec<Record>,
}

impl State {
    pub(super) fn new(targets: &EvenStrands, chain: &Chain, options: &StageOptions) -> Self {
        Self {
            target: fingerprint_of(targets.points()),
            options: fingerprint(format!("{options:?} {chain:?}").as_bytes()),
            head: None,
            stage: Stage::Initialize,
            round: 0,
            history: Vec::new(),
        }
    }

    /// The stage that was next is done.
    pub(super) fn advance(&mut self, alternations: usize) {
        self.stage = match self.stage {
            Stage::Initialize => Stage::Guides,
            Stage::Guides => Stage::Parameters,
            Stage::Parameters if self.round < alternations => {
                self.round += 1;
                Stage::Guides
            }
            Stage::Parameters => Stage::Numbers,
            Stage::Numbers | Stage::Done => Stage::Done,
        };
    }
}

/// A fingerprint of points.
pub(super) fn fingerprint_of(points: &[DVec3]) -> u64 {
    let bytes: Vec<u8> =
        points.iter().flat_map(|x| x.to_array()).flat_map(f64::to_le_bytes).collect();
    fingerprint(&bytes)
}

/// Names of a checkpoint's files in its folder.
const STATE: &str = "state.ron";
const GROOM: &str = "groom.ron";

impl Fitter {
    /// Takes up the fit that was saved in a folder.
    ///
    /// # Errors
    ///
    /// As [`Self::new`], and if the checkpoint cannot be read or is of another target, or of other
    /// options or operators.
    pub fn resume(
        folder: &Path,
        target: &Groom,
        chain: Chain,
        options: StageOptions,
    ) -> Result<Self, FitterError> {
        let mut fitter = Self::new(target, chain, options)?;
        let path = folder.join(STATE);
        let refused =
            |message: String| FitterError::Checkpoint { path: path.display().to_string(), message };
        let text = std::fs::read_to_string(&path).map_err(|error| refused(error.to_string()))?;
        let state: State = ron::from_str(&text).map_err(|error| refused(error.to_string()))?;
        if state.target != fitter.state.target {
            return Err(FitterError::Other("target"));
        }
        if state.options != fitter.state.options {
            return Err(FitterError::Other("set of options or operators"));
        }
        if state.stage != Stage::Initialize {
            fitter.groom = Some(ProceduralGroom::read(&folder.join(GROOM))?);
        }
        fitter.state = state;
        Ok(fitter)
    }

    /// Saves the fit in a folder, which is made if it is not there.
    ///
    /// # Errors
    ///
    /// If a file cannot be written.
    pub fn save(&self, folder: &Path) -> Result<(), FitterError> {
        let path = folder.join(STATE);
        let refused =
            |message: String| FitterError::Checkpoint { path: path.display().to_string(), message };
        std::fs::create_dir_all(folder).map_err(|error| refused(error.to_string()))?;
        if let Some(groom) = &self.groom {
            groom.write(&folder.join(GROOM))?;
        }
        let text = ron::to_string(&self.state).map_err(|error| refused(error.to_string()))?;
        Ok(write_whole(&path, text.as_bytes())?)
    }
}
