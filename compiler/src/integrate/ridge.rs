//! Functions of one affine form, cut at constants: clamps, smoothsteps, linear and quadratic falloffs.
//!
//! Along the line such a form u goes evenly from one end value to the other, so that the mean of F(u) over the interval
//! is the mean over the range of u. Where F changes at constants, these are in order whatever the line is: each is
//! clipped to the range, nothing is sorted, and which piece has which branch is known when the integral is written.
//! Where F changes at parameters, up to three of them are sorted by a network, and each piece is decided in its middle.
//! (A function of an affine form is a ridge function: Pinkus, Ridge Functions, 2015.)

use super::arithmetic::{add, div, mul, scale, sub};
use super::path::{Body, cone};
use super::{Integrator, Otherwise, Part, Path, Rule};
use crate::ir::{Id, Op, Prim, Ty};

/// How many expressions are tried as the affine form.
const MAX_FORMS_TRIED: usize = 32;
/// Greatest number of cuts that are sorted where parameters place them.
const MAX_SORTED: usize = 3;

/// An integrand as a function of one affine form, whose conditions change at places that do not depend on the line.
struct Ridge {
    /// The form.
    form: Id,
    /// The leaf that stands for it.
    leaf: Id,
    /// The integrand, by that leaf.
    function: Id,
    /// Where it may change, in order.
    cuts: Vec<Id>,
    /// What it is below, between and above the cuts, each with its degree.
    pieces: Vec<(Id, u32)>,
}

impl<'g> Integrator<'g> {
    /// ∫ F(u) dt = L Σ φᵢ ⟨F⟩ᵢ, where φᵢ is the part of the range of u that lies between two cuts and ⟨F⟩ᵢ the mean of
    /// the polynomial that F is there; L F(u) where u does not change. `None` where the integrand is no such function.
    pub(super) fn ridge(&mut self, root: Id) -> Option<Id> {
        let ridge = self.as_ridge(root)?;
        let ends = self.at_ends(ridge.form);
        let halves = ends.map(|end| scale(self.g, 0.5, end));
        let low = self.g.apply(Prim::Min, &halves);
        let high = self.g.apply(Prim::Max, &halves);
        let range = sub(self.g, high, low);
        let mut bounds = vec![low];
        for &cut in &ridge.cuts {
            let cut = scale(self.g, 0.5, cut);
            let above = self.g.apply(Prim::Max, &[cut, low]);
            bounds.push(self.g.apply(Prim::Min, &[above, high]));
        }
        bounds.push(high);
        let mut mean = self.g.real(0.0);
        for (&(piece, degree), bounds) in ridge.pieces.iter().zip(bounds.windows(2)) {
            let ends = [bounds[0], bounds[1]].map(|half| scale(self.g, 2.0, half));
            let path = Path::of_variable(self.g, ridge.leaf, ends[0], ends[1]);
            let part = div(self.g, path.half, range);
            let mut inner = Integrator::new(&mut *self.g, path, Otherwise::Refuse);
            let level = inner.mean(piece, degree as usize / 2 + 1);
            let part = mul(self.g, part, level);
            mean = add(self.g, mean, part);
        }
        let of_form = Body::new(self.g, &[ridge.function], std::iter::once(ridge.leaf));
        let middle = self.g.add(halves[0], halves[1]);
        let level = of_form.at(self.g, &[(ridge.leaf, middle)])[0];
        // where u is the same number at both ends: both change it by half
        let changes = self.g.apply(Prim::Less, &[low, high]);
        let mean = self.g.apply(Prim::Select, &[changes, mean, level]);
        let is_constant = ridge.pieces.iter().all(|p| p.1 == 0);
        self.parts.push(Part {
            integrand: root,
            guards: smallvec::SmallVec::new(),
            rule: if is_constant {
                Rule::Constant
            } else {
                Rule::Polynomial
            },
        });
        let [a, b] = self.path.ends;
        let length = sub(self.g, b, a);
        Some(self.g.mul(length, mean))
    }

    /// The integrand by the largest affine form of which it is a function with constant cuts and polynomial pieces.
    fn as_ridge(&mut self, root: Id) -> Option<Ridge> {
        let mut forms = cone(self.g, &[root]);
        forms.retain(|&id| {
            self.g.ty(id) == Ty::Real && self.degree(id) == Some(1) && self.moves(id)
        });
        let forms = forms.into_iter().rev().take(MAX_FORMS_TRIED);
        forms.into_iter().find_map(|form| self.by_form(root, form))
    }

    fn by_form(&mut self, root: Id, form: Id) -> Option<Ridge> {
        let leaf = self.g.new_variable(Ty::Real);
        let body = Body::new(self.g, &[root], std::iter::once(form));
        let function = body.at(self.g, &[(form, leaf)])[0];
        if self.moves(function) {
            return None;
        }
        let (low, high) = (self.g.real(-1.0), self.g.real(1.0));
        let path = Path::of_variable(self.g, leaf, low, high);
        let mut inner = Integrator::new(&mut *self.g, path, Otherwise::Refuse);
        let (cuts, places) = inner.ordered_cuts(function)?;
        let mut pieces = Vec::with_capacity(cuts.len() + 1);
        for place in places {
            inner.path.coordinates[0].mid = place;
            let piece = inner.decided(function);
            let degree = inner.degree(piece)?;
            pieces.push((piece, degree));
        }
        Some(Ridge {
            form,
            leaf,
            function,
            cuts,
            pieces,
        })
    }

    /// The places where conditions change, in order, and a place below, between and above them.
    fn ordered_cuts(&mut self, function: Id) -> Option<(Vec<Id>, Vec<Id>)> {
        let cuts = self.cuts(function).ok()?;
        match self.constant_cuts(&cuts) {
            Some(cuts) => {
                let places = between(&cuts);
                let real = |this: &mut Self, all: Vec<f64>| {
                    all.into_iter().map(|v| this.g.real(v)).collect::<Vec<Id>>()
                };
                Some((real(self, cuts), real(self, places)))
            }
            None => self.sorted_cuts(cuts),
        }
    }

    /// A few cuts that depend on parameters, by a sorting network. Only those that are numbers whatever the parameters
    /// are: zeros of what grows at a constant rate.
    fn sorted_cuts(&mut self, mut cuts: Vec<Id>) -> Option<(Vec<Id>, Vec<Id>)> {
        let is_safe = |this: &Self, cut: Id| {
            cone(this.g, &[cut]).iter().all(|&id| {
                let node = this.g.node(id);
                match node.op {
                    Op::Apply(Prim::Div) => {
                        let bottom = this.g.as_real(node.args[1]);
                        bottom.is_some_and(|b| b != 0.0 && b.is_finite())
                    }
                    Op::Apply(prim) => {
                        matches!(prim, Prim::Neg | Prim::Add | Prim::Sub | Prim::Mul)
                    }
                    Op::Const(bits) => f64::from_bits(bits).is_finite(),
                    Op::Param(_) | Op::Time | Op::Pixel => true,
                    _ => false,
                }
            })
        };
        if cuts.len() > MAX_SORTED || !cuts.iter().all(|&cut| is_safe(self, cut)) {
            return None;
        }
        for round in 1..cuts.len() {
            for k in 0..cuts.len() - round {
                let pair = [cuts[k], cuts[k + 1]];
                cuts[k] = self.g.apply(Prim::Min, &pair);
                cuts[k + 1] = self.g.apply(Prim::Max, &pair);
            }
        }
        let (first, last) = (*cuts.first()?, *cuts.last()?);
        let one = self.g.real(1.0);
        let [below, above] = [(first, -1.0), (last, 1.0)].map(|(cut, side)| {
            let size = self.g.apply(Prim::Abs, &[cut]);
            let far = self.g.apply(Prim::Max, &[size, one]);
            let step = scale(self.g, side, far);
            self.g.add(cut, step)
        });
        let mut places = vec![below];
        for pair in cuts.windows(2) {
            let halves = [pair[0], pair[1]].map(|cut| scale(self.g, 0.5, cut));
            places.push(self.g.add(halves[0], halves[1]));
        }
        places.push(above);
        Some((cuts, places))
    }

    /// The cuts in order, if all of them are known numbers.
    fn constant_cuts(&mut self, cuts: &[Id]) -> Option<Vec<f64>> {
        let cuts: Option<Vec<f64>> = cuts.iter().map(|&cut| self.g.as_real(cut)).collect();
        // + 0 makes -0 to 0
        let mut cuts: Vec<f64> = cuts?.into_iter().map(|cut| cut + 0.0).collect();
        // the zeros of a polynomial that has none
        cuts.retain(|cut| cut.is_finite());
        cuts.sort_unstable_by(f64::total_cmp);
        cuts.dedup();
        Some(cuts)
    }
}

/// A place below all, between each two and above all of some numbers in order.
fn between(cuts: &[f64]) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (cuts.first(), cuts.last()) else {
        return vec![0.0];
    };
    let inner = cuts.windows(2).map(|pair| 0.5 * pair[0] + 0.5 * pair[1]);
    std::iter::once(first - first.abs().max(1.0))
        .chain(inner)
        .chain(std::iter::once(last + last.abs().max(1.0)))
        .collect()
}
