//! The solver as a whole: verification against exact, published and finite-element
//! values, conservation, and what it does with errors.
//!
//! One test program for all, because each would compile the solver's generic code
//! again. A part of it: `cargo test --release -p gimpm --test solid manufactured`.
#![allow(clippy::unwrap_used)]

mod bar;
mod block_compression;
mod conservation;
mod contact;
mod determinism;
mod errors;
mod lattice;
mod loops;
mod manufactured;
mod noise;
mod plate;
mod pressed_block;
mod shapes;
mod stability;
mod surface_load;
mod total;
mod total_static;
mod transfer;
