//! Checks of `lighting.sky` and `lighting.moon`.

use super::Check;
use crate::{
    ranges,
    schema::{
        AEROSOL_OPTICAL_DEPTH, GROUND_ALBEDO, MoonFile, NIGHT_LUMINANCE_CD_M2, OZONE_DU, SkyFile,
        SkyModelName,
        SkyModelName::{Cie, Clear, Overcast},
    },
    sky::{MoonSpec, SkyBrightness, SkySpec},
};

/// Types of the CIE standard general sky that do not depend on the sun.
const SUNLESS_TYPES: [u32; 3] = [1, 3, 5];

impl Check<'_> {
    /// `sun` says whether the frame has one.
    pub(super) fn sky(&mut self, file: &SkyFile, sun: bool) -> Option<SkySpec> {
        let why = "one of clear, cie, overcast";
        let model = self.required("lighting.sky.model", file.model, why)?;
        self.foreign_sky_keys(file, model);
        let path = "lighting.sky.ground_albedo";
        let ground_albedo = self.range(path, file.ground_albedo.unwrap_or(GROUND_ALBEDO), ranges::ALBEDO);
        if model == Clear {
            let path = "lighting.sky.aerosol_optical_depth";
            let aerosol = file.aerosol_optical_depth.unwrap_or(AEROSOL_OPTICAL_DEPTH);
            let aerosol = self.range(path, aerosol, ranges::AEROSOL_DEPTH);
            let ozone =
                self.range("lighting.sky.ozone_du", file.ozone_du.unwrap_or(OZONE_DU), ranges::OZONE_DU);
            let path = "lighting.sky.night_luminance_cd_m2";
            let night = file.night_luminance_cd_m2.unwrap_or(NIGHT_LUMINANCE_CD_M2);
            let night = self.range(path, night, ranges::NIGHT_CD_M2);
            return Some(SkySpec::Clear {
                aerosol_optical_depth: aerosol?,
                ozone_du: ozone?,
                night_luminance_cd_m2: night?,
                ground_albedo: ground_albedo?,
            });
        }
        let brightness = self.brightness(file);
        let path = "lighting.sky.color_temperature_k";
        let colour = self.optional(path, file.color_temperature_k, ranges::COLOR_TEMPERATURE_K);
        if model == Overcast {
            return Some(SkySpec::Overcast {
                brightness: brightness?,
                color_temperature_k: colour?,
                ground_albedo: ground_albedo?,
            });
        }
        let path = "lighting.sky.cie_type";
        let cie_type = self.required(path, file.cie_type, "type of the CIE standard general sky, 1 to 15");
        let cie_type = self.whole(path, cie_type?, ranges::CIE_TYPE)?;
        if !(sun || SUNLESS_TYPES.contains(&cie_type)) {
            let message = format!(
                "type {cie_type} is shaped by the sun: give lighting.sun (irradiance: 0 if it is hidden), or type 1, 3 or 5"
            );
            self.problem(path, message);
            return None;
        }
        Some(SkySpec::Cie {
            cie_type,
            brightness: brightness?,
            color_temperature_k: colour?,
            ground_albedo: ground_albedo?,
        })
    }

    fn brightness(&mut self, file: &SkyFile) -> Option<SkyBrightness> {
        let (zenith, horizontal) =
            ("lighting.sky.zenith_luminance_cd_m2", "lighting.sky.horizontal_illuminance_lx");
        match (file.zenith_luminance_cd_m2, file.horizontal_illuminance_lx) {
            (Some(luminance), None) => {
                self.range(zenith, luminance, ranges::SKY_CD_M2).map(SkyBrightness::Zenith)
            }
            (None, Some(illuminance)) => {
                self.range(horizontal, illuminance, ranges::SKY_LX).map(SkyBrightness::Horizontal)
            }
            (None, None) => {
                let why = "luminance of the zenith above 0 up to 1000000 cd/m²; or horizontal_illuminance_lx";
                self.required::<f64>(zenith, None, why);
                None
            }
            (Some(_), Some(_)) => {
                self.problem(
                    horizontal,
                    "not with lighting.sky.zenith_luminance_cd_m2: one follows from the other",
                );
                None
            }
        }
    }

    /// Keys that belong to another model.
    fn foreign_sky_keys(&mut self, file: &SkyFile, model: SkyModelName) {
        const SHAPED: &[SkyModelName] = &[Cie, Overcast];
        let keys: [(&str, bool, &[SkyModelName]); 7] = [
            ("cie_type", file.cie_type.is_some(), &[Cie]),
            ("zenith_luminance_cd_m2", file.zenith_luminance_cd_m2.is_some(), SHAPED),
            ("horizontal_illuminance_lx", file.horizontal_illuminance_lx.is_some(), SHAPED),
            ("color_temperature_k", file.color_temperature_k.is_some(), SHAPED),
            ("aerosol_optical_depth", file.aerosol_optical_depth.is_some(), &[Clear]),
            ("ozone_du", file.ozone_du.is_some(), &[Clear]),
            ("night_luminance_cd_m2", file.night_luminance_cd_m2.is_some(), &[Clear]),
        ];
        for (key, given, owners) in keys {
            if given && !owners.contains(&model) {
                let names: Vec<&str> = owners.iter().map(|owner| owner.name()).collect();
                self.belongs("lighting.sky", key, ("model", &names), model.name());
            }
        }
    }

    /// `clear` says whether the frame has a clear sky.
    pub(super) fn moon(&mut self, file: &MoonFile, clear: bool) -> Option<MoonSpec> {
        if !clear {
            self.problem(
                "lighting.moon",
                "needs lighting.sky: {model: clear}, which its light is scattered by",
            );
        }
        let path = "lighting.moon.elevation_deg";
        let elevation = self.required(path, file.elevation_deg, "degrees above the horizon, -90 to 90");
        let elevation = elevation.and_then(|elevation| self.range(path, elevation, ranges::ELEVATION_DEG));
        let path = "lighting.moon.azimuth_deg";
        let why = "heading towards the moon in degrees, 0 = -Z, 90 = +X";
        let azimuth = self.required(path, file.azimuth_deg, why);
        let azimuth = azimuth.and_then(|azimuth| self.range(path, azimuth, ranges::HEADING_DEG));
        let phase = file.phase_deg.unwrap_or(0.0);
        let phase = self.range("lighting.moon.phase_deg", phase, ranges::MOON_PHASE_DEG);
        let moon = MoonSpec { elevation_deg: elevation?, azimuth_deg: azimuth?, phase_deg: phase? };
        clear.then_some(moon)
    }
}
