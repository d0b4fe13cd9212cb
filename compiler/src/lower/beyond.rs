//! Numbers of doubles beyond the range of single precision, for templates that take a power of two apart.
//!
//! A value and its derivatives are all divided by 2^e with one e, which is 0 but where single precision could not hold them. Other
//! formats have the range of single precision, and e is 0.

use naga::{Expression, Handle};

use super::function::Lowering;
use super::{LowerError, Precision};
use crate::ir::Id;

/// The library function of e.
const EXPONENT: &str = "complex_beyond";

impl Lowering<'_, '_, '_> {
    fn takes_powers_apart(&self) -> bool {
        self.precision == Precision::Double && self.converts()
    }

    /// e of a value and its derivatives by z and its conjugate, all complex, as an `f32`.
    pub(super) fn exponent(&mut self, jet: [Id; 3]) -> Result<Handle<Expression>, LowerError> {
        if !self.takes_powers_apart() {
            let zero = Expression::ZeroValue(self.types.real);
            return Ok(self.body.declare(zero));
        }
        let key = (EXPONENT, jet[0]);
        if let Some(&known) = self.pairs.get(&key) {
            return Ok(known);
        }
        let mut arguments = Vec::new();
        for id in jet {
            arguments.push(self.value(id)?);
        }
        let found = self.library(EXPONENT, arguments)?;
        self.pairs.insert(key, found);
        Ok(found)
    }

    /// A complex root divided by 2^e, as a `vec2<f32>`.
    pub(super) fn scaled_by_exponent(
        &mut self,
        root: Id,
        jet: [Id; 3],
    ) -> Result<Handle<Expression>, LowerError> {
        if !self.takes_powers_apart() {
            return self.returned(root);
        }
        let exponent = self.exponent(jet)?;
        let z = self.value(root)?;
        let mut components = Vec::new();
        for k in 0..2 {
            let part = self.part(z, k);
            components.push(self.library("real_to_f32_beyond", vec![part, exponent])?);
        }
        let ty = self.types.vec2;
        Ok(self.body.emit(Expression::Compose { ty, components }))
    }
}
