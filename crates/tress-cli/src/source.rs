//! Reading what a command works on.

use std::path::Path;

use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use tress::edit::Grouping;
use tress::fit::{FitOptions, FitReport, Sampling};
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, HelixGroom, Strands};
use tress::io::{Model, ReadError};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{FitArgs, SamplingArgs};
use crate::progress::Progress;
use crate::report::{Report, count, short};

/// Reads a file of any format.
pub(crate) fn read(path: &Path, progress: &Progress) -> Result<Model, Failure> {
    progress.stage(format!("reading {}", path.display()));
    Ok(tress::io::read(path)?)
}

/// The polylines of a file; super-helices are sampled.
pub(crate) fn polylines(path: &Path, progress: &Progress) -> Result<Groom, Failure> {
    into_polylines(read(path, progress)?, progress)
}

/// The polylines of a model; super-helices are sampled.
pub(crate) fn into_polylines(model: Model, progress: &Progress) -> Result<Groom, Failure> {
    match model {
        Model::Polylines(groom) => Ok(groom),
        Model::Helices(helices) => {
            progress.stage("sampling");
            let curved = Curved { helices, counts: None, fit: None };
            curved.sample(&SamplingArgs::default())
        }
    }
}

/// Where the strands of a file begin.
pub(crate) fn roots(path: &Path, progress: &Progress) -> Result<Vec<DVec3>, Failure> {
    Ok(match read(path, progress)? {
        Model::Polylines(groom) => first_points(groom.strands()),
        Model::Helices(helices) => helices.roots().iter().map(|root| root.position).collect(),
    })
}

/// The first point of each strand; a strand without points begins nowhere.
pub(crate) fn first_points(strands: &Strands<DVec3>) -> Vec<DVec3> {
    strands.iter().map(|points| points.first().copied().unwrap_or(DVec3::NAN)).collect()
}

/// The text of a file.
pub(crate) fn text(path: &Path) -> Result<String, Failure> {
    let open = |source| ReadError::Open { path: path.into(), source };
    String::from_utf8(std::fs::read(path).map_err(open)?)
        .map_err(|_| Failure::Failed(format!("{}: expected text, found bytes", path.display())))
}

/// What a .ron file says.
pub(crate) fn ron<T: DeserializeOwned>(path: &Path) -> Result<T, Failure> {
    ron::from_str(&text(path)?).map_err(|error| {
        let (line, column) = (error.span.start.line, error.span.start.col);
        let file = path.display();
        Failure::Failed(format!("{file}: line {line}, column {column}: {}", error.code))
    })
}

/// A groom as super-helices, and how many points each strand came with.
pub(crate) struct Curved {
    pub(crate) helices: HelixGroom,
    /// Points of each strand, where the input was polylines.
    pub(crate) counts: Option<Vec<usize>>,
    /// What the fit came to, where there was one.
    pub(crate) fit: Option<FitReport>,
}

impl Curved {
    /// Reads a groom to be edited and fits it where it is polylines; says how near the fit is.
    pub(crate) fn read(
        path: &Path,
        fit: &FitArgs,
        progress: &Progress,
        report: &mut Report,
    ) -> Result<Self, Failure> {
        report.set("input", path);
        let curved = Self::new(read(path, progress)?, &fit.options(), progress)?;
        curved.say_fit(report);
        Ok(curved)
    }

    /// Fits polylines; takes super-helices as they are.
    pub(crate) fn new(
        model: Model,
        options: &FitOptions,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        match model {
            Model::Helices(helices) => Ok(Self { helices, counts: None, fit: None }),
            Model::Polylines(groom) => Self::fit(&groom, options, progress),
        }
    }

    /// Fits polylines.
    pub(crate) fn fit(
        groom: &Groom,
        options: &FitOptions,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let strands = groom.strands().len();
        progress.stage_of(format!("fitting {} strands", count(strands)), strands);
        let fitted = tress::fit::fit_with(groom, options, |more| progress.add(more))?;
        Ok(Self {
            helices: fitted.helices,
            counts: Some(groom.strands().counts().collect()),
            fit: Some(fitted.report),
        })
    }

    /// The group of each strand. In a sequence clusters are those of its first frame, so that no
    /// strand goes over to another.
    pub(crate) fn groups(
        &self,
        grouping: &Grouping,
        input: &Path,
        fit: &FitArgs,
        everywhere: &Everywhere,
        progress: &Progress,
    ) -> Result<Vec<u32>, Failure> {
        let first = match (grouping, everywhere.frame.first(input)) {
            (Grouping::Clusters(_), Some(first)) => {
                Some(Self::new(read(first, progress)?, &fit.options(), progress)?)
            }
            _ => None,
        };
        let helices = first.as_ref().map_or(&self.helices, |first| &first.helices);
        Ok(tress::edit::groups(helices, grouping, everywhere.seed)?)
    }

    /// The share of the strands that was asked for.
    pub(crate) fn share(mut self, everywhere: &Everywhere) -> Self {
        let Some(shard) = everywhere.shard else { return self };
        let range = shard.range(self.helices.len());
        self.helices = self.helices.select(&range.clone().collect::<Vec<_>>());
        self.counts = self.counts.map(|counts| counts[range].to_vec());
        self
    }

    /// Says how near a fit is, and which strands it passed by.
    pub(crate) fn say_fit(&self, report: &mut Report) {
        let Some(fit) = &self.fit else { return };
        report.set("fit", fit_as_json(fit));
        let deviation = fit.deviation;
        let (rms, greatest) = (short(deviation.rms), short(deviation.greatest));
        report.say("fitted", format!("{} strands", count(fit.strands)));
        let of_radius = short(100.0 * deviation.rms_of_radius);
        let coiled = if 0.0 < deviation.rms_of_radius {
            format!("; {of_radius} % of the coil radius")
        } else {
            String::new()
        };
        report.say("distance", format!("rms {rms}{coiled}, greatest {greatest}"));
        let percent = short(100.0 * deviation.length_change);
        report.say("length change", format!("{percent} % at most"));
        for (reason, n) in &fit.kept {
            let n = count(*n);
            report.say("kept", format!("{n} strands {} as they are", reason.describe()));
        }
    }

    /// Polylines of the super-helices, by default with as many points as came in.
    pub(crate) fn sample(&self, args: &SamplingArgs) -> Result<Groom, Failure> {
        let how = match (args.points, args.spacing, &self.counts) {
            (Some(points), _, _) => Sampling::Points(points),
            (None, Some(spacing), _) => Sampling::Spacing(spacing),
            (None, None, Some(counts)) => Sampling::Counts(counts),
            (None, None, None) => Sampling::PerTurn(POINTS_PER_TURN),
        };
        Ok(tress::fit::sample(&self.helices, &how)?)
    }
}

/// A fit's report for programs.
pub(crate) fn fit_as_json(fit: &FitReport) -> Value {
    let d = fit.deviation;
    let kept = fit.kept.iter().map(|(reason, n)| (reason.describe().to_owned(), json!(n)));
    json!({
        "strands": fit.strands,
        "elements": fit.elements,
        "rms": d.rms,
        "greatest": d.greatest,
        "rms_fit_to_input": d.rms_back,
        "greatest_fit_to_input": d.greatest_back,
        "rms_of_coil_radius": d.rms_of_radius,
        "greatest_of_coil_radius": d.greatest_of_radius,
        "length_change": d.length_change,
        "arc_excess": d.arc_excess,
        "greatest_curvature_jump": d.curvature_jump,
        "kept": kept.collect::<serde_json::Map<_, _>>(),
    })
}

/// Points a turn where nothing else is known: a polyline of 16 points a turn is 2 % narrower than
/// its coil at worst.
const POINTS_PER_TURN: f64 = 16.0;

/// The share of a file's strands that was asked for.
pub(crate) fn share_of(model: Model, everywhere: &Everywhere) -> Model {
    match (model, everywhere.shard) {
        (model, None) => model,
        (Model::Polylines(groom), Some(_)) => Model::Polylines(share(groom, everywhere)),
        (Model::Helices(helices), Some(shard)) => {
            let strands = shard.range(helices.len()).collect::<Vec<_>>();
            Model::Helices(helices.select(&strands))
        }
    }
}

/// The share of the strands of polylines that was asked for.
pub(crate) fn share(groom: Groom, everywhere: &Everywhere) -> Groom {
    match everywhere.shard {
        None => groom,
        Some(shard) => groom.select(&shard.range(groom.strands().len()).collect::<Vec<_>>()),
    }
}
