//! The fog of a frame: where optics (droplets, tables) and scene (media) meet.

use crate::droplets::{self, Spectrum};
use crate::error::Error;
use crate::phase::FogPhase;
use crate::resources::Resources;
use fog_core::optics_table::OpticsTable;
use fog_core::patchiness::{Patchiness, PatchinessError, PatchyField};
use fog_optics::droplets::DropletLayer;
use fog_optics::layer::{self, FogLayer};
use fog_optics::state::FogState;
use fog_optics::table::{self, TableSettings};
use fog_optics::{coefficient, layer_csv};
use fog_plan::{Coefficient, FogModel, FogSpec, PatchinessSpec, Phase};
use fog_scene::medium::Medium;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A frame's fog: the medium that is traced, and what it is made of.
#[derive(Clone, Debug)]
pub struct Fog {
    /// Extinction and phase function.
    pub medium: Medium,
    layer: FogLayer,
    droplets: Option<Droplets>,
    g: Option<f64>,
    phase_record: Value,
    /// Where the extinction comes from droplets.
    coefficient: Option<Coefficient>,
    /// Hashes of the files that it was read from.
    files: BTreeMap<String, String>,
    datum_m: f64,
}

/// What a layer's droplets are computed from.
#[derive(Clone, Debug)]
struct Droplets {
    table: OpticsTable,
    fog: DropletLayer,
    /// The configured spectrum; none for the advection model's, which vary with altitude.
    spectrum: Option<Spectrum>,
}

impl Fog {
    /// Fog of a specification; `None` for clear air.
    ///
    /// # Errors
    /// If a file of the fog cannot be read or is wrong, or the visibility cannot be met.
    pub fn new(spec: &FogSpec, resources: &Resources) -> Result<Option<Self>, Error> {
        let Some((mut layer, mut droplets)) = layer_of(spec, resources)? else { return Ok(None) };
        if let Some(wanted) = spec.visibility {
            let factor = layer.scale_for_mor(wanted.mor_m, wanted.altitude_m)?;
            layer = layer.scaled(factor)?;
            if let Some(droplets) = &mut droplets {
                droplets.fog = droplets.fog.clone().scaled(factor)?;
            }
        }
        let FogPhase { phase, g, record: phase_record } = FogPhase::new(spec, &layer, resources)?;
        let mut medium = Medium::new(layer.profile(spec.datum_m)?, phase);
        if let Some(patchiness) = &spec.patchiness {
            let wrong = |e: PatchinessError| Error::Fog(format!("fog.patchiness: {e}"));
            medium = medium.with_patches(field(patchiness).map_err(wrong)?).map_err(wrong)?;
        }
        let coefficient = from_droplets(&spec.model).then_some(spec.coefficient);
        let files = resources.files().hashes(spec.files());
        let datum_m = spec.datum_m;
        Ok(Some(Self { medium, layer, droplets, g, phase_record, coefficient, files, datum_m }))
    }

    /// Extinction and albedo by altitude over the datum.
    #[must_use]
    pub fn layer(&self) -> &FogLayer {
        &self.layer
    }

    /// The same droplets at these wavelengths in nm (ascending, up to 64), without patches; what does not depend on the wavelength
    /// stays. `spec`, whose sampling must be by table, and `resources` are those that the fog was made from.
    ///
    /// # Errors
    /// If a wavelength is outside of the table of water.
    pub(crate) fn at_wavelengths(
        &self,
        spec: &FogSpec,
        resources: &Resources,
        wavelengths_nm: &[f64],
    ) -> Result<Self, Error> {
        let mut fog = self.clone();
        let mut phase = FogPhase::new(spec, &self.layer, resources)?.phase;
        if self.droplets.is_some() || spec.phase == Phase::Mie {
            let spectra = &resources.droplets(spec)?.spectra;
            let visible = TableSettings::visible_of(spectra);
            let settings = TableSettings { wavelengths_nm: wavelengths_nm.to_vec(), ..visible };
            let table = table::build(spectra, &settings, &|_| ())?;
            if let Some(droplets) = &mut fog.droplets {
                fog.layer = layer_from(spec.coefficient, &table, &droplets.fog)?;
                droplets.table = table.clone();
            }
            if spec.phase == Phase::Mie {
                phase = fog_scene::phase::Phase::Table(table);
            }
        }
        fog.medium = Medium::new(fog.layer.profile(self.datum_m)?, phase);
        Ok(fog)
    }

    /// Phase function, scattering coefficient, and BLAKE3 hashes of the fog's files by their paths, as they are recorded.
    pub(crate) fn optics_json(&self) -> [(&'static str, Value); 3] {
        [
            ("phase", self.phase_record.clone()),
            ("coefficient", json!(self.coefficient)),
            ("files", json!(self.files)),
        ]
    }

    /// Patches over the point (x, z) in m as they are recorded; null where the layer is even.
    pub(crate) fn patches_json(&self, x_m: f64, z_m: f64) -> Value {
        let Some(field) = self.medium.patches() else { return Value::Null };
        let [base, top] = self.extent_m();
        json!({
            "over_camera": {
                "density_factor": field.density_factor(x_m, z_m),
                "top_m": top + field.top_offset_m(x_m, z_m),
            },
            "mean_top_m": top,
            "definition": "sigma_t is density_factor times that of the mean layer at base + (altitude - base) * \
                           (mean top - base) / (top - base); at_camera, at_base and at_top are of the mean layer",
            "base_m": base,
        })
    }

    /// Altitude over the fog's datum of world height `y`, in metres.
    pub(crate) fn altitude_m(&self, y: f64) -> f64 {
        y - self.datum_m
    }

    /// Altitudes of the layer's base and top in metres over the datum.
    pub(crate) fn extent_m(&self) -> [f64; 2] {
        self.layer.extent_m()
    }

    /// What the fog is at an altitude in metres over its datum: σ_t, albedo, g and visibility at 550 nm, and the droplets
    /// where the model has them. σ_t is that of the layer that is traced, which is linear between its rows. A phase
    /// function that is not the droplets' own gives its own g.
    ///
    /// # Errors
    /// None for a fog that could be made.
    pub fn state(&self, altitude_m: f64) -> Result<FogState, Error> {
        let grey = FogState::grey(&self.layer, self.g, altitude_m);
        let Some(d) = &self.droplets else { return Ok(grey) };
        let mut state = FogState::droplets(&d.table, &d.fog, altitude_m);
        (state.sigma_t_550_1_m, state.mor_m) = (grey.sigma_t_550_1_m, grey.mor_m);
        if self.coefficient == Some(Coefficient::Paper) {
            state.albedo = state.albedo.and(grey.albedo);
        }
        if state.g.is_some() && self.g.is_some() {
            state.g = self.g;
        }
        Ok(state)
    }

    /// The configured spectrum and its number as they are recorded; null for other models.
    pub(crate) fn droplets_json(&self) -> Value {
        let Some(Droplets { fog, spectrum: Some(spectrum), .. }) = &self.droplets else { return Value::Null };
        let mut value = spectrum.to_json();
        value["mean_number_density_1_m3"] = json!(fog.mean_number_density_1_m3());
        value
    }

    /// [`Fog::state`] as it is recorded.
    pub(crate) fn state_json(&self, altitude_m: f64) -> Value {
        let s = self.state(altitude_m).unwrap_or_default();
        json!({
            "altitude_m": altitude_m,
            "sigma_t_1_m": s.sigma_t_550_1_m,
            "albedo": s.albedo,
            "g": s.g,
            "mor_m": s.mor_m,
            "mor_contrast_threshold": 0.05,
            "liquid_water_content_g_m3": s.liquid_water_content_g_m3,
            "number_density_1_m3": s.number_density_1_m3,
            "effective_radius_um": s.effective_radius_um,
            "mean_diameter_um": s.mean_diameter_um,
        })
    }
}

/// The billows of a specification.
fn field(spec: &PatchinessSpec) -> Result<PatchyField, PatchinessError> {
    let PatchinessSpec { density_sd, top_sd_m, length_m, octaves, seed } = *spec;
    PatchyField::new(Patchiness { density_sd, top_sd_m, length_m, octaves, seed })
}

/// True if the extinction of the layer, or a part of it, is that of droplets.
fn from_droplets(model: &FogModel) -> bool {
    match model {
        FogModel::None | FogModel::Layered { .. } => false,
        FogModel::Advection { .. } | FogModel::Droplets { .. } => true,
        FogModel::Homogeneous { sigma_t_1_m, .. } => sigma_t_1_m.is_none(),
        FogModel::LinearGradient { sigma_t_base_1_m, sigma_t_top_1_m, .. } => {
            sigma_t_base_1_m.is_none() || sigma_t_top_1_m.is_none()
        }
    }
}

/// The layer of droplets.
fn layer_from(coefficient: Coefficient, table: &OpticsTable, fog: &DropletLayer) -> Result<FogLayer, Error> {
    Ok(match coefficient {
        Coefficient::Integral => layer::droplets(table, fog),
        Coefficient::Paper => coefficient::paper_layer(fog, table.view().wavelengths_nm)?,
    })
}

/// The layer of a model, and its droplets where the model has them.
fn layer_of(spec: &FogSpec, resources: &Resources) -> Result<Option<(FogLayer, Option<Droplets>)>, Error> {
    // What the paper's baselines take their extinction from if none is given (Sec. 6.1).
    let advection = |height_m: f64| -> Result<FogLayer, Error> {
        layer_from(
            spec.coefficient,
            resources.mixture(spec)?,
            &DropletLayer::advection(resources.model(spec)?, height_m)?,
        )
    };
    let layer = match &spec.model {
        FogModel::None => return Ok(None),
        FogModel::Advection { height_m, number_density_scale } => {
            let model = resources.model(spec)?;
            let fog = DropletLayer::advection(model, *height_m)?.scaled(*number_density_scale)?;
            let table = resources.mixture(spec)?.clone();
            return Ok(Some((
                layer_from(spec.coefficient, &table, &fog)?,
                Some(Droplets { table, fog, spectrum: None }),
            )));
        }
        FogModel::Droplets { height_m, droplets, number_density_1_m3, vertical } => {
            let spectrum = resources.spectrum(droplets)?;
            let number = *number_density_1_m3;
            let fog = droplets::fog(spec, spectrum, number, vertical, *height_m, resources)?;
            let (table, spectrum) = (resources.mixture(spec)?.clone(), Some(spectrum.clone()));
            return Ok(Some((
                layer_from(spec.coefficient, &table, &fog)?,
                Some(Droplets { table, fog, spectrum }),
            )));
        }
        FogModel::Homogeneous { height_m, sigma_t_1_m, single_scattering_albedo } => {
            let sigma =
                sigma_t_1_m.map_or_else(|| Ok(advection(*height_m)?.mean_sigma_t()), Ok::<_, Error>)?;
            layer::homogeneous(*height_m, sigma, *single_scattering_albedo)?
        }
        FogModel::LinearGradient {
            height_m,
            sigma_t_base_1_m,
            sigma_t_top_1_m,
            single_scattering_albedo,
        } => {
            let (base, top) = match (sigma_t_base_1_m, sigma_t_top_1_m) {
                (Some(base), Some(top)) => (*base, *top),
                (base, top) => {
                    let [low, high] = advection(*height_m)?.min_max_sigma_t();
                    (base.unwrap_or(low), top.unwrap_or(high))
                }
            };
            layer::linear_gradient(*height_m, base, top, *single_scattering_albedo)?
        }
        FogModel::Layered { file, single_scattering_albedo } => {
            let rows = layer_csv::parse_layers(resources.files().text(file)?, &file.display().to_string())?;
            layer::layered(&rows, *single_scattering_albedo)?
        }
    };
    Ok(Some((layer, None)))
}
