//! Which strands belong together.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use tress_analysis::{ClusterError, k_means, root_tip_features};
use tress_geometry::{Column, HelixGroom};

/// How strands are grouped.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Grouping {
    /// All strands together.
    #[default]
    Whole,
    /// Strands with the same value of an attribute of strands.
    Attribute(String),
    /// This many clusters of strands whose roots and tips are near each other [CSE 5.3].
    Clusters(usize),
}

/// Why strands cannot be grouped.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GroupError {
    /// No attribute of strands has this name.
    #[error("no attribute of strands is called {name:?}; there is: {}", list(.known))]
    NoAttribute {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// The strands cannot be clustered.
    #[error(transparent)]
    Cluster(#[from] ClusterError),
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".into() } else { names.join(", ") }
}

/// The group of each strand, numbered from 0 in the order of first appearance (for clusters, as the
/// clusters are).
///
/// ```
/// use tress_edit::{Grouping, groups};
/// use tress_geometry::{Frame, HelixGroom, Strands};
///
/// let elements = Strands::from_counts([0, 0], vec![])?;
/// let groom = HelixGroom::new(vec![Frame::IDENTITY; 2], elements)?;
/// assert_eq!(groups(&groom, &Grouping::Whole, 0)?, [0, 0]);
/// let error = groups(&groom, &Grouping::Attribute("wisp".into()), 0).unwrap_err();
/// assert_eq!(error.to_string(), r#"no attribute of strands is called "wisp"; there is: none"#);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If there is no such attribute, or not a strand for each cluster.
pub fn groups(groom: &HelixGroom, grouping: &Grouping, seed: u64) -> Result<Vec<u32>, GroupError> {
    match grouping {
        Grouping::Whole => Ok(vec![0; groom.len()]),
        Grouping::Clusters(n) => Ok(k_means(&root_tip_features(groom), *n, seed)?.assignment),
        Grouping::Attribute(name) => match groom.strand_attributes().get(name) {
            Some(column) => Ok(number_values(column)),
            None => {
                let known = groom.strand_attributes().iter().map(|(name, _)| name.into());
                Err(GroupError::NoAttribute { name: name.clone(), known: known.collect() })
            }
        },
    }
}

/// The rows of a column, equal ones with equal numbers.
fn number_values(column: &Column) -> Vec<u32> {
    let components = column.components();
    let mut numbers = BTreeMap::new();
    let mut number = |key: Vec<u64>| {
        let next = u32::try_from(numbers.len()).expect("offsets of strands have 32 bits");
        *numbers.entry(key).or_insert(next)
    };
    match column {
        Column::Int(values) => values.iter().map(|v| number(vec![v.cast_unsigned()])).collect(),
        Column::Float { values, .. } => values
            .chunks_exact(components)
            .map(|row| number(row.iter().map(|v| v.to_bits()).collect()))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use tress_geometry::{Element, Frame, Strands};

    use super::*;

    #[test]
    fn equal_values_share_a_number() {
        assert_eq!(number_values(&Column::Int(vec![7, -1, 7])), [0, 1, 0]);
        let pairs = Column::Float { components: 2, values: vec![1.0, 2.0, 1.0, 3.0, 1.0, 2.0] };
        assert_eq!(number_values(&pairs), [0, 1, 0]);
    }

    #[test]
    fn strands_are_grouped_by_what_they_have_and_where_they_are() {
        let straight = Element { length: 1.0, ..Element::default() };
        let at = |x: f64| Frame { position: DVec3::X * x, ..Frame::IDENTITY };
        let roots = [0.0, 0.1, 9.0, 0.2, 9.1].map(at).to_vec();
        let elements = Strands::from_counts([1; 5], vec![straight; 5]).expect("five elements");
        let mut groom = HelixGroom::new(roots, elements).expect("a root a strand");
        let wisp = Column::Int(vec![4, 4, 7, 7, 4]);
        groom.insert_strand_attribute("wisp", wisp).expect("a row a strand");
        let by_wisp = groups(&groom, &Grouping::Attribute("wisp".into()), 0);
        assert_eq!(by_wisp, Ok(vec![0, 0, 1, 1, 0]));
        let near = groups(&groom, &Grouping::Clusters(2), 0).expect("more strands than clusters");
        assert!(near[0] == near[1] && near[0] == near[3] && near[2] == near[4]);
        assert_ne!(near[0], near[2]);
        let error = groups(&groom, &Grouping::Attribute("curl".into()), 0).unwrap_err();
        assert!(error.to_string().ends_with("there is: wisp"), "{error}");
    }
}
