//! Daylight by its colour temperature: the CIE D illuminants.
//!
//! Source: CIE 15, "Colorimetry", sec. 3.1 and table T.2 (`tables/sky`).

use crate::bands::{BANDS, BandSpectrum};
use crate::colour::{Observer, luminance};

/// Lowest correlated colour temperature of daylight in K.
pub const LOWEST_K: f64 = 4000.0;
/// Highest correlated colour temperature of daylight in K.
pub const HIGHEST_K: f64 = 25_000.0;

const COMPONENTS: &str = include_str!("../../../tables/sky/daylight_10nm.csv");
/// Wavelengths of the table.
const ROWS: usize = 41;

/// Daylight of a correlated colour temperature in K (clamped to [`LOWEST_K`] and [`HIGHEST_K`]) relative to D65, scaled to
/// luminance 1.
#[must_use]
pub fn daylight(observer: &Observer, colour_temperature_k: f64) -> BandSpectrum {
    let rows = power(colour_temperature_k.clamp(LOWEST_K, HIGHEST_K));
    // Mean over 20 nm around each band's centre; bands lie on every other row.
    let physical: [f64; BANDS] = core::array::from_fn(|band| {
        let row = 2 * band;
        let sides = [row.checked_sub(1), Some(row + 1).filter(|&r| r < ROWS)];
        let (sum, weight) =
            sides.iter().flatten().fold((rows[row], 1.0), |(s, w), &r| (s + 0.5 * rows[r], w + 0.5));
        sum / weight
    });
    let relative = observer.relative_to_d65(&physical);
    let y = luminance(observer.rgb_of(|nm| relative.at(nm)));
    relative.scaled((1.0 / y) as f32)
}

/// Relative spectral power at 380, 390, … 780 nm.
fn power(t: f64) -> [f64; ROWS] {
    let x = if t <= 7000.0 {
        0.244_063 + (0.099_11e3 + (2.9678e6 - 4.6070e9 / t) / t) / t
    } else {
        0.237_040 + (0.247_48e3 + (1.9018e6 - 2.0064e9 / t) / t) / t
    };
    let y = -3.0 * x * x + 2.87 * x - 0.275;
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    // Rounded to three decimals, as the CIE has them.
    let rounded = |m: f64| (m * 1000.0).round() / 1000.0;
    let m1 = rounded((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
    let m2 = rounded((0.0300 - 31.4424 * x + 30.0717 * y) / m);
    let mut out = [0.0; ROWS];
    for (out, line) in out.iter_mut().zip(COMPONENTS.lines().skip(1)) {
        let mut cells = line.split(',').skip(1).map(|c| c.parse::<f64>().expect("embedded table is numeric"));
        let mut next = || cells.next().expect("three components");
        *out = next() + m1 * next() + m2 * next();
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_its_temperature_it_is_d65() {
        // 6500 K by the constant c2 of 1931.
        let o = Observer::new();
        let rows = power(6500.0 * 1.4388 / 1.4380);
        for (i, power) in rows.iter().enumerate() {
            let d65 = 100.0 * f64::from(o.d65(380.0 + 10.0 * i as f32));
            assert!((power - d65).abs() < 1e-3, "row {i}: {power} for {d65}");
        }
        for value in daylight(&o, 6504.0).0 {
            assert!((value - 1.0).abs() < 2e-3, "{value}");
        }
    }

    #[test]
    fn luminance_is_kept_and_warm_is_red() {
        let o = Observer::new();
        let of = |t: f64| {
            let s = daylight(&o, t);
            o.rgb_of(|nm| s.at(nm))
        };
        for t in [1000.0, 4000.0, 5000.0, 7000.0, 7001.0, 12_000.0, 25_000.0, 1e9] {
            let rgb = of(t);
            assert!((luminance(rgb) - 1.0).abs() < 1e-6 && rgb.iter().all(|&c| c > 0.0), "{t} K: {rgb:?}");
        }
        // D50 is x, y = 0.3457, 0.3585: in linear sRGB 1.176, 0.976, 0.722.
        let [r, g, b] = of(5003.0);
        assert!(
            (r - 1.176).abs() < 0.01 && (g - 0.976).abs() < 0.01 && (b - 0.722).abs() < 0.01,
            "{r} {g} {b}"
        );
        assert!(of(4000.0)[0] > of(7000.0)[0] && of(7000.0)[0] > of(25_000.0)[0]);
    }
}
