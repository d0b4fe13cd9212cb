//! Suites that cross the crates of pullback, and what they share: the corpora, and what every answer of the
//! compiler has.

pub mod corpus;
pub mod holds;
pub mod mutate;
pub mod units;
