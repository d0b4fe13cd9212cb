//! Integration by Gauss-Legendre nodes, where there is no closed form.
//!
//! The interval is divided into panels with the same number of nodes each. Where the disc of the integrand around
//! a panel can be found ([`super::disc`]), the panels are as long as the bound of their error allows, found anew for each
//! ray; where it cannot, they are of equal length and nothing is claimed.

use super::arithmetic::{add, call, if_less, mul, scale};
use super::{Integrator, Path, Problem};
use crate::ir::{Id, Loop, Prim, State, Ty};

/// Number of panels of equal length where there is no bound.
pub const PANELS: u32 = 16;
/// Gauss-Legendre nodes of such a panel.
pub const NODES: usize = 6;
/// Gauss-Legendre nodes of a panel with a bound.
pub const BOUNDED_NODES: usize = 8;
/// Greatest error of a panel with a bound, as a part of its length times the greatest |f| found.
pub const TOLERANCE: f64 = 1e-9;
/// A panel that has no bound within the tolerance is accepted at 1/64 of the interval, …
const COARSE: u32 = 64;
/// … 256 of them at as little as 2⁻²⁰ of it: enough for a jump, a kink or a peak that is not known beforehand.
const SPARE: u32 = 256;
const FINE: f64 = 1.0 / 1_048_576.0;
/// Greatest number of panels with a bound.
pub const MAX_PANELS: u32 = COARSE + SPARE + 2;
/// The ellipse with foci at the ends of a panel whose half axes have the sum of this many half-lengths.
const ELLIPSE: f64 = 5.0;

/// How a part of an integrand is integrated numerically.
#[derive(Clone, Debug)]
pub struct Numerical {
    /// The part.
    pub integrand: Id,
    /// Number of panels that are taken and the sum of the bounds of their errors, for the ray; none where there is no
    /// bound.
    pub bound: Option<[Id; 2]>,
    /// The operation without a bound, where there is none.
    pub without: Option<Problem>,
}

/// The leaves of the loop over the panels: the interval is from 0 to 1.
struct Walk {
    /// Where the next panel begins.
    place: Id,
    /// Length of the last panel.
    step: Id,
    /// Panels that may still be shorter than 1/64.
    spare: Id,
    /// Greatest |f| so far.
    size: Id,
    sum: Id,
}

impl Integrator<'_> {
    /// Quadrature alone, on each piece between the places where conditions change, as far as these are known.
    pub(super) fn by_quadrature_alone(&mut self, root: Id) -> Result<Id, Problem> {
        match self.cuts_with_lows(root) {
            Ok(cuts) if !cuts.is_empty() => {
                self.piecewise(root, &cuts, |this, piece| Ok(this.numerically(piece)))
            }
            _ => Ok(self.numerically(root)),
        }
    }

    /// The integral by nodes, with a bound of the error where there is one.
    pub(super) fn numerically(&mut self, root: Id) -> Id {
        if !self.moves(root) {
            let length = self.length_of_path();
            return self.g.mul(length, root);
        }
        let reach = call(self.g, Prim::Abs, self.path.half);
        match self.disc(root, reach) {
            Ok(_) => {
                let value = self.by_panels(root, false);
                let bound = self.by_panels(root, true);
                self.rest.push(Numerical {
                    integrand: root,
                    bound: Some([bound[1], bound[0]]),
                    without: None,
                });
                value[0]
            }
            Err(culprit) => {
                self.rest.push(Numerical {
                    integrand: root,
                    bound: None,
                    without: Some(self.problem(culprit, super::Reason::NotFound)),
                });
                self.composite(root)
            }
        }
    }

    /// The composite rule: 16 panels with 6 Gauss-Legendre nodes each, in a loop. Exact for polynomials to degree 11 on
    /// each panel; the error of an integrand that is analytic around a panel to the distance of r half panels falls as
    /// (r + √(r² - 1))⁻¹².
    ///
    /// Davis and Rabinowitz, Methods of Numerical Integration, 2nd edition, sections 2.7 and 4.6.
    fn composite(&mut self, root: Id) -> Id {
        let whole = self.path.clone();
        let binder = self.g.binder();
        let (sum, counter) = (self.g.new_state(binder, Ty::Real), self.g.counter(binder));
        // panel k goes from h (2 k/n - 1) to h (2 (k + 1)/n - 1) around the middle
        let width = 1.0 / f64::from(PANELS);
        let places = [0.0, 1.0].map(|k| {
            let step = scale(self.g, width, counter);
            let offset = self.g.real(width * k);
            self.g.add(step, offset)
        });
        self.path = self.panel(&whole, places);
        let panel = self.gauss(root, NODES);
        self.path = whole;
        let next = self.g.add(sum, panel);
        let init = self.g.real(0.0);
        let count = self.g.real(f64::from(PANELS));
        let repeated = Loop {
            binder,
            count,
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

    /// The part of an interval between two places, 0 being its begin and 1 its end.
    fn panel(&mut self, whole: &Path, places: [Id; 2]) -> Path {
        let ends = places.map(|place| {
            let twice = scale(self.g, 2.0, place);
            let one = self.g.real(1.0);
            let part = self.g.sub(twice, one);
            let s = self.g.mul(whole.half, part);
            self.g.add(whole.middle, s)
        });
        whole.between(self.g, ends)
    }

    /// Panels with 8 nodes each, as long as the bound of the error allows: the value, or with `measured` the sum of the
    /// bounds and the number of panels.
    ///
    /// On [-1, 1] the rule with n nodes is exact for polynomials of degree 2n - 1 and has positive weights of sum 2. So
    /// its error is at most 4 times the distance of f from such a polynomial, which is at most 2 M ρ^(1 - 2n)/(ρ - 1)
    /// where |f| ≤ M in the ellipse with foci ±1 whose half axes have the sum ρ (Trefethen, Approximation Theory and
    /// Approximation Practice, theorems 8.2 and 19.3). The ellipse is in the disc of radius (ρ + 1/ρ)/2; M is |c| + r.
    /// A panel is halved until that is at most 1e-9 of the greatest |f| in the middles of panels.
    fn by_panels(&mut self, root: Id, measured: bool) -> [Id; 2] {
        let whole = self.path.clone();
        let binder = self.g.binder();
        let mut leaf = || self.g.new_state(binder, Ty::Real);
        let walk = Walk {
            place: leaf(),
            step: leaf(),
            spare: leaf(),
            size: leaf(),
            sum: leaf(),
        };
        let panels = leaf();
        let step = self.length_of_panel(root, &whole, &walk);
        let (one, zero) = (self.g.real(1.0), self.g.real(0.0));
        let next_place = self.g.add(walk.place, step);
        let coarse = self.g.real(1.0 / f64::from(COARSE));
        let fewer = self.g.sub(walk.spare, one);
        let next_spare = if_less(self.g, step, coarse, fewer, walk.spare);
        self.path = self.panel(&whole, [walk.place, next_place]);
        let middle = self.at_middle(root);
        let middle = call(self.g, Prim::Abs, middle);
        let next_size = self.g.apply(Prim::Max, &[walk.size, middle]);
        let part = if measured {
            let most = self.greatest(root, &whole, walk.place, step);
            let half = call(self.g, Prim::Abs, self.path.half);
            let error = mul(self.g, half, most);
            scale(self.g, 2.0 * error_factor(), error)
        } else {
            self.gauss(root, BOUNDED_NODES)
        };
        self.path = whole;
        let next_sum = self.g.add(walk.sum, part);
        let next_panels = self.g.add(panels, one);
        let [a, b] = self.at_ends(root).map(|v| call(self.g, Prim::Abs, v));
        let middle = self.at_middle(root);
        let middle = call(self.g, Prim::Abs, middle);
        let size = self.g.apply(Prim::Max, &[a, b]);
        let size = self.g.apply(Prim::Max, &[size, middle]);
        // what is infinite at an end, as a root in a divisor may be, is no size
        let infinity = self.g.real(f64::INFINITY);
        let size = if_less(self.g, size, infinity, size, zero);
        let spare = self.g.real(f64::from(SPARE));
        let mut states = vec![
            (walk.place, zero, next_place),
            (walk.step, one, step),
            (walk.spare, spare, next_spare),
            (walk.size, size, next_size),
            (walk.sum, zero, next_sum),
        ];
        if measured {
            states.push((panels, zero, next_panels));
        }
        let repeated = Loop {
            binder,
            count: self.g.real(f64::from(MAX_PANELS)),
            limit: MAX_PANELS,
            until: Some(self.g.apply(Prim::LessEqual, &[one, walk.place])),
            states: states
                .into_iter()
                .map(|(leaf, init, next)| State { leaf, init, next })
                .collect(),
        };
        let repeated = self.g.repeat(&repeated);
        let value = self.g.result(repeated, walk.sum);
        if measured {
            [value, self.g.result(repeated, panels)]
        } else {
            [value, value]
        }
    }

    /// Twice the length of the last panel, or the rest, halved until the bound holds or the panel is as short as it may
    /// be.
    fn length_of_panel(&mut self, root: Id, whole: &Path, walk: &Walk) -> Id {
        let binder = self.g.binder();
        let step = self.g.new_state(binder, Ty::Real);
        let one = self.g.real(1.0);
        let rest = self.g.sub(one, walk.place);
        let twice = scale(self.g, 2.0, walk.step);
        let first = self.g.apply(Prim::Min, &[twice, rest]);
        let most = self.greatest(root, whole, walk.place, step);
        let end = self.g.add(walk.place, step);
        let path = self.panel(whole, [walk.place, end]);
        let before = std::mem::replace(&mut self.path, path);
        let middle = self.at_middle(root);
        self.path = before;
        let middle = call(self.g, Prim::Abs, middle);
        let size = self.g.apply(Prim::Max, &[walk.size, middle]);
        let limit = scale(self.g, TOLERANCE / error_factor(), size);
        let holds = self.g.apply(Prim::LessEqual, &[most, limit]);
        let (zero, coarse, fine) = (
            self.g.real(0.0),
            self.g.real(1.0 / f64::from(COARSE)),
            self.g.real(FINE),
        );
        let shortest = if_less(self.g, zero, walk.spare, fine, coarse);
        let is_short = self.g.apply(Prim::LessEqual, &[step, shortest]);
        let next = scale(self.g, 0.5, step);
        let halvings = 22;
        let repeated = Loop {
            binder,
            count: self.g.real(f64::from(halvings)),
            limit: halvings,
            until: Some(self.g.apply(Prim::Or, &[holds, is_short])),
            states: std::iter::once(State {
                leaf: step,
                init: first,
                next,
            })
            .collect(),
        };
        let repeated = self.g.repeat(&repeated);
        self.g.result(repeated, step)
    }

    /// What |f| is at most in the disc around a panel.
    fn greatest(&mut self, root: Id, whole: &Path, place: Id, step: Id) -> Id {
        let end = self.g.add(place, step);
        let path = self.panel(whole, [place, end]);
        let before = std::mem::replace(&mut self.path, path);
        let half = mul(self.g, step, before.half);
        let half = call(self.g, Prim::Abs, half);
        let reach = scale(self.g, 0.5 * (ELLIPSE + 1.0 / ELLIPSE), half);
        let disc = self.disc(root, reach);
        self.path = before;
        match disc {
            Ok(disc) => {
                let size = call(self.g, Prim::Abs, disc.centre);
                add(self.g, size, disc.radius)
            }
            Err(_) => self.g.real(f64::INFINITY),
        }
    }
}

/// The bound of the error of a panel as a part of its length times M: half of 8 ρ^(1 - 2n)/(ρ - 1).
fn error_factor() -> f64 {
    let n = i32::try_from(BOUNDED_NODES).unwrap_or(1);
    4.0 * ELLIPSE.powi(1 - 2 * n) / (ELLIPSE - 1.0)
}
