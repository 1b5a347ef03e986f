//! From strands to registers and back: strands gathered into lanes, solved, and written back.
//!
//! Strands are sorted by how many elements and controls they have, so that few lanes carry
//! another's ballast, and handed out in parts of fixed size. Neither changes a bit of a strand's
//! result, since lanes do not know each other.
//!
//! A register is done when its slowest strand is. Most strands need a few walks and a few need
//! many, so that all strands get a few, and those that are not done share registers anew.

use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use tress_geometry::{Element, Frame, SuperHelix};

use crate::chain::{Chain, LaneElement, Point};
use crate::control::Prepared;
use crate::lanes::{Lane, LaneMat3, LaneVec3, MAX_LANES, vectors};
use crate::levenberg::{Levenberg, Limits, Outcome};
use crate::objective::element_weights;
use crate::{Control, Report, SculptOptions, Stiffness, Stop};

/// One strand to be solved.
#[derive(Debug)]
pub(crate) struct Job<'a> {
    /// Its place in the groom.
    pub(crate) strand: usize,
    pub(crate) root: Frame,
    /// `q0`; where there is none, `pose` is at rest.
    pub(crate) rest: Option<&'a [Element]>,
    /// In: where to start; out: the result.
    pub(crate) pose: &'a mut [Element],
    pub(crate) controls: &'a [Control],
    pub(crate) memory: Memory,
    pub(crate) report: Option<Report>,
    pub(crate) unfinished: Option<Unfinished>,
}

/// What a strand takes along that was not done when its register was.
#[derive(Debug)]
pub(crate) struct Unfinished {
    /// `q0`, once `pose` is no longer at rest.
    rest: Vec<Element>,
    slow: bool,
}

impl Job<'_> {
    fn rest(&self) -> &[Element] {
        match (&self.unfinished, self.rest) {
            (Some(unfinished), _) => &unfinished.rest,
            (None, Some(rest)) => rest,
            (None, None) => self.pose,
        }
    }

    fn is_at_rest(&self) -> bool {
        self.unfinished.is_none() && self.rest.is_none()
    }
}

/// What a strand's solution leaves for the next, with the same rest.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Memory {
    /// `c` in length^4, once it is known.
    pub(crate) c: Option<f64>,
    /// The greatest gradient that a solution started with.
    pub(crate) reference: f64,
}

/// Strands that a thread takes at a time: enough to spread what it costs to start, few enough to
/// share out a small groom.
const JOBS_AT_A_TIME: usize = 64;

/// Walks that every strand gets at first: a few more than most need. With more, registers wait for
/// their slowest strand; with fewer, strands are gathered again that were all but done.
const FIRST_WALKS: usize = 12;

/// Solves all jobs, whose controls have been checked; they are left in another order.
pub(crate) fn solve_all(jobs: &mut [Job<'_>], options: &SculptOptions) {
    let (mut left, mut walks, mut walked) = (jobs, FIRST_WALKS, 0);
    let most = options.max_iterations.max(1);
    while !left.is_empty() && walked < most {
        left.sort_by_key(|job| (job.pose.len(), job.controls.len(), job.strand));
        walks = walks.min(most - walked);
        left.par_chunks_mut(JOBS_AT_A_TIME)
            .for_each(|jobs| Arch::new().dispatch(Batch { jobs, options, walks }));
        walked += walks;
        walks *= 2;
        left.sort_by_key(|job| job.unfinished.is_none());
        let n_left = left.partition_point(|job| job.unfinished.is_some());
        left = &mut left[..n_left];
    }
}

struct Batch<'a, 'b> {
    jobs: &'a mut [Job<'b>],
    options: &'a SculptOptions,
    walks: usize,
}

impl WithSimd for Batch<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let limits = Limits {
            tolerance: self.options.tolerance,
            walks: self.walks,
            continuation: self.options.continuation,
        };
        let mut gather = Gather::default();
        let mut chain = Chain::new(simd);
        let mut solver = Levenberg::new(simd);
        for jobs in self.jobs.chunks_mut(S::F64_LANES) {
            gather.load(jobs, self.options, &mut chain, &mut solver);
            let outcomes = solver.solve(&mut chain, jobs.len(), &limits);
            gather.store(jobs, &chain, &solver, &outcomes);
        }
    }
}

/// Memory for what is on the way into lanes.
#[derive(Default)]
struct Gather {
    prepared: [Prepared; MAX_LANES],
    softness: [Vec<DVec3>; MAX_LANES],
}

impl Gather {
    /// Fills chain and solver with one strand a lane.
    #[inline(always)]
    fn load<S: Simd>(
        &mut self,
        jobs: &[Job<'_>],
        options: &SculptOptions,
        chain: &mut Chain<S>,
        solver: &mut Levenberg<S>,
    ) {
        let simd = chain.simd;
        for (lane, job) in jobs.iter().enumerate() {
            let rest = job.rest();
            let softness = &mut self.softness[lane];
            softness.clear();
            element_weights(rest, options, |w| {
                softness.push(w.map(|w| if 0.0 < w { 1.0 / w.sqrt() } else { 0.0 }));
            });
            let strand = SuperHelix { root: job.root, elements: rest };
            let checked = self.prepared[lane].prepare(&strand, job.controls);
            debug_assert!(checked.is_ok(), "controls are checked before strands are shared out");
        }
        for stale in &mut self.prepared[jobs.len()..] {
            stale.controls.clear();
        }
        self.load_elements(jobs, chain, solver);
        self.load_controls(jobs, chain, solver);
        chain.axes = LaneMat3([0, 1, 2].map(|column| {
            vectors(simd, |i| jobs.get(i).map_or(DVec3::ZERO, |job| job.root.axes.col(column)))
        }));
        solver.c = Lane::from_fn(simd, |i| {
            let Some(job) = jobs.get(i) else { return 0.0 };
            job.memory.c.unwrap_or(match options.stiffness {
                Stiffness::Raw(c) => c,
                Stiffness::Relative(stiffness) => -stiffness,
            })
        });
        solver.slow = Lane::from_fn(simd, |i| {
            let slow = jobs.get(i).and_then(|job| job.unfinished.as_ref()).is_some_and(|u| u.slow);
            f64::from(u8::from(slow))
        })
        .is(1.0);
        solver.reference = Lane::from_fn(simd, |i| jobs.get(i).map_or(0.0, |j| j.memory.reference));
    }

    #[inline(always)]
    fn load_elements<S: Simd>(
        &self,
        jobs: &[Job<'_>],
        chain: &mut Chain<S>,
        solver: &mut Levenberg<S>,
    ) {
        let simd = chain.simd;
        let n = jobs.iter().map(|job| job.pose.len()).max().unwrap_or(0);
        chain.elements.clear();
        solver.y.clear();
        for j in 0..n {
            let rest = |i: usize| jobs.get(i)?.rest().get(j);
            let softness = |i: usize| self.softness[i].get(j).copied().unwrap_or(DVec3::ZERO);
            chain.elements.push(LaneElement {
                rest: vectors(simd, |i| rest(i).map_or(DVec3::ZERO, |e| e.curvature)),
                length: Lane::from_fn(simd, |i| rest(i).map_or(0.0, |e| e.length)),
                softness: vectors(simd, |i| if i < jobs.len() { softness(i) } else { DVec3::ZERO }),
            });
            solver.y.push(vectors(simd, |i| {
                let Some((job, at_rest)) = jobs.get(i).zip(rest(i)) else { return DVec3::ZERO };
                if job.is_at_rest() {
                    return DVec3::ZERO;
                }
                let change = job.pose[j].curvature - at_rest.curvature;
                let soft = softness(i);
                DVec3::select(soft.cmpgt(DVec3::ZERO), change / soft, DVec3::ZERO)
            }));
        }
    }

    #[inline(always)]
    fn load_controls<S: Simd>(
        &self,
        jobs: &[Job<'_>],
        chain: &mut Chain<S>,
        solver: &mut Levenberg<S>,
    ) {
        let simd = chain.simd;
        let m = jobs.iter().map(|job| job.controls.len()).max().unwrap_or(0);
        chain.points.clear();
        chain.holds.clear();
        solver.anchors.clear();
        solver.normal.root_weights.clear();
        // Where each lane's walk along its strand has come to.
        let mut reached = [(0_usize, 0.0_f64); MAX_LANES];
        for k in 0..m {
            let mut places = [(0, 0.0); MAX_LANES];
            for (i, job) in jobs.iter().enumerate() {
                let Some(control) = self.prepared[i].controls.get(k) else { continue };
                let (index, begins) = &mut reached[i];
                while *index + 1 < job.pose.len()
                    && *begins + job.pose[*index].length < control.arc_length
                {
                    *begins += job.pose[*index].length;
                    *index += 1;
                }
                let local = (control.arc_length - *begins).clamp(0.0, job.pose[*index].length);
                places[i] = (*index, local);
                chain.holds.push((*index, k));
            }
            chain.points.push(Point::new(
                Lane::from_fn(simd, |i| places[i].0 as f64),
                Lane::from_fn(simd, |i| places[i].1),
            ));
            let control = |i: usize| self.prepared[i].controls.get(k);
            solver.anchors.push(vectors(simd, |i| control(i).map_or(DVec3::ZERO, |c| c.anchor)));
            let root_weight = |i| control(i).map_or(0.0, |c| c.weight.sqrt());
            solver.normal.root_weights.push(Lane::from_fn(simd, root_weight));
        }
        chain.holds.sort_unstable();
        chain.holds.dedup();
    }

    /// Writes curvatures and reports back.
    #[inline(always)]
    fn store<S: Simd>(
        &self,
        jobs: &mut [Job<'_>],
        chain: &Chain<S>,
        solver: &Levenberg<S>,
        outcomes: &[Outcome; MAX_LANES],
    ) {
        let positions: Vec<_> = solver.positions.iter().map(|p| p.to_array()).collect();
        for (i, job) in jobs.iter_mut().enumerate() {
            let Outcome { start, end, iterations, stop, slow, gradient, reference, c } =
                outcomes[i];
            let Prepared { controls, asked, unreachable, .. } = &self.prepared[i];
            let off = controls.iter().zip(asked).zip(&positions);
            let anchor_distance = off
                .filter(|((control, _), _)| 0.0 < control.weight)
                .fold(0.0, |worst, ((_, asked), p)| f64::max(worst, asked.distance(p[i])));
            // A strand that comes again started long before.
            let before = job.report.filter(|_| job.unfinished.is_some());
            job.report = Some(Report {
                start: before.map_or(start, |before| before.start),
                end,
                iterations: iterations + before.map_or(0, |before| before.iterations),
                stop,
                gradient: if reference == 0.0 { 0.0 } else { gradient / reference },
                anchor_distance,
                unreachable: u32::try_from(*unreachable).unwrap_or(u32::MAX),
            });
            job.memory = Memory { c: Some(c), reference };
            job.unfinished = (stop == Stop::MaxIterations).then(|| {
                let rest = job.unfinished.take().map(|before| before.rest);
                Unfinished { rest: rest.unwrap_or_else(|| job.rest().to_vec()), slow }
            });
        }
        for (j, (element, &y)) in chain.elements.iter().zip(&solver.y).enumerate() {
            let q: LaneVec3<S> = element.rest + element.softness.scale(y);
            let q = q.to_array();
            for (job, q) in jobs.iter_mut().zip(q) {
                if let Some(element) = job.pose.get_mut(j) {
                    element.curvature = q;
                }
            }
        }
    }
}
