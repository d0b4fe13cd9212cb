//! Modules as text that reads as if written by hand, in WGSL and in the languages that look like C.
//!
//! Values that are used once are written where they are used; the others are named, by the user's names where they have one. Loops
//! that count are `for`, brackets stand only where they must. What WGSL this prints is the module again, up to names: a test
//! parses it.

mod c_vectors;
mod dialect;
mod expression;
mod flow;
mod helpers;
mod layout;
mod loops;
mod math;
mod names;
mod operands;
mod plan;
mod survey;
mod types;

pub use dialect::Dialect;
pub(in crate::emit) use layout::comment;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use naga::valid::ModuleInfo;
use naga::{Constant, Function, GlobalVariable, Handle, Module, Type};
use rustc_hash::{FxHashMap, FxHashSet};

use c_vectors::CVector;
use flow::FunctionPrinter;
use names::Names;

/// A function as text.
#[derive(Clone, Debug)]
pub struct PrintedFunction {
    /// What it is called in the text.
    pub name: String,
    /// Its declaration, without a body.
    pub signature: String,
    /// The whole of it.
    pub text: String,
    /// Which functions it calls itself, by their places in [`Printed::functions`].
    pub calls: Vec<usize>,
    /// Its place in the module.
    pub handle: Handle<Function>,
}

/// A module as text, in parts.
#[derive(Clone, Debug, Default)]
pub struct Printed {
    /// Structures and constants, then what the language lacks and functions call.
    pub head: Vec<String>,
    /// Uniforms.
    pub uniforms: Vec<String>,
    /// Every function that the kept ones need, those that are called first.
    pub functions: Vec<PrintedFunction>,
}

impl Printed {
    /// The whole text.
    #[must_use]
    pub fn text(&self) -> String {
        let functions = self.functions.iter().map(|f| &f.text);
        let parts = self.head.iter().chain(&self.uniforms).chain(functions);
        let parts: Vec<&str> = parts.map(|p| p.trim_end()).collect();
        parts.join("\n\n") + "\n"
    }
}

/// Prints the functions that are wanted and those that they call. The wanted ones keep their names before all others.
///
/// # Errors
/// What the language cannot say, in words.
pub fn print(
    module: &Module,
    info: &ModuleInfo,
    dialect: Dialect,
    wanted: &[Handle<Function>],
) -> Result<Printed, String> {
    let mut printer = Printer::new(module, info, dialect, wanted);
    let order = needed(module, wanted);
    printer.name_module(wanted, &order);
    let mut out = Printed::default();
    for &handle in &order {
        let function = printer.function(handle, &order)?;
        out.functions.push(function);
    }
    printer.declarations(&mut out)?;
    Ok(out)
}

/// What the functions need, in the order of the module, in which the called ones stand first.
fn needed(module: &Module, wanted: &[Handle<Function>]) -> Vec<Handle<Function>> {
    let mut found: BTreeSet<Handle<Function>> = BTreeSet::new();
    let mut open = wanted.to_vec();
    while let Some(handle) = open.pop() {
        if found.insert(handle) {
            open.extend(crate::link::calls(&module.functions[handle].body));
        }
    }
    found.into_iter().collect()
}

/// Names of arguments and values of functions.
fn names_within(module: &Module, functions: &[Handle<Function>]) -> FxHashSet<String> {
    let mut out = FxHashSet::default();
    for &handle in functions {
        let function = &module.functions[handle];
        out.extend(function.arguments.iter().filter_map(|a| a.name.clone()));
        out.extend(function.named_expressions.values().cloned());
        let locals = function.local_variables.iter();
        out.extend(locals.filter_map(|(_, l)| l.name.clone()));
    }
    out
}

/// Turns what is common to the functions of a module into text.
struct Printer<'m> {
    module: &'m Module,
    info: &'m ModuleInfo,
    dialect: Dialect,
    names: Names,
    /// The functions that others call.
    wanted: BTreeSet<Handle<Function>>,
    functions: FxHashMap<Handle<Function>, String>,
    types: FxHashMap<Handle<Type>, String>,
    members: FxHashMap<Handle<Type>, Vec<String>>,
    constants: FxHashMap<Handle<Constant>, String>,
    globals: FxHashMap<Handle<GlobalVariable>, String>,
    /// Functions that the language lacks, by name, with their text.
    helpers: RefCell<BTreeMap<String, String>>,
    used_types: RefCell<BTreeSet<Handle<Type>>>,
    used_constants: RefCell<BTreeSet<Handle<Constant>>>,
    used_globals: RefCell<BTreeSet<Handle<GlobalVariable>>>,
    /// Which types of vectors C needs.
    vectors: RefCell<BTreeSet<CVector>>,
}

impl<'m> Printer<'m> {
    fn new(
        module: &'m Module,
        info: &'m ModuleInfo,
        dialect: Dialect,
        wanted: &[Handle<Function>],
    ) -> Self {
        Self {
            module,
            info,
            dialect,
            names: Names::new(dialect),
            wanted: wanted.iter().copied().collect(),
            functions: FxHashMap::default(),
            types: FxHashMap::default(),
            members: FxHashMap::default(),
            constants: FxHashMap::default(),
            globals: FxHashMap::default(),
            helpers: RefCell::default(),
            used_types: RefCell::default(),
            used_constants: RefCell::default(),
            used_globals: RefCell::default(),
            vectors: RefCell::default(),
        }
    }

    fn name_module(&mut self, wanted: &[Handle<Function>], order: &[Handle<Function>]) {
        let of_wanted = names_within(self.module, wanted);
        for &handle in wanted.iter().chain(order) {
            if !self.functions.contains_key(&handle) {
                let name = self.module.functions[handle].name.as_deref();
                let name = self.fresh(
                    name.unwrap_or("helper"),
                    &of_wanted,
                    wanted.contains(&handle),
                );
                self.functions.insert(handle, name);
            }
        }
        for (handle, ty) in self.module.types.iter() {
            let naga::TypeInner::Struct { members, .. } = &ty.inner else {
                continue;
            };
            let name = self.fresh(ty.name.as_deref().unwrap_or("Results"), &of_wanted, false);
            self.types.insert(handle, name);
            let mut inside = Names::new(self.dialect);
            let members = members
                .iter()
                .map(|m| inside.fresh(m.name.as_deref().unwrap_or("member")))
                .collect();
            self.members.insert(handle, members);
        }
        for (handle, constant) in self.module.constants.iter() {
            let name = self.fresh(
                constant.name.as_deref().unwrap_or("VALUE"),
                &of_wanted,
                false,
            );
            self.constants.insert(handle, name);
        }
        for (handle, global) in self.module.global_variables.iter() {
            let name = self.fresh(
                global.name.as_deref().unwrap_or("global"),
                &of_wanted,
                false,
            );
            self.globals.insert(handle, name);
        }
    }

    /// A free name; one that the user gave to something in a wanted function is left to that.
    fn fresh(&mut self, name: &str, of_wanted: &FxHashSet<String>, is_wanted: bool) -> String {
        let mut made = self.names.fresh(name);
        while !is_wanted && of_wanted.contains(&made) {
            made = self.names.fresh(&format!("{made}_of_library"));
        }
        made
    }

    fn function(
        &self,
        handle: Handle<Function>,
        order: &[Handle<Function>],
    ) -> Result<PrintedFunction, String> {
        let function = &self.module.functions[handle];
        let called = crate::link::calls(&function.body);
        let mut calls: Vec<usize> = called
            .iter()
            .filter_map(|c| order.iter().position(|o| o == c))
            .collect();
        calls.sort_unstable();
        calls.dedup();
        let (signature, text) = FunctionPrinter::new(self, handle)?.print()?;
        Ok(PrintedFunction {
            name: self.functions[&handle].clone(),
            signature,
            text,
            calls,
            handle,
        })
    }

    /// Structures, constants, helpers and uniforms that were used.
    fn declarations(&self, out: &mut Printed) -> Result<(), String> {
        let mut constants = Vec::new();
        let wanted = self.used_constants.borrow().clone();
        for handle in wanted {
            constants.push(self.constant(handle)?);
        }
        let globals = self.used_globals.borrow().clone();
        for handle in globals {
            out.uniforms.push(self.global(handle)?);
        }
        let structs = self.structures()?;
        if self.dialect == Dialect::C {
            let vectors = self.vectors.borrow();
            out.head.extend(vectors.iter().map(|v| v.declaration()));
        }
        out.head.extend(structs);
        if !constants.is_empty() {
            out.head.push(constants.join("\n"));
        }
        out.head.extend(self.helpers.borrow().values().cloned());
        Ok(())
    }
}
