//! Many spheres of one material at many angles, on one thread.

use super::angles::{self, GROUP, LANES, group_terms, orders};
use super::{Complex64, Efficiencies, MieSeries};
use crate::error::OpticsError;

/// Efficiencies and intensities of spheres of one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// By sphere, in the order asked for.
    pub efficiencies: Vec<Efficiencies>,
    /// Unpolarised intensities (|S1|² + |S2|²) / 2, dimensionless: \[sphere\]\[angle\], spheres × angles. Divided by
    /// π x² Q_sca they are the phase function in 1/sr.
    pub intensities: Vec<f64>,
}

/// Efficiencies of spheres of relative refractive index `m` and size parameters `sizes`, and their intensities at the
/// `cosines` of scattering angles (beyond [−1, 1] they are clamped to it).
///
/// The angular functions are computed once for all spheres, and four spheres of neighbouring sizes are summed side by side:
/// much faster than one [`MieSeries::amplitudes`] after the other. Memory: the result, and 32 bytes per order and sphere
/// (the number of orders is little more than the size parameter).
///
/// # Errors
/// As [`MieSeries::new`], for any of the spheres.
pub fn batch(m: Complex64, sizes: &[f64], cosines: &[f64]) -> Result<Batch, OpticsError> {
    // Neighbours in size have series of like length.
    let mut by_size: Vec<usize> = (0..sizes.len()).collect();
    by_size.sort_by(|&i, &j| sizes[i].total_cmp(&sizes[j]));

    let empty = Efficiencies { q_ext: 0.0, q_sca: 0.0, q_abs: 0.0, q_back: 0.0, g: 0.0 };
    let mut efficiencies = vec![empty; sizes.len()];
    let mut groups = Vec::with_capacity(sizes.len().div_ceil(GROUP));
    for members in by_size.chunks(GROUP) {
        let mut series = Vec::with_capacity(GROUP);
        for &i in members {
            let sphere = MieSeries::new(m, sizes[i])?;
            efficiencies[i] = sphere.efficiencies();
            series.push(sphere);
        }
        groups.push(group_terms(&series));
    }

    let orders = orders(groups.last().map_or(0, Vec::len));
    let mut functions = Vec::with_capacity(orders.len());
    let mut intensities = vec![0.0; sizes.len() * cosines.len()];
    for (block, chunk) in cosines.chunks(LANES).enumerate() {
        let mut mu = [1.0; LANES];
        for (slot, cosine) in mu.iter_mut().zip(chunk) {
            *slot = cosine.clamp(-1.0, 1.0);
        }
        angles::intensities(&mu, &groups, &orders, &mut functions, |g, group| {
            for (&sphere, values) in by_size[g * GROUP..].iter().zip(group) {
                let start = sphere * cosines.len() + block * LANES;
                for (slot, value) in intensities[start..start + chunk.len()].iter_mut().zip(values) {
                    *slot = 0.5 * value;
                }
            }
        });
    }
    Ok(Batch { efficiencies, intensities })
}
