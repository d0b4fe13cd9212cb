//! The shader texts that the compiler carries, each parsed once per process.

use std::sync::OnceLock;

use naga::{Function, Module};

use super::{Linker, Provider};
use crate::lower::{Exactness, Format, LowerError, Precision, Tier};

/// Functions on numbers, as one text.
const MATH: &str = concat!(
    include_str!("../../shaders/math/bits.wgsl"),
    include_str!("../../shaders/math/real.wgsl"),
    include_str!("../../shaders/math/trigonometry.wgsl"),
    include_str!("../../shaders/math/power.wgsl"),
    include_str!("../../shaders/math/gamma.wgsl"),
    include_str!("../../shaders/math/complex.wgsl"),
    include_str!("../../shaders/math/complex_waves.wgsl"),
    include_str!("../../shaders/math/wave_quotients.wgsl"),
    include_str!("../../shaders/math/complex_gamma.wgsl"),
    include_str!("../../shaders/math/complex_power.wgsl"),
    include_str!("../../shaders/math/pairs.wgsl"),
    include_str!("../../shaders/math/hash.wgsl"),
    include_str!("../../shaders/math/slope.wgsl"),
    include_str!("../../shaders/math/cardinal.wgsl"),
    include_str!("../../shaders/math/polygamma.wgsl"),
    include_str!("../../shaders/math/rational.wgsl"),
    include_str!("../../shaders/math/bessel.wgsl"),
    include_str!("../../shaders/math/erf.wgsl"),
);

/// Functions of the tier `fast`, where it has others than these.
const FAST: &str = concat!(
    include_str!("../../shaders/fast/real.wgsl"),
    include_str!("../../shaders/fast/hash.wgsl"),
    include_str!("../../shaders/fast/complex.wgsl"),
);

/// Functions on wide numbers, in terms of the arithmetic of a format, as one text.
macro_rules! wide {
    ($format:literal) => {
        concat!(
            include_str!(concat!("../../shaders/wide/", $format, ".wgsl")),
            include_str!("../../shaders/wide/uniforms.wgsl"),
            include_str!("../../shaders/wide/real.wgsl"),
            include_str!("../../shaders/wide/trigonometry.wgsl"),
            include_str!("../../shaders/wide/power.wgsl"),
            include_str!("../../shaders/wide/gamma.wgsl"),
            include_str!("../../shaders/wide/complex.wgsl"),
            include_str!("../../shaders/wide/complex_waves.wgsl"),
            include_str!("../../shaders/wide/complex_gamma.wgsl"),
            include_str!("../../shaders/wide/complex_power.wgsl"),
            include_str!("../../shaders/wide/pairs.wgsl"),
            include_str!("../../shaders/wide/hash.wgsl"),
            include_str!("../../shaders/wide/slope.wgsl"),
            include_str!("../../shaders/wide/cardinal.wgsl"),
            include_str!("../../shaders/wide/polygamma.wgsl"),
            include_str!("../../shaders/wide/rational.wgsl"),
            include_str!("../../shaders/wide/bessel.wgsl"),
            include_str!("../../shaders/wide/erf.wgsl"),
        )
    };
}

/// Functions on pairs of single-precision numbers, but for the exact steps, which go in front.
const PAIR: &str = wide!("pair");

/// Functions on double-precision numbers.
const DOUBLE: &str = wide!("double");

/// Functions that scenes draw with, as one text.
const SHARED: &str = concat!(
    include_str!("../../shaders/shared/number.wgsl"),
    include_str!("../../shaders/shared/colour.wgsl"),
    include_str!("../../shaders/shared/lines.wgsl"),
    include_str!("../../shaders/shared/gauss.wgsl"),
    include_str!("../../shaders/shared/plane.wgsl"),
    include_str!("../../shaders/shared/logarithm.wgsl"),
    include_str!("../../shaders/shared/phase.wgsl"),
    include_str!("../../shaders/shared/digits.wgsl"),
    include_str!("../../shaders/shared/key.wgsl"),
    include_str!("../../shaders/shared/camera.wgsl"),
    include_str!("../../shaders/shared/box.wgsl"),
    include_str!("../../shaders/shared/shapes.wgsl"),
    include_str!("../../shaders/shared/mesh.wgsl"),
    include_str!("../../shaders/shared/lighting.wgsl"),
    include_str!("../../shaders/shared/values.wgsl"),
    include_str!("../../shaders/shared/layers.wgsl"),
    include_str!("../../shaders/shared/space.wgsl"),
    include_str!("../../shaders/shared/search.wgsl"),
    include_str!("../../shaders/shared/march.wgsl"),
    include_str!("../../shaders/shared/shells.wgsl"),
    include_str!("../../shaders/shared/medium.wgsl"),
    include_str!("../../shaders/shared/column.wgsl"),
    include_str!("../../shaders/shared/glow.wgsl"),
);

const SPLIT: &str = include_str!("../../shaders/math/split_fma.wgsl");

const ENTRY: &str = include_str!("../../shaders/shared/entry.wgsl");

/// The modules that every scene is linked with.
#[derive(Clone, Copy, Debug)]
pub struct Sources {
    /// Entry points.
    pub entry: &'static Module,
    /// Drawing.
    pub shared: &'static Module,
    /// Numbers, in the format of the tier.
    pub math: &'static Module,
}

/// Parses WGSL; a text of ours that is not valid gives an empty module and the message, which a test reports.
#[must_use]
pub fn parse_wgsl(text: &str) -> (Module, Option<String>) {
    match naga::front::wgsl::parse_str(text) {
        Ok(module) => (module, None),
        Err(error) => (Module::default(), Some(error.emit_to_string(text))),
    }
}

/// The entry points' module.
pub fn entry_module() -> &'static Module {
    static MODULE: OnceLock<Module> = OnceLock::new();
    MODULE.get_or_init(|| parse_wgsl(ENTRY).0)
}

/// The drawing library.
pub fn shared_module() -> &'static Module {
    static MODULE: OnceLock<Module> = OnceLock::new();
    MODULE.get_or_init(|| parse_wgsl(SHARED).0)
}

/// The library of functions on numbers of a tier.
pub fn number_module(tier: Tier) -> &'static Module {
    static DOUBLES: OnceLock<Module> = OnceLock::new();
    match tier.precision.format() {
        Format::Single if tier.precision == Precision::Fast => fast_module(),
        Format::Single if tier.splits_fma => split_module(),
        Format::Single => math_module(),
        Format::Pair => pair_module(tier.exactness),
        Format::Double => DOUBLES.get_or_init(|| parse_wgsl(DOUBLE).0),
    }
}

/// The library of functions on pairs, with a form of the exact steps.
fn pair_module(exactness: Exactness) -> &'static Module {
    static MODULES: [OnceLock<Module>; Exactness::ALL.len()] =
        [const { OnceLock::new() }; Exactness::ALL.len()];
    MODULES[exactness as usize].get_or_init(|| parse_wgsl(&pair_text(exactness)).0)
}

fn pair_text(exactness: Exactness) -> String {
    [exactness.wgsl(), PAIR].concat()
}

/// The library of functions on numbers of single precision.
pub fn math_module() -> &'static Module {
    static MODULE: OnceLock<Module> = OnceLock::new();
    MODULE.get_or_init(|| parse_wgsl(MATH).0)
}

/// The library of functions on numbers of single precision with one more, which stands in for `fma`.
fn split_module() -> &'static Module {
    static MODULE: OnceLock<Module> = OnceLock::new();
    MODULE.get_or_init(|| parse_wgsl(&[MATH, SPLIT].concat()).0)
}

/// The library of the tier `fast`: that of single precision with some functions in a shorter form.
fn fast_module() -> &'static Module {
    static MODULE: OnceLock<Module> = OnceLock::new();
    MODULE.get_or_init(|| {
        let shorter = parse_wgsl(FAST).0;
        let sources = vec![&shorter, math_module()];
        let names = |module: &Module| -> Vec<String> {
            let functions = module.functions.iter();
            functions.filter_map(|(_, f)| f.name.clone()).collect()
        };
        let mut linker = Linker::new(sources);
        for name in names(&shorter).into_iter().chain(names(math_module())) {
            if linker.function(&name, &mut Whole).is_err() {
                return Module::default();
            }
        }
        linker.out
    })
}

/// Fills no stub: libraries have none.
struct Whole;

impl Provider for Whole {
    fn provide(
        &mut self,
        _: &str,
        _: &Function,
        _: &mut Linker,
    ) -> Result<Option<Function>, LowerError> {
        Ok(None)
    }
}

impl Sources {
    /// All of them, with the numbers of a tier.
    #[must_use]
    pub fn get(tier: Tier) -> Self {
        Self {
            entry: entry_module(),
            shared: shared_module(),
            math: number_module(tier),
        }
    }
}
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_parses() {
        for (name, text) in [
            ("math", MATH),
            ("split", &[MATH, SPLIT].concat()),
            ("fast", FAST),
            ("double", DOUBLE),
            ("shared", SHARED),
            ("entry", ENTRY),
        ] {
            assert_eq!(parse_wgsl(text).1, None, "{name}");
        }
        for form in Exactness::ALL {
            assert_eq!(parse_wgsl(&pair_text(form)).1, None, "{form:?}");
        }
    }
}
