//! How accurate functions and formulas are. What judges a function is the runtime's, for `pullback accuracy`; the formulas
//! and the second derivatives are here.

pub use pullback_runtime::accuracy::{bounds, error, measure, sweep, tables};

pub mod evaluators;
pub mod formulas;
pub mod literature;
pub mod report;
pub mod second;
pub mod subjects;
