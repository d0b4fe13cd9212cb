//! By what means a shader computes rounding errors exactly.

macro_rules! steps {
    ($hiding:literal, $product:literal) => {
        concat!(
            include_str!(concat!("../../shaders/wide/exact_", $hiding, ".wgsl")),
            include_str!(concat!("../../shaders/wide/exact_", $product, ".wgsl")),
        )
    };
}

/// The form of the exact steps of pairs: `hidden_zero`, `opaque`, `two_sum`, `quick_two_sum` and `two_product`. Drivers
/// reassociate and contract, so which form is exact depends on the driver; the runtime's probe finds out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Exactness {
    /// Hidden roundings, products by halves: exact on every adapter tried.
    #[default]
    Dekker,
    /// Hidden roundings, products by `fma`, where that rounds once.
    Fused,
    /// Nothing hidden, products by halves; the SPIR-V must be decorated with NoContraction before it is loaded.
    DecoratedDekker,
    /// Nothing hidden, products by `fma`; decorated likewise.
    DecoratedFused,
}

impl Exactness {
    /// All forms, the one that works everywhere first.
    pub const ALL: [Self; 4] = [
        Self::Dekker,
        Self::Fused,
        Self::DecoratedDekker,
        Self::DecoratedFused,
    ];

    /// The WGSL text of the steps.
    #[must_use]
    pub fn wgsl(self) -> &'static str {
        match self {
            Self::Dekker => steps!("hidden", "dekker"),
            Self::Fused => steps!("hidden", "fused"),
            Self::DecoratedDekker => steps!("plain", "dekker"),
            Self::DecoratedFused => steps!("plain", "fused"),
        }
    }

    /// Whether the module is right only when its SPIR-V is decorated with NoContraction before it is loaded.
    #[must_use]
    pub fn is_decorated(self) -> bool {
        matches!(self, Self::DecoratedDekker | Self::DecoratedFused)
    }

    /// The name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Dekker => "hidden, by halves",
            Self::Fused => "hidden, by fma",
            Self::DecoratedDekker => "decorated, by halves",
            Self::DecoratedFused => "decorated, by fma",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_has_the_same_functions() {
        for form in Exactness::ALL {
            let module = naga::front::wgsl::parse_str(form.wgsl()).unwrap();
            let signature = |name: &str| {
                let mut functions = module.functions.iter().map(|(_, function)| function);
                let found = functions.find(|function| function.name.as_deref() == Some(name));
                found.map(|function| function.arguments.len())
            };
            let names = [
                "hidden_zero",
                "opaque",
                "two_sum",
                "quick_two_sum",
                "two_product",
            ];
            let found = names.map(signature);
            assert_eq!(found, [1, 2, 3, 3, 3].map(Some), "{form:?}");
        }
    }
}
