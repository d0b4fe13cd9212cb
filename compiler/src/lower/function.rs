//! Lowering an expression graph to a naga function.

use std::borrow::Cow;

use naga::{BinaryOperator, Expression, Function, GlobalVariable, Handle, MathFunction, Type};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::body::Body;
use super::branches::Branches;
use super::factors::gathered;
use super::lattice::Cells;
use super::place;
use super::plain::plain;
use super::scaled::powers_in_products;
use super::{Format, LowerError, NagaTypes, NumberTypes, Precision};
use crate::ir::{
    Graph, Id, NO_CALLS, Node, Op, Prim, SINGLE_CALLS, Schedule, Ty, expand_powers, merge_loops,
};
use crate::link::{LinkError, Linker, Provider};
use crate::table::{self, Gpu};

/// Where a scalar input of the graph is found among the function's arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// The whole argument: an `f32`, or a `vec2<f32>` as a complex number.
    Whole(u32),
    /// A component or element of the argument.
    Component(u32, u32),
    /// Two elements of the argument as real and imaginary part.
    Pair(u32, u32, u32),
    /// A component of the argument, a vector from the centre of the view, as a world coordinate.
    Offset(u32, u32),
    /// The whole argument, a vector from the centre of the view, as a complex number of the world.
    OffsetPoint(u32),
}

/// Where a structure of parameters is.
#[derive(Clone, Copy, Debug)]
pub enum Base {
    /// A uniform of the module.
    Uniform(Handle<GlobalVariable>),
    /// An argument of the function.
    Argument(u32),
}

/// Where parameters, clock and footprint come from.
#[derive(Clone, Copy, Debug)]
pub enum Leaves {
    /// Uniforms of the module: the array of parameters, and the structure with `time` and `pixel`.
    Uniforms {
        /// `array<vec4<f32>, 16>`
        params: Handle<GlobalVariable>,
        /// A structure with members `time` and `pixel`, and `center` where inputs are offsets.
        clock: Handle<GlobalVariable>,
    },
    /// The uniform `wide` of the wide libraries, where each number is two words.
    Words(Handle<GlobalVariable>),
    /// Members of a structure: the k-th parameter is the k-th.
    Structure {
        /// What holds it.
        base: Base,
        /// The member that is the clock.
        time: u32,
        /// The member that is the footprint.
        pixel: u32,
    },
    /// Further arguments of the function, found by their names.
    Arguments {
        /// Index of the argument of the first parameter; the k-th parameter is the k-th after it.
        params: u32,
        /// Index of the clock's argument.
        time: u32,
        /// Index of the footprint's argument.
        pixel: u32,
    },
}

/// How results are put together.
#[derive(Clone, Debug)]
pub enum Output {
    /// One node, as it is.
    Node(usize),
    /// Zero of a type.
    Zero(Handle<Type>),
    /// A vector, structure or array.
    Compose(Handle<Type>, Vec<Output>),
    /// Real part of a complex node.
    Re(usize),
    /// Imaginary part of a complex node.
    Im(usize),
    /// The power of two that complex nodes are divided by, as a real (`lower::beyond`).
    Exponent(JetNodes),
    /// The first of these nodes, divided by that power of the others.
    Scaled(usize, JetNodes),
}

/// A complex value and its derivatives by z and by its conjugate, among the roots.
pub type JetNodes = [usize; 3];

/// The shape of the function that is generated.
#[derive(Clone, Debug)]
pub struct Interface {
    /// Its name, arguments and result type.
    pub declaration: Function,
    /// Where each scalar input of the graph is.
    pub inputs: Vec<Argument>,
    /// Where the other leaves are.
    pub leaves: Leaves,
    /// How the roots make up the result; nodes are numbered by their place among the roots.
    pub output: Output,
    /// Which forms of functions are called.
    pub precision: Precision,
    /// Whether arguments and results are numbers of the tier; else they are single precision.
    pub wide: bool,
}

/// Every value deeper than this below the last named one is given a name, because text writers recurse.
const MAX_UNNAMED_DEPTH: u8 = 24;

/// Lowers what the roots depend on.
///
/// # Errors
/// An operation has no form on the GPU, or a library function is missing.
pub fn lower(
    graph: &Graph,
    roots: &[Id],
    interface: Interface,
    linker: &mut Linker,
) -> Result<Function, LowerError> {
    let (graph, roots) = merge_loops(graph, roots);
    let calls = match interface.precision {
        Precision::Fast | Precision::Accurate => SINGLE_CALLS,
        Precision::Extended | Precision::Double => NO_CALLS,
    };
    let (graph, roots) = expand_powers(&graph, &roots, &calls);
    let plain = match interface.precision {
        Precision::Fast => plain(&graph, &roots),
        _ => None,
    };
    let (graph, roots) = match plain {
        Some((graph, roots)) => (Cow::Owned(graph), roots),
        None => (graph, roots),
    };
    let gathered = match interface.precision {
        Precision::Fast | Precision::Accurate => gathered(&graph, &roots),
        _ => None,
    };
    let (graph, roots) = match gathered {
        Some((graph, roots)) => (Cow::Owned(graph), roots),
        None => (graph, roots),
    };
    let graph = graph.as_ref();
    let types = NagaTypes::insert(&mut linker.out.types);
    let format = interface.precision.format();
    let live = graph.reachable(&roots);
    let mut scaled = powers_in_products(graph, &roots, &live, interface.precision);
    let cells = if format.is_wide() {
        Cells::default()
    } else {
        Cells::find(graph, &roots, &live, &mut scaled)
    };
    let mut lowering = Lowering {
        graph,
        types,
        format,
        numbers: NumberTypes::of(linker, format)?,
        wide: interface.wide,
        body: Body::new(interface.declaration),
        inputs: &interface.inputs,
        leaves: interface.leaves,
        precision: interface.precision,
        linker,
        scaled,
        cells,
        live,
        pairs: FxHashMap::default(),
        values: vec![None; graph.nodes().len()],
        depths: vec![0; graph.nodes().len()],
    };
    lowering.declare_leaves();
    lowering.schedule(&roots)?;
    lowering.body.at(pullback_grammar::Span::default());
    let value = lowering.output(&interface.output, &roots)?;
    Ok(lowering.body.finish(value))
}

pub(super) struct Lowering<'g, 'l, 's> {
    pub(super) graph: &'g Graph,
    pub(super) types: NagaTypes,
    pub(super) format: Format,
    pub(super) numbers: NumberTypes,
    /// Whether arguments and results are in the format.
    pub(super) wide: bool,
    pub(super) body: Body,
    pub(super) inputs: &'g [Argument],
    pub(super) leaves: Leaves,
    pub(super) precision: Precision,
    pub(super) linker: &'l mut Linker<'s>,
    live: Vec<bool>,
    /// What the one node computes that needs it: powers in products, hashes of which digits are wanted.
    pub(super) scaled: Vec<bool>,
    pub(super) cells: Cells,
    /// Results of functions that several results need, by function and (first) operand: those that are computed in pairs.
    pub(super) pairs: FxHashMap<(&'static str, Id), Handle<Expression>>,
    pub(super) values: Vec<Option<Handle<Expression>>>,
    /// Levels of unnamed expressions below each value.
    pub(super) depths: Vec<u8>,
}

/// Library functions never call back into generated ones.
struct LibraryOnly;

impl Provider for LibraryOnly {
    fn provide(
        &mut self,
        _: &str,
        _: &Function,
        _: &mut Linker,
    ) -> Result<Option<Function>, LowerError> {
        Ok(None)
    }
}

impl Lowering<'_, '_, '_> {
    /// Literals and arguments first, so that they do not cut the emitted ranges apart.
    fn declare_leaves(&mut self) {
        for k in 0..self.body.function.arguments.len() {
            self.body
                .declare(Expression::FunctionArgument(u32::try_from(k).unwrap_or(0)));
        }
        for (id, node) in self.graph.ids().zip(self.graph.nodes()) {
            if let Op::Const(bits) = node.op
                && self.live[id.index()]
                && let Some(value) = self.constant(f64::from_bits(bits))
            {
                self.values[id.index()] = Some(value);
            }
        }
    }

    /// Whether a result depends on a node.
    pub(super) fn is_live(&self, id: Id) -> bool {
        self.live[id.index()]
    }

    fn schedule(&mut self, roots: &[Id]) -> Result<(), LowerError> {
        let graph = self.graph;
        if !graph.has_loops() && self.cells.is_empty() {
            let branches = Branches::find(graph, roots, &self.live);
            return self.with_branches(&branches, &branches.top);
        }
        let schedule = Schedule::new(graph, roots);
        self.block(&schedule, &schedule.top)
    }

    /// Writes what is computed in one block, loops included.
    pub(super) fn block(&mut self, schedule: &Schedule, ids: &[Id]) -> Result<(), LowerError> {
        for &id in ids {
            match schedule.plan(id) {
                Some(plan) => self.repeat(schedule, plan)?,
                None => self.compute(id)?,
            }
        }
        Ok(())
    }

    pub(super) fn compute(&mut self, id: Id) -> Result<(), LowerError> {
        if self.values[id.index()].is_some() || self.scaled[id.index()] {
            return Ok(());
        }
        self.body.at(self.graph.span(id));
        let value = match self.corner(id)? {
            Some(value) => value,
            None => self.node(self.graph.node(id))?,
        };
        self.keep_value(id, value);
        Ok(())
    }

    /// Remembers the value of an operation, under its name where it has one.
    pub(super) fn keep_value(&mut self, id: Id, value: Handle<Expression>) {
        self.values[id.index()] = Some(value);
        self.name(id, self.graph.node(id), value);
    }

    /// Names a value by the user's name, or where the text would nest too deep.
    fn name(&mut self, id: Id, node: &Node, value: Handle<Expression>) {
        if !matches!(node.op, Op::Apply(_)) {
            return;
        }
        let below = node
            .args
            .iter()
            .map(|a| self.depths[a.index()])
            .max()
            .unwrap_or(0);
        self.depths[id.index()] = below + 1;
        let name = match self.graph.name(id) {
            // the result of a function needs no name in the function itself
            Some(name) if self.body.function.name.as_deref() == Some(name) => return,
            Some(name) => super::identifier(name),
            None if below + 1 >= MAX_UNNAMED_DEPTH => format!("t{}", id.index()),
            None => return,
        };
        self.body.function.named_expressions.insert(value, name);
        self.depths[id.index()] = 0;
    }

    pub(super) fn value(&self, id: Id) -> Result<Handle<Expression>, LowerError> {
        self.values[id.index()].ok_or(LowerError::NoForm("an operand that was not lowered"))
    }

    pub(super) fn argument(&self, k: u32) -> Result<Handle<Expression>, LowerError> {
        // arguments are the first expressions of the body
        let found = self.body.function.expressions.iter().nth(k as usize);
        found
            .map(|(handle, _)| handle)
            .ok_or(LowerError::NoForm("an argument"))
    }

    fn node(&mut self, node: &Node) -> Result<Handle<Expression>, LowerError> {
        match node.op {
            Op::Const(bits) => self.special(f64::from_bits(bits)),
            Op::Truth(value) => Ok(self
                .body
                .declare(Expression::Literal(naga::Literal::Bool(value)))),
            Op::Input(k) => self.input(k, node.ty),
            Op::Param(k) => self.param(k),
            Op::Time => self.clock("time"),
            Op::Pixel => self.clock("pixel"),
            Op::Apply(prim) => self.apply(prim, node),
            Op::Variable(_) | Op::State(..) | Op::Counter(_) | Op::Loop { .. } | Op::Result(_) => {
                Err(LowerError::NoForm("a running variable outside of its loop"))
            }
        }
    }

    /// Infinities and NaN, which shading languages have no literals for.
    fn special(&mut self, value: f64) -> Result<Handle<Expression>, LowerError> {
        let seed = self.constant(0.0).ok_or(LowerError::NoForm("a zero"))?;
        if value.is_nan() {
            return self.library("make_nan", vec![seed]);
        }
        let infinity = self.library("make_infinity", vec![seed])?;
        Ok(if value > 0.0 {
            infinity
        } else {
            self.unary(naga::UnaryOperator::Negate, infinity)
        })
    }

    pub(super) fn library(
        &mut self,
        name: &str,
        arguments: Vec<Handle<Expression>>,
    ) -> Result<Handle<Expression>, LowerError> {
        let function =
            self.linker
                .function(name, &mut LibraryOnly)
                .map_err(|error| match error {
                    LinkError::Missing(_) => LowerError::NoForm(missing_form(name)),
                    error => error.into(),
                })?;
        Ok(self.body.call(function, arguments))
    }

    /// Calls what is defined in the language.
    fn defined(
        &mut self,
        prim: Prim,
        complex: bool,
        arguments: Vec<Handle<Expression>>,
    ) -> Result<Handle<Expression>, LowerError> {
        let function = super::defined::function(self.linker, prim, complex, self.precision)?;
        Ok(self.body.call(function, arguments))
    }

    fn apply(&mut self, prim: Prim, node: &Node) -> Result<Handle<Expression>, LowerError> {
        if prim == Prim::Mul
            && let Some(value) = self.scaled_power(node)?
        {
            return Ok(value);
        }
        if let Some(value) = self.sum_with_square(prim, node)? {
            return Ok(value);
        }
        let mut args: SmallVec<[Handle<Expression>; 3]> = SmallVec::new();
        for &arg in &node.args {
            args.push(self.value(arg)?);
        }
        if let Some(value) = self.paired(prim, node, &args)? {
            return Ok(value);
        }
        let complex = node.args.iter().any(|&a| self.graph.ty(a) == Ty::Complex);
        if complex || node.ty == Ty::Complex {
            return self.apply_complex(prim, node, &args);
        }
        if prim == Prim::Div && self.is_quotient(node.args[0]) {
            // drivers turn (a / b) / c into a / (b c), which overflows or underflows early
            args[0] = self.library("rounded", vec![args[0]])?;
        }
        match table::row(prim).gpu {
            Gpu::Binary(op) => self.operator(op, args[0], args[1]),
            Gpu::Unary(op) => Ok(self.unary(op, args[0])),
            Gpu::Builtin(_) if prim == Prim::MulAdd && self.is_split_place(node) => {
                self.library(place::STAND_IN, args.to_vec())
            }
            Gpu::Builtin(fun) => self.builtin(fun, &args),
            Gpu::Library(_, Some(fun)) if self.precision == Precision::Fast => {
                Ok(self.math(fun, &args))
            }
            Gpu::Library(name, _) => self.library(name, args.to_vec()),
            Gpu::Family(name) => {
                args.extend(self.order(prim));
                self.library(name, args.to_vec())
            }
            Gpu::Defined => self.defined(prim, false, args.to_vec()),
            Gpu::Structural => match prim {
                Prim::Select => Ok(self.select(&args)),
                Prim::PowInt(n) => {
                    let n = self.integer(n);
                    self.library("real_powi", vec![args[0], n])
                }
                _ => Err(LowerError::NoForm(table::row(prim).usage)),
            },
        }
    }

    fn integer(&mut self, n: i32) -> Handle<Expression> {
        self.body
            .declare(Expression::Literal(naga::Literal::I32(n)))
    }

    /// Which member of its family an operation is.
    fn order(&mut self, prim: Prim) -> Option<Handle<Expression>> {
        prim.order().map(|n| self.integer(n.into()))
    }

    fn is_quotient(&self, id: Id) -> bool {
        self.graph.node(id).op == Op::Apply(Prim::Div)
    }

    /// One half of a pair of functions that are computed together, where both are wanted.
    fn paired(
        &mut self,
        prim: Prim,
        node: &Node,
        args: &[Handle<Expression>],
    ) -> Result<Option<Handle<Expression>>, LowerError> {
        let Some(pair) = table::pair(prim) else {
            return Ok(None);
        };
        let operand = node.args[0];
        let partner = self.graph.find_unary(pair.partner, operand);
        let complex = node.ty == Ty::Complex;
        // the fast tier calls built-ins, on reals
        let single = self.precision == Precision::Fast && !complex;
        if single || !partner.is_some_and(|p| self.live[p.index()]) {
            return Ok(None);
        }
        let name = if complex { pair.gpu_complex } else { pair.gpu };
        let both = match self.pairs.get(&(name, operand)) {
            Some(&both) => both,
            None => {
                let both = self.library(name, args.to_vec())?;
                self.pairs.insert((name, operand), both);
                both
            }
        };
        // the wide libraries give a structure of both
        if !complex || self.format.is_wide() {
            return Ok(Some(self.part(both, pair.place)));
        }
        let (re, im) = (
            self.part(both, 2 * pair.place),
            self.part(both, 2 * pair.place + 1),
        );
        Ok(Some(self.complex(re, im)))
    }

    fn apply_complex(
        &mut self,
        prim: Prim,
        node: &Node,
        args: &[Handle<Expression>],
    ) -> Result<Handle<Expression>, LowerError> {
        let is_complex: SmallVec<[bool; 3]> = node
            .args
            .iter()
            .map(|&a| self.graph.ty(a) == Ty::Complex)
            .collect();
        match (prim, args) {
            (Prim::Complex, &[re, im]) => Ok(self.complex(re, im)),
            (Prim::Re, &[z]) => Ok(self.part(z, 0)),
            (Prim::Im, &[z]) => Ok(self.part(z, 1)),
            (Prim::Conj, &[z]) => {
                let (re, im) = (self.part(z, 0), self.part(z, 1));
                let im = self.unary(naga::UnaryOperator::Negate, im);
                Ok(self.complex(re, im))
            }
            (Prim::Neg, &[z]) => Ok(self.complex_negated(z)),
            (Prim::Select, _) => self.complex_select(args),
            (Prim::Equal | Prim::NotEqual, &[a, b]) => self.equal_parts(prim, a, b),
            (Prim::Add | Prim::Sub, &[a, b]) => {
                self.sum(prim, (a, is_complex[0]), (b, is_complex[1]))
            }
            // a square has no cancelling component, a product may
            (Prim::Mul, &[a, b]) if a == b => self.library("complex_square", vec![a]),
            (Prim::Mul, &[a, b]) if !is_complex[0] => {
                self.complex_scaled(BinaryOperator::Multiply, b, a)
            }
            (Prim::Mul, &[a, b]) if !is_complex[1] => {
                self.complex_scaled(BinaryOperator::Multiply, a, b)
            }
            (Prim::Div, &[a, b]) if !is_complex[1] => {
                self.complex_scaled(BinaryOperator::Divide, a, b)
            }
            (Prim::Div, &[a, b]) if !is_complex[0] => {
                let inverse = self.library("complex_inverse", vec![b])?;
                if self.graph.as_real(node.args[0]) == Some(1.0) {
                    return Ok(inverse);
                }
                self.complex_scaled(BinaryOperator::Multiply, inverse, a)
            }
            (Prim::PowInt(-2), &[z]) => self.library("complex_inverse_square", vec![z]),
            (Prim::PowInt(n), &[z]) => {
                let n = self.integer(n);
                self.library("complex_powi", vec![z, n])
            }
            _ => {
                let row = table::row(prim);
                if row.is_defined(true) {
                    return self.defined(prim, true, args.to_vec());
                }
                if row.gpu_complex.is_empty() {
                    return Err(LowerError::NoForm(row.usage));
                }
                let order = self.order(prim);
                self.library(row.gpu_complex, args.iter().copied().chain(order).collect())
            }
        }
    }

    /// Sum or difference; a real operand is not widened, so that no signed zero of the other is lost.
    fn sum(
        &mut self,
        prim: Prim,
        (a, a_complex): (Handle<Expression>, bool),
        (b, b_complex): (Handle<Expression>, bool),
    ) -> Result<Handle<Expression>, LowerError> {
        let op = if prim == Prim::Add {
            BinaryOperator::Add
        } else {
            BinaryOperator::Subtract
        };
        if a_complex && b_complex {
            return self.complex_sum(op, a, b);
        }
        let (re, im) = if a_complex {
            let (re, im) = (self.part(a, 0), self.part(a, 1));
            (self.operator(op, re, b)?, im)
        } else {
            let (re, im) = (self.part(b, 0), self.part(b, 1));
            let re = self.operator(op, a, re)?;
            let im = if prim == Prim::Add {
                im
            } else {
                self.unary(naga::UnaryOperator::Negate, im)
            };
            (re, im)
        };
        Ok(self.complex(re, im))
    }

    fn equal_parts(
        &mut self,
        prim: Prim,
        a: Handle<Expression>,
        b: Handle<Expression>,
    ) -> Result<Handle<Expression>, LowerError> {
        let (each, join) = if prim == Prim::Equal {
            (BinaryOperator::Equal, BinaryOperator::LogicalAnd)
        } else {
            (BinaryOperator::NotEqual, BinaryOperator::LogicalOr)
        };
        let mut parts = [a; 2];
        for (k, part) in (0..).zip(&mut parts) {
            let (a, b) = (self.part(a, k), self.part(b, k));
            *part = self.operator(each, a, b)?;
        }
        Ok(self.binary(join, parts[0], parts[1]))
    }

    pub(super) fn part(&mut self, base: Handle<Expression>, index: u32) -> Handle<Expression> {
        self.body.emit(Expression::AccessIndex { base, index })
    }

    pub(super) fn unary(
        &mut self,
        op: naga::UnaryOperator,
        expr: Handle<Expression>,
    ) -> Handle<Expression> {
        self.body.emit(Expression::Unary { op, expr })
    }

    pub(super) fn binary(
        &mut self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Handle<Expression> {
        self.body.emit(Expression::Binary { op, left, right })
    }

    pub(super) fn math(
        &mut self,
        fun: MathFunction,
        args: &[Handle<Expression>],
    ) -> Handle<Expression> {
        let (arg1, arg2) = (args.get(1).copied(), args.get(2).copied());
        self.body.emit(Expression::Math {
            fun,
            arg: args[0],
            arg1,
            arg2,
            arg3: None,
        })
    }

    pub(super) fn select(&mut self, args: &[Handle<Expression>]) -> Handle<Expression> {
        self.body.emit(Expression::Select {
            condition: args[0],
            accept: args[1],
            reject: args[2],
        })
    }

    fn output(&mut self, output: &Output, roots: &[Id]) -> Result<Handle<Expression>, LowerError> {
        let root = |k: &usize| roots.get(*k).copied().ok_or(LowerError::NoForm("a result"));
        Ok(match output {
            Output::Node(k) => self.returned(root(k)?)?,
            Output::Re(k) => self.returned_part(root(k)?, 0)?,
            Output::Im(k) => self.returned_part(root(k)?, 1)?,
            Output::Exponent(jet) => {
                let jet = [root(&jet[0])?, root(&jet[1])?, root(&jet[2])?];
                self.exponent(jet)?
            }
            Output::Scaled(k, jet) => {
                let jet = [root(&jet[0])?, root(&jet[1])?, root(&jet[2])?];
                self.scaled_by_exponent(root(k)?, jet)?
            }
            Output::Zero(ty) => self.body.declare(Expression::ZeroValue(*ty)),
            Output::Compose(ty, parts) => {
                let components = parts
                    .iter()
                    .map(|p| self.output(p, roots))
                    .collect::<Result<_, _>>()?;
                self.body.emit(Expression::Compose {
                    ty: *ty,
                    components,
                })
            }
        })
    }

    /// A result, in the format of the function's results.
    pub(super) fn returned(&mut self, root: Id) -> Result<Handle<Expression>, LowerError> {
        let value = self.value(root)?;
        match self.graph.ty(root) {
            Ty::Real if self.converts() => self.narrowed(value),
            Ty::Complex if self.converts() => {
                let components = vec![self.returned_part(root, 0)?, self.returned_part(root, 1)?];
                let ty = self.types.vec2;
                Ok(self.body.emit(Expression::Compose { ty, components }))
            }
            _ => Ok(value),
        }
    }

    fn returned_part(&mut self, root: Id, index: u32) -> Result<Handle<Expression>, LowerError> {
        let z = self.value(root)?;
        let part = self.part(z, index);
        if self.converts() {
            self.narrowed(part)
        } else {
            Ok(part)
        }
    }
}

fn missing_form(name: &str) -> &'static str {
    table::rows()
        .iter()
        .find(|row| {
            row.gpu_complex == name
                || matches!(row.gpu, Gpu::Library(own, _) | Gpu::Family(own) if own == name)
        })
        .map_or("a library function", |row| row.usage)
}
