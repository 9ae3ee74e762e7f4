//! A runway as LARD measures it.

use std::collections::BTreeMap;

use fog_core::DVec3;
use fog_core::math::f64::atan2;
use serde_json::Value;

use super::Edition;
use crate::camera::vector;

const METRES_PER_NM: f64 = 1852.0;
const FEET_PER_METRE: f64 = 3.280_84;
/// Where lateral path angles are seen from in the first edition: beyond the threshold, m. In the second it is the threshold.
const LATERAL_REFERENCE_M: f64 = 3050.0;
/// Where vertical path angles are seen from: beyond the threshold, m.
const VERTICAL_REFERENCE_M: f64 = 305.0;
/// Names of the keypoints: far right, far left, near left, near right, LARD's TR, TL, BL, BR.
const CORNERS: [&str; 4] = ["end_right", "end_left", "threshold_left", "threshold_right"];

/// A runway's corners in the world (+Y up, −Z north), in the order of [`CORNERS`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Runway([DVec3; 4]);

/// A runway in a picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Seen {
    pub(super) runway: Runway,
    /// The camera in the world.
    pub(super) eye: DVec3,
    /// The corners from the image's corner, px.
    points: [[f64; 2]; 4],
}

/// Position relative to the runway.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Measures {
    pub(super) slant_nm: f64,
    pub(super) along_track_nm: f64,
    pub(super) height_ft: f64,
    pub(super) lateral_deg: f64,
    pub(super) vertical_deg: f64,
}

impl Runway {
    /// The runway that a thing is, if it has the keypoints of one.
    pub(super) fn of(object: &Value) -> Option<Self> {
        let mut corners = [DVec3::ZERO; 4];
        for (corner, name) in corners.iter_mut().zip(CORNERS) {
            *corner = vector(&keypoint(object, name)?["world_m"])?;
        }
        Some(Self(corners))
    }

    fn threshold(&self) -> DVec3 {
        0.5 * (self.0[2] + self.0[3])
    }

    /// Unit vectors along the runway, to its right, and up from its plane.
    fn axes(&self) -> [DVec3; 3] {
        let along = (0.5 * (self.0[0] + self.0[1]) - self.threshold()).normalize_or(DVec3::NEG_Z);
        let across = (self.0[3] - self.threshold()).normalize_or(DVec3::X);
        let up = across.cross(along).normalize_or(DVec3::Y);
        [along, along.cross(up), up]
    }

    /// Its number by its direction: two digits, 01 to 36.
    pub(super) fn number(&self) -> String {
        let [along, ..] = self.axes();
        let heading = atan2(along.x, -along.z).to_degrees().rem_euclid(360.0);
        let tens = (heading / 10.0).round() as u32 % 36;
        format!("{:02}", if tens == 0 { 36 } else { tens })
    }
}

impl Seen {
    /// The runway's place in the picture; `None` if a corner has none.
    pub(super) fn of(runway: Runway, object: &Value, eye: DVec3) -> Option<Self> {
        let mut points = [[0.0; 2]; 4];
        for (point, name) in points.iter_mut().zip(CORNERS) {
            let image = &keypoint(object, name)?["image_px"];
            *point = [image[0].as_f64()?, image[1].as_f64()?];
        }
        Some(Self { runway, eye, points })
    }

    /// Whether all corners are in the image.
    pub(super) fn is_whole(&self, [width, height]: [u32; 2]) -> bool {
        let inside =
            |[x, y]: &[f64; 2]| (0.0..=f64::from(width)).contains(x) && (0.0..=f64::from(height)).contains(y);
        self.points.iter().all(inside)
    }

    /// The corners by column.
    pub(super) fn corners(&self, edition: Edition, width: f64) -> BTreeMap<String, f64> {
        let mut points = self.points;
        if edition == Edition::V1 {
            points.sort_by(|a, b| (a[1] * width + a[0]).total_cmp(&(b[1] * width + b[0])));
        }
        let both = |(name, [x, y]): (&str, [f64; 2])| [(format!("x_{name}"), x), (format!("y_{name}"), y)];
        edition.corners().into_iter().zip(points).flat_map(both).collect()
    }

    /// Distances and angles by the definitions of the edition's code.
    pub(super) fn measures(&self, edition: Edition) -> Measures {
        let [along, right, up] = self.runway.axes();
        let from = self.eye - self.runway.threshold();
        let (before, cross, height) = (-from.dot(along), from.dot(right), from.dot(up));
        let to_reference = before + VERTICAL_REFERENCE_M;
        let degrees = |y: f64, x: f64| atan2(y, x).to_degrees();
        let (along_track_m, height_m, lateral_deg, vertical_deg) = match edition {
            // In the plane through the axis; the distance is negative beyond the threshold.
            Edition::V1 => (
                before,
                height.abs(),
                degrees(cross, before + LATERAL_REFERENCE_M),
                degrees(height.abs(), to_reference),
            ),
            // Against the runway's plane, from wherever the eye is.
            Edition::V2 => {
                (before.abs(), from.y, degrees(cross, before), degrees(height, to_reference.hypot(cross)))
            }
        };
        Measures {
            slant_nm: from.length() / METRES_PER_NM,
            along_track_nm: along_track_m / METRES_PER_NM,
            height_ft: height_m * FEET_PER_METRE,
            lateral_deg,
            vertical_deg,
        }
    }
}

fn keypoint<'v>(object: &'v Value, name: &str) -> Option<&'v Value> {
    object["keypoints"].as_array()?.iter().find(|point| point["name"] == name)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn an_approach_to_the_east_is_measured() {
        // Threshold at the origin, 1000 m to the east, 40 m wide; right is south.
        let corner = |name: &str, world: [f64; 3], image: [f64; 2]| json!({"name": name, "world_m": world, "image_px": image});
        let object = json!({"keypoints": [
            corner("end_right", [1000.0, 0.0, 20.0], [52.0, 30.0]),
            corner("end_left", [1000.0, 0.0, -20.0], [48.0, 30.0]),
            corner("threshold_left", [0.0, 0.0, -20.0], [30.0, 60.0]),
            corner("threshold_right", [0.0, 0.0, 20.0], [70.0, 61.0]),
        ]});
        let runway = Runway::of(&object).expect("a runway");
        assert_eq!(runway.number(), "09");
        let seen = Seen::of(runway, &object, DVec3::new(-1852.0, 100.0, 50.0)).expect("seen");
        assert!(seen.is_whole([100, 61]) && !seen.is_whole([100, 60]));
        let (one, two) = (seen.corners(Edition::V1, 100.0), seen.corners(Edition::V2, 100.0));
        assert_eq!((one["x_A"], one["x_B"], one["x_C"], one["y_D"]), (48.0, 52.0, 30.0, 61.0));
        assert_eq!((two["x_TR"], two["x_TL"], two["x_BL"], two["y_BR"]), (52.0, 48.0, 30.0, 61.0));
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
        for (edition, lateral, vertical) in [
            (Edition::V1, atan2(50.0, 4902.0), atan2(100.0, 2157.0)),
            (Edition::V2, atan2(50.0, 1852.0), atan2(100.0, 2157f64.hypot(50.0))),
        ] {
            let found = seen.measures(edition);
            near(found.slant_nm, (1852f64.powi(2) + 100f64.powi(2) + 50f64.powi(2)).sqrt() / 1852.0);
            near(found.along_track_nm, 1.0);
            near(found.height_ft, 328.084);
            near(found.lateral_deg, lateral.to_degrees());
            near(found.vertical_deg, vertical.to_degrees());
        }
    }
}
