//! Where things are: rotations without the platform's trigonometry.

use fog_core::{Vec3, math};
use glam::{Affine3A, Mat3A, Vec3A};

/// Translation and rotation of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) at: Vec3,
    /// Unit quaternion x, y, z, w.
    pub(crate) rotation: [f32; 4],
}

/// Sine and cosine of degrees.
pub(crate) fn sin_cos(deg: f32) -> (f32, f32) {
    let r = f64::from(deg).to_radians();
    (math::f64::sin(r) as f32, math::f64::cos(r) as f32)
}

impl Place {
    /// At a point, not turned.
    pub(crate) fn at(x: f32, y: f32, z: f32) -> Self {
        Self { at: Vec3::new(x, y, z), rotation: [0.0, 0.0, 0.0, 1.0] }
    }

    /// Facing a heading in degrees: 0 leaves −Z alone, 90 turns it to +X.
    pub(crate) fn facing(self, heading_deg: f32) -> Self {
        let (s, c) = sin_cos(-0.5 * heading_deg);
        Self { rotation: [0.0, s, 0.0, c], ..self }
    }

    /// Turned so that −Z, the axis of a spot light, points along `direction`, without roll: +X stays level.
    pub(crate) fn aimed(self, direction: Vec3) -> Self {
        let d = direction.normalize_or(Vec3::NEG_Z).as_dvec3();
        let half = |angle: f64| (math::f64::sin(0.5 * angle) as f32, math::f64::cos(0.5 * angle) as f32);
        // A turn to the heading, and before it one about +X to the elevation.
        let (sy, cy) = half(-math::f64::atan2(d.x, -d.z));
        let (sx, cx) = half(math::f64::atan2(d.y, (d.x * d.x + d.z * d.z).sqrt()));
        Self { rotation: [cy * sx, sy * cx, -sy * sx, cy * cx], ..self }
    }

    /// The world's point that is `local` of this place.
    pub(crate) fn point(&self, local: Vec3) -> Vec3 {
        let [x, y, z, w] = self.rotation;
        fog_core::Quat::from_xyzw(x, y, z, w) * local + self.at
    }
}

/// A shift.
pub(crate) fn shift(x: f32, y: f32, z: f32) -> Affine3A {
    Affine3A::from_translation(Vec3::new(x, y, z))
}

/// A turn about +X, counterclockwise seen from its tip: y towards z.
pub(crate) fn turn_x(deg: f32) -> Affine3A {
    let (s, c) = sin_cos(deg);
    let columns = Mat3A::from_cols(Vec3A::X, Vec3A::new(0.0, c, s), Vec3A::new(0.0, -s, c));
    Affine3A { matrix3: columns, translation: Vec3A::ZERO }
}

/// A turn about +Y, counterclockwise seen from above: z towards x.
pub(crate) fn turn_y(deg: f32) -> Affine3A {
    let (s, c) = sin_cos(deg);
    let columns = Mat3A::from_cols(Vec3A::new(c, 0.0, -s), Vec3A::Y, Vec3A::new(s, 0.0, c));
    Affine3A { matrix3: columns, translation: Vec3A::ZERO }
}

/// A turn about +Z, counterclockwise seen from its tip: x towards y.
pub(crate) fn turn_z(deg: f32) -> Affine3A {
    let (s, c) = sin_cos(deg);
    let columns = Mat3A::from_cols(Vec3A::new(c, s, 0.0), Vec3A::new(-s, c, 0.0), Vec3A::Z);
    Affine3A { matrix3: columns, translation: Vec3A::ZERO }
}

/// A stretch along the axes.
pub(crate) fn stretch(x: f32, y: f32, z: f32) -> Affine3A {
    Affine3A::from_scale(Vec3::new(x, y, z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_turn_as_their_names_say() {
        let near = |a: Vec3, b: Vec3| assert!((a - b).length() < 1e-5, "{a} {b}");
        near(Place::at(1.0, 2.0, 3.0).facing(90.0).point(Vec3::NEG_Z), Vec3::new(2.0, 2.0, 3.0));
        for d in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_Z, Vec3::new(0.3, -0.8, 0.2)] {
            let place = Place::at(0.0, 0.0, 0.0).aimed(d);
            near(place.point(Vec3::NEG_Z), d.normalize());
            assert!(place.point(Vec3::X).y.abs() < 1e-5 && place.point(Vec3::Y).y > -1e-5, "{d} rolls");
        }
        near(turn_x(90.0).transform_vector3(Vec3::Y), Vec3::Z);
        near(turn_y(90.0).transform_vector3(Vec3::Z), Vec3::X);
        near(turn_z(90.0).transform_vector3(Vec3::X), Vec3::Y);
    }
}
