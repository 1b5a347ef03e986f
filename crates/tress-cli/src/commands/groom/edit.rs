//! `tress groom edit`: parameters of a procedural groom changed from the command line.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use tress::procedural::ProceduralGroom;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::report::{Report, short};
use crate::target;

/// Change a procedural groom
///
/// Parameters can be changed by hand in the .ron file as well, and more: operators added, taken
/// away or put in another order.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress groom edit groom.ron tighter.ron --set curl.radius=0.4 --set curl.frequency=0.3
  tress groom edit groom.ron smooth.ron --set frizz.amplitude=0
  tress groom edit groom.ron parted.ron --scalp head.obj --neighbors 6")]
pub(crate) struct EditArgs {
    /// The procedural groom, .ron
    pub(crate) groom: PathBuf,
    /// The procedural groom to write, .ron
    pub(crate) output: PathBuf,
    /// A parameter and its value; of the first operator of that name
    #[arg(long, value_name = "OPERATOR.PARAMETER=X", required_unless_present = "scalp")]
    pub(crate) set: Vec<Setting>,
    /// Blend strands anew from the guides nearest over this mesh of the scalp, .obj or .ply: those
    /// across a parting or an ear are far away there
    #[arg(long, value_name = "MESH")]
    pub(crate) scalp: Option<PathBuf>,
    /// Guides a strand is blended from
    #[arg(long, value_name = "N", default_value_t = 4, requires = "scalp")]
    pub(crate) neighbors: usize,
    /// Distance at which a guide weighs 1/e of one at the root [default: the mean distance of
    /// neighboring guides]
    #[arg(long, value_name = "D", requires = "scalp", allow_negative_numbers = true)]
    pub(crate) sigma: Option<f64>,
}

/// `curl.radius=0.4`
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Setting {
    operator: String,
    parameter: String,
    value: f64,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('=').and_then(|(name, value)| {
            let (operator, parameter) = name.split_once('.')?;
            Some((operator, parameter, value.trim().parse().ok()?))
        });
        match parts {
            Some((operator, parameter, value)) => {
                Ok(Self { operator: operator.into(), parameter: parameter.into(), value })
            }
            None => Err("expected OPERATOR.PARAMETER=NUMBER, as in curl.radius=0.4".into()),
        }
    }
}

pub(super) fn run(args: &EditArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let what = ("procedural grooms are", "ron");
    target::check_kind(&[&args.groom], &args.output, what, everywhere)?;
    let mut report = Report::default();
    let mut groom = ProceduralGroom::read(&args.groom)?;
    for setting in &args.set {
        let before = change(&mut groom, setting)?;
        let name = format!("{}.{}", setting.operator, setting.parameter);
        report.set(&name, setting.value);
        report.say(&name, format!("{}, was {}", short(setting.value), short(before)));
    }
    if let Some(mesh) = &args.scalp {
        super::new::over(mesh, &mut groom, args.neighbors, args.sigma)?;
        report.set("scalp", mesh);
        report.say("blended", format!("from guides nearest over {}", mesh.display()));
    }
    // Out of range is an error now and not when the groom is built.
    groom.build()?;
    groom.write(&args.output)?;
    report.set("output", &args.output);
    report.say("wrote", args.output.display());
    Ok(report)
}

/// Sets a parameter; gives its value before.
fn change(groom: &mut ProceduralGroom, setting: &Setting) -> Result<f64, Failure> {
    let names: Vec<&str> = groom.chain.operators.iter().map(|o| o.name()).collect();
    let there = if names.is_empty() { "it has none".into() } else { names.join(", ") };
    let operator = groom.chain.operators.iter_mut().find(|o| o.name() == setting.operator);
    let operator = operator.ok_or_else(|| {
        Failure::Failed(format!("no operator {:?} in this groom: {there}", setting.operator))
    })?;
    if operator.parameters().is_empty() {
        let name = operator.name();
        let message = format!("options of {name} are changed in the .ron file, not by --set");
        return Err(Failure::Failed(message));
    }
    let parameters: Vec<&str> = operator.parameters().iter().map(|p| p.name).collect();
    let slot = parameters.iter().position(|name| *name == setting.parameter);
    let slot = slot.and_then(|slot| operator.values_mut().into_iter().nth(slot));
    let slot = slot.ok_or_else(|| {
        let (operator, parameter) = (&setting.operator, &setting.parameter);
        let there = parameters.join(", ");
        Failure::Failed(format!("no parameter {parameter:?} of {operator}: {there}"))
    })?;
    Ok(std::mem::replace(slot, setting.value))
}
