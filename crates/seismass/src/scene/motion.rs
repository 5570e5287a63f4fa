//! Ground acceleration.

use std::sync::Arc;

use crate::error::{Domain, Error, Result};

/// Longest motion a run takes (samples): 0.8 GB.
pub const MAX_SAMPLES: usize = 100_000_000;

/// Ground acceleration, linear between samples; the first sample is at t = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    dt: f64,
    acceleration: Arc<[f64]>,
    vertical: Option<Arc<[f64]>>,
}

impl Motion {
    /// A motion of horizontal samples (m/s2) at step `dt` (s), optionally with vertical ones (up positive).
    ///
    /// # Errors
    /// [`Error::Invalid`] when there is no sample, a value is not finite, `dt` is not positive, or lengths differ.
    pub fn new(acceleration: impl Into<Arc<[f64]>>, dt: f64, vertical: Option<Arc<[f64]>>) -> Result<Self> {
        let acceleration = acceleration.into();
        let refuse = |parameter: &str, requirement: String, value: String| {
            Err(Error::invalid(Domain::Motion, parameter, "motion", requirement, value))
        };
        if !(dt.is_finite() && dt > 0.0) {
            return refuse("dt", "a positive number".into(), dt.to_string());
        }
        if acceleration.is_empty() || acceleration.len() > MAX_SAMPLES {
            let requirement = format!("a list of 1 to {MAX_SAMPLES} samples");
            return refuse("acceleration", requirement, format!("{} samples", acceleration.len()));
        }
        if let Some(i) = acceleration.iter().position(|a| !a.is_finite()) {
            return refuse(
                "acceleration",
                "finite at every sample".into(),
                format!("{} at sample {i}", acceleration[i]),
            );
        }
        if let Some(vertical) = &vertical {
            if vertical.len() != acceleration.len() {
                let requirement = format!("as long as the horizontal one, {} samples", acceleration.len());
                return refuse("vertical acceleration", requirement, format!("{} samples", vertical.len()));
            }
            if let Some(i) = vertical.iter().position(|a| !a.is_finite()) {
                return refuse(
                    "vertical acceleration",
                    "finite at every sample".into(),
                    format!("{} at sample {i}", vertical[i]),
                );
            }
        }
        Ok(Self { dt, acceleration, vertical })
    }

    /// The motion up to the sample nearest to `duration` (s): cut, or continued at zero, which it reaches over one step.
    ///
    /// # Errors
    /// [`Error::Invalid`] when the duration is negative, not finite or too long.
    pub fn with_duration(&self, duration: f64) -> Result<Self> {
        let last = (duration / self.dt).round();
        if !(duration >= 0.0 && last < MAX_SAMPLES as f64) {
            let requirement = format!("between 0 and {} s", (MAX_SAMPLES - 1) as f64 * self.dt);
            return Err(Error::invalid(Domain::Motion, "duration", "motion", requirement, duration));
        }
        let length = last as usize + 1;
        let resize = |samples: &Arc<[f64]>| -> Arc<[f64]> {
            let mut samples = samples.to_vec();
            samples.resize(length, 0.0);
            samples.into()
        };
        Ok(Self { dt: self.dt, acceleration: resize(&self.acceleration), vertical: self.vertical.as_ref().map(resize) })
    }

    /// The motion with both components multiplied by `factor`.
    ///
    /// # Errors
    /// [`Error::Invalid`] when the factor, or a sample times it, is not a finite number.
    pub fn scaled(&self, factor: f64) -> Result<Self> {
        if !factor.is_finite() {
            return Err(Error::invalid(Domain::Motion, "factor", "scaled motion", "a finite number", factor));
        }
        if factor == 1.0 {
            return Ok(self.clone());
        }
        let multiply = |samples: &Arc<[f64]>| -> Arc<[f64]> { samples.iter().map(|a| a * factor).collect() };
        Self::new(multiply(&self.acceleration), self.dt, self.vertical.as_ref().map(multiply))
    }

    /// The same motion with each sample interval divided into `parts`.
    pub(crate) fn divided(&self, parts: usize) -> Self {
        if parts == 1 {
            return self.clone();
        }
        let divide = |samples: &Arc<[f64]>| -> Arc<[f64]> {
            let (intervals, last) = (samples.iter().zip(&samples[1..]), samples.last().copied());
            let within = |part: usize| part as f64 / parts as f64;
            let divided =
                intervals.flat_map(|(&start, &end)| (0..parts).map(move |part| start + (end - start) * within(part)));
            divided.chain(last).collect()
        };
        let (acceleration, vertical) = (divide(&self.acceleration), self.vertical.as_ref().map(divide));
        Self { dt: self.dt / parts as f64, acceleration, vertical }
    }

    /// Time step (s).
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Horizontal ground acceleration (m/s2).
    pub fn acceleration(&self) -> &[f64] {
        &self.acceleration
    }

    /// Vertical ground acceleration (m/s2), up positive.
    pub fn vertical(&self) -> Option<&[f64]> {
        self.vertical.as_deref()
    }
}
