//! The text of a model file, as `tables/advection/arcata.yaml` is one.

use super::outcome::SHAPE_KEYS;
use std::fmt::Write;

/// What a model file holds.
pub(super) struct ModelText<'a> {
    /// Lines of the comment on top.
    pub(super) comment: &'a [String],
    pub(super) diameter_range_um: [f64; 2],
    pub(super) heights_m: &'a [f64],
    /// Coefficients over powers of ζ, with a remark each.
    pub(super) shapes: [(Vec<f64>, String); 5],
    /// Coefficients of ζⁱ Hʲ.
    pub(super) number: &'a [Vec<f64>],
    pub(super) number_remark: String,
}

impl ModelText<'_> {
    pub(super) fn yaml(&self) -> String {
        let mut text = String::new();
        for line in self.comment {
            let _ = writeln!(text, "{}", format!("# {line}").trim_end());
        }
        let _ = writeln!(
            text,
            "#\n# n(d, z) = L * lognormal(d; mu_L, sigma_L) + G * normal(d; mu_G, sigma_G)     [m^-3 um^-1], d in um"
        );
        let _ = writeln!(
            text,
            "# zeta = z / fog_height in [0, 1]. Polynomials list c0, c1, ... of sum c_i zeta^i."
        );
        let _ = writeln!(
            text,
            "# L = N / (1 + r), G = N r / (1 + r), r = exp(ln_gl_ratio(zeta)), N = number density [m^-3]."
        );
        let [low, high] = self.diameter_range_um;
        let _ = writeln!(text, "diameter_range_um: {}", list(&[low, high]));
        let _ = writeln!(text, "measured_fog_heights_m: {}", list(self.heights_m));
        for (key, (coefficients, remark)) in SHAPE_KEYS.iter().zip(&self.shapes) {
            let _ = writeln!(text, "{key}: {}  # {remark}", list(coefficients));
        }
        let _ = writeln!(
            text,
            "# N(zeta, H) = sum_ij number_density[i][j] zeta^i H^j, H in m. {}",
            self.number_remark
        );
        let _ = writeln!(text, "number_density:");
        for row in self.number {
            let _ = writeln!(text, "  - {}", list(row));
        }
        let _ = writeln!(text, "number_density_scale: 1.0");
        text
    }
}

fn list(values: &[f64]) -> String {
    let numbers: Vec<String> = values.iter().map(|x| number(*x)).collect();
    format!("[{}]", numbers.join(", "))
}

/// Nine significant digits, always with a point or an exponent so that YAML sees a float.
pub(super) fn number(x: f64) -> String {
    let rounded = rounded(x);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        format!("{rounded:?}")
    } else {
        format!("{rounded:e}")
    }
}

/// The number to nine significant digits, as it stands in the file.
pub(super) fn rounded(x: f64) -> f64 {
    format!("{x:.8e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_nine_digits() {
        assert_eq!(number(1.0), "1.0");
        assert_eq!(number(0.123_456_789_012), "0.123456789");
        assert_eq!(number(-5.4096e9), "-5.4096e9");
        assert_eq!(number(2.5e-7), "2.5e-7");
        assert_eq!(number(0.0), "0.0");
        assert_eq!(list(&[100.0, 180.5]), "[100.0, 180.5]");
    }
}
