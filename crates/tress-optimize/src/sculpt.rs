//! Strands and whole grooms drawn to anchors.

use rayon::prelude::*;
use tress_geometry::{Element, HelixGroom, OffsetsError, Strands, SuperHelix};

use crate::batch::{Job, Memory, solve_all};
use crate::control::Prepared;
use crate::{
    Control, ControlError, Objective, OptionsError, Report, SculptOptions, Sculpted, Solver, adam,
};

/// Why sculpting did not begin. Nothing has been changed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SculptError {
    /// An option has no meaning.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// A control of a strand has no meaning.
    #[error("strand {strand}: {source}")]
    Control {
        /// The strand's place in the groom.
        strand: usize,
        /// What is wrong.
        source: ControlError,
    },
    /// The controls are for another groom.
    ///
    /// ```
    /// use tress_geometry::{HelixGroom, Strands};
    /// use tress_optimize::{SculptError, SculptOptions, sculpt};
    ///
    /// let mut bald = HelixGroom::new(vec![], Strands::default())?;
    /// let controls = Strands::from_counts([0, 0], vec![])?;
    /// let error = sculpt(&mut bald, &controls, &SculptOptions::default()).unwrap_err();
    /// assert_eq!(error, SculptError::Strands { controls: 2, strands: 0 });
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[error("controls for {controls} strands, but there are {strands}")]
    Strands {
        /// Strands that the controls are for.
        controls: usize,
        /// Strands there are.
        strands: usize,
    },
    /// The strand has no shape to start from: a curvature, a length or the root is not finite, or
    /// a length is negative. In a groom such a strand is left as it is and counted.
    #[error("strand {strand} is not finite")]
    NotFinite {
        /// The strand's place in the groom.
        strand: usize,
    },
    /// More controls than 32 bits can tell apart.
    #[error(transparent)]
    TooMany(#[from] OffsetsError),
}

/// Moves the control points of one strand to their anchors.
///
/// The strand as it stands is `q0`. Lengths of elements do not change, so that the strand's
/// length does not either.
///
/// # Errors
///
/// If an option or a control has no meaning, or the strand is not finite.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Element, Frame, SuperHelix};
/// use tress_optimize::{Control, SculptOptions, Stop, solve};
///
/// // A coil of 20 turns about an axis in the x-z plane; its tip goes to half the height.
/// let coil = Element { length: 0.5, ..Element::coil(0.3, 0.4) };
/// let elements = [coil; 80];
/// let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
/// let anchor = 0.5 * strand.tip().position + DVec3::Y;
/// let tip = [Control::new(strand.length(), anchor)];
/// let (sculpted, report) = solve(&strand, &tip, &SculptOptions::default())?;
///
/// let after = SuperHelix { root: strand.root, elements: &sculpted };
/// assert!(after.tip().position.distance(anchor) < 0.01);
/// assert_eq!(after.length(), strand.length());
/// assert_eq!(report.stop, Stop::Converged);
/// assert!(report.iterations < 40);
/// # Ok::<(), tress_optimize::SculptError>(())
/// ```
pub fn solve(
    strand: &SuperHelix<'_>,
    controls: &[Control],
    options: &SculptOptions,
) -> Result<(Vec<Element>, Report), SculptError> {
    options.validate()?;
    let mut prepared = Prepared::default();
    if !is_finite(strand) {
        return Err(SculptError::NotFinite { strand: 0 });
    }
    let named = |source| SculptError::Control { strand: 0, source };
    prepared.prepare(strand, controls).map_err(named)?;
    if strand.elements.is_empty() || controls.is_empty() {
        return Ok((strand.elements.to_vec(), Report::UNTOUCHED));
    }
    let mut pose = strand.elements.to_vec();
    let report = match options.solver {
        Solver::Adam(adam) => {
            let mut objective = Objective::new(strand, controls, options).map_err(named)?;
            adam::minimise(&mut objective, &mut pose, &adam)
        }
        Solver::LevenbergMarquardt => {
            let memory = Memory::default();
            let root = strand.root;
            let job = Job {
                strand: 0,
                root,
                rest: None,
                pose: &mut pose,
                controls,
                memory,
                report: None,
                unfinished: None,
            };
            let mut jobs = [job];
            solve_all(&mut jobs, options);
            let [Job { report, .. }] = jobs;
            report.unwrap_or(Report::UNTOUCHED)
        }
    };
    Ok((pose, report))
}

/// Draws the strands of a groom to the anchors of their controls; one without controls stays.
///
/// Every strand's result is the same to the bit on any number of threads, in any order of the
/// strands, and alone. Adds less than half a kilobyte a strand while it runs.
///
/// # Errors
///
/// If an option or a control has no meaning, or the controls are not for as many strands; then
/// nothing has been changed. The first bad strand is named.
pub fn sculpt(
    groom: &mut HelixGroom,
    controls: &Strands<Control>,
    options: &SculptOptions,
) -> Result<Sculpted, SculptError> {
    let fates = fates(groom, controls, options)?;
    let roots = groom.roots().to_vec();
    let poses = groom.elements_mut().iter_mut().enumerate();
    let jobs = poses.filter(|(i, _)| fates[*i] == Fate::Sculpt).map(|(strand, pose)| Job {
        strand,
        root: roots[strand],
        rest: None,
        pose,
        controls: controls.strand(strand),
        memory: Memory::default(),
        report: None,
        unfinished: None,
    });
    let mut jobs: Vec<_> = jobs.collect();
    run(&mut jobs, options);
    let mut sculpted = Sculpted::untouched(&fates);
    for job in jobs {
        sculpted.reports[job.strand] = job.report;
    }
    Ok(sculpted)
}

/// Sculpts a groom again and again from the same rest, each time from where the last call left it:
/// what an interactive tool does while a joint is dragged.
#[derive(Clone, Debug)]
pub struct Sculptor {
    rest: HelixGroom,
    pose: HelixGroom,
    options: SculptOptions,
    memories: Vec<Memory>,
}

impl Sculptor {
    /// A groom at rest.
    ///
    /// # Errors
    ///
    /// If an option has no meaning.
    pub fn new(rest: HelixGroom, options: SculptOptions) -> Result<Self, OptionsError> {
        options.validate()?;
        let memories = vec![Memory::default(); rest.len()];
        Ok(Self { pose: rest.clone(), rest, options, memories })
    }

    /// The groom as it was given.
    #[must_use]
    pub fn rest(&self) -> &HelixGroom {
        &self.rest
    }

    /// The groom as the last call left it.
    #[must_use]
    pub fn pose(&self) -> &HelixGroom {
        &self.pose
    }

    /// Draws the strands to their anchors, from the last pose on; strands without controls go back
    /// to rest.
    ///
    /// # Errors
    ///
    /// As [`sculpt`]; then the pose has not changed.
    pub fn sculpt(&mut self, controls: &Strands<Control>) -> Result<Sculpted, SculptError> {
        let fates = fates(&self.rest, controls, &self.options)?;
        let mut jobs = Vec::new();
        for (strand, pose) in self.pose.elements_mut().iter_mut().enumerate() {
            let SuperHelix { root, elements: rest } = self.rest.strand(strand);
            if fates[strand] != Fate::Sculpt {
                pose.copy_from_slice(rest);
                continue;
            }
            let (controls, memory) = (controls.strand(strand), self.memories[strand]);
            jobs.push(Job {
                strand,
                root,
                rest: Some(rest),
                pose,
                controls,
                memory,
                report: None,
                unfinished: None,
            });
        }
        run(&mut jobs, &self.options);
        let mut sculpted = Sculpted::untouched(&fates);
        for job in jobs {
            sculpted.reports[job.strand] = job.report;
            self.memories[job.strand] = job.memory;
        }
        Ok(sculpted)
    }
}

/// What happens to a strand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    Sculpt,
    Free,
    Kept,
    NotFinite,
}

/// What is to happen to each strand, and whether everything can.
fn fates(
    groom: &HelixGroom,
    controls: &Strands<Control>,
    options: &SculptOptions,
) -> Result<Vec<Fate>, SculptError> {
    options.validate()?;
    if controls.len() != groom.len() {
        return Err(SculptError::Strands { controls: controls.len(), strands: groom.len() });
    }
    let mut prepared = Prepared::default();
    let fate = |i: usize| {
        let (strand, controls) = (groom.strand(i), controls.strand(i));
        if controls.is_empty() {
            return Ok(Fate::Free);
        }
        if strand.elements.is_empty() {
            return Ok(Fate::Kept);
        }
        if !is_finite(&strand) {
            return Ok(Fate::NotFinite);
        }
        match prepared.prepare(&strand, controls) {
            Ok(()) => Ok(Fate::Sculpt),
            Err(source) => Err(SculptError::Control { strand: i, source }),
        }
    };
    (0..groom.len()).map(fate).collect()
}

fn is_finite(strand: &SuperHelix<'_>) -> bool {
    let good = |e: &Element| e.curvature.is_finite() && e.length.is_finite() && 0.0 <= e.length;
    strand.root.position.is_finite()
        && strand.root.axes.is_finite()
        && strand.elements.iter().all(good)
}

/// Solves all jobs by the solver that was asked for.
fn run(jobs: &mut [Job<'_>], options: &SculptOptions) {
    let Solver::Adam(adam) = options.solver else {
        solve_all(jobs, options);
        return;
    };
    jobs.par_iter_mut().for_each(|job| {
        let at_rest = job.rest.map_or_else(|| job.pose.to_vec(), <[Element]>::to_vec);
        let strand = SuperHelix { root: job.root, elements: &at_rest };
        if let Ok(mut objective) = Objective::new(&strand, job.controls, options) {
            job.report = Some(adam::minimise(&mut objective, job.pose, &adam));
        }
    });
}

impl Sculpted {
    fn untouched(fates: &[Fate]) -> Self {
        let count = |fate| fates.iter().filter(|f| **f == fate).count();
        Self {
            reports: vec![None; fates.len()],
            free: count(Fate::Free),
            kept: count(Fate::Kept),
            not_finite: count(Fate::NotFinite),
        }
    }
}
