//! Products with a power as one call: b·a^(b-1) may be an ordinary number where the power alone is none.

use naga::{Expression, Handle};

use super::function::Lowering;
use super::{LowerError, Precision};
use crate::ir::{Graph, Id, Node, Op, Prim, Regions, Ty};

/// For each node, whether it is a real power that nothing but one product needs: it is computed there. Not where the product
/// is computed in the steps of a loop that the power is not part of.
pub(super) fn powers_in_products(
    graph: &Graph,
    roots: &[Id],
    live: &[bool],
    precision: Precision,
) -> Vec<bool> {
    let mut scaled = vec![false; live.len()];
    if precision != Precision::Accurate {
        return scaled;
    }
    let regions = graph.has_loops().then(|| Regions::new(graph, live));
    let together = |a: Id, b: Id| {
        let same = |regions: &Regions| regions.innermost(a) == regions.innermost(b);
        regions.as_ref().is_none_or(same)
    };
    let mut users = vec![0_u32; live.len()];
    for root in roots {
        users[root.index()] += 1;
    }
    let nodes = || {
        graph
            .ids()
            .zip(graph.nodes())
            .filter(|(id, _)| live[id.index()])
    };
    for arg in nodes().flat_map(|(_, node)| &node.args) {
        users[arg.index()] += 1;
    }
    for (id, node) in nodes() {
        if node.op != Op::Apply(Prim::Mul) || node.ty != Ty::Real {
            continue;
        }
        let &[a, b] = node.args.as_slice() else {
            continue;
        };
        for (power, factor) in [(b, a), (a, b)] {
            let fits = match graph.node(power).op {
                Op::Apply(Prim::PowShift) => true,
                // of a derivative by a constant exponent
                Op::Apply(Prim::Pow) => {
                    graph.as_real(factor).is_some() || is_log_of_base(graph, factor, power)
                }
                _ => false,
            };
            let once = users[power.index()] == 1 && together(power, id);
            if fits && once && graph.ty(factor) == Ty::Real {
                scaled[power.index()] = true;
                break;
            }
        }
    }
    scaled
}

/// Whether a factor is log a beside the real power a^b: the derivative by the exponent, which is an ordinary number where
/// the power may be a subnormal one. There the power is computed twice.
fn is_log_of_base(graph: &Graph, factor: Id, power: Id) -> bool {
    let (log, power) = (graph.node(factor), graph.node(power));
    log.op == Op::Apply(Prim::Log)
        && matches!(power.op, Op::Apply(Prim::Pow | Prim::PowShift))
        && power.ty == Ty::Real
        && power.args.first() == log.args.first()
}

impl Lowering<'_, '_, '_> {
    /// A product with a power that was left to it.
    pub(super) fn scaled_power(
        &mut self,
        node: &Node,
    ) -> Result<Option<Handle<Expression>>, LowerError> {
        let &[a, b] = node.args.as_slice() else {
            return Ok(None);
        };
        for (power, factor) in [(b, a), (a, b)] {
            let by_exponent =
                self.precision == Precision::Accurate && is_log_of_base(self.graph, factor, power);
            if !self.scaled[power.index()] && !by_exponent {
                continue;
            }
            let power = self.graph.node(power);
            let mut args = vec![self.value(power.args[0])?, self.value(power.args[1])?];
            args.push(match power.args.get(2) {
                Some(&shift) => self.value(shift)?,
                None => self.body.literal(0.0),
            });
            args.push(self.value(factor)?);
            return self.library("real_scaled_power", args).map(Some);
        }
        Ok(None)
    }
}
