//! A scene under a motion by one of the methods.

use crate::reference::history::History;
use crate::reference::method::{Error, Method, checked, fraction, has_plain_laws, positive, require};
use crate::reference::{friction_springs, gauss, leapfrog, newmark, stepping};
use crate::scene::{Motion, Scene};

/// Integrates a scene under a motion.
///
/// # Errors
/// [`Error::Kernel`] with [`crate::Error::Invalid`] for a parameter out of its range or a scene the method does not
/// support; the others when the integration cannot go on.
pub fn integrate(scene: &Scene, motion: &Motion, method: &Method) -> Result<History, Error> {
    match *method {
        Method::Gauss { substeps, events } => {
            stepping::integrate(&gauss::Gauss, scene, motion, positive("substeps", substeps)?, checked(events)?)
        }
        Method::Newmark { substeps, events } => {
            stepping::integrate(&newmark::Newmark, scene, motion, positive("substeps", substeps)?, checked(events)?)
        }
        Method::FrictionSprings { substeps, stiffness_ratio, tolerance, max_iterations } => {
            require(
                stiffness_ratio.is_finite() && stiffness_ratio > 0.0,
                "stiffness_ratio",
                "positive",
                stiffness_ratio,
            )?;
            fraction("tolerance", tolerance)?;
            has_plain_laws(scene)?;
            let newton = friction_springs::Newton {
                substeps: positive("substeps", substeps)?,
                stiffness_ratio,
                tolerance,
                max_iterations: positive("max_iterations", max_iterations)?,
            };
            friction_springs::integrate(scene, motion, &newton)
        }
        Method::Leapfrog { substeps } => {
            has_plain_laws(scene)?;
            leapfrog::integrate(scene, motion, positive("substeps", substeps)?)
        }
    }
}
