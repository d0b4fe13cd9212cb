//! Functions of the operator table whose values are definitions in the language.
//!
//! A row whose form on the GPU is `Gpu::Defined`, or [`DEFINED`](table::DEFINED) on complex numbers, has its value from the
//! definition of the library that is named like its mnemonic with `_` in front, for reals or for complex numbers; a family
//! gives its order as the last argument. In
//! shaders it is a function of its own, lowered when something calls it, in the tier of the caller; in `f64` its graph is
//! evaluated. The derivative is the row's, so that no approximation is ever differentiated.

use std::sync::{Arc, OnceLock};

use rustc_hash::FxHashMap;

use crate::check::{Builder, Symbols, Value, library_file};
use crate::eval::{Leaves, Tape};
use crate::ir::{Graph, Id, Op, Prim, Ty};
use crate::reference::complex::complex;
use crate::table::{self, Number, Row, Typing};

/// The digits that a definition is for: it may take fewer terms where fewer are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Digits {
    /// Those of binary32.
    Single,
    /// Those of pairs of binary32 and of binary64.
    Wide,
}

/// Which definition is meant: of an operation, on reals or on complex numbers, for some digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key {
    /// The operation.
    pub prim: Prim,
    /// Whether the operands are complex.
    pub complex: bool,
    /// How many digits it is for.
    pub digits: Digits,
}

/// The value of an operation as a graph of its operands.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The graph; its inputs are the operands.
    pub graph: Graph,
    /// The value.
    pub root: Id,
    /// Types of the operands.
    pub inputs: Vec<Ty>,
}

/// What is known of an operation, once something has asked for it.
#[derive(Debug, Default)]
struct Entry {
    definition: OnceLock<Option<Arc<Definition>>>,
    tape: OnceLock<Option<Tape>>,
}

/// The entry of every operation that the table says is defined.
fn entry(key: Key) -> Option<&'static Entry> {
    static ENTRIES: OnceLock<FxHashMap<Key, Entry>> = OnceLock::new();
    let entries = ENTRIES.get_or_init(|| {
        let mut all = FxHashMap::default();
        for prim in table::rows().iter().flat_map(members) {
            for complex in [false, true] {
                for digits in [Digits::Single, Digits::Wide] {
                    let key = Key {
                        prim,
                        complex,
                        digits,
                    };
                    all.insert(key, Entry::default());
                }
            }
        }
        all
    });
    entries.get(&key)
}

/// The definition of an operation; `None` where there is none for operands of this type.
#[must_use]
pub fn definition(key: Key) -> Option<Arc<Definition>> {
    entry(key)?
        .definition
        .get_or_init(|| build(key).map(Arc::new))
        .clone()
}

fn build(key: Key) -> Option<Definition> {
    let row = table::row(key.prim);
    let ty = if key.complex { Ty::Complex } else { Ty::Real };
    let inputs = vec![ty; row.typing.arity()];
    let symbols = Symbols::default();
    let mut builder = Builder::new(library_file(), &symbols).for_digits(key.digits);
    let mut values: Vec<Value> = Vec::new();
    for k in 0..inputs.len() {
        let leaf = Op::Input(u16::try_from(k).ok()?);
        values.push(Value::Scalar(builder.graph.leaf(leaf, ty)));
    }
    if let Some(order) = key.prim.order() {
        let order = builder.graph.real(order.into());
        values.push(Value::Scalar(order));
    }
    let value = builder.defined(&format!("_{}", row.mnemonic), values)?;
    if builder.graph.ty(value) != ty {
        return None;
    }
    let (graph, roots) = builder.graph.compacted(&[value]);
    Some(Definition {
        graph,
        root: *roots.first()?,
        inputs,
    })
}

/// The name of an operation's function in shaders.
#[must_use]
pub fn shader_name(prim: Prim, complex: bool) -> String {
    let domain = if complex { "complex" } else { "real" };
    let mnemonic = table::row(prim).mnemonic;
    match prim.order() {
        Some(n) => format!("{domain}_{mnemonic}_{n}"),
        None => format!("{domain}_{mnemonic}"),
    }
}

/// The names in shaders of a row's functions, if they are defined in the language.
#[must_use]
pub fn shader_names(row: &Row) -> Vec<(Prim, String)> {
    let domains = [false, true].map(|complex| row.is_defined(complex).then_some(complex));
    let each = |prim| {
        let named = move |complex| (prim, shader_name(prim, complex));
        domains.into_iter().flatten().map(named)
    };
    members(row).into_iter().flat_map(each).collect()
}

/// The operations of a row: one, or one of each order of a family.
fn members(row: &Row) -> Vec<Prim> {
    match row.prim.order() {
        Some(_) => (0..=table::last_order(row.prim))
            .map(|n| row.prim.with_order(n))
            .collect(),
        None => vec![row.prim],
    }
}

/// The value of an operation in `f64`; `None` where it is not defined for such operands.
#[must_use]
pub fn value(prim: Prim, operands: &[Number]) -> Option<Number> {
    let always = matches!(table::row(prim).typing, Typing::Complex(_));
    let is_complex = |v: &Number| matches!(v, Number::Complex(_));
    let complex = always || operands.iter().any(is_complex);
    let mut inputs: smallvec::SmallVec<[Number; 4]> = operands.into();
    if complex {
        for input in &mut inputs {
            *input = Number::Complex(input.widened()?);
        }
    }
    run(
        Key {
            prim,
            complex,
            digits: Digits::Wide,
        },
        &inputs,
    )
}

fn run(key: Key, inputs: &[Number]) -> Option<Number> {
    let made = || definition(key).map(|d| Tape::new(&d.graph, &[d.root]));
    let tape = entry(key)?.tape.get_or_init(made).as_ref()?;
    let leaves = Leaves {
        inputs,
        params: &[],
        time: 0.0,
        pixel: 0.0,
    };
    let mut found = if key.complex {
        Number::Complex(complex(f64::NAN, f64::NAN))
    } else {
        Number::Real(f64::NAN)
    };
    tape.run_apart(&leaves, |value| found = value);
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every row that says so has a definition for each type that it takes.
    #[test]
    fn every_definition_is_there() {
        for row in table::rows() {
            for (prim, name) in shader_names(row) {
                let complex = name.starts_with("complex_");
                for digits in [Digits::Single, Digits::Wide] {
                    let key = Key {
                        prim,
                        complex,
                        digits,
                    };
                    assert!(definition(key).is_some(), "{key:?}");
                }
            }
        }
    }
}
