//! Sky and moon of a frame: what `lighting.sky` and `lighting.moon` say, checked.

use serde::Serialize;

/// A sky over level ground, in absolute units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "model", rename_all = "snake_case")]
pub enum SkySpec {
    /// Clear air lit by the frame's sun and moon, before the night sky.
    Clear {
        /// Optical depth of the aerosol at 550 nm straight up, 0 to 1.
        aerosol_optical_depth: f64,
        /// Ozone in Dobson units, 0 to 600.
        ozone_du: f64,
        /// Luminance of stars and airglow in cd/m², 0 to 1.
        night_luminance_cd_m2: f64,
        /// Albedo of the level ground around the scene, 0 to 1.
        ground_albedo: f64,
    },
    /// A type of the CIE standard general sky; its shape takes the sun's place from the frame's sun.
    Cie {
        /// 1 to 15.
        cie_type: u32,
        /// How bright.
        #[serde(flatten)]
        brightness: SkyBrightness,
        /// Correlated colour temperature of daylight in K, 4000 to 25 000; absent: that of D65.
        color_temperature_k: Option<f64>,
        /// Albedo of the level ground around the scene, 0 to 1.
        ground_albedo: f64,
    },
    /// The CIE overcast sky.
    Overcast {
        /// How bright.
        #[serde(flatten)]
        brightness: SkyBrightness,
        /// Correlated colour temperature of daylight in K, 4000 to 25 000; absent: that of D65.
        color_temperature_k: Option<f64>,
        /// Albedo of the level ground around the scene, 0 to 1.
        ground_albedo: f64,
    },
}

/// Brightness of a sky whose shape is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum SkyBrightness {
    /// Luminance of the zenith in cd/m², above 0 up to 1e6.
    #[serde(rename = "zenith_luminance_cd_m2")]
    Zenith(f64),
    /// Illuminance of the sky on level ground in lx, above 0 up to 1e6.
    #[serde(rename = "horizontal_illuminance_lx")]
    Horizontal(f64),
}

impl SkySpec {
    /// True if the sky says how much light of sun and moon is left.
    #[must_use]
    pub fn is_clear(&self) -> bool {
        matches!(self, Self::Clear { .. })
    }
}

/// The moon of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MoonSpec {
    /// Above the horizon, in degrees, −90 to 90.
    pub elevation_deg: f64,
    /// Direction towards the moon as a heading, in degrees.
    pub azimuth_deg: f64,
    /// Phase angle in degrees: 0 (full) to 180 (new).
    pub phase_deg: f64,
}
