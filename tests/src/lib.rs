//! Suites that cross the crates of pullback, and what they share: the corpora, what every answer of the compiler
//! has, and how accurate a number is.

#[cfg(feature = "gpu")]
pub mod accuracy;
#[cfg(feature = "gpu")]
pub mod benchmarks;
pub mod calculus;
pub mod constructs;
pub mod corpus;
#[cfg(feature = "gpu")]
pub mod deep_zoom;
pub mod formatting;
#[cfg(feature = "gpu")]
pub mod goldens;
pub mod holds;
pub mod loops;
pub mod mutate;
pub mod operations;
#[cfg(feature = "gpu")]
pub mod pictures;
pub mod same_module;
pub mod special;
#[cfg(feature = "gpu")]
pub mod special_batches;
#[cfg(feature = "gpu")]
pub mod special_cost;
#[cfg(feature = "gpu")]
pub mod special_record;
#[cfg(feature = "gpu")]
pub mod stability;
#[cfg(feature = "gpu")]
pub mod stills;
#[cfg(feature = "gpu")]
pub mod twins;
pub mod units;

#[cfg(feature = "gpu")]
pub use pullback_runtime::bench::marches;
