//! Drawing one program twice.

use std::str::FromStr;

use clap::ValueEnum;
use pullback_runtime::difference::Bitmap;
use pullback_runtime::{AdapterChoice, Renderer};

use super::{DiffArguments, Named};
use crate::cli::failure::Failure;
use crate::cli::progress::{Counted, Progress};
use crate::cli::subject::{Subject, Wanted};
use crate::cli::{Console, Device, Input, Numbers, Tier, spelling};

/// `gpu:accurate`: what draws a picture.
#[derive(Clone, Debug)]
pub(in crate::cli) struct Side {
    adapter: AdapterChoice,
    precision: Option<Tier>,
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
        let adapter = adapter.parse().unwrap_or_default();
        Ok(Self { adapter, precision })
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
    let device = Device {
        adapter: side.adapter.clone(),
    };
    let gpu = crate::cli::open(&device, console)?;
    let numbers = Numbers {
        precision: side.precision,
    };
    let precision = subject.precision(numbers, &gpu, console)?;
    let scene = subject.scene(crate::cli::tier(&gpu, precision)?, console)?;
    let bytes = scene.pack_settings(&subject.settings);
    let frame = subject.frame(&bytes);
    let mut rows: Vec<u8> = Vec::new();
    let mut progress = Progress::new(console);
    let mut renderer = Renderer::new(&gpu, &scene)?;
    let mut counted = Counted {
        sink: &mut rows,
        progress: &mut progress,
    };
    renderer.render(&frame, &mut counted)?;
    Ok(Named {
        picture: Bitmap::from_rgba(frame.size, &rows)?,
        name: format!("{} on {}", precision.name(), gpu.adapter()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides() {
        let read = |text: &str| text.parse::<Side>().map(|s| (s.adapter, s.precision));
        assert_eq!(read("gpu"), Ok((AdapterChoice::Gpu, None)));
        assert_eq!(
            read("software:fast"),
            Ok((AdapterChoice::Software, Some(Tier::Fast)))
        );
        assert_eq!(
            read("Radeon RX:auto"),
            Ok((AdapterChoice::Named("Radeon RX".into()), Some(Tier::Auto)))
        );
        for (bad, expected) in [
            ("gpu:acurate", "did you mean `accurate`"),
            ("gpu:", "there are fast, "),
            (":fast", "write ADAPTER"),
        ] {
            let message = read(bad).unwrap_err();
            assert!(message.contains(expected), "{bad}: {message}");
        }
    }
}
