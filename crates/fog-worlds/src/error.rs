//! What can be wrong with the options of a world.

/// A world cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// An option is out of its range.
    #[error("{option} is {value}; valid: {valid}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// What it was.
        value: String,
        /// What it may be.
        valid: &'static str,
    },
    /// A texture could not be encoded.
    #[error("cannot encode a texture: {0}")]
    Texture(#[from] image::ImageError),
}

/// `value` if it lies between `low` and `high`.
pub(crate) fn within(
    option: &'static str,
    value: f32,
    (low, high): (f32, f32),
    valid: &'static str,
) -> Result<f32, WorldError> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(WorldError::Option { option, value: value.to_string(), valid })
}
