//! Mie scattering of water droplets by a closed form: Jendersie & d'Eon, *An Approximate Mie Scattering Function for Fog
//! and Cloud Rendering*, SIGGRAPH Talks 2023, doi 10.1145/3587421.3595409.
//!
//! A Henyey–Greenstein forward peak blended with Draine's function, whose four parameters are functions of the diameter
//! alone: fitted to visible light, over all of it, in four ranges of diameter. [`fit_error`] measures what that costs.

use crate::distribution::DiameterGrid;
use crate::error::OpticsError;
use crate::polydisperse::{DropletSpectra, average};
use fog_core::math::f64::{cos, exp, ln, pow, sin, tan};
use fog_core::math::{PI, TAU};
use fog_core::phase::{Draine, HenyeyGreenstein, HgDraine};
use fog_core::phase_grid::{self, NODES};

/// Diameters in µm that the fit was made for (the lower end is open). It is not continued beyond 50 µm: its authors give no
/// values there, and the diffraction peak would go on to narrow while the fitted functions level off.
pub const DIAMETER_RANGE_UM: [f64; 2] = [0.0, 50.0];

/// The four parameters of the fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Mean cosine of the Henyey–Greenstein part.
    pub g_hg: f64,
    /// g of Draine's function.
    pub g_d: f64,
    /// α of Draine's function.
    pub alpha: f64,
    /// Share of Draine's function.
    pub w_d: f64,
}

/// Parameters for a droplet's diameter in µm.
///
/// # Errors
/// Unless 0 < `diameter_um` ≤ 50.
pub fn parameters(diameter_um: f64) -> Result<Parameters, OpticsError> {
    let d = diameter_um;
    if !(d > DIAMETER_RANGE_UM[0] && d <= DIAMETER_RANGE_UM[1]) {
        let valid = "above 0 up to 50 (the range of the fit)".to_owned();
        return Err(OpticsError::Range { what: "diameter_um of jendersie_deon", value: d, valid });
    }
    let l = ln(d);
    Ok(if d <= 0.1 {
        Parameters {
            g_hg: 13.8 * d * d,
            g_d: 1.1456 * d * sin(9.29044 * d),
            alpha: 250.0,
            w_d: 0.252977 - 312.983 * pow(d, 4.3),
        }
    } else if d < 1.5 {
        let inner = (l - 0.238604) * (l + 1.00667) / (0.507522 - 0.15677 * l);
        Parameters {
            g_hg: 0.862 - 0.143 * l * l,
            g_d: 0.379685 * cos(1.19692 * cos(inner) + 1.37932 * l + 0.0625835) + 0.344213,
            alpha: 250.0,
            w_d: 0.146209 * cos(3.38707 * l + 2.11193) + 0.316072 + 0.0778917 * l,
        }
    } else if d < 5.0 {
        let ll = ln(l);
        Parameters {
            g_hg: 0.0604931 * ll + 0.940256,
            g_d: 0.500411 - 0.081287 / (-2.0 * l + tan(l) + 1.27551),
            alpha: 7.30354 * l + 6.31675,
            w_d: 0.026914 * (l - cos(5.68947 * (ll - 0.0292149))) + 0.376475,
        }
    } else {
        Parameters {
            g_hg: exp(-0.0990567 / (d - 1.67154)),
            g_d: exp(-2.20679 / (d + 3.91029) - 0.428934),
            alpha: exp(3.62489 - 8.29288 / (d + 5.52825)),
            w_d: exp(-0.599085 / (d - 0.641583) - 0.665888),
        }
    })
}

/// Phase function for a droplet's diameter in µm.
///
/// # Errors
/// Unless 0 < `diameter_um` ≤ 50.
pub fn phase_function(diameter_um: f64) -> Result<HgDraine, OpticsError> {
    let p = parameters(diameter_um)?;
    let (hg, draine) = (HenyeyGreenstein::new(p.g_hg)?, Draine::new(p.g_d, p.alpha)?);
    Ok(HgDraine::new(hg, draine, p.w_d)?)
}

/// How far the fit is from Mie scattering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitError {
    /// √(∫(p_fit − p_mie)² / ∫p_mie²) over the sphere: nearly all of it is the height of the forward peak.
    pub relative_l2: f64,
    /// Root mean square over the sphere of ln(p_fit / p_mie): directions count by their solid angle, so that this is an
    /// error of the sides and the back.
    pub log_rms: f64,
    /// Share of the light that goes elsewhere, ½ ∫|p_fit − p_mie|.
    pub misplaced: f64,
    /// Mean cosine of the fit.
    pub g_fit: f64,
    /// Mean cosine of the droplets, from the Mie series.
    pub g_mie: f64,
}

/// Standard deviation of ln d of the droplets in [`fit_error`]: wide enough to wash out the interference rings of a single
/// diameter, which no smooth function has.
pub const FIT_SIGMA: f64 = 0.1;

/// Error of the fit for a diameter in µm against water droplets in light of the given wavelengths (nm, ascending, of equal
/// power), whose diameters are spread lognormally about it with σ = [`FIT_SIGMA`] (61 diameters within ±3σ, by number).
///
/// # Errors
/// If the diameter is outside the fit's range, or a wavelength outside that of [`crate::water`].
pub fn fit_error(diameter_um: f64, wavelengths_nm: &[f64]) -> Result<FitError, OpticsError> {
    let fit = phase_function(diameter_um)?;
    let [low, high] = [-3.0, 3.0].map(|x| diameter_um * exp(x * FIT_SIGMA));
    let grid = DiameterGrid::new(low, high, (high - low) / 60.0)?;
    let density = |_: f64, d: f64| {
        let t = ln(d / diameter_um) / FIT_SIGMA;
        exp(-0.5 * t * t) / d
    };
    let mie = average(&DropletSpectra::new(&[0.0], &grid, density)?, wavelengths_nm, &|_| ())?;
    if wavelengths_nm.is_empty() {
        return Err(OpticsError::Settings("fit_error needs a wavelength".to_owned()));
    }
    // What is scattered at each wavelength goes where that wavelength's phase function sends it.
    let c_sca: f64 = mie.c_sca_m2.iter().sum();
    let g_mie = mie.c_sca_m2.iter().zip(&mie.g).map(|(c, g)| c * g).sum::<f64>() / c_sca;
    let mean = |node: usize| -> f64 {
        let p = mie.c_sca_m2.iter().enumerate().map(|(l, c)| c * mie.phase[l * NODES + node]);
        p.sum::<f64>() / c_sca
    };
    let nodes = phase_grid::nodes();
    let norm = phase_grid::integral(&nodes, mean);
    let p: Vec<f64> = (0..NODES).map(|i| mean(i) / norm).collect();
    let q: Vec<f64> = nodes.iter().map(|&m| fit.eval(m)).collect();
    let over_sphere = |f: &dyn Fn(usize) -> f64| -> f64 {
        (0..NODES - 1).map(|i| PI * (f(i) + f(i + 1)) * (nodes[i + 1] - nodes[i])).sum()
    };
    let square = over_sphere(&|i| (q[i] - p[i]) * (q[i] - p[i]));
    let log_square = over_sphere(&|i| {
        let x = ln(q[i] / p[i]);
        x * x
    });
    Ok(FitError {
        relative_l2: (square / over_sphere(&|i| p[i] * p[i])).sqrt(),
        log_rms: (log_square / (2.0 * TAU)).sqrt(),
        misplaced: 0.5 * over_sphere(&|i| (q[i] - p[i]).abs()),
        g_fit: fit.mean_cosine(),
        g_mie,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parameters evaluated by hand from the printed formulas, in Python's floating point.
    #[test]
    fn every_range_gives_the_published_functions() {
        for (d, g_hg, g_d, alpha, w_d) in [
            (0.05, 0.0345, 0.0256611824419, 250.0, 0.252180672401),
            (0.7, 0.843807966764, 0.678103150002, 250.0, 0.378733688186),
            (3.0, 0.945945244641, 0.421972778073, 14.3405087948, 0.380939362683),
            (12.0, 0.990455188326, 0.566863888225, 23.3775202099, 0.48741873231),
        ] {
            let p = parameters(d).unwrap();
            for (got, want) in [(p.g_hg, g_hg), (p.g_d, g_d), (p.alpha, alpha), (p.w_d, w_d)] {
                assert!((got - want).abs() < 1e-9 * want.abs(), "{d} µm: {got} for {want}");
            }
        }
    }

    #[test]
    fn ranges_meet() {
        // The published pieces do not join exactly; where they meet, the light that changes its way is little.
        let nodes = phase_grid::nodes();
        for (d, bound) in [(0.1, 0.03), (1.5, 0.06), (5.0, 0.03)] {
            let (p, q) = (phase_function(d - 1e-9).unwrap(), phase_function(d + 1e-9).unwrap());
            let moved = 0.5 * phase_grid::integral(&nodes, |i| (p.eval(nodes[i]) - q.eval(nodes[i])).abs());
            assert!(moved < bound, "{moved} at {d} µm");
        }
    }

    #[test]
    fn smallest_droplets_are_rayleigh() {
        let (p, rayleigh) = (phase_function(1e-4).unwrap(), Draine::new(0.0, 1.0).unwrap());
        for m in [0.0, 0.5, 1.0, 1.5, 2.0] {
            assert!(
                (p.eval(m) / rayleigh.eval(m) - 1.0).abs() < 2e-3,
                "{m}: {} {}",
                p.eval(m),
                rayleigh.eval(m)
            );
        }
    }

    #[test]
    fn errors_are_as_measured() {
        let visible: Vec<f64> = (0..4).map(|i| 400.0 + 100.0 * f64::from(i)).collect();
        // Diameter, and bounds on misplaced light and on the error of g over the visible, and at 550 nm alone.
        for (d, over, dg_over, at_550, dg_550) in [
            (0.02, 0.01, 0.01, 0.01, 0.01),
            (0.1, 0.06, 0.06, 0.07, 0.09),
            (0.2, 0.14, 0.14, 0.19, 0.22),
            (0.5, 0.23, 0.06, 0.27, 0.06),
            (1.0, 0.15, 0.03, 0.18, 0.03),
            (2.0, 0.13, 0.06, 0.19, 0.11),
            (3.0, 0.12, 0.03, 0.15, 0.02),
            (5.0, 0.12, 0.02, 0.13, 0.02),
            (10.0, 0.14, 0.02, 0.16, 0.02),
            (20.0, 0.16, 0.02, 0.17, 0.02),
            (50.0, 0.18, 0.02, 0.20, 0.02),
        ] {
            for (nm, misplaced, dg) in [(&visible[..], over, dg_over), (&[550.0], at_550, dg_550)] {
                let e = fit_error(d, nm).unwrap();
                let g = (e.g_fit - e.g_mie).abs();
                assert!(e.misplaced < misplaced && g < dg && e.log_rms < 0.5, "{d} µm at {nm:?}: {e:?}");
                assert!(e.misplaced > 1e-4 && e.relative_l2 > 1e-3, "{d} µm at {nm:?}: {e:?}");
            }
        }
    }

    #[test]
    fn beyond_the_fit_is_refused() {
        for d in [0.0, -1.0, 50.001, f64::NAN, f64::INFINITY] {
            let message = parameters(d).unwrap_err().to_string();
            assert!(message.contains("above 0 up to 50"), "{message}");
            assert!(fit_error(d, &[550.0]).is_err());
        }
        assert!(parameters(50.0).is_ok());
        assert!(fit_error(10.0, &[100.0]).is_err() && fit_error(10.0, &[]).is_err());
    }
}
