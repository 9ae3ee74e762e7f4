//! Checks of `lighting`.

use super::Check;
use crate::{
    frame::{EnvironmentSpec, LightingSpec, SunSpec},
    ranges,
    schema::{
        EnvironmentFile, LUMINANCE_OF_ONE_CD_M2, LightingFile, LightingMap, Preset, SkyModelName, SunFile,
    },
};

impl Check<'_> {
    /// `rendered_nm` is the frame's only wavelength, if it has one.
    pub(super) fn lighting(
        &mut self,
        lighting: &LightingFile,
        rendered_nm: Option<f64>,
    ) -> Option<LightingSpec> {
        // Names have become maps; one that is left stands for a section that is a problem already.
        let LightingFile::Map(map) = lighting else { return None };
        let LightingMap {
            preset,
            clear,
            environment,
            sky,
            sun,
            moon,
            scene_emitters,
            luminance_of_one_cd_m2,
            groups,
        } = &**map;
        if clear.is_some() && preset.is_some() {
            self.problem(
                "lighting.clear",
                "not beside lighting.preset, which is a whole lighting of its own",
            );
        }
        if sky.is_some() && environment.is_some() {
            self.problem("lighting.environment", "not with lighting.sky, which surrounds the scene too");
        }
        let has_sun = sun.is_some();
        let clear = sky.as_ref().is_some_and(|sky| sky.model == Some(SkyModelName::Clear));
        let environment =
            environment.as_ref().map_or(Some(None), |e| self.environment(e, rendered_nm).map(Some));
        let sky = sky.as_ref().map_or(Some(None), |sky| self.sky(sky, has_sun).map(Some));
        let sun = sun.as_ref().map_or(Some(None), |sun| self.sun(sun, clear, rendered_nm).map(Some));
        let moon = moon.as_ref().map_or(Some(None), |moon| self.moon(moon, clear).map(Some));
        let path = "lighting.luminance_of_one_cd_m2";
        let luminance = self.optional(path, *luminance_of_one_cd_m2, ranges::LUMINANCE_CD_M2);
        let groups = self.light_groups(groups);
        Some(LightingSpec {
            preset: preset.map(Preset::name),
            environment: environment?,
            sky: sky?,
            sun: sun?,
            moon: moon?,
            scene_emitters: *scene_emitters,
            luminance_of_one_cd_m2: luminance?.unwrap_or(LUMINANCE_OF_ONE_CD_M2),
            groups: groups?,
        })
    }

    fn environment(&mut self, file: &EnvironmentFile, rendered_nm: Option<f64>) -> Option<EnvironmentSpec> {
        if let Some(image) = &file.image {
            return self.environment_image(file, image);
        }
        for (key, value) in [("scale", file.scale), ("rotation_deg", file.rotation_deg)] {
            if value.is_some() {
                self.problem(&format!("lighting.environment.{key}"), "only with lighting.environment.image");
            }
        }
        let path = "lighting.environment.radiance";
        let why = "radiance of the surroundings, 0 or more; or image, the path of an equirectangular image";
        let radiance = self.required(path, file.radiance, why);
        let radiance = radiance.and_then(|radiance| self.range(path, radiance, ranges::RADIANCE));
        let path = "lighting.environment.wavelength_nm";
        let wavelength = self.wavelength(path, file.wavelength_nm, rendered_nm);
        Some(EnvironmentSpec::Uniform { radiance: radiance?, wavelength_nm: wavelength? })
    }

    fn environment_image(&mut self, file: &EnvironmentFile, image: &str) -> Option<EnvironmentSpec> {
        let mut alone = true;
        for (key, value) in [("radiance", file.radiance), ("wavelength_nm", file.wavelength_nm)] {
            if value.is_some() {
                let message = "not with lighting.environment.image, which says the radiance";
                self.problem(&format!("lighting.environment.{key}"), message);
                alone = false;
            }
        }
        if image.is_empty() {
            self.problem("lighting.environment.image", "empty; the path of an equirectangular image");
            return None;
        }
        let scale = self.optional("lighting.environment.scale", file.scale, ranges::SCALE);
        let rotation =
            self.optional("lighting.environment.rotation_deg", file.rotation_deg, ranges::HEADING_DEG);
        let (scale, rotation) = (scale?.unwrap_or(1.0), rotation?.unwrap_or(0.0));
        alone.then(|| EnvironmentSpec::Image { image: image.into(), scale, rotation_deg: rotation })
    }

    /// `clear` says whether the frame has a clear sky, whose air says how much of the sun's light is left.
    fn sun(&mut self, file: &SunFile, clear: bool, rendered_nm: Option<f64>) -> Option<SunSpec> {
        let path = "lighting.sun.elevation_deg";
        let elevation = self.required(path, file.elevation_deg, "degrees above the horizon, -90 to 90");
        let elevation = elevation.and_then(|elevation| self.range(path, elevation, ranges::ELEVATION_DEG));
        let path = "lighting.sun.azimuth_deg";
        let azimuth =
            self.required(path, file.azimuth_deg, "heading towards the sun in degrees, 0 = -Z, 90 = +X");
        let azimuth = azimuth.and_then(|azimuth| self.range(path, azimuth, ranges::HEADING_DEG));
        let irradiance = self.sun_irradiance(file, clear);
        let path = "lighting.sun.color_temperature_k";
        let colour = self.optional(path, file.color_temperature_k, ranges::COLOR_TEMPERATURE_K);
        if file.color_temperature_k.is_some() && file.wavelength_nm.is_some() {
            self.problem(
                path,
                "not with lighting.sun.wavelength_nm: light of one wavelength has no other colour",
            );
        }
        let path = "lighting.sun.angular_diameter_deg";
        let diameter = self.range(path, file.angular_diameter_deg, ranges::SUN_DIAMETER_DEG);
        let wavelength = self.wavelength("lighting.sun.wavelength_nm", file.wavelength_nm, rendered_nm);
        Some(SunSpec {
            elevation_deg: elevation?,
            azimuth_deg: azimuth?,
            irradiance: irradiance?,
            color_temperature_k: colour?,
            angular_diameter_deg: diameter?,
            wavelength_nm: wavelength?,
        })
    }

    fn sun_irradiance(&mut self, file: &SunFile, clear: bool) -> Option<Option<f64>> {
        let path = "lighting.sun.irradiance";
        if !clear {
            let why = "irradiance on a plane normal to the beam, 0 or more";
            let irradiance = self.required(path, file.irradiance, why)?;
            return self.range(path, irradiance, ranges::RADIANCE).map(Some);
        }
        let given = [
            ("irradiance", file.irradiance.is_some()),
            ("color_temperature_k", file.color_temperature_k.is_some()),
            ("wavelength_nm", file.wavelength_nm.is_some()),
        ];
        let mut none = true;
        for (key, _) in given.into_iter().filter(|(_, given)| *given) {
            let message =
                "not with a clear sky (lighting.sky), whose air says what is left of the sun's light";
            self.problem(&format!("lighting.sun.{key}"), message);
            none = false;
        }
        none.then_some(None)
    }

    /// A light given at one wavelength has no meaning at any other.
    fn wavelength(
        &mut self,
        path: &str,
        light_nm: Option<f64>,
        rendered_nm: Option<f64>,
    ) -> Option<Option<f64>> {
        let Some(light) = self.optional(path, light_nm, ranges::WAVELENGTH_NM)? else { return Some(None) };
        if rendered_nm == Some(light) {
            return Some(Some(light));
        }
        let rendered = match rendered_nm {
            None => "is absent (the whole visible spectrum is rendered)".to_owned(),
            Some(nm) => format!("is {nm} nm"),
        };
        let rule = "a light given at one wavelength needs render.wavelength_nm to be the same";
        self.problem(path, format!("{light} nm, but render.wavelength_nm {rendered}; {rule}"));
        None
    }
}
