//! The productions, one function each; `grammar.ebnf` at the root of this crate is the same in one page.
//!
//! What is no production lives elsewhere: the tokens and recovery in `cursor.rs`, the complaints in `complaint/`.
//!
//! The way from an expression down to its first operand is inlined: in deep brackets, returning through a function for
//! each production costs more than all else, as processors foresee only the innermost few returns.

mod arithmetic;
mod call;
mod expression;
mod form;
mod logic;
mod postfix;
mod primary;
mod show;
mod statement;
