//! One function by itself, as a module: what another program would paste.

use naga::valid::ModuleInfo;
use naga::{
    EntryPoint, Expression, Function, FunctionArgument, FunctionResult, Handle, Module,
    ShaderStage, Span, Statement, StructMember, Type, TypeInner,
};

use super::Target;
use crate::formula::{Formula, scalar_types};
use crate::ir::Op;
use crate::link::{Linker, number_module};
use crate::lower::{Argument, Interface, Leaves, LowerError, NagaTypes, Output, Precision, lower};
use crate::module::{Evaluation, ModuleError, What, stable_evaluation};
use crate::numeral::Numeral;
use crate::program::Program;
use crate::types::Type as LanguageType;

/// Arguments of the function: the formula's inputs, then the parameters, the clock and the footprint that it uses.
struct Arguments {
    list: Vec<FunctionArgument>,
    inputs: Vec<Argument>,
    leaves: Leaves,
    described: Vec<String>,
}

/// Builds a module with one function of the formula and the library functions that it calls, and says what the
/// function is.
pub fn standalone(
    program: &Program,
    formula: &Formula,
    what: What,
    precision: Precision,
    target: Target,
) -> Result<(Module, ModuleInfo, String), ModuleError> {
    let evaluation = stable_evaluation(formula, what)?;
    let mut linker = Linker::new(vec![number_module(precision.into())]);
    let types = NagaTypes::insert(&mut linker.out.types);
    let arguments = arguments(program, formula, &evaluation, types);
    let [value, gradient, derivative, ..] = function_names(&formula.name);
    let name = match what {
        What::Value => value,
        What::Gradient => gradient,
        What::Derivative => derivative,
        What::Hessian => format!("{value}_hessian"),
    };
    let (output, result, returns) = result(formula, what, &evaluation, types, &mut linker, &name);
    let interface = Interface {
        declaration: Function {
            name: Some(name.clone()),
            arguments: arguments.list,
            result: Some(FunctionResult {
                ty: result,
                binding: None,
            }),
            ..Function::default()
        },
        inputs: arguments.inputs,
        leaves: arguments.leaves,
        output,
        precision,
        wide: false,
    };
    let function = lower(&evaluation.graph, &evaluation.roots, interface, &mut linker)?;
    let handle = linker.append(function);
    let mut module = linker.out;
    if target == Target::Glsl {
        add_main(&mut module, handle);
    }
    naga::compact::compact(&mut module, naga::compact::KeepUnused::Yes);
    let info = crate::module::validate(&module, precision)?;
    let header = format!(
        "{name}({}) returns {returns}",
        arguments.described.join(", ")
    );
    Ok((module, info, header))
}

/// Names of the functions for value, gradient, derivative, integral, transmittance and opacity.
fn function_names(formula: &str) -> [String; 6] {
    let formula = crate::lower::identifier(formula);
    [
        formula.clone(),
        format!("{formula}_gradient"),
        format!("{formula}_derivative"),
        format!("{formula}_integral"),
        format!("{formula}_transmittance"),
        format!("{formula}_opacity"),
    ]
}

/// Names of every function that is generated from a formula of this name, by itself or in a scene.
pub fn generated_names(formula: &str) -> Vec<String> {
    let demands = crate::module::DEMANDS.iter().map(|d| (*d).to_owned());
    function_names(formula).into_iter().chain(demands).collect()
}

fn arguments(
    program: &Program,
    formula: &Formula,
    evaluation: &Evaluation,
    types: NagaTypes,
) -> Arguments {
    let mut out = Arguments {
        list: Vec::new(),
        inputs: Vec::new(),
        leaves: Leaves::Arguments {
            params: 0,
            time: 0,
            pixel: 0,
        },
        described: Vec::new(),
    };
    let mut add = |name: &str, ty: Handle<Type>, described: String, list: &mut Vec<_>| {
        list.push(FunctionArgument {
            name: Some(crate::lower::identifier(name)),
            ty,
            binding: None,
        });
        out.described.push(described);
        u32::try_from(list.len() - 1).unwrap_or(u32::MAX)
    };
    for input in &formula.inputs {
        let ty = match input.ty {
            LanguageType::Real | LanguageType::Bool => types.real,
            LanguageType::Complex | LanguageType::Vector(2) => types.vec2,
            LanguageType::Vector(3) => types.vec3,
            LanguageType::Vector(_) => types.vec4,
        };
        let described = format!("{}: {}", input.name, input.ty);
        let index = add(&input.name, ty, described, &mut out.list);
        for k in 0..scalar_types(input.ty).len() {
            out.inputs.push(match input.ty {
                LanguageType::Vector(_) => {
                    Argument::Component(index, u32::try_from(k).unwrap_or(0))
                }
                _ => Argument::Whole(index),
            });
        }
    }
    let live = evaluation.graph.reachable(&evaluation.roots);
    let uses = |op: Op| {
        evaluation
            .graph
            .ids()
            .zip(evaluation.graph.nodes())
            .any(|(id, node)| live[id.index()] && node.op == op)
    };
    let params = u32::try_from(out.list.len()).unwrap_or(u32::MAX);
    let any_param =
        (0..program.params().len()).any(|k| uses(Op::Param(u16::try_from(k).unwrap_or(u16::MAX))));
    if any_param {
        for param in program.params() {
            let described = format!(
                "{}: real, {} in {}..{}",
                param.name,
                Numeral(param.default),
                Numeral(param.lo),
                Numeral(param.hi)
            );
            add(&param.name, types.real, described, &mut out.list);
        }
    }
    let (mut time, mut pixel) = (0, 0);
    if uses(Op::Time) {
        time = add(
            "time",
            types.real,
            "time: seconds".to_owned(),
            &mut out.list,
        );
    }
    if uses(Op::Pixel) {
        pixel = add(
            "pixel",
            types.real,
            "pixel: world units per pixel".to_owned(),
            &mut out.list,
        );
    }
    out.leaves = Leaves::Arguments {
        params,
        time,
        pixel,
    };
    out
}

/// How the results make up the return value, its type, and what it is in words.
fn result(
    formula: &Formula,
    what: What,
    evaluation: &Evaluation,
    types: NagaTypes,
    linker: &mut Linker,
    name: &str,
) -> (Output, Handle<Type>, String) {
    let vector = |n: usize| match n {
        2 => Some(types.vec2),
        3 => Some(types.vec3),
        4 => Some(types.vec4),
        _ => None,
    };
    let nodes: Vec<Output> = (0..evaluation.roots.len()).map(Output::Node).collect();
    match (what, formula.ty) {
        (What::Value, LanguageType::Real) => (Output::Node(0), types.real, "the value".into()),
        (What::Value, LanguageType::Complex) => (
            Output::Node(0),
            types.vec2,
            "the value (real and imaginary part)".into(),
        ),
        (What::Value, LanguageType::Bool) => (Output::Node(0), types.truth, "the value".into()),
        (What::Value, LanguageType::Vector(n)) => {
            let ty = vector(usize::from(n)).unwrap_or(types.vec4);
            (Output::Compose(ty, nodes), ty, "the value".into())
        }
        (What::Gradient, LanguageType::Real) if vector(nodes.len()).is_some() => {
            let mut parts = nodes;
            parts.rotate_left(1);
            let ty = vector(parts.len()).unwrap_or(types.vec4);
            let mut names = evaluation.names.clone();
            names.rotate_left(1);
            (
                Output::Compose(ty, parts),
                ty,
                format!("({})", names.join(", ")),
            )
        }
        _ => {
            let members = member_names(formula, what, evaluation);
            let ty = structure(evaluation, types, linker, name, &members);
            let described = evaluation.names.join(", ");
            (
                Output::Compose(ty, nodes),
                ty,
                format!("a structure of {described}"),
            )
        }
    }
}

/// Identifiers for the roots of an evaluation.
fn member_names(formula: &Formula, what: What, evaluation: &Evaluation) -> Vec<String> {
    let values = formula.value.len();
    let names = |k: usize| match what {
        _ if k < values && values == 1 => "value".to_owned(),
        _ if k < values => format!("value_{}", ["x", "y", "z", "w"][k.min(3)]),
        What::Derivative if evaluation.roots.len() == 2 * values && values == 1 => {
            "derivative".to_owned()
        }
        What::Derivative if values == 1 => ["", "dz", "dzbar"][k.min(2)].to_owned(),
        _ => format!("d{}", k - values),
    };
    (0..evaluation.roots.len()).map(names).collect()
}

fn structure(
    evaluation: &Evaluation,
    types: NagaTypes,
    linker: &mut Linker,
    name: &str,
    members: &[String],
) -> Handle<Type> {
    let mut offset: u32 = 0;
    let mut out = Vec::new();
    for (&root, member) in evaluation.roots.iter().zip(members) {
        let (ty, size) = match evaluation.graph.ty(root) {
            crate::ir::Ty::Complex => (types.vec2, 8),
            crate::ir::Ty::Real => (types.real, 4),
            crate::ir::Ty::Bool | crate::ir::Ty::Loop => (types.truth, 4),
        };
        offset = offset.next_multiple_of(size);
        out.push(StructMember {
            name: Some(member.clone()),
            ty,
            binding: None,
            offset,
        });
        offset += size;
    }
    let title: String = name
        .split('_')
        .map(|word| {
            let mut letters = word.chars();
            letters
                .next()
                .map_or(String::new(), |c| c.to_uppercase().chain(letters).collect())
        })
        .collect();
    let span = offset.next_multiple_of(8);
    let inner = TypeInner::Struct { members: out, span };
    linker.insert_type(Type {
        name: Some(title),
        inner,
    })
}

/// GLSL has no module without an entry point: one that calls the function with zeros.
fn add_main(module: &mut Module, function: Handle<Function>) {
    let mut main = Function {
        name: Some("main".into()),
        ..Function::default()
    };
    let tys: Vec<_> = module.functions[function]
        .arguments
        .iter()
        .map(|a| a.ty)
        .collect();
    let arguments = tys
        .into_iter()
        .map(|ty| {
            main.expressions
                .append(Expression::ZeroValue(ty), Span::UNDEFINED)
        })
        .collect();
    let result = main
        .expressions
        .append(Expression::CallResult(function), Span::UNDEFINED);
    let call = Statement::Call {
        function,
        arguments,
        result: Some(result),
    };
    main.body.push(call, Span::UNDEFINED);
    main.body
        .push(Statement::Return { value: None }, Span::UNDEFINED);
    module.entry_points.push(EntryPoint {
        name: "main".into(),
        stage: ShaderStage::Fragment,
        early_depth_test: None,
        workgroup_size: [0; 3],
        workgroup_size_overrides: None,
        function: main,
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    });
}

impl From<LowerError> for crate::link::LinkError {
    fn from(error: LowerError) -> Self {
        Self::Lower(error)
    }
}
