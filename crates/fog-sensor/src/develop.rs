//! From a raw picture to linear sRGB: levels, mosaic, white balance, colour matrix.

use crate::demosaic::demosaic;
use crate::raw::Sensor;
use fog_core::colour::Rgb;

/// What turns a camera's channels into linear sRGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    /// Factors on red, green and blue that make D65 white equal in all three.
    pub white_balance: [f64; 3],
    /// Linear sRGB from the balanced channels, row by row.
    pub matrix: [[f64; 3]; 3],
}

impl Colour {
    /// Channels that are linear sRGB already.
    pub const SRGB: Self =
        Self { white_balance: [1.0; 3], matrix: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
}

/// Linear sRGB of a raw picture (row-major, as [`Sensor::expose`] gives it); light that saturates the converter is 1.
///
/// What is below the black level stays negative, so that noise has no bias. Balanced channels are cut where the first of them
/// is full, so that what is too bright is white.
///
/// # Panics
/// When there are not width × height values.
#[must_use]
pub fn develop(raw: &[u16], width: usize, height: usize, sensor: &Sensor, colour: &Colour) -> Vec<Rgb> {
    let black = f64::from(sensor.black_level);
    let range = f64::from(sensor.largest()) - black;
    let light: Vec<f32> = raw.iter().map(|&v| ((f64::from(v) - black) / range) as f32).collect();
    let least = colour.white_balance.iter().copied().fold(f64::INFINITY, f64::min);
    let full = (f64::from(sensor.white_level()) - black) / range * least;
    let balanced = |rgb: Rgb| {
        let [r, g, b] = [0, 1, 2].map(|c: usize| (f64::from(rgb[c]) * colour.white_balance[c]).min(full));
        colour.matrix.map(|row| (row[0] * r + row[1] * g + row[2] * b) as f32)
    };
    demosaic(&light, width, height, sensor.bayer).into_iter().map(balanced).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bayer::Bayer;
    use crate::raw::FixedPattern;

    const QUIET: Sensor = Sensor {
        bayer: Bayer::Gbrg,
        adc_bits: 16,
        black_level: 256,
        full_well_e: 10_000.0,
        saturation_e: 10_000.0,
        dark_e: 0.0,
        read_noise_e: 0.0,
        photon_noise: false,
        pattern: FixedPattern::NONE,
    };

    #[test]
    fn an_even_colour_is_developed_exactly() {
        let colour = Colour {
            white_balance: [2.0, 1.0, 1.5],
            matrix: [[1.5, -0.5, 0.0], [-0.25, 1.5, -0.25], [0.0, -0.5, 1.5]],
        };
        let light = [0.1, 0.4, 0.2];
        let out = develop(&QUIET.expose(&[light; 30], 6, 5, 0), 6, 5, &QUIET, &colour);
        let (r, g, b) = (0.2, 0.4, 0.3);
        let want = [1.5 * r - 0.5 * g, -0.25 * r + 1.5 * g - 0.25 * b, -0.5 * g + 1.5 * b];
        for rgb in out {
            assert!((0..3).all(|c| (f64::from(rgb[c]) - want[c]).abs() < 3e-5), "{rgb:?} {want:?}");
        }
    }

    #[test]
    fn what_is_too_bright_is_white() {
        let colour = Colour { white_balance: [2.0, 1.0, 1.5], matrix: Colour::SRGB.matrix };
        let bright = develop(&QUIET.expose(&[[30.0, 70.0, 40.0]; 16], 4, 4, 0), 4, 4, &QUIET, &colour);
        assert!(bright.iter().flatten().all(|v| (v - 1.0).abs() < 1e-6));
    }

    #[test]
    fn noise_around_black_has_no_bias() {
        let noisy = Sensor { read_noise_e: 20.0, ..QUIET };
        let out = develop(&noisy.expose(&[[0.0; 3]; 10_000], 100, 100, 3), 100, 100, &noisy, &Colour::SRGB);
        let mean = out.iter().map(|v| f64::from(v[1])).sum::<f64>() / 10_000.0;
        assert!(mean.abs() < 5.0 * 20.0 / 10_000.0 / 70.0, "{mean}");
    }
}
