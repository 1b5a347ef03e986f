//! One wisp ruffled more and more, as in [CSE Fig. 3].

use tress::edit::{RuffleOptions, ruffle};
use tress::fit::{Elements, FitOptions, fit};
use tress::geometry::Groom;
use tress::view::View;
use tress_fixtures::{PatchOptions, coily_patch};

use crate::Outcome;

use super::{Frame, sampled};

pub(super) fn make() -> Outcome {
    let options = PatchOptions { wisps: 1, strands_per_wisp: 40, ..PatchOptions::default() };
    let wisp = coily_patch(&options, 3);
    let fitted = FitOptions { elements: Elements::Count(90), ..FitOptions::default() };
    let helices = fit(&wisp, &fitted)?.helices;
    let grooms: Vec<Groom> = [0.0, 0.05, 0.1, 0.25]
        .into_iter()
        .map(|probability| {
            let options = RuffleOptions { probability, keep: 30, ..RuffleOptions::default() };
            sampled(&ruffle(&helices, &[0; 40], &options, 1)?.0)
        })
        .collect::<Outcome<_>>()?;
    let frame = Frame::around(&grooms, View::Side, (440, 520), 0.035);
    let captions = ["as it is", "probability 0.05", "0.1", "0.25"];
    let panels: Vec<_> = grooms.iter().zip(captions).collect();
    frame.sheet("ruffle.png", 4, &panels)
}
