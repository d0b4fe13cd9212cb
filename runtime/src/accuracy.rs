//! How accurate every operation of the language is on an adapter, on each tier, and what it costs.
//!
//! The operator table says what there is and what is declared of it; the tables of `tests/oracle`, which the program
//! carries, say what is right.

pub mod allowance;
pub mod bounds;
pub mod cost;
pub mod decimal;
pub mod error;
pub mod evaluators;
pub mod measure;
pub mod random;
pub mod report;
pub mod subjects;
pub mod survey;
pub mod sweep;
pub mod tables;

mod chart;
mod json;
mod stopwatch;
