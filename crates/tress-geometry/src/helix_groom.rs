//! A groom as super-helices: what edits act on.
//!
//! Positions are derived from roots and elements; nothing else is stored but what a polyline
//! cannot be fitted with: strands without a direction are *kept* as the polylines they were, so
//! that no strand is lost on the way.

use glam::DVec3;

use crate::groom::{JoinError, check_rows, check_space};
use crate::{
    Attributes, Column, ColumnError, Element, Frame, GroomError, Strands, SuperHelix, UpAxis,
};

/// Strands that could not become helices, as they came.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kept {
    /// Which strands of the groom they are, ascending.
    pub strands: Vec<u32>,
    /// Their points, one polyline an entry.
    pub polylines: Strands<DVec3>,
    /// Columns with one row a kept point.
    pub point_attributes: Attributes,
}

/// Super-helices with attributes.
///
/// Strand `i` is `roots[i]` and the elements of `elements.strand(i)`; it has one joint more than
/// elements, and the attributes of joints hold a row for each, strand after strand.
///
/// ```
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
///
/// let coil = Element { length: 3.0, ..Element::coil(0.5, 1.0) };
/// let elements = Strands::from_counts([2], vec![coil; 2])?;
/// let groom = HelixGroom::new(vec![Frame::IDENTITY], elements)?;
/// assert_eq!(groom.strand(0).length(), 6.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HelixGroom {
    /// Metres in one unit of length, where it is known.
    pub unit: Option<f64>,
    /// The axis that is up, where it is known.
    pub up: Option<UpAxis>,
    // Invariant: one root a strand, attribute rows match, kept strands ascend, are there
    // and have no elements.
    roots: Vec<Frame>,
    elements: Strands<Element>,
    strand_attributes: Attributes,
    joint_attributes: Attributes,
    kept: Kept,
}

impl HelixGroom {
    /// Roots and elements without attributes, unit and up axis unknown.
    ///
    /// # Errors
    ///
    /// If there is not one root a strand.
    pub fn new(roots: Vec<Frame>, elements: Strands<Element>) -> Result<Self, GroomError> {
        let strand_attributes = Attributes::new(elements.len());
        let joint_attributes = Attributes::new(elements.points().len() + elements.len());
        Self::with_attributes(roots, elements, strand_attributes, joint_attributes, Kept::default())
    }

    /// All parts of a groom of super-helices.
    ///
    /// # Errors
    ///
    /// If there is not one root a strand, if an attribute table has not one row a strand or joint,
    /// or if a kept polyline stands for no strand or for one with elements.
    pub fn with_attributes(
        roots: Vec<Frame>,
        elements: Strands<Element>,
        strand_attributes: Attributes,
        joint_attributes: Attributes,
        kept: Kept,
    ) -> Result<Self, GroomError> {
        if roots.len() != elements.len() {
            return Err(GroomError::Roots { roots: roots.len(), strands: elements.len() });
        }
        check_rows("strands", &strand_attributes, elements.len())?;
        check_rows("joints", &joint_attributes, elements.points().len() + elements.len())?;
        check_rows("kept points", &kept.point_attributes, kept.polylines.points().len())?;
        check_kept(&kept, &elements)?;
        let (unit, up) = (None, None);
        Ok(Self { unit, up, roots, elements, strand_attributes, joint_attributes, kept })
    }

    /// The same groom, said to be in this unit and with this axis up.
    #[must_use]
    pub fn in_space(mut self, unit: Option<f64>, up: Option<UpAxis>) -> Self {
        self.unit = unit;
        self.up = up;
        self
    }

    /// The same groom with other elements (the counts may differ) and no attributes of joints.
    ///
    /// # Errors
    ///
    /// If there are not as many strands.
    pub fn with_elements(&self, elements: Strands<Element>) -> Result<Self, GroomError> {
        let joints = Attributes::new(elements.points().len() + elements.len());
        let (roots, strands) = (self.roots.clone(), self.strand_attributes.clone());
        let groom = Self::with_attributes(roots, elements, strands, joints, self.kept.clone())?;
        Ok(groom.in_space(self.unit, self.up))
    }

    /// How many strands there are, kept ones included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.roots.len()
    }

    /// Whether there are no strands.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// Strand `i`; one without elements when it is [kept](Self::kept_polyline) as a polyline.
    #[must_use]
    pub fn strand(&self, i: usize) -> SuperHelix<'_> {
        SuperHelix { root: self.roots[i], elements: self.elements.strand(i) }
    }

    /// All strands in turn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = SuperHelix<'_>> {
        (0..self.len()).map(|i| self.strand(i))
    }

    /// The root frames.
    #[must_use]
    pub fn roots(&self) -> &[Frame] {
        &self.roots
    }

    /// The root frames, to be moved.
    pub fn roots_mut(&mut self) -> &mut [Frame] {
        &mut self.roots
    }

    /// The elements.
    #[must_use]
    pub fn elements(&self) -> &Strands<Element> {
        &self.elements
    }

    /// The elements, to be bent and stretched.
    pub fn elements_mut(&mut self) -> &mut Strands<Element> {
        &mut self.elements
    }

    /// Columns with one row a strand.
    #[must_use]
    pub fn strand_attributes(&self) -> &Attributes {
        &self.strand_attributes
    }

    /// Columns with one row a joint, where elements begin and at the tip.
    #[must_use]
    pub fn joint_attributes(&self) -> &Attributes {
        &self.joint_attributes
    }

    /// Attaches a column with one row a strand; one of the same name is replaced.
    ///
    /// # Errors
    ///
    /// If there is not one row a strand.
    pub fn insert_strand_attribute(
        &mut self,
        name: impl Into<String>,
        column: Column,
    ) -> Result<(), ColumnError> {
        self.strand_attributes.insert(name, column).map(drop)
    }

    /// Attaches a column with one row a joint; one of the same name is replaced.
    ///
    /// # Errors
    ///
    /// If there is not one row a joint.
    pub fn insert_joint_attribute(
        &mut self,
        name: impl Into<String>,
        column: Column,
    ) -> Result<(), ColumnError> {
        self.joint_attributes.insert(name, column).map(drop)
    }

    /// Where the joints of strand `i` lie in the attributes of joints.
    #[must_use]
    pub fn joint_range(&self, i: usize) -> std::ops::Range<usize> {
        let elements = self.elements.range(i);
        elements.start + i..elements.end + i + 1
    }

    /// The strands that are not helices.
    #[must_use]
    pub fn kept(&self) -> &Kept {
        &self.kept
    }

    /// The polyline that strand `i` is kept as, when it is not a helix, and its place among the
    /// kept ones.
    #[must_use]
    pub fn kept_polyline(&self, i: usize) -> Option<(usize, &[DVec3])> {
        let entry = self.kept.strands.binary_search(&u32::try_from(i).ok()?).ok()?;
        Some((entry, self.kept.polylines.strand(entry)))
    }

    /// Appends the strands of another groom.
    ///
    /// # Errors
    ///
    /// If the other is in another unit, has another axis up or other attributes, or if both have
    /// too many elements; this groom is then as it was.
    pub fn append(&mut self, other: &Self) -> Result<(), JoinError> {
        check_space((self.unit, self.up), (other.unit, other.up))?;
        let mut joined = self.clone();
        let first = u32::try_from(self.len()).unwrap_or(u32::MAX);
        joined.strand_attributes.append(&other.strand_attributes)?;
        joined.joint_attributes.append(&other.joint_attributes)?;
        joined.kept.point_attributes.append(&other.kept.point_attributes)?;
        joined.elements.append(&other.elements)?;
        joined.kept.polylines.append(&other.kept.polylines)?;
        joined.kept.strands.extend(other.kept.strands.iter().map(|strand| first + strand));
        joined.roots.extend_from_slice(&other.roots);
        *self = joined;
        Ok(())
    }

    /// The strands named, ascending and each once, with their attributes.
    ///
    /// # Panics
    ///
    /// If a strand is not there, or they do not ascend.
    #[must_use]
    pub fn select(&self, strands: &[usize]) -> Self {
        let elements = self.elements.select(strands.iter().copied());
        let n_joints = elements.points().len() + elements.len();
        let joints = || strands.iter().flat_map(|&i| self.joint_range(i));
        let kept = strands.iter().enumerate();
        let kept: Vec<(usize, usize)> =
            kept.filter_map(|(to, &from)| Some((to, self.kept_polyline(from)?.0))).collect();
        let entries = || kept.iter().map(|&(_, entry)| entry);
        let polylines = self.kept.polylines.select(entries());
        let points = || entries().flat_map(|entry| self.kept.polylines.range(entry));
        let kept = Kept {
            strands: kept.iter().map(|&(to, _)| u32::try_from(to).unwrap_or(u32::MAX)).collect(),
            point_attributes: self
                .kept
                .point_attributes
                .map(polylines.points().len(), |column| column.select(points())),
            polylines,
        };
        let rows = |column: &Column| column.select(strands.iter().copied());
        Self::with_attributes(
            strands.iter().map(|&i| self.roots[i]).collect(),
            elements,
            self.strand_attributes.map(strands.len(), rows),
            self.joint_attributes.map(n_joints, |column| column.select(joints())),
            kept,
        )
        .expect("rows were taken along with their strands")
        .in_space(self.unit, self.up)
    }
}

fn check_kept(kept: &Kept, elements: &Strands<Element>) -> Result<(), GroomError> {
    let mut least = 0;
    for (entry, &strand) in kept.strands.iter().enumerate() {
        let there = (strand as usize) < elements.len() && entry < kept.polylines.len();
        if strand < least || !there || !elements.strand(strand as usize).is_empty() {
            return Err(GroomError::Kept { entry, strand });
        }
        least = strand + 1;
    }
    if kept.polylines.len() == kept.strands.len() {
        return Ok(());
    }
    Err(GroomError::Kept { entry: kept.strands.len(), strand: u32::MAX })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(kept: Vec<u32>) -> Result<HelixGroom, GroomError> {
        let elements = Strands::from_counts([1, 0, 2], vec![Element::default(); 3]).unwrap();
        let n = kept.len();
        let polylines = Strands::from_counts(vec![1; n], vec![DVec3::ONE; n]).unwrap();
        let kept = Kept { strands: kept, polylines, point_attributes: Attributes::new(n) };
        let tables = (Attributes::new(3), Attributes::new(6));
        HelixGroom::with_attributes(vec![Frame::IDENTITY; 3], elements, tables.0, tables.1, kept)
    }

    #[test]
    fn kept_strands_are_found_again() {
        let groom = parts(vec![1]).expect("strand 1 is there");
        assert!(groom.kept_polyline(0).is_none());
        assert_eq!(
            groom.kept_polyline(1).map(|(entry, points)| (entry, points.len())),
            Some((0, 1))
        );
        assert_eq!(groom.joint_range(2), 3..6);
    }

    #[test]
    fn strands_have_the_elements_that_were_given() {
        let groom = parts(vec![1]).expect("strand 1 is there");
        assert_eq!(groom.elements().counts().collect::<Vec<_>>(), [1, 0, 2]);
        let counts: Vec<usize> = groom.iter().map(|strand| strand.elements.len()).collect();
        assert_eq!(counts, [1, 0, 2]);
    }

    #[test]
    fn selecting_takes_kept_strands_along() {
        let groom = parts(vec![1]).expect("strand 1 is there");
        let picked = groom.select(&[1, 2]);
        assert_eq!((picked.len(), picked.strand(1).elements.len()), (2, 2));
        assert!(picked.kept_polyline(0).is_some() && picked.kept_polyline(1).is_none());
        assert_eq!(groom.select(&[0]).kept().strands, [0_u32; 0]);
        assert_eq!(groom.select(&[0]).select(&[]).len(), 0);
    }

    #[test]
    fn parts_joined_are_the_whole() {
        let groom = parts(vec![1]).expect("strand 1 is there");
        let mut joined = groom.select(&[0]);
        joined.append(&groom.select(&[1, 2])).expect("parts of one groom are alike");
        assert_eq!(joined, groom);
        let error = joined.append(&groom.clone().in_space(Some(1.0), None));
        assert_eq!(error, Err(JoinError::Space("the unit")));
        assert_eq!(joined, groom);
    }

    #[test]
    fn kept_strands_that_cannot_be_are_refused() {
        assert_eq!(parts(vec![2]), Err(GroomError::Kept { entry: 0, strand: 2 }));
        assert_eq!(parts(vec![3]), Err(GroomError::Kept { entry: 0, strand: 3 }));
        assert_eq!(parts(vec![1, 1]), Err(GroomError::Kept { entry: 1, strand: 1 }));
        assert_eq!(parts(vec![1, 0]), Err(GroomError::Kept { entry: 1, strand: 0 }));
    }
}
