//! Functions that are defined in the language, as functions of the shader.

use naga::{Function, FunctionArgument, FunctionResult, Handle};

use super::function::{Argument, Interface, Leaves, Output, lower};
use super::{Format, LowerError, NumberTypes, Precision};
use crate::defined::{self, Digits, Key, shader_name};
use crate::ir::{Prim, Ty};
use crate::link::Linker;
use crate::table;

/// The shader function of an operation that is defined in the language: lowered where it is called first.
///
/// # Errors
/// There is no definition for operands of this type, or it needs what the GPU has no form for.
pub(super) fn function(
    linker: &mut Linker,
    prim: Prim,
    complex: bool,
    precision: Precision,
) -> Result<Handle<Function>, LowerError> {
    let name = shader_name(prim, complex);
    if let Some(handle) = linker.generated(&name) {
        return Ok(handle);
    }
    let format = precision.format();
    let digits = match format {
        Format::Single => Digits::Single,
        Format::Pair | Format::Double => Digits::Wide,
    };
    let key = Key {
        prim,
        complex,
        digits,
    };
    let definition = defined::definition(key).ok_or(LowerError::NoForm(table::row(prim).usage))?;
    let types = NumberTypes::of(linker, format)?;
    let ty = |ty: Ty| match ty {
        Ty::Complex => types.complex,
        _ => types.real,
    };
    let argument = |(k, &input): (usize, &Ty)| FunctionArgument {
        name: Some(["a", "b", "c", "d"][k.min(3)].to_owned()),
        ty: ty(input),
        binding: None,
    };
    let arguments: Vec<FunctionArgument> =
        definition.inputs.iter().enumerate().map(argument).collect();
    let inputs = (0u32..).map(Argument::Whole).take(arguments.len());
    let interface = Interface {
        inputs: inputs.collect(),
        declaration: Function {
            name: Some(name.clone()),
            arguments,
            result: Some(FunctionResult {
                ty: ty(definition.graph.ty(definition.root)),
                binding: None,
            }),
            ..Function::default()
        },
        leaves: Leaves::Arguments {
            params: 0,
            time: 0,
            pixel: 0,
        },
        output: Output::Node(0),
        // built-ins of the adapter have no bounds, and a definition may lose with them all that it has
        precision: match precision {
            Precision::Fast => Precision::Accurate,
            other => other,
        },
        wide: true,
    };
    let function = lower(&definition.graph, &[definition.root], interface, linker)?;
    let handle = linker.append(function);
    linker.keep(name, handle);
    Ok(handle)
}
