//! The linker: which function a name means, and in what order functions are copied.

use naga::{Function, FunctionResult, Handle, Module, Span, Statement, Type};
use rustc_hash::FxHashMap;

use super::import::Importer;
use crate::lower::LowerError;

/// Gives the functions that the compiler generates.
pub trait Provider {
    /// Builds the function that stands in for the stub of this name, or `None` where the name is not a demand.
    /// `stub` is the declaration, its types already those of the linker's module.
    ///
    /// # Errors
    /// The function cannot be built.
    fn provide(
        &mut self,
        name: &str,
        stub: &Function,
        linker: &mut Linker,
    ) -> Result<Option<Function>, LowerError>;
}

/// Modules could not be joined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkError {
    /// The function that was to be copied exists nowhere.
    Missing(String),
    /// The stub and the function that replaces it have different signatures.
    Signature(String),
    /// Functions call each other in a circle.
    Circle(String),
    /// A module uses something that our shader texts must not.
    Unsupported(&'static str),
    /// A generated function could not be built.
    Lower(LowerError),
}

/// A function in one of the source modules.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Place {
    source: usize,
    function: Handle<Function>,
}

/// Builds one module out of several.
pub struct Linker<'a> {
    /// The module that is being built.
    pub out: Module,
    sources: Vec<&'a Module>,
    /// The function that each name means: the first that is not a stub, in the order of the sources.
    by_name: FxHashMap<&'a str, Place>,
    importers: Vec<Importer>,
    done: FxHashMap<Place, Handle<Function>>,
    /// Functions that were generated on demand, by name.
    generated: FxHashMap<String, Handle<Function>>,
    active: Vec<Place>,
}

impl<'a> Linker<'a> {
    /// A linker over source modules; where several define a name, the first in this order that is not a stub is
    /// meant.
    #[must_use]
    pub fn new(sources: Vec<&'a Module>) -> Self {
        let mut by_name: FxHashMap<&str, Place> = FxHashMap::default();
        for (source, module) in sources.iter().enumerate() {
            for (function, body) in module.functions.iter() {
                let Some(name) = body.name.as_deref() else {
                    continue;
                };
                let place = Place { source, function };
                match by_name.get(name) {
                    Some(known) if !is_stub(&sources[known.source].functions[known.function]) => {}
                    Some(_) if is_stub(body) => {}
                    _ => {
                        by_name.insert(name, place);
                    }
                }
            }
        }
        let importers = sources.iter().map(|_| Importer::default()).collect();
        Self {
            out: Module::default(),
            sources,
            by_name,
            importers,
            done: FxHashMap::default(),
            generated: FxHashMap::default(),
            active: Vec::new(),
        }
    }

    /// Copies every entry point of a source module with all that it reaches.
    ///
    /// # Errors
    /// See [`LinkError`].
    pub fn link_entry_points(
        &mut self,
        source: usize,
        provider: &mut dyn Provider,
    ) -> Result<(), LinkError> {
        for entry in &self.sources[source].entry_points {
            let mut entry = entry.clone();
            entry.function = self.copy(source, entry.function, provider)?;
            self.out.entry_points.push(entry);
        }
        Ok(())
    }

    /// Whether one of the sources has a function of this name.
    #[must_use]
    pub fn offers(&self, name: &str) -> bool {
        self.by_name.contains_key(name)
    }

    /// The function of this name in the module that is being built, copied or generated with all that it calls.
    ///
    /// # Errors
    /// See [`LinkError`].
    pub fn function(
        &mut self,
        name: &str,
        provider: &mut dyn Provider,
    ) -> Result<Handle<Function>, LinkError> {
        let Some(&place) = self.by_name.get(name) else {
            return Err(LinkError::Missing(name.to_owned()));
        };
        self.at(place, name, provider)
    }

    /// The copy of the function at a place, or what stands in for it where it is a stub.
    fn at(
        &mut self,
        place: Place,
        name: &str,
        provider: &mut dyn Provider,
    ) -> Result<Handle<Function>, LinkError> {
        if let Some(&handle) = self.done.get(&place) {
            return Ok(handle);
        }
        if self.active.contains(&place) {
            return Err(LinkError::Circle(name.to_owned()));
        }
        self.active.push(place);
        let body = self.sources[place.source].functions[place.function].clone();
        let declared = self.signature(place.source, &body)?;
        let generated = if is_stub(&body) {
            provider
                .provide(name, &declared, self)
                .map_err(LinkError::Lower)?
        } else {
            None
        };
        let function = match generated {
            Some(function) => function,
            None => self.copy(place.source, body, provider)?,
        };
        self.active.pop();
        let handle = self.append(function);
        self.done.insert(place, handle);
        Ok(handle)
    }

    /// What a module means by a function that it calls: its own where it has more than a stub of it and the function
    /// that has the name has another signature, else that function.
    fn callee(
        &mut self,
        source: usize,
        callee: Handle<Function>,
        provider: &mut dyn Provider,
    ) -> Result<Handle<Function>, LinkError> {
        let module = self.sources[source];
        let own = &module.functions[callee];
        let name = own.name.as_deref().unwrap_or_default();
        let declared = self.signature(source, own)?;
        let Some(&named) = self.by_name.get(name) else {
            return Err(LinkError::Missing(name.to_owned()));
        };
        let meant = &self.sources[named.source].functions[named.function];
        let meant = self.signature(named.source, meant)?;
        if same_signature(&declared, &meant) {
            return self.at(named, name, provider);
        }
        if is_stub(own) {
            return Err(LinkError::Signature(name.to_owned()));
        }
        let place = Place {
            source,
            function: callee,
        };
        self.at(place, name, provider)
    }

    /// Adds a finished function.
    pub fn append(&mut self, function: Function) -> Handle<Function> {
        self.out.functions.append(function, Span::UNDEFINED)
    }

    /// The function that was generated and kept under this name.
    #[must_use]
    pub fn generated(&self, name: &str) -> Option<Handle<Function>> {
        self.generated.get(name).copied()
    }

    /// Keeps a generated function, for others that call it.
    pub fn keep(&mut self, name: String, function: Handle<Function>) {
        self.generated.insert(name, function);
    }

    /// The global variable of this name, copied from the first source that has it.
    ///
    /// # Errors
    /// There is none.
    pub fn global(&mut self, name: &str) -> Result<Handle<naga::GlobalVariable>, LinkError> {
        for source in 0..self.sources.len() {
            let module = self.sources[source];
            let found = module
                .global_variables
                .iter()
                .find(|(_, g)| g.name.as_deref() == Some(name));
            if let Some((handle, _)) = found {
                return self.importers[source].global(module, &mut self.out, handle);
            }
        }
        Err(LinkError::Missing(name.to_owned()))
    }

    /// The type of this name, copied from the first source that has it.
    ///
    /// # Errors
    /// There is none.
    pub fn type_named(&mut self, name: &str) -> Result<Handle<Type>, LinkError> {
        for source in 0..self.sources.len() {
            let module = self.sources[source];
            let found = module
                .types
                .iter()
                .find(|(_, ty)| ty.name.as_deref() == Some(name));
            if let Some((handle, _)) = found {
                return self.importers[source].ty(module, &mut self.out, handle);
            }
        }
        Err(LinkError::Missing(name.to_owned()))
    }

    /// The arguments and the result of a function, with types of the module that is being built.
    fn signature(&mut self, source: usize, body: &Function) -> Result<Function, LinkError> {
        let mut out = Function {
            name: body.name.clone(),
            ..Function::default()
        };
        let module = self.sources[source];
        for argument in &body.arguments {
            let mut argument = argument.clone();
            argument.ty = self.importers[source].ty(module, &mut self.out, argument.ty)?;
            out.arguments.push(argument);
        }
        if let Some(result) = &body.result {
            let ty = self.importers[source].ty(module, &mut self.out, result.ty)?;
            out.result = Some(FunctionResult {
                ty,
                binding: result.binding.clone(),
            });
        }
        Ok(out)
    }

    /// Copies a function of a source module; what it calls is copied before.
    fn copy(
        &mut self,
        source: usize,
        mut function: Function,
        provider: &mut dyn Provider,
    ) -> Result<Function, LinkError> {
        let module = self.sources[source];
        let mut callees: FxHashMap<Handle<Function>, Handle<Function>> = FxHashMap::default();
        for callee in calls(&function.body) {
            if callees.contains_key(&callee) {
                continue;
            }
            let handle = self.callee(source, callee, provider)?;
            callees.insert(callee, handle);
        }
        let importer = &mut self.importers[source];
        importer.function(module, &mut self.out, &mut function, &callees)?;
        Ok(function)
    }

    /// A type of the module that is being built.
    pub fn insert_type(&mut self, ty: Type) -> Handle<Type> {
        self.out.types.insert(ty, Span::UNDEFINED)
    }
}

fn same_signature(a: &Function, b: &Function) -> bool {
    a.arguments.len() == b.arguments.len()
        && a.arguments
            .iter()
            .zip(&b.arguments)
            .all(|(x, y)| x.ty == y.ty)
        && a.result.as_ref().map(|r| r.ty) == b.result.as_ref().map(|r| r.ty)
}

/// Whether a function only declares: its body is nothing but `return` of a zero value.
#[must_use]
pub fn is_stub(function: &Function) -> bool {
    let mut value = None;
    for statement in &function.body {
        match statement {
            Statement::Emit(_) => {}
            Statement::Return {
                value: Some(returned),
            } => value = Some(*returned),
            _ => return false,
        }
    }
    value.is_some_and(|v| is_zero(function, v))
}

fn is_zero(function: &Function, value: Handle<naga::Expression>) -> bool {
    match &function.expressions[value] {
        naga::Expression::ZeroValue(_) => true,
        naga::Expression::Literal(literal) => match *literal {
            naga::Literal::F32(x) => x == 0.0,
            naga::Literal::U32(x) => x == 0,
            naga::Literal::I32(x) => x == 0,
            naga::Literal::Bool(x) => !x,
            _ => false,
        },
        naga::Expression::Splat { value, .. } => is_zero(function, *value),
        naga::Expression::Compose { components, .. } => {
            components.iter().all(|&c| is_zero(function, c))
        }
        _ => false,
    }
}

/// Every callee in a block, in order.
pub(crate) fn calls(block: &naga::Block) -> Vec<Handle<Function>> {
    let mut out = Vec::new();
    let mut stack: Vec<&naga::Block> = vec![block];
    while let Some(block) = stack.pop() {
        for statement in block {
            match statement {
                Statement::Call { function, .. } => out.push(*function),
                Statement::Block(inner) => stack.push(inner),
                Statement::If { accept, reject, .. } => stack.extend([accept, reject]),
                Statement::Switch { cases, .. } => stack.extend(cases.iter().map(|c| &c.body)),
                Statement::Loop {
                    body, continuing, ..
                } => stack.extend([body, continuing]),
                _ => {}
            }
        }
    }
    out
}
