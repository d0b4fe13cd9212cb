//! A module with the functions that were asked for and the library functions that they call, each once.

use naga::valid::ModuleInfo;
use naga::{
    AddressSpace, Function, FunctionArgument, FunctionResult, GlobalVariable, Handle, Module,
    ResourceBinding, Span, StructMember, Type, TypeInner,
};
use rustc_hash::FxHashMap;

use super::Target;
use super::parts::{Part, result_names};
use super::request::{Emission, EmitWhat, ParamsAs};
use crate::formula::scalar_types;
use crate::ir::{Op, Ty};
use crate::link::{Linker, number_module};
use crate::lower::{Argument, Base, Interface, Leaves, NagaTypes, Output, lower};
use crate::module::{ModuleError, validate};
use crate::numeral::Numeral;
use crate::program::Program;
use crate::types::Type as LanguageType;

/// A function in the module, and what is said of it.
pub(super) struct Built {
    pub(super) what: EmitWhat,
    pub(super) handle: Handle<Function>,
    pub(super) returns: String,
    /// Each argument or parameter: its name and what it is.
    pub(super) arguments: Vec<(String, String)>,
    pub(super) remark: String,
}

/// The module of an emission.
pub(super) struct BuiltModule {
    pub(super) module: Module,
    pub(super) info: ModuleInfo,
    pub(super) functions: Vec<Built>,
}

/// What of parameters, clock and footprint the parts use.
#[derive(Clone, Copy, Debug, Default)]
struct Uses {
    params: bool,
    time: bool,
    pixel: bool,
}

impl Uses {
    fn of(part: &Part) -> Self {
        let graph = &part.evaluation.graph;
        let live = graph.reachable(&part.evaluation.roots);
        let mut out = Self::default();
        for (id, node) in graph.ids().zip(graph.nodes()) {
            if live[id.index()] {
                out.params |= matches!(node.op, Op::Param(_));
                out.time |= node.op == Op::Time;
                out.pixel |= node.op == Op::Pixel;
            }
        }
        out
    }

    fn any(self) -> bool {
        self.params || self.time || self.pixel
    }

    fn or(self, other: Self) -> Self {
        Self {
            params: self.params || other.params,
            time: self.time || other.time,
            pixel: self.pixel || other.pixel,
        }
    }
}

/// Builds the functions of the parts.
pub(super) fn build(
    program: &Program,
    parts: &[Part],
    emission: &Emission,
) -> Result<BuiltModule, ModuleError> {
    let sources = vec![number_module(emission.precision.into())];
    let mut builder = Builder {
        program,
        emission,
        linker: Linker::new(sources),
        uses: parts.iter().map(Uses::of).fold(Uses::default(), Uses::or),
        structure: None,
    };
    let mut functions = Vec::new();
    for part in parts {
        functions.push(builder.function(part)?);
    }
    let mut module = builder.linker.out;
    let wanted: Vec<Handle<Function>> = functions.iter().map(|f| f.handle).collect();
    super::restore::restore_operators(&mut module);
    let places = compact(&mut module, &wanted);
    for (function, place) in functions.iter_mut().zip(places) {
        function.handle = place;
    }
    let info = validate(&module, emission.precision)?;
    Ok(BuiltModule {
        module,
        info,
        functions,
    })
}

/// Removes what nothing uses, and says where the wanted functions are then: they stay in their order.
fn compact(module: &mut Module, wanted: &[Handle<Function>]) -> Vec<Handle<Function>> {
    let is_wanted: Vec<bool> = module
        .functions
        .iter()
        .map(|(handle, _)| wanted.contains(&handle))
        .collect();
    naga::compact::compact(module, naga::compact::KeepUnused::Yes);
    // no function is removed, as those that nothing calls are kept
    let all = module.functions.iter().zip(is_wanted);
    let kept: Vec<Handle<Function>> = all.filter(|(_, w)| *w).map(|((h, _), _)| h).collect();
    let mut sorted = wanted.to_vec();
    sorted.sort_unstable();
    let place: FxHashMap<_, _> = sorted.into_iter().zip(kept).collect();
    wanted
        .iter()
        .filter_map(|w| place.get(w).copied())
        .collect()
}

struct Builder<'a> {
    program: &'a Program,
    emission: &'a Emission,
    linker: Linker<'a>,
    uses: Uses,
    /// The structure of the parameters, and the uniform that has it.
    structure: Option<(Handle<Type>, Option<Handle<GlobalVariable>>)>,
}

/// Arguments of a function.
#[derive(Default)]
struct Arguments {
    list: Vec<FunctionArgument>,
    inputs: Vec<Argument>,
    described: Vec<(String, String)>,
}

impl Arguments {
    fn add(&mut self, name: String, ty: Handle<Type>, described: String) -> u32 {
        self.described.push((name.clone(), described));
        self.list.push(FunctionArgument {
            name: Some(name),
            ty,
            binding: None,
        });
        u32::try_from(self.list.len() - 1).unwrap_or(u32::MAX)
    }
}

impl Builder<'_> {
    fn function(&mut self, part: &Part) -> Result<Built, ModuleError> {
        let types = NagaTypes::insert(&mut self.linker.out.types);
        let emission = self.emission;
        let base = emission.name.clone();
        let formula_name = match part.what {
            // the integral is a formula with a name of its own
            EmitWhat::Integral | EmitWhat::Transmittance | EmitWhat::Opacity => {
                part.formula.name.trim_end_matches("_integral")
            }
            EmitWhat::ShiftedIntegral => part.formula.name.trim_end_matches("_shifted_integral"),
            _ => &part.formula.name,
        };
        let base = base.unwrap_or_else(|| crate::lower::identifier(formula_name));
        let name = format!("{base}{}", part.what.suffix());
        let mut arguments = self.inputs(part, types);
        let uses = Uses::of(part);
        let leaves = self.leaves(uses, &mut arguments, types);
        if part.is_fixed {
            let constant = |(name, what)| (name, format!("{what}, a constant here"));
            arguments
                .described
                .extend(self.params().into_iter().map(constant));
        }
        let (output, result, returns) = self.result(part, types, &name);
        let interface = Interface {
            declaration: Function {
                name: Some(name),
                arguments: arguments.list,
                result: Some(FunctionResult {
                    ty: result,
                    binding: None,
                }),
                ..Function::default()
            },
            inputs: arguments.inputs,
            leaves,
            output,
            precision: emission.precision,
            wide: false,
        };
        let evaluation = &part.evaluation;
        let function = lower(
            &evaluation.graph,
            &evaluation.roots,
            interface,
            &mut self.linker,
        )?;
        Ok(Built {
            what: part.what,
            handle: self.linker.append(function),
            returns,
            arguments: arguments.described,
            remark: part.remark.clone(),
        })
    }

    fn inputs(&mut self, part: &Part, types: NagaTypes) -> Arguments {
        let mut out = Arguments::default();
        for input in &part.formula.inputs {
            let ty = match input.ty {
                LanguageType::Real | LanguageType::Bool => types.real,
                LanguageType::Complex | LanguageType::Vector(2) => types.vec2,
                LanguageType::Vector(3) => types.vec3,
                LanguageType::Vector(_) => types.vec4,
            };
            let described = match input.ty {
                LanguageType::Complex => "complex, as real and imaginary part".to_owned(),
                other => other.to_string(),
            };
            let index = out.add(self.emission.name_of(&input.name), ty, described);
            for k in 0..scalar_types(input.ty).len() {
                out.inputs.push(match input.ty {
                    LanguageType::Vector(_) => {
                        Argument::Component(index, u32::try_from(k).unwrap_or(0))
                    }
                    _ => Argument::Whole(index),
                });
            }
        }
        out
    }

    /// Where parameters, clock and footprint are, with the arguments that hold them.
    fn leaves(&mut self, uses: Uses, arguments: &mut Arguments, types: NagaTypes) -> Leaves {
        // a structure of nothing is none
        if self.emission.params == ParamsAs::Uniform && self.uses.any() {
            return self.structured(uses, arguments, types);
        }
        let params = u32::try_from(arguments.list.len()).unwrap_or(u32::MAX);
        if uses.params {
            for (name, described) in self.params() {
                arguments.add(name, types.real, described);
            }
        }
        let (mut time, mut pixel) = (0, 0);
        if uses.time {
            time = arguments.add(self.emission.name_of("time"), types.real, TIME.to_owned());
        }
        if uses.pixel {
            pixel = arguments.add(self.emission.name_of("pixel"), types.real, PIXEL.to_owned());
        }
        Leaves::Arguments {
            params,
            time,
            pixel,
        }
    }

    /// Names of the parameters, and what they are.
    fn params(&self) -> Vec<(String, String)> {
        let describe = |param: &crate::program::ParamInfo| {
            let range = format!(
                "real, {} in {}..{}",
                Numeral(param.default),
                Numeral(param.lo),
                Numeral(param.hi)
            );
            (self.emission.name_of(&param.name), range)
        };
        self.program.params().iter().map(describe).collect()
    }

    fn structured(&mut self, uses: Uses, arguments: &mut Arguments, types: NagaTypes) -> Leaves {
        let all = self.uses;
        let (structure, uniform) = match self.structure {
            Some(known) => known,
            None => {
                let made = self.parameters(types);
                self.structure = Some(made);
                made
            }
        };
        let count = if all.params {
            self.program.params().len()
        } else {
            0
        };
        let time = u32::try_from(count).unwrap_or(u32::MAX);
        let pixel = time.saturating_add(u32::from(all.time));
        if uses.any() {
            if all.params {
                arguments.described.extend(self.params());
            }
            let further = [(all.time, "time", TIME), (all.pixel, "pixel", PIXEL)];
            for (_, name, described) in further.into_iter().filter(|f| f.0) {
                let name = self.emission.name_of(name);
                arguments.described.push((name, described.to_owned()));
            }
        }
        let base = match uniform {
            Some(global) => Base::Uniform(global),
            None if uses.any() => {
                arguments.list.push(FunctionArgument {
                    name: Some("params".to_owned()),
                    ty: structure,
                    binding: None,
                });
                Base::Argument(u32::try_from(arguments.list.len() - 1).unwrap_or(u32::MAX))
            }
            None => Base::Argument(0),
        };
        Leaves::Structure { base, time, pixel }
    }

    /// The structure of all parameters, and the uniform of it where the language has such.
    fn parameters(&mut self, types: NagaTypes) -> (Handle<Type>, Option<Handle<GlobalVariable>>) {
        let mut names: Vec<String> = Vec::new();
        if self.uses.params {
            names.extend(self.params().into_iter().map(|p| p.0));
        }
        if self.uses.time {
            names.push(self.emission.name_of("time"));
        }
        if self.uses.pixel {
            names.push(self.emission.name_of("pixel"));
        }
        let mut offset = 0;
        let mut members = Vec::new();
        for name in names {
            members.push(StructMember {
                name: Some(name),
                ty: types.real,
                binding: None,
                offset,
            });
            offset += 4;
        }
        let structure = self.linker.insert_type(Type {
            name: Some("Params".to_owned()),
            inner: TypeInner::Struct {
                members,
                span: offset.max(4),
            },
        });
        let has_uniforms = !matches!(self.emission.target, Target::Msl | Target::C);
        let uniform = (has_uniforms && self.uses.any()).then(|| {
            let global = GlobalVariable {
                name: Some("params".to_owned()),
                space: AddressSpace::Uniform,
                binding: Some(ResourceBinding {
                    group: 0,
                    binding: 0,
                }),
                ty: structure,
                init: None,
                memory_decorations: naga::MemoryDecorations::empty(),
            };
            self.linker
                .out
                .global_variables
                .append(global, Span::UNDEFINED)
        });
        (structure, uniform)
    }

    /// How the results make up the return value, its type, and what it is in words.
    fn result(
        &mut self,
        part: &Part,
        types: NagaTypes,
        name: &str,
    ) -> (Output, Handle<Type>, String) {
        let evaluation = &part.evaluation;
        let vector = |n: usize| match n {
            1 => Some(types.real),
            2 => Some(types.vec2),
            3 => Some(types.vec3),
            4 => Some(types.vec4),
            _ => None,
        };
        let mut nodes: Vec<Output> = (0..evaluation.roots.len()).map(Output::Node).collect();
        let ty = part.formula.ty;
        let described = evaluation.names.join(", ");
        let is_real = ty == LanguageType::Real;
        match (part.what, ty) {
            (
                EmitWhat::Value
                | EmitWhat::Integral
                | EmitWhat::ShiftedIntegral
                | EmitWhat::Transmittance
                | EmitWhat::Opacity,
                _,
            ) => {
                let (ty, words) = match ty {
                    LanguageType::Real => (types.real, "the value"),
                    LanguageType::Complex => (types.vec2, "the value (real and imaginary part)"),
                    LanguageType::Bool => (types.truth, "the value"),
                    LanguageType::Vector(n) => {
                        let ty = vector(usize::from(n)).unwrap_or(types.vec4);
                        return (Output::Compose(ty, nodes), ty, "the value".to_owned());
                    }
                };
                (Output::Node(0), ty, words.to_owned())
            }
            (EmitWhat::Gradient | EmitWhat::Partials | EmitWhat::Directional, _)
                if is_real && vector(nodes.len()).is_some() =>
            {
                let mut names = evaluation.names.clone();
                if part.what == EmitWhat::Gradient {
                    nodes.rotate_left(1);
                    names.rotate_left(1);
                }
                let ty = vector(nodes.len()).unwrap_or(types.real);
                if nodes.len() == 1 {
                    return (Output::Node(0), ty, described);
                }
                (
                    Output::Compose(ty, nodes),
                    ty,
                    format!("({})", names.join(", ")),
                )
            }
            _ => {
                let ty = self.structure(part, types, name);
                (
                    Output::Compose(ty, nodes),
                    ty,
                    format!("a structure of {described}"),
                )
            }
        }
    }

    /// A structure with a member for each result.
    fn structure(&mut self, part: &Part, types: NagaTypes, name: &str) -> Handle<Type> {
        let evaluation = &part.evaluation;
        let mut offset: u32 = 0;
        let mut members = Vec::new();
        for (&root, name) in evaluation.roots.iter().zip(result_names(part)) {
            let (ty, size) = match evaluation.graph.ty(root) {
                Ty::Complex => (types.vec2, 8),
                Ty::Real => (types.real, 4),
                Ty::Bool | Ty::Loop => (types.truth, 4),
            };
            offset = offset.next_multiple_of(size);
            members.push(StructMember {
                name: Some(name),
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
        self.linker.insert_type(Type {
            name: Some(title),
            inner: TypeInner::Struct { members, span },
        })
    }
}

const TIME: &str = "seconds";
const PIXEL: &str = "units of the plane per pixel";
