//! Types and operations of the IR.

/// Type of a value in the IR.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Ty {
    /// A real number.
    Real,
    /// A complex number.
    Complex,
    /// A truth value.
    Bool,
    /// The final states of a loop together; only [`Op::Result`] takes it apart.
    Loop,
}

/// Names the leaves that stand for the changing values of a loop inside of its body. Loops that were derived from
/// one another share their binder, and so those leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Binder(pub(super) u32);

/// What a node computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A real constant, by the bits of its `f64` (so that `-0` and NaN are themselves).
    Const(u64),
    /// A truth value.
    Truth(bool),
    /// The k-th scalar input of the function that is being compiled.
    Input(u16),
    /// The k-th user parameter (a uniform).
    Param(u16),
    /// The animation clock in seconds.
    Time,
    /// The footprint of a pixel in world units.
    Pixel,
    /// A bound variable of the calculus; replaced before anything is evaluated or lowered.
    Variable(u32),
    /// A state of a loop before a step, inside of the loop's body.
    State(Binder, u16),
    /// The number of steps that a loop has done, as a real, inside of the loop's body.
    Counter(Binder),
    /// A loop. Operands: the number of steps as a real (rounded down; negative and NaN are none), the condition
    /// that ends it where there is one, tested before each step; then for each state its leaf, its value at the
    /// start, and its value after a step.
    Loop {
        /// Whose leaves its body uses.
        binder: Binder,
        /// No more steps than this are done.
        limit: u32,
        /// Whether the second operand is a condition that ends it.
        until: bool,
    },
    /// The final value of the state with this number of the loop that is the operand.
    Result(u16),
    /// A primitive of the operator table applied to the node's arguments.
    Apply(Prim),
}

/// Primitives: the operations that every evaluator implements. Each is one row of the operator table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(
    missing_docs,
    reason = "the operator table documents each under its name"
)]
pub enum Prim {
    Neg,
    Add,
    Sub,
    Mul,
    Div,
    /// Power with a constant integer exponent.
    PowInt(i32),
    Pow,
    /// A complex number from real and imaginary part.
    Complex,
    Re,
    Im,
    Conj,
    Abs,
    Arg,
    Sqrt,
    Cbrt,
    Hypot,
    /// Length of a vector of three reals without spurious overflow.
    Hypot3,
    Exp,
    Exp2,
    Expm1,
    Log,
    Log2,
    Log10,
    Log1p,
    Sin,
    Cos,
    Tan,
    Sec,
    Csc,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Sech,
    Csch,
    Asinh,
    Acosh,
    Atanh,
    Sinc,
    Sinhc,
    Exprel,
    /// ∫₀¹ s²ⁿ/(1 + z s²) ds: for n = 0 atan(√z)/√z.
    AtanQuotient(u8),
    /// atan2(√p, x)/√p
    Atan2Quotient,
    /// ∫₀¹ sⁿ/(1 + z s)ⁿ⁺¹ ds: for n = 0 log(1 + z)/z.
    Log1pRel(u8),
    /// Spherical Bessel function of this order.
    SphericalJ(u8),
    /// e^{-|x|} times the modified spherical Bessel function of this order.
    SphericalIScaled(u8),
    Erf,
    Erfc,
    /// e^{x²} iⁿerfc x: for n = 0 the scaled complementary error function.
    Erfcx(u8),
    /// e^{-x²}
    Gauss,
    /// e^{-(x + y)²}
    GaussOfSum,
    /// ∫ e^{-u²} du over an interval given by centre and half-width.
    GaussMass,
    /// The same, divided by the greatest value of the integrand in the interval.
    GaussMassScaled,
    /// ∫ (u - a)ᵏ e^{a² - u²} du over an interval to the right of 0 that begins at a, by its centre and half-width.
    GaussMassMoment(u8),
    /// e^{x y}
    ExpOfProduct,
    /// x² + p, rounded once.
    SquarePlus,
    /// a b + c, rounded once where the adapter's `fma` is.
    MulAdd,
    /// a + b - s: by how much s, which is about their sum, is rounded.
    SumRest,
    /// a b + c - s: by how much s, which is about that, is rounded.
    MulAddRest,
    /// a b - p: by how much p, which is about their product, is rounded.
    ProductRest,
    /// sin x - s: by how much s, which is about that, is rounded.
    SineRest,
    /// cos x - s: by how much s, which is about that, is rounded.
    CosineRest,
    /// -b/a, about where a s² + 2 b s + c is least; locally constant.
    Foot,
    Log1pExp,
    Gamma,
    Lgamma,
    Digamma,
    Trigamma,
    /// The n-th derivative of digamma, 2 ≤ n ≤ 5.
    Polygamma(u8),
    /// The n-th derivative of the Faddeeva function.
    Faddeeva(u8),
    /// Branch k of the Lambert W function, of (z, k).
    LambertW,
    /// The n-th derivative of the Riemann zeta function.
    Zeta(u8),
    /// The n-th derivative of the Dirichlet eta function.
    DirichletEta(u8),
    /// The n-th derivative of the Dirichlet beta function.
    DirichletBeta(u8),
    /// Principal branch of the logarithm of the gamma function.
    Loggamma,
    AiryAi,
    AiryAiPrime,
    AiryBi,
    AiryBiPrime,
    EllipticK,
    EllipticE,
    /// (K(m) - E(m))/m
    EllipticD(u8),
    Dilogarithm,
    /// The n-th derivative of the Eisenstein series of weight 2.
    EisensteinE2(u8),
    /// The same of weight 4.
    EisensteinE4(u8),
    /// The same of weight 6.
    EisensteinE6(u8),
    KleinJ,
    DedekindEta,
    ModularLambda,
    /// θ₂⁴ θ₄⁴/θ₃⁴ as a function of τ.
    ModularLambdaSlope(u8),
    /// The n-th derivative by z of the elliptic function of Weierstrass.
    WeierstrassP(u8),
    /// Bessel function J, of (order, z).
    BesselJ,
    /// Bessel function Y, of (order, x); the same of I and K.
    BesselY,
    BesselI,
    BesselK,
    ExpintE1,
    ExpintEi,
    Sinint,
    Cosint,
    Logint,
    FresnelS,
    FresnelC,
    EulerBeta,
    /// ψ(a + b) - ψ(a)
    DigammaRise,
    /// Chebyshev polynomial of the first kind, of (degree, x).
    ChebyshevT,
    /// Gegenbauer polynomial, of (degree, parameter, x), or its derivative by the parameter.
    GegenbauerC(u8),
    /// Hermite polynomial of the physicists, of (degree, x).
    HermiteH,
    /// Generalized Laguerre polynomial, of (degree, parameter, x), or its derivative by the parameter.
    LaguerreL(u8),
    /// The same of the lattice with invariants g₂, g₃.
    WeierstrassPInvariants(u8),
    /// The n-th derivative by z of the theta functions of Jacobi, of z and the nome.
    JacobiTheta1(u8),
    JacobiTheta2(u8),
    JacobiTheta3(u8),
    JacobiTheta4(u8),
    /// Elliptic functions of Jacobi of u and the parameter m, or their derivatives by m.
    JacobiSn(u8),
    JacobiCn(u8),
    JacobiDn(u8),
    /// The n-th derivative by s of the zeta function of Hurwitz, of s and a.
    HurwitzZeta(u8),
    /// Gauss's hypergeometric function of a, b, c and z: itself, its derivative by a, that by c.
    Hypergeometric(u8),
    /// `a^(b + c)` for a whole constant c, b + c not rounded.
    PowShift,
    AtanSlope,
    AtanhSlope,
    AsinSlope,
    AsinhSlope,
    AcoshSlope,
    Direction,
    Direction3,
    Floor,
    Ceil,
    Round,
    Trunc,
    Fract,
    Mod,
    Sign,
    Min,
    Max,
    /// A number in [0, 1) from a point of the lattice of integers.
    Hash,
    Less,
    LessEqual,
    Equal,
    NotEqual,
    And,
    Or,
    Not,
    /// `select(c, a, b)`: a where c holds, else b.
    Select,
}

impl Prim {
    /// Which member of its family it is; `None` of what is no family, and of integer powers.
    #[must_use]
    pub fn order(self) -> Option<u8> {
        match self {
            Self::Polygamma(n)
            | Self::AtanQuotient(n)
            | Self::Log1pRel(n)
            | Self::SphericalJ(n)
            | Self::SphericalIScaled(n)
            | Self::Erfcx(n)
            | Self::GaussMassMoment(n)
            | Self::Faddeeva(n)
            | Self::Zeta(n)
            | Self::DirichletEta(n)
            | Self::DirichletBeta(n)
            | Self::EisensteinE2(n)
            | Self::EisensteinE4(n)
            | Self::EisensteinE6(n)
            | Self::EllipticD(n)
            | Self::ModularLambdaSlope(n)
            | Self::WeierstrassP(n)
            | Self::WeierstrassPInvariants(n)
            | Self::JacobiTheta1(n)
            | Self::JacobiTheta2(n)
            | Self::JacobiTheta3(n)
            | Self::JacobiTheta4(n)
            | Self::HurwitzZeta(n)
            | Self::JacobiSn(n)
            | Self::JacobiCn(n)
            | Self::JacobiDn(n)
            | Self::GegenbauerC(n)
            | Self::LaguerreL(n)
            | Self::Hypergeometric(n) => Some(n),
            _ => None,
        }
    }

    /// The member of the family with this number; itself where it is no family.
    #[must_use]
    pub fn with_order(self, n: u8) -> Self {
        match self {
            Self::Polygamma(_) => Self::Polygamma(n),
            Self::AtanQuotient(_) => Self::AtanQuotient(n),
            Self::Log1pRel(_) => Self::Log1pRel(n),
            Self::SphericalJ(_) => Self::SphericalJ(n),
            Self::SphericalIScaled(_) => Self::SphericalIScaled(n),
            Self::Erfcx(_) => Self::Erfcx(n),
            Self::GaussMassMoment(_) => Self::GaussMassMoment(n),
            Self::Faddeeva(_) => Self::Faddeeva(n),
            Self::Zeta(_) => Self::Zeta(n),
            Self::DirichletEta(_) => Self::DirichletEta(n),
            Self::DirichletBeta(_) => Self::DirichletBeta(n),
            Self::EisensteinE2(_) => Self::EisensteinE2(n),
            Self::EisensteinE4(_) => Self::EisensteinE4(n),
            Self::EisensteinE6(_) => Self::EisensteinE6(n),
            Self::EllipticD(_) => Self::EllipticD(n),
            Self::ModularLambdaSlope(_) => Self::ModularLambdaSlope(n),
            Self::WeierstrassP(_) => Self::WeierstrassP(n),
            Self::WeierstrassPInvariants(_) => Self::WeierstrassPInvariants(n),
            Self::JacobiTheta1(_) => Self::JacobiTheta1(n),
            Self::JacobiTheta2(_) => Self::JacobiTheta2(n),
            Self::JacobiTheta3(_) => Self::JacobiTheta3(n),
            Self::JacobiTheta4(_) => Self::JacobiTheta4(n),
            Self::HurwitzZeta(_) => Self::HurwitzZeta(n),
            Self::JacobiSn(_) => Self::JacobiSn(n),
            Self::JacobiCn(_) => Self::JacobiCn(n),
            Self::JacobiDn(_) => Self::JacobiDn(n),
            Self::GegenbauerC(_) => Self::GegenbauerC(n),
            Self::LaguerreL(_) => Self::LaguerreL(n),
            Self::Hypergeometric(_) => Self::Hypergeometric(n),
            other => other,
        }
    }
}
