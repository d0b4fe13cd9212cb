//! The rules, as they are told to people.

/// A rule of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "each is documented by its record")]
pub enum Rule {
    Constant,
    Polynomial,
    Exponential,
    Wave,
    DampedWave,
    ProductOfWaves,
    PolynomialByWave,
    Series,
}

/// What a rule does.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    /// The rule.
    pub rule: Rule,
    /// Its name.
    pub name: &'static str,
    /// What is integrated, and what comes out. h is half the length of the interval, L = 2h; Greek letters are values
    /// in its middle and slopes by the parameter.
    pub equation: &'static str,
    /// Where it holds, and what it is worth: the greatest |computed - exact| / ∫|f| in the accurate tier.
    pub bound: &'static str,
    /// Where it is from.
    pub source: &'static str,
}

/// Every rule, in the order of [`Rule`].
pub static RULES: [Record; 8] = [
    Record {
        rule: Rule::Constant,
        name: "constant",
        equation: "∫ c = c L",
        bound: "always; 2 roundings",
        source: "elementary",
    },
    Record {
        rule: Rule::Polynomial,
        name: "polynomial",
        equation: "∫ p = h Σ wⱼ p(h xⱼ), Gauss-Legendre nodes of the polynomial as written, exact to its degree",
        bound: "degree up to 60; positive weights, so that the error is that of the values",
        source: "Davis and Rabinowitz, Methods of Numerical Integration, section 2.7",
    },
    Record {
        rule: Rule::Exponential,
        name: "exponential",
        equation: "∫ e^(α + βs) = L e^(α + |βh|) φ(-2|βh|), φ(x) = (eˣ - 1)/x",
        bound: "always; the relative error of the exponential of its exponent",
        source: "NIST DLMF 4.10.1",
    },
    Record {
        rule: Rule::Wave,
        name: "wave",
        equation: "∫ sin(γ + δs) = L sinc(δh) sin γ, and cos, sinh, cosh with sinhc alike",
        bound: "always; 1e-6 while |γ| is below 1",
        source: "NIST DLMF 4.26.1, 4.21(ii)",
    },
    Record {
        rule: Rule::DampedWave,
        name: "exponential by wave",
        equation: "∫ e^(α + βs) sin(γ + δs) = L Im(e^(α + w + i(γ + v)) φ(-2(w + iv))), w + iv = ±(β + iδ)h, w ≥ 0",
        bound: "always",
        source: "NIST DLMF 4.26.8, 4.26.9",
    },
    Record {
        rule: Rule::ProductOfWaves,
        name: "product of waves",
        equation: "∫ sin u cos v = ½ ∫ (sin(u + v) + sin(u - v)) and its kin; nodes of the product on short intervals",
        bound: "up to 16 factors; the phases that change by less than 1 each are taken by nodes, right to 1e-12",
        source: "NIST DLMF 4.21(ii), 4.35(ii)",
    },
    Record {
        rule: Rule::PolynomialByWave,
        name: "polynomial by exponential or wave",
        equation: "∫ p e^(λs) = [e^(λs) Σ (-1)ᵏ p⁽ᵏ⁾/λᵏ⁺¹] at both ends; nodes of the product where |λh| < degree + 2",
        bound: "degree up to 16; the nodes are right to 1e-12",
        source: "NIST DLMF 4.10(i), 4.26(ii)",
    },
    Record {
        rule: Rule::Series,
        name: "sum",
        equation: "∫ Σ fₖ = Σ ∫ fₖ",
        bound: "as its terms",
        source: "elementary",
    },
];

impl Rule {
    /// What the rule does.
    #[must_use]
    pub fn record(self) -> &'static Record {
        &RULES[self as usize]
    }
}
