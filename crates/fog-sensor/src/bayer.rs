//! Colour filters over the pixels.

/// Which filter the four pixels of a cell have: named by the two of its upper row, then the two of its lower one, from the
/// upper left corner of the picture on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bayer {
    /// Red, green / green, blue.
    Rggb,
    /// Blue, green / green, red.
    Bggr,
    /// Green, red / blue, green.
    Grbg,
    /// Green, blue / red, green.
    Gbrg,
}

impl Bayer {
    /// All patterns.
    pub const ALL: [Self; 4] = [Self::Rggb, Self::Bggr, Self::Grbg, Self::Gbrg];

    /// Channel of a pixel: 0 red, 1 green, 2 blue.
    #[inline]
    #[must_use]
    pub fn channel(self, x: usize, y: usize) -> usize {
        let cell: [[usize; 2]; 2] = match self {
            Self::Rggb => [[0, 1], [1, 2]],
            Self::Bggr => [[2, 1], [1, 0]],
            Self::Grbg => [[1, 0], [2, 1]],
            Self::Gbrg => [[1, 2], [0, 1]],
        };
        cell[y & 1][x & 1]
    }

    /// The name in capitals.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rggb => "RGGB",
            Self::Bggr => "BGGR",
            Self::Grbg => "GRBG",
            Self::Gbrg => "GBRG",
        }
    }

    /// Code that `cv2.cvtColor` wants for this pattern. OpenCV names patterns by the second and third pixel of the second row,
    /// so that its `BG` is what others call RGGB.
    #[must_use]
    pub fn opencv_code(self) -> &'static str {
        match self {
            Self::Rggb => "COLOR_BayerBG2BGR",
            Self::Bggr => "COLOR_BayerRG2BGR",
            Self::Grbg => "COLOR_BayerGB2BGR",
            Self::Gbrg => "COLOR_BayerGR2BGR",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_the_cell_row_by_row() {
        for bayer in Bayer::ALL {
            let cell: String = [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(x, y)| ['R', 'G', 'B'][bayer.channel(x, y)])
                .iter()
                .collect();
            assert_eq!(cell, bayer.name());
            assert_eq!(bayer.channel(5, 8), bayer.channel(1, 0));
            // OpenCV's two letters: columns 1 and 2 of row 1.
            let letters: String = [1, 2].map(|x| ['R', 'G', 'B'][bayer.channel(x, 1)]).iter().collect();
            assert_eq!(bayer.opencv_code(), format!("COLOR_Bayer{letters}2BGR"));
        }
    }
}
