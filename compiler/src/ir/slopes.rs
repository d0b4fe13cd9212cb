//! Derivatives of a value that are known better than from the operations it is made of.

use smallvec::SmallVec;

use super::{Graph, Id, Ty};

/// Derivatives of a real value by values that it is made of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slopes {
    /// Each value, and the derivative by it.
    pub by: SmallVec<[(Id, Id); 2]>,
    /// What else it is made of: the derivatives hold where these are constant.
    pub fixed: SmallVec<[Id; 2]>,
}

impl Slopes {
    /// The same of the nodes that `new` gives for each of these; `None` where it gives none.
    pub fn mapped(&self, mut new: impl FnMut(Id) -> Option<Id>) -> Option<Self> {
        Some(Self {
            by: self
                .by
                .iter()
                .map(|&(value, slope)| Some((new(value)?, new(slope)?)))
                .collect::<Option<_>>()?,
            fixed: self
                .fixed
                .iter()
                .map(|&id| new(id))
                .collect::<Option<_>>()?,
        })
    }
}

impl Graph {
    /// Remembers derivatives of a value. They are not kept where the value is older than one of their nodes, as where it has been
    /// simplified to one, and lost in a copy of the graph that lacks one.
    pub fn set_slopes(&mut self, value: Id, slopes: Slopes) {
        let by = slopes.by.iter().flat_map(|&(of, slope)| [of, slope]);
        let is_newer = by.chain(slopes.fixed.iter().copied()).all(|id| id < value);
        if is_newer && self.ty(value) == Ty::Real {
            self.slopes.entry(value).or_insert(slopes);
        }
    }

    /// The derivatives of a value that are remembered.
    #[must_use]
    pub fn slopes(&self, value: Id) -> Option<&Slopes> {
        self.slopes.get(&value)
    }
}
