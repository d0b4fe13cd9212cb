//! `--set name=value`: parameters of the program and settings of the scene.

use std::str::FromStr;

use pullback_compiler::{Picture, Program, SceneModule};
use pullback_runtime::settings;

use super::failure::Failure;
use super::{Console, spelling};

/// `name=value` or `name=a,b,c`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Assignment {
    name: String,
    values: Vec<f64>,
}

impl FromStr for Assignment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (name, value) = text
            .split_once('=')
            .ok_or("write NAME=VALUE, such as k=2.5")?;
        let name = name.trim();
        if name.is_empty() {
            return Err("the name is missing before `=`".into());
        }
        // A range in the language is written lo..hi.
        let parts: Vec<&str> = match value.split_once("..") {
            Some((lo, hi)) => vec![lo, hi],
            None => value.split(',').collect(),
        };
        let values = parts
            .iter()
            .map(|part| match part.trim() {
                "true" => Ok(1.0),
                "false" => Ok(0.0),
                part => part
                    .parse()
                    .map_err(|_| format!("`{part}` is not a number")),
            })
            .collect::<Result<_, String>>()?;
        Ok(Self {
            name: name.to_owned(),
            values,
        })
    }
}

/// Values of the program's parameters and bytes of the scene's settings, after all assignments.
pub(super) fn apply(
    assignments: &[Assignment],
    program: &Program,
    scene: Option<(&Picture, &SceneModule)>,
    console: &Console,
) -> Result<(Vec<f64>, Vec<u8>), Failure> {
    let mut params: Vec<f64> = program.params().iter().map(|param| param.default).collect();
    let slots = scene.map_or_else(Vec::new, |(_, module)| settings::slots(&module.module));
    let mut bytes = scene.map_or_else(Vec::new, |(_, module)| module.settings.clone());
    for assignment in assignments {
        let name = assignment.name.as_str();
        let mut known = false;
        if let Some(i) = program.params().iter().position(|param| param.name == name) {
            params[i] = parameter(program, i, assignment, console)?;
            continue;
        }
        if let Some((picture, _)) = scene
            && let Some(spec) = picture.scene.settings.iter().find(|spec| spec.name == name)
        {
            known = true;
            if let [value] = assignment.values[..]
                && !(spec.lo..=spec.hi).contains(&value)
            {
                return Err(Failure::usage(format!(
                    "setting `{name}` must lie in {}..{}, not {value}",
                    spec.lo, spec.hi
                )));
            }
        }
        if let Some(slot) = slots.iter().find(|slot| slot.name == name) {
            known = true;
            if !slot.write(&mut bytes, &assignment.values) {
                return Err(Failure::usage(format!(
                    "setting `{name}` takes {} number{}, not {}",
                    slot.components,
                    if slot.components == 1 { "" } else { "s" },
                    assignment.values.len()
                )));
            }
        }
        if !known {
            return Err(unknown(name, program, scene.map(|(picture, _)| picture)));
        }
    }
    Ok((params, bytes))
}

fn parameter(
    program: &Program,
    index: usize,
    assignment: &Assignment,
    console: &Console,
) -> Result<f64, Failure> {
    let param = &program.params()[index];
    let [value] = assignment.values[..] else {
        return Err(Failure::usage(format!(
            "parameter `{}` takes 1 number, not {}",
            param.name,
            assignment.values.len()
        )));
    };
    if !(param.lo..=param.hi).contains(&value) {
        console.warning(&format!(
            "parameter `{}` = {value} lies outside of its range {}..{}",
            param.name, param.lo, param.hi
        ));
    }
    Ok(value)
}

fn unknown(name: &str, program: &Program, picture: Option<&Picture>) -> Failure {
    let params = program.params().iter().map(|param| param.name.as_str());
    let settings = picture
        .into_iter()
        .flat_map(|picture| picture.scene.settings.iter().map(|spec| spec.name));
    let names: Vec<&str> = params.chain(settings).collect();
    let message = format!("no parameter or setting is called `{name}`");
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
        let check = |text: &str, name: &str, values: &[f64]| {
            let read: Assignment = text.parse().unwrap();
            assert_eq!((read.name.as_str(), &read.values[..]), (name, values));
        };
        check("k=2.5", "k", &[2.5]);
        check(" k = -1e3 ", "k", &[-1000.0]);
        check("φ=1", "φ", &[1.0]);
        check("tint=1,0.5,0", "tint", &[1.0, 0.5, 0.0]);
        check("range=-1..2.5", "range", &[-1.0, 2.5]);
        check("on=true", "on", &[1.0]);
        for bad in ["k", "=1", "k=", "k=x", "k=1,,2", "k=1..2..3"] {
            assert!(bad.parse::<Assignment>().is_err(), "{bad}");
        }
    }
}
