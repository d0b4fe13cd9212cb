//! Whether an expression is an integral, by normal forms ([`super::normal`]), case by case of its conditions.
//!
//! Sines, exponentials and their quotients become what they are, and are differentiated as that; what else there is has no
//! normal form. A condition is the sign of a sum; where it decides which of two different forms counts, both are looked at.
//! Places where two sides are equal, which are single places, are not.

use rustc_hash::FxHashMap;

use super::normal::{Budget, Form, Quotient};
use super::path::cone;
use crate::ir::{Graph, Id, Op, Prim, Ty};

/// Greatest number of cases.
const MAX_CASES: usize = 32;
/// Greatest number of products of terms, of all cases together.
const MAX_PRODUCTS: usize = 150_000;
/// Numbers of variables beside the inputs: parameters, the clock and the pixel.
const PARAMS: u16 = 1000;
const TIME: u16 = 900;
const PIXEL: u16 = 901;
/// The inputs that are the ends of the interval.
const START: u16 = 6;
const END: u16 = 7;

/// Why there is no normal form.
#[derive(Clone, Debug)]
enum Stop {
    /// An operation or number has none, or there are too many terms.
    Unknown,
    /// The sign of this is to be known first.
    Split(Form),
}

/// Reads expressions in one case of the signs of some sums.
struct Reader<'g> {
    g: &'g Graph,
    /// Whether the interval is empty: its second end is the first.
    is_empty: bool,
    /// Sums with whether they are positive.
    signs: &'g [(Form, bool)],
    values: FxHashMap<Id, Result<Quotient, Stop>>,
    truths: FxHashMap<Id, Result<bool, Stop>>,
    budget: Budget,
}

/// Whether an expression is the integral of a field from input 6 to input 7: whether its derivative by input 7 is the other
/// expression, the field there, and whether it is 0 where both are the same. `false` also where that is not known.
pub fn is_integral(g: &Graph, integral: Id, field: Id) -> bool {
    let roots = [integral, field];
    let is_read = |&id: &Id| match g.node(id).op {
        Op::Apply(prim) => is_elementary(prim),
        _ => true,
    };
    cone(g, &roots).iter().all(is_read)
        && in_every_case(g, false, |reader| reader.is_slope(integral, field))
        && in_every_case(g, true, |reader| Ok(reader.read(integral)?.top.is_zero()))
}

/// Whether something holds in every case of the signs that it asks for.
fn in_every_case(
    g: &Graph,
    is_empty: bool,
    holds: impl Fn(&mut Reader) -> Result<bool, Stop>,
) -> bool {
    let mut cases: Vec<Vec<(Form, bool)>> = vec![Vec::new()];
    let (mut count, mut left_over) = (0, MAX_PRODUCTS);
    while let Some(signs) = cases.pop() {
        count += 1;
        if count > MAX_CASES {
            return false;
        }
        let mut reader = Reader {
            g,
            is_empty,
            signs: &signs,
            values: FxHashMap::default(),
            truths: FxHashMap::default(),
            budget: Budget(left_over),
        };
        let found = holds(&mut reader);
        left_over = reader.budget.0;
        match found {
            Ok(true) => {}
            Ok(false) | Err(Stop::Unknown) => return false,
            Err(Stop::Split(of)) => {
                for sign in [true, false] {
                    let mut signs = signs.clone();
                    signs.push((of.clone(), sign));
                    cases.push(signs);
                }
            }
        }
    }
    true
}

/// Whether an operation has a normal form.
fn is_elementary(prim: Prim) -> bool {
    use Prim::{
        Abs, Add, And, Cos, Cosh, CosineRest, Div, Equal, Exp, Expm1, Exprel, Less, LessEqual, Max,
        Min, Mul, MulAdd, MulAddRest, Neg, Not, Or, PowInt, ProductRest, Select, Sign, Sin, Sinc,
        SineRest, Sinh, Sinhc, SquarePlus, Sub, SumRest,
    };
    matches!(
        prim,
        Abs | Add
            | And
            | Cos
            | CosineRest
            | Cosh
            | Div
            | Equal
            | Exp
            | Expm1
            | Exprel
            | Less
            | LessEqual
            | Max
            | Min
            | Mul
            | MulAdd
            | MulAddRest
            | Neg
            | Not
            | Or
            | PowInt(_)
            | ProductRest
            | Select
            | Sign
            | Sin
            | Sinc
            | SineRest
            | Sinh
            | Sinhc
            | SquarePlus
            | Sub
            | SumRest
    )
}

impl Reader<'_> {
    fn is_slope(&mut self, integral: Id, field: Id) -> Result<bool, Stop> {
        let [integral, field] = [self.read(integral)?, self.read(field)?];
        let slope = integral.slope(END, &mut self.budget);
        let slope = slope.ok_or(Stop::Unknown)?;
        slope.equals(&field, &mut self.budget).ok_or(Stop::Unknown)
    }

    fn read(&mut self, root: Id) -> Result<Quotient, Stop> {
        for id in cone(self.g, &[root]) {
            if self.g.ty(id) == Ty::Real {
                if !self.values.contains_key(&id) {
                    let value = self.value(id);
                    self.values.insert(id, value);
                }
            } else if !self.truths.contains_key(&id) {
                let truth = self.truth(id);
                self.truths.insert(id, truth);
            }
        }
        self.known(root)
    }

    fn known(&self, id: Id) -> Result<Quotient, Stop> {
        self.values.get(&id).cloned().unwrap_or(Err(Stop::Unknown))
    }

    fn value(&mut self, id: Id) -> Result<Quotient, Stop> {
        let node = self.g.node(id);
        let variable = |k: u16| Ok(Quotient::whole(Form::variable(k)));
        match node.op {
            Op::Const(bits) => {
                let v = f64::from_bits(bits);
                if v.is_finite() {
                    Ok(Quotient::whole(Form::constant(v)))
                } else {
                    Err(Stop::Unknown)
                }
            }
            Op::Input(END) if self.is_empty => variable(START),
            Op::Input(k) => variable(k),
            Op::Param(k) => variable(PARAMS.saturating_add(k)),
            Op::Time => variable(TIME),
            Op::Pixel => variable(PIXEL),
            Op::Apply(Prim::Select) => self.selected(&node.args),
            Op::Apply(prim) => {
                let args: Result<Vec<Quotient>, Stop> =
                    node.args.iter().map(|&a| self.known(a)).collect();
                self.operation(prim, &args?)
            }
            _ => Err(Stop::Unknown),
        }
    }

    /// What both branches are where they are the same, else the one that counts.
    fn selected(&mut self, args: &[Id]) -> Result<Quotient, Stop> {
        let &[condition, then, otherwise] = args else {
            return Err(Stop::Unknown);
        };
        let branches = [self.known(then), self.known(otherwise)];
        if let [Ok(then), Ok(otherwise)] = &branches
            && then.equals(otherwise, &mut self.budget) == Some(true)
        {
            return Ok(then.clone());
        }
        let truth = self.truths.get(&condition).cloned();
        let [then, otherwise] = branches;
        if truth.unwrap_or(Err(Stop::Unknown))? {
            then
        } else {
            otherwise
        }
    }

    fn truth(&mut self, id: Id) -> Result<bool, Stop> {
        let node = self.g.node(id);
        let of = |k: usize| self.truths.get(&node.args[k]).cloned();
        let both = || {
            let unknown = || Err(Stop::Unknown);
            let [a, b] = [of(0), of(1)].map(|t| t.unwrap_or_else(unknown));
            Ok::<[bool; 2], Stop>([a?, b?])
        };
        match node.op {
            Op::Truth(v) => Ok(v),
            Op::Apply(Prim::And) => both().map(|[a, b]| a && b),
            Op::Apply(Prim::Or) => both().map(|[a, b]| a || b),
            Op::Apply(Prim::Not) => of(0).unwrap_or(Err(Stop::Unknown)).map(|t| !t),
            Op::Apply(Prim::Less | Prim::LessEqual) => {
                let [low, high] = [self.known(node.args[0])?, self.known(node.args[1])?];
                let difference = self.sum(&high, &low, -1.0)?;
                self.is_positive(&difference)
            }
            Op::Apply(Prim::Equal) => {
                let [a, b] = [self.known(node.args[0])?, self.known(node.args[1])?];
                a.equals(&b, &mut self.budget).ok_or(Stop::Unknown)
            }
            _ => Err(Stop::Unknown),
        }
    }

    /// Whether a quotient is positive in this case.
    fn is_positive(&mut self, of: &Quotient) -> Result<bool, Stop> {
        let form = self.product_of(&of.top, &of.bottom)?;
        if let Some(v) = form.as_number() {
            return Ok(v > 0.0);
        }
        for (known, sign) in self.signs {
            if let Some(side) = known.side_of(&form) {
                return Ok(*sign == (side > 0.0));
            }
        }
        Err(Stop::Split(form))
    }

    fn product_of(&mut self, a: &Form, b: &Form) -> Result<Form, Stop> {
        a.times(b, &mut self.budget).ok_or(Stop::Unknown)
    }

    fn sum(&mut self, a: &Quotient, b: &Quotient, v: f64) -> Result<Quotient, Stop> {
        a.plus(b, v, &mut self.budget).ok_or(Stop::Unknown)
    }

    fn product(&mut self, a: &Quotient, b: &Quotient) -> Result<Quotient, Stop> {
        a.times(b, &mut self.budget).ok_or(Stop::Unknown)
    }

    fn quotient(&mut self, a: &Quotient, b: &Quotient) -> Result<Quotient, Stop> {
        a.over(b, &mut self.budget).ok_or(Stop::Unknown)
    }

    fn power(&mut self, of: &Quotient, n: i32) -> Result<Quotient, Stop> {
        let one = number(1.0);
        let mut out = one.clone();
        let size = n.unsigned_abs();
        for bit in (0..u32::BITS - size.leading_zeros()).rev() {
            out = self.product(&out, &out)?;
            if size >> bit & 1 == 1 {
                out = self.product(&out, of)?;
            }
        }
        if n < 0 {
            self.quotient(&one, &out)
        } else {
            Ok(out)
        }
    }

    fn operation(&mut self, prim: Prim, args: &[Quotient]) -> Result<Quotient, Stop> {
        let zero = number(0.0);
        match (prim, args) {
            (Prim::Add, [a, b]) => self.sum(a, b, 1.0),
            (Prim::Sub, [a, b]) => self.sum(a, b, -1.0),
            (Prim::Neg, [a]) => self.sum(&zero, a, -1.0),
            (Prim::Mul, [a, b]) => self.product(a, b),
            (Prim::Div, [a, b]) => self.quotient(a, b),
            (Prim::PowInt(n), [a]) => self.power(a, n),
            (Prim::MulAdd, [a, b, c]) => {
                let product = self.product(a, b)?;
                self.sum(&product, c, 1.0)
            }
            (Prim::SquarePlus, [a, c]) => {
                let square = self.product(a, a)?;
                self.sum(&square, c, 1.0)
            }
            // rests of roundings are 0
            (Prim::SumRest, [a, b, s]) => {
                let sum = self.sum(a, b, 1.0)?;
                self.sum(&sum, s, -1.0)
            }
            (Prim::MulAddRest, [a, b, c, s]) => {
                let product = self.product(a, b)?;
                let sum = self.sum(&product, c, 1.0)?;
                self.sum(&sum, s, -1.0)
            }
            (Prim::ProductRest, [a, b, p]) => {
                let product = self.product(a, b)?;
                self.sum(&product, p, -1.0)
            }
            (Prim::SineRest, [x, s]) => {
                let sine = self.operation(Prim::Sin, std::slice::from_ref(x))?;
                self.sum(&sine, s, -1.0)
            }
            (Prim::CosineRest, [x, s]) => {
                let cosine = self.operation(Prim::Cos, std::slice::from_ref(x))?;
                self.sum(&cosine, s, -1.0)
            }
            (Prim::Abs, [a]) => {
                let sign = if self.is_positive(a)? { 1.0 } else { -1.0 };
                self.sum(&zero, a, sign)
            }
            (Prim::Sign, [a]) => Ok(number(if self.is_positive(a)? { 1.0 } else { -1.0 })),
            (Prim::Max | Prim::Min, [a, b]) => {
                let difference = self.sum(a, b, -1.0)?;
                let is_first = self.is_positive(&difference)? == (prim == Prim::Max);
                Ok(if is_first { a.clone() } else { b.clone() })
            }
            _ => self.function(prim, args),
        }
    }

    fn function(&mut self, prim: Prim, args: &[Quotient]) -> Result<Quotient, Stop> {
        let one = number(1.0);
        let x = args.first().ok_or(Stop::Unknown)?;
        if matches!(prim, Prim::Sinc | Prim::Sinhc | Prim::Exprel) && x.top.is_zero() {
            return Ok(one);
        }
        if args.len() == 1
            && let Some(form) = x.as_form()
        {
            let waves = |round: bool| Form::waves(&form, round).map(|w| w.map(Quotient::whole));
            let whole = |k: usize, round: bool| waves(round).map(|w| w[k].clone());
            let found = match prim {
                Prim::Exp => Form::exp(&form).map(Quotient::whole),
                Prim::Sin => whole(0, true),
                Prim::Cos => whole(1, true),
                Prim::Sinh => whole(0, false),
                Prim::Cosh => whole(1, false),
                Prim::Sinc | Prim::Sinhc => {
                    let sine = whole(0, prim == Prim::Sinc);
                    sine.and_then(|s| s.over(x, &mut self.budget))
                }
                Prim::Expm1 | Prim::Exprel => {
                    let grown = Form::exp(&form).map(|e| e.plus(&Form::constant(1.0), -1.0));
                    grown.map(Quotient::whole).and_then(|e| {
                        if prim == Prim::Expm1 {
                            Some(e)
                        } else {
                            e.over(x, &mut self.budget)
                        }
                    })
                }
                _ => None,
            };
            return found.ok_or(Stop::Unknown);
        }
        Err(Stop::Unknown)
    }
}

fn number(v: f64) -> Quotient {
    Quotient::whole(Form::constant(v))
}
