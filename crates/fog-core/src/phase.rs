//! Analytic phase functions: how a droplet turns light, in closed form.
//!
//! All take m = 1 − cos θ in [0, 2], with θ the angle between the directions of travel before and after: m = 0 is straight
//! on, and floating point resolves it best where fog sends most of its light. Values are in 1/sr and integrate to 1 over
//! the sphere, so that they are the densities of their own samplers. Samplers map u = 0 to forward.

mod draine;
mod henyey_greenstein;
mod hg_draine;

pub use draine::Draine;
pub use henyey_greenstein::HenyeyGreenstein;
pub use hg_draine::HgDraine;

/// Why the parameters of a phase function were refused.
#[derive(Debug, thiserror::Error, PartialEq)]
#[error("{what} is {value}; valid: {valid}")]
pub struct PhaseError {
    /// Name of the parameter.
    pub what: &'static str,
    /// What was given.
    pub value: f64,
    /// What is valid.
    pub valid: &'static str,
}

/// Fails unless `inside`.
fn check(inside: bool, what: &'static str, value: f64, valid: &'static str) -> Result<(), PhaseError> {
    if inside { Ok(()) } else { Err(PhaseError { what, value, valid }) }
}
