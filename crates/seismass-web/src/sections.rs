//! Lists of numbers in one array: how many lists, the length of each, then all of them.

/// Lists as one array, which the page takes apart again.
pub(crate) fn sections(lists: &[&[f64]]) -> Vec<f64> {
    let lengths = lists.iter().map(|list| list.len() as f64);
    std::iter::once(lists.len() as f64)
        .chain(lengths)
        .chain(lists.iter().flat_map(|list| list.iter().copied()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_follow_their_number_and_lengths() {
        assert_eq!(sections(&[&[1.0, 2.0], &[], &[3.0]]), [3.0, 2.0, 0.0, 1.0, 1.0, 2.0, 3.0]);
    }
}
