//! From a formula to exact derivatives and GPU shaders.
//!
//! [`compile`] turns a text into a [`Program`]; a program gives scene modules, evaluation modules, an `f64`
//! evaluator, and text in several shading languages. No input or output happens here, and nothing panics,
//! whatever the text.

// A library neither prints nor gives up; tests may.
#![cfg_attr(
    not(test),
    warn(
        clippy::expect_used,
        clippy::panic,
        clippy::print_stderr,
        clippy::print_stdout,
        clippy::unreachable,
        clippy::unwrap_used
    )
)]

pub mod check;
pub mod defined;
pub mod derive;
pub mod emit;
pub mod eval;
pub mod formula;
pub mod integrate;
pub mod ir;
pub mod link;
pub mod lower;
pub mod module;
mod numeral;
pub mod program;
pub mod reference;
pub mod scene;
mod simplify;
mod specialise;
pub mod stable;
pub mod table;
pub mod types;

pub use emit::{Emission, EmitWhat, Emitted, EmittedFunction, ParamsAs, Target};
pub use module::{EvalModule, Evaluator, SceneModule, What};
pub use program::{
    Compilation, ParamInfo, Picture, Program, SettingValue, compile, compile_bytes,
    compile_function,
};
