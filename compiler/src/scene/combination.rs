//! Settings that make no sense together.

use glam::DVec3;

use super::Scene;
use crate::program::SettingValue;

/// Why a setting cannot have the value that it has beside the others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// The setting that is in the way, and others that may be instead: the first that the text has is shown.
    pub settings: &'static [&'static str],
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub hint: &'static str,
}

/// A setting that counts only where a choice has a word.
struct Needs {
    setting: &'static str,
    choice: &'static str,
    word: &'static str,
    /// What to do instead where the choice has another word.
    hint: &'static str,
}

const NEEDS: [Needs; 8] = [
    needs("yaw", "camera", "orbit", LOOK),
    needs("pitch", "camera", "orbit", LOOK),
    needs("distance", "camera", "orbit", LOOK),
    needs("eye", "camera", "look_at", "add `camera = look_at`"),
    needs("aim", "camera", "look_at", "add `camera = look_at`"),
    needs("up", "camera", "look_at", "add `camera = look_at`"),
    needs("fov", "projection", "perspective", EXTENT),
    needs("distance", "projection", "perspective", EXTENT),
];
const LOOK: &str = "leave it out, or take `camera = orbit`; `eye` and `aim` place this camera";
const EXTENT: &str = "leave it out: an orthographic picture is as large as `extent` says";
const ORTHOGRAPHIC: Needs = needs(
    "extent",
    "projection",
    "orthographic",
    "add `projection = orthographic`",
);

const fn needs(
    setting: &'static str,
    choice: &'static str,
    word: &'static str,
    hint: &'static str,
) -> Needs {
    Needs {
        setting,
        choice,
        word,
        hint,
    }
}

/// The least sine of the angle between `up` and the way to look for which `up` says what is upwards.
const LEAST_SINE: f64 = 1e-6;

/// What is wrong with the settings of a scene taken together. `given` says which have been set.
#[must_use]
pub fn conflicts(
    scene: &Scene,
    settings: &[SettingValue],
    given: &dyn Fn(&str) -> bool,
) -> Vec<Conflict> {
    let find = |name: &str| settings.iter().find(|s| s.spec.name == name);
    let mut out = Vec::new();
    for rule in NEEDS.iter().chain([&ORTHOGRAPHIC]) {
        if !given(rule.setting) || out.iter().any(|c: &Conflict| c.settings == [rule.setting]) {
            continue;
        }
        let word = find(rule.choice).and_then(SettingValue::word);
        if let (Some(word), Some(setting)) = (word, find(rule.setting))
            && word != rule.word
        {
            out.push(Conflict {
                settings: std::slice::from_ref(&setting.spec.name),
                message: format!(
                    "`{}` does nothing with `{} = {word}`",
                    rule.setting, rule.choice
                ),
                hint: rule.hint,
            });
        }
    }
    let vector = |name: &str| find(name).map(|s| s.value);
    if find("camera").and_then(SettingValue::word) == Some("look_at")
        && let (Some(eye), Some(aim), Some(up)) = (vector("eye"), vector("aim"), vector("up"))
    {
        out.extend(look_at_conflict(eye, aim, up));
    }
    for name in ["normal", "axis"] {
        if let Some(setting) = find(name)
            && setting.value == DVec3::ZERO
        {
            out.push(Conflict {
                settings: std::slice::from_ref(&setting.spec.name),
                message: format!("`{name}` is zero, which is no direction"),
                hint: "write a vector that is not zero, such as (1, 0, 0)",
            });
        }
    }
    out.extend(highlight_conflict(scene, settings));
    out
}

fn look_at_conflict(eye: DVec3, aim: DVec3, up: DVec3) -> Option<Conflict> {
    let view = aim - eye;
    // in single precision, as the shader has them
    if view.as_vec3() == glam::Vec3::ZERO || view.length() <= 1e-6 * eye.length().max(aim.length())
    {
        return Some(Conflict {
            settings: &["eye", "aim", "camera"],
            message: "`eye` and `aim` are the same point".into(),
            hint: "move one of them: the camera looks from `eye` to `aim`",
        });
    }
    if up == DVec3::ZERO {
        return Some(Conflict {
            settings: &["up"],
            message: "`up` is zero, which is no direction".into(),
            hint: "write the direction that is upwards in the picture, such as (0, 0, 1)",
        });
    }
    let sine = view
        .normalize_or_zero()
        .cross(up.normalize_or_zero())
        .length();
    (sine < LEAST_SINE).then(|| Conflict {
        settings: &["up", "eye", "aim", "camera"],
        message: "`up` is the way that the camera looks".into(),
        hint: "write another direction for `up`, such as (0, 1, 0) for a camera that looks down",
    })
}

fn highlight_conflict(scene: &Scene, settings: &[SettingValue]) -> Option<Conflict> {
    scene.setting("highlight")?;
    let number = |name: &str| {
        settings
            .iter()
            .find(|s| s.spec.name == name)
            .map(|s| s.value.x)
    };
    let (highlight, count) = (number("highlight")?, number("count")?);
    (highlight > count).then(|| Conflict {
        settings: &["highlight", "count"],
        message: format!("`highlight` is level {highlight} of {count}"),
        hint: "levels are counted from 1, the lowest, to `count`; 0 is the one in the middle",
    })
}
