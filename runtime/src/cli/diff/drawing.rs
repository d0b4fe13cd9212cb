//! Drawing one program twice.

use std::convert::Infallible;
use std::str::FromStr;

use clap::ValueEnum;
use pullback_runtime::difference::Bitmap;

use super::{DiffArguments, Named};
use crate::cli::failure::Failure;
use crate::cli::place::{Computer, Place};
use crate::cli::progress::{Counted, Progress};
use crate::cli::render::Artist;
use crate::cli::subject::{Subject, Wanted};
use crate::cli::{Console, Input, Numbers, Tier, spelling};

/// `gpu:accurate`: what draws a picture.
#[derive(Clone, Debug)]
pub(in crate::cli) struct Side {
    pub(in crate::cli) place: Place,
    pub(in crate::cli) precision: Option<Tier>,
}

impl FromStr for Side {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (place, precision) = match text.rsplit_once(':') {
            Some((place, word)) => (place, Some(tier(word)?)),
            None => (text, None),
        };
        if place.is_empty() {
            return Err("write ADAPTER or ADAPTER:PRECISION, such as gpu:accurate".into());
        }
        let Ok(place): Result<Place, Infallible> = place.parse();
        Ok(Self { place, precision })
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
            None => format!(
                "there is no precision `{word}`; there are {}",
                names.join(", ")
            ),
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
    let computer = Computer::open(&side.place, console)?;
    let numbers = Numbers {
        precision: side.precision,
    };
    let tier = subject.tier(numbers, &computer, console)?;
    let scene = subject.scene(tier, console)?;
    let bytes = scene.pack_settings(&subject.settings);
    let frame = subject.frame(&bytes);
    let mut rows: Vec<u8> = Vec::new();
    let mut progress = Progress::new(console);
    let mut counted = Counted {
        sink: &mut rows,
        progress: &mut progress,
    };
    Artist::new(
        &computer,
        &scene,
        frame.pipeline,
        Some((&subject.settings, frame.samples)),
    )?
    .render(&frame, &subject.settings, &mut counted)
    .map_err(|error| subject.source.blamed(error.into(), console))?;
    Ok(Named {
        picture: Bitmap::from_rgba(frame.size, &rows)?,
        name: format!("{} on {computer}", tier.precision.name()),
    })
}

#[cfg(test)]
mod tests {
    use pullback_runtime::AdapterChoice;
    use pullback_runtime::executor::Arithmetic;

    use super::*;

    #[test]
    fn sides() {
        let check = |text: &str, place: Place, precision: Option<Tier>| {
            let side: Side = text.parse().unwrap();
            assert_eq!((side.place, side.precision), (place, precision), "{text}");
        };
        check("gpu", Place::Adapter(AdapterChoice::Gpu), None);
        let software = Place::Adapter(AdapterChoice::Software);
        check("software:fast", software, Some(Tier::Fast));
        let named = AdapterChoice::Named("Radeon RX".into());
        check("Radeon RX:auto", Place::Adapter(named), Some(Tier::Auto));
        let reference = Place::Processor(Arithmetic::Reference);
        check("reference", reference, None);
        let exact = Place::Processor(Arithmetic::Ieee32);
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
