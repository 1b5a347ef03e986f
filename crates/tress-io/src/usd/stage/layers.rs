//! Opening a stage so that every layer is looked at before openusd parses it.

use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::Path;

use openusd::ar::{Asset, AssetInfo, DefaultResolver, ResolvedPath, Resolver};
use openusd::usd;

use super::{crate_file, unreadable};
use crate::{ParseError, Place, Problem};

/// What binary layers begin with.
const BINARY: &[u8] = b"PXR-USDC";
/// What text layers begin with.
const TEXT: &[u8] = b"#usda";
/// What packages (`.usdz`, which are zip archives) begin with.
const PACKAGE: &[u8] = b"PK\x03\x04";

/// Blocks within blocks that text may have. openusd's parser descends by recursion; a thread's
/// stack of 2 MiB holds some hundreds of its frames in a build without optimization.
const DEEPEST: usize = 100;

/// Whether the file begins as USD does and agrees with its extension.
pub(super) fn check_root(path: &Path) -> Result<(), ParseError> {
    let mut begin = Vec::new();
    File::open(path)?.take(8).read_to_end(&mut begin)?;
    let extension = path.extension().map(|e| e.to_ascii_lowercase());
    let wrong =
        |expected: &str, found: &str| Err(Problem::unexpected(expected, found).at(Place::File));
    let (binary, text) = (begin.starts_with(BINARY), begin.starts_with(TEXT));
    match extension.as_deref().and_then(|e| e.to_str()) {
        _ if begin.starts_with(PACKAGE) => Err(Problem::Unsupported(
            "a USD package (.usdz) is not read: unpack it and read the layer inside".into(),
        )
        .at(Place::File)),
        Some("usda") if binary => wrong("text in a .usda file", "binary USD: name it .usdc"),
        Some("usdc") if text => wrong("binary USD in a .usdc file", "text: name it .usda"),
        _ if binary || text => Ok(()),
        _ => wrong("a USD file, which begins with #usda or PXR-USDC", "something else"),
    }
}

/// The composed stage.
pub(super) fn open(path: &Path) -> Result<usd::Stage, ParseError> {
    // An absolute path is not searched for.
    let absolute = std::path::absolute(path)?;
    let Some(path) = absolute.to_str() else {
        let problem = Problem::Unsupported("USD reads only paths that are Unicode".into());
        return Err(problem.at(Place::File));
    };
    usd::Stage::builder()
        .resolver(Checked(DefaultResolver::new()))
        .open(path)
        .map_err(|error| unreadable(Place::File, &error))
}

/// Finds layers as openusd does, and hands out only those that passed a check.
struct Checked(DefaultResolver);

impl Resolver for Checked {
    fn create_identifier(&self, asset_path: &str, anchor: Option<&ResolvedPath>) -> String {
        self.0.create_identifier(asset_path, anchor)
    }

    fn resolve(&self, asset_path: &str) -> Option<ResolvedPath> {
        self.0.resolve(asset_path)
    }

    fn resolve_for_new_asset(&self, asset_path: &str) -> Option<ResolvedPath> {
        self.0.resolve_for_new_asset(asset_path)
    }

    fn get_asset_info(&self, asset_path: &str, resolved: &ResolvedPath) -> AssetInfo {
        self.0.get_asset_info(asset_path, resolved)
    }

    fn open_asset(&self, resolved: &ResolvedPath) -> io::Result<Box<dyn Asset>> {
        let bytes = self.0.open_asset(resolved)?.read_all()?;
        let checked =
            if bytes.starts_with(BINARY) { crate_file::check(&bytes) } else { check_depth(&bytes) };
        checked.map_err(|reason| io::Error::new(io::ErrorKind::InvalidData, reason))?;
        Ok(Box::new(Cursor::new(bytes)))
    }
}

/// Whether no block of the text lies within more than [`DEEPEST`] others.
///
/// Brackets in strings and comments count as well; there they come in pairs or do not matter at
/// this depth.
fn check_depth(text: &[u8]) -> Result<(), String> {
    let mut depth = 0_usize;
    for byte in text {
        match byte {
            b'{' | b'(' | b'[' => depth += 1,
            b'}' | b')' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if DEEPEST < depth {
            return Err(format!("blocks lie more than {DEEPEST} deep in each other"));
        }
    }
    Ok(())
}
