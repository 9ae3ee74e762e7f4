//! The phase function of a fog: what its key in the configuration means, and how it is recorded.

use crate::droplets::Spectrum;
use crate::error::Error;
use crate::resources::Resources;
use fog_core::phase::HenyeyGreenstein;
use fog_optics::error::OpticsError;
use fog_optics::layer::FogLayer;
use fog_optics::mean_cosine::layer_mean_cosine;
use fog_optics::mean_diameter::{self, diameter_table, layer_mean_diameter_um};
use fog_optics::{jendersie_deon, layer};
use fog_plan::{FogSpec, MeanCosine, Phase, Sampling};
use serde_json::{Value, json};

/// A phase function that is ready to be traced.
#[derive(Clone, Debug)]
pub(crate) struct FogPhase {
    pub(crate) phase: fog_scene::phase::Phase,
    /// Mean cosine, where it is the same everywhere.
    pub(crate) g: Option<f64>,
    /// What it is, for the record of a frame.
    pub(crate) record: Value,
}

impl FogPhase {
    /// The phase function that `spec` asks for in `layer`, whose droplets are those of `spectrum`, or the advection model's.
    ///
    /// # Errors
    /// If a table was not prepared, or the droplets are too large for the closed form.
    pub(crate) fn new(
        spec: &FogSpec,
        layer: &FogLayer,
        spectrum: Option<&Spectrum>,
        resources: &Resources,
    ) -> Result<Self, Error> {
        use fog_scene::phase::Phase as Traced;
        let table = || spectrum.map_or_else(|| resources.polydisperse(), |s| Ok(&s.table));
        let mean_diameter_um = || match spectrum {
            Some(spectrum) => spectrum.distribution.mean_diameter_um(),
            None => layer_mean_diameter_um(&resources.model),
        };
        Ok(match spec.phase {
            Phase::Hg(MeanCosine::Value(g)) => Self {
                phase: Traced::HenyeyGreenstein(henyey_greenstein(g)?),
                g: Some(g),
                record: json!({"kind": "henyey_greenstein", "g": g}),
            },
            Phase::Hg(MeanCosine::Layer) => {
                let g = layer_mean_cosine(layer, table()?);
                Self {
                    phase: Traced::HenyeyGreenstein(henyey_greenstein(g)?),
                    g: Some(g),
                    record: json!({
                        "kind": "henyey_greenstein",
                        "g": g,
                        "g_definition": "mean over altitude of the droplets' g, weighted by the layer's scattering",
                        "wavelength_nm": layer::REFERENCE_NM,
                    }),
                }
            }
            Phase::Mie => {
                let phase = match spec.sampling {
                    Sampling::Table => Traced::Table(table()?.clone()),
                    Sampling::Diameter => {
                        let (table, choice) = resources.single(&spec.model)?.clone();
                        Traced::Droplets { table, choice }
                    }
                };
                Self { phase, g: None, record: json!({"kind": "mie", "sampling": spec.sampling}) }
            }
            Phase::MieMeanDiameter => {
                let d = mean_diameter_um();
                let table = match spectrum {
                    Some(_) => diameter_table(d, mean_diameter::WAVELENGTH_NM)?,
                    None => resources.mean_diameter()?.clone(),
                };
                let g = table.view().g[0];
                Self {
                    phase: Traced::Table(table),
                    g: Some(g),
                    record: json!({
                        "kind": "mie_mean_diameter",
                        "diameter_um": d,
                        "wavelength_nm": mean_diameter::WAVELENGTH_NM,
                        "g": g,
                    }),
                }
            }
            Phase::JendersieDeon { diameter_um } => {
                let d = diameter_um.unwrap_or_else(mean_diameter_um);
                let (p, mixture) = (jendersie_deon::parameters(d)?, jendersie_deon::phase_function(d)?);
                let g = mixture.mean_cosine();
                Self {
                    phase: Traced::HgDraine(mixture),
                    g: Some(g),
                    record: json!({
                        "kind": "jendersie_deon",
                        "diameter_um": d,
                        "g_hg": p.g_hg,
                        "g_d": p.g_d,
                        "alpha": p.alpha,
                        "w_d": p.w_d,
                        "g": g,
                    }),
                }
            }
        })
    }
}

/// Rounded to single precision, which is what the renderer evaluates.
fn henyey_greenstein(g: f64) -> Result<HenyeyGreenstein, Error> {
    Ok(HenyeyGreenstein::new(f64::from(g as f32)).map_err(OpticsError::from)?)
}
