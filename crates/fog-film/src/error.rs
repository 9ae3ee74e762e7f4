//! What can be wrong with a frame.

/// A frame that must not be stored.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// A channel has another number of values than the picture has pixels, or the picture has none.
    #[error("channel `{channel}` has {found} values, but {width} x {height} pixels need {expected}")]
    Shape {
        /// Name of the channel, as the field of [`crate::Frame`] or [`crate::Truth`].
        channel: &'static str,
        /// Columns of the frame.
        width: u32,
        /// Rows of the frame.
        height: u32,
        /// width × height.
        expected: usize,
        /// Length of the channel.
        found: usize,
    },
    /// A frame of no pixels.
    #[error("a frame of {width} x {height} pixels is empty")]
    Empty {
        /// Columns of the frame.
        width: u32,
        /// Rows of the frame.
        height: u32,
    },
    /// A radiance is infinite or not a number: the renderer failed there.
    #[error("the radiance of pixel ({x}, {y}) is not finite")]
    NotFinite {
        /// Column, from the left.
        x: u32,
        /// Row, from the top.
        y: u32,
    },
    /// A pixel without a single sample.
    #[error("pixel ({x}, {y}) was not sampled")]
    Unsampled {
        /// Column, from the left.
        x: u32,
        /// Row, from the top.
        y: u32,
    },
}
