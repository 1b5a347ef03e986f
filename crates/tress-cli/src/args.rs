//! What every command understands.

use std::ops::Range;
use std::str::FromStr;

use clap::{Args, Parser};

use crate::commands::Command;
use crate::sequence::{Frame, Frames};

/// Edit coiled hair in curvature space.
///
/// A groom is read from any format that tress knows, by its extension: .obj .hair .data .bin .ply
/// .tfx .npy .npz .usda .usdc .usd .abc, and .tress for super-helices. Commands fit polylines on
/// the way in and sample them on the way out. Names as in groom.%04d.obj stand for all frames of a
/// sequence.
#[derive(Debug, Parser)]
#[command(name = "tress", version, max_term_width = 100, propagate_version = true)]
#[command(after_help = "Start with `tress demo`, or with `tress info` on a groom of your own.")]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// What every command understands.
    #[command(flatten)]
    pub(crate) everywhere: Everywhere,
}

/// Options that every command understands.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Everywhere")]
pub(crate) struct Everywhere {
    /// Print one JSON report on standard output, and nothing else there
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Seed of all random choices; the same seed gives the same bytes
    #[arg(long, global = true, default_value_t = 0, value_name = "N")]
    pub(crate) seed: u64,
    /// Threads to work with [default: one a core]
    #[arg(long, global = true, value_name = "N", value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Say nothing but errors
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Only the I-th of N shares of the strands; `tress merge` joins the files written
    #[arg(long, global = true, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    /// Allow the output to be the input file
    #[arg(long, global = true)]
    pub(crate) in_place: bool,
    /// Work on every frame of the animated Alembic and USD files given; what comes out is one
    /// animated file again where its format is one of these, else name a file a frame
    #[arg(long, global = true)]
    pub(crate) animated: bool,
    /// Of a sequence (files named as in groom.%04d.obj) only these frames, as in 10-48
    #[arg(long, global = true, value_name = "A-B")]
    pub(crate) frames: Option<Frames>,
    /// The frame of a sequence that this is.
    #[arg(skip)]
    pub(crate) frame: Frame,
}

fn parse_threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads) if 0 < threads && threads <= 1024 => Ok(threads),
        _ => Err("expected a whole number from 1 to 1024".into()),
    }
}

/// A share of the strands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    index: usize,
    of: usize,
}

impl Shard {
    /// The strands of this share, of `strands` in all.
    pub(crate) fn range(self, strands: usize) -> Range<usize> {
        let end = |i: usize| (strands as u128 * i as u128 / self.of as u128) as usize;
        end(self.index - 1)..end(self.index)
    }
}

impl FromStr for Shard {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let parts =
            text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((index, of)) if 0 < index && index <= of => Ok(Self { index, of }),
            _ => Err("expected I/N with I from 1 to N, as in 2/8".into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }

    #[test]
    fn shards_share_all_strands_out() {
        for (strands, of) in [(10, 3), (2, 5), (0, 2), (1_000_003, 7)] {
            let mut next = 0;
            for index in 1..=of {
                let range = Shard { index, of }.range(strands);
                assert_eq!(range.start, next);
                next = range.end;
            }
            assert_eq!(next, strands);
        }
        for wrong in ["0/2", "3/2", "1", "a/b", "1/0", "-1/2"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
