//! Where a function computes, reads and writes what: positions of its statements in the order of the text.

use naga::{Block, Expression, Function, Handle, LocalVariable, Statement};
use rustc_hash::FxHashMap;

use super::operands::{reads, variable_of};

/// A place in the text: the number of a statement, counted before those inside of it.
pub(super) type Position = u32;
/// A loop; 0 is none.
pub(super) type LoopId = u32;

/// Where something happens.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) at: Position,
    pub(super) within: LoopId,
}

/// One level of the way from the function's body to a statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    /// The block, by its address.
    block: usize,
    /// The statement, by its address.
    pub(super) statement: usize,
    index: usize,
    is_loop: bool,
}

/// A place where a variable is used.
#[derive(Clone, Debug)]
struct Reference {
    path: Vec<Level>,
    /// Whether it is a statement that gives the whole variable a value.
    sets: bool,
}

#[derive(Debug)]
struct LoopExtent {
    parent: LoopId,
    last: Position,
}

/// How a variable comes into being.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Birth {
    /// Before the statement of this address.
    Before(usize),
    /// In the store of this address.
    In(usize),
}

/// What is known of a function before it is printed.
#[derive(Debug, Default)]
pub(super) struct Survey {
    /// Where each expression is computed, if that is a moment.
    pub(super) computed: Vec<Option<Spot>>,
    /// What statements read.
    pub(super) uses: Vec<Vec<Spot>>,
    /// Operands of each call's result.
    pub(super) arguments: FxHashMap<Handle<Expression>, Vec<Handle<Expression>>>,
    stores: FxHashMap<Handle<LocalVariable>, Vec<Position>>,
    references: FxHashMap<Handle<LocalVariable>, Vec<Reference>>,
    loops: Vec<LoopExtent>,
    next: Position,
}

pub(super) fn address(statement: &Statement) -> usize {
    std::ptr::from_ref(statement).addr()
}

impl Survey {
    pub(super) fn new(function: &Function) -> Result<Self, &'static str> {
        let count = function.expressions.len();
        let mut out = Self {
            computed: vec![None; count],
            uses: vec![Vec::new(); count],
            loops: vec![LoopExtent {
                parent: 0,
                last: u32::MAX,
            }],
            ..Self::default()
        };
        out.block(function, &function.body, 0, &mut Vec::new())?;
        Ok(out)
    }

    fn block(
        &mut self,
        function: &Function,
        block: &Block,
        within: LoopId,
        path: &mut Vec<Level>,
    ) -> Result<(), &'static str> {
        for (index, statement) in block.iter().enumerate() {
            self.next += 1;
            let spot = Spot {
                at: self.next,
                within,
            };
            path.push(Level {
                block: std::ptr::from_ref(block).addr(),
                statement: address(statement),
                index,
                is_loop: matches!(statement, Statement::Loop { .. }),
            });
            self.statement(function, statement, spot, path)?;
            path.pop();
        }
        Ok(())
    }

    fn statement(
        &mut self,
        function: &Function,
        statement: &Statement,
        spot: Spot,
        path: &mut Vec<Level>,
    ) -> Result<(), &'static str> {
        for read in reads(statement)? {
            self.uses[read.index()].push(spot);
        }
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    self.computed[handle.index()] = Some(spot);
                    if let Expression::Load { pointer } = function.expressions[handle] {
                        self.refer(function, pointer, path, false);
                    }
                }
            }
            Statement::Call {
                arguments,
                result: Some(result),
                ..
            } => {
                self.computed[result.index()] = Some(spot);
                self.arguments.insert(*result, arguments.clone());
            }
            Statement::Store { pointer, .. } => {
                if let Some(variable) = variable_of(function, *pointer) {
                    self.stores.entry(variable).or_default().push(spot.at);
                }
                let whole = matches!(function.expressions[*pointer], Expression::LocalVariable(_));
                self.refer(function, *pointer, path, whole);
            }
            Statement::Block(inner) => self.block(function, inner, spot.within, path)?,
            Statement::If { accept, reject, .. } => {
                self.block(function, accept, spot.within, path)?;
                self.block(function, reject, spot.within, path)?;
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    self.block(function, &case.body, spot.within, path)?;
                }
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => {
                let this = LoopId::try_from(self.loops.len()).unwrap_or(0);
                self.loops.push(LoopExtent {
                    parent: spot.within,
                    last: u32::MAX,
                });
                self.block(function, body, this, path)?;
                self.block(function, continuing, this, path)?;
                self.next += 1;
                if let Some(condition) = break_if {
                    self.uses[condition.index()].push(Spot {
                        at: self.next,
                        within: this,
                    });
                }
                self.loops[this as usize].last = self.next;
            }
            _ => {}
        }
        Ok(())
    }

    fn refer(
        &mut self,
        function: &Function,
        pointer: Handle<Expression>,
        path: &[Level],
        sets: bool,
    ) {
        if let Some(variable) = variable_of(function, pointer) {
            self.references
                .entry(variable)
                .or_default()
                .push(Reference {
                    path: path.to_vec(),
                    sets,
                });
        }
    }

    /// Whether what is computed at one spot and written out at another would be computed more often.
    pub(super) fn is_repeated(&self, computed: Spot, written: Spot) -> bool {
        self.loop_between(computed.within, written.within).is_some()
    }

    /// The outermost loop around the second that is not around the first.
    fn loop_between(&self, outer: LoopId, inner: LoopId) -> Option<LoopId> {
        let mut found = None;
        let mut at = inner;
        while at != outer && at != 0 {
            found = Some(at);
            at = self.loops[at as usize].parent;
        }
        found
    }

    /// Whether a variable may have another value where it is written out than where it was read.
    pub(super) fn is_changed(
        &self,
        variable: Handle<LocalVariable>,
        read: Spot,
        written: Spot,
    ) -> bool {
        let last = match self.loop_between(read.within, written.within) {
            Some(id) => self.loops[id as usize].last,
            None => written.at.saturating_sub(1),
        };
        let stores = self.stores.get(&variable);
        stores.is_some_and(|all| all.iter().any(|&s| read.at < s && s <= last))
    }

    /// Whether a variable is used in one statement only, but for another that sets it.
    pub(super) fn is_only_in(
        &self,
        variable: Handle<LocalVariable>,
        statement: usize,
        but_for: usize,
    ) -> bool {
        let all = self.references.get(&variable);
        all.is_some_and(|all| {
            all.iter().all(|r| {
                let last = r.path.last().map(|l| l.statement);
                last == Some(but_for) || r.path.iter().any(|l| l.statement == statement)
            })
        })
    }

    /// Where a variable is declared; nothing where it is not used.
    pub(super) fn birth(
        &self,
        function: &Function,
        variable: Handle<LocalVariable>,
    ) -> Option<Birth> {
        let all = self.references.get(&variable)?;
        let first = all.first()?;
        let has_start = function.local_variables[variable].init.is_some();
        let mut best = None;
        for depth in 0..first.path.len() {
            let here = first.path[depth];
            let shared = |r: &Reference| r.path.get(depth).is_some_and(|l| l.block == here.block);
            if !all.iter().all(shared) {
                break;
            }
            let begins = first.sets && first.path.len() == depth + 1 && !has_start;
            if begins {
                return Some(Birth::In(here.statement));
            }
            let outside = first.path[..depth].iter().all(|l| !l.is_loop);
            if outside {
                best = Some(Birth::Before(here.statement));
            }
            let together = all.iter().all(|r| r.path[depth].index == here.index);
            if !together {
                break;
            }
        }
        best
    }
}
