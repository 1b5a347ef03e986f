//! Figures with names, bars and units.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::Outcome;

/// A bar that a figure is held against.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bar {
    /// The figure should be at most this.
    AtMost(f64),
    /// The figure should be at least this.
    AtLeast(f64),
    /// Nothing is asked of it.
    None,
}

/// Figures measured so far; each is printed as soon as it is known.
#[derive(Debug, Default)]
pub(crate) struct Figures {
    values: BTreeMap<String, Figure>,
    baseline: Option<Kept>,
    missed: usize,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Figure {
    value: f64,
    unit: String,
}

/// What is written to a file.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Kept {
    revision: String,
    cores: usize,
    figures: BTreeMap<String, Figure>,
}

impl Figures {
    /// Figures to be compared with those of a file.
    pub(crate) fn against(baseline: Option<&Path>) -> Outcome<Self> {
        let baseline = match baseline {
            Some(path) => Some(serde_json::from_str(&fs::read_to_string(path)?)?),
            None => None,
        };
        Ok(Self { baseline, ..Self::default() })
    }

    /// Records a figure and prints it: `METRIC:name:value:unit`, then how it stands to its bar.
    pub(crate) fn add(&mut self, name: &str, value: f64, unit: &str, bar: Bar) {
        let (met, asked) = match bar {
            Bar::AtMost(most) => (value <= most, format!(" at most {most}")),
            Bar::AtLeast(least) => (least <= value, format!(" at least {least}")),
            Bar::None => (true, String::new()),
        };
        let verdict = match (asked.as_str(), met) {
            ("", _) => String::new(),
            (asked, true) => format!("  (met:{asked})"),
            (asked, false) => format!("  (MISSED:{asked})"),
        };
        self.missed += usize::from(!met);
        let before = self.baseline.as_ref().and_then(|kept| kept.figures.get(name));
        let change = before.map_or(String::new(), |before| {
            format!("  (x {:.3} of {:.6})", value / before.value, before.value)
        });
        say(&format!("METRIC:{name}:{value:.6}:{unit}{verdict}{change}"));
        self.values.insert(name.into(), Figure { value, unit: unit.into() });
    }

    /// Writes all figures with the revision they belong to.
    pub(crate) fn write(&self, path: &Path) -> Outcome {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let kept = Kept { revision: revision(), cores, figures: self.values.clone() };
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(path, serde_json::to_string_pretty(&kept)? + "\n")?;
        Ok(())
    }

    /// How many figures missed their bars.
    pub(crate) fn missed(&self) -> usize {
        self.missed
    }
}

/// The revision of the sources, or that it is not known.
fn revision() -> String {
    let git = Command::new("git").args(["describe", "--always", "--dirty"]).output();
    git.ok()
        .filter(|output| output.status.success())
        .map_or("unknown".into(), |output| String::from_utf8_lossy(&output.stdout).trim().into())
}

#[expect(clippy::print_stdout, reason = "figures are printed as they come")]
pub(crate) fn say(line: &str) {
    println!("{line}");
}
