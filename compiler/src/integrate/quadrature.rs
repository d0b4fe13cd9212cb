//! Integration by a fixed composite rule, where there is no closed form.

use super::arithmetic::scale;
use super::{Integrator, Problem};
use crate::ir::{Id, Loop, State, Ty};

/// Number of panels of equal length.
pub const PANELS: u32 = 16;
/// Gauss-Legendre nodes of a panel.
pub const NODES: usize = 6;

impl Integrator<'_> {
    /// Quadrature alone, on each piece between the places where conditions change, as far as these are known.
    pub(super) fn by_quadrature_alone(&mut self, root: Id) -> Result<Id, Problem> {
        match self.cuts(root) {
            Ok(cuts) if !cuts.is_empty() => {
                self.piecewise(root, &cuts, |this, piece| Ok(this.composite(piece)))
            }
            _ => Ok(self.composite(root)),
        }
    }

    /// The composite rule: 16 panels with 6 Gauss-Legendre nodes each, in a loop. Exact for polynomials to degree 11 on
    /// each panel; the error of an integrand that is analytic around a panel to the distance of r half panels falls as
    /// (r + √(r² - 1))⁻¹².
    ///
    /// Davis and Rabinowitz, Methods of Numerical Integration, 2nd edition, sections 2.7 and 4.6.
    pub(super) fn composite(&mut self, root: Id) -> Id {
        if !self.moves(root) {
            let length = self.length_of_path();
            return self.g.mul(length, root);
        }
        let whole = self.path.clone();
        let binder = self.g.binder();
        let (sum, counter) = (self.g.new_state(binder, Ty::Real), self.g.counter(binder));
        // panel k goes from h (2 k/n - 1) to h (2 (k + 1)/n - 1) around the middle
        let width = 2.0 / f64::from(PANELS);
        let ends = [0.0, 1.0].map(|k| {
            let step = scale(self.g, width, counter);
            let offset = self.g.real(width * k - 1.0);
            let part = self.g.add(step, offset);
            let s = self.g.mul(whole.half, part);
            self.g.add(whole.middle, s)
        });
        self.path = whole.between(self.g, ends);
        let panel = self.gauss(root, NODES);
        self.path = whole;
        let next = self.g.add(sum, panel);
        let init = self.g.real(0.0);
        let repeated = Loop {
            binder,
            count: self.g.real(f64::from(PANELS)),
            limit: PANELS,
            until: None,
            states: std::iter::once(State {
                leaf: sum,
                init,
                next,
            })
            .collect(),
        };
        let repeated = self.g.repeat(&repeated);
        self.g.result(repeated, sum)
    }
}
