use super::*;
use crate::Helicoid;

fn groom() -> HelicoidGroom {
    let piece = Piece { k: Helicoid::new(1.0, 0.1, 0.2, 0.3), length: 1.0 };
    let pieces = Strands::from_counts([2, 0, 1], vec![piece; 3]).expect("counts sum to 3");
    let mut attributes = Attributes::new(3);
    attributes.insert("id", Column::Int(vec![4, 5, 6])).expect("a row a strand");
    let kept = BTreeMap::from([(1, vec![DVec3::ONE])]);
    HelicoidGroom::with_attributes(vec![Frame::IDENTITY; 3], pieces, attributes, kept)
        .expect("parts match")
        .in_space(Some(0.01), Some(UpAxis::Y))
}

#[test]
fn ron_keeps_everything() {
    let text = ron::ser::to_string_pretty(&groom(), ron::ser::PrettyConfig::default());
    assert_eq!(ron::from_str(&text.expect("plain data")), Ok(groom()));
}

#[test]
fn sampled_strands_keep_count_order_attributes_and_lost_causes() {
    let polylines = sample(&groom(), 5, Tracing::default()).expect("clear");
    assert_eq!(polylines.strands().counts().collect::<Vec<_>>(), [5, 1, 5]);
    assert_eq!(polylines.strands().strand(1), [DVec3::ONE]);
    assert_eq!(polylines.strand_attributes().get("id"), Some(&Column::Int(vec![4, 5, 6])));
    assert_eq!((polylines.unit, polylines.up), (Some(0.01), Some(UpAxis::Y)));
}

#[test]
fn selecting_takes_all_along() {
    let picked = groom().select(&[2, 1]);
    assert_eq!(picked.hair(0).pieces.len(), 1);
    assert_eq!(picked.kept().get(&1), Some(&vec![DVec3::ONE]));
    assert_eq!(picked.strand_attributes().get("id"), Some(&Column::Int(vec![6, 5])));
}

#[test]
fn parts_that_do_not_match_are_refused() {
    let roots = HelicoidGroom::new(vec![Frame::IDENTITY; 2], Strands::default());
    assert!(matches!(roots, Err(HelicoidGroomError::Parts(GroomError::Roots { .. }))));
    let kept = BTreeMap::from([(7, vec![])]);
    let stray =
        HelicoidGroom::with_attributes(vec![], Strands::default(), Attributes::new(0), kept);
    assert!(matches!(stray, Err(HelicoidGroomError::Parts(GroomError::Kept { strand: 7, .. }))));
    let rows =
        HelicoidGroom::with_attributes(vec![], Strands::default(), Attributes::new(1), [].into());
    assert!(matches!(rows, Err(HelicoidGroomError::Parts(GroomError::Rows { .. }))));
    let negative = Piece { k: Helicoid::default(), length: -1.0 };
    let strands = Strands::from_counts([1], vec![negative]).expect("counts sum to 1");
    let broken = HelicoidGroom::new(vec![Frame::IDENTITY], strands);
    assert_eq!(broken, Err(HelicoidGroomError::Strand { strand: 0 }));
}

#[test]
fn hairs_that_cannot_be_traced_are_named() {
    let sink = Piece { k: Helicoid::new(0.0, -2.0, 0.0, 0.0), length: 1.0 };
    let strands = Strands::from_counts([0, 1], vec![sink]).expect("counts sum to 1");
    let hairs = HelicoidGroom::new(vec![Frame::IDENTITY; 2], strands).expect("parts match");
    let error = sample(&hairs, 4, Tracing::default());
    assert!(matches!(error, Err(SampleError::Trace { strand: 1, .. })));
    assert_eq!(sample(&hairs, 1, Tracing::default()), Err(SampleError::Points(1)));
}
