//! Droplets of a fog as a frame needs them: resolved, checked, in the units of their names.

use std::path::PathBuf;

use serde::Serialize;

/// The spectrum of a fog's droplets.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DropletsSpec {
    /// Gamma distribution of Hansen & Travis 1974.
    Gamma {
        /// Effective radius in µm, 0.01 to 500.
        effective_radius_um: f64,
        /// Effective variance, 0.001 to 0.33.
        effective_variance: f64,
    },
    /// n(r) ∝ r^α exp(−b r^γ), r the radius in µm (Deirmendjian 1969).
    ModifiedGamma {
        /// α, 0 to 1000.
        alpha: f64,
        /// b in µm^−γ, 1e-20 to 1e12.
        b: f64,
        /// γ, 0.25 to 8.
        gamma: f64,
    },
    /// A sum of lognormals, 1 to 16.
    Lognormals(Vec<LognormalSpec>),
    /// A measured spectrum: path of a CSV file as written in the configuration.
    File(PathBuf),
    /// A spectrum of the literature by its name.
    #[serde(untagged)]
    Named(String),
}

/// One lognormal of a sum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LognormalSpec {
    /// Number of droplets relative to the other lognormals, above 0.
    pub share: f64,
    /// Median diameter in µm, 0.02 to 500.
    pub median_diameter_um: f64,
    /// Geometric standard deviation, 1.02 to 4.
    pub geometric_sd: f64,
}

/// Number of droplets by altitude over thickness, ζ; each profile's mean is 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum VerticalSpec {
    /// The same at every altitude.
    Uniform,
    /// The numbers of the advection model's layer of the same height (Kolářová et al. 2024).
    Advection,
    /// (1 − ζ)^p with this p, 0.1 to 10: densest at the ground, nothing at the top.
    Thinning(f64),
    /// (ζ, number), ζ ascending within 0 to 1: linear between rows, 0 outside.
    Rows(Vec<[f64; 2]>),
    /// Rows from a CSV file with columns `relative_altitude,relative_number_density`: path as written.
    File(PathBuf),
}
