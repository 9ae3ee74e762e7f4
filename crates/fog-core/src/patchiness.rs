//! Fog that varies horizontally: a random factor on the density and a random displacement of the layer's top.
//!
//! Kolářová, Lachiver & Wilkie 2024 model the mean of a layer by altitude and leave its billows open (Sec. 4.1). Here they
//! are sums of plane waves w_i cos 2π(u_i x + v_i z + φ_i) with random phases, wave vectors spread evenly over an annulus of
//! wavenumbers, and variances that fall as wavenumber^(−2/3) per wave, which is Kolmogorov's −5/3 spectrum. Waves instead of
//! lattice noise because everything about them is known exactly:
//!
//! * the band is sharp: nothing outside [`PatchyField::band_1_m`], and no lattice or period on the infinite plane;
//! * the density factor is exp(Σ a_i cos φ_i) / Π I₀(a_i) with Bessel's I₀. It is positive, and its mean is exactly 1: over
//!   the seeds, for phases are uniform; over the plane too, for the phases of waves without a common period fill their torus
//!   evenly (Weyl). Its variance and covariances are products of I₀ as well, for the very realisation at hand;
//! * bounds over a rectangle are sums of the extremes of each cosine there: strict, and tight where the rectangle is small
//!   against the waves, which is what residual ratio tracking needs; over the whole plane they are exp(±Σ a_i) / Π I₀(a_i).
//!
//! The top's displacement is Σ b_i cos ψ_i by other waves of the same band: mean exactly 0, and independent of the density,
//! so that the mean optical depth of a column is that of the even layer ([`PatchyLayer`]).
//!
//! Functions of (seed, position) and nothing else, with the same bits on every machine. A value costs about 25 ns per octave
//! (baseline x86-64), the density some 20 ns more.

mod along;
mod fog;
mod layer;
mod waves;

pub use fog::{Crossed, PatchyFog};
pub use layer::PatchyLayer;

use crate::math::f64::{exp, ln};
use crate::random::{PathRng, mix64};
use waves::Waves;

/// Waves in each octave of the band.
pub const WAVES_PER_OCTAVE: usize = waves::LANES;

/// What is wrong with a patchiness or its use.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum PatchinessError {
    /// A number outside of its range.
    #[error("patchiness {what} is {value}; valid: {valid}")]
    Value {
        /// The field of [`Patchiness`].
        what: &'static str,
        /// What was given.
        value: f64,
        /// What is valid.
        valid: &'static str,
    },
    /// The base of the layer is not below its top.
    #[error("patchy layer from {base_m} m to {top_m} m: the base must be below the top, both finite")]
    Extent {
        /// Altitude of the base in m.
        base_m: f64,
        /// Altitude of the top in m.
        top_m: f64,
    },
    /// The top could come down to the base.
    #[error(
        "patchiness top_sd_m is {top_sd_m}: the top may sink by up to {sink_m:.3} m, which leaves less than a tenth of the \
         layer's {thickness_m} m"
    )]
    TopTooRough {
        /// Standard deviation of the top's altitude in m.
        top_sd_m: f64,
        /// Largest descent of the top in m.
        sink_m: f64,
        /// Mean thickness of the layer in m.
        thickness_m: f64,
    },
}

/// Parameters of a patchy fog.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patchiness {
    /// Standard deviation of the density factor, whose mean is 1; 0 to 2. 0 is even fog.
    pub density_sd: f64,
    /// Standard deviation of the top's altitude in m, 0 to 1000.
    pub top_sd_m: f64,
    /// Longest wavelength of the waves in m, the distance between the largest patches; 0.1 to 1e6.
    pub length_m: f64,
    /// Octaves of the band, 1 to 8: wavelengths reach from `length_m` down to `length_m` / 2^octaves.
    pub octaves: u32,
    /// Selects the realisation.
    pub seed: u64,
}

/// A realisation of a patchy fog over the horizontal plane (x, z).
#[derive(Clone, Debug, PartialEq)]
pub struct PatchyField {
    parameters: Patchiness,
    /// Waves of the logarithm of the density, with amplitudes a_i.
    density: Waves,
    /// ln Π I₀(a_i).
    ln_mean: f64,
    /// Waves of the top's displacement in m, with amplitudes b_i.
    top: Waves,
}

/// A rectangle of the horizontal plane: least and greatest x and z in m. The ends may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Least and greatest x.
    pub x_m: [f64; 2],
    /// Least and greatest z.
    pub z_m: [f64; 2],
}

impl Area {
    /// The whole plane.
    pub const EVERYWHERE: Self =
        Self { x_m: [f64::NEG_INFINITY, f64::INFINITY], z_m: [f64::NEG_INFINITY, f64::INFINITY] };
}

/// Slack of bounds, as a fraction of the sum of the amplitudes: above what rounding can do for positions up to 1e6 waves
/// from the origin.
const SLACK: f64 = 1e-8;

impl PatchyField {
    /// The realisation of the given parameters.
    ///
    /// # Errors
    /// If a parameter is outside of its range.
    pub fn new(parameters: Patchiness) -> Result<Self, PatchinessError> {
        let Patchiness { density_sd, top_sd_m, length_m, octaves, seed } = parameters;
        let check = |what, value: f64, low: f64, high: f64, valid| {
            if (low..=high).contains(&value) {
                Ok(())
            } else {
                Err(PatchinessError::Value { what, value, valid })
            }
        };
        check("density_sd", density_sd, 0.0, 2.0, "0 to 2 (of the mean density)")?;
        check("top_sd_m", top_sd_m, 0.0, 1e3, "0 to 1000 m")?;
        check("length_m", length_m, 0.1, 1e6, "0.1 to 1e6 m")?;
        check("octaves", f64::from(octaves), 1.0, 8.0, "1 to 8")?;

        let shape = |stream: u64| {
            let mut rng = PathRng::new(mix64(seed ^ 0x7061_7463_6869_6e65), stream, 0);
            Waves::new(1.0 / length_m, octaves as usize, &mut rng)
        };
        let density = scaled_to_variance(&shape(0), density_sd * density_sd);
        let ln_mean = density.amplitudes().map(ln_bessel_i0).sum();
        Ok(Self { parameters, density, ln_mean, top: shape(1).scaled(top_sd_m) })
    }

    /// What the field was made from.
    #[must_use]
    pub fn parameters(&self) -> &Patchiness {
        &self.parameters
    }

    /// Factor on the density of droplets, and so on σ_t, at a point of the plane (m): positive, mean 1.
    #[inline]
    #[must_use]
    pub fn density_factor(&self, x_m: f64, z_m: f64) -> f64 {
        exp(self.density.at(x_m, z_m) - self.ln_mean)
    }

    /// Height of the top over its mean in m at a point of the plane (m): mean 0.
    #[inline]
    #[must_use]
    pub fn top_offset_m(&self, x_m: f64, z_m: f64) -> f64 {
        self.top.at(x_m, z_m)
    }

    /// Least and greatest density factor that can occur in an area: strict, and exact in the limit of a small one.
    ///
    /// Holds for positions up to 1e6 times `length_m` / 2^`octaves` from the origin, where phases round to 1e-9 of a turn.
    #[must_use]
    pub fn density_bounds(&self, area: &Area) -> [f64; 2] {
        let [low, high] = self.density.bounds(area);
        let slack = SLACK * self.density.amplitudes().sum::<f64>();
        [exp(low - self.ln_mean - slack), exp(high - self.ln_mean + slack)]
    }

    /// Least and greatest offset of the top in m that can occur in an area, as [`PatchyField::density_bounds`].
    #[must_use]
    pub fn top_bounds_m(&self, area: &Area) -> [f64; 2] {
        let [low, high] = self.top.bounds(area);
        let slack = SLACK * self.top.amplitudes().sum::<f64>();
        [low - slack, high + slack]
    }

    /// Covariance of the density factors of two points (x, z) and (x + `dx_m`, z + `dz_m`), over the plane:
    /// Π I₀(2 a_i cos(δ_i/2)) / I₀(a_i)² − 1, δ_i being the difference of phase of wave i.
    ///
    /// At no distance it is the variance, `density_sd`². On average over directions and seeds it falls to 1/e at a fifth
    /// (one octave) to a tenth (four and more) of `length_m`.
    #[must_use]
    pub fn density_covariance(&self, dx_m: f64, dz_m: f64) -> f64 {
        exp(self.density.ln_product(dx_m, dz_m) - 2.0 * self.ln_mean) - 1.0
    }

    /// Covariance in m² of the top's offsets of two points that far apart, over the plane: Σ b_i²/2 cos δ_i. Its average
    /// over seeds is that of J₀(2π k r) over the band.
    #[must_use]
    pub fn top_covariance_m2(&self, dx_m: f64, dz_m: f64) -> f64 {
        self.top.covariance(dx_m, dz_m)
    }

    /// Least and greatest wavenumber in cycles per m of the top's offset and of the logarithm of the density.
    #[must_use]
    pub fn band_1_m(&self) -> [f64; 2] {
        let lowest = 1.0 / self.parameters.length_m;
        [lowest, lowest * f64::from(1u32 << self.parameters.octaves)]
    }

    /// The field applied to an even layer between two altitudes in m.
    ///
    /// # Errors
    /// If the base is not below the top, or the top's displacement can leave less than a tenth of the layer's thickness.
    pub fn layer(&self, base_m: f64, top_m: f64) -> Result<PatchyLayer<'_>, PatchinessError> {
        PatchyLayer::new(self, base_m, top_m)
    }
}

/// Waves of the logarithm of a factor with mean 1 and the given variance: Π I₀(2a_i) / I₀(a_i)² = 1 + variance.
fn scaled_to_variance(shape: &Waves, variance: f64) -> Waves {
    let target = ln(1.0 + variance);
    let excess = |scale: f64| -> f64 {
        shape.amplitudes().map(|a| ln_bessel_i0(2.0 * scale * a) - 2.0 * ln_bessel_i0(scale * a)).sum()
    };
    // The excess grows with the scale; near 0 it is the scale squared, and 4 is enough for any variance up to 4.
    let (mut low, mut high) = (0.0, 4.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if excess(middle) < target { low = middle } else { high = middle }
    }
    shape.scaled(if variance == 0.0 { 0.0 } else { 0.5 * (low + high) })
}

/// ln I₀(x), the modified Bessel function, by its series Σ (x²/4)^k / (k!)², for |x| up to some tens.
fn ln_bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum, mut k) = (1.0, 1.0, 1.0);
    while term > 1e-17 * sum {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
    }
    ln(sum)
}

#[cfg(test)]
mod tests;
