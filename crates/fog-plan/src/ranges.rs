//! Valid ranges of the numbers, said once: the checks, their messages and the JSON Schema read them here.

use crate::words::{short_number, unit_of};

/// An interval, closed above, and below unless `open`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    pub(crate) min: f64,
    pub(crate) max: f64,
    open: bool,
}

impl Range {
    const fn closed(min: f64, max: f64) -> Self {
        Self { min, max, open: false }
    }

    const fn above(min: f64, max: f64) -> Self {
        Self { min, max, open: true }
    }

    /// Whether `x` lies inside; never true for NaN.
    pub(crate) fn contains(self, x: f64) -> bool {
        x <= self.max && if self.open { x > self.min } else { x >= self.min }
    }

    /// The message about a value outside: `-5 m is out of range; valid: 1 to 5000 m`.
    pub(crate) fn message(self, key: &str, x: f64) -> String {
        let unit = unit_of(key).map(|(symbol, _)| format!(" {symbol}")).unwrap_or_default();
        let (min, max) = (short_number(self.min), short_number(self.max));
        let valid = if self.open { format!("above {min} up to {max}") } else { format!("{min} to {max}") };
        format!("{}{unit} is out of range; valid: {valid}{unit}", short_number(x))
    }
}

pub(crate) const LAYER_HEIGHT_M: Range = Range::closed(1.0, 5000.0);
pub(crate) const DENSITY_SCALE: Range = Range::above(0.0, 100.0);
pub(crate) const EFFECTIVE_RADIUS_UM: Range = Range::closed(0.01, 500.0);
pub(crate) const EFFECTIVE_VARIANCE: Range = Range::closed(0.001, 0.33);
pub(crate) const ALPHA: Range = Range::closed(0.0, 1000.0);
pub(crate) const B: Range = Range::closed(1e-20, 1e12);
pub(crate) const GAMMA: Range = Range::closed(0.25, 8.0);
pub(crate) const SHARE: Range = Range::above(0.0, 1e12);
pub(crate) const MEDIAN_DIAMETER_UM: Range = Range::closed(0.02, 500.0);
pub(crate) const GEOMETRIC_SD: Range = Range::closed(1.02, 4.0);
pub(crate) const NUMBER_DENSITY_1_M3: Range = Range::above(0.0, 1e15);
pub(crate) const THINNING: Range = Range::closed(0.1, 10.0);
pub(crate) const RELATIVE_ALTITUDE: Range = Range::closed(0.0, 1.0);
pub(crate) const RELATIVE_NUMBER: Range = Range::closed(0.0, 1e30);
pub(crate) const SIGMA_T_1_M: Range = Range::closed(0.0, 10.0);
pub(crate) const ALBEDO: Range = Range::closed(0.0, 1.0);
pub(crate) const HG_G: Range = Range::closed(-0.999, 0.999);
pub(crate) const FIT_DIAMETER_UM: Range = Range::above(0.0, 50.0);
pub(crate) const DENSITY_SD: Range = Range::closed(0.0, 2.0);
pub(crate) const TOP_SD_M: Range = Range::closed(0.0, 1000.0);
pub(crate) const PATCH_LENGTH_M: Range = Range::closed(1.0, 100_000.0);
pub(crate) const OCTAVES: Range = Range::closed(1.0, 8.0);
pub(crate) const MOR_M: Range = Range::closed(1.0, 100_000.0);
pub(crate) const VISIBILITY_ALTITUDE_M: Range = Range::closed(0.0, 5000.0);
pub(crate) const DATUM_M: Range = Range::closed(-500.0, 9000.0);
pub(crate) const CAMERA_ALTITUDE_M: Range = Range::closed(-500.0, 20_000.0);
pub(crate) const POSITION_M: Range = Range::closed(-1e7, 1e7);
pub(crate) const HEADING_DEG: Range = Range::closed(-360.0, 360.0);
pub(crate) const PITCH_DEG: Range = Range::closed(-90.0, 90.0);
pub(crate) const ROLL_DEG: Range = Range::closed(-180.0, 180.0);
pub(crate) const MOUNT_M: Range = Range::closed(-1000.0, 1000.0);
pub(crate) const TIME_S: Range = Range::closed(-1e9, 1e9);
pub(crate) const SPEED_M_S: Range = Range::above(0.0, 10_000.0);
pub(crate) const RATE_HZ: Range = Range::above(0.0, 10_000.0);
pub(crate) const READOUT_S: Range = Range::above(0.0, 1.0);
pub(crate) const EYE_HEIGHT_M: Range = Range::closed(0.0, 100.0);
pub(crate) const LANE_OFFSET_M: Range = Range::closed(-100.0, 100.0);
pub(crate) const POSES: Range = Range::closed(1.0, 1_000_000.0);
pub(crate) const GLIDE_ANGLE_DEG: Range = Range::closed(0.5, 20.0);
pub(crate) const ALONG_TRACK_M: Range = Range::above(0.0, 100_000.0);
pub(crate) const AIMING_POINT_M: Range = Range::closed(0.0, 2000.0);
pub(crate) const DEVIATION_DEG: Range = Range::closed(-20.0, 20.0);
pub(crate) const CRAB_DEG: Range = Range::closed(-45.0, 45.0);
pub(crate) const SPREAD_DEG: Range = Range::closed(0.0, 20.0);
pub(crate) const IMAGE_PX: Range = Range::closed(1.0, 16_384.0);
pub(crate) const FOV_DEG: Range = Range::closed(0.1, 170.0);
pub(crate) const WIDE_FOV_DEG: Range = Range::closed(0.1, 360.0);
pub(crate) const FOCAL_PX: Range = Range::above(0.0, 1e6);
pub(crate) const CENTRE_PX: Range = Range::closed(-1e6, 1e6);
pub(crate) const LENS_COEFFICIENT: Range = Range::closed(-1e6, 1e6);
pub(crate) const LATITUDE_DEG: Range = Range::closed(-90.0, 90.0);
pub(crate) const EXPOSURE: Range = Range::above(0.0, 1e9);
pub(crate) const PERCENTILE: Range = Range::closed(0.0, 1.0);
pub(crate) const TARGET: Range = Range::above(0.0, 1e6);
pub(crate) const ISO: Range = Range::closed(1.0, 1e7);
pub(crate) const SHUTTER_S: Range = Range::closed(1e-6, 3600.0);
pub(crate) const F_NUMBER: Range = Range::closed(0.5, 128.0);
pub(crate) const LENS_TRANSMISSION: Range = Range::above(0.0, 1.0);
pub(crate) const ADC_BITS: Range = Range::closed(6.0, 16.0);
pub(crate) const BLACK_LEVEL: Range = Range::closed(0.0, 32_767.0);
pub(crate) const FULL_WELL_E: Range = Range::closed(100.0, 1e7);
pub(crate) const READ_NOISE_E: Range = Range::closed(0.0, 1e4);
pub(crate) const PRNU: Range = Range::closed(0.0, 0.5);
pub(crate) const DSNU_E: Range = Range::closed(0.0, 1e4);
pub(crate) const DARK_CURRENT_E_S: Range = Range::closed(0.0, 1e6);
pub(crate) const GAIN: Range = Range::closed(0.01, 1e4);
pub(crate) const PIXEL_UM: Range = Range::closed(0.5, 50.0);
pub(crate) const QUANTUM_EFFICIENCY: Range = Range::above(0.0, 1.0);
pub(crate) const GAUSSIAN_PX: Range = Range::closed(0.05, 16.0);
pub(crate) const VIGNETTING: Range = Range::closed(-10.0, 10.0);
pub(crate) const RADIANCE: Range = Range::closed(0.0, 1e12);
pub(crate) const INTENSITY: Range = Range::closed(0.0, 1e6);
pub(crate) const SCALE: Range = Range::above(0.0, 1e12);
pub(crate) const SKY_CD_M2: Range = Range::above(0.0, 1e6);
pub(crate) const SKY_LX: Range = Range::above(0.0, 1e6);
pub(crate) const NIGHT_CD_M2: Range = Range::closed(0.0, 1.0);
pub(crate) const COLOR_TEMPERATURE_K: Range = Range::closed(4000.0, 25_000.0);
pub(crate) const AEROSOL_DEPTH: Range = Range::closed(0.0, 1.0);
pub(crate) const OZONE_DU: Range = Range::closed(0.0, 600.0);
pub(crate) const CIE_TYPE: Range = Range::closed(1.0, 15.0);
pub(crate) const MOON_PHASE_DEG: Range = Range::closed(0.0, 180.0);
pub(crate) const LUMINANCE_CD_M2: Range = Range::closed(1e-6, 1e9);
pub(crate) const ELEVATION_DEG: Range = Range::closed(-90.0, 90.0);
pub(crate) const SUN_DIAMETER_DEG: Range = Range::closed(0.0, 10.0);
pub(crate) const URBAN_LENGTH_M: Range = Range::closed(80.0, 600.0);
pub(crate) const HIGHWAY_LENGTH_M: Range = Range::closed(200.0, 5000.0);
pub(crate) const RUNWAY_LENGTH_M: Range = Range::closed(1200.0, 5000.0);
pub(crate) const FULLNESS: Range = Range::closed(0.0, 1.0);
pub(crate) const SPEED_LIMIT: Range = Range::closed(5.0, 130.0);
pub(crate) const GANTRIES_M: Range = Range::closed(100.0, 5000.0);
pub(crate) const PAPI_DEG: Range = Range::closed(2.0, 5.0);
pub(crate) const LIGHTS_PERCENT: Range = Range::closed(0.01, 100.0);
pub(crate) const BOARD_M: Range = Range::closed(1.0, 1000.0);
pub(crate) const BLACK_M: Range = Range::closed(5.0, 20_000.0);
pub(crate) const BLACK_DEG: Range = Range::closed(0.1, 4.0);
pub(crate) const EYE_M: Range = Range::closed(0.5, 100.0);
pub(crate) const SITE_LENGTH_M: Range = Range::closed(100.0, 10_000.0);
pub(crate) const SITE_WIDTH_M: Range = Range::closed(5.0, 200.0);
pub(crate) const GLIDE_SLOPE_DEG: Range = Range::closed(1.0, 10.0);
pub(crate) const TOUCHDOWN_M: Range = Range::closed(0.0, 2000.0);
pub(crate) const BACKGROUND_CD_M2: Range = Range::closed(0.0, 1e6);
pub(crate) const WAVELENGTH_NM: Range = Range::closed(380.0, 780.0);
pub(crate) const SAMPLES: Range = Range::closed(1.0, 1_000_000.0);
pub(crate) const NOISE: Range = Range::above(0.0, 1.0);
pub(crate) const CONTRAST: Range = Range::closed(0.001, 1.0);
pub(crate) const MIN_PIXELS: Range = Range::closed(1.0, 1_000_000.0);
pub(crate) const MAX_DEPTH: Range = Range::closed(1.0, 1_000_000.0);
pub(crate) const COUNT: Range = Range::closed(1.0, 100_000_000.0);
