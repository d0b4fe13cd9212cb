//! What an adapter's arithmetic is worth, and what follows for the tiers.
//!
//! [`Capabilities::of`] is lazy: findings are kept in memory, and on disk in the user's cache folder, so that an adapter is
//! tried once for each version of its driver and of the probe.

mod cache;

use std::sync::{Arc, Mutex, PoisonError};

use pullback_compiler::lower::{Exactness, Precision, Tier};
use serde::{Deserialize, Serialize};

use crate::{Error, Gpu, probe};
pub use cache::cache_folder;

/// What findings are about.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Key {
    /// The adapter's name.
    pub name: String,
    /// Driver name and version.
    pub driver: String,
    /// The interface it is driven through.
    pub backend: String,
}

impl Key {
    /// The key of an open device.
    #[must_use]
    pub fn of(gpu: &Gpu) -> Self {
        let adapter = gpu.adapter();
        Self {
            name: adapter.name.clone(),
            driver: adapter.driver.clone(),
            backend: adapter.backend.to_string(),
        }
    }
}

/// What the device has beyond binary32.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Offered {
    /// Native binary64.
    pub f64: bool,
    /// 64-bit integers, for the bits of binary64.
    pub u64: bool,
    /// SPIR-V of ours, whose instructions can be decorated with NoContraction.
    pub decorations: bool,
}

/// Findings about one format. Shares are of results that were wrong, from 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Arithmetic {
    /// TwoSum as written: above zero where the driver reassociates sums.
    pub two_sum: f64,
    /// TwoSum with every step hidden from the shader compiler.
    pub two_sum_hidden: f64,
    /// TwoProd by `fma`: above zero where that rounds twice.
    pub two_product_fma: f64,
    /// TwoProd by halves (Dekker), hidden.
    pub two_product_halves: f64,
    /// Products that were fused with the difference that they stand in, unasked.
    pub contracted: f64,
    /// Largest errors of single operations.
    pub rounding: Rounding,
    /// Operations on special numbers that go wrong.
    pub special: Special,
}

/// Largest errors in units in the last place of the result, for normal arguments and results; up to 0.5 is correct.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "each field is the operation that it names")]
pub struct Rounding {
    pub sum: f64,
    pub difference: f64,
    pub product: f64,
    pub quotient: f64,
    pub root: f64,
}

impl Rounding {
    /// Whether every operation is rounded correctly. The rows lie within about an ulp² of midpoints, and the judge's own
    /// errors are smaller.
    #[must_use]
    pub fn is_correct(&self) -> bool {
        self.has_correct_sums() && self.quotient <= CORRECT && self.root <= CORRECT
    }

    /// Whether sums, differences and products are.
    #[must_use]
    pub fn has_correct_sums(&self) -> bool {
        [self.sum, self.difference, self.product]
            .iter()
            .all(|&error| error <= CORRECT)
    }
}

/// Half an ulp, and room for the judge's rounding.
const CORRECT: f64 = 0.5 + 1e-6;

/// Operations whose results IEEE 754 fixes and the adapter does not give, under what they are about. Empty is good.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "each field is what its operations are about")]
pub struct Special {
    pub subnormal_results: Vec<String>,
    pub subnormal_arguments: Vec<String>,
    pub zeros: Vec<String>,
    pub infinities: Vec<String>,
    pub nans: Vec<String>,
}

/// A form of the exact steps, tried.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Form {
    /// [`Exactness::name`].
    pub name: String,
    /// The share of rows with a wrong result.
    pub wrong: f64,
}

impl Form {
    pub(crate) fn new(exactness: Exactness, wrong: f64) -> Self {
        Self {
            name: exactness.name().to_owned(),
            wrong,
        }
    }
}

/// What an adapter's arithmetic is worth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Capabilities {
    /// Which adapter.
    pub adapter: Key,
    /// What it has.
    pub offered: Offered,
    /// binary32.
    pub single: Arithmetic,
    /// binary64, where it is offered with 64-bit integers.
    pub double: Option<Arithmetic>,
    /// binary32 with every instruction decorated, where that is possible.
    pub single_decorated: Option<Arithmetic>,
    /// binary64 likewise.
    pub double_decorated: Option<Arithmetic>,
    /// Forms of the exact steps of pairs.
    pub forms: Vec<Form>,
    /// Turns after which all loops of an invocation end without an error; none where 2²⁰ were made.
    pub turns: Option<u32>,
}

/// Findings of this process.
static KNOWN: Mutex<Vec<Arc<Capabilities>>> = Mutex::new(Vec::new());

impl Capabilities {
    /// What is known of the device's adapter, from memory, from the cache folder, or by trying it now.
    ///
    /// # Errors
    /// The device's. A cache that cannot be read or written is no error.
    pub fn of(gpu: &Gpu) -> Result<Arc<Self>, Error> {
        let key = Key::of(gpu);
        if let Some(known) = recall(&key) {
            return Ok(known);
        }
        let found = cache::folder().and_then(|folder| cache::load(&folder, &key));
        match found {
            Some(found) => Ok(remember(found)),
            None => Self::refresh(gpu),
        }
    }

    /// Tries the adapter, whatever is known, and keeps what is found.
    ///
    /// # Errors
    /// The device's.
    pub fn refresh(gpu: &Gpu) -> Result<Arc<Self>, Error> {
        let found = probe::capabilities(gpu)?;
        if let Some(folder) = cache::folder() {
            // Without a cache the next process measures again.
            let _ = cache::store(&folder, &found);
        }
        Ok(remember(found))
    }

    /// What numbers of a precision are best computed with on a device: for `extended`, by the fastest exact steps.
    ///
    /// # Errors
    /// [`Error::Invalid`] where the adapter cannot keep the bounds of the precision, and the device's.
    pub fn tier(gpu: &Gpu, precision: Precision) -> Result<Tier, Error> {
        let refused = |reason| Error::Invalid {
            reason: format!(
                "no `{}` on {}: {reason}",
                precision.name(),
                gpu.adapter().name
            ),
        };
        match precision {
            Precision::Fast => Ok(precision.into()),
            // no software adapter that was tried rounds it once, and where one does, steps are as right
            Precision::Accurate => Ok(Tier {
                splits_fma: gpu.adapter().is_software(),
                ..precision.into()
            }),
            Precision::Extended => Ok(Tier {
                exactness: Self::of(gpu)?.extended().map_err(refused)?,
                ..precision.into()
            }),
            Precision::Double => {
                Self::of(gpu)?.double().map_err(refused)?;
                Ok(precision.into())
            }
        }
    }

    /// The fastest form of the exact steps that is exact here, for the tier `extended`.
    ///
    /// # Errors
    /// Why there is none.
    pub fn extended(&self) -> Result<Exactness, String> {
        // The fewer instructions the better: `fma` does in one what halves do in sixteen, and hiding takes one for every
        // rounding.
        use Exactness::{DecoratedDekker, DecoratedFused, Dekker, Fused};
        [DecoratedFused, DecoratedDekker, Fused, Dekker]
            .into_iter()
            .find(|&exactness| self.is_exact(exactness))
            .ok_or_else(|| "no form of exact sums and products is exact on this adapter".into())
    }

    /// Whether a form of the exact steps is known to be exact.
    #[must_use]
    pub fn is_exact(&self, exactness: Exactness) -> bool {
        self.forms
            .iter()
            .any(|form| form.name == exactness.name() && form.wrong == 0.0)
    }

    /// Whether the tier `double` keeps its bounds.
    ///
    /// # Errors
    /// Why it does not.
    pub fn double(&self) -> Result<(), String> {
        if !self.offered.f64 {
            return Err("the adapter offers no f64 in shaders".into());
        }
        let Some(found) = &self.double else {
            return Err("the adapter offers f64, but no 64-bit integers".into());
        };
        if !found.rounding.has_correct_sums() {
            return Err("sums or products of f64 are not rounded correctly".into());
        }
        if found.two_sum_hidden > 0.0 || found.two_product_halves > 0.0 {
            return Err("no sum or product of f64 is exact with hidden steps".into());
        }
        Ok(())
    }
}

fn recall(key: &Key) -> Option<Arc<Capabilities>> {
    let known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    known.iter().find(|found| found.adapter == *key).cloned()
}

fn remember(found: Capabilities) -> Arc<Capabilities> {
    let found = Arc::new(found);
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    known.retain(|older| older.adapter != found.adapter);
    known.push(Arc::clone(&found));
    found
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Findings about a machine by the book.
    pub(crate) fn ideal() -> Capabilities {
        let rounding = Rounding {
            sum: 0.5,
            difference: 0.5,
            product: 0.5,
            quotient: 0.5,
            root: 0.5,
        };
        let arithmetic = Arithmetic {
            two_sum: 0.0,
            two_sum_hidden: 0.0,
            two_product_fma: 0.0,
            two_product_halves: 0.0,
            contracted: 0.0,
            rounding,
            special: Special::default(),
        };
        Capabilities {
            adapter: Key {
                name: "A/GPU (x)".into(),
                driver: "driver 1.2".into(),
                backend: "vulkan".into(),
            },
            offered: Offered {
                f64: true,
                u64: true,
                decorations: true,
            },
            single: arithmetic.clone(),
            double: Some(arithmetic.clone()),
            single_decorated: Some(arithmetic.clone()),
            double_decorated: Some(arithmetic),
            forms: Exactness::ALL.map(|form| Form::new(form, 0.0)).into(),
            turns: None,
        }
    }

    #[test]
    fn the_fastest_exact_form_is_chosen() {
        let mut found = ideal();
        let check = |found: &Capabilities, expected| assert_eq!(found.extended().ok(), expected);
        use Exactness::{DecoratedDekker, DecoratedFused, Dekker, Fused};
        check(&found, Some(DecoratedFused));
        found.forms[3].wrong = 1.0;
        check(&found, Some(DecoratedDekker));
        found.forms.truncate(2);
        check(&found, Some(Fused));
        found.forms[1].wrong = 1e-4;
        check(&found, Some(Dekker));
        found.forms[0].wrong = 1e-4;
        check(&found, None);
    }

    #[test]
    fn doubles_that_are_missing_or_wrong_are_refused() {
        let check = |change: fn(&mut Capabilities), reason: Option<&str>| {
            let mut found = ideal();
            change(&mut found);
            match (found.double(), reason) {
                (Ok(()), None) => {}
                (Err(said), Some(reason)) => assert!(said.contains(reason), "{said}"),
                (found, reason) => panic!("{found:?} for {reason:?}"),
            }
        };
        check(|_| {}, None);
        check(|found| found.offered.f64 = false, Some("no f64"));
        check(|found| found.double = None, Some("64-bit integers"));
        check(
            |found| found.double.as_mut().unwrap().rounding.product = 0.9,
            Some("rounded correctly"),
        );
        check(
            |found| found.double.as_mut().unwrap().two_sum_hidden = 0.1,
            Some("exact"),
        );
        // Reassociation is what hiding is for, and quotients are not relied upon.
        check(|found| found.double.as_mut().unwrap().two_sum = 1.0, None);
        check(
            |found| found.double.as_mut().unwrap().rounding.quotient = 1.0,
            None,
        );
    }

    /// What FACTS of lavapipe are: Mesa's software adapter, where there is one. Other drivers may differ, and what they
    /// do is found, not assumed.
    #[test]
    fn what_the_software_adapter_does() {
        let Ok(gpu) = Gpu::open(&crate::AdapterChoice::Software) else {
            return;
        };
        let found = probe::capabilities(&gpu).unwrap();
        // Holds everywhere, or `extended` is refused.
        assert!(found.extended().is_ok());
        assert_eq!(found.single.two_sum_hidden, 0.0);
        assert!(found.single.rounding.has_correct_sums());
        if !gpu.adapter().driver.contains("Mesa 22") {
            return;
        }
        assert!(!found.is_exact(Exactness::Fused));
        assert!(found.is_exact(Exactness::Dekker));
        assert_eq!(found.extended(), Ok(Exactness::DecoratedDekker));
        assert!(found.single.two_sum > 0.2, "reassociates");
        assert!(found.single.two_product_fma > 0.9, "fma is not fused");
        assert_eq!(found.single.two_product_halves, 0.0);
        assert!(
            found.single.rounding.is_correct(),
            "{:?}",
            found.single.rounding
        );
        assert_eq!(found.double(), Ok(()));
        assert_eq!(found.single_decorated.unwrap().two_sum, 0.0);
        assert_eq!(found.double_decorated.unwrap().two_sum, 0.0);
    }
}
