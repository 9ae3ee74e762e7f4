//! What a rendering is asked for.

/// Sampling and limits of one rendering; see `fog_plan` for defaults and valid ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Paths per pixel.
    pub samples: u64,
    /// Longest path in edges (1 = only light that comes straight from its source), or no limit.
    pub max_depth: Option<u32>,
    /// Renders this wavelength alone (nm) instead of colour.
    pub wavelength_nm: Option<f32>,
}
