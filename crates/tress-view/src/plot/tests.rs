use super::*;

fn waves(n: u32) -> Vec<(Vec<f64>, Vec<f64>)> {
    (0..n)
        .map(|i| {
            let x: Vec<f64> = (0..=50).map(|k| f64::from(k) / 50.0).collect();
            let y = x.iter().map(|x| (6.0 * x + 0.001 * f64::from(i)).sin()).collect();
            (x, y)
        })
        .collect()
}

fn density(lines: &[(Vec<f64>, Vec<f64>)]) -> Density {
    Density::of(lines.iter().map(|(x, y)| Line { x, y }), [0.0, 1.0])
}

fn plot(layers: Vec<Layer>) -> Plot {
    Plot {
        title: "T".into(),
        x: "along (cm)".into(),
        y: "up (1/cm)".into(),
        layers,
        ..Plot::default()
    }
}

#[test]
fn a_thousand_lines_have_the_quantiles_of_their_values() {
    let density = density(&waves(1000));
    let (x, q) = density.quantiles().nth(100).expect("lines reach it");
    let at = |share: f64| (6.0 * x + 0.999 * share).sin();
    let mut ends = [at(0.05), at(0.5), at(0.95)];
    ends.sort_unstable_by(f64::total_cmp);
    for (found, expected) in [q[0], q[2], q[4]].iter().zip(ends) {
        assert!((found - expected).abs() < 0.01, "{q:?} {ends:?}");
    }
}

#[test]
fn every_line_is_counted_once_a_column_and_tips_end_it() {
    let half = (vec![0.0, 0.5], vec![1.0, 1.0]);
    let density = density(&[half]);
    let reached = density.quantiles().count();
    assert!((119..=121).contains(&reached), "{reached} of 240 columns");
    let dark: Vec<f64> = density.runs().iter().map(|run| run.1).collect();
    assert!(!dark.is_empty() && dark.iter().all(|d| (d - 1.0).abs() < 1e-12));
}

#[test]
fn svg_and_pixels_show_the_same_layers() {
    let lines = waves(300);
    let bars = histogram(&lines[0].1, 12);
    let all = vec![
        Layer::Density(density(&lines)),
        Layer::Band {
            points: vec![[0.0, -0.5, 0.0], [1.0, -0.2, 0.3]],
            name: "band".into(),
            color: COLORS[1],
            opacity: 0.4,
        },
        Layer::line(vec![[0.0, 0.0], [f64::NAN, 1.0], [0.5, 0.4], [1.0, 1.0]], COLORS[0])
            .named("line"),
        Layer::bars(bars).named("bars"),
    ];
    let plot = plot(all);
    let svg = plot.svg(Size::new(600, 400)).expect("room enough");
    for word in ["along (cm)", "up (1/cm)", "band", "line", "bars", "<rect", "<polyline"] {
        assert!(svg.contains(word), "{word}");
    }
    assert!(!svg.contains("NaN") && svg.len() < 2_000_000, "{}", svg.len());
    assert_eq!(svg, plot.svg(Size::new(600, 400)).expect("room enough"));
    let image = plot.picture(Size::new(600, 400)).expect("room enough");
    let inked = image.pixels().filter(|p| p.0 != [255; 3]).count();
    assert!(10_000 < inked, "{inked}");
}

#[test]
fn plots_of_nothing_and_of_one_value_are_drawn() {
    let size = Size::new(300, 200);
    let nothing = [
        plot(vec![]),
        plot(vec![Layer::Density(density(&[]))]),
        plot(vec![Layer::bars(histogram(&[], 5))]),
        plot(vec![Layer::bars(histogram(&[3.0; 9], 5))]),
        plot(vec![Layer::line(vec![[f64::INFINITY, 0.0]], COLORS[0])]),
        plot(vec![Layer::Density(density(&[(vec![0.0, 1.0], vec![0.0, 0.0])]))]),
    ];
    for plot in nothing {
        assert!(plot.svg(size).is_ok() && plot.picture(size).is_ok(), "{plot:?}");
    }
    assert!(plot(vec![]).picture(Size::new(100_000, 100_000)).is_err());
}

#[test]
fn no_value_is_lost_from_a_histogram() {
    let values: Vec<f64> = (0..100).map(|i| f64::from(i * i)).collect();
    for bars in [1, 7, 50] {
        let total: f64 = histogram(&values, bars).iter().map(|bar| bar.height).sum();
        assert!((total - 100.0).abs() < 1e-9);
        let within = histogram_within(&values, bars, [100.0, 200.0]);
        let total: f64 = within.iter().map(|bar| bar.height).sum();
        assert!((total - 100.0).abs() < 1e-9);
    }
    assert!(histogram(&values, 0).is_empty());
}
