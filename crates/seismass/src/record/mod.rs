//! What is kept of a run: peaks in continuous time, histories, energies.

pub(crate) mod energy;
pub(crate) mod forces;
pub(crate) mod histories;
pub(crate) mod observer;
pub(crate) mod peaks;
pub(crate) mod update;
