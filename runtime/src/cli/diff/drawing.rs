//! Drawing one program twice.

use std::str::FromStr;
use std::sync::atomic::AtomicBool;

use clap::ValueEnum;
use pullback_runtime::difference::Bitmap;
use pullback_runtime::executor::{Arithmetic, Painter};
use pullback_runtime::{AdapterChoice, Renderer};

use super::{DiffArguments, Named};
use crate::cli::failure::Failure;
use crate::cli::progress::{Counted, Progress};
use crate::cli::subject::{Subject, Wanted};
use crate::cli::{Console, Device, Input, Numbers, Tier, spelling};

/// `gpu:accurate`: what draws a picture.
#[derive(Clone, Debug)]
pub(in crate::cli) struct Side {
    machine: Machine,
    precision: Option<Tier>,
}

#[derive(Clone, Debug, PartialEq)]
enum Machine {
    Adapter(AdapterChoice),
    Processor(Arithmetic),
}

impl Machine {
    fn named(text: &str) -> Self {
        let all = [Arithmetic::Reference, Arithmetic::Ieee32];
        match all.into_iter().find(|arithmetic| arithmetic.name() == text) {
            Some(arithmetic) => Self::Processor(arithmetic),
            None => Self::Adapter(text.parse().unwrap_or_default()),
        }
    }
}

impl FromStr for Side {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (adapter, precision) = match text.rsplit_once(':') {
            Some((adapter, word)) => (adapter, Some(tier(word)?)),
            None => (text, None),
        };
        if adapter.is_empty() {
            return Err("write ADAPTER or ADAPTER:PRECISION, such as gpu:accurate".into());
        }
        Ok(Self {
            machine: Machine::named(adapter),
            precision,
        })
    }
}

fn tier(word: &str) -> Result<Tier, String> {
    Tier::from_str(word, false).map_err(|_| {
        let names: Vec<String> = Tier::value_variants()
            .iter()
            .filter_map(|tier| Some(tier.to_possible_value()?.get_name().to_owned()))
            .collect();
        match spelling::nearest(word, names.iter().map(String::as_str)) {
            Some(known) => format!("there is no precision `{word}`; did you mean `{known}`?"),
            None => format!("there is no precision `{word}`; there are {}", names.join(", ")),
        }
    })
}

/// The program's picture as each side draws it.
pub(super) fn both(arguments: &DiffArguments, console: &Console) -> Result<[Named; 2], Failure> {
    let framing = &arguments.framing;
    let wanted = Wanted {
        input: &Input {
            input: arguments.first.clone(),
        },
        which: arguments.which,
        rules: arguments.rules,
        settings: &arguments.settings,
        center: framing.center,
        height: framing.height,
        size: framing.size,
        samples: framing.samples,
    };
    let subject = Subject::open(&wanted, console)?;
    let a = drawn(&subject, &arguments.a, console)?;
    Ok([a, drawn(&subject, &arguments.b, console)?])
}

fn drawn(subject: &Subject, side: &Side, console: &Console) -> Result<Named, Failure> {
    let numbers = Numbers {
        precision: side.precision,
    };
    let mut rows: Vec<u8> = Vec::new();
    let mut progress = Progress::new(console);
    let mut counted = Counted {
        sink: &mut rows,
        progress: &mut progress,
    };
    let size = subject.frame(&[]).size;
    let (precision, machine) = match &side.machine {
        Machine::Adapter(adapter) => {
            let device = Device {
                adapter: adapter.clone(),
            };
            let gpu = crate::cli::open(&device, console)?;
            let precision = subject.precision(numbers, &gpu, console)?;
            let scene = subject.scene(crate::cli::tier(&gpu, precision)?, console)?;
            let bytes = scene.pack_settings(&subject.settings);
            let frame = subject.frame(&bytes);
            Renderer::new(&gpu, &scene)?.render(&frame, &mut counted)?;
            (precision, gpu.adapter().to_string())
        }
        Machine::Processor(arithmetic) => {
            let precision = numbers.without_view(&subject.settings)?;
            let scene = subject.scene(precision.into(), console)?;
            let painter = Painter::new(&scene, *arithmetic)?;
            let never = AtomicBool::new(false);
            let frame = subject.frame(&[]);
            painter.render(&frame, &subject.settings, &never, &mut counted)?;
            (precision, arithmetic.name().to_owned())
        }
    };
    Ok(Named {
        picture: Bitmap::from_rgba(size, &rows)?,
        name: format!("{} on {machine}", precision.name()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides() {
        let check = |text: &str, machine: Machine, precision: Option<Tier>| {
            let side: Side = text.parse().unwrap();
            assert_eq!((side.machine, side.precision), (machine, precision), "{text}");
        };
        check("gpu", Machine::Adapter(AdapterChoice::Gpu), None);
        let software = Machine::Adapter(AdapterChoice::Software);
        check("software:fast", software, Some(Tier::Fast));
        let named = AdapterChoice::Named("Radeon RX".into());
        check("Radeon RX:auto", Machine::Adapter(named), Some(Tier::Auto));
        let reference = Machine::Processor(Arithmetic::Reference);
        check("reference", reference, None);
        let exact = Machine::Processor(Arithmetic::Ieee32);
        check("ieee32:extended", exact, Some(Tier::Extended));
        for (bad, expected) in [
            ("gpu:acurate", "did you mean `accurate`"),
            ("gpu:", "there are fast, "),
            (":fast", "write ADAPTER"),
        ] {
            let message = bad.parse::<Side>().unwrap_err();
            assert!(message.contains(expected), "{bad}: {message}");
        }
    }
}
