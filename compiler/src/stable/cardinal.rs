//! sin a/a and its relatives: quotients of a function that vanishes with its argument, and that argument.

use smallvec::SmallVec;

use super::guard::scaled;
use super::pass::Pass;
use super::rule::Rule;
use crate::ir::{Graph, Id, Op, Prim};

/// Most factors of a quotient that is looked at.
const MAX_FACTORS: usize = 8;

/// A product of powers, with a constant factor.
#[derive(Clone, Default)]
struct Factors {
    constant: f64,
    powers: SmallVec<[(Id, i32); 6]>,
}

impl Pass {
    /// f(a)ⁿ/aⁿ = h(a)ⁿ, and its inverse, for sin, sinh, expm1; constant factors of a are taken out.
    pub(super) fn cardinal(&mut self, g: &mut Graph, id: Id) -> Option<Id> {
        if !self.on(Rule::Cardinal) {
            return None;
        }
        let whole = factors(g, id, 1.0, &[])?;
        let functions = whole
            .powers
            .iter()
            .filter_map(|&(f, _)| Some(argument(g, f)?.1));
        let arguments: SmallVec<[Id; 4]> = functions.collect();
        // an argument that is there as it is need not be taken apart
        for kept in [arguments.as_slice(), &[]] {
            let whole = factors(g, id, 1.0, kept)?;
            let found = whole
                .powers
                .iter()
                .find_map(|&(f, n)| joined(g, &whole, f, n, kept));
            if let Some(found) = found {
                let new = built(g, &found)?;
                return self.by(Rule::Cardinal, new);
            }
        }
        None
    }
}

/// The quotient of a function with its argument, and the argument.
fn argument(g: &Graph, f: Id) -> Option<(Prim, Id)> {
    let node = g.node(f);
    let quotient = match node.op {
        Op::Apply(Prim::Sin) => Prim::Sinc,
        Op::Apply(Prim::Sinh) => Prim::Sinhc,
        Op::Apply(Prim::Expm1) => Prim::Exprel,
        _ => return None,
    };
    Some((quotient, node.args[0]))
}

/// The product with fⁿ and as many powers of its argument made one, where those are there.
fn joined(g: &Graph, whole: &Factors, f: Id, n: i32, kept: &[Id]) -> Option<Joined> {
    let (quotient, a) = argument(g, f)?;
    let inner = factors(g, a, 1.0, kept)?;
    if inner.powers.is_empty() {
        return None;
    }
    // how often the argument stands on the other side
    let mut times = n.abs();
    for &(atom, power) in &inner.powers {
        let (_, there) = whole.powers.iter().find(|(other, _)| *other == atom)?;
        let against = there.signum() * power.signum() == -n.signum();
        times = times.min(if against {
            there.abs() / power.abs()
        } else {
            0
        });
    }
    if times == 0 {
        return None;
    }
    let times = times * n.signum();
    let mut rest = whole.clone();
    rest.multiply(f, -times)?;
    for &(atom, power) in &inner.powers {
        rest.multiply(atom, power * times)?;
    }
    rest.constant *= inner.constant.powi(times);
    let sane = rest.constant.is_normal() && (1e-30..1e30).contains(&rest.constant.abs());
    sane.then_some(Joined {
        quotient,
        argument: a,
        times,
        rest,
    })
}

/// h(a)ⁿ times the rest.
struct Joined {
    quotient: Prim,
    argument: Id,
    times: i32,
    rest: Factors,
}

fn built(g: &mut Graph, joined: &Joined) -> Option<Id> {
    let value = g.apply(joined.quotient, &[joined.argument]);
    let mut out = (joined.times > 0).then(|| g.apply(Prim::PowInt(joined.times), &[value]));
    for &(atom, power) in joined.rest.powers.iter().filter(|(_, power)| *power > 0) {
        let factor = g.apply(Prim::PowInt(power), &[atom]);
        out = Some(match out {
            Some(product) => g.mul(product, factor),
            None => factor,
        });
    }
    let constant = joined.rest.constant;
    let mut out = match out {
        Some(product) if constant.to_bits() == 1.0_f64.to_bits() => product,
        Some(product) => scaled(g, constant, product),
        None => g.real(constant),
    };
    if joined.times < 0 {
        let divisor = g.apply(Prim::PowInt(-joined.times), &[value]);
        out = g.div(out, divisor);
    }
    for &(atom, power) in joined.rest.powers.iter().filter(|(_, power)| *power < 0) {
        let divisor = g.apply(Prim::PowInt(power.checked_neg()?), &[atom]);
        out = g.div(out, divisor);
    }
    Some(out)
}

impl Factors {
    /// Multiplies by a power.
    fn multiply(&mut self, atom: Id, power: i32) -> Option<()> {
        match self.powers.iter().position(|(other, _)| *other == atom) {
            Some(k) => {
                self.powers[k].1 = self.powers[k].1.checked_add(power)?;
                if self.powers[k].1 == 0 {
                    self.powers.remove(k);
                }
            }
            None if self.powers.len() < MAX_FACTORS => self.powers.push((atom, power)),
            None => return None,
        }
        Some(())
    }
}

/// A node as a product of powers; those of `kept` are atoms. `None` where it is too long, or has the factor 0.
fn factors(g: &Graph, id: Id, constant: f64, kept: &[Id]) -> Option<Factors> {
    let mut out = Factors {
        constant,
        powers: SmallVec::new(),
    };
    let mut pending: SmallVec<[(Id, i32); 8]> = SmallVec::new();
    pending.push((id, 1));
    let mut looked = 0;
    while let Some((id, power)) = pending.pop() {
        looked += 1;
        if looked > 4 * MAX_FACTORS {
            return None;
        }
        let node = g.node(id);
        if kept.contains(&id) {
            out.multiply(id, power)?;
            continue;
        }
        match (node.op, node.args.as_slice()) {
            (Op::Apply(Prim::Mul), &[a, b]) => pending.extend([(a, power), (b, power)]),
            (Op::Apply(Prim::Div), &[a, b]) => pending.extend([(a, power), (b, -power)]),
            (Op::Apply(Prim::Neg), &[a]) => {
                pending.push((a, power));
                out.constant *= if power % 2 == 0 { 1.0 } else { -1.0 };
            }
            (Op::Apply(Prim::PowInt(n)), &[a]) if (1..=8).contains(&n) => {
                pending.push((a, power.checked_mul(n)?));
            }
            _ => match super::polynomial::constant(g, id) {
                Some(c) if c != 0.0 && c.is_finite() && power.abs() <= 8 => {
                    out.constant *= c.powi(power);
                }
                Some(_) => return None,
                None => out.multiply(id, power)?,
            },
        }
    }
    (out.constant.is_normal()).then_some(out)
}
