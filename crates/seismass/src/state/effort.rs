//! What steps of a tall building with peaks inside take.

/// Order of a series from which on its terms are looked at.
pub(crate) const LOWEST_ORDER: usize = 8;

/// What the last step with peaks inside has taken: into how many parts it was divided, and the order of their series.
/// The run keeps it, so that what the next one takes does not depend on where plain steps begin anew.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    pub(crate) parts: usize,
    pub(crate) order: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self { parts: 1, order: LOWEST_ORDER }
    }
}
