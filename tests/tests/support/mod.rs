//! What several suites share.

pub mod formulas;
