//! Switchbacks put into a groom, wisp by wisp.

use std::collections::BTreeMap;

use rand::RngExt;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_edit::strand_rng;
use tress_geometry::{
    Attributes, Element, GroomError, HelixGroom, OffsetsError, Strands, SuperHelix, polyline,
};

use super::{InsertError, InsertOptions, Placed, Shapes, insert_shape};

/// Where switchbacks go. All strands of a wisp get theirs at the same arc lengths from the root, so
/// that the wisp stays one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Placing {
    /// At these arc lengths from the root.
    ArcLengths(Vec<f64>),
    /// At these shares, 0 to 1, of the median length of the wisp's strands.
    Shares(Vec<f64>),
    /// At random, so many in a unit of arc length on average, independently of each other. Those
    /// that fall on the room of another, or on the strand's ends, are left out.
    Density(f64),
}

/// What was put into a groom.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InsertReport {
    /// Every switchback with the strand it is in, by strand and from the root.
    pub placed: Vec<(u32, Placed)>,
    /// Strands that got at least one.
    pub strands: usize,
    /// Places asked for, summed over strands.
    pub asked: usize,
    /// Places refused for want of room, the ends of a strand and other switchbacks included.
    pub no_room: usize,
    /// Places refused because the strand has no coil there.
    pub no_coil: usize,
    /// The longest room that was wanting on one side, 0 if none was.
    pub most_needed: f64,
}

/// Why a groom got no switchbacks at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InsertGroomError {
    /// An option is out of its range.
    #[error(transparent)]
    Options(#[from] InsertError),
    /// Not one group a strand.
    #[error("{groups} group numbers for {strands} strands")]
    Groups {
        /// Group numbers given.
        groups: usize,
        /// Strands in the groom.
        strands: usize,
    },
    /// The strands have more elements than can be counted.
    #[error(transparent)]
    TooMany(#[from] OffsetsError),
    /// The parts do not fit together.
    #[error(transparent)]
    Groom(#[from] GroomError),
}

/// Puts switchbacks into every strand of every wisp; `groups[i]` is the wisp of strand `i`.
///
/// Strands of a wisp take theirs at the same places, drawn from the seed and the wisp's number.
/// A place that a strand has no room or no coil for is left out on that strand alone and counted.
/// Attributes of joints are carried along by arc length.
///
/// ```
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
/// use tress_switchback::{InsertOptions, Placing, insert};
///
/// let coil = vec![Element { length: 0.5, ..Element::coil(0.5, 1.0) }; 120];
/// let elements = Strands::from_counts([120, 120], [coil.clone(), coil].concat())?;
/// let groom = HelixGroom::new(vec![Frame::IDENTITY; 2], elements)?;
/// let middle = Placing::Shares(vec![0.5]);
/// let (_, report) = insert(&groom, &[0, 0], &middle, &InsertOptions::default(), 1)?;
/// assert_eq!((report.strands, report.no_room), (2, 0));
/// assert!((report.placed[1].1.arc_length - 30.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If an option is out of range or there is not one group a strand.
pub fn insert(
    groom: &HelixGroom,
    groups: &[u32],
    placing: &Placing,
    options: &InsertOptions,
    seed: u64,
) -> Result<(HelixGroom, InsertReport), InsertGroomError> {
    options.validate()?;
    placing.validate()?;
    if groups.len() != groom.len() {
        return Err(InsertGroomError::Groups { groups: groups.len(), strands: groom.len() });
    }
    let places = places_by_group(groom, groups, placing, seed)?;
    let shapes = Shapes::new(*options);
    let changed: Vec<Changed> = (0..groom.len())
        .into_par_iter()
        .map(|i| Changed::new(&groom.strand(i), &places[&groups[i]], &shapes))
        .collect();
    let mut report = InsertReport::default();
    for (i, strand) in changed.iter().enumerate() {
        report.count(u32::try_from(i).unwrap_or(u32::MAX), strand);
    }
    Ok((assemble(groom, changed)?, report))
}

/// Places that are drawn for a strand, at most: far more than any hair has.
const MOST_PLACES: f64 = 1e3;

impl Placing {
    fn validate(&self) -> Result<(), InsertError> {
        let out = |name, value, expected| Err(InsertError::Option { name, value, expected });
        match self {
            Self::ArcLengths(places) => {
                match places.iter().find(|s| !(s.is_finite() && 0.0 <= **s)) {
                    Some(&s) => out("an arc length", s, "0 or more"),
                    None => Ok(()),
                }
            }
            Self::Shares(shares) => match shares.iter().find(|s| !(0.0..=1.0).contains(*s)) {
                Some(&share) => out("a share of the strand", share, "0 to 1"),
                None => Ok(()),
            },
            Self::Density(density) if !(density.is_finite() && 0.0 <= *density) => {
                out("the density", *density, "0 or more in a unit of length")
            }
            Self::Density(_) => Ok(()),
        }
    }

    /// The places on a wisp of this length, ascending; an error where there are far too many.
    fn places(&self, length: f64, mut rng: impl rand::Rng) -> Result<Vec<f64>, InsertError> {
        let mut places: Vec<f64> = match self {
            Self::ArcLengths(places) => places.clone(),
            Self::Shares(shares) => shares.iter().map(|share| share * length).collect(),
            Self::Density(density) if MOST_PLACES < density * length => {
                let (name, value) = ("the number of switchbacks on a strand", density * length);
                return Err(InsertError::Option { name, value, expected: "1,000 at most" });
            }
            Self::Density(density) => {
                // Gaps of a Poisson process; none where nothing is asked for.
                let mut s = 0.0;
                let gap = || {
                    let uniform: f64 = rng.random();
                    s -= (1.0 - uniform).ln() / density;
                    Some(s)
                };
                std::iter::from_fn(gap).take_while(|s| *s < length).collect()
            }
        };
        places.sort_unstable_by(f64::total_cmp);
        Ok(places)
    }
}

/// The places of every group, by its number.
fn places_by_group(
    groom: &HelixGroom,
    groups: &[u32],
    placing: &Placing,
    seed: u64,
) -> Result<BTreeMap<u32, Vec<f64>>, InsertError> {
    let mut lengths: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
    for (strand, &group) in groom.iter().zip(groups) {
        lengths.entry(group).or_default().push(strand.length());
    }
    let median = |mut lengths: Vec<f64>| {
        lengths.sort_unstable_by(f64::total_cmp);
        lengths.get(lengths.len() / 2).copied().unwrap_or(0.0)
    };
    let places = lengths.into_iter().map(|(group, lengths)| {
        let rng = strand_rng(seed, group as usize);
        Ok((group, placing.places(median(lengths), rng)?))
    });
    places.collect()
}

/// A strand with its switchbacks.
struct Changed {
    /// `None` where the strand is as it was.
    elements: Option<Vec<Element>>,
    placed: Vec<Placed>,
    refused: Vec<InsertError>,
}

impl Changed {
    /// From root to tip, so that each place finds the coil it would have found without the others.
    fn new(strand: &SuperHelix<'_>, places: &[f64], shapes: &Shapes) -> Self {
        let mut changed = Self { elements: None, placed: Vec::new(), refused: Vec::new() };
        let mut from = 0.0;
        for &place in places {
            let elements = changed.elements.as_deref().unwrap_or(strand.elements);
            let current = SuperHelix { root: strand.root, elements };
            match insert_shape(&current, place, from, shapes) {
                Ok((elements, placed)) => {
                    from = placed.arc_length + placed.half_width;
                    changed.elements = Some(elements);
                    changed.placed.push(placed);
                }
                Err(error) => changed.refused.push(error),
            }
        }
        changed
    }
}

impl InsertReport {
    fn count(&mut self, i: u32, strand: &Changed) {
        self.strands += usize::from(!strand.placed.is_empty());
        self.asked += strand.placed.len() + strand.refused.len();
        self.placed.extend(strand.placed.iter().map(|&placed| (i, placed)));
        for error in &strand.refused {
            match *error {
                InsertError::NoRoom { needed, .. } => {
                    self.no_room += 1;
                    self.most_needed = self.most_needed.max(needed);
                }
                InsertError::OffStrand { .. } => self.no_room += 1,
                _ => self.no_coil += 1,
            }
        }
    }
}

/// The groom with changed strands; attributes of joints follow by arc length.
fn assemble(groom: &HelixGroom, changed: Vec<Changed>) -> Result<HelixGroom, InsertGroomError> {
    let mut elements = Strands::default();
    for (i, strand) in changed.into_iter().enumerate() {
        match strand.elements {
            Some(new) => elements.push(new)?,
            None => elements.push(groom.elements().strand(i).iter().copied())?,
        }
    }
    let joints = joint_attributes(groom, &elements);
    let assembled = HelixGroom::with_attributes(
        groom.roots().to_vec(),
        elements,
        groom.strand_attributes().clone(),
        joints,
        groom.kept().clone(),
    )?;
    Ok(assembled.in_space(groom.unit, groom.up))
}

fn joint_attributes(groom: &HelixGroom, elements: &Strands<Element>) -> Attributes {
    let rows = elements.points().len() + elements.len();
    if groom.joint_attributes().is_empty() {
        return Attributes::new(rows);
    }
    let mut places = Vec::with_capacity(rows);
    for (i, new) in elements.iter().enumerate() {
        let first = groom.joint_range(i).start;
        let joints = joint_arc_lengths(groom.elements().strand(i));
        places.extend(joint_arc_lengths(new).into_iter().map(|s| {
            let (segment, share) = polyline::place(&joints, s);
            (first + segment, share)
        }));
    }
    groom.joint_attributes().map(rows, |column| column.interpolate(places.iter().copied()))
}

fn joint_arc_lengths(elements: &[Element]) -> Vec<f64> {
    let mut s = 0.0;
    let rest = elements.iter().map(|element| {
        s += element.length;
        s
    });
    std::iter::once(0.0).chain(rest).collect()
}

#[cfg(test)]
mod tests;
