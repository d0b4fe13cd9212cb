//! Which values get a name of their own, and which are written where they are used.

use naga::valid::{FunctionInfo, GlobalUse, ModuleInfo};
use naga::{Expression, Function, Handle, Module, TypeInner};
use rustc_hash::FxHashMap;

use super::operands::{operands, variable_of};
use super::survey::{Spot, Survey};

/// More operations than this are not written as one expression.
const MOST_OPERATIONS: u32 = 22;

/// How the expressions of a function are written.
#[derive(Debug)]
pub(super) struct Plan {
    /// Whether the expression has a name.
    pub(super) named: Vec<bool>,
    /// Whether anything needs it.
    pub(super) needed: Vec<bool>,
    pub(super) survey: Survey,
}

impl Plan {
    /// `by_reference` says of which expressions a language cannot write the part without a name for the whole.
    pub(super) fn new(
        module: &Module,
        infos: &ModuleInfo,
        function: &Function,
        info: &FunctionInfo,
        must_name: &dyn Fn(Handle<Expression>) -> bool,
    ) -> Result<Self, &'static str> {
        let survey = Survey::new(function)?;
        let count = function.expressions.len();
        let mut planner = Planner {
            module,
            infos,
            function,
            info,
            uses: survey.uses.clone(),
            long: vec![false; count],
            survey,
        };
        planner.measure()?;
        let (mut named, mut needed) = (vec![false; count], vec![false; count]);
        for (handle, expression) in function.expressions.iter().rev() {
            let at = handle.index();
            if planner.uses[at].is_empty() {
                continue;
            }
            needed[at] = true;
            let computed = planner.survey.computed[at];
            let is_named =
                computed.is_some_and(|c| planner.wants_name(handle, c) || must_name(handle));
            named[at] = is_named;
            let places = match (is_named, computed) {
                (true, Some(spot)) => vec![spot],
                _ => std::mem::take(&mut planner.uses[at]),
            };
            let called = planner.survey.arguments.get(&handle);
            let of_call = called.into_iter().flatten().copied().collect::<Vec<_>>();
            for operand in operands(expression)?.into_iter().chain(of_call) {
                let uses = &mut planner.uses[operand.index()];
                uses.extend(&places);
            }
        }
        Ok(Self {
            named,
            needed,
            survey: planner.survey,
        })
    }
}

struct Planner<'m> {
    module: &'m Module,
    infos: &'m ModuleInfo,
    function: &'m Function,
    info: &'m FunctionInfo,
    survey: Survey,
    /// Where each expression is written, as far as is known: those that use it come first.
    uses: Vec<Vec<Spot>>,
    /// Whether the expression and what is written in it would be too long.
    long: Vec<bool>,
}

impl Planner<'_> {
    /// Cuts long expressions apart.
    fn measure(&mut self) -> Result<(), &'static str> {
        let mut sizes = vec![0_u32; self.long.len()];
        for (handle, expression) in self.function.expressions.iter() {
            let mut size = match expression {
                Expression::Binary { .. }
                | Expression::Math { .. }
                | Expression::Select { .. }
                | Expression::Unary { .. }
                | Expression::CallResult(_) => 1,
                _ => 0,
            };
            let of_call = self.survey.arguments.get(&handle);
            let of_call = of_call.into_iter().flatten().copied().collect::<Vec<_>>();
            for operand in operands(expression)?.into_iter().chain(of_call) {
                let shared = self.info[operand].ref_count > 1
                    || self.function.named_expressions.contains_key(&operand);
                if !shared {
                    size += sizes[operand.index()];
                }
            }
            if size > MOST_OPERATIONS {
                self.long[handle.index()] = true;
                size = 0;
            }
            sizes[handle.index()] = size;
        }
        Ok(())
    }

    fn wants_name(&self, handle: Handle<Expression>, computed: Spot) -> bool {
        let uses = &self.uses[handle.index()];
        let users_name = self.function.named_expressions.contains_key(&handle);
        let repeated = uses.iter().any(|&u| self.survey.is_repeated(computed, u));
        match self.function.expressions[handle] {
            Expression::Load { pointer } => match variable_of(self.function, pointer) {
                // the variable's own name says as much
                Some(variable) => uses
                    .iter()
                    .any(|&u| self.survey.is_changed(variable, computed, u)),
                None => self.is_written(pointer) || (users_name && uses.len() > 1),
            },
            Expression::AccessIndex { .. } | Expression::Access { .. } if self.is_place(handle) => {
                false
            }
            Expression::AccessIndex { .. } => users_name,
            Expression::CallResult(callee) => {
                users_name || uses.len() > 1 || repeated || self.has_effect(callee)
            }
            _ => users_name || uses.len() > 1 || repeated || self.long[handle.index()],
        }
    }

    fn is_place(&self, handle: Handle<Expression>) -> bool {
        matches!(
            self.info[handle].ty.inner_with(&self.module.types),
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. }
        )
    }

    /// Whether a global variable that a pointer leads to is ever written.
    fn is_written(&self, mut pointer: Handle<Expression>) -> bool {
        loop {
            match self.function.expressions[pointer] {
                Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                    pointer = base;
                }
                Expression::GlobalVariable(global) => {
                    return self.info[global].contains(GlobalUse::WRITE);
                }
                _ => return true,
            }
        }
    }

    fn has_effect(&self, callee: Handle<Function>) -> bool {
        let info = &self.infos[callee];
        let globals = self.module.global_variables.iter();
        globals
            .map(|(global, _)| info[global])
            .any(|used| used.contains(GlobalUse::WRITE))
    }
}

/// The name that a user gave to what is read from each variable, where all readings have one name.
pub(super) fn names_of_readings(
    function: &Function,
    plan: &Plan,
) -> FxHashMap<Handle<naga::LocalVariable>, String> {
    let mut out: FxHashMap<Handle<naga::LocalVariable>, Option<String>> = FxHashMap::default();
    for (handle, expression) in function.expressions.iter() {
        let Expression::Load { pointer } = *expression else {
            continue;
        };
        let Expression::LocalVariable(variable) = function.expressions[pointer] else {
            continue;
        };
        if !plan.needed[handle.index()] {
            continue;
        }
        let Some(name) = function.named_expressions.get(&handle) else {
            continue;
        };
        let kept = (!plan.named[handle.index()]).then(|| name.clone());
        out.entry(variable)
            .and_modify(|known| {
                if *known != kept {
                    *known = None;
                }
            })
            .or_insert(kept);
    }
    out.into_iter()
        .filter_map(|(variable, name)| Some((variable, name?)))
        .collect()
}
