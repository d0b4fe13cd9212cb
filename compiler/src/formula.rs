//! A formula that has been checked: what it takes, what it gives, and its IR.

use std::borrow::Cow;

use pullback_grammar::Span;
use smallvec::SmallVec;

use crate::check::Value;
use crate::ir::{Graph, Id, Op, Ty};
use crate::stable::{Phase, Rewrites, stabilise};
use crate::types::Type;

/// One argument of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
}

/// What a formula computes, as IR.
#[derive(Clone, Debug)]
pub struct Form {
    /// The IR.
    pub graph: Graph,
    /// The value: one node, or the components of a vector.
    pub value: SmallVec<[Id; 4]>,
}

/// A function or bare formula with resolved types.
#[derive(Clone, Debug)]
pub struct Formula {
    /// Its name; `f` for a bare formula.
    pub name: String,
    /// Its arguments in order.
    pub inputs: Vec<Input>,
    /// The IR. The scalar inputs are the components of the arguments in order, a complex one being one input.
    pub graph: Graph,
    /// The value: one node, or the components of a vector.
    pub value: SmallVec<[Id; 4]>,
    /// Type of the value.
    pub ty: Type,
    /// Where it stands in the text.
    pub span: Span,
    /// Which stability rewrites are done where it is compiled for the GPU. The graph itself is as written, the
    /// derivatives that stand in it those of what is written.
    pub rewrites: Rewrites,
    /// The formula with those derivatives taken of expressions that were rewritten before, where there are such; made
    /// with [`Self::rewrites`] by the compiler. Nothing else in it is rewritten.
    pub derived: Option<Form>,
}

impl Formula {
    /// The same formula with other stability rewrites. Derivatives that stand in it are then those of what is written,
    /// as only the program's text can be compiled with others: `Program::with_rewrites` does that.
    #[must_use]
    pub fn with_rewrites(mut self, rewrites: Rewrites) -> Self {
        if rewrites != self.rewrites {
            self.derived = None;
        }
        self.rewrites = rewrites;
        self
    }

    /// What is compiled for the GPU, before the rewrites of the whole.
    #[must_use]
    pub fn to_compile(&self) -> (&Graph, &[Id]) {
        match &self.derived {
            Some(form) if self.rewrites.any() => (&form.graph, &form.value),
            _ => (&self.graph, &self.value),
        }
    }

    /// The formula with those rewrites done that come before it is differentiated.
    #[must_use]
    pub fn stabilised(&self) -> Cow<'_, Self> {
        if !self.rewrites.any() {
            return Cow::Borrowed(self);
        }
        let (graph, value) = self.to_compile();
        let stable = stabilise(graph, value, self.rewrites, Phase::Early);
        if stable.applied.is_empty() && self.derived.is_none() {
            return Cow::Borrowed(self);
        }
        Cow::Owned(Self {
            name: self.name.clone(),
            inputs: self.inputs.clone(),
            graph: stable.graph,
            value: stable.roots.into(),
            derived: None,
            ..*self
        })
    }

    /// The leaf of the k-th scalar input, by IR type; added to the graph where the formula does not use it.
    pub fn leaf(graph: &mut Graph, k: usize, ty: Ty) -> Id {
        graph.leaf(Op::Input(u16::try_from(k).unwrap_or(u16::MAX)), ty)
    }

    /// IR types of the scalar inputs.
    #[must_use]
    pub fn scalars(&self) -> Vec<Ty> {
        self.inputs
            .iter()
            .flat_map(|input| scalar_types(input.ty))
            .collect()
    }

    /// Names of the real columns that hold the arguments in tables.
    #[must_use]
    pub fn columns(&self) -> Vec<String> {
        self.inputs
            .iter()
            .flat_map(|input| column_names(&input.name, input.ty))
            .collect()
    }
}

/// IR types of the scalars that make up a value.
#[must_use]
pub fn scalar_types(ty: Type) -> Vec<Ty> {
    match ty {
        Type::Real => vec![Ty::Real],
        Type::Complex => vec![Ty::Complex],
        Type::Bool => vec![Ty::Bool],
        Type::Vector(n) => vec![Ty::Real; usize::from(n)],
    }
}

/// Names of the columns of a value in tables.
#[must_use]
pub fn column_names(name: &str, ty: Type) -> Vec<String> {
    match ty {
        Type::Real | Type::Bool => vec![name.to_owned()],
        Type::Complex => vec![format!("re({name})"), format!("im({name})")],
        Type::Vector(n) => ["x", "y", "z", "w"]
            .iter()
            .take(usize::from(n))
            .map(|c| format!("{name}.{c}"))
            .collect(),
    }
}

/// The value that stands for an argument while a formula is built.
pub fn argument_value(graph: &mut Graph, first: usize, ty: Type) -> Value {
    let leaves = scalar_types(ty)
        .into_iter()
        .enumerate()
        .map(|(k, scalar)| Formula::leaf(graph, first + k, scalar));
    let value = match ty {
        Type::Vector(_) => Value::Vector(leaves.collect()),
        _ => leaves.map(Value::Scalar).next().unwrap_or(Value::Error),
    };
    // it stands in the text where it is first used
    graph.cover(Span::default());
    value
}
