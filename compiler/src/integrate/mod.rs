//! Definite integrals of expressions along a line, as IR.
//!
//! ∫ₐᵇ f(o + t d) dt is taken as a definite integral: the line is centred at the middle of the interval, so that the
//! result vanishes with its length and nothing is the difference of two antiderivatives where that cancels. The
//! integrand becomes a sum of products; each product is integrated by the rule of its class ([`Rule`]). What is
//! piecewise is cut where its conditions change. Nothing divides by a component of the direction.

mod addends;
mod affine;
mod algebraic;
mod arithmetic;
mod bessel;
mod boundary;
mod bowl;
mod breaks;
mod changes;
mod class;
mod complementary;
mod density;
mod disc;
mod equiangular;
mod expand;
mod explain;
mod exponential;
mod faddeeva;
mod field;
mod gaussian;
mod gaussian_waves;
mod group;
mod growing;
mod height;
mod infinite;
mod legendre;
mod local;
mod normal;
mod pair;
mod paired;
mod path;
mod problem;
mod products;
mod prove;
mod quadratic;
mod quadrature;
mod rational;
mod ridge;
mod rule;
mod series;
mod symbolic;
mod tails;
mod term;
mod waves;

pub use algebraic::MAX_DEGREE_BESIDE_POWER;
pub use breaks::MAX_BREAKS;
pub use class::MAX_DEGREE;
pub use density::{Density, Values};
pub use expand::{MAX_FACTORS, MAX_TERMS};
pub use explain::{Explanation, Rest, SAMPLE, Told, explain};
pub use exponential::MAX_DEGREE_BESIDE;
pub(crate) use field::of_integrals;
pub use field::{FieldIntegral, INPUTS, SHIFTED_INPUTS, field_integral, shifted_field_integral};
pub use gaussian::MAX_DEGREE_BESIDE_GAUSSIAN;
pub use infinite::improper;
pub use legendre::{Node as QuadratureNode, gauss_legendre};
pub use path::{Coordinate, Path};
pub use problem::{Problem, Reason};
pub use prove::{PROOF_TOLERANCE, Proof, prove};
pub use quadrature::{BOUNDED_NODES, MAX_PANELS, NODES, Numerical, PANELS, TOLERANCE};
pub use rule::{RULES, Record, Rule};
pub use waves::MAX_WAVES;

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use arithmetic::{add, mul, scale};
use class::Classes;
use exponential::Parts;
use group::Groups;
use path::{Body, without_rests};
use term::{Factor, Term};

use crate::derive::forward;
use crate::ir::{Graph, Id, Prim};

/// Greatest number of nodes that an integral may add to a graph.
pub const MAX_NODES: usize = 200_000;

/// What is done where there is no closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Otherwise {
    /// The first such part is an error.
    Refuse,
    /// It is integrated numerically.
    Quadrature,
}

/// One product of the integrand and the rule that integrated it.
#[derive(Clone, Debug)]
pub struct Part {
    /// The product.
    pub integrand: Id,
    /// The conditions under which it counts, each with whether it holds.
    pub guards: SmallVec<[(Id, bool); 2]>,
    /// The rule.
    pub rule: Rule,
}

/// A definite integral.
#[derive(Clone, Debug)]
pub struct Integral {
    /// Its value.
    pub value: Id,
    /// The products of the integrand, each with its rule.
    pub parts: Vec<Part>,
    /// Whether the interval is cut into pieces where conditions change.
    pub pieces: bool,
    /// The parts that were integrated numerically, and why.
    pub numerical: Vec<Problem>,
    /// How they were.
    pub rest: Vec<Numerical>,
}

/// ∫ of a real expression along a path.
///
/// # Errors
/// A part has no closed form and none but closed forms are wanted, or a bound is exceeded.
pub fn integrate(
    g: &mut Graph,
    root: Id,
    path: &Path,
    otherwise: Otherwise,
) -> Result<Integral, Problem> {
    let root = without_rests(g, root);
    let mut integrator = Integrator::new(g, path.clone(), otherwise);
    let value = integrator.whole(root)?;
    Ok(Integral {
        value,
        parts: integrator.parts,
        pieces: integrator.pieces,
        numerical: integrator.numerical,
        rest: integrator.rest,
    })
}

/// ∫ of a real expression along a path by quadrature alone, cut where conditions change.
///
/// # Errors
/// A bound is exceeded.
pub fn quadrature(g: &mut Graph, root: Id, path: &Path) -> Result<Id, Problem> {
    let root = without_rests(g, root);
    Integrator::new(g, path.clone(), Otherwise::Quadrature).by_quadrature_alone(root)
}

/// Builds one integral.
struct Integrator<'g> {
    g: &'g mut Graph,
    path: Path,
    classes: Classes,
    otherwise: Otherwise,
    parts: Vec<Part>,
    numerical: Vec<Problem>,
    rest: Vec<Numerical>,
    pieces: bool,
    /// Whether conditions are decided at infinity.
    beyond: bool,
    /// The conditions as they were written, of those that were decided.
    written: FxHashMap<Id, Id>,
    /// Whether known numbers that single precision does not hold are pairs: where a logarithm is near 0 that counts.
    splits_constants: bool,
    /// Number of nodes of the graph beyond which the integral is refused.
    limit: usize,
}

impl<'g> Integrator<'g> {
    fn new(g: &'g mut Graph, path: Path, otherwise: Otherwise) -> Self {
        let classes = Classes::new(path.coordinates.iter().map(|c| c.leaf));
        let limit = g.nodes().len() + MAX_NODES;
        Self {
            g,
            path,
            classes,
            otherwise,
            parts: Vec::new(),
            numerical: Vec::new(),
            rest: Vec::new(),
            pieces: false,
            beyond: false,
            written: FxHashMap::default(),
            splits_constants: false,
            limit,
        }
    }

    /// The integral of the whole integrand; addends with conditions of their own each for itself.
    fn whole(&mut self, root: Id) -> Result<Id, Problem> {
        let mut sum = self.g.real(0.0);
        for group in self.addends(root) {
            let value = self.in_pieces(group)?;
            sum = add(self.g, sum, value);
        }
        Ok(sum)
    }

    /// The integral of an integrand, in pieces where it has conditions.
    fn in_pieces(&mut self, root: Id) -> Result<Id, Problem> {
        match self.cuts(root) {
            Ok(cuts) if cuts.is_empty() => self.smooth(root),
            Ok(_) => {
                self.pieces = true;
                match self.ridge(root) {
                    Some(value) => Ok(value),
                    None => self.in_rebased_pieces(root),
                }
            }
            Err(problem) if self.otherwise == Otherwise::Quadrature => {
                let value = self.numerically(root);
                self.numerical.push(problem);
                Ok(value)
            }
            Err(problem) => Err(problem),
        }
    }

    /// The pieces with t counted from the middle where the interval is far away: places where conditions change would be
    /// rounded to their distance from t = 0.
    fn in_rebased_pieces(&mut self, root: Id) -> Result<Id, Problem> {
        let whole = self.path.clone();
        self.path = whole.rebased(self.g);
        let cuts = self.cuts_with_lows(root);
        let value = cuts.and_then(|cuts| self.piecewise(root, &cuts, Self::smooth));
        self.path = whole;
        value
    }

    /// The integral of an integrand whose conditions are constant along the path.
    fn smooth(&mut self, root: Id) -> Result<Id, Problem> {
        if let Some(degree) = self.degree(root) {
            return Ok(self.polynomial(root, degree));
        }
        let terms = self.expand(root)?;
        let known = self.numerical.len();
        let mut sum = self.g.real(0.0);
        let mut rest = self.g.real(0.0);
        let mut groups = Groups::default();
        for term in terms {
            let found = match self.term(&term) {
                Ok(value) => Ok(vec![(term.clone(), value)]),
                Err(problem) => self.by_fractions(&term).ok_or(problem),
            };
            match found {
                Ok(values) => {
                    for (part, value) in values {
                        let value = self.guarded(&part, value);
                        match part.product {
                            Some(product) => groups.push(product, part, value),
                            None => sum = add(self.g, sum, value),
                        }
                    }
                }
                Err(problem) if self.otherwise == Otherwise::Refuse => return Err(problem),
                Err(problem) => {
                    let integrand = term.integrand(self.g);
                    let integrand = self.guarded(&term, integrand);
                    rest = add(self.g, rest, integrand);
                    self.numerical.push(problem);
                }
            }
            if self.g.nodes().len() > self.limit {
                return Err(self.problem(term.source, Reason::Bound("operations", MAX_NODES)));
            }
        }
        // a product of which a part has no closed form is not taken as it is
        let all_closed = self.numerical.len() == known;
        let grouped = self.sum_of_groups(groups, all_closed);
        sum = add(self.g, sum, grouped);
        if self.moves(rest) {
            let value = self.numerically(rest);
            sum = add(self.g, sum, value);
        }
        Ok(sum)
    }

    fn guarded(&mut self, term: &Term, mut value: Id) -> Id {
        let zero = self.g.real(0.0);
        for &(condition, holds) in &term.guards {
            let (then, otherwise) = if holds { (value, zero) } else { (zero, value) };
            value = self.g.apply(Prim::Select, &[condition, then, otherwise]);
        }
        value
    }

    /// c L, and Gauss-Legendre with ⌈(n + 1)/2⌉ nodes of the polynomial as it is written.
    fn polynomial(&mut self, root: Id, degree: u32) -> Id {
        let rule = if degree == 0 {
            Rule::Constant
        } else {
            Rule::Polynomial
        };
        self.note(root, &[], rule);
        self.local_gauss(root, degree as usize / 2 + 1)
    }

    /// Remembers how a product was integrated, conditions as they were written.
    fn note(&mut self, integrand: Id, guards: &[(Id, bool)], rule: Rule) {
        let values: Vec<(Id, Id)> = self.written.iter().map(|(&d, &w)| (d, w)).collect();
        let roots: Vec<Id> = std::iter::once(integrand)
            .chain(guards.iter().map(|c| c.0))
            .collect();
        let body = Body::new(self.g, &roots, values.iter().map(|v| v.0));
        let shown = body.at(self.g, &values);
        let holds = guards.iter().map(|c| c.1);
        self.parts.push(Part {
            integrand: shown[0],
            guards: shown[1..].iter().copied().zip(holds).collect(),
            rule,
        });
    }

    /// The integral of one product.
    fn term(&mut self, term: &Term) -> Result<Id, Problem> {
        let (value, rule) = self.by_class(term)?;
        let integrand = term.integrand(self.g);
        self.note(integrand, &term.guards, rule);
        Ok(mul(self.g, term.coefficient, value))
    }

    /// The integral of the factors of a product without its coefficient.
    fn by_class(&mut self, term: &Term) -> Result<(Id, Rule), Problem> {
        let is = |f: fn(&Factor) -> bool| term.factors.iter().all(f);
        if term.factors.is_empty() {
            return Ok((self.length_of_path(), Rule::Constant));
        }
        if let Some(problem) = self.without_rule(term) {
            return Err(problem);
        }
        if is(|f| matches!(f, Factor::Polynomial(_))) {
            let moving = term.moving(self.g);
            let Some(degree) = self.degree(moving) else {
                return Err(
                    self.problem(term.source, Reason::Bound("degrees", MAX_DEGREE as usize))
                );
            };
            return Ok((
                self.local_gauss(moving, degree as usize / 2 + 1),
                Rule::Polynomial,
            ));
        }
        if let [Factor::Series(id)] = *term.factors.as_slice() {
            return self.series(id);
        }
        self.classes.extend(self.g);
        let is_exponential = |f: &Factor| match f {
            Factor::Polynomial(_) | Factor::Wave(..) => true,
            Factor::Exponential(e) => self.classes.known_degree(*e) == Some(1),
            _ => false,
        };
        if term.factors.iter().all(is_exponential) {
            return self.exponential(term);
        }
        self.algebraic_or_gaussian(term)
    }

    fn algebraic_or_gaussian(&mut self, term: &Term) -> Result<(Id, Rule), Problem> {
        let parts = Parts::of(term);
        if parts.rest.is_empty() {
            return self.gaussian(term);
        }
        if parts.exponent.is_none() && parts.waves.is_empty() {
            match *parts.rest.as_slice() {
                [Factor::Power(base, exponent)] => {
                    let is_affine = self.degree(base) == Some(1);
                    let rule = if is_affine {
                        Self::affine_power
                    } else {
                        Self::quadratic_power
                    };
                    return rule(self, term.source, &parts.polynomials, base, exponent);
                }
                [Factor::Log(base)] => {
                    let is_affine = self.degree(base) == Some(1);
                    let rule = if is_affine {
                        Self::affine_log
                    } else {
                        Self::quadratic_log
                    };
                    return rule(self, term.source, &parts.polynomials, base);
                }
                _ => {}
            }
            if parts.polynomials.is_empty()
                && let Some((base, exponent)) = self.power_by_log(&parts.rest)
            {
                let value = self.affine_power_by_log(base, exponent);
                return Ok((value, Rule::AffineLog));
            }
            if parts.polynomials.is_empty()
                && let Some(pair) = products::pair_of_powers(&parts.rest)
            {
                return self.product_of_powers(term, pair);
            }
            if parts.polynomials.is_empty()
                && let Some(found) = self.function(&parts.rest)
            {
                return Ok(found);
            }
        }
        Err(self.why_product(term))
    }

    /// Why a product with this factor has no rule whatever else it is made of.
    fn without_rule(&mut self, term: &Term) -> Option<Problem> {
        let other = term.factors.iter().find_map(|f| match f {
            Factor::Other(id) => Some(*id),
            _ => None,
        })?;
        Some(self.why(other))
    }

    fn degree(&mut self, id: Id) -> Option<u32> {
        self.classes.degree(self.g, id)
    }

    fn moves(&mut self, id: Id) -> bool {
        self.classes.moves(self.g, id)
    }

    fn extend_classes(&mut self) {
        self.classes.extend(self.g);
    }

    /// 2h
    fn length_of_path(&mut self) -> Id {
        scale(self.g, 2.0, self.path.half)
    }

    /// An expression in the middle of the path.
    fn at_middle(&mut self, id: Id) -> Id {
        if !self.moves(id) {
            return id;
        }
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let values = self.path.middle();
        Body::new(self.g, &[id], leaves).at(self.g, &values)[0]
    }

    /// An expression at both ends of the path.
    fn at_ends(&mut self, id: Id) -> [Id; 2] {
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let body = Body::new(self.g, &[id], leaves);
        [0, 1].map(|which| {
            let values = self.path.end(self.g, which);
            body.at(self.g, &values)[0]
        })
    }

    /// Expressions at t, by way of the origin.
    fn at_place(&mut self, roots: &[Id], t: Id) -> SmallVec<[Id; 4]> {
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let body = Body::new(self.g, roots, leaves);
        let whole = self.path.clone();
        let seen = whole.from_origin(self.g);
        let values = seen.point(self.g, t);
        body.at(self.g, &values)
    }

    /// The derivative by s. What has none has no such factor.
    fn slope(&mut self, id: Id) -> Id {
        let seeds = self.path.seeds();
        let slope = forward(self.g, &[id], &seeds).ok().and_then(|t| t[0]);
        slope.unwrap_or_else(|| self.g.real(0.0))
    }

    /// ∫ by Gauss-Legendre nodes of the expression itself: Σ h wⱼ f(h xⱼ).
    fn gauss(&mut self, root: Id, count: usize) -> Id {
        if !self.moves(root) {
            let length = self.length_of_path();
            return mul(self.g, length, root);
        }
        let sum = self.weighted_sum(root, count);
        mul(self.g, self.path.half, sum)
    }

    /// The mean along the path by Gauss-Legendre nodes of the expression itself: Σ wⱼ f(h xⱼ)/2.
    fn mean(&mut self, root: Id, count: usize) -> Id {
        if !self.moves(root) {
            return root;
        }
        let sum = self.weighted_sum(root, count);
        scale(self.g, 0.5, sum)
    }

    /// Σ wⱼ f(h xⱼ), the weights of which are 2 together.
    fn weighted_sum(&mut self, root: Id, count: usize) -> Id {
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let body = Body::new(self.g, &[root], leaves);
        let mut sum = self.g.real(0.0);
        for node in gauss_legendre(count) {
            let s = scale(self.g, node.place, self.path.half);
            let values = if node.place == 0.0 {
                self.path.middle()
            } else {
                self.path.point(self.g, s)
            };
            let mut value = body.at(self.g, &values)[0];
            if node.place != 0.0 {
                let back = self.g.neg(s);
                let values = self.path.point(self.g, back);
                let other = body.at(self.g, &values)[0];
                value = self.g.add(value, other);
            }
            let part = scale(self.g, node.weight, value);
            sum = add(self.g, sum, part);
        }
        sum
    }
}
