//! How much less light the lens brings to the corners than to the middle.

/// A law of vignetting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Vignetting {
    /// None.
    Even,
    /// The fourth power of the cosine of the angle from the axis: a thin lens before a flat sensor.
    Cos4,
    /// 1 + a r² + b r⁴ + c r⁶, r the distance from the picture's middle in half diagonals.
    Polynomial([f64; 3]),
}

impl Vignetting {
    /// Share of the light on the axis that a pixel gets, never below 0: its ray has this cosine with the axis, and is at `x`, `y` in
    /// pixels from the upper left corner of a picture of `width` × `height`.
    #[must_use]
    pub fn share(self, cosine: f64, (x, y): (f64, f64), (width, height): (f64, f64)) -> f64 {
        match self {
            Self::Even => 1.0,
            Self::Cos4 => cosine.max(0.0).powi(4),
            Self::Polynomial([a, b, c]) => {
                let (dx, dy) = (2.0 * x - width, 2.0 * y - height);
                let r2 = (dx * dx + dy * dy) / (width * width + height * height);
                (1.0 + r2 * (a + r2 * (b + r2 * c))).max(0.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_are_closed_forms() {
        let size = (640.0, 480.0);
        assert_eq!(Vignetting::Even.share(0.1, (0.0, 0.0), size), 1.0);
        assert_eq!(Vignetting::Cos4.share(0.5, (0.0, 0.0), size), 0.0625);
        assert_eq!(Vignetting::Cos4.share(-0.5, (0.0, 0.0), size), 0.0);
        let law = Vignetting::Polynomial([-0.5, 0.25, -0.125]);
        assert_eq!(law.share(1.0, (320.0, 240.0), size), 1.0);
        assert_eq!(law.share(1.0, (0.0, 480.0), size), 0.625);
        // Half of the diagonal's half.
        let half = law.share(1.0, (480.0, 360.0), size);
        assert!((half - (1.0 - 0.125 + 0.25 / 16.0 - 0.125 / 64.0)).abs() < 1e-15);
        assert_eq!(Vignetting::Polynomial([-2.0, 0.0, 0.0]).share(1.0, (0.0, 0.0), size), 0.0);
    }
}
