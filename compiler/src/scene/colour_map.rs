//! Named colour maps: those of the crate `colorous` (d3-scale-chromatic's) and matplotlib's `twilight`, as tables in linear
//! light. A scene that takes `palette` gets the table of the map that is chosen, in its settings, and no other.

use std::sync::OnceLock;

use colorous::Gradient;
use rustc_hash::FxHashMap;

use super::twilight::TWILIGHT;
use crate::program::SettingValue;

/// Colours of a table, from the lowest value to the highest; between two of them linear light is mixed.
pub const ENTRIES: usize = 129;

/// The member of a template's `Settings` that holds the table of its setting `palette`: `array<vec4f, 129>`.
pub const TABLE: &str = "colours";

/// Linear rgb.
pub type Table = [[f64; 3]; ENTRIES];

/// Words of a choice: a scene's own ones, and the maps for values.
macro_rules! value_palette {
    ($($own:literal),* $(,)?) => {
        &[
            $($own,)* "viridis", "cividis", "magma", "inferno", "plasma", "RdBu", "RdBu_r", "PuOr",
        ]
    };
}
pub(super) use value_palette;

/// A map for values, and whether it is turned round.
const GRADIENTS: [(&str, Gradient, bool); 8] = [
    ("viridis", colorous::VIRIDIS, false),
    ("cividis", colorous::CIVIDIS, false),
    ("magma", colorous::MAGMA, false),
    ("inferno", colorous::INFERNO, false),
    ("plasma", colorous::PLASMA, false),
    ("RdBu", colorous::RED_BLUE, false),
    ("RdBu_r", colorous::RED_BLUE, true),
    ("PuOr", colorous::PURPLE_ORANGE, false),
];

/// The map for arguments.
const CYCLIC: &str = "twilight";

/// sRGB to linear light, 0..1 (IEC 61966-2-1).
fn linear(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// The table of a map of this name; there is none for a scene's own words.
#[must_use]
pub fn colour_map(name: &str) -> Option<&'static Table> {
    static TABLES: OnceLock<FxHashMap<&'static str, Table>> = OnceLock::new();
    TABLES.get_or_init(tables).get(name)
}

fn tables() -> FxHashMap<&'static str, Table> {
    let last = ENTRIES - 1;
    let mut out = FxHashMap::default();
    for (name, gradient, turned) in GRADIENTS {
        let table = std::array::from_fn(|k| {
            let place = if turned { last - k } else { k };
            #[allow(clippy::cast_precision_loss, reason = "a place in a short list")]
            let colour = gradient.eval_continuous(place as f64 / last as f64);
            [colour.r, colour.g, colour.b].map(|part| linear(f64::from(part) / 255.0))
        });
        out.insert(name, table);
    }
    let cycle = std::array::from_fn(|k| TWILIGHT[k % TWILIGHT.len()].map(linear));
    out.insert(CYCLIC, cycle);
    out
}

/// A component of a member of a template's `Settings`: of the setting of its name, or of the table of the palette.
#[must_use]
pub fn setting_component(settings: &[SettingValue], member: &str, k: usize) -> Option<f64> {
    let find = |name: &str| settings.iter().find(|s| s.spec.name == name);
    if member != TABLE {
        return find(member)?.value.to_array().get(k).copied();
    }
    let entry = colour_map(find("palette")?.word()?).and_then(|table| table.get(k / 4));
    // the fourth component of an entry is for alignment
    Some(
        entry
            .and_then(|colour| colour.get(k % 4))
            .map_or(0.0, |c| *c),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{SettingKind, scenes};

    #[test]
    fn every_word_of_a_palette_is_a_map_or_the_scene_s_own() {
        const OWN: [&str; 9] = [
            "diverging",
            "sequential",
            "paper",
            "own",
            "wheel",
            "cubehelix",
            "oklch",
            "hsv",
            "",
        ];
        let mut maps = 0;
        for scene in scenes() {
            let Some(SettingKind::Choice(words)) = scene.setting("palette").map(|s| s.kind) else {
                continue;
            };
            for word in words {
                let known = colour_map(word).is_some();
                assert!(known || OWN.contains(word), "{}: {word}", scene.name);
                maps += usize::from(known);
            }
        }
        assert!(maps > 40, "{maps}");
    }

    /// Colours of matplotlib 3.11 at the ends and in the middle, in 8 bits, read by another program (Python).
    #[test]
    fn maps_are_those_of_their_names() {
        let check = |name: &str, place: usize, expected: [u8; 3]| {
            let colour = colour_map(name).expect("a map")[place];
            for (part, byte) in colour.iter().zip(expected) {
                let off = (encoded(*part) * 255.0 - f64::from(byte)).abs();
                assert!(off < 4.0, "{name} at {place}: {colour:?}, not {expected:?}");
            }
        };
        check("viridis", 0, [68, 1, 84]);
        check("viridis", 64, [33, 145, 140]);
        check("viridis", 128, [253, 231, 37]);
        check("magma", 64, [183, 55, 121]);
        check("plasma", 128, [240, 249, 33]);
        check("twilight", 0, [226, 217, 226]);
        check("twilight", 64, [48, 18, 55]);
        check("twilight", 128, [226, 217, 226]);
        check("RdBu", 0, [103, 0, 31]);
        check("RdBu_r", 0, [5, 48, 97]);
    }

    fn encoded(linear: f64) -> f64 {
        if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * linear.powf(1.0 / 2.4) - 0.055
        }
    }

    /// Between the entries a table is the map to the steps of 8 bits.
    #[test]
    fn tables_are_fine_enough() {
        for (name, gradient, turned) in GRADIENTS {
            let table = colour_map(name).expect("a map");
            for k in 0..=4000_u32 {
                let t = f64::from(k) / 4000.0;
                let place = t * 128.0;
                let low = (place as usize).min(127);
                let part = place - low as f64;
                let colour = gradient.eval_continuous(if turned { 1.0 - t } else { t });
                for (c, byte) in [colour.r, colour.g, colour.b].into_iter().enumerate() {
                    let mixed = table[low][c] * (1.0 - part) + table[low + 1][c] * part;
                    let off = (encoded(mixed) * 255.0 - f64::from(byte)).abs();
                    assert!(off < 2.5, "{name} at {t}: off by {off} of 255");
                }
            }
        }
    }
}
