//! What computes: a graphics adapter, or the processor.

use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;

use pullback_compiler::lower::{Precision, Tier};
use pullback_runtime::auto::Trier;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::{AdapterChoice, Error, Gpu};

use super::Console;
use super::failure::Failure;

/// What is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Adapter(AdapterChoice),
    Processor(Arithmetic),
}

impl FromStr for Place {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(match text {
            "reference" => Self::Processor(Arithmetic::Reference),
            "ieee32" => Self::Processor(Arithmetic::Ieee32),
            other => Self::Adapter(other.parse()?),
        })
    }
}

/// What computes.
#[derive(Debug)]
pub(super) enum Computer {
    Adapter(Gpu),
    Processor(Arithmetic),
}

impl Computer {
    /// Opens what is asked for, and says what it is. Where there is no adapter at all the processor stands in, in `f64`.
    pub(super) fn open(place: &Place, console: &Console) -> Result<Self, Failure> {
        let choice = match place {
            Place::Processor(arithmetic) => return Ok(Self::Processor(*arithmetic)),
            Place::Adapter(choice) => choice,
        };
        match super::open(choice, console) {
            Err(Failure::Device(error)) if *choice == AdapterChoice::Auto && is_absence(&error) => {
                let here = Self::Processor(Arithmetic::Reference);
                console.warning(&format!("{error}: {here}, computes, which takes longer"));
                Ok(here)
            }
            opened => Ok(Self::Adapter(opened?)),
        }
    }

    /// What tries the tiers for `auto`; nothing in `f64`, where there is nothing to choose.
    pub(super) fn trier(&self) -> Option<Trier<'_>> {
        match self {
            Self::Adapter(gpu) => Some(Trier::Device(gpu)),
            Self::Processor(Arithmetic::Ieee32) => Some(Trier::Exact),
            Self::Processor(Arithmetic::Reference) => None,
        }
    }

    /// The tier of the module: of two that could be, in `f64` the one that holds all digits of constants, too.
    pub(super) fn tier(
        &self,
        given: Option<super::Tier>,
        wanted: Option<Precision>,
    ) -> Result<Tier, Failure> {
        match self {
            Self::Adapter(gpu) => match wanted {
                Some(precision) => super::tier(gpu, precision),
                None => Err(no_choice()),
            },
            Self::Processor(Arithmetic::Reference) => {
                let given = given.and_then(super::Tier::precision);
                Ok(given.unwrap_or(Precision::Double).into())
            }
            Self::Processor(Arithmetic::Ieee32) => wanted.map(Tier::from).ok_or_else(no_choice),
        }
    }
}

/// Whether no adapter is there that gives a device.
fn is_absence(error: &Error) -> bool {
    matches!(error, Error::NoAdapter { .. } | Error::NoDevice { .. })
}

fn no_choice() -> Failure {
    Failure::usage_hint(
        "`auto` chooses the precision for a picture, and there is none here",
        "give --precision accurate, or another",
    )
}

impl fmt::Display for Computer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Adapter(gpu) => gpu.adapter().fmt(f),
            Self::Processor(Arithmetic::Reference) => f.write_str("the processor, in f64"),
            Self::Processor(Arithmetic::Ieee32) => {
                f.write_str("the processor, in exact single precision")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words() {
        let place = |text: &str| text.parse::<Place>().unwrap();
        assert_eq!(place("ieee32"), Place::Processor(Arithmetic::Ieee32));
        assert_eq!(place("reference"), Place::Processor(Arithmetic::Reference));
        assert_eq!(place("auto"), Place::Adapter(AdapterChoice::Auto));
    }

    #[test]
    fn in_f64_constants_keep_their_digits_unless_a_tier_is_given() {
        let reference = Computer::Processor(Arithmetic::Reference);
        let wanted = Some(Precision::Accurate);
        let tier = |given| reference.tier(given, wanted).unwrap().precision;
        assert_eq!(tier(None), Precision::Double);
        assert_eq!(tier(Some(super::super::Tier::Fast)), Precision::Fast);
        let ieee32 = Computer::Processor(Arithmetic::Ieee32);
        assert_eq!(
            ieee32.tier(None, wanted).unwrap().precision,
            Precision::Accurate
        );
        assert!(ieee32.tier(None, None).is_err());
    }
}
