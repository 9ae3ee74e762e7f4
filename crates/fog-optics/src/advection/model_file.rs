//! The file format of an advection-fog model, apart from the model so that each can change without the other.

use super::AdvectionModel;
use crate::distribution::DiameterGrid;
use crate::error::OpticsError;
use serde::Deserialize;

/// Keys of the YAML file; their meaning is written in `tables/advection/arcata.yaml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(non_snake_case)]
struct ModelFile {
    diameter_range_um: [f64; 2],
    measured_fog_heights_m: Vec<f64>,
    mu_L: Vec<f64>,
    sigma_L: Vec<f64>,
    mu_G: Vec<f64>,
    sigma_G: Vec<f64>,
    ln_gl_ratio: Vec<f64>,
    number_density: Vec<Vec<f64>>,
    number_density_scale: f64,
}

/// Reads and checks a model.
pub(super) fn parse(text: &str) -> Result<AdvectionModel, OpticsError> {
    let file: ModelFile =
        serde_yaml::from_str(text).map_err(|error| OpticsError::ModelText(error.to_string()))?;
    check(&file)?;
    let diameters = DiameterGrid::fine(file.diameter_range_um)
        .map_err(|error| fault("diameter_range_um", error.to_string()))?;
    let model = AdvectionModel {
        diameters,
        measured_heights_m: file.measured_fog_heights_m,
        mu_l: file.mu_L,
        sigma_l: file.sigma_L,
        mu_g: file.mu_G,
        sigma_g: file.sigma_G,
        ln_gl_ratio: file.ln_gl_ratio,
        number_density: file.number_density,
        number_density_scale: file.number_density_scale,
    };
    check_spectra(&model)?;
    Ok(model)
}

fn fault(key: &'static str, problem: impl Into<String>) -> OpticsError {
    OpticsError::Model { key, problem: problem.into() }
}

fn check(file: &ModelFile) -> Result<(), OpticsError> {
    let polynomials = [
        ("mu_L", &file.mu_L),
        ("sigma_L", &file.sigma_L),
        ("mu_G", &file.mu_G),
        ("sigma_G", &file.sigma_G),
        ("ln_gl_ratio", &file.ln_gl_ratio),
    ];
    let rows = file.number_density.iter().map(|row| ("number_density", row));
    for (key, coefficients) in polynomials.into_iter().chain(rows) {
        if coefficients.is_empty() || coefficients.iter().any(|c| !c.is_finite()) {
            return Err(fault(key, "needs at least one coefficient, all finite"));
        }
    }
    if file.number_density.is_empty() {
        return Err(fault("number_density", "needs at least one row"));
    }
    if !(file.number_density_scale > 0.0 && file.number_density_scale.is_finite()) {
        return Err(fault(
            "number_density_scale",
            format!("is {}; valid: above 0", file.number_density_scale),
        ));
    }
    let [low, high] = file.diameter_range_um;
    if !(low >= 0.01 && high <= 1000.0 && low < high) {
        return Err(fault(
            "diameter_range_um",
            format!("is [{low}, {high}]; valid: ascending, within 0.01 to 1000"),
        ));
    }
    let heights = &file.measured_fog_heights_m;
    let ascending = heights.windows(2).all(|w| w[0] < w[1]);
    if heights.is_empty() || !ascending || heights.iter().any(|h| !(h.is_finite() && *h > 0.0)) {
        return Err(fault("measured_fog_heights_m", "needs ascending heights above 0"));
    }
    Ok(())
}

/// Widths must stay positive, and some droplets lie in the range, at every altitude.
fn check_spectra(model: &AdvectionModel) -> Result<(), OpticsError> {
    for i in 0..=1024 {
        let zeta = f64::from(i) / 1024.0;
        let shape = model.shape(zeta);
        for (key, sigma) in [("sigma_L", shape.sigma_l), ("sigma_G", shape.sigma_g)] {
            if sigma <= 0.0 {
                return Err(fault(
                    key,
                    format!("is {sigma} at zeta {zeta}; valid: above 0 for zeta in 0 to 1"),
                ));
            }
        }
        // Hundreds of exponentials: at the altitudes of the tables alone.
        if i % 32 != 0 {
            continue;
        }
        let inside = model.diameters.integrate(|d| shape.density_1_um(d));
        if !(inside.is_finite() && inside > 1e-3) {
            return Err(fault(
                "diameter_range_um",
                format!("holds a share of {inside} of the droplets at zeta {zeta}; valid: above 0.001"),
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::advection::ARCATA;

    fn error(from: &str, to: &str) -> String {
        assert!(ARCATA.contains(from));
        parse(&ARCATA.replace(from, to)).unwrap_err().to_string()
    }

    #[test]
    fn shipped_file_is_read() {
        let model = parse(ARCATA).unwrap();
        assert_eq!(model.number_density[1], [1.01430e9, 3.3810e6]);
        assert_eq!(model.measured_heights_m, [100.0, 180.0, 260.0]);
    }

    #[test]
    fn mistakes_are_named_with_their_place() {
        let message = error("mu_G:", "mu_Q:");
        assert!(message.contains("mu_Q") && message.contains("line 1"), "{message}");
        assert!(error("sigma_G: [1.41, 1.60]", "sigma_G: [wide]").contains("line"));
        assert!(error("sigma_G: [1.41, 1.60]", "sigma_G: [1.0, -2.0]").contains("sigma_G"));
        assert!(error("sigma_L: [0.79]", "sigma_L: []").contains("sigma_L"));
        assert!(error("sigma_L: [0.79]", "sigma_L: [.nan]").contains("sigma_L"));
        assert!(error("number_density_scale: 1.0\n", "").contains("number_density_scale"));
        assert!(error("scale: 1.0", "scale: -1.0").contains("above 0"));
        assert!(error("[0.5, 60.0]", "[60.0, 0.5]").contains("diameter_range_um"));
        assert!(error("[0.5, 60.0]", "[0.5, 60.01]").contains("diameter_range_um"));
        assert!(error("[100, 180, 260]", "[260, 100]").contains("measured_fog_heights_m"));
        assert!(parse("").is_err() && parse("- 1").is_err());
    }
}
