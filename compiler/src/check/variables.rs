//! Names that something is differentiated by.
//!
//! A derivative needs its variable as a leaf. A name that an expression of its scope differentiates by is therefore
//! bound to a leaf of its own while that scope is built; afterwards the leaf is replaced by what the name stands for.
//! Other names are bound to their values.

use std::sync::OnceLock;

use pullback_grammar::Span;
use pullback_grammar::ast::{Expr, File};
use smallvec::SmallVec;

use super::scope::Scope;
use super::{Builder, Source, Value, calculus, library};
use crate::ir::{Id, Op, Ty};

/// The calls of a text that differentiate, by the beginning of their places.
#[derive(Debug, Default)]
pub struct Differentiated {
    calls: Vec<(Span, Variables)>,
}

/// What a call differentiates by.
#[derive(Debug)]
enum Variables {
    /// Every parameter of the function around it.
    Parameters,
    /// These names; of a call that takes a point, names that stand in it as well.
    Names(Vec<String>),
}

impl Differentiated {
    /// Every call of a text that differentiates.
    pub fn of(file: &File) -> Self {
        let mut calls = Vec::new();
        for (_, expr, span) in file.exprs.iter() {
            let Expr::Call { callee, args, .. } = expr else {
                continue;
            };
            if calculus::by_name(&callee.text).is_none() {
                continue;
            }
            let behind = args.get(1..).unwrap_or(&[]);
            let names: Vec<String> = behind
                .iter()
                .filter_map(|&arg| match &file.exprs[arg] {
                    Expr::Name(name) => Some(name.text.clone()),
                    _ => None,
                })
                .collect();
            calls.push((
                span,
                if names.is_empty() {
                    Variables::Parameters
                } else {
                    Variables::Names(names)
                },
            ));
        }
        calls.sort_by_key(|call| call.0);
        Self { calls }
    }

    /// Whether a call inside of a place differentiates by a name; by a parameter also where it names none.
    fn by(&self, place: Span, name: &str, is_parameter: bool) -> bool {
        self.inside(place).any(|variables| match variables {
            Variables::Parameters => is_parameter,
            Variables::Names(names) => names.iter().any(|n| n == name),
        })
    }

    fn inside(&self, place: Span) -> impl Iterator<Item = &Variables> {
        let from = self.calls.partition_point(|c| c.0.start < place.start);
        let behind = self.calls.get(from..).unwrap_or(&[]).iter();
        behind
            .take_while(move |c| c.0.start < place.end)
            .map(|c| &c.1)
    }

    /// Those of the library.
    fn of_library() -> &'static Self {
        static CALLS: OnceLock<Differentiated> = OnceLock::new();
        CALLS.get_or_init(|| Self::of(library::file()))
    }
}

/// The names that the definition which is being built binds.
#[derive(Debug, Default)]
pub struct Frame<'a> {
    /// The parameters of the function, or the inputs of the formula, as they stand in the scope.
    pub(super) parameters: Vec<(&'a str, Value)>,
    /// Names that are bound to leaves of their own, innermost last.
    variables: Vec<Variable>,
}

/// A name that is bound to leaves of its own.
#[derive(Debug)]
struct Variable {
    /// The leaves in the place of the value's nodes.
    leaves: Value,
    /// What the leaves stand for.
    value: Value,
    /// Whether the value follows from variables before it; else it varies by itself.
    follows: bool,
}

impl<'a> Builder<'a> {
    fn differentiated(&self) -> &'a Differentiated {
        match self.source {
            Source::Program => &self.symbols.differentiated,
            Source::Library => Differentiated::of_library(),
        }
    }

    /// Leaves in the place of the numbers of a value, or `None` where it has none.
    pub(super) fn leaves_like(&mut self, value: &Value) -> Option<Value> {
        let mut leaves: SmallVec<[(Id, Id); 4]> = SmallVec::new();
        for id in value.all_ids() {
            let ty = self.graph.ty(id);
            let is_number = matches!(ty, Ty::Real | Ty::Complex);
            // a record has a number twice; a vector may have one in two components, which vary apart
            let is_twin = matches!(value, Value::Record(_)) && leaves.iter().any(|l| l.0 == id);
            if is_number && !is_twin {
                let leaf = self.graph.new_variable(ty);
                self.bounds.variables.insert(leaf, id);
                leaves.push((id, leaf));
            }
        }
        if leaves.is_empty() {
            return None;
        }
        if !matches!(value, Value::Record(_)) {
            let mut new = leaves.iter().map(|l| l.1);
            return Some(value.map(&mut |id| new.next().unwrap_or(id)));
        }
        let leaf_of = |id: Id| leaves.iter().find(|l| l.0 == id).map_or(id, |l| l.1);
        Some(value.map(&mut |id| leaf_of(id)))
    }

    /// Binds a name of the current scope to a value, or to leaves where something in `place` differentiates by it.
    /// To be ended by [`Self::release`].
    fn bind_as(&mut self, name: &'a str, value: Value, place: Span, follows: bool) {
        let calls = self.differentiated();
        let bound = if calls.by(place, name, false) {
            self.leaves_like(&value)
        } else {
            None
        };
        let Some(leaves) = bound else {
            self.scope.push(name, value);
            return;
        };
        self.scope.push(name, leaves.clone());
        self.frame.variables.push(Variable {
            leaves,
            value,
            follows,
        });
    }

    /// Binds a local, which follows from the names before it.
    pub(super) fn bind_local(&mut self, name: &'a str, value: Value, place: Span) {
        self.bind_as(name, value, place, true);
    }

    /// Binds a name that varies by itself, such as the running variable of a sum.
    pub(super) fn bind_running(&mut self, name: &'a str, value: Value, place: Span) {
        self.bind_as(name, value, place, false);
    }

    /// Number of names that are bound to leaves, to be given to [`Self::release`].
    pub(super) fn bound(&self) -> usize {
        self.frame.variables.len()
    }

    /// Replaces the leaves of the names that were bound since there were `bound` of them; they end to hold.
    pub(super) fn release(&mut self, bound: usize, built: &mut [Value]) {
        if self.frame.variables.len() <= bound {
            return;
        }
        let ended = self.frame.variables.split_off(bound);
        let pairs: Vec<(Id, Id)> = ended.iter().flat_map(pairs).collect();
        for value in built {
            *value = self.replaced(value, &pairs);
        }
    }

    /// A value with leaves replaced.
    pub(super) fn replaced(&mut self, value: &Value, pairs: &[(Id, Id)]) -> Value {
        if pairs.is_empty() {
            return value.clone();
        }
        let mut new = self.graph.replace(&value.all_ids(), pairs).into_iter();
        value.map(&mut |id| new.next().unwrap_or(id))
    }

    /// The frame of a definition whose parameters are in `scope`; binds those to leaves that its body differentiates
    /// by.
    pub(super) fn frame_of(&mut self, scope: &mut Scope<'a, Value>, body: Span) -> Frame<'a> {
        let mut frame = Frame::default();
        let calls = self.differentiated();
        let by_global = self.differentiates_by_global(body);
        let entries: Vec<(&'a str, Value)> = scope
            .entries()
            .map(|(name, value)| (name, value.clone()))
            .collect();
        scope.truncate(0);
        for (name, value) in entries {
            let varies = |id: &Id| !matches!(self.graph.node(*id).op, Op::Const(_));
            let wanted =
                calls.by(body, name, true) || (by_global && value.ids().iter().any(varies));
            let leaves = if wanted {
                self.leaves_like(&value)
            } else {
                None
            };
            let held = leaves.clone().unwrap_or_else(|| value.clone());
            scope.push(name, held.clone());
            frame.parameters.push((name, held));
            if let Some(leaves) = leaves {
                frame.variables.push(Variable {
                    leaves,
                    value,
                    follows: false,
                });
            }
        }
        frame
    }

    /// Whether something in a place differentiates by a `param` or the clock: the arguments of the function around it
    /// must not follow them then.
    fn differentiates_by_global(&self, place: Span) -> bool {
        let is_global = |name: &String| {
            matches!(name.as_str(), "time" | "pixel")
                || self.symbols.params.contains_key(name.as_str())
        };
        self.differentiated()
            .inside(place)
            .any(|variables| match variables {
                Variables::Names(names) => names.iter().any(is_global),
                Variables::Parameters => false,
            })
    }

    /// The place of the variable with these leaves among the variables.
    fn place_of_leaves(&self, leaves: &Value) -> Option<usize> {
        self.frame
            .variables
            .iter()
            .rposition(|v| v.leaves == *leaves)
    }

    /// A value in which the locals that follow from the named variables are replaced, and the leaves of the
    /// variables: what is then differentiated by them. Fails with the place of a name that stands for no variable.
    pub(super) fn opened(
        &mut self,
        value: &Value,
        names: &[&str],
    ) -> Result<(Value, Vec<Value>), usize> {
        let mut leaves = Vec::new();
        for (at, name) in names.iter().enumerate() {
            leaves.push(self.leaves_of(name).ok_or(at)?);
        }
        let value = self.varying(value, &leaves);
        let numbers = leaves.into_iter().enumerate().map(|(at, held)| match held {
            Value::Record(record) => record.value.ok_or(at),
            number => Ok(number),
        });
        Ok((value, numbers.collect::<Result<_, _>>()?))
    }

    /// [`Self::opened`] by the parameters of the definition.
    pub(super) fn opened_by_parameters(&mut self, value: &Value) -> (Value, Vec<Value>) {
        let parameters = self.frame.parameters.iter();
        let leaves: Vec<Value> = parameters.map(|(_, value)| value.clone()).collect();
        (self.varying(value, &leaves), leaves)
    }

    /// A value in which the locals are replaced that may depend on variables, which are given by their leaves. Those
    /// among the variables themselves stay.
    fn varying(&mut self, value: &Value, leaves: &[Value]) -> Value {
        let first = leaves
            .iter()
            .map(|l| self.place_of_leaves(l).map_or(0, |at| at + 1))
            .min();
        let later = self.frame.variables.get(first.unwrap_or(0)..);
        let following = later
            .unwrap_or(&[])
            .iter()
            .filter(|v| v.follows && !leaves.contains(&v.leaves));
        let pairs: Vec<(Id, Id)> = following.flat_map(pairs).collect();
        self.replaced(value, &pairs)
    }

    /// The leaves that a name stands for: those of a variable, an input, a state, a `param`, the clock. A record of
    /// leaves is given as such.
    fn leaves_of(&mut self, name: &str) -> Option<Value> {
        if let Some(value) = self.scope.get(name) {
            let is_leaf = |&id: &Id| {
                matches!(
                    self.graph.node(id).op,
                    Op::Input(_) | Op::State(..) | Op::Counter(_) | Op::Variable(_)
                )
            };
            let ids = value.all_ids();
            return (!ids.is_empty() && ids.iter().all(is_leaf)).then(|| value.clone());
        }
        let op = match name {
            "time" => Op::Time,
            "pixel" => Op::Pixel,
            _ if self.source == Source::Program => Op::Param(self.symbols.params.get(name)?.0),
            _ => return None,
        };
        Some(Value::Scalar(self.graph.leaf(op, Ty::Real)))
    }
}

fn pairs(variable: &Variable) -> SmallVec<[(Id, Id); 4]> {
    let (leaves, values) = (variable.leaves.all_ids(), variable.value.all_ids());
    let pairs = leaves.into_iter().zip(values);
    pairs.filter(|(leaf, value)| leaf != value).collect()
}
