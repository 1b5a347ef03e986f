//! Writing what a command made.

use std::fs;
use std::path::Path;

use tress::geometry::Groom;
use tress::io::unreal::{self, UnrealOptions};
use tress::io::{Format, UsdCurves, WriteOptions};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{FormatArgs, RoadArgs, SamplingArgs, TargetArg, UsdCurvesArg};
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::source::Curved;

/// Says no before any work is done: to a format that is not known, and to the input itself.
pub(crate) fn check(
    inputs: &[&Path],
    output: &Path,
    everywhere: &Everywhere,
) -> Result<Format, Failure> {
    let format = Format::from_path(output)?;
    check_place(inputs, output, everywhere)?;
    Ok(format)
}

/// The same for a groom that is edited, and no to choices that the format has no place for.
pub(crate) fn check_edited(
    input: &Path,
    output: &Path,
    road: &RoadArgs,
    everywhere: &Everywhere,
) -> Result<(), Failure> {
    let format = check(&[input], output, everywhere)?;
    check_sampling(format, &road.sampling)
}

/// The same for polylines, and no to a file of super-helices.
pub(crate) fn check_polylines(
    inputs: &[&Path],
    output: &Path,
    everywhere: &Everywhere,
) -> Result<(), Failure> {
    if check(inputs, output, everywhere)? == Format::Tress {
        let file = output.display();
        let message = format!("{file}: a .tress file holds super-helices; name a polyline format");
        return Err(Failure::Usage(message));
    }
    Ok(())
}

/// The same for a file of another kind, by its extension.
pub(crate) fn check_kind(
    inputs: &[&Path],
    output: &Path,
    (what, extension): (&str, &str),
    everywhere: &Everywhere,
) -> Result<(), Failure> {
    if !has_extension(output, extension) {
        let file = output.display();
        return Err(Failure::Usage(format!("{file}: {what} written to a .{extension} file")));
    }
    check_place(inputs, output, everywhere)
}

/// Whether a path names a file of this kind.
pub(crate) fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

fn check_sampling(format: Format, sampling: &SamplingArgs) -> Result<(), Failure> {
    if format == Format::Tress && sampling.is_given() {
        let message = "--points and --spacing mean polylines; a .tress file has none";
        return Err(Failure::Usage(message.into()));
    }
    Ok(())
}

/// Says no to files that the program which the output is for does not read.
pub(crate) fn check_program(output: &Path, format: &FormatArgs) -> Result<(), Failure> {
    match format.target {
        Some(TargetArg::Unreal) if Format::from_path(output)? != Format::Abc => {
            let message = format!("{}: --target unreal writes an .abc file", output.display());
            Err(Failure::Usage(message))
        }
        _ => Ok(()),
    }
}

/// Says no to a folder that is not there, and to overwriting an input.
pub(crate) fn check_place(
    inputs: &[&Path],
    output: &Path,
    everywhere: &Everywhere,
) -> Result<(), Failure> {
    let file = output.display();
    let folder = output.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        return Err(Failure::Failed(format!("{file}: there is no folder {}", folder.display())));
    }
    let place = |path: &Path| fs::canonicalize(path).ok();
    let target = place(output);
    if everywhere.in_place || target.is_none() || inputs.iter().all(|input| place(input) != target)
    {
        return Ok(());
    }
    Err(Failure::Failed(format!("{file} is an input: say --in-place to overwrite it")))
}

/// Writes super-helices, sampled unless the format holds them as they are.
pub(crate) fn write_curved(
    output: &Path,
    curved: &Curved,
    sampling: &SamplingArgs,
    format: &FormatArgs,
    progress: &Progress,
    report: &mut Report,
) -> Result<(), Failure> {
    let kind = Format::from_path(output)?;
    check_sampling(kind, sampling)?;
    if kind == Format::Tress {
        progress.stage(format!("writing {}", output.display()));
        tress::io::write_helices(output, &curved.helices)?;
        report.set("output", output);
        report.set("elements", curved.helices.elements().points().len());
        let elements = count(curved.helices.elements().points().len());
        report.say("wrote", format!("{} ({elements} elements)", output.display()));
        return Ok(());
    }
    progress.stage("sampling");
    write(output, &curved.sample(sampling)?, format, progress, report)
}

/// Writes the share of an edited groom that was asked for.
pub(crate) fn write_edited(
    output: &Path,
    edited: Curved,
    road: &RoadArgs,
    everywhere: &Everywhere,
    progress: &Progress,
    report: &mut Report,
) -> Result<(), Failure> {
    let share = edited.share(everywhere);
    write_curved(output, &share, &road.sampling, &road.format, progress, report)
}

/// Writes polylines, and reports what the format has no place for.
pub(crate) fn write(
    output: &Path,
    groom: &Groom,
    format: &FormatArgs,
    progress: &Progress,
    report: &mut Report,
) -> Result<(), Failure> {
    progress.stage(format!("writing {}", output.display()));
    if format.target == Some(TargetArg::Unreal) {
        return write_for_unreal(output, groom, report);
    }
    let lost = tress::io::write(output, groom, &options(format))?;
    let (strands, points) = (groom.strands().len(), groom.strands().points().len());
    report.set("output", output);
    report.set("strands", strands);
    report.set("points", points);
    report.set("lost", lost.iter().map(ToString::to_string).collect::<Vec<_>>());
    let (file, strands, points) = (output.display(), count(strands), count(points));
    report.say("wrote", format!("{file} ({strands} strands, {points} points)"));
    for loss in lost {
        report.say("not carried", loss);
    }
    Ok(())
}

/// Writes polylines as Unreal imports them, and reports what its limits cost.
fn write_for_unreal(output: &Path, groom: &Groom, report: &mut Report) -> Result<(), Failure> {
    let fit = unreal::write(output, groom, &UnrealOptions::default())?;
    let unit = if fit.unit_is_assumed { "units" } else { "cm" };
    let error = fit.greatest_error();
    report.set("output", output);
    report.set("strands", groom.strands().len());
    report.set("resampled", fit.resampled);
    report.set("most_points", fit.most_points);
    report.set("greatest_error", error);
    report.set("unit_is_assumed", fit.unit_is_assumed);
    let strands = count(groom.strands().len());
    report.say("wrote", format!("{} ({strands} strands, for Unreal)", output.display()));
    if fit.unit_is_assumed {
        report.say("unit", "unknown, taken for centimetres: say --unit if it is another");
    }
    if 0 < fit.resampled {
        let resampled = count(fit.resampled);
        let line = format!("{resampled} strands to 255 points, at most {error:.3} {unit} off");
        report.say("resampled", line);
    }
    Ok(())
}

/// What was chosen of what formats leave open.
pub(crate) fn options(format: &FormatArgs) -> WriteOptions {
    let usd_curves = match format.usd_curves {
        None | Some(UsdCurvesArg::Linear) => UsdCurves::Linear,
        Some(UsdCurvesArg::CatmullRom) => UsdCurves::CatmullRom,
    };
    WriteOptions { usd_curves }
}
