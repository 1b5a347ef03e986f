//! A fit, stage by stage, that can be watched, stopped and taken up again.

use std::path::Path;

use serde::{Deserialize, Serialize};
use tress_geometry::{Column, Groom, names};

use super::parameters::{LossError, ParametersError};
use super::weights::vertex_loss;
use super::{
    FlawOptions, Flaws, GuideOptions, InitialError, NumberOptions, ParameterOptions, Smoothing,
    find_flaws, fit_parameters, fit_weights, initialize, medoids, refine_guides, refine_numbers,
};
use crate::groom::spacing;
use crate::numbers::fingerprint;
use crate::{
    BuildError, Chain, EvenError, EvenStrands, FileError, Instances, Instancing, ProceduralGroom,
    Roots,
};

/// How a groom is fitted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StageOptions {
    /// Guides. Default 500.
    pub guides: usize,
    /// Operator guides, the number of curls or clumps. Default as many as guides.
    pub operator_guides: Option<usize>,
    /// Points a strand. Default the greatest number the targets have, from 16 to 160.
    pub points: Option<usize>,
    /// Guides a strand is blended from. Default 8.
    pub neighbors: usize,
    /// Whether a strand's guides are weighted as brings it nearest its target, as suits captured
    /// hair, or by the distance of roots, as grooms made by hand are. Default yes. Weights of a
    /// strand's own take up some of what scale and clump would explain.
    pub own_weights: bool,
    /// Weight of the root against the strand in clusters. Default 8: clusters are patches of scalp
    /// whose means even out what operators do; 1 gathers strands that look alike from farther off.
    pub root_weight: f64,
    /// How cluster means become guides.
    pub smoothing: Smoothing,
    /// How guides are refined.
    pub guide: GuideOptions,
    /// How the operators' parameters are found.
    pub parameters: ParameterOptions,
    /// How random numbers are refined.
    pub numbers: NumberOptions,
    /// Which strands are left out.
    pub flaws: FlawOptions,
    /// Seed of clusters, slices and random numbers. Default 0.
    pub seed: u64,
}

impl Default for StageOptions {
    fn default() -> Self {
        Self {
            guides: 500,
            operator_guides: None,
            points: None,
            neighbors: 8,
            own_weights: true,
            root_weight: 8.0,
            smoothing: Smoothing::default(),
            guide: GuideOptions::default(),
            parameters: ParameterOptions::default(),
            numbers: NumberOptions::default(),
            flaws: FlawOptions::default(),
            seed: 0,
        }
    }
}

/// What comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Stage {
    /// Clusters, smoothing, operator guides and instancing weights.
    Initialize,
    /// Guides refined.
    Guides,
    /// Parameters of the operators.
    Parameters,
    /// Random numbers of single strands.
    Numbers,
    /// Nothing.
    Done,
}

impl Stage {
    fn next(self) -> Self {
        match self {
            Self::Initialize => Self::Guides,
            Self::Guides => Self::Parameters,
            Self::Parameters => Self::Numbers,
            Self::Numbers | Self::Done => Self::Done,
        }
    }

    /// In words.
    #[must_use]
    pub fn describe(self) -> &'static str {
        match self {
            Self::Initialize => "finding guides",
            Self::Guides => "refining guides",
            Self::Parameters => "finding parameters",
            Self::Numbers => "refining random numbers",
            Self::Done => "done",
        }
    }
}

/// The loss after one step of a stage, and the parameters of all operators.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// The stage; losses of different stages do not compare.
    pub stage: Stage,
    /// The loss.
    pub loss: f64,
    /// Values of each operator's [parameters](crate::Operator::parameters).
    pub parameters: Vec<Vec<f64>>,
}

/// What is told while a fit runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The stage at work.
    pub stage: Stage,
    /// The loss now.
    pub loss: f64,
    /// How much of the stage's steps is done, 0 to 1.
    pub done: f64,
}

/// Why a fit cannot begin, go on or be taken up again.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FitterError {
    /// Fewer strands than guides, or none.
    #[error(transparent)]
    Initial(#[from] InitialError),
    /// Too few points a strand.
    #[error(transparent)]
    Even(#[from] EvenError),
    /// The loss is not a number; the groom has the last good state.
    #[error(transparent)]
    Loss(#[from] LossError),
    /// A stage failed.
    #[error(transparent)]
    Parameters(#[from] ParametersError),
    /// The groom cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A file of the checkpoint cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The checkpoint's record cannot be read or written.
    #[error("{path}: {message}")]
    Checkpoint {
        /// The file.
        path: String,
        /// What is wrong.
        message: String,
    },
    /// The checkpoint belongs to other strands or options.
    #[error("the checkpoint is of another {0}")]
    Other(&'static str),
}

/// A fit under way.
#[derive(Clone, Debug)]
pub struct Fitter {
    targets: EvenStrands,
    kept: Vec<usize>,
    flaws: Flaws,
    options: StageOptions,
    chain: Chain,
    state: State,
    groom: Option<ProceduralGroom>,
    uv: Option<Vec<[f64; 2]>>,
    space: (Option<f64>, Option<tress_geometry::UpAxis>),
}

/// What a checkpoint holds beside the groom.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct State {
    /// Of the target's points.
    target: u64,
    /// Of the options and the operators to begin with.
    options: u64,
    stage: Stage,
    history: Vec<Record>,
}

/// Names of a checkpoint's files in its folder.
const STATE: &str = "state.ron";
const GROOM: &str = "groom.ron";

impl Fitter {
    /// Begins a fit: `chain` names the operators and where their parameters begin.
    ///
    /// Strands with a [defect](tress_geometry::polyline::Defect) are left out.
    ///
    /// # Errors
    ///
    /// If there are fewer strands than guides or a parameter is out of range.
    pub fn new(target: &Groom, chain: Chain, options: StageOptions) -> Result<Self, FitterError> {
        let most = target.strands().counts().max().unwrap_or(0).clamp(16, 160);
        let points = options.points.unwrap_or(most);
        let (targets, kept) = EvenStrands::resampled(target, points)?;
        for (index, operator) in chain.operators.iter().enumerate() {
            let range = operator.check(index).map_err(crate::ChainError::from);
            range.map_err(BuildError::from)?;
        }
        let (guides, strands) = (options.guides, targets.len());
        if guides == 0 || strands < guides {
            return Err(InitialError::Count { guides, strands }.into());
        }
        let bytes: Vec<u8> =
            targets.points().iter().flat_map(|x| x.to_array()).flat_map(f64::to_le_bytes).collect();
        let state = State {
            target: fingerprint(&bytes),
            options: fingerprint(format!("{options:?} {chain:?}").as_bytes()),
            stage: Stage::Initialize,
            history: Vec::new(),
        };
        let uv = match target.strand_attributes().get(names::ROOT_UV) {
            Some(Column::Float { components: 2, values }) => {
                Some(kept.iter().map(|&i| [values[2 * i], values[2 * i + 1]]).collect())
            }
            _ => None,
        };
        let flaws = find_flaws(&targets, &options.flaws);
        let space = (target.unit, target.up);
        Ok(Self { targets, kept, flaws, options, chain, state, groom: None, uv, space })
    }

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
        std::fs::write(&path, text).map_err(|error| refused(error.to_string()))
    }

    /// What comes next.
    #[must_use]
    pub fn stage(&self) -> Stage {
        self.state.stage
    }

    /// The loss and parameters after every step so far.
    #[must_use]
    pub fn history(&self) -> &[Record] {
        &self.state.history
    }

    /// Which strands are flawed, as indices into [`Self::kept`].
    #[must_use]
    pub fn flaws(&self) -> &Flaws {
        &self.flaws
    }

    /// The strands of the target that are fitted, those without a defect.
    #[must_use]
    pub fn kept(&self) -> &[usize] {
        &self.kept
    }

    /// The target as even strands.
    #[must_use]
    pub fn targets(&self) -> &EvenStrands {
        &self.targets
    }

    /// The groom so far; none before the first stage.
    #[must_use]
    pub fn groom(&self) -> Option<&ProceduralGroom> {
        self.groom.as_ref()
    }

    /// Runs the next stage; gives what comes after it.
    ///
    /// # Errors
    ///
    /// If the stage fails. What it found before it failed is kept, and so is the stage: a loss that
    /// is not a number leaves the last good state.
    pub fn advance(&mut self, watch: &mut dyn FnMut(Progress)) -> Result<Stage, FitterError> {
        match (self.state.stage, self.groom.take()) {
            (Stage::Done, groom) => self.groom = groom,
            (Stage::Initialize, _) | (_, None) => self.groom = Some(self.initialize(watch)?),
            (stage, Some(mut groom)) => {
                let outcome = self.run(stage, &mut groom, watch);
                self.groom = Some(groom);
                outcome?;
            }
        }
        self.state.stage = self.state.stage.next();
        Ok(self.state.stage)
    }

    fn initialize(
        &mut self,
        watch: &mut dyn FnMut(Progress),
    ) -> Result<ProceduralGroom, FitterError> {
        let options = &self.options;
        let sound = self.targets.select(&self.flaws.sound);
        let initial = initialize(
            &sound,
            options.guides,
            options.root_weight,
            &options.smoothing,
            options.seed,
        )?;
        let roots = Roots { positions: self.targets.roots(), uv: self.uv.clone() };
        let guide_strands: Vec<usize> =
            initial.root_strands.iter().map(|&i| self.flaws.sound[i]).collect();
        let guide_roots = roots.select(&guide_strands);
        let sigma = spacing(&guide_roots.places(&roots));
        let near = Instances::by_distance(&guide_roots, &roots, options.neighbors, sigma);
        let instances = if options.own_weights {
            fit_weights(&initial.means, &self.targets, &near)
        } else {
            near
        };
        let strands = instances.instance(&initial.means, &roots.positions);
        let loss = vertex_loss(&strands, &self.targets);
        watch(Progress { stage: Stage::Initialize, loss, done: 1.0 });
        let count = options.operator_guides.unwrap_or(initial.guides.len());
        let mut groom = ProceduralGroom::new(initial.guides, roots)?;
        groom.operator_guides = medoids(&groom.guides, count);
        groom.guide_uv = guide_roots.uv;
        groom.assign();
        groom.chain = self.chain.clone();
        groom.seed = options.seed;
        if options.own_weights {
            groom.instancing = Instancing::Stored;
            groom.instances = Some(instances);
        } else {
            groom.instancing = Instancing::Gaussian { neighbors: options.neighbors, sigma };
        }
        (groom.unit, groom.up) = self.space;
        groom.draw_missing();
        let parameters = groom.chain.operators.iter().map(crate::Operator::values).collect();
        self.state.history.push(Record { stage: Stage::Initialize, loss, parameters });
        Ok(groom)
    }

    fn run(
        &mut self,
        stage: Stage,
        groom: &mut ProceduralGroom,
        watch: &mut dyn FnMut(Progress),
    ) -> Result<(), FitterError> {
        let (targets, sound) = (&self.targets, &self.flaws.sound);
        let history = &mut self.state.history;
        let mut values: Vec<Vec<f64>> =
            groom.chain.operators.iter().map(crate::Operator::values).collect();
        let mut step = 0.0;
        let mut note = |loss: f64, steps: f64, parameters: &[Vec<f64>]| {
            step += 1.0;
            watch(Progress { stage, loss, done: f64::min(step / steps, 1.0) });
            history.push(Record { stage, loss, parameters: parameters.to_vec() });
        };
        let options = &self.options;
        match stage {
            Stage::Guides => {
                let instances = groom.instances()?;
                let roots = groom.guide_roots();
                let steps = (options.guide.corrections + options.guide.steps) as f64;
                refine_guides(
                    &mut groom.guides,
                    &roots,
                    &instances,
                    targets,
                    sound,
                    &options.guide,
                    &mut |loss| note(loss, steps, &values),
                )?;
            }
            Stage::Parameters => {
                let count: usize = values.iter().map(Vec::len).sum();
                let found = &options.parameters;
                let steps = (found.searches * count + found.rounds * found.steps) as f64;
                let mut watch = |loss: f64, operators: &[crate::Operator]| {
                    values = operators.iter().map(crate::Operator::values).collect();
                    note(loss, steps, &values);
                };
                fit_parameters(groom, targets, sound, found, &mut watch)?;
            }
            Stage::Numbers => {
                let steps = options.numbers.steps as f64;
                let mut watch = |loss| note(loss, steps, &values);
                refine_numbers(groom, targets, sound, &options.numbers, &mut watch)?;
            }
            Stage::Initialize | Stage::Done => {}
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
