//! Section `lighting`.

use std::fmt;

use schemars::JsonSchema;
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{Error, IntoDeserializer, MapAccess, Visitor, value::MapAccessDeserializer},
};

use super::sky::{MoonFile, SkyFile};
use crate::ranges;

/// A preset or a map.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[schemars(rename = "Lighting")]
pub(crate) enum LightingFile {
    /// A preset by name.
    Preset(Preset),
    /// Light sources one by one.
    Map(Box<LightingMap>),
}

impl Default for LightingFile {
    fn default() -> Self {
        Self::Preset(Preset::Day)
    }
}

/// Ready-made lighting: the files of `configs/lighting`.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Preset {
    /// The same radiance 1 from every direction; the scene's lights off.
    Day,
    /// A thick cloud cover at noon, without shadows; the scene's lights off.
    Overcast,
    /// Sun and clear sky, the sun 30° high; the scene's lights off.
    Clear,
    /// Clear sky at the end of civil twilight; the scene's lights on.
    Dusk,
    /// Only the scene's lights, in its own units.
    Night,
    /// Weak sky and a sun 35° high in the south-east; the scene's lights off.
    Sunny,
    /// A street at night, under the glow of a town; the scene's lights on.
    NightStreet,
    /// A runway on a moonless night; the scene's lights on.
    NightRunway,
    /// A night without street lamps: of the scene's lights those of vehicles alone.
    Headlamps,
}

impl Preset {
    /// All of them.
    pub(crate) const ALL: [Self; 9] = [
        Self::Day,
        Self::Overcast,
        Self::Clear,
        Self::Dusk,
        Self::Night,
        Self::Sunny,
        Self::NightStreet,
        Self::NightRunway,
        Self::Headlamps,
    ];

    /// Its name and its file, as text.
    const fn source(self) -> (&'static str, &'static str) {
        match self {
            Self::Day => ("day", include_str!("../../../../configs/lighting/day.yaml")),
            Self::Overcast => ("overcast", include_str!("../../../../configs/lighting/overcast.yaml")),
            Self::Clear => ("clear", include_str!("../../../../configs/lighting/clear.yaml")),
            Self::Dusk => ("dusk", include_str!("../../../../configs/lighting/dusk.yaml")),
            Self::Night => ("night", include_str!("../../../../configs/lighting/night.yaml")),
            Self::Sunny => ("sunny", include_str!("../../../../configs/lighting/sunny.yaml")),
            Self::NightStreet => {
                ("night_street", include_str!("../../../../configs/lighting/night_street.yaml"))
            }
            Self::NightRunway => {
                ("night_runway", include_str!("../../../../configs/lighting/night_runway.yaml"))
            }
            Self::Headlamps => ("headlamps", include_str!("../../../../configs/lighting/headlamps.yaml")),
        }
    }

    /// The name in configurations.
    pub(crate) const fn name(self) -> &'static str {
        self.source().0
    }

    /// The file that says what it is.
    pub(crate) const fn yaml(self) -> &'static str {
        self.source().1
    }
}

/// Light sources.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct LightingMap {
    /// A preset that the other keys are laid over. Absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) preset: Option<Preset>,
    /// A clear sky with the sun so high: short for the preset `clear` with these keys of `sun`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) clear: Option<ClearFile>,
    /// Light from every direction. Absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) environment: Option<EnvironmentFile>,
    /// A sky with structure and its ground, in place of `environment`. Absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sky: Option<SkyFile>,
    /// The sun. Absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sun: Option<SunFile>,
    /// The moon, under a clear sky. Absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) moon: Option<MoonFile>,
    /// Whether the scene file's emitting surfaces and lights shine.
    pub(crate) scene_emitters: bool,
    /// Luminance in cd/m² that the radiance 1 stands for: emission (cd/m²), lamps (cd) and directional lights (lx) of the
    /// scene file, and the light of `sky`, are divided by it.
    #[schemars(range(min = ranges::LUMINANCE_CD_M2.min, max = ranges::LUMINANCE_CD_M2.max))]
    /// Absent: 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) luminance_of_one_cd_m2: Option<f64>,
    /// Groups of lights: the light of each is one more layer of the radiance, and those of all lights that belong to no group
    /// one more, `rest`; they add up to the image. A light belongs to the first group that names it.
    #[schemars(length(max = 32))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) groups: Vec<LightGroupFile>,
}

/// The sun of a clear sky.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Clear")]
pub(crate) struct ClearFile {
    /// Height of the sun above the horizon, in degrees.
    #[schemars(range(min = ranges::ELEVATION_DEG.min, max = ranges::ELEVATION_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sun_elevation_deg: Option<f64>,
    /// Direction towards the sun as a heading, in degrees.
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sun_azimuth_deg: Option<f64>,
}

/// A group of lights.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "LightGroup", extend("required" = ["name", "lights"]))]
pub(crate) struct LightGroupFile {
    /// Name of the layer: letters, digits, `_` and `-`.
    #[schemars(required, length(min = 1, max = 32), regex(pattern = "^[A-Za-z0-9_-]+$"))]
    pub(crate) name: Option<String>,
    /// Its lights: `environment`, `sun`, `lamps` (all points and spots of the scene file), `directional`, `emitters`,
    /// `node:NAME` (lights and emitting surfaces of nodes), `material:NAME` (emitting surfaces); in a name, `*` stands for any
    /// text.
    #[schemars(required, length(min = 1))]
    pub(crate) lights: Option<Vec<String>>,
    /// Factor on the light of all of them. Absent: 1.
    #[schemars(range(min = ranges::INTENSITY.min, max = ranges::INTENSITY.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) intensity: Option<f64>,
}

impl Default for LightingMap {
    fn default() -> Self {
        Self {
            preset: None,
            clear: None,
            environment: None,
            sky: None,
            sun: None,
            moon: None,
            scene_emitters: true,
            luminance_of_one_cd_m2: None,
            groups: Vec::new(),
        }
    }
}

/// Uniform light from every direction, or that of an image.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Environment")]
pub(crate) struct EnvironmentFile {
    /// Radiance with the spectrum of D65, recorded as R = G = B = this value; with wavelength_nm the spectral radiance
    /// there.
    #[schemars(range(min = ranges::RADIANCE.min, max = ranges::RADIANCE.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) radiance: Option<f64>,
    /// In place of `radiance`: an image of the whole sphere (equirectangular; OpenEXR, Radiance HDR, PNG or JPEG), relative to
    /// the current folder. Its centre shows north (−Z), headings grow to the right, its top is the zenith. Its values are
    /// radiance in linear sRGB.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) image: Option<String>,
    /// Factor on the values of `image`. Absent: 1.
    #[schemars(range(min = ranges::SCALE.min, max = ranges::SCALE.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) scale: Option<f64>,
    /// Heading in degrees that the centre of `image` shows. Absent: 0.
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) rotation_deg: Option<f64>,
    /// The wavelength that `radiance` is meant at, in nanometres: equal to render.wavelength_nm.
    #[schemars(range(min = ranges::WAVELENGTH_NM.min, max = ranges::WAVELENGTH_NM.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) wavelength_nm: Option<f64>,
}

/// A disc in the sky.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Sun")]
pub(crate) struct SunFile {
    /// Above the horizon, in degrees.
    #[schemars(range(min = ranges::ELEVATION_DEG.min, max = ranges::ELEVATION_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) elevation_deg: Option<f64>,
    /// Direction towards the sun as a heading, in degrees: 0 is north (−Z), 90 is east (+X).
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) azimuth_deg: Option<f64>,
    /// Irradiance on a plane normal to the beam, with the spectrum of D65, recorded as R = G = B = this value; with
    /// wavelength_nm the spectral irradiance there. Not with a clear sky, which says what is left of the sun's light.
    #[schemars(range(min = ranges::RADIANCE.min, max = ranges::RADIANCE.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) irradiance: Option<f64>,
    /// Correlated colour temperature of daylight in kelvins, the irradiance's luminance kept. Absent: that of D65.
    #[schemars(range(min = ranges::COLOR_TEMPERATURE_K.min, max = ranges::COLOR_TEMPERATURE_K.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) color_temperature_k: Option<f64>,
    /// Angular diameter in degrees; 0 is a parallel beam.
    #[schemars(range(min = ranges::SUN_DIAMETER_DEG.min, max = ranges::SUN_DIAMETER_DEG.max))]
    pub(crate) angular_diameter_deg: f64,
    /// The wavelength that `irradiance` is meant at, in nanometres: equal to render.wavelength_nm.
    #[schemars(range(min = ranges::WAVELENGTH_NM.min, max = ranges::WAVELENGTH_NM.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) wavelength_nm: Option<f64>,
}

/// Luminance of the radiance 1 unless said otherwise: glTF's own units are taken as they are.
pub(crate) const LUMINANCE_OF_ONE_CD_M2: f64 = 1.0;

/// Mean angular diameter of the sun in degrees.
pub(crate) const SUN_DIAMETER_DEG: f64 = 0.533;

impl Default for SunFile {
    fn default() -> Self {
        Self {
            elevation_deg: None,
            azimuth_deg: None,
            irradiance: None,
            color_temperature_k: None,
            angular_diameter_deg: SUN_DIAMETER_DEG,
            wavelength_nm: None,
        }
    }
}

impl<'de> Deserialize<'de> for LightingFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LightingVisitor)
    }
}

struct LightingVisitor;

impl<'de> Visitor<'de> for LightingVisitor {
    type Value = LightingFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let presets = Preset::ALL.map(Preset::name).join(", ");
        write!(
            f,
            "a preset ({presets}) or a map with keys preset, clear, environment, sky, sun, moon, scene_emitters, \
             luminance_of_one_cd_m2, groups"
        )
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<LightingFile, E> {
        Preset::deserialize(text.into_deserializer()).map(LightingFile::Preset)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<LightingFile, A::Error> {
        LightingMap::deserialize(MapAccessDeserializer::new(map)).map(|map| LightingFile::Map(Box::new(map)))
    }
}
