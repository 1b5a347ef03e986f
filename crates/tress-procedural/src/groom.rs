//! A procedural groom: guides, roots, a chain of operators and the numbers they draw.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_geometry::{Column, Groom, UpAxis, names};

use crate::numbers::{count, draw_one};
use crate::{Bound, Chain, ChainError, EvenStrands, Instances, Instancing, Roots, Surface, widths};

/// A groom as guides plus operators.
///
/// ```
/// use glam::DVec3;
/// use tress_procedural::{EvenStrands, Frizz, Operator, ProceduralGroom, Roots};
///
/// let guide = (0..20).map(|j| DVec3::Y * f64::from(j)).collect();
/// let roots = Roots { positions: vec![DVec3::ZERO, DVec3::X], uv: None };
/// let mut groom = ProceduralGroom::new(EvenStrands::new(20, guide)?, roots)?;
/// groom.chain.operators = vec![Operator::Frizz(Frizz { frequency: 0.5, amplitude: 0.3 })];
/// groom.draw_missing();
/// let strands = groom.build()?;
/// assert_eq!(strands.len(), 2);
/// assert_eq!(strands, groom.build()?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ProceduralGroom {
    /// The operators.
    pub chain: Chain,
    /// Where random numbers come from that are not stored.
    pub seed: u64,
    /// How strands choose their guides.
    pub instancing: Instancing,
    /// The guides.
    pub guides: EvenStrands,
    /// Texture coordinates of the guides' roots, where known.
    pub guide_uv: Option<Vec<[f64; 2]>>,
    /// Which guides are operator guides.
    pub operator_guides: Vec<u32>,
    /// Where strands grow.
    pub roots: Roots,
    /// The operator guide of each strand, as an index into `operator_guides`.
    pub operator_of: Vec<u32>,
    /// Guides and weights of each strand, for [`Instancing::Stored`].
    pub instances: Option<Instances>,
    /// The random numbers of each operator, see [`draw`](crate::draw).
    pub numbers: Vec<Vec<f64>>,
    /// Widths of every strand at places even from root to tip, linear between, in the groom's unit:
    /// one for the same width all along, none for strands without a width.
    pub widths: Vec<f64>,
    /// Metres in one unit of length, where it is known.
    pub unit: Option<f64>,
    /// The axis that is up, where it is known.
    pub up: Option<UpAxis>,
}

/// Why a procedural groom cannot be built.
#[derive(Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// No guides.
    ///
    /// ```
    /// # use tress_procedural::{BuildError, EvenStrands, ProceduralGroom, Roots};
    /// let none = EvenStrands::new(2, vec![])?;
    /// let error = ProceduralGroom::new(none, Roots::default()).unwrap_err();
    /// assert_eq!(error, BuildError::NoGuides);
    /// # Ok::<(), tress_procedural::EvenError>(())
    /// ```
    #[error("a procedural groom without guides")]
    NoGuides,
    /// A guide or root with a coordinate that is not finite.
    #[error("{what} {index} has a coordinate that is not finite")]
    NotFinite {
        /// Guide or root.
        what: &'static str,
        /// Which.
        index: usize,
    },
    /// An array of another length than it should have.
    #[error("{given} {what}, expected {expected}")]
    Count {
        /// What the array holds.
        what: &'static str,
        /// Entries it has.
        given: usize,
        /// Entries it should have.
        expected: usize,
    },
    /// An index that names no guide.
    #[error("{what} {index} names guide {guide}, but there are {guides}")]
    NoGuide {
        /// What names the guide.
        what: &'static str,
        /// Which of them.
        index: usize,
        /// The guide it names.
        guide: u32,
        /// How many there are.
        guides: usize,
    },
    /// Instancing says that weights are stored, and they are not.
    #[error("the weights of instancing are said to be stored, and are not")]
    NoWeights,
    /// `sigma` is no positive number.
    #[error("the sigma of instancing is {0}, expected a number above 0")]
    Sigma(f64),
    /// A width that is no length.
    #[error("width {index} is {width}, expected a number from 0")]
    Width {
        /// Which of the widths, from 0.
        index: usize,
        /// What it is.
        width: f64,
    },
    /// The chain cannot be run.
    #[error(transparent)]
    Chain(#[from] ChainError),
    /// More points than offsets tell apart.
    #[error(transparent)]
    Offsets(#[from] tress_geometry::OffsetsError),
}

/// Metadata of a groom that is one number or name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Space {
    pub(crate) unit: Option<f64>,
    pub(crate) up: Option<UpAxis>,
}

impl ProceduralGroom {
    /// A groom without operators, instanced from the nearest guides; every guide is an operator
    /// guide, and a strand belongs to the one its root is nearest to.
    ///
    /// # Errors
    ///
    /// If there are no guides, or a coordinate is not finite.
    pub fn new(guides: EvenStrands, roots: Roots) -> Result<Self, BuildError> {
        let operator_guides = (0..).zip(guides.iter()).map(|(i, _)| i).collect();
        let sigma = spacing(&guides.roots());
        let mut groom = Self {
            chain: Chain::default(),
            seed: 0,
            instancing: Instancing::Gaussian { neighbors: 4, sigma },
            guides,
            guide_uv: None,
            operator_guides,
            operator_of: Vec::new(),
            roots,
            instances: None,
            numbers: Vec::new(),
            widths: Vec::new(),
            unit: None,
            up: None,
        };
        groom.check_guides()?;
        groom.assign();
        Ok(groom)
    }

    /// The guides' roots.
    #[must_use]
    pub fn guide_roots(&self) -> Roots {
        Roots { positions: self.guides.roots(), uv: self.guide_uv.clone() }
    }

    /// Gives every strand to the operator guide its root is nearest to.
    pub fn assign(&mut self) {
        let guides = self.guide_roots();
        let operators: Vec<usize> = self.operator_guides.iter().map(|&g| g as usize).collect();
        let guides = guides.select(&operators);
        let near =
            crate::instancing::nearest(&guides.places(&self.roots), &self.roots.places(&guides), 1);
        self.operator_of = near.iter().map(|near| near.first().map_or(0, |best| best.1)).collect();
    }

    /// Blends every strand from the guides whose roots are nearest, in texture coordinates where
    /// both sides have them and else in space, with the mean distance of neighboring guides for
    /// `sigma`; and gives it to the operator guide nearest there.
    pub fn instance_by_distance(&mut self, neighbors: usize) {
        let sigma = spacing(&self.guide_roots().places(&self.roots));
        self.instancing = Instancing::Gaussian { neighbors, sigma };
        self.instances = None;
        self.assign();
    }

    /// Mean distance of a guide's root from the nearest other; 1 where there is no other.
    #[must_use]
    pub fn guide_spacing(&self) -> f64 {
        spacing(&self.guides.roots())
    }

    /// Blends every strand from the guides nearest over a scalp, and gives it to the operator guide
    /// nearest there; the weights are stored with the groom, so that it needs no mesh to be built.
    ///
    /// # Errors
    ///
    /// If `sigma` is no positive number.
    pub fn instance_over(
        &mut self,
        scalp: &Surface,
        neighbors: usize,
        sigma: f64,
    ) -> Result<(), BuildError> {
        if !(0.0 < sigma && sigma.is_finite()) {
            return Err(BuildError::Sigma(sigma));
        }
        let (guides, roots) = (self.guides.roots(), &self.roots.positions);
        let instances = Instances::over_surface(scalp, &guides, roots, neighbors, sigma);
        let of_operators = self.operator_guide_points().roots();
        let nearest = Instances::over_surface(scalp, &of_operators, roots, 1, sigma);
        self.operator_of = nearest.guides;
        self.instances = Some(instances);
        self.instancing = Instancing::Stored;
        Ok(())
    }

    /// Draws the random numbers of operators that have none, or not as many as they need.
    pub fn draw_missing(&mut self) {
        let operators = &self.chain.operators;
        self.numbers.resize(operators.len(), Vec::new());
        let (strands, guides) = (self.roots.len(), self.operator_guides.len());
        for (o, operator) in operators.iter().enumerate() {
            if self.numbers[o].len() != count(operator, strands, guides) {
                self.numbers[o] = draw_one(operators, o, strands, guides, self.seed);
            }
        }
    }

    fn check_guides(&self) -> Result<(), BuildError> {
        if self.guides.is_empty() {
            return Err(BuildError::NoGuides);
        }
        if let Some(point) = self.guides.points().iter().position(|x| !x.is_finite()) {
            let index = point / self.guides.points_each();
            return Err(BuildError::NotFinite { what: "guide", index });
        }
        if let Some(index) = self.roots.positions.iter().position(|x| !x.is_finite()) {
            return Err(BuildError::NotFinite { what: "root", index });
        }
        Ok(())
    }

    /// An error unless all parts fit together.
    ///
    /// # Errors
    ///
    /// See [`BuildError`].
    pub fn check(&self) -> Result<(), BuildError> {
        self.check_guides()?;
        let (guides, strands) = (self.guides.len(), self.roots.len());
        let uv_of = |uv: &Option<Vec<[f64; 2]>>| uv.as_ref().map(Vec::len);
        let counts = [
            ("texture coordinates of guides", uv_of(&self.guide_uv).unwrap_or(guides), guides),
            ("texture coordinates of roots", uv_of(&self.roots.uv).unwrap_or(strands), strands),
            ("operator guides of strands", self.operator_of.len(), strands),
        ];
        if let Some(&(what, given, expected)) = counts.iter().find(|(_, a, b)| a != b) {
            return Err(BuildError::Count { what, given, expected });
        }
        let named = |what: &'static str, names: &[u32], guides: usize| {
            let stray = names.iter().enumerate().find(|&(_, &guide)| guide as usize >= guides);
            stray.map_or(Ok(()), |(index, &guide)| {
                Err(BuildError::NoGuide { what, index, guide, guides })
            })
        };
        let wrong = |width: &f64| !(0.0 <= *width && width.is_finite());
        if let Some(index) = self.widths.iter().position(wrong) {
            return Err(BuildError::Width { index, width: self.widths[index] });
        }
        named("operator guide", &self.operator_guides, guides)?;
        named("strand", &self.operator_of, self.operator_guides.len())?;
        if let Some(instances) = &self.instances {
            if instances.each == 0 {
                return Err(BuildError::Count { what: "guides a strand", given: 0, expected: 1 });
            }
            let given = instances.guides.len();
            let expected = strands.saturating_mul(instances.each);
            if given != expected || instances.weights.len() != expected {
                return Err(BuildError::Count { what: "instancing weights", given, expected });
            }
            named("instancing weight", &instances.guides, guides)?;
        }
        Ok(())
    }

    /// The guides and weights of each strand.
    ///
    /// # Errors
    ///
    /// If they are said to be stored and are not, or if `sigma` is no positive number.
    pub fn instances(&self) -> Result<Instances, BuildError> {
        match self.instancing {
            Instancing::Stored => self.instances.clone().ok_or(BuildError::NoWeights),
            Instancing::Gaussian { neighbors, sigma } => {
                if !(0.0 < sigma && sigma.is_finite()) {
                    return Err(BuildError::Sigma(sigma));
                }
                Ok(Instances::by_distance(&self.guide_roots(), &self.roots, neighbors, sigma))
            }
        }
    }

    /// The operator guides' points.
    #[must_use]
    pub fn operator_guide_points(&self) -> EvenStrands {
        let guides: Vec<usize> = self.operator_guides.iter().map(|&g| g as usize).collect();
        self.guides.select(&guides)
    }

    /// The strands.
    ///
    /// # Errors
    ///
    /// See [`BuildError`].
    pub fn build(&self) -> Result<EvenStrands, BuildError> {
        self.check()?;
        let mut strands = self.instances()?.instance(&self.guides, &self.roots.positions);
        let guides = self.operator_guide_points();
        let bound =
            Bound { guides: &guides, operator_of: &self.operator_of, numbers: &self.numbers };
        self.chain.apply(&mut strands, &bound, self.seed)?;
        Ok(strands)
    }

    /// Gives strands the mean [width](names::WIDTH), from root to tip, of another groom's strands;
    /// none where that has none.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_geometry::{Column, Groom, Strands, names};
    /// use tress_procedural::{EvenStrands, ProceduralGroom, Roots};
    ///
    /// let strands = Strands::from_counts([2], vec![DVec3::ZERO, DVec3::Z])?;
    /// let guides = EvenStrands::try_from(&strands)?;
    /// let mut given = Groom::new(strands);
    /// given.insert_point_attribute(names::WIDTH, Column::scalar(vec![0.07, 0.03]))?;
    /// let roots = Roots { positions: vec![DVec3::X], uv: None };
    /// let mut groom = ProceduralGroom::new(guides, roots)?;
    /// groom.take_widths(&given);
    /// let built = groom.build_groom()?;
    /// assert_eq!(built.strand_values(names::WIDTH), Some(vec![0.05]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn take_widths(&mut self, groom: &Groom) {
        self.widths = widths::of(groom);
    }

    /// The strands as a groom, with unit and up axis, the operator guide of each as its
    /// [group](names::GROUP), its texture coordinates and its [width](names::WIDTH).
    ///
    /// # Errors
    ///
    /// See [`BuildError`].
    pub fn build_groom(&self) -> Result<Groom, BuildError> {
        let groom = Groom::new(self.build()?.into_strands()?);
        let mut groom = groom.in_space(self.unit, self.up);
        let row_each = "one row was made for each strand";
        let groups = self.operator_of.iter().map(|&guide| i64::from(guide)).collect();
        groom.insert_strand_attribute(names::GROUP, Column::Int(groups)).expect(row_each);
        if !self.widths.is_empty() {
            let (strands, points) = (self.roots.len(), self.guides.points_each());
            let column = widths::column(&self.widths, strands, points);
            groom.insert_point_attribute(names::WIDTH, column).expect("as many each as points");
        }
        if let Some(uv) = &self.roots.uv {
            let column = Column::Float { components: 2, values: uv.concat() };
            groom.insert_strand_attribute(names::ROOT_UV, column).expect(row_each);
        }
        Ok(groom)
    }
}

/// Mean distance of points from the nearest other one; 1 where there is none.
pub(crate) fn spacing(points: &[DVec3]) -> f64 {
    let near = crate::instancing::nearest(points, points, 2);
    let second = near.iter().filter_map(|near| near.get(1)).map(|near| near.0.sqrt());
    let mean = second.sum::<f64>() / points.len().max(1) as f64;
    if mean > 0.0 { mean } else { 1.0 }
}
