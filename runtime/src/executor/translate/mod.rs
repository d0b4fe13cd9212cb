//! From a naga module to a program.

mod arithmetic;
mod body;
mod call;
mod expression;
mod flow;
mod frame;
mod globals;
mod math;
mod memory;
mod native;
mod plan;
mod pointer;

use std::collections::HashMap;

use naga::valid::ModuleInfo;
use naga::{Binding, Expression, Function, GlobalVariable, Handle, Module, TypeInner};

use super::code::{Form, Indexed, Inst, Op};
use super::fault::{Fault, LoopSite};
use super::lanes::Slot;
use super::library::LibraryCall;
use super::program::{Buffer, Component, Options, Program, Start, started};
use super::shape::Shapes;
use super::trace::Site;
use body::Body;
use call::Compiled;
use frame::Frame;
use globals::GlobalPlace;
use memory::Memory;
use plan::Plans;

/// Words of a value, one for each component.
type Parts = Vec<Slot>;

/// What the translation of a module has made so far.
struct Translator<'m> {
    module: &'m Module,
    info: &'m ModuleInfo,
    options: Options,
    shapes: Shapes<'m>,
    plans: Plans,
    code: Vec<Inst>,
    uniforms: Vec<u64>,
    constants: HashMap<u64, Slot>,
    indices: Vec<Indexed>,
    library: Vec<LibraryCall>,
    sites: Vec<Site>,
    loops: Vec<LoopSite>,
    owners: Vec<u32>,
    names: Vec<String>,
    /// The function at hand, a place in `names`.
    owner: u32,
    inputs: Vec<Component>,
    buffers: Vec<Buffer>,
    globals: HashMap<Handle<GlobalVariable>, GlobalPlace>,
    compiled: HashMap<Handle<Function>, Compiled>,
    frame: Frame,
    memory: Memory,
    /// Slots that the expression at hand has made.
    temporaries: Vec<Slot>,
    /// For each block that is open, instructions that go on at its end.
    pending: Vec<Vec<usize>>,
}

/// Translates a function of a module with all that it calls.
pub(super) fn program(
    module: &Module,
    info: &ModuleInfo,
    start: Start,
    options: Options,
) -> Result<Program, Fault> {
    let (root, place) = started(module, start)?;
    let plans = Plans::new(module, root.function, options)?;
    let mut translator = Translator {
        module,
        info,
        options,
        shapes: Shapes::new(module, options.arithmetic),
        plans,
        code: Vec::new(),
        uniforms: Vec::new(),
        constants: HashMap::new(),
        indices: Vec::new(),
        library: Vec::new(),
        sites: Vec::new(),
        loops: Vec::new(),
        owners: Vec::new(),
        names: vec![String::new()],
        owner: 0,
        inputs: Vec::new(),
        buffers: Vec::new(),
        globals: HashMap::new(),
        compiled: HashMap::new(),
        frame: Frame::default(),
        memory: Memory::default(),
        temporaries: Vec::new(),
        pending: Vec::new(),
    };
    translator.constant(0);
    translator.declare_globals()?;
    let mut registers = 0;
    // what is called precedes its callers
    for (handle, function) in module.functions.iter() {
        if translator.plans.stands_alone(handle) && Some(handle) != root.handle {
            translator
                .stand_alone(handle, function)
                .map_err(|fault| fault.within(function.name.as_deref()))?;
            registers = registers.max(translator.frame.top());
        } else {
            let floor = translator.plans.floor(function);
            translator.plans.set_floor(handle, floor);
        }
    }
    let info = match root.handle {
        Some(handle) => &info[handle],
        None => info.get_entry_point(place),
    };
    let body = Body::new(root.function, info, root.handle, options.contraction)?;
    let name = root.function.name.clone();
    let (entry, arguments, results) = translator
        .root(body)
        .map_err(|fault| fault.within(name.as_deref()))?;
    registers = registers.max(translator.frame.top());
    Ok(translator.finish(entry, registers, arguments, results))
}

impl<'m> Translator<'m> {
    /// Adds the function that is run: gives its place, its arguments and its results.
    fn root(
        &mut self,
        mut body: Body<'m>,
    ) -> Result<(usize, Vec<Component>, Vec<Component>), Fault> {
        let function = body.function;
        self.frame = Frame::new(self.plans.floor(function));
        let entry = self.code.len();
        let mut arguments = Vec::new();
        for argument in &function.arguments {
            let inner = &self.module.types[argument.ty].inner;
            let parts = self.argument_registers(inner)?;
            let path = match (&argument.binding, &argument.name) {
                (Some(Binding::BuiltIn(builtin)), _) => format!("{builtin:?}"),
                (_, Some(name)) => name.clone(),
                _ => String::new(),
            };
            self.components(&path, inner, &parts, &mut arguments)?;
            body.arguments.push(parts);
        }
        let results = self.function_body(&mut body)?;
        self.emit(Inst::new(Op::End));
        let mut components = Vec::new();
        if let Some(result) = &function.result {
            let inner = &self.module.types[result.ty].inner;
            self.components("", inner, &results, &mut components)?;
        }
        Ok((entry, arguments, components))
    }

    fn components(
        &self,
        path: &str,
        inner: &TypeInner,
        parts: &[Slot],
        out: &mut Vec<Component>,
    ) -> Result<(), Fault> {
        let mut forms = Vec::new();
        self.shapes.forms(inner, &mut forms)?;
        for (index, (&form, &slot)) in forms.iter().zip(parts).enumerate() {
            let path = path.to_owned();
            out.push(Component {
                path,
                index,
                slot,
                form,
            });
        }
        Ok(())
    }

    /// Puts everything at its place in memory: uniforms first, and the code at its beginning.
    fn finish(
        self,
        entry: usize,
        registers: u32,
        arguments: Vec<Component>,
        results: Vec<Component>,
    ) -> Program {
        let uniforms = self.uniforms.len() as u32;
        let component = |mut component: Component| {
            component.slot = component.slot.placed(uniforms);
            component
        };
        let site = |mut site: Site| {
            for slot in &mut site.parts {
                *slot = slot.placed(uniforms);
            }
            site
        };
        // the function that is run comes last, so that one jump leads to it
        let mut code = vec![Inst::new(Op::Jump).at(entry as u32 + 1)];
        let owners = std::iter::once(0).chain(self.owners).collect();
        let shifted = |inst: Inst| {
            if inst.op.jumps() {
                inst.at(inst.x + 1)
            } else {
                inst
            }
        };
        code.extend(self.code.into_iter().map(|i| shifted(i).placed(uniforms)));
        Program {
            code,
            uniforms: self.uniforms,
            registers: registers as usize,
            indices: self.indices,
            library: self
                .library
                .into_iter()
                .map(|call| call.placed(uniforms))
                .collect(),
            sites: self.sites.into_iter().map(site).collect(),
            loops: self.loops,
            owners,
            names: self.names,
            inputs: self.inputs.into_iter().map(component).collect(),
            buffers: self.buffers,
            arguments: arguments.into_iter().map(component).collect(),
            results: results.into_iter().map(component).collect(),
        }
    }

    fn emit(&mut self, inst: Inst) -> usize {
        self.code.push(inst);
        self.owners.push(self.owner);
        self.code.len() - 1
    }

    /// What is emitted from now on comes from a function; gives the function before.
    fn owned_by(&mut self, function: &Function) -> u32 {
        let name = function.name.as_deref().unwrap_or_default();
        let known = self.names.iter().position(|n| n == name);
        let place = known.unwrap_or_else(|| {
            self.names.push(name.to_owned());
            self.names.len() - 1
        });
        std::mem::replace(&mut self.owner, place as u32)
    }

    /// The place of the next instruction.
    fn here(&self) -> u32 {
        self.code.len() as u32
    }

    /// A uniform of this word.
    fn constant(&mut self, word: u64) -> Slot {
        if let Some(&slot) = self.constants.get(&word) {
            return slot;
        }
        let slot = self.uniform(word);
        self.constants.insert(word, slot);
        slot
    }

    /// A uniform of its own.
    fn uniform(&mut self, word: u64) -> Slot {
        self.uniforms.push(word);
        Slot::uniform(self.uniforms.len() as u32 - 1)
    }

    /// A slot for a result that is the same in all lanes if all operands are.
    fn result_of(&mut self, operands: &[Slot]) -> Result<Slot, Fault> {
        if operands.iter().all(|slot| slot.is_uniform()) {
            return Ok(self.uniform(0));
        }
        self.register()
    }

    /// A register that lives as long as the expression at hand.
    fn register(&mut self) -> Result<Slot, Fault> {
        let slot = self.frame.take()?;
        self.temporaries.push(slot);
        Ok(slot)
    }

    fn unary(&mut self, op: Op, a: Slot) -> Result<Slot, Fault> {
        let d = self.result_of(&[a])?;
        self.emit(Inst::new(op).to(d).of(a));
        Ok(d)
    }

    fn binary(&mut self, op: Op, a: Slot, b: Slot) -> Result<Slot, Fault> {
        let d = self.result_of(&[a, b])?;
        self.emit(Inst::new(op).to(d).of(a).and(b));
        Ok(d)
    }

    fn ternary(&mut self, op: Op, a: Slot, b: Slot, c: Slot) -> Result<Slot, Fault> {
        let d = self.result_of(&[a, b, c])?;
        self.emit(Inst::new(op).to(d).of(a).and(b).with(c));
        Ok(d)
    }

    fn inner<'a>(&'a self, body: &'a Body<'m>, handle: Handle<Expression>) -> &'a TypeInner {
        body.info[handle].ty.inner_with(&self.module.types)
    }

    /// How the components of a number or a vector are read.
    fn form(&self, body: &Body<'m>, handle: Handle<Expression>) -> Result<Form, Fault> {
        let scalar = self.inner(body, handle).scalar();
        self.shapes
            .form(scalar.ok_or_else(|| Fault::unsupported("arithmetic on an aggregate"))?)
    }
}
