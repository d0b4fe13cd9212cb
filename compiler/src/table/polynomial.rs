//! Orthogonal polynomials of a degree that is a whole number.

use super::defined::{Partial, named, order};
use super::derivative::{plus, scaled};
use super::whole::known;
use super::{Row, Typing};
use crate::ir::{Graph, Id, Prim};
use crate::table;

/// factor · p(n - 1, …), and 0 of the degree 0; `rest` are the operands behind the degree.
fn lowered(g: &mut Graph, prim: Prim, n: Id, rest: [Id; 2], factor: Id) -> Id {
    let zero = g.real(0.0);
    if known(g, n) == Some(0.0) {
        return zero;
    }
    let below = match known(g, n) {
        Some(n) => g.real(n - 1.0),
        None => plus(g, n, -1.0),
    };
    let args = [below, rest[0], rest[1]];
    let value = g.apply(prim, &args[..table::row(prim).typing.arity()]);
    let slope = g.mul(factor, value);
    if known(g, n).is_some() {
        return slope;
    }
    let constant = g.apply(Prim::Equal, &[n, zero]);
    g.apply(Prim::Select, &[constant, zero, slope])
}

pub fn rows() -> Vec<Row> {
    let row = |prim, names, usage, doc, arity, partial: Partial| {
        let typing = Typing::Analytic(arity);
        named(prim, names, usage, doc, typing, partial, 100)
    };
    vec![
        row(
            Prim::ChebyshevT,
            &["chebyshev_t"],
            "chebyshev_t(n, z)",
            "Chebyshev polynomial of the first kind of degree n, 0 to 50",
            2,
            // n U(n - 1) (DLMF 18.9.21), U being Gegenbauer's polynomial of parameter 1
            |g, args, _, k| match k {
                0 => g.real(0.0),
                _ => {
                    let one = g.real(1.0);
                    lowered(g, Prim::GegenbauerC(0), args[0], [one, args[1]], args[0])
                }
            },
        ),
        row(
            Prim::GegenbauerC(0),
            &["gegenbauer_c"],
            "gegenbauer_c(n, a, z)",
            "Gegenbauer polynomial of degree n, 0 to 50, and parameter a",
            3,
            // 2 a C(n - 1, a + 1) (DLMF 18.9.19), and of the derivative by a that of this product
            |g, args, value, k| match k {
                0 => g.real(0.0),
                1 => {
                    let m = order(g, value);
                    g.apply(Prim::GegenbauerC(m + 1), args)
                }
                _ => {
                    let m = order(g, value);
                    let above = plus(g, args[1], 1.0);
                    let factor = scaled(g, 2.0, args[1]);
                    let rest = [above, args[2]];
                    let slope = lowered(g, Prim::GegenbauerC(m), args[0], rest, factor);
                    if m == 0 {
                        return slope;
                    }
                    let twice = g.real(2.0 * f64::from(m));
                    let more = lowered(g, Prim::GegenbauerC(m - 1), args[0], rest, twice);
                    g.add(slope, more)
                }
            },
        ),
        row(
            Prim::HermiteH,
            &["hermite_h"],
            "hermite_h(n, z)",
            "Hermite polynomial of the physicists, of degree n, 0 to 50",
            2,
            // 2 n H(n - 1) (DLMF 18.9.25)
            |g, args, _, k| match k {
                0 => g.real(0.0),
                _ => {
                    let factor = scaled(g, 2.0, args[0]);
                    lowered(g, Prim::HermiteH, args[0], [args[1], args[1]], factor)
                }
            },
        ),
        row(
            Prim::LaguerreL(0),
            &["laguerre_l"],
            "laguerre_l(n, a, z)",
            "generalized Laguerre polynomial of degree n, 0 to 50, and parameter a",
            3,
            // -L(n - 1, a + 1) (DLMF 18.9.23)
            |g, args, value, k| match k {
                0 => g.real(0.0),
                1 => {
                    let m = order(g, value);
                    g.apply(Prim::LaguerreL(m + 1), args)
                }
                _ => {
                    let prim = Prim::LaguerreL(order(g, value));
                    let above = plus(g, args[1], 1.0);
                    let factor = g.real(-1.0);
                    lowered(g, prim, args[0], [above, args[2]], factor)
                }
            },
        ),
    ]
}
