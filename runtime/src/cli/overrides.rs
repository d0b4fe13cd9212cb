//! `--set name=value`: parameters of the program and settings of the scene.

use std::str::FromStr;

use glam::DVec3;
use pullback_compiler::scene::{SettingKind, SettingSpec, conflicts};
use pullback_compiler::{Picture, Program, SettingValue};

use super::failure::Failure;
use super::spelling;

/// `name=2`, `name=1,0.5,0` or `name=word`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Assignment {
    name: String,
    value: Value,
}

#[derive(Clone, Debug, PartialEq)]
enum Value {
    Numbers(Vec<f64>),
    Word(String),
}

impl Assignment {
    /// A name gets a word.
    pub(super) fn word(name: &str, word: &str) -> Self {
        Self {
            name: name.to_owned(),
            value: Value::Word(word.to_owned()),
        }
    }

    /// A name gets one number.
    pub(super) fn number(name: &str, value: f64) -> Self {
        Self {
            name: name.to_owned(),
            value: Value::Numbers(vec![value]),
        }
    }
}

impl FromStr for Assignment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (name, value) = text
            .split_once('=')
            .ok_or("write NAME=VALUE, such as k=2.5")?;
        let (name, value) = (name.trim(), value.trim());
        if name.is_empty() || value.is_empty() {
            return Err("write NAME=VALUE, such as k=2.5".into());
        }
        let numbers: Result<Vec<f64>, _> =
            value.split(',').map(|part| part.trim().parse()).collect();
        let value = match numbers {
            Ok(numbers) => Value::Numbers(numbers),
            Err(_) if value.chars().all(|c| c.is_alphanumeric() || c == '_') => {
                Value::Word(value.to_owned())
            }
            Err(_) => return Err(format!("`{value}` is not a number")),
        };
        Ok(Self {
            name: name.to_owned(),
            value,
        })
    }
}

/// The program's parameters and the picture's settings after all assignments.
pub(super) fn for_picture(
    assignments: &[Assignment],
    program: &Program,
    picture: &Picture,
) -> Result<(Vec<f64>, Vec<SettingValue>), Failure> {
    let mut params = defaults(program);
    let mut settings = picture.settings.clone();
    for assignment in assignments {
        assign(assignment, program, &mut params, &mut settings)?;
    }
    let given = |name: &str| assignments.iter().any(|a| a.name == name);
    match conflicts(picture.scene, &settings, &given).pop() {
        Some(conflict) if !assignments.is_empty() => {
            Err(Failure::usage_hint(conflict.message, conflict.hint))
        }
        _ => Ok((params, settings)),
    }
}

/// Sets a parameter of the program or a setting of the picture.
pub(super) fn assign(
    assignment: &Assignment,
    program: &Program,
    params: &mut [f64],
    settings: &mut [SettingValue],
) -> Result<(), Failure> {
    if set_parameter(assignment, program, params)? {
        return Ok(());
    }
    let name = assignment.name.as_str();
    let Some(setting) = settings.iter_mut().find(|s| s.spec.name == name) else {
        let names = settings.iter().map(|setting| setting.spec.name);
        return Err(unknown("parameter or setting", name, program, names));
    };
    setting.value = components(setting.spec, &assignment.value).map_err(Failure::usage)?;
    Ok(())
}

/// The program's parameters after all assignments.
pub(super) fn for_values(
    assignments: &[Assignment],
    program: &Program,
) -> Result<Vec<f64>, Failure> {
    let mut params = defaults(program);
    for assignment in assignments {
        if !set_parameter(assignment, program, &mut params)? {
            return Err(unknown("parameter", &assignment.name, program, []));
        }
    }
    Ok(params)
}

fn defaults(program: &Program) -> Vec<f64> {
    program.params().iter().map(|param| param.default).collect()
}

/// Sets a parameter; `false` if there is none of this name.
fn set_parameter(
    assignment: &Assignment,
    program: &Program,
    params: &mut [f64],
) -> Result<bool, Failure> {
    let names = program.params().iter().map(|param| &param.name);
    let Some((_, slot)) = names
        .zip(params)
        .find(|(name, _)| **name == assignment.name)
    else {
        return Ok(false);
    };
    match &assignment.value {
        Value::Numbers(numbers) if numbers.len() == 1 => *slot = numbers[0],
        _ => {
            let name = &assignment.name;
            return Err(Failure::usage(format!(
                "parameter `{name}` takes one number"
            )));
        }
    }
    Ok(true)
}

/// The components of a setting's value, zero beyond them.
fn components(spec: &SettingSpec, value: &Value) -> Result<DVec3, String> {
    let name = spec.name;
    let size = match spec.kind {
        SettingKind::Choice(words) => {
            let place = match value {
                Value::Word(word) => words.iter().position(|known| known == word),
                Value::Numbers(_) => None,
            };
            let place = place
                .and_then(|place| u32::try_from(place).ok())
                .ok_or_else(|| format!("`{name}` is one of {}", words.join(", ")))?;
            return Ok(DVec3::splat(f64::from(place)));
        }
        SettingKind::Function => {
            return Err(format!(
                "`{name}` is a function of the program: name it in the braces of its `show`"
            ));
        }
        SettingKind::Real | SettingKind::Integer => 1,
        SettingKind::Vec2 => 2,
        SettingKind::Vec3 => 3,
    };
    let numbers = match value {
        Value::Numbers(numbers) => numbers.clone(),
        Value::Word(word) => return Err(format!("`{name}` takes a number, not `{word}`")),
    };
    let numbers = match numbers[..] {
        // One number stands for three equal ones, as in the language.
        [all] if size != 2 => DVec3::splat(all),
        [x, y] if size == 2 => DVec3::new(x, y, 0.0),
        [x, y, z] if size == 3 => DVec3::new(x, y, z),
        _ => {
            return Err(format!(
                "`{name}` takes {size} number{}, not {}",
                if size == 1 { "" } else { "s" },
                numbers.len()
            ));
        }
    };
    if !numbers.is_finite() {
        return Err(format!("`{name}` takes finite numbers"));
    }
    spec.check(&numbers.as_ref()[..size])?;
    Ok(numbers)
}

fn unknown<'a>(
    what: &str,
    name: &str,
    program: &'a Program,
    settings: impl IntoIterator<Item = &'a str>,
) -> Failure {
    let params = program.params().iter().map(|param| param.name.as_str());
    let names: Vec<&str> = params.chain(settings).collect();
    let message = format!("no {what} is called `{name}`");
    if names.is_empty() {
        return Failure::usage(message);
    }
    let hint = match spelling::nearest(name, names.iter().copied()) {
        Some(known) => format!("did you mean `{known}`?"),
        None => format!("the names are {}", names.join(", ")),
    };
    Failure::usage_hint(message, hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assignments() {
        let check = |text: &str, name: &str, value: Value| {
            let read: Assignment = text.parse().unwrap();
            assert_eq!((read.name.as_str(), read.value), (name, value));
        };
        check("k=2.5", "k", Value::Numbers(vec![2.5]));
        check(" k = -1e3 ", "k", Value::Numbers(vec![-1000.0]));
        check("φ=1", "φ", Value::Numbers(vec![1.0]));
        check("ink=1,0.5, 0", "ink", Value::Numbers(vec![1.0, 0.5, 0.0]));
        check("palette=paper", "palette", Value::Word("paper".into()));
        for bad in ["k", "=1", "k=", "k=1,,2", "k=1..2", "k==1", "k=2 x"] {
            assert!(bad.parse::<Assignment>().is_err(), "{bad}");
        }
    }

    #[test]
    fn values_of_settings() {
        let check = |spec: &SettingSpec, text: &str, expected: Result<[f64; 3], &str>| {
            let value = format!("s={text}").parse::<Assignment>().unwrap().value;
            let found = components(spec, &value);
            match (&found, expected) {
                (Ok(found), Ok(expected)) => assert_eq!(found.to_array(), expected, "{text}"),
                (Err(found), Err(expected)) => assert!(found.contains(expected), "{found}"),
                _ => panic!("{text}: {found:?}"),
            }
        };
        let real = SettingSpec::real("gain", 1.0, (0.0, 4.0), "");
        check(&real, "2", Ok([2.0; 3]));
        check(&real, "5", Err("between"));
        check(&real, "nan", Err("finite"));
        check(&real, "1,2", Err("takes 1 number, not 2"));
        check(&real, "big", Err("takes a number, not `big`"));
        let whole = SettingSpec::integer("steps", 1.0, (0.0, 4.0), "");
        check(&whole, "1.5", Err("whole"));
        let ink = SettingSpec::colour("ink", [0.0; 3], "");
        check(&ink, "0.5", Ok([0.5; 3]));
        check(&ink, "0,1,0", Ok([0.0, 1.0, 0.0]));
        check(&ink, "0,1", Err("takes 3 numbers, not 2"));
        let palette = SettingSpec::choice("palette", &["light", "dark"], 0.0, "");
        check(&palette, "dark", Ok([1.0; 3]));
        check(&palette, "1", Err("one of light, dark"));
    }
}
