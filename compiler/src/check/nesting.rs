//! How deep loops stand within one another, and how many steps they take together.

use crate::ir::{Graph, Id, Op};
use pullback_grammar::{Diagnostic, Span};

use super::Builder;

/// Greatest number of loops within one another.
pub const MAX_LOOP_NESTING: usize = 8;
/// Greatest number of steps of a loop, times those of the loops around it.
pub const MAX_STEPS: u32 = 100_000;

/// Loops within one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Extent {
    /// The product of their greatest numbers of steps.
    pub steps: u64,
    /// How many they are.
    pub depth: usize,
}

impl Extent {
    /// No loop.
    pub const NONE: Self = Self { steps: 1, depth: 0 };

    fn within(self, other: Self) -> Self {
        Self {
            steps: self.steps.saturating_mul(other.steps),
            depth: self.depth + other.depth,
        }
    }

    fn or_deeper(self, other: Self) -> Self {
        Self {
            steps: self.steps.max(other.steps),
            depth: self.depth.max(other.depth),
        }
    }
}

/// The loops around what is being built, and those inside of it so far.
#[derive(Clone, Copy, Debug)]
pub struct Nesting {
    around: Extent,
    inside: Extent,
}

impl Default for Nesting {
    fn default() -> Self {
        Self {
            around: Extent::NONE,
            inside: Extent::NONE,
        }
    }
}

impl Nesting {
    /// What was before a loop or call; to be given back when it ends.
    pub fn apart(&mut self) -> Self {
        let before = *self;
        self.inside = Extent::NONE;
        before
    }

    /// What was before a constant, which is computed outside of every loop.
    pub fn outermost(&mut self) -> Self {
        std::mem::take(self)
    }

    /// The body of a loop begins.
    pub fn enter(&mut self, limit: u32) -> Self {
        let before = self.apart();
        self.around = self.around.within(Extent {
            steps: u64::from(limit),
            depth: 1,
        });
        before
    }

    /// The body of a loop ends.
    pub fn leave(&mut self, limit: u32, before: Self) -> Extent {
        let body = self.inside;
        let own = Extent {
            steps: u64::from(limit),
            depth: 1,
        };
        *self = before;
        self.inside = self.inside.or_deeper(own.within(body));
        body
    }

    /// A call ends; what it contains.
    pub fn join(&mut self, before: Self) -> Extent {
        let call = self.inside;
        *self = before;
        self.inside = self.inside.or_deeper(call);
        call
    }
}

impl Builder<'_> {
    /// Whether loops may stand here; reports why not.
    pub(super) fn admits(&mut self, loops: Extent, span: Span) -> bool {
        let together = self.nesting.around.within(loops);
        if together.depth > MAX_LOOP_NESTING {
            self.report(
                Diagnostic::error(
                    "too-deep",
                    span,
                    format!("more than {MAX_LOOP_NESTING} loops within one another"),
                )
                .with_hint("compute what does not change in an outer loop outside of it"),
            );
            return false;
        }
        if together.steps > u64::from(MAX_STEPS) {
            self.too_many_steps(loops, span);
            return false;
        }
        true
    }

    fn too_many_steps(&mut self, loops: Extent, span: Span) {
        let around = self.nesting.around.steps;
        let problem = if around > 1 {
            let message = format!(
                "{} steps within {around}, more than {MAX_STEPS} together",
                loops.steps
            );
            Diagnostic::error("too-many-steps", span, message).with_hint(
                "take fewer steps in one of them: the product of the maxima of nested loops counts",
            )
        } else {
            let message = format!("{} steps are more than {MAX_STEPS}", loops.steps);
            Diagnostic::error("too-many-steps", span, message)
                .with_hint(format!("take at most {MAX_STEPS}"))
        };
        self.report(problem);
    }

    /// A call that was built before is used again; `false` where its loops do not fit here.
    pub(super) fn reuse(&mut self, loops: Extent, span: Span) -> bool {
        self.nesting.inside = self.nesting.inside.or_deeper(loops);
        loops == Extent::NONE || self.admits(loops, span)
    }

    /// Something that is remembered together with what was found while it was built is forgotten, where it was
    /// built since `calls` and `constants` were so many.
    pub(super) fn forget(&mut self, calls: usize, constants: usize) {
        self.calls.retain(|_, known| known.place < calls);
        self.derivatives.clear();
        self.constants.retain(|_, known| known.1 < constants);
    }
}

/// The parameter without a range that a number of steps depends on.
pub fn open_param(graph: &Graph, count: Id, has_range: impl Fn(u16) -> bool) -> Option<u16> {
    const MAX_VISITS: usize = 256;
    let mut stack = vec![count];
    for _ in 0..MAX_VISITS {
        let node = graph.node(stack.pop()?);
        match node.op {
            Op::Param(k) if !has_range(k) => return Some(k),
            _ => stack.extend(node.args.iter().copied()),
        }
    }
    None
}
