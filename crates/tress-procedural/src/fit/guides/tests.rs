//! The sweep against differences, and guides that find their way back.

use super::*;

fn grid() -> EvenStrands {
    let strand = |i: u32| {
        let root = DVec3::new(f64::from(i % 6), 0.0, f64::from(i / 6));
        (0..20).map(move |j| {
            let s = 0.2 * f64::from(j);
            root + DVec3::new(0.1 * s * s, -s, 0.3 * (0.7 * s + root.x).sin())
        })
    };
    EvenStrands::new(20, (0..36).flat_map(strand).collect()).expect("whole strands")
}

#[test]
fn the_sweep_agrees_with_differences() {
    let guide = grid().strand(7).to_vec();
    let weights: Vec<DVec3> =
        (0..20).map(f64::from).map(|x| DVec3::new(x.sin(), x.cos(), 0.3 * x)).collect();
    let loss =
        |guide: &[DVec3]| -> f64 { guide.iter().zip(&weights).map(|(x, w)| x.dot(*w)).sum() };
    let (mut turning, mut length) = (vec![DVec3::ZERO; 19], vec![DVec3::ZERO; 19]);
    sweep(&guide, &weights, &mut turning, &mut length);
    for k in 0..19 {
        for axis in DVec3::AXES {
            let moved = |h: f64| {
                let mut guide = guide.clone();
                let mut unit = vec![DVec3::ZERO; 19];
                unit[k] = axis;
                advance(&mut guide, &unit, &vec![DVec3::ZERO; 19], -h, 0.0);
                loss(&guide)
            };
            let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((difference - turning[k].dot(axis)).abs() < 1e-7, "turning at {k}");
        }
        let moved = |h: f64| {
            let mut guide = guide.clone();
            let mut unit = vec![DVec3::ZERO; 19];
            unit[k] = DVec3::X;
            advance(&mut guide, &vec![DVec3::ZERO; 19], &unit, 0.0, -h);
            loss(&guide)
        };
        let segment = guide[k].distance(guide[k + 1]);
        let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
        assert!((difference - segment * length[k].x).abs() < 1e-7, "length of {k}");
    }
}

#[test]
fn bent_guides_find_their_way_back() {
    let truth = grid();
    let roots = Roots { positions: truth.roots(), uv: None };
    let instances = Instances::by_distance(&roots, &roots, 4, 0.5);
    let targets = instances.instance(&truth, &roots.positions);
    let mut guides = truth.clone();
    let unit = vec![DVec3::X; 19];
    for i in 0..guides.len() {
        advance(guides.strand_mut(i), &unit, &unit, 0.02, 0.1);
    }
    let sound: Vec<usize> = (0..36).collect();
    let mut losses = Vec::new();
    let options = GuideOptions::default();
    let mut watch = |loss| losses.push(loss);
    let last =
        refine_guides(&mut guides, &roots, &instances, &targets, &sound, &options, &mut watch)
            .expect("finite losses");
    assert!(last < 0.02 * losses[0], "{last} from {}", losses[0]);
    assert_eq!(guides.roots(), truth.roots());
}

#[test]
fn a_loss_that_is_not_a_number_is_said() {
    let mut guides = grid();
    let roots = Roots { positions: guides.roots(), uv: None };
    let instances = Instances::by_distance(&roots, &roots, 4, 0.5);
    let mut targets = guides.clone();
    targets.strand_mut(3)[4].x = f64::NAN;
    let before = guides.clone();
    let sound: Vec<usize> = (0..36).collect();
    let options = GuideOptions::default();
    let error =
        refine_guides(&mut guides, &roots, &instances, &targets, &sound, &options, &mut |_| {});
    assert!(error.is_err_and(|error| error.to_string().contains("step 0")));
    assert_eq!(guides, before);
}
