//! Sunlight scattered once by droplets of about one size, as the eye sees it.

use crate::FiguresError;
use fog_core::colour::{Observer, luminance, srgb_encode};
use fog_core::math::{
    PI,
    f64::{acos, pow},
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
const MOST_WORK_UM: f64 = 160_000.0;

/// Linear sRGB of light scattered by a droplet, per unit of scattering and steradian, at ascending angles in degrees.
#[derive(Debug)]
pub(crate) struct Scattered {
    pub(crate) rgb: Vec<[f64; 3]>,
}

impl Scattered {
    /// Sunlight (taken as D65, so that white is R = G = B) scattered once by a narrow gamma spectrum of droplets of effective
    /// diameter `diameter_um`, at the angles of `view`.
    pub(crate) fn new(diameter_um: f64, view: &SunView, observer: &Observer) -> Result<Self, FiguresError> {
        let spectrum = SizeDistribution::gamma(0.5 * diameter_um, EFFECTIVE_VARIANCE)?;
        let [first, last] = spectrum.grid().range_um();
        let count = MOST_DIAMETERS.min((MOST_WORK_UM / diameter_um) as usize);
        let grid = DiameterGrid::covering(first, last, (last - first) / (count - 1) as f64)?;
        let spectra = DropletSpectra::new(&[0.0], &grid, |_, d| spectrum.density_1_um(d))?;
        let wavelengths: Vec<f64> = (0..16).map(|i| 380.0 + 400.0 * f64::from(i) / 15.0).collect();
        let parts = average(&spectra, &wavelengths, &|_| ())?;

        // Weighted with C_sca, relative to its mean: large drops scatter all colours alike, small ones do not.
        let mean: f64 = parts.c_sca_m2.iter().sum::<f64>() / parts.c_sca_m2.len() as f64;
        let smoothed: Vec<Vec<f64>> = (parts.phase.chunks_exact(phase_grid::NODES).zip(&parts.c_sca_m2))
            .map(|(phase, c_sca)| view.means(phase).map(|p| p * c_sca / mean).collect())
            .collect();
        let rgb = (0..view.angles.len())
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

/// Means of phase functions over the sun's disc at given scattering angles of its centre.
#[derive(Debug)]
pub(crate) struct SunView {
    /// For each angle, interval of the phase grid and weights of its ends.
    angles: Vec<Vec<(usize, [f64; 2])>>,
}

impl SunView {
    /// At scattering angles in degrees, 0 to 180.
    ///
    /// The share of the disc at a distance from the axis of 0° or of 180°, whichever is nearer, is that of a plane; it is
    /// exact enough near the axes, and away from them the disc's extent across hardly changes the scattering angle.
    pub(crate) fn new(angles_deg: &[f64]) -> Self {
        const PARTS: usize = 48;
        let nodes: Vec<f64> =
            phase_grid::cosines().iter().map(|c| acos(c.clamp(-1.0, 1.0)) * 180.0 / PI).collect();
        let weights_at = |&angle: &f64| {
            let centre = angle.min(180.0 - angle);
            // Equal steps of the root of the distance, because phase functions are steep near the axes.
            let (low, high) = ((centre - SUN_RADIUS_DEG).max(0.0).sqrt(), (centre + SUN_RADIUS_DEG).sqrt());
            let parts: Vec<[f64; 2]> = (0..PARTS)
                .map(|i| {
                    let root = low + (high - low) * (i as f64 + 0.5) / PARTS as f64;
                    let distance = root * root;
                    let chord = distance * distance + centre * centre - SUN_RADIUS_DEG * SUN_RADIUS_DEG;
                    let arc =
                        acos((chord / (2.0 * distance * centre).max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0));
                    [distance, distance * arc * root]
                })
                .collect();
            let sum: f64 = parts.iter().map(|p| p[1]).sum();
            (parts.iter())
                .map(|&[distance, weight]| {
                    let seen = if angle <= 90.0 { distance } else { 180.0 - distance };
                    let i = nodes.partition_point(|&a| a <= seen).clamp(1, nodes.len() - 1) - 1;
                    let t = ((seen - nodes[i]) / (nodes[i + 1] - nodes[i])).clamp(0.0, 1.0);
                    (i, [weight / sum * (1.0 - t), weight / sum * t])
                })
                .collect()
        };
        Self { angles: angles_deg.iter().map(weights_at).collect() }
    }

    /// Means of a phase function that is given at the nodes of the phase grid.
    fn means(&self, phase: &[f64]) -> impl Iterator<Item = f64> {
        (self.angles.iter())
            .map(|weights| weights.iter().map(|&(i, [a, b])| a * phase[i] + b * phase[i + 1]).sum())
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_over_the_disc_keep_what_does_not_vary_and_spread_what_does() {
        let view = SunView::new(&[0.0, 0.1, 0.2666, 90.0, 138.0, 180.0]);
        assert!(view.means(&[3.0; phase_grid::NODES]).all(|p| (p - 3.0).abs() < 1e-12));
        // A function that is the angle from forward: over the disc at the pole its mean is 2/3 of the radius.
        let angle: Vec<f64> =
            phase_grid::cosines().iter().map(|c| acos(c.clamp(-1.0, 1.0)) * 180.0 / PI).collect();
        let means: Vec<f64> = view.means(&angle).collect();
        assert!((means[0] / (2.0 / 3.0 * SUN_RADIUS_DEG) - 1.0).abs() < 2e-3, "{means:?}");
        assert!((means[3] - 90.0).abs() < 1e-3 && (means[4] - 138.0).abs() < 1e-3, "{means:?}");
        assert!((180.0 - means[5] - means[0]).abs() < 1e-4, "{means:?}");
    }

    #[test]
    fn strips_keep_hue_and_order() {
        let strip = strip(&[[1.0, 1.0, 1.0], [0.5, 0.5, 0.5], [0.9, 0.1, 0.0], [0.0, 0.0, 0.0]], 1.0);
        let channels = |c: &str| [1, 3, 5].map(|i| u8::from_str_radix(&c[i..i + 2], 16).unwrap());
        let [white, grey, red, black] = [0, 1, 2, 3].map(|i| channels(&strip[i]));
        assert!(
            white[0] == white[2] && white[0] > 230 && grey[0] < white[0] && grey[0] == grey[1],
            "{strip:?}"
        );
        assert!(red[0] > red[1] && red[1] > red[2], "{strip:?}");
        assert_eq!(black, [0, 0, 0]);
    }
}
