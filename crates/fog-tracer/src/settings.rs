//! What a rendering is asked for.

/// Sampling and limits of one rendering; see `fog_plan` for defaults and valid ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Paths per pixel; with `stop` the first ones, at least 2.
    pub samples: u64,
    /// Samples each pixel on until its noise is low.
    pub stop: Option<Stop>,
    /// Longest path in edges (1 = only light that comes straight from its source), or no limit.
    pub max_depth: Option<u32>,
    /// Renders this wavelength alone (nm) instead of colour.
    pub wavelength_nm: Option<f32>,
}

/// When enough of a pixel has been sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Relative standard error of the luminance to be reached (above [`fog_film::noise_floor`]), above 0.
    pub noise: f64,
    /// Paths per pixel after which sampling ends all the same.
    pub max_samples: u64,
}
