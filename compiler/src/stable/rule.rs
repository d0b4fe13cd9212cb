//! The rules, as data.

/// One rewrite: what it is called, its equation, where it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    /// The rule.
    pub rule: Rule,
    /// Its name on the command line.
    pub name: &'static str,
    /// The equation, left as it is written, right as it is computed.
    pub equation: &'static str,
    /// Numbers for which it is used.
    pub kinds: &'static str,
    /// Where it holds in floating point: zeros, infinities, NaN, overflow, what guards it.
    pub domain: &'static str,
    /// Who says so.
    pub source: &'static str,
    /// Whether the written formula is changed before it is differentiated, too; otherwise only what is computed is.
    pub early: bool,
}

macro_rules! rules {
    ($($rule:ident $name:literal, $early:literal, $kinds:literal: $equation:literal, $domain:literal, $source:literal;)*) => {
        /// Names a rule.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[allow(missing_docs, reason = "each is described by its record")]
        pub enum Rule { $($rule),* }

        /// Every rule, in the order of the documentation.
        pub const RULES: &[Record] = &[$(Record {
            rule: Rule::$rule,
            name: $name,
            equation: $equation,
            kinds: $kinds,
            domain: $domain,
            source: $source,
            early: $early,
        }),*];
    };
}

rules! {
    Cancel "cancel", true, "real and complex":
        "(a + b) - a = b",
        "terms of a sum that are the same but for a constant factor are added first, where the factors add exactly; a term that vanishes stays as 0·a, so that a NaN or an infinity of it still gives NaN. Products of sums are multiplied out where just one term is left so. Where b is far below a, b comes out instead of 0",
        "distributive law";
    Constants "constants", true, "real and complex":
        "(c·a)/d = (c/d)·a",
        "c and d constants whose quotient or product is exact and neither subnormal nor infinite: the result can only overflow or underflow less often",
        "exact scaling";
    Factor "factor", true, "real and complex":
        "a·b - a·c = a·(b - c)",
        "only where b - c is simplified by another rule; a = ±∞ with b = c gives NaN either way",
        "distributive law";
    Quotients "quotients", true, "real and complex":
        "a/b - c/d = (a·d - c·b)/b/d",
        "only where the numerator loses its terms to cancellation or is simplified by another rule, and has no exponential in it; the divisions follow one another, so that b·d cannot overflow. Where the numerator is a difference of squares, guarded by 2|a/b - c/d| < |a/b|, else as written: there nothing cancels, and the written form rounds less. At a pole the infinity is that of the pole; where both terms are infinite, the limit comes out instead of NaN",
        "N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., section 1.7";
    Products "products", true, "real":
        "a·b - c·d = a·(b - d) + d·(a - c)",
        "only where both differences are simplified by other rules",
        "discrete product rule";
    Squares "squares", false, "real and complex":
        "a² - b² = (a - b)·(a + b), (a - b)² + 2·b·(a - b) for a constant b",
        "reals everywhere, in a sum of two terms: the errors of a - b and a + b compensate. Of a constant b as written where a² < 2|a² - b²|, since there nothing cancels; |a| and |b| are taken, so that an exact zero is +0 as written. Complex a and constant b: only the real part is taken from the product, the imaginary part from a², where it does not cancel and its sign chooses the side of a cut. a² may overflow where the product does not. Not before differentiation: (2a)' is better than the derivative of the product",
        "D. Goldberg, What every computer scientist should know about floating-point arithmetic, ACM Comput. Surv. 23 (1991), section 1.4";
    Cubes "cubes", false, "real and complex":
        "a³ - b³ = (a - b)·(a² + a·b + b²), and so on for aⁿ - bⁿ, n = 5, 7",
        "reals everywhere for n = 3, where the second factor is 3/4·(a + b)² + 1/4·(a - b)²; else only where a - b is simplified. For n = 5 and 7 the sum in the second factor may be NaN where the powers overflow; infinite a and b of opposite signs give NaN",
        "factorisation";
    ComplexSquares "complex-squares", false, "complex":
        "z² + c² = (z - c·i)·(z + c·i)",
        "c a constant; everywhere, the imaginary part from z²",
        "factorisation over the complex numbers";
    Sqrt "sqrt-difference", true, "real; complex where a - b is a real constant":
        "√a - √b = (a - b)/(√a + √b)",
        "where a - b is simplified, or a and b are inputs; guarded by |a - b| < b unless a - b is constant. NaN for negative reals as written; where a - b is constant, the limit 0 instead of NaN for a, b → ∞",
        "Higham, section 1.8";
    Conjugate "conjugate", true, "real":
        "√a - b = (a - b²)/(√a + b) for b > 0",
        "where a - b² is simplified; guarded by √a < 4b, else as written. This is the stable quadratic formula",
        "G. E. Forsythe, How do you solve a quadratic equation?, Stanford CS 40 (1966); Higham, section 1.8";
    Cbrt "cbrt-difference", true, "real":
        "cbrt a - cbrt b = (a - b)/(cbrt²a + cbrt a·cbrt b + cbrt²b)",
        "where a - b is simplified; guarded by the divisor > 0 where a - b can vanish",
        "factorisation of a³ - b³";
    Log "log-difference", true, "real; complex where a - b is a real constant":
        "log a - log b = log1p((a - b)/b)",
        "where a - b is simplified, or a and b are inputs; reals guarded by 2|a - b| < b, else as written, so that logarithms of negative numbers stay NaN and those of 0 infinite",
        "W. Kahan, Branch cuts for complex elementary functions (1987), section 5";
    LogQuotient "log-quotient", true, "real":
        "log(a/b) = log1p((a - b)/b), 2·atanh((a - b)/(a + b)) where a + b is constant",
        "where a - b is simplified; the first guarded by |(a - b)/b| < 1/2; negative quotients stay NaN, a/b = 0 is -∞",
        "definition of log1p";
    Log1p "log1p", true, "real and complex":
        "log(1 + a) = log1p(a)",
        "everywhere; log(1 + a) of a tiny a is a, with its sign, where it was 0. The cut of complex numbers is the same",
        "Kahan 1987; DLMF 4.2";
    LogAbs "log-abs", true, "complex":
        "log|z| = re log z",
        "everywhere; accurate near |z| = 1 and where |z| over- or underflows",
        "Kahan 1987";
    LogPower "log-power", true, "real and complex":
        "log|aⁿ| = n·log|a|, log(aⁿ) = n·log|a| for even n, log|exp z| = re z, log(exp x) = x",
        "everywhere; aⁿ and exp z are not formed, and cannot over- or underflow",
        "DLMF 4.8";
    Exp "exp-difference", true, "real and complex":
        "exp a - exp b = exp b·expm1(a - b)",
        "where a - b is simplified, or a and b are inputs; guarded by |a - b| < 1 unless it is a small constant",
        "definition of expm1";
    Expm1 "expm1", true, "real and complex":
        "exp a - 1 = expm1 a",
        "everywhere; of a tiny a it is a, with its sign, where it was 0",
        "Kahan 1987";
    SinhExp "sinh", true, "real and complex":
        "exp a - exp(-a) = 2·sinh a",
        "everywhere; a = ±0 gives ±0 where +0 came out. Any constant difference or sum of the exponents is taken out",
        "DLMF 4.28.1";
    CoshExp "cosh", true, "real and complex":
        "exp a + exp(-a) = 2·cosh a",
        "everywhere",
        "DLMF 4.28.2";
    ExpProduct "exp-product", true, "real and complex":
        "exp a·exp b = exp(a + b), exp a/exp b = exp(a - b)",
        "only where terms of the exponents cancel; neither factor can over- or underflow any more. A NaN of what cancels stays NaN",
        "DLMF 4.8";
    ExpRatio "exp-ratio", true, "real":
        "exp a/(exp a - 1) = -1/expm1(-a)",
        "everywhere; 1 instead of NaN where exp a overflows; at a = -0 the infinity of that side",
        "Higham, section 1.14";
    Ratio "exponential-ratio", true, "real":
        "sinh a/cosh a = tanh a, expm1(2a)/expm1 a = exp a + 1",
        "everywhere; the limit instead of NaN where both overflow, and 2 instead of NaN at a = 0 for the second",
        "DLMF 4.28.8";
    PowerMinusOne "power-minus-one", true, "real":
        "a^b - 1 = expm1(b·log a)",
        "guarded by |b·log a| < 1/2, else as written; log a is log1p(a - 1) where a - 1 is simplified",
        "Higham, problem 1.5";
    PowerDifference "power-difference", true, "real":
        "a^p - b^p = b^p·expm1(p·log1p((a - b)/b))",
        "where a - b is simplified; guarded by |a - b| < b and |p·log1p(…)| < 100, else as written",
        "as log-difference";
    CompoundPower "compound-power", true, "real":
        "(1 + a)^b = exp(b·log1p a)",
        "guarded by |a| < 2⁻⁸ and |b·log1p a| < 100, else as written; a no constant, b no integer constant. 1 + a would lose the digits of a, and b magnifies that",
        "Goldberg, section 1.4 (interest)";
    CosMinusOne "one-minus-cos", true, "real and complex":
        "1 - cos a = 2·sin²(a/2), 1 + cos a = 2·cos²(a/2)",
        "everywhere; where sin²(a/2) underflows, the result does",
        "DLMF 4.21.1, 4.21.2";
    CoshMinusOne "cosh-minus-one", true, "real and complex":
        "cosh a - 1 = 2·sinh²(a/2)",
        "everywhere",
        "DLMF 4.35.16";
    Pythagoras "pythagoras", true, "real and complex":
        "1 - cos²a = sin²a, 1 - sin²a = cos²a, cosh²a - 1 = sinh²a, 1 - tanh²a = sech²a",
        "everywhere; reals where cosh a overflows: sech²a is 0, and 1 - tanh²a was",
        "DLMF 4.21.12, 4.35.11";
    TanhMinusOne "one-minus-tanh", true, "real":
        "1 - tanh a = 2/(1 + exp(2a))",
        "everywhere; 0 where exp(2a) overflows",
        "DLMF 4.28.4";
    Sin "sin-difference", true, "real and complex":
        "sin a - sin b = 2·sin d·(cos b·cos d - sin b·sin d), d = (a - b)/2",
        "where a - b is simplified, or (guarded by |a - b| < 1) a and b are inputs; no argument is rounded that was exact. Complex: 2·sin d·cos(b + d), which does not overflow where the sines do not",
        "DLMF 4.21.6, 4.21.2";
    Cos "cos-difference", true, "real and complex":
        "cos a - cos b = -2·sin d·(sin b·cos d + cos b·sin d), d = (a - b)/2",
        "as sin-difference",
        "DLMF 4.21.9, 4.21.1";
    Tan "tan-difference", true, "real":
        "tan a - tan b = sin(a - b)/cos a/cos b",
        "where a - b is simplified; poles as written",
        "DLMF 4.21.4";
    TanHalf "tan-half", true, "real":
        "(1 - cos a)/sin a = tan(a/2)",
        "everywhere; 0 instead of NaN at a = 0",
        "DLMF 4.21.20";
    Atan "atan-difference", true, "real":
        "atan a - atan b = atan2(a - b, 1 + a·b)",
        "where a - b is simplified; the difference is in (-π, π), so the branch is certain. Guarded by |a - b| < |b| unless a - b is constant. Where a·b overflows the difference underflows",
        "DLMF 4.24.15";
    Hyperbolic "hyperbolic-difference", true, "real":
        "sinh a - sinh b = 2·cosh((a + b)/2)·sinh((a - b)/2), cosh a - cosh b = 2·sinh((a + b)/2)·sinh((a - b)/2), tanh a - tanh b = sinh(a - b)/cosh a/cosh b",
        "where a - b is simplified; tanh guarded by |a - b| < 1 unless that is constant",
        "DLMF 4.35.3 to 4.35.10";
    Slope "slope-difference", true, "real":
        "1/(1 + a²) - 1/(1 + b²) = (b - a)·(b + a)/(1 + a²)/(1 + b²)",
        "of the derivatives of atan, where a - b is simplified",
        "factorisation";
    Hypot "hypot", true, "real":
        "√(a² + b²) = hypot(a, b), √(a² + b² + c²) = length(a, b, c), √(c·a²) = √c·|a|",
        "everywhere, constants that are squares among the terms, too; does not overflow, nor underflow, where the result does not. Where a or b is a product, as written while the sum of the squares is between 10⁻³⁰ and 10³⁰, and a quotient by it, too: the rounding of the product would count twice. As in C99, infinite where an argument is, even beside a NaN",
        "W. Kahan 1987; C99 7.12.7.3";
    Asinh "asinh", true, "real":
        "log(x + √(x² + 1)) = asinh x, log(x + √(x² - 1)) = acosh x",
        "everywhere; asinh of negative x, where the sum cancels, and of huge ones, where x² overflows; acosh is NaN below 1 as the logarithm is",
        "DLMF 4.37.16, 4.37.19";
    Cardinal "cardinal", true, "real and complex":
        "sin a/a = sinc a, sinh a/a = sinhc a, expm1 a/a = exprel a",
        "everywhere, powers and inverses of them, and with constant factors of a, too; 1 instead of NaN at a = 0, the limit at ±∞, and no overflow before that of the quotient. The values are no better: the derivatives are, which cancel near 0 as those of quotients",
        "DLMF 4.19.1, 4.33.1, 4.2.19";
    RootOfSquares "root-of-squares", false, "real":
        "√(a² - b²) = √(|a| - |b|)·√(|a| + |b|)",
        "guarded by |b| ≤ |a|, else as written, which is NaN but where a² and b² underflow; not for a constant a or b. Neither overflows nor underflows where the result does not, nor cancels; infinite a and b give NaN either way",
        "Higham, section 1.14";
    LogTan "log-tan", true, "real":
        "log(tan(π/4 + a)) = 2·atanh(tan a)",
        "everywhere: tan(π/4 + a) is positive where |tan a| < 1, and NaN comes out elsewhere; the sum with π/4 would round a",
        "DLMF 4.23.39, 4.37.24";
    LogSum "log-sum", true, "real":
        "log(1 + exp a) = a + log1p(exp(-a)), log(exp a + exp b) = a + log1p(exp(b - a))",
        "the exponent that is greater stands outside, so that nothing overflows; where |a - b| is no number below 10³⁰, as written",
        "P. Blanchard, D. J. Higham, N. J. Higham, Accurately computing the log-sum-exp and softmax functions, IMA J. Numer. Anal. 41 (2021)";
    LogCosh "log-cosh", false, "real":
        "log(cosh a) = |a| + log1p(exp(-2|a|)) - log 2, log|sinh a| = |a| + log1p(-exp(-2|a|)) - log 2",
        "for |a| ≥ 1; nearer to 0 log(cosh a) is log1p(2·sinh²(a/2)), and log|sinh a| as written. Not before differentiation: sinh a/cosh a is better",
        "DLMF 4.28.1, 4.28.2, 4.35.16";
    Logistic "logistic", true, "real":
        "c/(1 + exp a) - c/2 = -c/2·tanh(a/2), c/(1 + exp a) - c = -c/(1 + exp(-a))",
        "everywhere, c a constant; 0 with its sign at a = 0",
        "DLMF 4.28.4";
    Acos "acos-near-one", true, "real":
        "acos(1 - a) = 2·asin(√(a/2))",
        "guarded by 0 ≤ a < 1/4, else as written; 1 - a would lose the digits of a",
        "DLMF 4.21.21";
    Gudermann "gudermannian", true, "real":
        "atan(exp a) - π/4 = atan(tanh(a/2))",
        "everywhere",
        "DLMF 4.23.39 to 4.23.41";
    Remainder "remainder", true, "real":
        "f(a) minus the first terms of its Taylor series = the rest of the series",
        "sin a - a, sinh a - a, exp a - 1 - a, expm1 a - a, cos a - 1 + a²/2, cosh a - 1 - a²/2, tan a - a; guarded by |a| < 1, else as written. A zero has the sign of the rest",
        "DLMF 4.19, 4.33";
    PowerQuotient "power-quotient", true, "real and complex":
        "aᵐ·b/aⁿ = aᵐ⁻ⁿ·b, exp(a)·b/exp a = b",
        "of a sum over one product, too, where every term has the factor; where m or n is above 1 or the factor is a function that overflows before its argument does. A logarithmic derivative f'/f of a power needs no power. The limit instead of NaN where aⁿ is 0 or infinite, so at a = 0, too",
        "laws of exponents";
    SquareQuotient "square-quotient", true, "real":
        "b·a²/(a² + c) = b·(a·s)²/((a·s)² + c·s²), b/(a² + c) = (b·s)/((a·s)² + c·s²)·s",
        "a and c real, b of either kind; c between 0 and 2⁶⁰, sums of several squares, too; s = 2⁻⁶⁴ where |a| > 2⁶⁰, and 2⁶⁴ where |a| < 2⁻⁶⁰ if c is 0, else 1: multiplication by it is exact. Holds to |a| = 2⁵⁷⁵; beyond, and for infinite a, NaN as written. The points of the Riemann sphere are such quotients",
        "exact scaling; W. Kahan 1987";
    Reciprocal "reciprocal-wave", true, "real and complex":
        "c/cosh a = c·sech a, c/sinh a = c·csch a, of complex numbers c/cos a = c·sec a, c/sin a = c·csc a",
        "c constant; everywhere. The derivative of the quotient is 0·∞ where the function overflows, that of sech is not",
        "DLMF 4.28.9";
    ArgExp "arg-exp", true, "complex":
        "arg exp z = atan2(sin im z, cos im z), log exp z = re z + i·arg exp z",
        "everywhere, the logarithm after differentiation only; with the sign of im z where that is 0; exp z is not formed, and cannot over- or underflow. NaN where re z or im z is; the limit where re z is infinite",
        "DLMF 4.2";
}

impl Rule {
    /// What the rule is.
    #[must_use]
    pub fn record(self) -> &'static Record {
        &RULES[self as usize]
    }
}

/// Which rewrites are done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rewrites(u64);

impl Rewrites {
    /// All of them.
    pub const ON: Self = Self(u64::MAX >> (64 - RULES.len()));
    /// None.
    pub const OFF: Self = Self(0);

    /// Just these.
    #[must_use]
    pub fn of(rules: &[Rule]) -> Self {
        Self(rules.iter().fold(0, |bits, &rule| bits | Self::bit(rule)))
    }

    /// All but this one.
    #[must_use]
    pub fn without(self, rule: Rule) -> Self {
        Self(self.0 & !Self::bit(rule))
    }

    /// Whether a rule is among them.
    #[must_use]
    pub fn has(self, rule: Rule) -> bool {
        self.0 & Self::bit(rule) != 0
    }

    /// Whether there are any.
    #[must_use]
    pub fn any(self) -> bool {
        self.0 != 0
    }

    /// The rules among them.
    pub fn rules(self) -> impl Iterator<Item = Rule> {
        RULES.iter().map(|r| r.rule).filter(move |&r| self.has(r))
    }

    /// Reads `on`, `off`, or names with commas between; a name with a minus before it is left out of all.
    ///
    /// # Errors
    /// The word that names no rule.
    pub fn parse(text: &str) -> Result<Self, String> {
        match text.trim() {
            "on" | "all" => return Ok(Self::ON),
            "off" | "none" => return Ok(Self::OFF),
            _ => {}
        }
        let mut out: Option<Self> = None;
        for word in text.split(',').map(str::trim) {
            let (minus, name) = match word.strip_prefix('-') {
                Some(name) => (true, name),
                None => (false, word),
            };
            let record = RULES.iter().find(|r| r.name == name);
            let bit = Self::bit(record.ok_or_else(|| word.to_owned())?.rule);
            let start = out.unwrap_or(if minus { Self::ON } else { Self::OFF });
            out = Some(if minus {
                Self(start.0 & !bit)
            } else {
                Self(start.0 | bit)
            });
        }
        Ok(out.unwrap_or(Self::OFF))
    }

    fn bit(rule: Rule) -> u64 {
        1 << (rule as u32)
    }
}

impl Default for Rewrites {
    fn default() -> Self {
        Self::ON
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_stand_at_their_rules() {
        assert!(RULES.len() <= 64);
        for (k, record) in RULES.iter().enumerate() {
            assert_eq!(record.rule as usize, k);
            assert_eq!(record.rule.record().name, record.name);
            assert_eq!(RULES.iter().filter(|r| r.name == record.name).count(), 1);
        }
    }

    #[test]
    fn sets_are_read() {
        assert_eq!(Rewrites::parse("on"), Ok(Rewrites::ON));
        assert_eq!(Rewrites::parse("off"), Ok(Rewrites::OFF));
        let two = Rewrites::of(&[Rule::Hypot, Rule::Log1p]);
        assert_eq!(Rewrites::parse("hypot, log1p"), Ok(two));
        let rest = Rewrites::parse("-hypot").unwrap();
        assert!(!rest.has(Rule::Hypot) && rest.has(Rule::Log1p));
        assert_eq!(Rewrites::parse("hypot,nonsense"), Err("nonsense".into()));
        assert_eq!(Rewrites::ON.rules().count(), RULES.len());
    }
}
