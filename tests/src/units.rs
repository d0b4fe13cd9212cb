//! No finite differences: dimensional analysis of a scene template.
//!
//! A stub gives values (unit V), and derivatives (V per length L) that are exact. A finite difference is a quantity
//! in V/L that was not one before: a value divided by a distance, whatever the steps between; or the difference of
//! two evaluations, divided or multiplied by anything that is itself no value, because a distance may also hide in
//! a constant or a setting. The analysis follows units through expressions, variables, structures and calls, and
//! reports every operation that makes such a quantity. Ratios of values, as root finders take them, are none; nor is
//! a value divided by a slope, which is a distance.
//!
//! What it does not see: a difference taken inside of a library function (those get no stub), one hidden behind
//! a transcendental function, whose argument is a number, and one of members of a jet that was put together of two.

use std::collections::{BTreeMap, BTreeSet};

use naga::valid::{Capabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator};
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, MathFunction, Module, Statement, Type,
    TypeInner, UnaryOperator,
};

/// Stubs that the compiler fills in, with what is in the components of their results.
pub const FIELD_STUBS: [&str; 10] = [
    "field",
    "field_grad",
    "field_integral",
    "field_column",
    "field_jet2",
    "field_ray",
    "map",
    "map_jet",
    "chart_jet",
    "chart_jet_inverse",
];

/// Where a value comes from: a call in this function, or somewhere else (0).
type Origin = usize;

/// A possible unit of a quantity: powers of V and L, the evaluation, and whether it is a difference of evaluations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Unit {
    value: i8,
    length: i8,
    origin: Origin,
    difference: bool,
}

const NUMBER: Unit = Unit {
    value: 0,
    length: 0,
    origin: 0,
    difference: false,
};
const LENGTH: Unit = Unit {
    length: 1,
    ..NUMBER
};

impl Unit {
    fn of_value(origin: Origin) -> Self {
        Self {
            value: 1,
            origin,
            ..NUMBER
        }
    }

    fn of_slope(origin: Origin) -> Self {
        Self {
            value: 1,
            length: -1,
            origin,
            ..NUMBER
        }
    }
}

/// Possible units; none for a number.
type Units = BTreeSet<Unit>;

/// A place that holds a quantity between expressions.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Local(Handle<Function>, usize),
    Argument(Handle<Function>, usize),
    Result(Handle<Function>),
    Member(String, usize),
}

struct Analysis<'m> {
    module: &'m Module,
    info: ModuleInfo,
    places: BTreeMap<Place, Units>,
    changed: bool,
    found: BTreeSet<String>,
}

/// Every operation of a template that makes a finite difference.
///
/// # Panics
/// The template is not valid.
#[must_use]
pub fn finite_differences(module: &Module) -> Vec<String> {
    let info = Validator::new(ValidationFlags::all(), Capabilities::default())
        .validate(module)
        .expect("a valid template");
    let mut analysis = Analysis {
        module,
        info,
        places: BTreeMap::new(),
        changed: true,
        found: BTreeSet::new(),
    };
    analysis.seed();
    for _ in 0..100 {
        if !std::mem::take(&mut analysis.changed) {
            break;
        }
        analysis.found.clear();
        for (handle, function) in module.functions.iter() {
            analysis.function(handle, function);
        }
    }
    analysis.found.into_iter().collect()
}

/// How often a function can run per picture sample: `None` where it is in a loop. Branches count with their greatest.
#[must_use]
pub fn evaluations(module: &Module, name: &str) -> Option<usize> {
    let (handle, _) = module
        .functions
        .iter()
        .find(|(_, f)| f.name.as_deref() == Some(name))?;
    in_function(module, handle)
}

/// How many calls of `callee` a function has when all that it calls is copied into it, as drivers do.
#[must_use]
pub fn copies(module: &Module, name: &str, callee: &str) -> usize {
    let named = |f: &Function| f.name.as_deref() == Some(name);
    let Some((_, function)) = module.functions.iter().find(|(_, f)| named(f)) else {
        return 0;
    };
    copies_in(module, &function.body, callee)
}

fn copies_in(module: &Module, block: &Block, callee: &str) -> usize {
    let within = |block: &Block| copies_in(module, block, callee);
    let in_statement = |statement: &Statement| match statement {
        Statement::Call { function, .. } => {
            let called = &module.functions[*function];
            usize::from(called.name.as_deref() == Some(callee)) + within(&called.body)
        }
        Statement::Block(inner) => within(inner),
        Statement::If { accept, reject, .. } => within(accept) + within(reject),
        Statement::Switch { cases, .. } => cases.iter().map(|case| within(&case.body)).sum(),
        Statement::Loop {
            body, continuing, ..
        } => within(body) + within(continuing),
        _ => 0,
    };
    block.iter().map(in_statement).sum()
}

fn in_function(module: &Module, handle: Handle<Function>) -> Option<usize> {
    let function = &module.functions[handle];
    if function
        .name
        .as_deref()
        .is_some_and(|n| FIELD_STUBS.contains(&n))
    {
        return Some(1);
    }
    in_block(module, &function.body)
}

fn in_block(module: &Module, block: &Block) -> Option<usize> {
    let mut count = 0;
    for statement in block {
        count += match statement {
            Statement::Call { function, .. } => in_function(module, *function)?,
            Statement::Block(inner) => in_block(module, inner)?,
            Statement::If { accept, reject, .. } => {
                in_block(module, accept)?.max(in_block(module, reject)?)
            }
            Statement::Switch { cases, .. } => {
                let counts: Option<Vec<usize>> = cases
                    .iter()
                    .map(|case| in_block(module, &case.body))
                    .collect();
                counts?.into_iter().max().unwrap_or(0)
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                let once = in_block(module, body)? + in_block(module, continuing)?;
                if once > 0 {
                    return None;
                }
                0
            }
            _ => 0,
        };
    }
    Some(count)
}

impl Analysis<'_> {
    /// Lengths come from the pixel, the view and the ray.
    fn seed(&mut self) {
        let lengths = [("View", "center"), ("View", "pixel"), ("Ray", "origin")];
        for (_, ty) in self.module.types.iter() {
            let (Some(name), TypeInner::Struct { members, .. }) = (&ty.name, &ty.inner) else {
                continue;
            };
            for (k, member) in members.iter().enumerate() {
                let member = member.name.as_deref().unwrap_or_default();
                if lengths.contains(&(name.as_str(), member)) {
                    self.places
                        .insert(Place::Member(name.clone(), k), Units::from([LENGTH]));
                }
                let is_number = ["exponent", "branches"].contains(&member);
                if (name == "Jet" || name == "Jet2") && !is_number {
                    let unit = if k == 0 {
                        Unit::of_value(0)
                    } else {
                        Unit::of_slope(0)
                    };
                    self.places
                        .insert(Place::Member(name.clone(), k), Units::from([unit]));
                }
            }
        }
        for (handle, function) in self.module.functions.iter() {
            if function.name.as_deref() == Some("shade") {
                self.places
                    .insert(Place::Argument(handle, 0), Units::from([LENGTH]));
            }
        }
    }

    fn is_jet(place: &Place) -> bool {
        matches!(place, Place::Member(name, _) if name == "Jet" || name == "Jet2")
    }

    fn read(&self, place: &Place) -> Units {
        self.places.get(place).cloned().unwrap_or_default()
    }

    /// Adds to what a place holds; outside of its function, an evaluation is any evaluation.
    fn write(&mut self, place: Place, units: &Units) {
        let held = self.places.entry(place).or_default();
        let before = held.len();
        held.extend(units.iter().map(|u| Unit { origin: 0, ..*u }));
        self.changed |= held.len() > before;
    }

    fn function(&mut self, handle: Handle<Function>, function: &Function) {
        let name = function.name.clone().unwrap_or_default();
        let calls = call_results(&function.body);
        let mut units: Vec<Units> = Vec::new();
        for (at, expression) in function.expressions.iter() {
            let found = self.expression(handle, function, &name, at, expression, &units, &calls);
            units.push(found);
        }
        self.block(handle, function, &function.body, &units);
    }

    #[allow(clippy::too_many_arguments, reason = "the state of one walk")]
    fn expression(
        &mut self,
        handle: Handle<Function>,
        function: &Function,
        name: &str,
        at: Handle<Expression>,
        expression: &Expression,
        units: &[Units],
        calls: &BTreeMap<Handle<Expression>, Handle<Function>>,
    ) -> Units {
        let of = |h: Handle<Expression>| units[h.index()].clone();
        match *expression {
            Expression::FunctionArgument(k) => self.read(&Place::Argument(handle, k as usize)),
            Expression::LocalVariable(v) => self.read(&Place::Local(handle, v.index())),
            Expression::Load { pointer } => of(pointer)
                .into_iter()
                .map(|u| Unit { origin: 0, ..u })
                .collect(),
            Expression::Access { base, .. } => of(base),
            Expression::AccessIndex { base, index } => {
                match self.member(handle, base, index as usize) {
                    // a jet is of one point
                    Some(place) if Self::is_jet(&place) => of_one(self.read(&place), base),
                    Some(place) => self.read(&place),
                    None => component(
                        &of(base),
                        packed(self.module, function, base, calls),
                        &[index],
                    ),
                }
            }
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let letters: Vec<u32> = pattern
                    .iter()
                    .take(size as usize)
                    .map(|c| *c as u32)
                    .collect();
                component(
                    &of(vector),
                    packed(self.module, function, vector, calls),
                    &letters,
                )
            }
            Expression::Splat { value, .. } => of(value),
            Expression::Compose { ty, ref components } => {
                let parts: Vec<Units> = components.iter().map(|c| of(*c)).collect();
                if let Some(title) = struct_name(self.module, ty) {
                    for (k, part) in parts.iter().enumerate() {
                        self.write(Place::Member(title.clone(), k), part);
                    }
                }
                parts.into_iter().flatten().collect()
            }
            Expression::Select { accept, reject, .. } => &of(accept) | &of(reject),
            Expression::Unary {
                op: UnaryOperator::Negate,
                expr,
            } => of(expr),
            Expression::As { expr, .. } => of(expr),
            Expression::Binary { op, left, right } => self.binary(name, op, &of(left), &of(right)),
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                ..
            } => {
                let rest: Vec<Units> = [arg1, arg2].into_iter().flatten().map(of).collect();
                self.math(name, fun, &of(arg), &rest)
            }
            Expression::CallResult(callee) => self.result(callee, at, units, function),
            _ => Units::new(),
        }
    }

    /// The member of a structure that is accessed, if `base` is one or points to one.
    fn member(
        &self,
        handle: Handle<Function>,
        base: Handle<Expression>,
        k: usize,
    ) -> Option<Place> {
        let info: &FunctionInfo = &self.info[handle];
        let resolution = &info[base].ty;
        let ty = match resolution.inner_with(&self.module.types) {
            TypeInner::Pointer { base, .. } => *base,
            TypeInner::Struct { .. } => resolution.handle()?,
            _ => return None,
        };
        Some(Place::Member(struct_name(self.module, ty)?, k))
    }

    /// What a call gives. Of the library, only what keeps or makes a unit is listed; the rest gives numbers.
    fn result(
        &mut self,
        callee: Handle<Function>,
        at: Handle<Expression>,
        units: &[Units],
        function: &Function,
    ) -> Units {
        let title = self.module.functions[callee]
            .name
            .as_deref()
            .unwrap_or_default();
        let site = at.index() + 1;
        match title {
            "field" | "map" => Units::from([Unit::of_value(site)]),
            "field_grad" | "field_ray" => Units::from([Unit::of_value(site), Unit::of_slope(site)]),
            "box_span" => Units::from([LENGTH]),
            "length2_safe" | "length3_safe" | "magnify_tiny" => arguments_of(&function.body, at)
                .iter()
                .flat_map(|a| units[a.index()].clone())
                .collect(),
            _ => self.read(&Place::Result(callee)),
        }
    }

    fn block(
        &mut self,
        handle: Handle<Function>,
        function: &Function,
        block: &Block,
        units: &[Units],
    ) {
        for statement in block {
            match statement {
                Statement::Store { pointer, value } => {
                    if let Some(place) = self.stored(handle, function, *pointer) {
                        self.write(place, &units[value.index()]);
                    }
                }
                Statement::Return { value: Some(value) } => {
                    self.write(Place::Result(handle), &units[value.index()]);
                }
                Statement::Call {
                    function: callee,
                    arguments,
                    ..
                } => {
                    for (k, argument) in arguments.iter().enumerate() {
                        self.write(Place::Argument(*callee, k), &units[argument.index()]);
                    }
                }
                Statement::Block(inner) => self.block(handle, function, inner, units),
                Statement::If { accept, reject, .. } => {
                    self.block(handle, function, accept, units);
                    self.block(handle, function, reject, units);
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        self.block(handle, function, &case.body, units);
                    }
                }
                Statement::Loop {
                    body, continuing, ..
                } => {
                    self.block(handle, function, body, units);
                    self.block(handle, function, continuing, units);
                }
                _ => {}
            }
        }
    }

    fn stored(
        &self,
        handle: Handle<Function>,
        function: &Function,
        pointer: Handle<Expression>,
    ) -> Option<Place> {
        match function.expressions[pointer] {
            Expression::LocalVariable(v) => Some(Place::Local(handle, v.index())),
            Expression::AccessIndex { base, index } => self
                .member(handle, base, index as usize)
                .or_else(|| self.stored(handle, function, base)),
            Expression::Access { base, .. } => self.stored(handle, function, base),
            _ => None,
        }
    }

    fn binary(&mut self, name: &str, op: BinaryOperator, left: &Units, right: &Units) -> Units {
        match op {
            BinaryOperator::Add => left | right,
            BinaryOperator::Subtract => difference(left, right),
            BinaryOperator::Multiply => self.product(name, "*", left, right, 1),
            BinaryOperator::Divide => self.product(name, "/", left, right, -1),
            BinaryOperator::Modulo => left.clone(),
            _ => Units::new(),
        }
    }

    fn product(&mut self, name: &str, sign: &str, left: &Units, right: &Units, power: i8) -> Units {
        let number = Units::from([NUMBER]);
        let or_number = |units: &Units| {
            if units.is_empty() {
                number.clone()
            } else {
                units.clone()
            }
        };
        let mut out = Units::new();
        for a in or_number(left) {
            for b in or_number(right) {
                let b = Unit {
                    value: power * b.value,
                    length: power * b.length,
                    ..b
                };
                let (value, length) = (a.value + b.value, a.length + b.length);
                let per_length = value > 0 && length < 0 && {
                    let of_values = if a.value > 0 { a } else { b };
                    length < of_values.length
                };
                let lone = (a.difference && a.value != 0 && b.value == 0)
                    || (b.difference && b.value != 0 && a.value == 0);
                // one over a difference is no difference quotient yet
                let inverse = b.difference && b.value < 0 && a.value == 0;
                if per_length || (lone && !inverse) {
                    self.found.insert(format!("`{name}`: {a:?} {sign} {b:?}"));
                }
                if value.abs() <= 2 && length.abs() <= 3 && (value, length) != (0, 0) {
                    let origin = if a.value == 0 {
                        b.origin
                    } else if b.value == 0 {
                        a.origin
                    } else {
                        0
                    };
                    let kept = (a.difference && b.value == 0) || (b.difference && a.value == 0);
                    out.insert(Unit {
                        value,
                        length,
                        origin,
                        difference: kept,
                    });
                }
            }
        }
        out
    }

    fn math(&mut self, name: &str, fun: MathFunction, arg: &Units, rest: &[Units]) -> Units {
        use MathFunction as F;
        let second = rest.first().cloned().unwrap_or_default();
        match fun {
            F::Min | F::Max | F::Clamp | F::Mix => {
                let ends = if fun == F::Mix { &rest[..1] } else { rest };
                ends.iter().fold(arg.clone(), |all, units| &all | units)
            }
            F::Distance => difference(arg, &second),
            F::Dot | F::Cross => self.product(name, "dot", arg, &second, 1),
            F::Fma => {
                let product = self.product(name, "*", arg, &second, 1);
                &product | &rest.get(1).cloned().unwrap_or_default()
            }
            F::Abs
            | F::Floor
            | F::Ceil
            | F::Round
            | F::Trunc
            | F::Fract
            | F::Saturate
            | F::Length
            | F::Sqrt
            | F::InverseSqrt => arg.clone(),
            _ => Units::new(),
        }
    }
}

/// The difference of two evaluations is marked; that of one with itself, or with a number, is not.
/// Units of a member of a structure that is one evaluation.
fn of_one(units: Units, base: Handle<Expression>) -> Units {
    let origin = base.index() + 1;
    let known = units.into_iter();
    known.map(|unit| Unit { origin, ..unit }).collect()
}

fn difference(left: &Units, right: &Units) -> Units {
    let is_evaluation = |u: &&Unit| u.value > 0;
    let mut out = left | right;
    for a in left.iter().filter(is_evaluation) {
        for b in right.iter().filter(is_evaluation) {
            if a.origin != b.origin || a.origin == 0 {
                out.remove(a);
                out.remove(b);
                out.insert(Unit {
                    origin: 0,
                    difference: true,
                    ..*a
                });
            }
        }
    }
    out
}

fn struct_name(module: &Module, ty: Handle<Type>) -> Option<String> {
    match &module.types[ty] {
        Type {
            name: Some(name),
            inner: TypeInner::Struct { .. },
        } => Some(name.clone()),
        _ => None,
    }
}

/// Where the value is in the vector that an expression is, if that is the result of a stub or a variable or argument
/// that holds one.
fn packed(
    module: &Module,
    function: &Function,
    base: Handle<Expression>,
    calls: &BTreeMap<Handle<Expression>, Handle<Function>>,
) -> Option<u32> {
    if let Some(callee) = calls.get(&base) {
        return match module.functions[*callee].name.as_deref()? {
            "field_grad" => {
                let result = module.functions[*callee].result.as_ref()?;
                match module.types[result.ty].inner {
                    TypeInner::Vector { size, .. } => Some(size as u32 - 1),
                    _ => None,
                }
            }
            "field_ray" => Some(0),
            _ => None,
        };
    }
    let name = match function.expressions[base] {
        Expression::FunctionArgument(k) => function.arguments[k as usize].name.clone()?,
        Expression::Load { pointer } => match function.expressions[pointer] {
            Expression::LocalVariable(v) => function.local_variables[v].name.clone()?,
            _ => return None,
        },
        _ => return None,
    };
    // by convention, a vector called `jet` holds gradient and value
    (name == "jet").then_some(3)
}

/// Units of components: of a packed vector, the value or the slopes; of any other, those of the whole.
fn component(base: &Units, value_at: Option<u32>, letters: &[u32]) -> Units {
    let Some(value_at) = value_at else {
        return base.clone();
    };
    let wanted = |u: &&Unit| {
        letters
            .iter()
            .any(|&letter| (letter == value_at) == (u.length == 0) || u.value == 0)
    };
    base.iter().filter(wanted).copied().collect()
}

/// The callee of every call result.
fn call_results(block: &Block) -> BTreeMap<Handle<Expression>, Handle<Function>> {
    let mut out = BTreeMap::new();
    each_call(block, &mut |function, _, result| {
        if let Some(result) = result {
            out.insert(result, function);
        }
    });
    out
}

fn arguments_of(block: &Block, at: Handle<Expression>) -> Vec<Handle<Expression>> {
    let mut out = Vec::new();
    each_call(block, &mut |_, arguments, result| {
        if result == Some(at) {
            out = arguments.to_vec();
        }
    });
    out
}

type EachCall<'c> =
    &'c mut dyn FnMut(Handle<Function>, &[Handle<Expression>], Option<Handle<Expression>>);

/// Visits every call of a block.
pub fn each_call(block: &Block, visit: EachCall) {
    for statement in block {
        match statement {
            Statement::Call {
                function,
                arguments,
                result,
            } => visit(*function, arguments, *result),
            Statement::Block(inner) => each_call(inner, visit),
            Statement::If { accept, reject, .. } => {
                each_call(accept, visit);
                each_call(reject, visit);
            }
            Statement::Switch { cases, .. } => {
                cases.iter().for_each(|case| each_call(&case.body, visit));
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                each_call(body, visit);
                each_call(continuing, visit);
            }
            _ => {}
        }
    }
}
