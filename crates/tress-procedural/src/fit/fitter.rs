//! A fit, stage by stage, that can be watched, stopped and taken up again.

use tress_geometry::polyline::defect;
use tress_geometry::{Column, Groom, Mesh, UpAxis, names};

use super::checkpoint::{State, fingerprint_of};
use super::courses::courses;
use super::guides::even_out;
use super::weights::{fit_sigma, vertex_loss};
use super::{
    Flaws, InitialError, Progress, Record, Smoothing, Stage, StageError, StageOptions, avoid_head,
    find_flaws, fit_parameters, fit_weights, initialize, medoids, refine_guides, refine_numbers,
};
use crate::groom::spacing;
use crate::{
    BuildError, Chain, EvenError, EvenStrands, FileError, Instances, Instancing, Operator,
    ProceduralGroom, Roots, widths,
};

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
    /// A stage failed, by a loss that is not a number for one; the groom has the last good state.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// An operator that parameters cannot be found for: recoil, ruffle, switchback and skip.
    #[error(
        "{operator} {index} has no derivative and cannot be fitted: leave it out, and put it into \
         the groom's file afterwards"
    )]
    Operator {
        /// The operator's name.
        operator: &'static str,
        /// Which operator of the chain, from 0.
        index: usize,
    },
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
    /// The lines that the targets coil about, where the chain curls.
    courses: Option<EvenStrands>,
    kept: Vec<usize>,
    flaws: Flaws,
    options: StageOptions,
    chain: Chain,
    pub(super) state: State,
    pub(super) groom: Option<ProceduralGroom>,
    uv: Option<Vec<[f64; 2]>>,
    space: (Option<f64>, Option<UpAxis>),
    widths: Vec<f64>,
    head: Option<Mesh>,
}

impl Fitter {
    /// Begins a fit: `chain` names the operators and where their parameters begin.
    ///
    /// Strands with a [defect](tress_geometry::polyline::Defect) are left out.
    ///
    /// # Errors
    ///
    /// If there are fewer strands than guides, a parameter is out of range or an operator has no
    /// derivative.
    pub fn new(target: &Groom, chain: Chain, options: StageOptions) -> Result<Self, FitterError> {
        let most = target.strands().counts().max().unwrap_or(0).clamp(16, 160);
        let points = options.points.unwrap_or(most);
        let (targets, kept) = even(target, points)?;
        for (index, operator) in chain.operators.iter().enumerate() {
            let range = operator.check(index).map_err(crate::ChainError::from);
            range.map_err(BuildError::from)?;
            if !operator.is_differentiable() {
                return Err(FitterError::Operator { operator: operator.name(), index });
            }
        }
        let (guides, strands) = (options.guides, targets.len());
        if guides == 0 || strands < guides {
            return Err(InitialError::Count { guides, strands }.into());
        }
        let uv = match target.strand_attributes().get(names::ROOT_UV) {
            Some(Column::Float { components: 2, values }) => {
                Some(kept.iter().map(|&i| [values[2 * i], values[2 * i + 1]]).collect())
            }
            _ => None,
        };
        let state = State::new(&targets, &chain, &options);
        let flaws = find_flaws(&targets, &options.flaws);
        let curls = chain.operators.iter().any(|operator| matches!(operator, Operator::Curl(_)));
        Ok(Self {
            courses: curls.then(|| courses(&targets)),
            space: (target.unit, target.up),
            widths: widths::of(target),
            groom: None,
            head: None,
            targets,
            kept,
            flaws,
            options,
            chain,
            state,
            uv,
        })
    }

    /// The head that hair grows on, in the target's unit: no strand is given to an operator guide
    /// that would [draw it through](super::avoid_head). It counts when guides are found, in the
    /// first stage.
    ///
    /// # Errors
    ///
    /// If guides were found already, with another head or without one.
    pub fn set_head(&mut self, head: Mesh) -> Result<(), FitterError> {
        let points = fingerprint_of(head.positions());
        if self.state.stage != Stage::Initialize && self.state.head != Some(points) {
            return Err(FitterError::Other("head"));
        }
        self.head = Some(head);
        Ok(())
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
        self.state.advance(self.options.alternations);
        Ok(self.state.stage)
    }

    /// What guides are found for.
    fn courses(&self) -> &EvenStrands {
        self.courses.as_ref().unwrap_or(&self.targets)
    }

    fn initialize(
        &mut self,
        watch: &mut dyn FnMut(Progress),
    ) -> Result<ProceduralGroom, FitterError> {
        let (courses, sound, options) = (self.courses(), &self.flaws.sound, &self.options);
        let StageOptions { guides, root_weight, smoothing, seed, .. } = options;
        let strands = courses.select(sound);
        let mut initial = initialize(&strands, *guides, *root_weight, smoothing, *seed)?;
        if bends(&self.chain.operators) {
            initial.restore_lengths(&strands, smoothing);
        }
        let roots = Roots { positions: self.targets.roots(), uv: self.uv.clone() };
        let guide_strands: Vec<usize> = initial.root_strands.iter().map(|&i| sound[i]).collect();
        let guide_roots = roots.select(&guide_strands);
        let neighbors = options.neighbors;
        let spacing = spacing(&guide_roots.places(&roots));
        let by_distance = |sigma| Instances::by_distance(&guide_roots, &roots, neighbors, sigma);
        let (sigma, instances) = if options.own_weights {
            (spacing, fit_weights(&initial.means, courses, &by_distance(spacing)))
        } else {
            fit_sigma(&initial.means, courses, spacing, by_distance)
        };
        let strands = instances.instance(&initial.means, &roots.positions);
        let loss = vertex_loss(&strands, courses);
        let mut groom = ProceduralGroom::new(initial.guides, roots)?;
        groom.operator_guides =
            medoids(&groom.guides, options.operator_guides.unwrap_or(groom.guides.len()));
        groom.guide_uv = guide_roots.uv;
        groom.assign();
        groom.chain = self.chain.clone();
        groom.seed = options.seed;
        if options.own_weights {
            groom.instancing = Instancing::Stored;
            groom.instances = Some(instances);
        } else {
            groom.instancing = Instancing::Gaussian { neighbors, sigma };
        }
        (groom.unit, groom.up) = self.space;
        groom.widths.clone_from(&self.widths);
        if let Some(head) = &self.head {
            avoid_head(&mut groom, head)?;
        }
        groom.draw_missing();
        self.state.head = self.head.as_ref().map(|head| fingerprint_of(head.positions()));
        let mut note = note(&mut self.state.history, Stage::Initialize, 1, watch);
        note(loss, &groom.chain.operators);
        Ok(groom)
    }

    fn run(
        &mut self,
        stage: Stage,
        groom: &mut ProceduralGroom,
        watch: &mut dyn FnMut(Progress),
    ) -> Result<(), StageError> {
        let (targets, sound, options) = (&self.targets, &self.flaws.sound, &self.options);
        let operators = groom.chain.operators.clone();
        match stage {
            Stage::Guides => {
                let courses = self.courses.as_ref().unwrap_or(targets);
                let (mut moving, mut options) = (moving(&operators), options.guide);
                if self.state.round == 0 {
                    // Nothing is known of the operators yet, but that bends would take from the
                    // length of the mean what they do not take from strands.
                    if bends(&operators) {
                        options.stretch = 0.0;
                        options.evenness = options.evenness.max(1.0);
                    }
                    let roots = groom.guide_roots();
                    even_out(&mut groom.guides, &roots, &options);
                    moving.clear();
                    options.steps = 0;
                }
                let steps = options.corrections + options.steps;
                let mut note = note(&mut self.state.history, stage, steps, watch);
                let mut watch = |loss| note(loss, &operators);
                refine_guides(groom, courses, sound, &moving, &options, &mut watch)?;
                if self.courses.is_some() {
                    let smoothing = self.options.smoothing;
                    let steps = smoothing.steps / CURL_SHARE;
                    Smoothing { steps, ..smoothing }.apply_to_all(&mut groom.guides);
                }
            }
            Stage::Parameters => {
                let steps = options.parameters.most_steps(&operators);
                let mut note = note(&mut self.state.history, stage, steps, watch);
                fit_parameters(groom, targets, sound, &options.parameters, &mut note)?;
            }
            Stage::Numbers => {
                let steps = options.numbers.steps;
                let mut note = note(&mut self.state.history, stage, steps, watch);
                let mut watch = |loss| note(loss, &operators);
                refine_numbers(groom, targets, sound, &options.numbers, &mut watch)?;
            }
            Stage::Initialize | Stage::Done => {}
        }
        Ok(())
    }
}

/// The target's sound strands with as many points each. Where all have as many already they keep
/// theirs: a groom's points are even along its guides, not along its curls.
fn even(target: &Groom, points: usize) -> Result<(EvenStrands, Vec<usize>), EvenError> {
    let strands = target.strands();
    if strands.counts().any(|count| count != points) {
        return EvenStrands::resampled(target, points);
    }
    let kept: Vec<usize> =
        (0..strands.len()).filter(|&i| defect(strands.strand(i)).is_none()).collect();
    let all = kept.iter().flat_map(|&i| strands.strand(i)).copied().collect();
    Ok((EvenStrands::new(points, all)?, kept))
}

/// Of the steps that smooth a cluster's mean, the share that guides of curls are smoothed by in the
/// end: what centerlines keep of a curl is short, and comes back with corrections.
const CURL_SHARE: usize = 4;

fn bends(operators: &[Operator]) -> bool {
    operators.iter().any(|operator| matches!(operator, Operator::Bend(_)))
}

/// The operators that do not leave strands where they are in the mean [IPG 5.4].
fn moving(operators: &[Operator]) -> Vec<Operator> {
    let moves = |o: &&Operator| matches!(o, Operator::Clump(_) | Operator::Bend(_));
    operators.iter().filter(moves).cloned().collect()
}

/// Keeps and tells every step of a stage.
fn note<'a>(
    history: &'a mut Vec<Record>,
    stage: Stage,
    steps: usize,
    watch: &'a mut dyn FnMut(Progress),
) -> impl FnMut(f64, &[Operator]) + 'a {
    let mut step = 0;
    move |loss, operators| {
        step += 1;
        let done = f64::min(step as f64 / steps.max(1) as f64, 1.0);
        watch(Progress { stage, loss, done });
        let parameters = operators.iter().map(Operator::values).collect();
        history.push(Record { stage, loss, parameters });
    }
}

#[cfg(test)]
mod tests;
