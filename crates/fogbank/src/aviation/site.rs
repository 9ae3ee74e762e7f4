//! A runway's place and size.

use fog_core::DVec3;
use fog_core::math::f64::{atan2, cos, sin};
use fog_optics::visibility::rvr::ASSESSMENT_HEIGHT_M;
use fog_plan::RunwaySpec;
use serde::Serialize;
use serde_json::Value;

/// Glide path of a runway that does not say, in degrees.
const GLIDE_SLOPE_DEG: f64 = 3.0;
/// Distance of the aiming point from the threshold of a runway that does not say, in m: 1020 ft (FAA AC 150/5340-1).
const TOUCHDOWN_M: f64 = 310.896;

/// A runway as one lands on it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunwaySite {
    /// Middle of the threshold in world coordinates, m.
    pub threshold_m: [f64; 3],
    /// Direction of landing, clockwise from −Z (north) seen from above, in degrees, 0 to 360.
    pub heading_deg: f64,
    /// Length in m.
    pub length_m: f64,
    /// Width in m.
    pub width_m: f64,
    /// Angle of the glide path in degrees.
    pub glide_slope_deg: f64,
    /// Distance of the aiming point, where the glide path meets the runway, beyond the threshold in m.
    pub touchdown_m: f64,
}

impl RunwaySite {
    /// From the configuration, and for what it leaves open from `extras.runway` of the scene; `None` if the place is in neither.
    pub(crate) fn new(spec: Option<&RunwaySpec>, extras: &Value) -> Option<Self> {
        let of_scene = Self::of_scene(&extras["runway"]);
        let Some(spec) = spec else { return of_scene };
        let base = of_scene.as_ref();
        Some(Self {
            threshold_m: spec.threshold_m.or(base.map(|b| b.threshold_m))?,
            heading_deg: spec.heading_deg.map(|deg| deg.rem_euclid(360.0)).or(base.map(|b| b.heading_deg))?,
            length_m: spec.length_m.or(base.map(|b| b.length_m))?,
            width_m: spec.width_m.or(base.map(|b| b.width_m))?,
            glide_slope_deg: spec
                .glide_slope_deg
                .or(base.map(|b| b.glide_slope_deg))
                .unwrap_or(GLIDE_SLOPE_DEG),
            touchdown_m: spec.touchdown_m.or(base.map(|b| b.touchdown_m)).unwrap_or(TOUCHDOWN_M),
        })
    }

    /// From the `extras` that `fogbank scene runway` writes; `None` if they are not such.
    fn of_scene(runway: &Value) -> Option<Self> {
        let point = |value: &Value| -> Option<DVec3> {
            let c = |i: usize| value[i].as_f64().filter(|x| x.abs() < 1e7);
            Some(DVec3::new(c(0)?, c(1)?, c(2)?))
        };
        let corners = |key: &str| Some([point(&runway[key][0])?, point(&runway[key][1])?]);
        let [left, right] = corners("threshold_corners_m")?;
        let [far_left, far_right] = corners("end_corners_m")?;
        let (threshold, end) = (0.5 * (left + right), 0.5 * (far_left + far_right));
        let way = end - threshold;
        let length_m = way.x.hypot(way.z);
        let heading = atan2(way.x, -way.z).to_degrees().rem_euclid(360.0);
        let aim =
            point(&runway["aiming_point_m"]).map(|aim| (aim.x - threshold.x).hypot(aim.z - threshold.z));
        (length_m > 1.0).then(|| Self {
            threshold_m: threshold.to_array(),
            heading_deg: heading,
            length_m,
            width_m: (right - left).length(),
            glide_slope_deg: runway["glide_path_deg"].as_f64().unwrap_or(GLIDE_SLOPE_DEG),
            touchdown_m: aim.unwrap_or(TOUCHDOWN_M),
        })
    }

    /// Unit vector of the direction of landing, level.
    pub(crate) fn forward(&self) -> DVec3 {
        let heading = self.heading_deg.to_radians();
        DVec3::new(sin(heading), 0.0, -cos(heading))
    }

    /// Unit vector to the right of it.
    pub(crate) fn right(&self) -> DVec3 {
        let forward = self.forward();
        DVec3::new(-forward.z, 0.0, forward.x)
    }

    pub(crate) fn threshold(&self) -> DVec3 {
        DVec3::from_array(self.threshold_m)
    }

    /// The aiming point.
    pub(crate) fn aim(&self) -> DVec3 {
        self.threshold() + self.forward() * self.touchdown_m
    }

    /// Distance before the threshold along the runway's axis in m: negative beyond it.
    pub(crate) fn before(&self, point: DVec3) -> f64 {
        -(point - self.threshold()).dot(self.forward())
    }

    /// World height where extinction is assessed.
    pub(crate) fn assessment_y(&self) -> f64 {
        self.threshold_m[1] + ASSESSMENT_HEIGHT_M
    }
}
