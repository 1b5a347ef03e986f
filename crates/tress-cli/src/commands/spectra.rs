//! `tress spectra`: a library of coils.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use tress::fit::{Harmonic, Spectra};
use tress::geometry::Strands;
use tress::io::npz::{self, FloatArray};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count, short};
use crate::{source, target};

/// Extension of libraries.
const LIBRARY: &str = "tress-spectra";

/// Take the coils of a groom's strands as a library for `tress grow`
///
/// Each strand that coils gives the amplitudes and phases of its offsets from its centerline. Two
/// .npz files of amplitudes and of phases, as the authors of Curly-Cue publish them, become a
/// library too.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress spectra simulated.abc spongy.tress-spectra
  tress spectra fullComb.objAmps.npz fullComb.objAngs.npz spongy.tress-spectra")]
pub(crate) struct SpectraArgs {
    /// The groom, or amplitudes and phases (.npz), and then the library to write
    #[arg(required = true, num_args = 2..=3, value_name = "INPUT... OUTPUT")]
    pub(crate) files: Vec<PathBuf>,
    /// Of amplitudes and phases: arc length of the centerline between samples; without it, a
    /// coil's samples are as far apart as the points of the guide that it is laid along
    #[arg(long, value_name = "D", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(crate) step: f64,
}

pub(crate) fn run(args: &SpectraArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let Some((output, inputs)) = args.files.split_last() else {
        return Err(Failure::Usage("name the groom and the library to write".into()));
    };
    let paths: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
    target::check_kind(&paths, output, ("libraries of coils are", LIBRARY), everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("inputs", inputs);
    let spectra = match inputs {
        [groom] => {
            let groom = source::polylines(groom, &progress)?;
            progress.stage("analysing");
            let spectra = Spectra::of(groom.strands());
            let straight = groom.strands().len() - spectra.len();
            report.set("left_out", straight);
            if 0 < straight {
                report.say("left out", format!("{} strands without a coil", count(straight)));
            }
            spectra
        }
        _ => read(inputs, args.step, &progress)?,
    };
    let n = spectra.len();
    let radius = (0..n).map(|i| spectra.radius(i)).sum::<f64>() / n.max(1) as f64;
    report.set("output", output);
    report.set("spectra", n);
    report.set("radius", radius);
    tress::io::write_bytes(output, &spectra.to_bytes()?)?;
    let (file, n) = (output.display(), count(n));
    report.say("wrote", format!("{file} ({n} coils, mean radius {})", short(radius)));
    Ok(report)
}

/// Reads a library, or a pair of files of amplitudes and phases.
pub(crate) fn read(files: &[PathBuf], step: f64, progress: &Progress) -> Result<Spectra, Failure> {
    let bytes = |path: &PathBuf| {
        progress.stage(format!("reading {}", path.display()));
        let failed = |error| Failure::Failed(format!("{}: {error}", path.display()));
        fs::read(path).map_err(failed)
    };
    let failed = |path: &Path, why: String| Failure::Failed(format!("{}: {why}", path.display()));
    match files {
        [library] => Spectra::from_bytes(&bytes(library)?)
            .map_err(|error| failed(library, error.to_string())),
        [amplitudes, phases] => {
            let arrays = |path: &PathBuf| {
                npz::float_arrays(&bytes(path)?).map_err(|error| failed(path, error.to_string()))
            };
            let (a, p) = (arrays(amplitudes)?, arrays(phases)?);
            paired(&a, &p, step).map_err(|why| failed(phases, why))
        }
        _ => Err(Failure::Usage("name a library, or amplitudes and phases".into())),
    }
}

/// One spectrum of each pair of arrays, of harmonics x 2 each.
fn paired(amplitudes: &[FloatArray], phases: &[FloatArray], step: f64) -> Result<Spectra, String> {
    if amplitudes.len() != phases.len() {
        let (n, m) = (phases.len(), amplitudes.len());
        return Err(format!("{n} arrays of phases for {m} of amplitudes"));
    }
    let mut harmonics = Strands::default();
    let mut samples = Vec::new();
    for (a, p) in amplitudes.iter().zip(phases) {
        let &[n, 2] = a.shape.as_slice() else {
            return Err(format!("{} is not an array of harmonics x 2", a.name));
        };
        if a.shape != p.shape {
            return Err(format!("{} is of another shape than its amplitudes", p.name));
        }
        let rows = a.values.chunks_exact(2).zip(p.values.chunks_exact(2));
        let own = rows.map(|(a, p)| Harmonic { amplitude: pair(a), phase: pair(p) });
        harmonics.push(own).map_err(|error| error.to_string())?;
        samples.push(n_samples(n, &p.values));
    }
    let steps = vec![step; samples.len()];
    Spectra::new(harmonics, samples, steps).map_err(|error| error.to_string())
}

#[expect(clippy::cast_possible_truncation, reason = "libraries are kept to seven digits")]
fn pair(row: &[f64]) -> [f32; 2] {
    [row[0] as f32, row[1] as f32]
}

/// How many samples have so many harmonics: with an even number, the last harmonic is real.
fn n_samples(harmonics: usize, phases: &[f64]) -> u32 {
    let real = |phase: &f64| phase.sin().abs() < 1e-9;
    let even = phases.iter().rev().take(2).all(real);
    let most = 2 * harmonics.saturating_sub(1) + usize::from(!even);
    u32::try_from(most).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(shape: &[usize], values: &[f64]) -> FloatArray {
        FloatArray { name: "arr_0".into(), shape: shape.to_vec(), values: values.to_vec() }
    }

    #[test]
    fn the_last_phase_says_whether_samples_are_even() {
        let amplitudes = [array(&[3, 2], &[1.0; 6])];
        let read = |last: f64| {
            let phases = [array(&[3, 2], &[0.0, 0.0, 1.0, 2.0, last, last])];
            paired(&amplitudes, &phases, 0.1).expect("a pair").samples(0)
        };
        assert_eq!((read(0.0), read(std::f64::consts::PI), read(1.0)), (4, 4, 5));
    }

    #[test]
    fn arrays_that_do_not_pair_are_refused() {
        let two = [array(&[2, 2], &[1.0; 4])];
        let three = [array(&[3, 2], &[1.0; 6])];
        assert!(paired(&two, &[], 0.0).is_err() && paired(&two, &three, 0.0).is_err());
        assert!(paired(&[array(&[4], &[1.0; 4])], &two, 0.0).is_err());
        assert!(paired(&two, &[array(&[2, 2], &[f64::NAN; 4])], 0.0).is_err());
    }
}
