use std::f64::consts::TAU;

use glam::Vec3Swizzles as _;
use proptest::prelude::*;

use super::*;

fn coil(n: u32, per_turn: f64, bend: f64) -> Vec<DVec3> {
    let at = |i| {
        let (sine, cosine) = (f64::from(i) / per_turn * TAU).sin_cos();
        let (across, along) = (bend * f64::from(i) / f64::from(n)).sin_cos();
        let radial = DVec3::new(-across, along, 0.0);
        let axis = DVec3::new(across, 1.0 - along, 0.0) * (0.2 * f64::from(n) / bend);
        axis + 0.5 * (cosine * radial + sine * DVec3::Z)
    };
    (0..n).map(at).collect()
}

#[test]
fn the_inverse_gives_the_offsets_back() {
    for n in [60, 61] {
        let points = coil(n, 5.3, 1.0);
        let strands = Strands::from_counts([points.len()], points.clone()).expect("one strand");
        let spectra = Spectra::of(&strands);
        let line = centerline(&points).expect("a coil");
        for finer in [1, 2, 3] {
            let found = spectra.offsets(finer);
            for (i, offset) in line.offsets(&points).iter().enumerate() {
                let given = found.strand(0)[i * finer];
                assert!(given.distance(offset.yz()) < 1e-5, "{n} {finer} {i}");
            }
        }
        assert!((spectra.radius(0) - 0.5).abs() < 0.02);
        assert!((spectra.step(0) - 0.2).abs() < 0.01);
    }
}

#[test]
fn a_coil_has_the_same_spectrum_wherever_its_axis_goes() {
    let spectrum = |bend| {
        let points = coil(106, 5.3, bend);
        Spectra::of(&Strands::from_counts([points.len()], points).expect("one strand"))
    };
    let (a, b) = (spectrum(1e-6), spectrum(1.0));
    let strength = |s: &Spectra, k: usize| {
        let [u, v] = s.harmonics(0)[k].amplitude.map(f64::from);
        u.hypot(v)
    };
    for k in 0..54 {
        assert!((strength(&a, k) - strength(&b, k)).abs() < 2.0, "{k}");
    }
}

#[test]
fn every_broken_library_is_refused() {
    let good = Spectra::of(&Strands::from_counts([60], coil(60, 5.0, 1.0)).expect("one strand"));
    let bytes = good.to_bytes().expect("a library");
    assert_eq!(Spectra::from_bytes(&bytes).expect("what was written"), good);
    assert_eq!(bytes, good.to_bytes().expect("a library"));
    for end in [0, 4, 8, 60, bytes.len() - 1] {
        assert!(Spectra::from_bytes(&bytes[..end]).is_err());
    }
    let two = vec![Harmonic::default(); 2];
    let pair = || Strands::from_counts([2], two.clone()).expect("one spectrum");
    assert!(Spectra::new(pair(), vec![2], vec![0.0]).is_ok());
    let count = SpectraError::Count { of: "steps", given: 0, spectra: 1 };
    assert_eq!(Spectra::new(pair(), vec![2], vec![]), Err(count));
    let bad = Spectra::new(pair(), vec![2], vec![f64::NAN]);
    assert_eq!(bad, Err(SpectraError::Number { spectrum: 0 }));
    let one = Strands::from_counts([1], two[..1].to_vec()).expect("one spectrum");
    assert!(matches!(Spectra::new(one, vec![0], vec![0.0]), Err(SpectraError::Samples { .. })));
    let other = safetensors::serialize::<&str, safetensors::tensor::TensorView<'_>, _>([], None);
    let error = Spectra::from_bytes(&other.expect("nothing")).expect_err("no library");
    assert!(matches!(error, ReadSpectraError::Format(_)));
}

proptest! {
    #[test]
    fn bytes_of_any_kind_are_read_or_refused(
        at in 0_usize..4000,
        byte in any::<u8>(),
    ) {
        let good = Spectra::of(&Strands::from_counts([20], coil(20, 5.0, 1.0)).expect("one"));
        let mut bytes = good.to_bytes().expect("a library");
        let at = at % bytes.len();
        bytes[at] = byte;
        if let Ok(read) = Spectra::from_bytes(&bytes) {
            prop_assert!(read.len() <= 1);
        }
    }
}
