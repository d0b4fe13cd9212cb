//! The complementary error function of what changes evenly: erfc.

use super::Integrator;
use super::arithmetic::{call, if_less, mul, scale};
use super::exponential::NEAR;
use super::legendre::nodes_for_exponential;
use crate::ir::{Id, Prim};

impl Integrator<'_> {
    /// ∫ erfc x by T(x) = ∫ₓ^∞ erfc = e^(-x²) (e^(x²) i¹erfc |x|) - 2x where x < 0: the tails keep their digits. Nodes of
    /// the function where the exponent -x² changes by little more than 1.
    ///
    /// NIST DLMF 7.18.
    pub(super) fn complementary(&mut self, of: Id) -> Id {
        let x = self.affine(of);
        let (zero, one) = (self.g.real(0.0), self.g.real(1.0));
        let w = mul(self.g, x.slope, self.path.half);
        let [w_size, mid] = [w, x.mid].map(|v| call(self.g, Prim::Abs, v));
        let tails = x.ends.map(|end| self.falling_tail(end));
        let width = scale(self.g, 2.0, w);
        let difference = self.g.sub(tails[0], tails[1]);
        let tails = self.g.div(difference, width);
        // the part of the interval that is left of 0, where erfc is 2 less what it is on the right
        let low = self.g.apply(Prim::Min, &x.ends);
        let high = self.g.apply(Prim::Max, &x.ends);
        let left = self.g.div(low, width);
        let left = call(self.g, Prim::Abs, left);
        let left = if_less(self.g, high, zero, one, left);
        let left = if_less(self.g, low, zero, left, zero);
        let left = scale(self.g, 2.0, left);
        let far = self.g.add(left, tails);
        let function = call(self.g, Prim::Erfc, of);
        let near = self.local_gauss(function, nodes_for_exponential(2.0, 0, NEAR));
        let reach = self.g.add(one, mid);
        let change = self.g.mul(reach, w_size);
        let length = self.length_of_path();
        let far = mul(self.g, length, far);
        let limit = self.g.real(0.5);
        if_less(self.g, change, limit, near, far)
    }

    /// ∫ erfc from |x| to ∞.
    fn falling_tail(&mut self, x: Id) -> Id {
        // its derivative at 0 is that from the right
        let (zero, back) = (self.g.real(0.0), self.g.neg(x));
        let size = if_less(self.g, x, zero, back, x);
        let bell = call(self.g, Prim::Gauss, size);
        let scaled = self.g.apply(Prim::Erfcx(1), &[size]);
        mul(self.g, bell, scaled)
    }

    /// ∫ erfc from x to ∞.
    pub(super) fn tail_of_complementary(&mut self, x: Id) -> Id {
        let zero = self.g.real(0.0);
        let tail = self.falling_tail(x);
        let twice = scale(self.g, -2.0, x);
        let left = self.g.add(twice, tail);
        if_less(self.g, x, zero, left, tail)
    }
}
