//! Which functions are written out where they are called, and where the registers of the others begin.

use naga::{Block, Expression, Function, Handle, Module, ScalarKind, Statement, TypeInner};

use crate::executor::Arithmetic;
use crate::executor::fault::Fault;
use crate::executor::library::stand;
use crate::executor::program::{Options, Watched};

/// Functions of no more expressions than this, with all that is written out in them, are written out everywhere.
const SMALL: usize = 48;
/// How deep functions are written out within each other.
const MAX_DEPTH: usize = 12;

/// What becomes of a function.
#[derive(Clone, Copy, Debug, Default)]
struct Plan {
    called: bool,
    /// The table's definition stands in for it.
    stands_in: bool,
    written_out: bool,
    /// It is written out, and gives a word of nothing but its arguments.
    word: bool,
    weight: usize,
    depth: usize,
    /// The first register that is free of all that it calls; above its own once it is translated.
    floor: u32,
}

/// The plan of every function of a module.
#[derive(Debug)]
pub(super) struct Plans(Vec<Plan>);

impl Plans {
    pub fn new(module: &Module, root: &Function, options: Options) -> Result<Self, Fault> {
        let count = module.functions.len();
        let mut plans = Self(vec![Plan::default(); count]);
        let mut sites = vec![0_usize; count];
        for (handle, function) in module.functions.iter() {
            let reference = options.arithmetic == Arithmetic::Reference;
            plans.0[handle.index()].stands_in =
                reference && stand(function, &module.types).is_some();
        }
        plans.call(root, &mut sites);
        // callers come after what they call
        for (handle, function) in module
            .functions
            .iter()
            .collect::<Vec<_>>()
            .into_iter()
            .rev()
        {
            let plan = plans.0[handle.index()];
            if plan.called && !plan.stands_in {
                plans.call(function, &mut sites);
            }
        }
        for (handle, function) in module.functions.iter() {
            if !plans.0[handle.index()].called {
                continue;
            }
            let mut plan = plans.0[handle.index()];
            plan.weight = function.expressions.len();
            plan.depth = 1;
            for callee in calls(&function.body) {
                let callee = plans.0[callee.index()];
                if callee.written_out {
                    // words are shared where functions that have them are written out, and nowhere else
                    let weight = if callee.word { 1 } else { callee.weight };
                    plan.weight = plan.weight.saturating_add(weight);
                    plan.depth = plan.depth.max(callee.depth + 1);
                }
            }
            let fits = plan.weight <= SMALL || sites[handle.index()] == 1;
            plan.written_out = fits && plan.depth <= MAX_DEPTH;
            // what is shared is not seen again
            let unseen = matches!(options.watched, Watched::Nothing);
            plan.word = plan.written_out && unseen && gives_word(function, module);
            plans.0[handle.index()] = plan;
        }
        Ok(plans)
    }

    fn call(&mut self, function: &Function, sites: &mut [usize]) {
        for callee in calls(&function.body) {
            self.0[callee.index()].called = true;
            sites[callee.index()] += 1;
        }
    }

    /// Whether the table's definition stands in for a function.
    pub fn stands_in(&self, handle: Handle<Function>) -> bool {
        self.0[handle.index()].stands_in
    }

    /// Whether a function is written out where it is called.
    pub fn is_written_out(&self, handle: Handle<Function>) -> bool {
        self.0[handle.index()].written_out
    }

    /// Whether a function is written out, and its result depends on nothing but its arguments: a word, of which hashes are
    /// made.
    pub fn is_word(&self, handle: Handle<Function>) -> bool {
        self.0[handle.index()].word
    }

    /// Whether a function is translated by itself.
    pub fn stands_alone(&self, handle: Handle<Function>) -> bool {
        let plan = self.0[handle.index()];
        plan.called && !plan.stands_in && !plan.written_out
    }

    /// The first register that is free of all that a function calls.
    pub fn floor(&mut self, function: &Function) -> u32 {
        let callees = calls(&function.body);
        let floors = callees.iter().map(|callee| self.0[callee.index()].floor);
        floors.max().unwrap_or(0)
    }

    /// Notes the floor of a function that is written out, or the top of one that is translated.
    pub fn set_floor(&mut self, handle: Handle<Function>, floor: u32) {
        self.0[handle.index()].floor = floor;
    }
}

/// Whether a function gives an unsigned integer that depends on nothing but its arguments.
fn gives_word(function: &Function, module: &Module) -> bool {
    let is_word = function.result.as_ref().is_some_and(|result| {
        let inner = &module.types[result.ty].inner;
        matches!(inner, TypeInner::Scalar(scalar) if scalar.kind == ScalarKind::Uint)
    });
    let mut statements = function.body.iter();
    let mut expressions = function.expressions.iter();
    is_word
        && function.local_variables.is_empty()
        && statements.all(|s| matches!(s, Statement::Emit(_) | Statement::Return { .. }))
        && expressions.all(|(_, e)| !matches!(e, Expression::GlobalVariable(_)))
}

/// Every callee in a block.
fn calls(block: &Block) -> Vec<Handle<Function>> {
    let mut out = Vec::new();
    let mut stack = vec![block];
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
