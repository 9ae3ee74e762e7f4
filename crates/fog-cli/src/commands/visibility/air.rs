//! The air that one looks through: a layer, and its droplets where they are known.

use crate::args::VisibilityArgs;
use crate::commands::fog_source::FogSource;
use anyhow::{Context, Result};
use fogbank::optics::advection::AdvectionModel;
use fogbank::optics::layer::{self, FogLayer, REFERENCE_NM};
use fogbank::optics::layer_csv::parse_layers;
use fogbank::optics::parcel::FogParcel;
use fogbank::optics::table::{TableSettings, build_table};
use fogbank::optics::visibility::Sight;

/// Height in m of fog that is the same everywhere.
const ENDLESS_M: f64 = 1e5;

/// What one looks through.
pub(super) struct Air {
    pub(super) description: String,
    pub(super) sight: Sight,
    /// Altitudes of base and top in m; none for fog that is the same everywhere.
    pub(super) extent_m: Option<[f64; 2]>,
    droplets: Droplets,
}

enum Droplets {
    Unknown,
    /// The model's, with the number of droplets scaled.
    Advection {
        model: Box<AdvectionModel>,
        height_m: f64,
        scale: f64,
    },
    Everywhere(Box<FogParcel>),
}

impl Air {
    /// The air of the arguments; `first_m` is the first altitude.
    pub(super) fn new(args: &VisibilityArgs, first_m: f64) -> Result<Self> {
        if let Some(file) = &args.layers {
            let text =
                std::fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
            let layer = layer::layered(&parse_layers(&text, &file.to_string_lossy())?, 1.0)?;
            return Self::of_layer(&layer, format!("Layer of {}", file.display()), Droplets::Unknown);
        }
        match FogSource::new(&args.fog)? {
            FogSource::Advection { model, height_m, mor_m } => advection(model, height_m, mor_m, first_m),
            FogSource::Droplets { fog, description } => {
                let sigma_t = fog.sigma_t_550_1_m();
                Self::even(sigma_t, args.fog.height, description, Droplets::Everywhere(Box::new(fog)))
            }
            FogSource::Extinction(sigma_t) => {
                let description = format!("Fog of {} 1/m", crate::rows::significant(sigma_t));
                Self::even(sigma_t, args.fog.height, description, Droplets::Unknown)
            }
        }
    }

    fn of_layer(layer: &FogLayer, description: String, droplets: Droplets) -> Result<Self> {
        Ok(Self { description, sight: Sight::new(layer)?, extent_m: Some(layer.extent_m()), droplets })
    }

    fn even(sigma_t: f64, height_m: Option<f64>, what: String, droplets: Droplets) -> Result<Self> {
        let layer = layer::homogeneous(height_m.unwrap_or(ENDLESS_M), sigma_t, 1.0)?;
        let description = match height_m {
            Some(height_m) => format!("{what}, the same from the ground to {height_m} m"),
            None => format!("{what}, the same everywhere"),
        };
        let air = Self::of_layer(&layer, description, droplets)?;
        Ok(Self { extent_m: height_m.and(air.extent_m), ..air })
    }

    /// The droplets at an altitude in m, where they are known and there are any.
    pub(super) fn droplets(&self, altitude_m: f64) -> Result<Option<FogParcel>> {
        Ok(match &self.droplets {
            Droplets::Unknown => None,
            Droplets::Advection { height_m, .. } if !(0.0..=*height_m).contains(&altitude_m) => None,
            Droplets::Advection { model, height_m, scale } => {
                match FogParcel::advection(model, *height_m, altitude_m)? {
                    Some(fog) => Some(fog.scaled(*scale)?),
                    None => None,
                }
            }
            Droplets::Everywhere(fog) => {
                let [base, top] = self.extent_m.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
                (base..=top).contains(&altitude_m).then(|| (**fog).clone())
            }
        })
    }
}

/// The model's layer. One wavelength is enough, whose table takes a few hundredths of a second.
fn advection(model: AdvectionModel, height_m: f64, mor_m: Option<f64>, first_m: f64) -> Result<Air> {
    let settings = TableSettings { wavelengths_nm: vec![REFERENCE_NM], ..TableSettings::visible(&model) };
    let table = build_table(&model, &settings, &|_| ())?;
    let mut fog = layer::advection(&table, &model, height_m, 1.0)?;
    let mut description = format!("Advection fog, {height_m} m high (Kolářová, Lachiver & Wilkie 2024)");
    let mut scale = 1.0;
    if let Some(mor_m) = mor_m {
        scale = fog.scale_for_mor(mor_m, first_m)?;
        fog = fog.scaled(scale)?;
        description += &format!(
            ", {} times the model's number of droplets for a MOR of {mor_m} m at {first_m} m",
            crate::rows::significant(scale)
        );
    }
    Air::of_layer(&fog, description, Droplets::Advection { model: Box::new(model), height_m, scale })
}
