//! Why a part of an integrand has no closed form.

use pullback_grammar::{Diagnostic, Span};

use super::Integrator;
use super::term::{Factor, Term};
use crate::ir::{Id, Op, Prim};

/// A part of an integrand that is not integrated in closed form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The part.
    pub node: Id,
    /// Where it stands in the text; empty where that is not known.
    pub span: Span,
    /// Why.
    pub reason: Reason,
}

/// Why there is no closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// There is no elementary one: the theorem or the function that is needed.
    NotElementary(&'static str),
    /// None was found.
    NotFound,
    /// A power whose exponent is no whole multiple of 1/2: a hypergeometric function.
    Hypergeometric,
    /// There are more of these than the bound.
    Bound(&'static str, usize),
    /// A condition whose zeros along a line are not those of a polynomial of degree 2.
    Condition,
    /// A loop that is not a sum of terms, whose number is constant along the line.
    Loop,
    /// The value jumps at every whole number of something that grows along the line.
    Rounding,
    /// The integral to infinity has no limit, and why.
    Diverges(&'static str),
    /// Several parts of a sum have no integral to infinity, each for itself.
    Together,
    /// A complex number on the way.
    Complex,
    /// The function is not one of up to three reals with a real value.
    NoField,
}

impl Reason {
    /// The reason as a sentence's end: "… has no closed form here: ".
    #[must_use]
    pub fn in_words(self) -> String {
        match self {
            Self::NotElementary(why) => format!("no elementary function has this derivative ({why})"),
            Self::NotFound => "none of the rules integrates it; whether it has one is not known".to_owned(),
            Self::Bound(what, bound) => format!("at most {bound} {what} are written out"),
            Self::Hypergeometric => {
                "powers of quadratics are integrated for exponents that are whole multiples of 1/2".to_owned()
            }
            Self::Condition => {
                "conditions are cut where polynomials of degree 1 or 2, or lengths, change their order".to_owned()
            }
            Self::Loop => "of the loops, sums of terms with a constant number of terms are integrated".to_owned(),
            Self::Rounding => "it jumps as often as the line is long".to_owned(),
            Self::NoField => "the integral along a ray is of a real function of x, y and z".to_owned(),
            Self::Diverges(why) => why.to_owned(),
            Self::Together => {
                "several of its terms have no integral to infinity; whether they cancel is not known".to_owned()
            }
            Self::Complex => "complex numbers on the way are not integrated".to_owned(),
        }
    }

    /// Whether it is proven that no elementary function is the integral.
    #[must_use]
    pub fn is_proven(self) -> bool {
        matches!(self, Self::NotElementary(_))
    }

    /// Whether an integral to infinity has no limit.
    #[must_use]
    pub fn diverges(self) -> bool {
        matches!(self, Self::Diverges(_))
    }
}

impl Problem {
    /// The problem as an error of an integral that stands at this place.
    #[must_use]
    pub fn diagnostic(&self, whole: Span) -> Diagnostic {
        let is_known = self.span != Span::default();
        let place = if is_known { self.span } else { whole };
        let (code, message) = match self.reason {
            Reason::NoField => ("wrong-demand", "this has no integral along a ray"),
            Reason::Bound(..) => ("too-large", "this integral is too large to be written out"),
            Reason::Diverges(_) => ("divergent-integral", "this integral has no limit"),
            reason if reason.is_proven() => (
                "no-closed-form",
                "this integral has no elementary closed form",
            ),
            _ => (
                "no-closed-form",
                "no closed form of this integral is known here",
            ),
        };
        let diagnostic = Diagnostic::error(code, place, message).with_label(self.reason.in_words());
        if place == whole {
            return diagnostic;
        }
        diagnostic.with_related(whole, "in this integral")
    }
}

impl Integrator<'_> {
    pub(super) fn problem(&self, node: Id, reason: Reason) -> Problem {
        Problem {
            node,
            span: self.g.span(node),
            reason,
        }
    }

    /// Why a factor has no rule. The part that is named is the innermost one that has none by itself.
    pub(super) fn why(&mut self, id: Id) -> Problem {
        let mut id = id;
        loop {
            let node = self.g.node(id).clone();
            let Op::Apply(prim) = node.op else {
                return self.problem(id, Reason::NotFound);
            };
            if node
                .args
                .iter()
                .any(|&a| self.g.ty(a) == crate::ir::Ty::Complex)
            {
                return self.problem(id, Reason::Complex);
            }
            if let Some(reason) = self.theorem(prim, &node.args) {
                return self.problem(id, reason);
            }
            let first = node.args.first().copied();
            let is_inside = |this: &mut Self, a: Id| {
                let op = this.g.node(a).op;
                this.degree(a).is_none() && matches!(op, Op::Apply(p) if is_rounding(p))
            };
            match first {
                Some(a) if is_inside(self, a) => id = a,
                _ => return self.problem(id, Reason::NotFound),
            }
        }
    }

    /// The known theorems that speak of one operation. Rosenlicht, "Integration in finite terms", American Mathematical
    /// Monthly 79 (1972), for e^p and its kin; Legendre for the roots.
    fn theorem(&mut self, prim: Prim, args: &[Id]) -> Option<Reason> {
        let first = *args.first()?;
        let degree = self.degree(first);
        let inner = self.inner_operation(first);
        let is_wave = |p: Option<Prim>| matches!(p, Some(Prim::Sin | Prim::Cos | Prim::Exp));
        Some(Reason::NotElementary(match prim {
            _ if is_rounding(prim) => return Some(Reason::Rounding),
            Prim::Exp if degree.is_some_and(|d| d > 2) => {
                "Liouville: e to a polynomial of degree 3 or more"
            }
            Prim::Sin | Prim::Cos if degree.is_some_and(|d| d > 1) => {
                "Liouville: the sine of a polynomial of degree 2 or more; of degree 2 it is Fresnel's integral"
            }
            Prim::Exp if is_wave(inner) => "Liouville: e to a sine or an exponential",
            Prim::Sin | Prim::Cos if is_wave(inner) => {
                "Liouville: the sine of a sine or an exponential"
            }
            Prim::Exp if matches!(inner, Some(Prim::Hypot | Prim::Hypot3)) => {
                "Liouville: e to the root of a quadratic; the line that meets its zero is an exception"
            }
            Prim::Sqrt if degree.is_some_and(|d| d == 3 || d == 4) => {
                "Legendre: an elliptic integral, unless the polynomial has a double root"
            }
            Prim::Sqrt if degree.is_some_and(|d| d > 4) => {
                "Abel: a hyperelliptic integral, unless the polynomial has a double root"
            }
            _ => return None,
        }))
    }

    /// The operation of an expression, seen through signs and factors that do not change along the path.
    fn inner_operation(&mut self, id: Id) -> Option<Prim> {
        let mut id = id;
        loop {
            let node = self.g.node(id).clone();
            let Op::Apply(prim) = node.op else {
                return None;
            };
            id = match (prim, node.args.as_slice()) {
                (Prim::Neg, &[a]) => a,
                (Prim::Mul, &[a, b]) if !self.moves(a) => b,
                (Prim::Mul | Prim::Div, &[a, b]) if !self.moves(b) => a,
                _ => return Some(prim),
            };
        }
    }

    /// Why a product of known factors has no rule. Of exponentials or waves beside one other factor R: ∫ e^g R is
    /// elementary exactly if R = w' + w g' for a rational w (Liouville), and so not where R has a simple pole, or is
    /// a power with one zero; beside a logarithm ∫ e^g log q leaves ∫ e^g q'/q.
    pub(super) fn why_product(&mut self, term: &Term) -> Problem {
        let is_exponential = |f: &&Factor| matches!(f, Factor::Exponential(_) | Factor::Wave(..));
        let exponentials = term.factors.iter().filter(is_exponential).count();
        let others = term.factors.iter().filter(|f| !is_exponential(f));
        let reason = match *others.collect::<Vec<_>>().as_slice() {
            [&other] if exponentials > 0 => self.beside_exponentials(other),
            _ => Reason::NotFound,
        };
        self.problem(term.source, reason)
    }

    fn beside_exponentials(&mut self, other: Factor) -> Reason {
        const INTEGRAL: &str = "Liouville: the exponential, sine or cosine integral";
        const GAMMA: &str = "Liouville: the incomplete gamma function";
        let (base, power) = match other {
            Factor::Power(base, n) => (base, self.g.as_real(n)),
            Factor::Log(base) => (base, None),
            _ => return Reason::NotFound,
        };
        match (self.degree(base), power, other) {
            (_, _, Factor::Log(_)) => Reason::NotElementary(INTEGRAL),
            (Some(1), Some(n), _) if n.fract() != 0.0 => Reason::NotElementary(GAMMA),
            (Some(1), Some(n), _) if n < 0.0 => Reason::NotElementary(INTEGRAL),
            (Some(2), Some(n), _) if n.fract() == 0.0 && (-2.0..=-1.0).contains(&n) => {
                Reason::NotElementary(INTEGRAL)
            }
            _ => Reason::NotFound,
        }
    }
}

fn is_rounding(prim: Prim) -> bool {
    matches!(
        prim,
        Prim::Floor | Prim::Ceil | Prim::Round | Prim::Trunc | Prim::Fract | Prim::Mod | Prim::Hash
    )
}
