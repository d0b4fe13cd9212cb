//! The algebraic surfaces of docs/surfaces against what is known of them, and the pictures that the scene `surface` makes of
//! them against roots along rays.

mod algebra;
mod coordinates;
mod facts;
mod group;
mod lines;
mod polynomial;
mod program;
mod rays;
mod roots;
mod table;
