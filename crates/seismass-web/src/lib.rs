//! The kernel for the live page: one case of a uniform building under one motion, and its effective fraction of live load
//! over a suite, behind functions that JavaScript calls with arrays of numbers.
//!
//! On WebAssembly the kernel has its baseline instructions and gives the bits of `SEISMASS_INSTRUCTIONS=baseline` on every
//! other machine. Elsewhere this crate builds too, so that it is checked and tested with the others.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod case;
mod curve;
mod design;
mod effective;
mod interface;
mod run;
mod scatter;
mod sections;
