//! What is known of the functions of a module: what they are called with, and what they return.

use naga::{Function, Handle};
use rustc_hash::FxHashMap;

use super::known::{Key, Known};

/// Arguments so far, and results from the round before.
#[derive(Debug, Default)]
pub struct Calls {
    arguments: FxHashMap<Handle<Function>, Vec<Option<Known>>>,
    values: FxHashMap<Handle<Function>, Known>,
    /// Values of calls with known arguments, where they are known.
    tried: FxHashMap<(Handle<Function>, Vec<Key>), Option<Known>>,
    /// How many functions are being tried, one within the other: what they call is not called.
    trials: usize,
}

impl Calls {
    /// Notes a call: an argument stays known while all calls agree on it.
    pub fn note<'a>(
        &mut self,
        function: Handle<Function>,
        arguments: impl Iterator<Item = Option<&'a Known>>,
    ) {
        if self.trials > 0 {
            return;
        }
        match self.arguments.get_mut(&function) {
            None => {
                let first = arguments.map(|a| a.cloned()).collect();
                self.arguments.insert(function, first);
            }
            Some(known) => {
                for (slot, argument) in known.iter_mut().zip(arguments) {
                    let same = matches!((&*slot, argument), (Some(x), Some(y)) if x.is(y));
                    if !same {
                        *slot = None;
                    }
                }
            }
        }
    }

    /// What the function is called with; `None` if nothing calls it.
    pub fn arguments(&self, function: Handle<Function>) -> Option<Vec<Option<Known>>> {
        self.arguments.get(&function).cloned()
    }

    /// What the function always returns.
    pub fn value(&self, function: Handle<Function>) -> Option<&Known> {
        self.values.get(&function)
    }

    /// Notes what a function always returns; whether that is news.
    pub fn returns(&mut self, function: Handle<Function>, value: Known) -> bool {
        self.values.insert(function, value).is_none()
    }

    /// What has come of trying a call with known arguments.
    pub fn tried(&self, function: Handle<Function>, arguments: &[Key]) -> Option<Option<Known>> {
        self.tried.get(&(function, arguments.to_vec())).cloned()
    }

    /// Calls are not noted until the trial ends.
    pub fn begin_trial(&mut self) {
        self.trials += 1;
    }

    /// Notes what has come of trying a call.
    pub fn end_trial(
        &mut self,
        function: Handle<Function>,
        arguments: Vec<Key>,
        value: Option<Known>,
    ) {
        self.trials -= 1;
        self.tried.insert((function, arguments), value);
    }

    /// Before the next round: all calls are looked at anew.
    pub fn forget_arguments(&mut self) {
        self.arguments.clear();
        self.tried.clear();
    }
}
