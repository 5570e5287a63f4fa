//! Events: the guards of all state machines as polynomials, the first that falls, and what it does (docs/numerics.md).

pub(crate) mod carry_out;
pub(crate) mod first;
pub(crate) mod guards;
