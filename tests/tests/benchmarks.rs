//! The benchmark expressions of FPBench and Herbie.
