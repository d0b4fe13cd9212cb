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
    Reciprocal,
    ReciprocalRoot,
    Root,
    ReciprocalCube,
    ReciprocalSquare,
    Equiangular,
    PolynomialByPower,
    LogQuadratic,
    AffinePower,
    AffineLog,
    Bell,
    Sigmoidal,
    Logistic,
    Gaussian,
    PolynomialByGaussian,
    GaussianByWave,
    GrowingGaussian,
    ReciprocalProduct,
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
pub static RULES: [Record; 26] = [
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
        equation: "∫ sin u cos v = ½ ∫ (sin(u + v) + sin(u - v)) and its kin; nodes of the product on short \
                   intervals",
        bound: "up to 16 factors; the phases that change by less than 1 each are taken by nodes, right to 1e-12",
        source: "NIST DLMF 4.21(ii), 4.35(ii)",
    },
    Record {
        rule: Rule::PolynomialByWave,
        name: "polynomial by exponential or wave",
        equation: "∫ p e^(iδs) = L Σ cₙ iⁿ jₙ(δh), p(h x) = Σ cₙ Pₙ(x); beside an exponential \
                   [e^(λs) Σ (-1)ᵏ p⁽ᵏ⁾/λᵏ⁺¹] at both ends, and nodes of the product where |λh| < degree + 2",
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
    Record {
        rule: Rule::Reciprocal,
        name: "reciprocal of a quadratic",
        equation: "∫ 1/q = L atan2(√(DL²), E)/√(DL²), E = q(m) - a h², D = |d|² |p(m) - c|² - (d·(p(m) - c))² \
                   as |d × (p(m) - c)|²",
        bound: "always; one formula through D = 0",
        source: "NIST DLMF 4.23, 4.40.5; Sun et al., A practical analytic single scattering model, SIGGRAPH 2005",
    },
    Record {
        rule: Rule::ReciprocalRoot,
        name: "reciprocal root of a quadratic",
        equation: "∫ 1/√q = (1/√a) log(1 + √a L (S + √a L)/(r₀r₁ + E)), S = r₀ + r₁; \
                   2L atan2(√-a L, S)/(√-a L) where a may be negative",
        bound: "always; infinite where q has a zero in the interval",
        source: "NIST DLMF 4.37, 4.40",
    },
    Record {
        rule: Rule::Root,
        name: "root of a quadratic",
        equation: "∫ √q = L (S/4 + (q(m) + D u k)/S), u = L²/S², k = (artanh(√z)/√z - 1)/z at z = a u; \
                   L (S/4 + q(m) G - (r₁ - r₀)² A₁/(4S)), G = atan2(√-a L, S)/(√-a L), where a may be negative",
        bound: "always",
        source: "NIST DLMF 4.40; Gradshteyn and Ryzhik 2.262",
    },
    Record {
        rule: Rule::ReciprocalCube,
        name: "reciprocal cube of a root",
        equation: "∫ q^(-3/2) = L (r₀ + r₁)/(r₀ r₁ (r₀ r₁ + E)), r₀r₁ + E = DL²/(r₀r₁ - E) where E < 0",
        bound: "always; infinite where q has a zero in the interval",
        source: "Gradshteyn and Ryzhik 2.264.5",
    },
    Record {
        rule: Rule::ReciprocalSquare,
        name: "squared reciprocal of a quadratic",
        equation: "∫ 1/q² = (L/q₀q₁) (1 + (a/2D) (G q₀q₁ - E)), G = atan2(√(DL²), E)/√(DL²); with \
                   (aL²/2E) (1 - (1 + z) A₁(z)) for z = DL²/E² below 1",
        bound: "always; infinite where q has a zero in the interval",
        source: "Gradshteyn and Ryzhik 2.172, 2.173",
    },
    Record {
        rule: Rule::Equiangular,
        name: "negative power of a quadratic",
        equation: "∫ p q^(-n) = ∫ p q^(1-n) dθ/√D over the angle at the zero of q, by nodes",
        bound: "exponents -5/2, -3 …, and -2 beside polynomials of degree up to 2n - 2; right to 1e-12",
        source: "Kulla and Fajardo, Importance sampling techniques for path tracing in participating media, 2012",
    },
    Record {
        rule: Rule::PolynomialByPower,
        name: "polynomial by power of a quadratic",
        equation: "Σ p⁽ᵏ⁾(s₀)/k! ∫ σᵏ q^r, (2r + 1 + k) Fₖ = [σᵏ⁻¹ q^(r+1)]/a - (k - 1) (D/a²) Fₖ₋₂; nodes of \
                   the product where |a| h² < q(m)/4",
        bound: "exponents -3/2, -1, -1/2, 1/2, 3/2 …, degree up to 12",
        source: "Gradshteyn and Ryzhik 2.263",
    },
    Record {
        rule: Rule::LogQuadratic,
        name: "logarithm of a quadratic",
        equation: "(k + 1) ∫ σᵏ log q = [σᵏ⁺¹ log q] - 2a ∫ σᵏ⁺²/q; nodes of the product where |a| h² < q(m)/4",
        bound: "degree up to 12",
        source: "Gradshteyn and Ryzhik 2.733",
    },
    Record {
        rule: Rule::AffinePower,
        name: "power of a linear function",
        equation: "∫ x^p = L X^p φ((p + 1) λ)/φ(λ), X the end greater in size, λ = log1p(-2|w|/|X|) or the logarithm \
                   of the ratio of both ends",
        bound: "any exponent; beside polynomials of degree up to 12 by moments, and nodes where |w| < |x(m)|/2",
        source: "NIST DLMF 4.10.3",
    },
    Record {
        rule: Rule::AffineLog,
        name: "logarithm of a linear function",
        equation: "(k + 1) β ∫ xᵏ log x = [xᵏ⁺¹ (log x - 1/(k + 1))]; nodes of the product where |w| < |x(m)|/2",
        bound: "degree up to 12",
        source: "NIST DLMF 4.10.5",
    },
    Record {
        rule: Rule::Bell,
        name: "hyperbolic secant",
        equation: "∫ sech² x = L sinhc(2w)/(cosh x₀ cosh x₁), ∫ sech x = L atan(w y)/w, y = sinhc(w)/cosh x(m)",
        bound: "always",
        source: "NIST DLMF 4.40.5",
    },
    Record {
        rule: Rule::Sigmoidal,
        name: "tanh, atan, asinh, erf, erfc",
        equation: "the difference of log cosh x, x atan x - log √(1 + x²), x asinh x - √(1 + x²), x erf x + \
                   e^(-x²)/√π, i¹erfc x; nodes on short intervals",
        bound: "always",
        source: "NIST DLMF 4.40.3, 4.26.14, 4.40.11, 7.7",
    },
    Record {
        rule: Rule::Logistic,
        name: "logistic function",
        equation: "∫ 1/(1 + e^-x) = L (log(1 + e^x₁) - log(1 + e^x₀))/(x₁ - x₀); L σ φ(δ) log1p(σ expm1 δ)/(σ \
                   expm1 δ) for δ = x₁ - x₀ below 1",
        bound: "always",
        source: "elementary",
    },
    Record {
        rule: Rule::Gaussian,
        name: "Gaussian",
        equation: "∫ e^(-q) = L e^(-min q) M/(2w), M = ∫ e^(-u²) from c - w to c + w over its greatest value",
        bound: "exponents that fall; the relative error of the exponential of its exponent",
        source: "NIST DLMF 7.2.1, 7.7",
    },
    Record {
        rule: Rule::PolynomialByGaussian,
        name: "polynomial by Gaussian",
        equation: "∫ₓ^∞ p e^(-u²) du = e^(-x²) Σ p⁽ⁿ⁾ (√π/2) e^(x²) iⁿerfc x from the ends and the centre; \
                   nodes where the exponent changes by less than degree + 2",
        bound: "degree up to 7",
        source: "NIST DLMF 7.18",
    },
    Record {
        rule: Rule::GaussianByWave,
        name: "Gaussian by wave",
        equation: "∫ₓ^∞ p e^(-u² + iκu) du = (√π/2) e^(-x² + iκx) Σ p⁽ⁿ⁾ e^(z²) iⁿerfc z, z = x - iκ/2, from both ends, \
                   the first of them w(iz), and √π e^(-κ²/4) Σ p⁽ᵐ⁾ iᵐ hₘ/m! around the centre; nodes of the product \
                   where exponent and phases change by less than 4 or degree + 2",
        bound: "degree up to 7; w and its derivatives right to 3e-13",
        source: "NIST DLMF 7.2(i), 7.7, 7.18; Weideman, SIAM Journal on Numerical Analysis 31, 1994",
    },
    Record {
        rule: Rule::GrowingGaussian,
        name: "growing Gaussian",
        equation: "∫ p e^(u²) du = e^(u²) Σ p⁽ⁿ⁾ D⁽ⁿ⁾/(2ⁿ n!) at both ends with Dawson's D; nodes where the exponent changes \
                   by less than degree + 4",
        bound: "degree up to 7; D and its derivatives right to 3e-13",
        source: "NIST DLMF 7.2.5, 7.5; Weideman, SIAM Journal on Numerical Analysis 31, 1994",
    },
    Record {
        rule: Rule::ReciprocalProduct,
        name: "product of reciprocals",
        equation: "∫ 1/(xy) = L log1p(z)/(z x₀ y₁), z = L (x'y - y'x)/(x₀ y₁); ∫ 1/(xq) and ∫ 1/(q₁q₂) by partial \
                   fractions, and ∫₀¹ ∫ 1/((1 - t) q₁ + t q₂)² dt by 8 nodes where the zeros of both are near one \
                   another",
        bound: "two of degree 1 or 2, those of degree 2 without zeros on the line; the nodes right to 1e-12; rational \
                functions of one linear function by as many fractions as they have",
        source: "Feynman, Physical Review 76, 1949, equation 14; elementary",
    },
];

impl Rule {
    /// What the rule does.
    #[must_use]
    pub fn record(self) -> &'static Record {
        &RULES[self as usize]
    }
}
