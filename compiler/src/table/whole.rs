//! Operands that must be whole numbers, such as the order of a Bessel function.

use crate::ir::{Graph, Id, Prim};

/// What an operand must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Whole {
    /// Which operand.
    pub place: usize,
    /// What it is: `order`, `degree`.
    pub what: &'static str,
    /// The least that is taken.
    pub least: i32,
    /// The greatest that is taken.
    pub most: i32,
}

/// The operand of an operation that must be a whole number, of reals or of complex numbers.
#[must_use]
pub fn whole(prim: Prim, complex: bool) -> Option<Whole> {
    let first = |what, least, most| Whole {
        place: 0,
        what,
        least,
        most,
    };
    match prim {
        Prim::BesselJ if complex => Some(first("order", -10, 10)),
        Prim::BesselJ | Prim::BesselY | Prim::BesselI | Prim::BesselK => {
            Some(first("order", -50, 50))
        }
        Prim::ChebyshevT | Prim::GegenbauerC(_) | Prim::HermiteH | Prim::LaguerreL(_) => {
            Some(first("degree", 0, 50))
        }
        Prim::LambertW if !complex => Some(Whole {
            place: 1,
            what: "branch",
            least: -1,
            most: 0,
        }),
        Prim::LambertW => Some(Whole {
            place: 1,
            what: "branch",
            least: -1_000_000,
            most: 1_000_000,
        }),
        _ => None,
    }
}

/// The value of an operand that is a real constant, also where it stands among complex ones.
pub(super) fn known(g: &Graph, id: Id) -> Option<f64> {
    let complex = || g.as_complex(id).filter(|(_, im)| *im == 0.0);
    g.as_real(id).or_else(|| complex().map(|(re, _)| re))
}
