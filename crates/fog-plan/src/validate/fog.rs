//! Checks of `fog`.

use super::Check;
use crate::{
    frame::{Coefficient, FogModel, FogSpec, MeanCosine, Phase, Sampling, Visibility},
    ranges,
    schema::{
        CoefficientFile, FogFile, FogModelName, MeanCosineFile, OrNone, PhaseFile, SamplingFile,
        VisibilityFile,
    },
};

use FogModelName::{Advection, Droplets, Homogeneous, Layered, LinearGradient};

/// Number density and albedo of fogs that do not say.
pub(crate) const DEFAULT_SCALE: f64 = 1.0;
/// Water hardly absorbs visible light.
pub(crate) const DEFAULT_ALBEDO: f64 = 1.0;

/// Models that have a layer of given thickness.
const WITH_HEIGHT: [FogModelName; 4] = [Advection, Droplets, Homogeneous, LinearGradient];
/// Models whose albedo is given rather than computed.
const WITH_ALBEDO: [FogModelName; 3] = [Homogeneous, LinearGradient, Layered];

impl Check<'_> {
    pub(super) fn fog(&mut self, fog: Option<&OrNone<FogFile>>) -> Option<FogSpec> {
        let fog = match self.required(
            "fog",
            fog,
            "give `none` or a map such as {model: advection, height_m: 180}",
        )? {
            OrNone::None(_) => {
                return Some(FogSpec {
                    model: FogModel::None,
                    coefficients: None,
                    phase: Phase::Mie,
                    coefficient: Coefficient::default(),
                    sampling: Sampling::default(),
                    visibility: None,
                    patchiness: None,
                    datum_m: 0.0,
                });
            }
            OrNone::Some(fog) => fog,
        };
        let phase = self.phase(fog.phase);
        let coefficient = self.coefficient(fog);
        let sampling = self.sampling(fog);
        let datum_m = self.range("fog.datum_m", fog.datum_m, ranges::DATUM_M);
        let visibility =
            fog.visibility.as_ref().map_or(Some(None), |v| self.visibility(v, fog.height_m).map(Some));
        let patchiness = self.patchiness(fog.patchiness.as_ref(), fog.height_m);
        let why = "one of advection, droplets, homogeneous, linear_gradient, layered";
        let name = self.required("fog.model", fog.model, why)?;
        self.foreign_keys(fog, name);
        let model = self.model(fog, name);
        let spec = FogSpec {
            model: model?,
            coefficients: fog.coefficients.as_ref().map(Into::into),
            phase: phase?,
            coefficient: coefficient?,
            sampling: sampling?,
            visibility: visibility?,
            patchiness: patchiness?,
            datum_m: datum_m?,
        };
        if spec.coefficients.is_some() && !spec.takes_advection_model() {
            let message = match name {
                Droplets => {
                    "is the file of the advection model, which `droplets` takes only `vertical: advection` from"
                }
                _ => {
                    "is the file of the advection model, but this fog's extinction and phase function are given"
                }
            };
            self.problem("fog.coefficients", message);
            return None;
        }
        Some(spec)
    }

    fn phase(&mut self, phase: PhaseFile) -> Option<Phase> {
        match phase {
            PhaseFile::Mie => Some(Phase::Mie),
            PhaseFile::Hg(MeanCosineFile::Value(g)) => {
                let g = self.range("fog.phase.hg", g, ranges::HG_G)?;
                Some(Phase::Hg(MeanCosine::Value(g)))
            }
            PhaseFile::Hg(MeanCosineFile::Word(_)) => Some(Phase::Hg(MeanCosine::Layer)),
            PhaseFile::MieMeanDiameter => Some(Phase::MieMeanDiameter),
            PhaseFile::JendersieDeon(file) => {
                let diameter_um = file.and_then(|file| file.diameter_um);
                let path = "fog.phase.jendersie_deon.diameter_um";
                let diameter_um = self.optional(path, diameter_um, ranges::FIT_DIAMETER_UM)?;
                Some(Phase::JendersieDeon { diameter_um })
            }
        }
    }

    /// The coefficient of a layer whose extinction comes from droplets; another layer must not name one.
    fn coefficient(&mut self, fog: &FogFile) -> Option<Coefficient> {
        let Some(coefficient) = fog.coefficient else { return Some(Coefficient::default()) };
        let given = match fog.model {
            Some(Homogeneous) if fog.sigma_t_1_m.is_some() => Some("sigma_t_1_m"),
            Some(LinearGradient) if fog.sigma_t_base_1_m.is_some() && fog.sigma_t_top_1_m.is_some() => {
                Some("sigma_t_base_1_m and sigma_t_top_1_m")
            }
            Some(Layered) => Some("file"),
            _ => None,
        };
        if let Some(given) = given {
            let message =
                format!("is about the extinction that droplets add up to, but here {given} says it");
            self.problem("fog.coefficient", message);
            return None;
        }
        Some(match coefficient {
            CoefficientFile::Integral => Coefficient::Integral,
            CoefficientFile::Paper => Coefficient::Paper,
        })
    }

    fn sampling(&mut self, fog: &FogFile) -> Option<Sampling> {
        match fog.sampling {
            None | Some(SamplingFile::Table) => Some(Sampling::Table),
            Some(SamplingFile::Diameter) if matches!(fog.phase, PhaseFile::Mie) => Some(Sampling::Diameter),
            Some(SamplingFile::Diameter) => {
                let message = "`diameter` draws droplets of the fog, which only `phase: mie` knows";
                self.problem("fog.sampling", message);
                None
            }
        }
    }

    fn visibility(&mut self, visibility: &VisibilityFile, height_m: Option<f64>) -> Option<Visibility> {
        let mor = self.required("fog.visibility.mor_m", visibility.mor_m, "1 to 100000 m");
        let mor = mor.and_then(|mor| self.range("fog.visibility.mor_m", mor, ranges::MOR_M));
        let path = "fog.visibility.altitude_m";
        let altitude = self.required(path, visibility.altitude_m, "the altitude in metres where mor_m holds");
        let altitude = altitude.and_then(|z| self.range(path, z, ranges::VISIBILITY_ALTITUDE_M));
        if let (Some(altitude), Some(height)) = (altitude, height_m)
            && altitude > height
        {
            self.problem(path, format!("{altitude} m is above the layer, whose height_m is {height} m"));
            return None;
        }
        Some(Visibility { mor_m: mor?, altitude_m: altitude? })
    }

    /// Keys of another model: a sign of a mistake, so never ignored.
    fn foreign_keys(&mut self, fog: &FogFile, model: FogModelName) {
        let keys: [(&str, bool, &[FogModelName]); 10] = [
            ("height_m", fog.height_m.is_some(), &WITH_HEIGHT),
            ("number_density_scale", fog.number_density_scale.is_some(), &[Advection]),
            ("droplets", fog.droplets.is_some(), &[Droplets]),
            ("number_density_1_m3", fog.number_density_1_m3.is_some(), &[Droplets]),
            ("vertical", fog.vertical.is_some(), &[Droplets]),
            ("sigma_t_1_m", fog.sigma_t_1_m.is_some(), &[Homogeneous]),
            ("sigma_t_base_1_m", fog.sigma_t_base_1_m.is_some(), &[LinearGradient]),
            ("sigma_t_top_1_m", fog.sigma_t_top_1_m.is_some(), &[LinearGradient]),
            ("file", fog.file.is_some(), &[Layered]),
            ("single_scattering_albedo", fog.single_scattering_albedo.is_some(), &WITH_ALBEDO),
        ];
        for (key, given, owners) in keys {
            if given && !owners.contains(&model) {
                let names: Vec<&str> = owners.iter().map(|owner| owner.name()).collect();
                self.belongs("fog", key, ("model", &names), model.name());
            }
        }
    }

    fn model(&mut self, fog: &FogFile, name: FogModelName) -> Option<FogModel> {
        let height = if WITH_HEIGHT.contains(&name) {
            let height = self.required("fog.height_m", fog.height_m, "the layer's thickness, 1 to 5000 m");
            height.and_then(|height| self.range("fog.height_m", height, ranges::LAYER_HEIGHT_M))
        } else {
            None
        };
        let albedo = fog.single_scattering_albedo.unwrap_or(DEFAULT_ALBEDO);
        let albedo = self.range("fog.single_scattering_albedo", albedo, ranges::ALBEDO);
        Some(match name {
            Advection => {
                let scale = fog.number_density_scale.unwrap_or(DEFAULT_SCALE);
                let scale = self.range("fog.number_density_scale", scale, ranges::DENSITY_SCALE);
                FogModel::Advection { height_m: height?, number_density_scale: scale? }
            }
            Droplets => self.parcel(fog, height)?,
            Homogeneous => {
                let sigma_t = self.optional("fog.sigma_t_1_m", fog.sigma_t_1_m, ranges::SIGMA_T_1_M);
                FogModel::Homogeneous {
                    height_m: height?,
                    sigma_t_1_m: sigma_t?,
                    single_scattering_albedo: albedo?,
                }
            }
            LinearGradient => {
                let base = self.optional("fog.sigma_t_base_1_m", fog.sigma_t_base_1_m, ranges::SIGMA_T_1_M);
                let top = self.optional("fog.sigma_t_top_1_m", fog.sigma_t_top_1_m, ranges::SIGMA_T_1_M);
                FogModel::LinearGradient {
                    height_m: height?,
                    sigma_t_base_1_m: base?,
                    sigma_t_top_1_m: top?,
                    single_scattering_albedo: albedo?,
                }
            }
            Layered => {
                let why = "path of a CSV file with columns altitude_m,sigma_t_1_m";
                let file = self.required("fog.file", fog.file.as_ref(), why);
                FogModel::Layered { file: file?.into(), single_scattering_albedo: albedo? }
            }
        })
    }
}
