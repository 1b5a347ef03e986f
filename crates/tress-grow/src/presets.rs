//! Options that have a name.

use crate::GrowOptions;

/// The presets: names and RON.
const PRESETS: [(&str, &str); 4] = [
    ("close-fade", include_str!("../presets/close-fade.ron")),
    ("short-coils", include_str!("../presets/short-coils.ron")),
    ("long-coils", include_str!("../presets/long-coils.ron")),
    ("brushed-out", include_str!("../presets/brushed-out.ron")),
];

/// The names of all presets.
pub fn preset_names() -> impl ExactSizeIterator<Item = &'static str> {
    PRESETS.iter().map(|(name, _)| *name)
}

/// The options of this name.
///
/// ```
/// let brushed_out = tress_grow::preset("brushed-out").expect("a preset");
/// assert_eq!(brushed_out.skip.probability, 0.75);
/// assert_eq!(tress_grow::preset("mohawk"), None);
/// ```
#[must_use]
pub fn preset(name: &str) -> Option<GrowOptions> {
    ron::from_str(preset_text(name)?).ok()
}

/// The options of this name as they are written, to be changed by hand.
#[must_use]
pub fn preset_text(name: &str) -> Option<&'static str> {
    PRESETS.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_reads_and_is_in_range() {
        for name in preset_names() {
            let options = preset(name).expect("a preset");
            assert_eq!(options.validate(), Ok(()), "{name}");
        }
    }
}
