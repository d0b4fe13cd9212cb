//! What is known of a scene's function in the scene's box.

use naga::{Block, Expression, Function, Literal, Module, Range, Span, Statement};

use crate::derive::{Majorant, majorant};
use crate::ir::{Graph, Id, Ty, cost};
use crate::program::{Picture, SettingValue};
use crate::scene::{Space, setting_component};

/// The function that tells it to a scene: (at least |f|, at least the norm of the matrix of second derivatives),
/// negative where that is not known or no help.
const TELLER: &str = "field_bounds";
/// The function that begins loops of one or more places where f is called, so that drivers do not copy it.
const BEGINNER: &str = "first_turn";
/// A function that costs no more than this may be copied, in additions.
const SHORT: u32 = 32;
/// Where f bends by more than this part of what it may change in a step, values of samples are no good sign of extrema between
/// them: too many say that there may be one. (A measured number: neovius.pull has 0.06, and was slower with it.)
const LITTLE: f64 = 0.05;
/// Part of the box by which rays may leave it by rounding.
const ROOM: f64 = 1e-3;

/// A real function of x, y and z.
#[derive(Clone, Debug)]
pub(super) struct Field {
    graph: Graph,
    root: Id,
}

impl Field {
    /// The function that a scene of space shows.
    pub(super) fn of(picture: &Picture) -> Option<Self> {
        let formula = &picture.formula;
        let is_spatial = picture.scene.space == Space::Space;
        let reals = formula.scalars().iter().all(|ty| *ty == Ty::Real);
        if !(is_spatial && reals) {
            return None;
        }
        let (graph, roots) = formula.graph.compacted(&formula.value);
        let root = *roots.first()?;
        Some(Self { graph, root })
    }

    /// Bounds of it in the box of these settings: of itself, and of its second derivatives if their help is any.
    fn bounds(&self, settings: &[SettingValue]) -> Option<[f64; 2]> {
        let found = self.majorant(settings)?;
        let step = step(settings)?;
        let is_little = 0.5 * found.curvature * step <= LITTLE * found.slope;
        Some([found.value, if is_little { found.curvature } else { -1.0 }])
    }

    /// Whether it costs a driver little to have it more than once.
    fn is_short(&self) -> bool {
        cost(&self.graph, &[self.root]).weighted <= SHORT
    }

    fn majorant(&self, settings: &[SettingValue]) -> Option<Majorant> {
        let component = |name: &str, k| setting_component(settings, name, k);
        let mut reach = [0.0; 3];
        for (k, reach) in reach.iter_mut().enumerate() {
            let half = component("box", k)?.abs();
            let center = component("center", k)?.abs();
            *reach = center + half + ROOM * half;
        }
        majorant(&self.graph, self.root, reach)
    }
}

/// World units between samples of a ray along the diagonal of the box.
fn step(settings: &[SettingValue]) -> Option<f64> {
    let component = |name: &str, k| setting_component(settings, name, k);
    let half = [0, 1, 2].map(|k| component("box", k).unwrap_or(0.0));
    let diagonal = 2.0 * half.iter().map(|x| x * x).sum::<f64>().sqrt();
    Some(diagonal / component("steps", 0)?)
}

/// Lets the module know.
pub(super) fn tell(module: &mut Module, field: &Field, settings: &[SettingValue]) {
    for (_, function) in module.functions.iter_mut() {
        match function.name.as_deref() {
            Some(TELLER) => {
                if let Some(bounds) = field.bounds(settings) {
                    let bounds = bounds.map(|x| Literal::F32(rounded_up(x)));
                    return_literals(function, &bounds);
                }
            }
            Some(BEGINNER) if field.is_short() => return_literals(function, &[Literal::U32(0)]),
            _ => {}
        }
    }
}

fn rounded_up(x: f64) -> f32 {
    #[allow(clippy::cast_possible_truncation, reason = "the next one is greater")]
    let near = x as f32;
    near.next_up()
}

/// Makes a function return this number or, of several, this vector, whatever it has done.
fn return_literals(function: &mut Function, parts: &[Literal]) {
    let Some(result) = &function.result else {
        return;
    };
    let ty = result.ty;
    let mut own = Function {
        name: function.name.take(),
        arguments: std::mem::take(&mut function.arguments),
        result: function.result.take(),
        ..Function::default()
    };
    let mut add = |expression| own.expressions.append(expression, Span::UNDEFINED);
    let parts = parts.iter().map(|part| add(Expression::Literal(*part)));
    let components: Vec<_> = parts.collect();
    let mut body = Block::new();
    let value = match components[..] {
        [only] => only,
        _ => {
            let whole = add(Expression::Compose { ty, components });
            let emit = Statement::Emit(Range::new_from_bounds(whole, whole));
            body.push(emit, Span::UNDEFINED);
            whole
        }
    };
    let value = Some(value);
    body.push(Statement::Return { value }, Span::UNDEFINED);
    own.body = body;
    *function = own;
}
