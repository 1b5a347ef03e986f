use proptest::prelude::*;

use super::*;

fn scale(min: f64, max: f64) -> Scale {
    Scale { min, max, ..Scale::default() }
}

proptest! {
    #[test]
    fn ticks_are_round_few_within_and_told_apart(
        middle in -1e6_f64..1e6,
        magnitude in -8_i32..8,
        digit in 1.0_f64..10.0,
        most in 5_usize..12,
    ) {
        let half = digit * 10_f64.powi(magnitude);
        let (low, high) = (middle - half, middle + half);
        prop_assume!(1e-9 * middle.abs() < half);
        let ticks = scale(low, high).ticks(most);
        prop_assert!((2..=most).contains(&ticks.len()), "{ticks:?}");
        let slack = 1e-6 * half;
        for pair in ticks.windows(2) {
            prop_assert!(pair[0].value < pair[1].value && pair[0].label != pair[1].label);
        }
        for tick in &ticks {
            prop_assert!(low - slack <= tick.value && tick.value <= high + slack);
            let read: f64 = tick.label.replace('\u{2212}', "-").parse().expect("a number");
            prop_assert!((read - tick.value).abs() <= 1e-6 * half, "{tick:?}");
        }
    }
}

#[test]
fn odd_ranges_have_sensible_ticks() {
    let labels = |scale: Scale| -> Vec<String> {
        scale.ticks(6).into_iter().map(|tick| tick.label).collect()
    };
    assert_eq!(labels(scale(-4.5, -4.5)), ["\u{2212}4.5"]);
    assert_eq!(labels(Scale::spanning([f64::NAN, f64::INFINITY])), ["0"]);
    assert!(labels(scale(f64::NAN, 1.0)).is_empty());
    assert!(labels(scale(f64::MIN, f64::MAX)).is_empty());
    assert_eq!(labels(scale(1.0, 0.0)), labels(scale(0.0, 1.0)));
    assert_eq!(labels(scale(0.0, 3e6)), ["0", "1e6", "2e6", "3e6"]);
}

#[test]
fn places_are_held_within_and_nothing_is_nowhere() {
    let s = scale(-2.0, 6.0);
    assert_eq!(s.place(0.0), Some(0.25));
    assert_eq!((s.place(-9.0), s.place(f64::INFINITY)), (Some(0.0), Some(1.0)));
    assert_eq!(s.place(f64::NAN), None);
    assert_eq!(scale(3.0, 3.0).place(3.0), Some(0.5));
    assert_eq!(scale(f64::MIN, f64::MAX).place(0.0), Some(0.5));
    assert_eq!(s.clone().symmetric().place(0.0), Some(0.5));
    assert_eq!(s.color(f64::NAN), None);
}

#[test]
fn lightness_rises_along_the_sequential_maps() {
    for map in [ColorMap::Viridis, ColorMap::Cividis] {
        let lightness = |i: u8| crate::color::lightness(map.rgb(f64::from(i) / 20.0));
        let steps: Vec<f32> = (1..=20).map(|i| lightness(i) - lightness(i - 1)).collect();
        assert!(steps.iter().all(|&step| 0.02 < step && step < 0.07), "{map:?}: {steps:?}");
    }
    for map in [ColorMap::BlueRed, ColorMap::PurpleGreen] {
        let [low, middle, high] = [0.0, 0.5, 1.0].map(|t| crate::color::lightness(map.rgb(t)));
        assert!((low - high).abs() < 0.15 && low < middle - 0.3, "{map:?}: {low} {middle} {high}");
    }
}

#[test]
fn scales_are_written_by_hand() {
    let text = r#"(min: -1, max: 1, title: "twist", unit: "1/cm", map: BlueRed)"#;
    let scale: Scale = ron::from_str(text).expect("a scale");
    assert_eq!(scale.caption(), "twist (1/cm)");
    assert!(ron::from_str::<Scale>("(minimum: 0)").is_err());
}
