//! Light on the pixels to numbers in a file: electrons, noise, the well's end, the converter.
//!
//! Linear model of EMVA Standard 1288, release 4.0 Linear (2021): a pixel counts μ = light + dark electrons with Poisson's
//! variance, reading adds normal noise of variance σ_d², and the number is black level + K · electrons, rounded. Its
//! nonuniformities are a fixed pattern: each pixel has a gain and an offset of its own, the same in every picture of a sensor.

use crate::bayer::Bayer;
use crate::noise::{normal, poisson};
use fog_core::colour::Rgb;
use fog_core::random::{PathRng, mix64};

/// Keeps the sensor's random numbers apart from those of paths.
const STREAM: u64 = 0x73_65_6e_73_6f_72_21_21;
/// And the fixed pattern apart from both.
const PATTERN_STREAM: u64 = 0x70_61_74_74_65_72_6e_21;

/// A sensor and its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Its colour filters.
    pub bayer: Bayer,
    /// Bits of the converter, 1 to 16.
    pub adc_bits: u32,
    /// Number for no light, below the largest one.
    pub black_level: u16,
    /// Most electrons of a pixel, above 0.
    pub full_well_e: f64,
    /// Electrons that light 1 gives, which the converter's largest number stands for; above 0.
    pub saturation_e: f64,
    /// Mean dark electrons of an exposure, 0 or more.
    pub dark_e: f64,
    /// Standard deviation of the noise of reading, in electrons, 0 or more.
    pub read_noise_e: f64,
    /// Whether electrons are counted at random.
    pub photon_noise: bool,
    /// What tells its pixels apart.
    pub pattern: FixedPattern,
}

/// The nonuniformity of a sensor's pixels: white, normally distributed over the pixels, the same in all pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedPattern {
    /// Standard deviation of the pixels' responses to light over their mean, 0 or more: PRNU₁₂₈₈ as a share.
    pub prnu: f64,
    /// Standard deviation of the pixels' dark signals in electrons, 0 or more: DSNU₁₂₈₈.
    pub dsnu_e: f64,
    /// Which sensor it is.
    pub seed: u64,
}

impl FixedPattern {
    /// No pixel differs from another.
    pub const NONE: Self = Self { prnu: 0.0, dsnu_e: 0.0, seed: 0 };

    /// Factor on the light of a pixel, 0 or more, and electrons that reading adds to it.
    fn of(&self, pixel: u64) -> (f64, f64) {
        if self.prnu == 0.0 && self.dsnu_e == 0.0 {
            return (1.0, 0.0);
        }
        let mut rng = PathRng::new(mix64(self.seed ^ PATTERN_STREAM), pixel, 0);
        let gain = (1.0 + self.prnu * normal(&mut rng)).max(0.0);
        (gain, self.dsnu_e * normal(&mut rng))
    }
}

impl Sensor {
    /// Largest number of the converter.
    #[must_use]
    pub fn largest(&self) -> u16 {
        u16::MAX >> (16 - self.adc_bits.clamp(1, 16))
    }

    /// System gain K in numbers per electron.
    #[must_use]
    pub fn numbers_per_electron(&self) -> f64 {
        f64::from(self.largest() - self.black_level.min(self.largest())) / self.saturation_e
    }

    /// Number at which a pixel is full: the converter's largest, or that of a full well if it is less.
    #[must_use]
    pub fn white_level(&self) -> u16 {
        self.number(self.full_well_e)
    }

    /// The raw picture of light (row-major, its three channels; 1 saturates the converter; only the channel of a pixel's filter
    /// counts). A function of its arguments: every pixel has random numbers of its own.
    ///
    /// # Panics
    /// When there is not light for width × height pixels.
    #[must_use]
    pub fn expose(&self, light: &[Rgb], width: usize, height: usize, seed: u64) -> Vec<u16> {
        assert_eq!(light.len(), width * height, "light for every pixel");
        let seed = mix64(seed ^ STREAM);
        let pixel = |(i, rgb): (usize, &Rgb)| {
            let (gain, offset_e) = self.pattern.of(i as u64);
            let light = gain * f64::from(rgb[self.bayer.channel(i % width, i / width)]);
            let mut rng = PathRng::new(seed, i as u64, 0);
            let electrons = self.electrons(light, &mut rng);
            self.number(electrons + offset_e + self.read_noise_e * normal(&mut rng))
        };
        light.iter().enumerate().map(pixel).collect()
    }

    /// Electrons in a pixel's well.
    fn electrons(&self, light: f64, rng: &mut PathRng) -> f64 {
        let mean = light.max(0.0) * self.saturation_e + self.dark_e;
        // So much light fills the well for sure.
        let flooded = mean > 2.0 * self.full_well_e + 1000.0;
        let electrons = if self.photon_noise && !flooded { poisson(mean, rng) } else { mean };
        electrons.min(self.full_well_e)
    }

    fn number(&self, electrons: f64) -> u16 {
        let number = f64::from(self.black_level) + self.numbers_per_electron() * electrons;
        (number + 0.5).floor().clamp(0.0, f64::from(self.largest())) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SENSOR: Sensor = Sensor {
        bayer: Bayer::Rggb,
        adc_bits: 12,
        black_level: 64,
        full_well_e: 10_000.0,
        saturation_e: 10_000.0,
        dark_e: 5.0,
        read_noise_e: 4.0,
        photon_noise: true,
        pattern: FixedPattern::NONE,
    };

    fn flat(sensor: &Sensor, light: f32, seed: u64) -> (f64, f64) {
        let n = 200 * 200;
        let raw = sensor.expose(&vec![[light; 3]; n], 200, 200, seed);
        let mean = raw.iter().map(|&v| f64::from(v)).sum::<f64>() / n as f64;
        let variance = raw.iter().map(|&v| (f64::from(v) - mean).powi(2)).sum::<f64>() / (n as f64 - 1.0);
        (mean, variance)
    }

    #[test]
    fn photon_transfer_gives_gain_and_read_noise_back() {
        // EMVA 1288: the variance over the mean above dark has slope K and, in the dark, K² (σ_d² + dark) + 1/12.
        let k = SENSOR.numbers_per_electron();
        let (dark_mean, dark_variance) = flat(&SENSOR, 0.0, 1);
        let points: Vec<(f64, f64)> = (1..=8)
            .map(|i| {
                let (mean, variance) = flat(&SENSOR, 0.1 * i as f32, 1 + i);
                (mean - dark_mean, variance - dark_variance)
            })
            .collect();
        // Relative error of a variance is √(2/n): weights 1/x² make the slope a mean of ratios.
        let slope = points.iter().map(|(x, y)| y / x).sum::<f64>() / points.len() as f64;
        assert!((slope / k - 1.0).abs() < 4.5 * (2.0f64 / 40_000.0 / 8.0).sqrt(), "{slope} {k}");
        let read = (dark_variance - 1.0 / 12.0) / (k * k) - SENSOR.dark_e;
        assert!((read.sqrt() / 4.0 - 1.0).abs() < 0.04, "{}", read.sqrt());
        assert!((dark_mean - 64.0 - k * 5.0).abs() < 4.5 * (dark_variance / 40_000.0).sqrt(), "{dark_mean}");
    }

    /// EMVA 1288, release 4.0: spatial standard deviations of pictures averaged over time, dark and half full.
    #[test]
    fn nonuniformities_are_those_of_the_standard() {
        let pattern = FixedPattern { prnu: 0.02, dsnu_e: 6.0, seed: 11 };
        let (side, pictures) = (160, 64);
        let n = side * side;
        let mean = |sensor: &Sensor, light: f32| {
            let mut sums = vec![0.0; n];
            for seed in 0..pictures {
                let raw = sensor.expose(&vec![[light; 3]; n], side, side, 100 + seed);
                sums.iter_mut().zip(raw).for_each(|(sum, v)| *sum += f64::from(v) / pictures as f64);
            }
            sums
        };
        let moments = |v: &[f64]| {
            let mean = v.iter().sum::<f64>() / n as f64;
            (mean, v.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n as f64 - 1.0))
        };
        let sensor = Sensor { pattern, ..SENSOR };
        let (dark, half) = (mean(&sensor, 0.0), mean(&sensor, 0.5));
        let (plain_dark, plain_half) = (mean(&SENSOR, 0.0), mean(&SENSOR, 0.5));
        // What is left of the noise in time is as without the pattern.
        let (dark_variance, half_variance) =
            (moments(&dark).1 - moments(&plain_dark).1, moments(&half).1 - moments(&plain_half).1);
        let dsnu = dark_variance.sqrt() / sensor.numbers_per_electron();
        let prnu = (half_variance - dark_variance).sqrt() / (moments(&half).0 - moments(&dark).0);
        // A standard deviation over n pixels is known to 1/√(2n), 0.44 %.
        assert!((dsnu / 6.0 - 1.0).abs() < 0.025, "{dsnu}");
        assert!((prnu / 0.02 - 1.0).abs() < 0.025, "{prnu}");
        // Of the sensor and not of the picture.
        let still = Sensor { photon_noise: false, read_noise_e: 0.0, ..sensor };
        let light = vec![[0.4; 3]; 64];
        assert_eq!(still.expose(&light, 8, 8, 1), still.expose(&light, 8, 8, 2));
        let other = Sensor { pattern: FixedPattern { seed: 12, ..pattern }, ..still };
        assert_ne!(still.expose(&light, 8, 8, 1), other.expose(&light, 8, 8, 1));
    }

    #[test]
    fn wells_and_converters_end() {
        let quiet = Sensor { photon_noise: false, read_noise_e: 0.0, dark_e: 0.0, ..SENSOR };
        assert_eq!(
            quiet.expose(&[[0.0; 3], [0.5; 3], [1.0; 3], [1e30; 3], [-1.0; 3]], 5, 1, 0),
            [64, 2080, 4095, 4095, 64]
        );
        // A low ISO speed: the well is full before the converter.
        let low = Sensor { saturation_e: 20_000.0, ..quiet };
        assert_eq!(low.white_level(), 2080);
        assert_eq!(low.expose(&[[0.25; 3], [0.5; 3], [9.0; 3]], 3, 1, 0), [1072, 2080, 2080]);
        // A full well does not spare the noise of reading.
        let (mean, variance) = flat(&Sensor { saturation_e: 20_000.0, ..SENSOR }, 5.0, 3);
        assert!((mean - 2080.0).abs() < 1.0 && variance > 0.5, "{mean} {variance}");
        assert_eq!(Sensor { adc_bits: 16, ..SENSOR }.largest(), 65_535);
        assert_eq!(Sensor { adc_bits: 8, ..SENSOR }.largest(), 255);
    }

    #[test]
    fn a_pixel_takes_the_channel_of_its_filter() {
        let quiet = Sensor { photon_noise: false, read_noise_e: 0.0, dark_e: 0.0, black_level: 0, ..SENSOR };
        for bayer in Bayer::ALL {
            let raw = Sensor { bayer, ..quiet }.expose(&[[0.2, 0.4, 0.8]; 4], 2, 2, 0);
            let want = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| [819, 1638, 3276][bayer.channel(x, y)]);
            assert_eq!(raw, want);
        }
    }

    #[test]
    fn noise_is_a_function_of_seed_and_pixel() {
        let light = vec![[0.3; 3]; 64];
        let a = SENSOR.expose(&light, 8, 8, 7);
        assert_eq!(a, SENSOR.expose(&light, 8, 8, 7));
        assert_ne!(a, SENSOR.expose(&light, 8, 8, 8));
        // The first rows alone have the same noise.
        assert_eq!(a[..32], SENSOR.expose(&light[..32], 8, 4, 7));
        // Bits are pinned: a change here changes every raw picture.
        assert_eq!(a[..4], PINNED);
    }

    const PINNED: [u16; 4] = [1301, 1293, 1297, 1264];
}
