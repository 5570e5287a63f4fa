//! Bootstrap of means over motions, real building and models drawn together.

/// How often each resample has each motion.
#[derive(Debug, Clone, Default)]
pub(crate) struct Resamples {
    motions: usize,
    counts: Vec<f64>,
}

impl Resamples {
    /// Counts of `motions` motions, resample by resample; what is left of an incomplete one is not taken.
    pub(crate) fn new(motions: usize, counts: &[f64]) -> Self {
        let whole = counts.len() - if motions == 0 { counts.len() } else { counts.len() % motions };
        Self { motions, counts: counts[..whole].to_vec() }
    }

    /// Whether there is a resample, of so many motions.
    pub(crate) fn are_of(&self, motions: usize) -> bool {
        self.motions == motions && !self.counts.is_empty()
    }

    /// The mean of values, one per motion, in each resample.
    pub(crate) fn means(&self, values: &[f64]) -> Vec<f64> {
        let mean = |counts: &[f64]| {
            let total: f64 = counts.iter().sum();
            counts.iter().zip(values).map(|(count, value)| count * value).sum::<f64>() / total
        };
        self.counts.chunks_exact(self.motions).map(mean).collect()
    }
}

/// Percentiles, linear between the sorted values.
pub(crate) fn percentiles<const N: usize>(mut values: Vec<f64>, shares: [f64; N]) -> [f64; N] {
    values.sort_by(f64::total_cmp);
    shares.map(|share| {
        let place = share * (values.len() - 1) as f64;
        let (low, high) = (values[place.floor() as usize], values[place.ceil() as usize]);
        low + (high - low) * place.fract()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_weigh_motions_by_their_counts() {
        let resamples = Resamples::new(2, &[2.0, 0.0, 1.0, 1.0, 9.0]);
        assert!(resamples.are_of(2) && !resamples.are_of(3) && !Resamples::default().are_of(0));
        assert_eq!(resamples.means(&[1.0, 4.0]), [1.0, 2.5]);
    }

    #[test]
    fn percentiles_are_interpolated() {
        assert_eq!(percentiles(vec![3.0, 1.0, 2.0, 5.0], [0.0, 0.5, 1.0]), [1.0, 2.5, 5.0]);
    }
}
