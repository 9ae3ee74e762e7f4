//! A fit as tables for machines: CSV with units in the names of the columns.

use super::bins::shares;
use super::measurements::Bin;
use super::outcome::{Fit, OwnFit, SHAPE_KEYS};
use crate::distribution::{SpectrumShape, gaussian, lognormal};
use std::fmt::Write;

impl OwnFit {
    /// The two parts of the fit at a diameter in µm, lognormal and Gaussian, in m⁻³ µm⁻¹ (Eq. 1): their sum is the fit.
    #[must_use]
    pub fn parts_1_m3_um(&self, d_um: f64) -> [f64; 2] {
        parts(self.number_density_1_m3, &self.shape, d_um)
    }
}

/// Lognormal and Gaussian part of a spectrum of `number` droplets per m³.
fn parts(number: f64, shape: &SpectrumShape, d_um: f64) -> [f64; 2] {
    let r = shape.gl_ratio;
    [
        number / (1.0 + r) * lognormal(d_um, shape.mu_l, shape.sigma_l),
        number * r / (1.0 + r) * gaussian(d_um, shape.mu_g, shape.sigma_g),
    ]
}

/// Mean densities over a bin in m⁻³ µm⁻¹ of a spectrum of `number` droplets per m³: the whole, lognormal, Gaussian.
fn bin_means(number: f64, shape: &SpectrumShape, bin: &Bin) -> [f64; 3] {
    let [mu_l, sigma_l, mu_g, sigma_g, ln_ratio] = shape.parameters();
    // e^±700 leaves one of the parts alone.
    let alone = |ln_ratio: f64| {
        let mut share = Vec::new();
        shares(&[mu_l, sigma_l, mu_g, sigma_g, ln_ratio], &[*bin], &mut share);
        number * share[0].value / bin.width_um()
    };
    let r = shape.gl_ratio;
    [alone(ln_ratio), alone(-700.0) / (1.0 + r), alone(700.0) * r / (1.0 + r)]
}

/// Text in a CSV cell: no commas, quotes or line ends.
fn cell(text: &str) -> String {
    text.chars().map(|c| if matches!(c, ',' | '"' | '\n' | '\r') { ';' } else { c }).collect()
}

/// A number in a CSV cell: seven significant digits.
fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.6e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-3..1e7).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

impl Fit {
    /// `fits.csv`: a row for each altitude. Cells of what an altitude has not are empty; `rrse` and `model_rrse` are shares
    /// (0.023 is 2.3 %), columns that end in `_error` standard errors.
    #[must_use]
    pub fn fits_csv(&self) -> String {
        let mut text = String::from(
            "fog_height_m,altitude_m,zeta,standing,bins,bins_set_aside,droplets,number_density_1_m3,number_density_error_1_m3,\
             number_density_set_aside,model_rrse,own_number_density_1_m3,own_number_density_error_1_m3",
        );
        for key in SHAPE_KEYS {
            let _ = write!(text, ",own_{key},own_{key}_error");
        }
        text.push_str(",own_rrse,own_deviance_per_freedom,own_agreeing_starts,reason\n");
        for a in &self.altitudes {
            let s = &a.spectrum;
            let mut cells = vec![
                short(s.fog_height_m),
                short(s.altitude_m),
                short(s.zeta()),
                a.standing.word().to_owned(),
                s.bins.len().to_string(),
                a.bad_bins.len().to_string(),
                short(s.droplets()),
            ];
            match a.number_density {
                Some([value, error]) => {
                    cells.extend([short(value), short(error), a.number_rejected.to_string()])
                }
                None => cells.extend(["", "", ""].map(String::from)),
            }
            cells.push(short(a.model_rrse));
            match &a.own {
                Some(own) => {
                    cells.push(short(own.number_density_1_m3));
                    cells.push(short(own.number_density_1_m3 * own.number_density_error));
                    for (value, error) in own.shape.parameters().iter().zip(own.shape_errors) {
                        cells.extend([short(*value), short(error)]);
                    }
                    cells.extend([
                        short(own.rrse),
                        short(own.deviance_per_freedom),
                        own.agreeing_starts.to_string(),
                    ]);
                }
                None => cells.extend(std::iter::repeat_n(String::new(), 15)),
            }
            cells.push(cell(a.standing.reason()));
            text.push_str(&cells.join(","));
            text.push('\n');
        }
        text
    }

    /// `parameters.csv`: the model's curves, a row for each parameter and ζ (and fog height, for `number_density`).
    #[must_use]
    pub fn parameters_csv(&self) -> String {
        let mut text = String::from("parameter,fog_height_m,zeta,value,standard_error\n");
        for shape in &self.shapes {
            for [zeta, value, error] in &shape.curve {
                let _ = writeln!(text, "{},,{},{},{}", shape.key, short(*zeta), short(*value), short(*error));
            }
        }
        for row in &self.number.curves {
            let _ = writeln!(text, "number_density,{}", row.map(short).join(","));
        }
        text
    }

    /// `spectra.csv`: a row for each bin with the measured density, the altitude's own fit with its two parts, and the
    /// model, all in m⁻³ µm⁻¹ and means over the bin.
    #[must_use]
    pub fn spectra_csv(&self) -> String {
        let mut text = String::from(
            "fog_height_m,altitude_m,diameter_low_um,diameter_high_um,measured_1_m3_um,set_aside,own_fit_1_m3_um,\
             own_lognormal_1_m3_um,own_gaussian_1_m3_um,model_1_m3_um\n",
        );
        for a in &self.altitudes {
            let s = &a.spectrum;
            for (i, bin) in s.bins.iter().enumerate() {
                let own = a.own.map_or_else(
                    || [""; 3].map(String::from),
                    |own| bin_means(own.number_density_1_m3, &own.shape, bin).map(short),
                );
                let number = self.model.number_density_1_m3(s.zeta(), s.fog_height_m);
                let [model, ..] = bin_means(number, &self.model.shape(s.zeta()), bin);
                let _ = writeln!(
                    text,
                    "{},{},{},{},{},{},{},{}",
                    short(s.fog_height_m),
                    short(s.altitude_m),
                    short(bin.low_um),
                    short(bin.high_um),
                    short(bin.density_1_m3_um()),
                    a.bad_bins.contains(&i),
                    own.join(","),
                    short(model),
                );
            }
        }
        text
    }
}
