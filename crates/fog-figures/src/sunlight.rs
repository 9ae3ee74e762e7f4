//! Sunlight scattered once by droplets of about one size, as the eye sees it.

use crate::FiguresError;
use fog_core::colour::{Observer, luminance, srgb_encode};
use fog_core::math::{
    PI,
    f64::{acos, cos, pow, sin},
};
use fog_core::phase_grid;
use fog_optics::distribution::DiameterGrid;
use fog_optics::polydisperse::{DropletSpectra, average};
use fog_optics::size::SizeDistribution;

/// Angular radius of the sun in degrees: 0.2666 at mean distance (radius 695 700 km, 149.6 million km).
const SUN_RADIUS_DEG: f64 = 0.2666;
/// Effective variance of the spectra: a standard deviation of a tenth of the size.
pub(crate) const EFFECTIVE_VARIANCE: f64 = 0.01;
/// Most diameters of a spectrum. Large drops would need more for a smooth curve at one wavelength; over the sun's disc and
/// the eye's wavelengths this is enough.
const MOST_DIAMETERS: usize = 320;
/// Product of diameters (µm) and their number that a spectrum may have: the cost of its series grows with it.
const MOST_WORK_UM: f64 = 80_000.0;

/// Linear sRGB of light scattered by a droplet, per unit of scattering and steradian, at ascending angles in degrees.
#[derive(Debug)]
pub(crate) struct Scattered {
    pub(crate) rgb: Vec<[f64; 3]>,
}

impl Scattered {
    /// Sunlight (taken as D65, so that white is R = G = B) scattered once by a narrow gamma spectrum of droplets of effective
    /// diameter `diameter_um`, as a mean over the sun's disc, at `angles_deg`.
    pub(crate) fn new(
        diameter_um: f64,
        angles_deg: &[f64],
        observer: &Observer,
    ) -> Result<Self, FiguresError> {
        let spectrum = SizeDistribution::gamma(0.5 * diameter_um, EFFECTIVE_VARIANCE)?;
        let [first, last] = spectrum.grid().range_um();
        let count = MOST_DIAMETERS.min((MOST_WORK_UM / diameter_um) as usize);
        let grid = DiameterGrid::covering(first, last, (last - first) / (count - 1) as f64)?;
        let spectra = DropletSpectra::new(&[0.0], &grid, |_, d| spectrum.density_1_um(d))?;
        let wavelengths: Vec<f64> = (0..16).map(|i| 380.0 + 400.0 * f64::from(i) / 15.0).collect();
        let parts = average(&spectra, &wavelengths, &|_| ())?;

        // Weighted with C_sca, relative to its mean: large drops scatter all colours alike, small ones do not.
        let mean: f64 = parts.c_sca_m2.iter().sum::<f64>() / parts.c_sca_m2.len() as f64;
        let nodes_deg: Vec<f64> =
            phase_grid::cosines().iter().map(|c| acos(c.clamp(-1.0, 1.0)) * 180.0 / PI).collect();
        let disc = disc();
        let smoothed: Vec<Vec<f64>> = (parts.phase.chunks_exact(phase_grid::NODES).zip(&parts.c_sca_m2))
            .map(|(phase, c_sca)| {
                let scale = c_sca / (mean * disc.len() as f64);
                (angles_deg.iter())
                    .map(|&a| disc.iter().map(|&o| at(&nodes_deg, phase, seen_at(a, o))).sum::<f64>() * scale)
                    .collect()
            })
            .collect();
        let rgb = (0..angles_deg.len())
            .map(|i| {
                observer.rgb_of(|nm| {
                    let x = (f64::from(nm) - 380.0) * 15.0 / 400.0;
                    let l = (x as usize).min(14);
                    let (low, high) = (smoothed[l][i], smoothed[l + 1][i]);
                    (low + (high - low) * (x - l as f64)) as f32
                })
            })
            .collect();
        Ok(Self { rgb })
    }

    /// Luminance at each angle.
    pub(crate) fn luminance(&self) -> Vec<f64> {
        self.rgb.iter().map(|&rgb| luminance(rgb)).collect()
    }
}

/// Points of the sun's disc in degrees from its centre, of equal area each.
fn disc() -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for ring in 0..4 {
        let r = SUN_RADIUS_DEG * ((f64::from(ring) + 0.5) / 4.0).sqrt();
        for k in 0..9 {
            let angle = 2.0 * PI * (f64::from(k) + 0.25 * f64::from(ring)) / 9.0;
            points.push([r * cos(angle), r * sin(angle)]);
        }
    }
    points
}

/// Scattering angle of light from a point of the disc where that of the disc's centre is `angle_deg`; plane geometry around
/// the nearer of 0° and 180°, exact where the disc's extent across matters.
fn seen_at(angle_deg: f64, [along, across]: [f64; 2]) -> f64 {
    let from_axis = |a: f64| ((a + along) * (a + along) + across * across).sqrt();
    if angle_deg <= 90.0 { from_axis(angle_deg) } else { 180.0 - from_axis(180.0 - angle_deg) }
}

/// Linear interpolation at an angle between ascending ones.
fn at(angles: &[f64], values: &[f64], angle: f64) -> f64 {
    let i = angles.partition_point(|&a| a <= angle).clamp(1, angles.len() - 1);
    let t = ((angle - angles[i - 1]) / (angles[i] - angles[i - 1])).clamp(0.0, 1.0);
    values[i - 1] + (values[i] - values[i - 1]) * t
}

/// Colours of a strip for linear sRGB values: the brightest is given luminance 1 and the others that of their share to the
/// power of `contrast` (1: as it is; less: as a photograph with its brightness compressed), each with its own chromaticity,
/// mixed with grey as far as it lies outside of sRGB.
pub(crate) fn strip(rgb: &[[f64; 3]], contrast: f64) -> Vec<String> {
    let brightest = rgb.iter().map(|&c| luminance(c)).fold(f64::MIN_POSITIVE, f64::max);
    (rgb.iter())
        .map(|&c| {
            let y = luminance(c).max(f64::MIN_POSITIVE);
            let shown = 0.85 * pow(y / brightest, contrast);
            let lit = c.map(|x| x / y * shown);
            // The share of grey that brings every channel into [0, 1].
            let share = lit.iter().fold(1.0f64, |share, &x| {
                let limit = if x > shown { (1.0 - shown) / (x - shown) } else { shown / (shown - x) };
                if x == shown { share } else { share.min(limit) }
            });
            let [r, g, b] = lit.map(|x| {
                let x = shown + (x - shown) * share;
                (255.0 * srgb_encode(x as f32)).round() as u8
            });
            format!("#{r:02x}{g:02x}{b:02x}")
        })
        .collect()
}
