//! Joining shader modules by name.
//!
//! A function that one module only declares, by a stub, is replaced by the function of the same name from a
//! library module or from the compiler. Only what the roots reach is copied; callees precede their callers, as
//! naga requires.

mod import;
mod linker;
mod sources;

pub(crate) use linker::calls;
pub use linker::{LinkError, Linker, Provider, is_stub};
pub use sources::{Sources, entry_module, math_module, number_module, parse_wgsl, shared_module};
