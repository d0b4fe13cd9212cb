//! The benchmark expressions of FPBench and Herbie, and how many bits each tier loses on them.
//!
//! The expressions, points of their domains and exact values come from `tests/oracle/benchmarks.py`. FPBench: Damouche
//! et al., "Toward a standard benchmark format and suite for floating-point analysis", NSV 2016. Herbie: Panchekha et
//! al., "Automatically improving accuracy for floating point expressions", PLDI 2015.

pub mod bits;
pub mod data;
pub mod dense;
pub mod measure;
pub mod report;
pub mod rewriting;
pub mod store;
