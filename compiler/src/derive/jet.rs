//! The first-order jet of a function of one complex variable.

use rustc_hash::FxHashMap;

use super::NoDerivative;
use super::activity::{activity, conjugate_activity};
use super::extend::{extend, states};
use super::rules::{
    int_power_partial, inverse_tangent, is_zero, quotient_correction, sum, takes_second,
};
use crate::ir::{Graph, Id, Node, Op, Prim, State, Ty};
use crate::table::{self, Derivative};

/// Value and Wirtinger derivatives of f at z.
#[derive(Clone, Copy, Debug)]
pub struct Jet {
    /// f(z), complex.
    pub value: Id,
    /// ∂f/∂z, which is f′(z) where f is holomorphic; complex.
    pub dz: Id,
    /// ∂f/∂z̄, or `None` where f is holomorphic as an expression.
    pub dzbar: Option<Id>,
}

/// The variable of a complex function.
#[derive(Clone, Copy, Debug)]
pub enum ComplexVariable {
    /// One complex leaf.
    Whole(Id),
    /// Two real leaves, the real and the imaginary part.
    Parts(Id, Id),
}

/// Derivatives of one node by z and by z̄; `None` is an exact zero. A real node keeps the first only: its second is
/// the conjugate.
#[derive(Clone, Copy, Debug, Default)]
struct Tangent {
    dz: Option<Id>,
    dzbar: Option<Id>,
}

/// The jet of `root` by a complex variable, in one pass: each node carries ∂/∂z and, below what is not holomorphic,
/// ∂/∂z̄. The derivative of a choice is that of the branch.
///
/// Wirtinger 1927; Ahlfors, Complex Analysis, 3rd edition, section 2.1.2. Chain rule for the pair: Kreutz-Delgado,
/// The Complex Gradient Operator and the CR-Calculus, arXiv:0906.4835, section 4.2.
///
/// # Errors
/// An operation that depends on z has no derivative rule.
pub fn jet(g: &mut Graph, root: Id, z: ComplexVariable) -> Result<Jet, NoDerivative> {
    let tangent = tangent_of(g, root, z)?;
    let zero = g.real(0.0);
    let dz = tangent.dz.unwrap_or(zero);
    let dzbar = bar(g, root, tangent);
    let value = g.widen(root);
    Ok(Jet {
        value,
        dz: g.widen(dz),
        dzbar: dzbar.map(|d| g.widen(d)),
    })
}

/// ∂f/∂z of a real function of z = x + i y, which holds both partial derivatives: (∂f/∂x - i ∂f/∂y)/2. `None` is an
/// exact zero.
///
/// # Errors
/// As [`jet`].
pub fn wirtinger(g: &mut Graph, root: Id, x: Id, y: Id) -> Result<Option<Id>, NoDerivative> {
    Ok(tangent_of(g, root, ComplexVariable::Parts(x, y))?.dz)
}

/// After so many rounds every state that may depend on z̄ is taken to.
const MAX_ROUNDS: usize = 8;

/// The derivatives of the root. Which states of loops depend on z̄ is found by trying: at first none is taken to, and as
/// long as some turn out to, once more with these.
fn tangent_of(g: &mut Graph, root: Id, z: ComplexVariable) -> Result<Tangent, NoDerivative> {
    let live = g.reachable(&[root]);
    let seeds = seeds(g, z);
    let mut states_of_loops = Vec::new();
    let mut general = vec![false; live.len()];
    let mut all_general = Vec::new();
    if g.has_loops() {
        let leaves: Vec<Id> = seeds.iter().map(|seed| seed.0).collect();
        let active = activity(g, &live, &leaves);
        states_of_loops = states(g, &live, &active);
        all_general = conjugate_activity(g, &live, &active);
    }
    for _ in 0..MAX_ROUNDS {
        let mut attempt = Attempt {
            live: &live,
            tangents: seeded(g, &live, &seeds, &states_of_loops, &general),
            extended: FxHashMap::default(),
            further: Vec::new(),
        };
        attempt.run(g)?;
        if attempt.further.is_empty() {
            return Ok(attempt.tangents[root.index()]);
        }
        for leaf in attempt.further {
            general[leaf.index()] = true;
        }
    }
    let mut attempt = Attempt {
        live: &live,
        tangents: seeded(g, &live, &seeds, &states_of_loops, &all_general),
        extended: FxHashMap::default(),
        further: Vec::new(),
    };
    attempt.run(g)?;
    Ok(attempt.tangents[root.index()])
}

/// The tangents to begin with: of the leaves, and of the states of loops that depend on z.
fn seeded(
    g: &mut Graph,
    live: &[bool],
    seeds: &[(Id, Id)],
    states: &[Id],
    general: &[bool],
) -> Vec<Tangent> {
    let mut tangents = vec![Tangent::default(); live.len()];
    for &leaf in states {
        let dz = Some(g.tangent_state(leaf, seeds, DZ, Ty::Complex));
        let is_general = general[leaf.index()];
        let dzbar = is_general.then(|| g.tangent_state(leaf, seeds, DZBAR, Ty::Complex));
        tangents[leaf.index()] = Tangent { dz, dzbar };
    }
    for &(leaf, dz) in seeds {
        tangents[leaf.index()].dz = Some(dz);
    }
    tangents
}

/// One pass over the graph.
struct Attempt<'a> {
    live: &'a [bool],
    tangents: Vec<Tangent>,
    /// Each loop with the derivatives of its states.
    extended: FxHashMap<Id, Id>,
    /// States that were taken not to depend on z̄, and do.
    further: Vec<Id>,
}

impl Attempt<'_> {
    fn run(&mut self, g: &mut Graph) -> Result<(), NoDerivative> {
        let ids: Vec<Id> = g.ids().take(self.live.len()).collect();
        for id in ids {
            if !self.live[id.index()] {
                continue;
            }
            let node = g.node(id).clone();
            let prim = match node.op {
                Op::Apply(prim) => prim,
                Op::Loop { .. } => {
                    self.find_further(g, id);
                    extend_loop(g, id, self.live, &self.tangents, &mut self.extended);
                    continue;
                }
                Op::Result(_) => {
                    self.tangents[id.index()] = of_result(g, id, &self.tangents, &self.extended);
                    continue;
                }
                _ => continue,
            };
            let tangents = &self.tangents;
            let depends =
                |a: &Id| tangents[a.index()].dz.is_some() || tangents[a.index()].dzbar.is_some();
            if node.ty != Ty::Bool && node.args.iter().any(depends) {
                self.tangents[id.index()] = Rule {
                    g,
                    node: &node,
                    value: id,
                    tangents,
                }
                .tangent(prim)?;
            }
        }
        Ok(())
    }

    fn find_further(&mut self, g: &Graph, id: Id) {
        let Some(it) = g.as_loop(id) else { return };
        for state in &it.states {
            let bar = |of: Id| self.tangents[of.index()].dzbar.is_some();
            let is_complex = g.ty(state.leaf) == Ty::Complex;
            if self.live[state.leaf.index()]
                && is_complex
                && !bar(state.leaf)
                && (bar(state.init) || bar(state.next))
            {
                self.further.push(state.leaf);
            }
        }
    }
}

/// Which tangent of a state a further state is.
const DZ: u8 = 1;
const DZBAR: u8 = 2;

/// A loop with the derivatives of its states by z, and by z̄ where they have one.
fn extend_loop(
    g: &mut Graph,
    id: Id,
    live: &[bool],
    tangents: &[Tangent],
    extended: &mut FxHashMap<Id, Id>,
) {
    let once = extend(g, id, live, |of| tangents.get(of.index())?.dz);
    let Some(once) = once else { return };
    let twice = extend(g, id, live, |of| tangents.get(of.index())?.dzbar);
    let Some(twice) = twice.and_then(|twice| g.as_loop(twice)) else {
        extended.insert(id, once);
        return;
    };
    if let Some(mut both) = g.as_loop(once) {
        let further = twice.states.iter();
        let further: Vec<State> = further
            .filter(|s| !both.states.contains(s))
            .copied()
            .collect();
        both.states.extend(further);
        let both = g.repeat(&both);
        extended.insert(id, both);
    }
}

fn of_result(g: &mut Graph, id: Id, tangents: &[Tangent], extended: &FxHashMap<Id, Id>) -> Tangent {
    let repeated = g.node(id).args[0];
    let (Some(&longer), Some(leaf)) = (extended.get(&repeated), g.leaf_of_result(id)) else {
        return Tangent::default();
    };
    let Tangent { dz, dzbar } = tangents[leaf.index()];
    Tangent {
        dz: dz.map(|leaf| g.result(longer, leaf)),
        dzbar: dzbar.map(|leaf| g.result(longer, leaf)),
    }
}

/// ∂/∂z of the leaves: of z itself 1, of its parts x = (z + z̄)/2 and y = (z - z̄)/(2i).
fn seeds(g: &mut Graph, z: ComplexVariable) -> Vec<(Id, Id)> {
    match z {
        ComplexVariable::Whole(z) => vec![(z, g.real(1.0))],
        ComplexVariable::Parts(x, y) => vec![(x, g.real(0.5)), (y, g.complex(0.0, -0.5))],
    }
}

/// ∂/∂z̄ of a node.
fn bar(g: &mut Graph, id: Id, tangent: Tangent) -> Option<Id> {
    if g.ty(id) == Ty::Real {
        tangent.dz.map(|d| g.apply(Prim::Conj, &[d]))
    } else {
        tangent.dzbar
    }
}

/// One application of the chain rule.
struct Rule<'a> {
    g: &'a mut Graph,
    node: &'a Node,
    value: Id,
    tangents: &'a [Tangent],
}

impl Rule<'_> {
    fn dz(&self, k: usize) -> Option<Id> {
        self.tangents[self.node.args[k].index()].dz
    }

    fn dzbar(&mut self, k: usize) -> Option<Id> {
        let arg = self.node.args[k];
        bar(self.g, arg, self.tangents[arg.index()])
    }

    fn tangent(&mut self, prim: Prim) -> Result<Tangent, NoDerivative> {
        let missing = |(k, arg): (usize, &Id)| {
            let of = self.tangents[arg.index()];
            table::is_missing(prim, k) && (of.dz.is_some() || of.dzbar.is_some())
        };
        if self.node.args.iter().enumerate().any(missing) {
            return Err(NoDerivative { prim });
        }
        let tangent = match table::derivative(prim) {
            Derivative::Zero => Tangent::default(),
            Derivative::Missing => return Err(NoDerivative { prim }),
            Derivative::Partial(partial) => self.each(|rule, tangents| {
                let mut total = None;
                for (k, tangent) in tangents.iter().enumerate() {
                    let Some(tangent) = *tangent else { continue };
                    let slope = partial(rule.g, &rule.node.args, rule.value, k);
                    if is_zero(rule.g, slope) {
                        continue;
                    }
                    let term = rule.g.mul(slope, tangent);
                    total = sum(rule.g, total, Some(term));
                }
                total
            }),
            Derivative::Structural => self.structural(prim),
        };
        let g = &*self.g;
        let nonzero = |t: &Id| !is_zero(g, *t);
        Ok(Tangent {
            dz: tangent.dz.filter(nonzero),
            dzbar: tangent.dzbar.filter(nonzero),
        })
    }

    /// Applies a rule that is linear in the tangents to both derivatives.
    fn each(&mut self, rule: impl Fn(&mut Self, &[Option<Id>]) -> Option<Id>) -> Tangent {
        let count = self.node.args.len();
        let dz: Vec<_> = (0..count).map(|k| self.dz(k)).collect();
        let dz = rule(self, &dz);
        if self.node.ty == Ty::Real {
            return Tangent { dz, dzbar: None };
        }
        let dzbar: Vec<_> = (0..count).map(|k| self.dzbar(k)).collect();
        let dzbar = if dzbar.iter().all(Option::is_none) {
            None
        } else {
            rule(self, &dzbar)
        };
        Tangent { dz, dzbar }
    }

    fn structural(&mut self, prim: Prim) -> Tangent {
        let args = self.node.args.clone();
        match (prim, args.as_slice()) {
            (Prim::Neg, _) => self.each(|r, t| t[0].map(|t| r.g.neg(t))),
            (Prim::Add, _) => self.each(|r, t| sum(r.g, t[0], t[1])),
            (Prim::Sub, _) => self.each(|r, t| difference(r.g, t[0], t[1])),
            (Prim::Mul, &[a, b]) => self.each(|r, t| {
                let left = t[0].map(|t| r.g.mul(t, b));
                let right = t[1].map(|t| r.g.mul(a, t));
                sum(r.g, left, right)
            }),
            (Prim::Div, &[a, b]) => self.each(|r, t| r.quotient(a, b, t[0], t[1])),
            (Prim::PowInt(n), &[x]) => self.each(|r, t| {
                let slope = int_power_partial(r.g, x, n);
                t[0].map(|t| r.g.mul(slope, t))
            }),
            (Prim::Complex, _) => self.parts_joined(),
            (Prim::Conj, _) => {
                let (dz, dzbar) = (self.dz(0), self.dzbar(0));
                Tangent {
                    dz: conj(self.g, dzbar),
                    dzbar: conj(self.g, dz),
                }
            }
            (Prim::Re | Prim::Im | Prim::Abs | Prim::Arg, &[x]) => Tangent {
                dz: self.real_part_of(prim, x),
                dzbar: None,
            },
            (Prim::Min | Prim::Max, &[a, b]) => {
                let second = takes_second(self.g, prim, a, b);
                self.each(|r, t| r.choice(second, t[1], t[0]))
            }
            (Prim::Select, &[condition, ..]) => self.each(|r, t| r.choice(condition, t[1], t[2])),
            _ => Tangent::default(),
        }
    }

    /// (a/b)′ = (a′ - (a/b) b′)/b, and (1/b)′ = -(1/b)² b′.
    fn quotient(&mut self, a: Id, b: Id, da: Option<Id>, db: Option<Id>) -> Option<Id> {
        let g = &mut *self.g;
        if let (None, Some(db)) = (da, db)
            && g.as_real(a) == Some(1.0)
        {
            if let Some(tangent) = inverse_tangent(g, b, db) {
                return Some(tangent);
            }
            let once = quotient_correction(g, self.value, b, db);
            let product = g.mul(self.value, once);
            return Some(g.neg(product));
        }
        let correction = db.map(|db| quotient_correction(g, self.value, b, db));
        difference(g, da, correction).map(|n| g.div(n, b))
    }

    /// x + i y: ∂ = ∂x + i ∂y with either derivative.
    fn parts_joined(&mut self) -> Tangent {
        self.each(|r, t| {
            let turned = t[1].map(|t| turn(r.g, t));
            sum(r.g, t[0], turned)
        })
    }

    /// ∂/∂z of a real function of one operand u, with a = ∂u/∂z and b = ∂u/∂z̄:
    /// re u: (a + b̄)/2; im u: (a - b̄)/(2i); |u|: (ē a + e b̄)/2 with e = u/|u|, or 0 at 0;
    /// arg u: (a/u - conj(b/u))/(2i).
    fn real_part_of(&mut self, prim: Prim, u: Id) -> Option<Id> {
        let (a, b) = (self.dz(0), self.dzbar(0));
        let g = &mut *self.g;
        if g.ty(u) == Ty::Real {
            return match prim {
                Prim::Re => a,
                Prim::Abs => {
                    let sign = g.apply(Prim::Sign, &[u]);
                    a.map(|a| g.mul(sign, a))
                }
                _ => None,
            };
        }
        let twice = match prim {
            Prim::Re => {
                let b = conj(g, b);
                sum(g, a, b)
            }
            Prim::Im => {
                let b = conj(g, b);
                difference(g, a, b).map(|d| turn_back(g, d))
            }
            Prim::Abs => {
                let unit = unit(g, u, self.value);
                let reflected = g.apply(Prim::Conj, &[unit]);
                let left = a.map(|a| g.mul(reflected, a));
                let right = conj(g, b).map(|b| g.mul(unit, b));
                sum(g, left, right)
            }
            _ => {
                let left = a.map(|a| g.div(a, u));
                let right = b.map(|b| g.div(b, u));
                let right = conj(g, right);
                difference(g, left, right).map(|d| turn_back(g, d))
            }
        };
        let half = g.real(0.5);
        twice.map(|t| g.mul(half, t))
    }

    fn choice(&mut self, condition: Id, a: Option<Id>, b: Option<Id>) -> Option<Id> {
        if a.is_none() && b.is_none() {
            return None;
        }
        let zero = self.g.real(0.0);
        let (mut a, mut b) = (a.unwrap_or(zero), b.unwrap_or(zero));
        if self.g.ty(a) != self.g.ty(b) {
            (a, b) = (self.g.widen(a), self.g.widen(b));
        }
        Some(self.g.apply(Prim::Select, &[condition, a, b]))
    }
}

/// u/|u|, and 0 with its derivatives at 0.
fn unit(g: &mut Graph, u: Id, modulus: Id) -> Id {
    let (zero, origin) = (g.real(0.0), g.complex(0.0, 0.0));
    let vanishes = g.apply(Prim::Equal, &[modulus, zero]);
    let unit = g.div(u, modulus);
    g.apply(Prim::Select, &[vanishes, origin, unit])
}

fn difference(g: &mut Graph, a: Option<Id>, b: Option<Id>) -> Option<Id> {
    match (a, b) {
        (Some(a), Some(b)) => Some(g.sub(a, b)),
        (None, Some(b)) => Some(g.neg(b)),
        (a, None) => a,
    }
}

fn conj(g: &mut Graph, a: Option<Id>) -> Option<Id> {
    a.map(|a| g.apply(Prim::Conj, &[a]))
}

/// i · w
fn turn(g: &mut Graph, w: Id) -> Id {
    let (re, im) = (g.apply(Prim::Re, &[w]), g.apply(Prim::Im, &[w]));
    let minus = g.neg(im);
    g.apply(Prim::Complex, &[minus, re])
}

/// w / i
fn turn_back(g: &mut Graph, w: Id) -> Id {
    let (re, im) = (g.apply(Prim::Re, &[w]), g.apply(Prim::Im, &[w]));
    let minus = g.neg(re);
    g.apply(Prim::Complex, &[im, minus])
}
