//! What a rendering is asked for.

/// Sampling and limits of one rendering; see `fog_plan` for defaults and valid ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Paths per pixel; with `stop` the first ones, at least 2.
    pub samples: u64,
    /// Gives some pixels more samples than others.
    pub stop: Option<Stop>,
    /// Longest path in edges (1 = only light that comes straight from its source), or no limit.
    pub max_depth: Option<u32>,
    /// Renders this wavelength alone (nm) instead of colour.
    pub wavelength_nm: Option<f32>,
}

/// When enough of a pixel has been sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// When its noise is low.
    Noise(NoiseTarget),
    /// When the frame's paths, [`Settings::samples`] times its pixels, are shared out so that the mean relative squared error
    /// is least. A pixel gets [`MOST_OF_BUDGET`] times `samples` at most.
    Budget,
}

/// Share of an even one that a pixel gets at most with [`Stop::Budget`].
pub const MOST_OF_BUDGET: u64 = 16;

/// Noise that is low enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseTarget {
    /// Relative standard error of the luminance to be reached (above [`fog_film::noise_floor`]), above 0.
    pub noise: f64,
    /// Paths per pixel after which sampling ends all the same.
    pub max_samples: u64,
}
