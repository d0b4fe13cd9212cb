//! A function of a complex variable near infinity: f(1/w) as a function of w.
//!
//! Putting 1/w in the place of z does not do: z⁵ overflows where f is still a plain number, and at w = 0 there is no z at
//! all. So each rational part is kept as wᵖ u with a whole p and a part u that is regular at w = 0 (the first term of a
//! Laurent series taken out): z is w⁻¹ · 1, products add exponents, sums take out the lesser one. What is left in the end has
//! the pole or zero of f at infinity as its only power of w. The chart of the sphere: L. Ahlfors, Complex Analysis, 3rd
//! edition, section 3.2.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use crate::formula::Formula;
use crate::ir::{Binder, Graph, Id, Node, Op, Prim, Ty};

/// Greatest exponent that is taken out; beyond it expressions are left as they are.
const MAX_POWER: i32 = 1 << 16;

/// A value as wᵖ u.
#[derive(Clone, Copy, Debug)]
struct Factored {
    power: i32,
    unit: Id,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Does not depend on w.
    Constant,
    /// A rational function of w.
    Rational,
    /// Anything else; its exponent is 0.
    Other,
}

/// The roots as functions of w = 1/z, which is the only input, complex. `scalars` are the types of the inputs of `from`: z
/// itself, or its real and imaginary parts. A state of a loop keeps the exponent that it starts with, so that an iteration
/// that fixes infinity stays regular there.
pub fn reciprocal(from: &Graph, roots: &[Id], scalars: &[Ty]) -> (Graph, Vec<Id>) {
    let live = from.reachable(roots);
    let mut to = Graph::new();
    let w = Formula::leaf(&mut to, 0, Ty::Complex);
    let mut walk = Walk {
        from,
        to,
        w,
        whole: scalars == [Ty::Complex],
        values: vec![None; live.len()],
        starts: starts(from, &live),
        binders: FxHashMap::default(),
    };
    for id in from.ids().take(live.len()) {
        if live[id.index()] {
            walk.visit(id, &live);
        }
    }
    let roots = roots.iter().map(|&root| walk.plain(root)).collect();
    (walk.to, roots)
}

/// Where each state of a live loop starts; loops of one binder agree on it, or it is left out.
fn starts(from: &Graph, live: &[bool]) -> FxHashMap<Id, Option<Id>> {
    let mut starts = FxHashMap::default();
    let loops = from.ids().take(live.len()).filter(|id| live[id.index()]);
    for state in loops
        .filter_map(|id| from.as_loop(id))
        .flat_map(|it| it.states)
    {
        let start = starts.entry(state.leaf).or_insert(Some(state.init));
        if *start != Some(state.init) {
            *start = None;
        }
    }
    starts
}

struct Walk<'g> {
    from: &'g Graph,
    to: Graph,
    w: Id,
    /// Whether the input is z itself.
    whole: bool,
    values: Vec<Option<Factored>>,
    starts: FxHashMap<Id, Option<Id>>,
    binders: FxHashMap<Binder, Binder>,
}

impl Walk<'_> {
    fn visit(&mut self, id: Id, live: &[bool]) {
        let node = self.from.node(id).clone();
        let value = match node.op {
            Op::Input(k) => self.input(k),
            Op::State(binder, index) => {
                let binder = self.binder(binder);
                let unit = self.to.state(binder, index, node.ty);
                let power = self.power_of_state(id, node.ty);
                let kind = if node.ty == Ty::Complex {
                    Kind::Rational
                } else {
                    Kind::Other
                };
                Factored { power, unit, kind }
            }
            Op::Counter(binder) => {
                let binder = self.binder(binder);
                other(self.to.counter(binder))
            }
            Op::Loop { .. } => match self.repeated(id, live) {
                Some(unit) => other(unit),
                None => return,
            },
            Op::Result(_) => self.result(id, &node),
            Op::Apply(prim) => self.apply(prim, &node),
            op => Factored {
                power: 0,
                unit: self.to.leaf(op, node.ty),
                kind: Kind::Constant,
            },
        };
        if let (0, Some(name)) = (value.power, self.from.name(id)) {
            self.to.set_name(value.unit, name);
        }
        self.values[id.index()] = Some(value);
    }

    fn value(&self, id: Id) -> Factored {
        self.values[id.index()].unwrap_or(other(self.w))
    }

    fn binder(&mut self, old: Binder) -> Binder {
        let to = &mut self.to;
        *self.binders.entry(old).or_insert_with(|| to.binder())
    }

    /// z = w⁻¹, or a part of it.
    fn input(&mut self, k: u16) -> Factored {
        // real, as products by it cost less; `plain` gives it back its type
        let z = Factored {
            power: -1,
            unit: self.to.real(1.0),
            kind: Kind::Rational,
        };
        if self.whole {
            return z;
        }
        let z = self.expanded(z);
        let part = if k == 0 { Prim::Re } else { Prim::Im };
        other(self.to.apply(part, &[z]))
    }

    /// wᵖ for p > 0.
    fn power(&mut self, p: i32) -> Id {
        if p == 1 {
            self.w
        } else {
            self.to.apply(Prim::PowInt(p), &[self.w])
        }
    }

    /// wᵖ u, multiplied out.
    fn times(&mut self, p: i32, unit: Id) -> Id {
        match p {
            0 => unit,
            1.. => {
                let power = self.power(p);
                self.to.mul(power, unit)
            }
            _ => {
                let power = self.power(-p);
                self.to.div(unit, power)
            }
        }
    }

    fn expanded(&mut self, value: Factored) -> Id {
        self.times(value.power, value.unit)
    }

    /// The value as it is, of the type that it had.
    fn plain(&mut self, id: Id) -> Id {
        let value = self.value(id);
        let expanded = self.expanded(value);
        self.typed(expanded, id)
    }

    fn typed(&mut self, new: Id, old: Id) -> Id {
        if self.from.ty(old) == Ty::Complex {
            self.to.widen(new)
        } else {
            new
        }
    }

    fn apply(&mut self, prim: Prim, node: &Node) -> Factored {
        let args: SmallVec<[Factored; 4]> = node.args.iter().map(|&a| self.value(a)).collect();
        if args.iter().all(|a| a.kind == Kind::Constant) {
            let units: SmallVec<[Id; 4]> = args.iter().map(|a| a.unit).collect();
            return Factored {
                power: 0,
                unit: self.to.apply(prim, &units),
                kind: Kind::Constant,
            };
        }
        if node.ty == Ty::Complex
            && args.iter().all(|a| a.kind != Kind::Other)
            && let Some(value) = self.rational(prim, &args)
        {
            return value;
        }
        let plain: SmallVec<[Id; 4]> = node.args.iter().map(|&a| self.plain(a)).collect();
        other(self.to.apply(prim, &plain))
    }

    /// The rules of exponents; `None` where an operation has none.
    fn rational(&mut self, prim: Prim, args: &[Factored]) -> Option<Factored> {
        let (power, unit) = match (prim, args) {
            (Prim::Neg, [a]) => (a.power, self.to.neg(a.unit)),
            // wᵖ u ± w^q v = w^m (w^(p-m) u ± w^(q-m) v), m = min(p, q)
            (Prim::Add | Prim::Sub, [a, b]) => {
                let least = a.power.min(b.power);
                let left = self.times(a.power - least, a.unit);
                let right = self.times(b.power - least, b.unit);
                (least, self.to.apply(prim, &[left, right]))
            }
            (Prim::Mul, [a, b]) => (a.power + b.power, self.to.mul(a.unit, b.unit)),
            (Prim::Div, [a, b]) => (a.power - b.power, self.to.div(a.unit, b.unit)),
            (Prim::PowInt(n), [a]) => (a.power.checked_mul(n)?, self.to.apply(prim, &[a.unit])),
            _ => return None,
        };
        (power.abs() <= MAX_POWER).then_some(Factored {
            power,
            unit,
            kind: Kind::Rational,
        })
    }

    /// The exponent that a state keeps: that of its start.
    fn power_of_state(&self, leaf: Id, ty: Ty) -> i32 {
        let start = self.starts.get(&leaf).copied().flatten();
        let start = start.and_then(|start| self.values[start.index()]);
        match start {
            Some(start) if ty == Ty::Complex && start.kind != Kind::Other => start.power,
            _ => 0,
        }
    }

    fn repeated(&mut self, id: Id, live: &[bool]) -> Option<Id> {
        let mut it = self.from.as_loop(id)?;
        it.binder = self.binder(it.binder);
        it.count = self.plain(it.count);
        it.until = it.until.map(|until| self.plain(until));
        it.states.retain(|state| live[state.leaf.index()]);
        for state in &mut it.states {
            let leaf = self.value(state.leaf);
            state.init = self.beside(state.init, leaf.power);
            state.next = self.beside(state.next, leaf.power);
            state.leaf = leaf.unit;
        }
        Some(self.to.repeat(&it))
    }

    /// u where the value is wᵖ u, for a given p.
    fn beside(&mut self, id: Id, power: i32) -> Id {
        let value = self.value(id);
        let unit = self.times(value.power - power, value.unit);
        self.typed(unit, id)
    }

    fn result(&mut self, id: Id, node: &Node) -> Factored {
        let repeated = self.value(node.args[0]).unit;
        let leaf = self.from.leaf_of_result(id).map(|leaf| self.value(leaf));
        let unit = self.to.intern(node.op, node.ty, &[repeated]);
        match leaf {
            Some(leaf) => Factored { unit, ..leaf },
            None => other(unit),
        }
    }
}

fn other(unit: Id) -> Factored {
    Factored {
        power: 0,
        unit,
        kind: Kind::Other,
    }
}

#[cfg(test)]
mod tests {
    use super::reciprocal;
    use crate::compile;
    use crate::eval::{Leaves, Tape};
    use crate::formula::Formula;
    use crate::reference::complex::{Complex, complex};
    use crate::table::Number;

    fn formula(text: &str) -> Formula {
        let compiled = compile(&format!("f(z) = {text}\nshow domain(f)"));
        let Some(program) = compiled.program else {
            panic!("{text}: {:?}", compiled.diagnostics);
        };
        program.pictures()[0].formula.clone()
    }

    fn norm(z: Complex) -> f64 {
        z.re.hypot(z.im)
    }

    fn polar(r: f64, angle: f64) -> Complex {
        complex(r * angle.cos(), r * angle.sin())
    }

    fn run(tape: &mut Tape, z: Complex) -> Complex {
        let inputs = [Number::Complex(complex(z.re, z.im))];
        let leaves = Leaves {
            inputs: &inputs,
            params: &[],
            time: 0.0,
            pixel: 0.0,
        };
        let mut out = complex(f64::NAN, f64::NAN);
        tape.run(&leaves, |value| {
            out = match value {
                Number::Complex(z) => z,
                Number::Real(x) => complex(x, 0.0),
                Number::Truth(_) => out,
            };
        });
        out
    }

    fn at_reciprocal(text: &str, w: Complex) -> Complex {
        let f = formula(text);
        let (graph, roots) = reciprocal(&f.graph, &f.value, &f.scalars());
        run(&mut Tape::new(&graph, &roots), w)
    }

    /// Where z = 1/w is an ordinary number, both forms are one function.
    #[test]
    fn it_is_the_same_function() {
        for text in [
            "z",
            "(z^2 - 1)/(z + i)",
            "3z^5 - 2/z^3 + i",
            "conj(z)^2 + 1/z",
            "exp(z) z^3 - |z|",
            "iterate(3, w = z, w (2w^5 + 3)/(3w^5 + 2))",
            "iterate(4, w = z, w^2 - 0.8 + 0.15i)",
            "iterate(3, w = 1/z, w^2 + z)",
            "r.w + r.d where r = iterate(5, w = z, d = 1, w^2 + 0.3, 2 w d until |w| > 4)",
            "sum(k in 1..5, z^k/k)",
            "√(-z/z)",
            "if re(z) > 0 then z else 1/z",
            "(z/z)^2 gamma(1/z)",
        ] {
            let f = formula(text);
            let mut direct = Tape::new(&f.graph, &f.value);
            for k in 0..40 {
                let w = polar(0.3 + 0.05 * f64::from(k), 0.7 * f64::from(k) + 0.1);
                let (found, wanted) = (
                    at_reciprocal(text, w),
                    run(&mut direct, complex(1.0, 0.0) / w),
                );
                let error = norm(found - wanted) / norm(wanted).max(1.0);
                assert!(
                    error < 1e-10 || !norm(wanted).is_finite(),
                    "{text} at {w:?}: {found:?}, {wanted:?}"
                );
            }
        }
    }

    /// At w = 0, and where powers of z overflow, rational functions have their limits.
    #[test]
    fn infinity_is_a_point() {
        let limit = |text: &str, wanted: Complex| {
            for w in [0.0, 1e-300, 1e-30, 1e-12] {
                let found = at_reciprocal(text, complex(w, -w));
                assert!(norm(found - wanted) < 1e-10, "{text} at {w}: {found:?}");
            }
        };
        limit("(3z^2 - 1)/(2z^2 + i)", complex(1.5, 0.0));
        limit("(z^40 - 3)/(i z^40 + z)", complex(0.0, -1.0));
        limit("(z - 1)/(z^2 + 1)", complex(0.0, 0.0));
        limit(
            "iterate(2, w = z, w (2w^5 + 3)/(3w^5 + 2))/z",
            complex(4.0 / 9.0, 0.0),
        );
        limit("(z - (z^3 - 1)/(3z^2))/z", complex(2.0 / 3.0, 0.0));
    }
}
