//! Suites that cross the crates of pullback, and what they share.
pub mod accuracy;
