//! `tress sample`: super-helices to polylines.

use tress::fit::FitOptions;
use tress::io::Format;

use crate::args::{Everywhere, SampleCommandArgs};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::Report;
use crate::source::{self, Curved};
use crate::target;

pub(crate) fn run(args: &SampleCommandArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    if target::check(&[&args.input], &args.output, everywhere)? == Format::Tress {
        let file = args.output.display();
        let message = format!("{file}: a .tress file holds super-helices; name a polyline format");
        return Err(Failure::Usage(message));
    }
    let progress = Progress::new(4, everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let model = source::read(&args.input, &progress)?;
    let curved = Curved::new(model, &FitOptions::default(), &progress)?.share(everywhere);
    let sampling = &args.sampling;
    target::write_curved(&args.output, &curved, sampling, &args.format, &progress, &mut report)?;
    Ok(report)
}
