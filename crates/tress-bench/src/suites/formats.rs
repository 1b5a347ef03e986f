//! Reading and writing files.

use tress::io::WriteOptions;

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures};

use super::best_of;

pub(crate) const NAMES: &[&str] = &["read_obj_seconds", "read_usdc_seconds", "write_usda_seconds"];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    let folder = tempfile::tempdir()?;
    let swatch = match grooms::real("curlycue/curlycue_swatch70_seed1337.obj") {
        Some(path) => path,
        None => {
            let path = folder.path().join("swatch.obj");
            tress::io::write(&path, &grooms::generated(3176, 73), &WriteOptions::default())?;
            path
        }
    };
    let obj = best_of(3, || tress::io::read(&swatch))?;
    figures.add("read_obj_seconds", obj, "s", Bar::AtMost(1.0));
    if let Some(path) = grooms::real("blender/bl_coily_10k.usdc") {
        let usdc = best_of(3, || tress::io::read(&path))?;
        figures.add("read_usdc_seconds", usdc, "s", Bar::None);
    }
    let groom = grooms::groom("blender/bl_coily_10k.usdc", 10_000, 160)?;
    let target = folder.path().join("out.usda");
    let usda = best_of(2, || tress::io::write(&target, &groom, &WriteOptions::default()))?;
    figures.add("write_usda_seconds", usda, "s", Bar::None);
    Ok(())
}
