//! How a body is turned, in f64: aviation angles, quaternions, one rotation after another, and motion between two.
//!
//! A body has OpenCV's camera axes: x right, y down, z forward. The world is right-handed with +Y up.

use crate::math;
use glam::{DMat3, DVec3};

/// World from body: the columns are the body's right, down and forward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude(DMat3);

impl Attitude {
    /// From angles in degrees: heading clockwise seen from above (0 = −Z, 90 = +X), pitch up, roll to the right.
    #[must_use]
    pub fn from_angles_deg([heading, pitch, roll]: [f64; 3]) -> Self {
        let sin_cos = |deg: f64| (math::f64::sin(deg.to_radians()), math::f64::cos(deg.to_radians()));
        let ((sh, ch), (sp, cp), (sr, cr)) = (sin_cos(heading), sin_cos(pitch), sin_cos(roll));
        let (level, right) = (DVec3::new(sh, 0.0, -ch), DVec3::new(ch, 0.0, sh));
        let (forward, up) = (cp * level + sp * DVec3::Y, cp * DVec3::Y - sp * level);
        Self(DMat3::from_cols(cr * right - sr * up, -(cr * up + sr * right), forward))
    }

    /// Heading (−180 to 180), pitch and roll in degrees, to 1e-12; the inverse of [`Attitude::from_angles_deg`]. Straight up or
    /// down roll is 0.
    #[must_use]
    pub fn angles_deg(&self) -> [f64; 3] {
        let (right, forward) = (self.0.x_axis, self.0.z_axis);
        let level = (forward.x * forward.x + forward.z * forward.z).sqrt();
        let vertical = level < 1e-12;
        // Looking straight up or down, the heading is that of the right hand's side less 90 degrees.
        let heading = if vertical {
            math::f64::atan2(right.z, right.x)
        } else {
            math::f64::atan2(forward.x, -forward.z)
        };
        let pitch = math::f64::atan2(forward.y, level);
        let (sh, ch) = (math::f64::sin(heading), math::f64::cos(heading));
        let (sp, cp) = (math::f64::sin(pitch), math::f64::cos(pitch));
        let (right0, up0) = (DVec3::new(ch, 0.0, sh), DVec3::new(-sp * sh, cp, sp * ch));
        let roll = if vertical { 0.0 } else { math::f64::atan2(-right.dot(up0), right.dot(right0)) };
        // Adding zero turns -0 into 0.
        [heading, pitch, roll].map(|a| (a.to_degrees() * 1e12).round() / 1e12 + 0.0)
    }

    /// From a quaternion w, x, y, z that turns body axes into world axes; of any length. `None` if it is 0 or not finite.
    #[must_use]
    pub fn from_quaternion_wxyz(q: [f64; 4]) -> Option<Self> {
        let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let [w, x, y, z] = q.map(|c| c / length);
        Some(Self(DMat3::from_cols(
            DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
            DVec3::new(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
            DVec3::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)),
        )))
    }

    /// A body mounted on another: the attitude of a body that is turned by these angles in degrees relative to this one
    /// (heading to its right, pitch up, roll to the right).
    #[must_use]
    pub fn mounted(&self, angles_deg: [f64; 3]) -> Self {
        let level = Self::from_angles_deg([0.0; 3]).0;
        Self(self.0 * (level.transpose() * Self::from_angles_deg(angles_deg).0))
    }

    /// A vector in body axes as one of the world.
    #[must_use]
    pub fn to_world(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        (self.0 * DVec3::new(x, y, z)).to_array()
    }

    /// The attitude after `share` of the rotation that leads from `from` to `to`, begun at this one: with the same axis and
    /// `share` times the angle. `share` may be any number; `self` equal to `from` with share 1 gives `to`.
    #[must_use]
    pub fn turned(&self, from: &Self, to: &Self, share: f64) -> Self {
        Self(Turn::between(from, to).matrix(share) * self.0)
    }

    /// From its columns right, down and forward, which are unit vectors at right angles.
    #[must_use]
    pub fn from_columns(columns: [[f64; 3]; 3]) -> Self {
        Self(DMat3::from_cols_array_2d(&columns))
    }

    /// Columns right, down and forward.
    #[must_use]
    pub fn columns(&self) -> [[f64; 3]; 3] {
        self.0.to_cols_array_2d()
    }
}

/// A rotation about one axis, of which shares can be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    axis: DVec3,
    /// In radians, 0 to π.
    angle: f64,
}

impl Turn {
    /// The rotation that leads from one attitude to another.
    #[must_use]
    pub fn between(from: &Attitude, to: &Attitude) -> Self {
        let (axis, angle) = rotation(to.0 * from.0.transpose());
        Self { axis, angle }
    }

    /// The matrix, for vectors of the world, of the rotation about the same axis by `share` times the angle.
    #[must_use]
    pub fn matrix(&self, share: f64) -> DMat3 {
        rotate(self.axis, self.angle * share)
    }
}

/// Unit axis of a rotation matrix, and its angle in radians, 0 to π.
fn rotation(m: DMat3) -> (DVec3, f64) {
    let twice = DVec3::new(m.y_axis.z - m.z_axis.y, m.z_axis.x - m.x_axis.z, m.x_axis.y - m.y_axis.x);
    let trace = m.x_axis.x + m.y_axis.y + m.z_axis.z;
    let sin = 0.5 * twice.length();
    let angle = math::f64::atan2(sin, 0.5 * (trace - 1.0));
    if sin > 1e-12 {
        return (0.5 * twice / sin, angle);
    }
    if trace > 0.0 {
        return (DVec3::Y, 0.0);
    }
    // Half a turn: M = 2 a aᵀ − 1, any column that is not 0.
    let columns = [m.x_axis + DVec3::X, m.y_axis + DVec3::Y, m.z_axis + DVec3::Z];
    let longest = columns.into_iter().fold(DVec3::ZERO, |a, b| if b.length() > a.length() { b } else { a });
    (longest.normalize(), angle)
}

/// Rotation about a unit axis (Rodrigues).
fn rotate(axis: DVec3, angle: f64) -> DMat3 {
    let [x, y, z] = axis.to_array();
    let (s, c) = (math::f64::sin(angle), math::f64::cos(angle));
    let v = 1.0 - c;
    DMat3::from_cols(
        DVec3::new(c + x * x * v, y * x * v + z * s, z * x * v - y * s),
        DVec3::new(x * y * v - z * s, c + y * y * v, z * y * v + x * s),
        DVec3::new(x * z * v + y * s, y * z * v - x * s, c + z * z * v),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: &Attitude, b: &Attitude) {
        assert!(a.0.abs_diff_eq(b.0, 1e-12), "{a:?}\n{b:?}");
    }

    const ANGLES: [[f64; 3]; 5] =
        [[0.0; 3], [33.0, -20.0, 10.0], [-170.5, 60.0, -150.0], [90.0, 0.0, 180.0], [12.0, -89.0, 5.0]];

    #[test]
    fn angles_come_back() {
        for angles in ANGLES {
            let found = Attitude::from_angles_deg(angles).angles_deg();
            assert!(found.iter().zip(angles).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} {angles:?}");
        }
        for pitch in [90.0, -90.0] {
            let attitude = Attitude::from_angles_deg([30.0, pitch, 20.0]);
            near(&Attitude::from_angles_deg(attitude.angles_deg()), &attitude);
        }
    }

    #[test]
    fn quaternions_turn_body_into_world_axes() {
        // Half a turn about x takes OpenCV's axes to the world's: right +X, down −Y, forward −Z.
        near(
            &Attitude::from_quaternion_wxyz([0.0, 2.0, 0.0, 0.0]).unwrap(),
            &Attitude::from_angles_deg([0.0; 3]),
        );
        // A quarter turn to the right about the world's −Y after that: q = (√½, 0, −√½, 0)(0, 1, 0, 0) = (0, √½, 0, √½).
        near(
            &Attitude::from_quaternion_wxyz([0.0, 1.0, 0.0, 1.0]).unwrap(),
            &Attitude::from_angles_deg([90.0, 0.0, 0.0]),
        );
        assert_eq!(Attitude::from_quaternion_wxyz([0.0; 4]), None);
    }

    #[test]
    fn mounts_add_angles_about_the_same_axis() {
        let body = Attitude::from_angles_deg([40.0, 0.0, 0.0]);
        near(&body.mounted([15.0, 0.0, 0.0]), &Attitude::from_angles_deg([55.0, 0.0, 0.0]));
        near(
            &Attitude::from_angles_deg([40.0, 10.0, 0.0]).mounted([0.0, -25.0, 0.0]),
            &Attitude::from_angles_deg([40.0, -15.0, 0.0]),
        );
        near(&Attitude::from_angles_deg(ANGLES[1]).mounted([0.0; 3]), &Attitude::from_angles_deg(ANGLES[1]));
        let right = body.to_world([1.0, 0.0, 0.0]);
        assert!((right[0] - math::f64::cos(40.0f64.to_radians())).abs() < 1e-12 && right[1] == 0.0);
    }

    #[test]
    fn turning_has_a_constant_rate() {
        let (a, b) =
            (Attitude::from_angles_deg([10.0, 0.0, 0.0]), Attitude::from_angles_deg([50.0, 0.0, 0.0]));
        near(&a.turned(&a, &b, 0.25), &Attitude::from_angles_deg([20.0, 0.0, 0.0]));
        near(&b.turned(&a, &b, 0.5), &Attitude::from_angles_deg([70.0, 0.0, 0.0]));
        for from in ANGLES {
            for to in ANGLES {
                let (a, b) = (Attitude::from_angles_deg(from), Attitude::from_angles_deg(to));
                near(&a.turned(&a, &b, 1.0), &b);
                near(&a.turned(&a, &b, 0.0), &a);
                near(&a.turned(&a, &b, 0.5).turned(&a, &b, 0.5), &b);
            }
        }
    }
}
