//! How accurate functions and formulas are: references, errors, bounds, and the evaluators that are judged.

pub mod bounds;
pub mod error;
pub mod evaluators;
pub mod formulas;
pub mod literature;
pub mod measure;
pub mod report;
pub mod second;
pub mod subjects;
pub mod sweep;
pub mod tables;
