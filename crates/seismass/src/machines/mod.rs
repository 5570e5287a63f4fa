//! The machines of a scene: a spring per storey, friction per block, and the model that joins them.

pub(crate) mod block;
pub(crate) mod guard;
pub(crate) mod model;
pub(crate) mod segment;
pub(crate) mod settle;
pub(crate) mod sign;
pub(crate) mod spring_path;
pub(crate) mod springs;
pub(crate) mod storey;
