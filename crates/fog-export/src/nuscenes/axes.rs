//! From our axes to those of nuScenes.

use fog_core::{DMat3, DMat4, DQuat, DVec3};
use serde_json::{Value, json};

use crate::camera::{Box3, Camera, matrix};

/// x east, y north, z up from ours: x east, y up, z south.
const GLOBAL_FROM_WORLD: DMat3 = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);
/// x right, y down, z forward from the vehicle's x forward, y left, z up.
const CAMERA_FROM_EGO: DMat3 = DMat3::from_cols(DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y);
/// x right, y up, z back of a thing from its x forward, y left, z up.
const THING_FROM_BOX: DMat3 = DMat3::from_cols(DVec3::NEG_Z, DVec3::NEG_X, DVec3::Y);

/// Where something is and how it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) translation: DVec3,
    pub(super) rotation: DQuat,
}

impl Pose {
    fn new(m: &DMat4) -> Self {
        Self { translation: m.w_axis.truncate(), rotation: DQuat::from_mat4(m).normalize() }
    }

    /// As a record with a token.
    pub(super) fn json(&self, token: &str) -> Value {
        let q = self.rotation;
        // Adding zero turns −0 into 0.
        let rotation = [q.w, q.x, q.y, q.z].map(|v| v + 0.0);
        json!({
            "token": token,
            "translation": self.translation.to_array().map(|v| v + 0.0),
            "rotation": rotation,
        })
    }
}

/// The vehicle in the world, which is the rig or else the camera, and the camera in it.
pub(super) fn poses(record: &Value, camera: &Camera) -> (Pose, Pose) {
    let rig = &record["rig"];
    let world_from_rig = matrix(&rig["world_from_rig"]).unwrap_or(camera.world_from_camera);
    let rig_from_camera = matrix(&rig["rig_from_camera"]).unwrap_or(DMat4::IDENTITY);
    let ego_from_rig = DMat4::from_mat3(CAMERA_FROM_EGO.transpose());
    let global = DMat4::from_mat3(GLOBAL_FROM_WORLD) * world_from_rig * DMat4::from_mat3(CAMERA_FROM_EGO);
    (Pose::new(&global), Pose::new(&(ego_from_rig * rig_from_camera)))
}

/// A box of the world: its pose, and width, length, height in m.
pub(super) fn solid(solid: &Box3) -> (Pose, [f64; 3]) {
    let turn = GLOBAL_FROM_WORLD * DMat3::from_quat(solid.turn) * THING_FROM_BOX;
    let pose =
        Pose { translation: GLOBAL_FROM_WORLD * solid.centre, rotation: DQuat::from_mat3(&turn).normalize() };
    (pose, [solid.size.x, solid.size.z, solid.size.y])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_is_y_and_a_thing_that_looks_there_is_turned_left_by_a_quarter() {
        let thing = Box3 {
            size: DVec3::new(2.0, 1.5, 4.0),
            centre: DVec3::new(3.0, 0.75, -10.0),
            turn: DQuat::IDENTITY,
        };
        let (pose, size) = solid(&thing);
        assert_eq!((pose.translation, size), (DVec3::new(3.0, 10.0, 0.75), [2.0, 4.0, 1.5]));
        let forward = pose.rotation * DVec3::X;
        assert!(
            (forward - DVec3::Y).length() < 1e-12 && (pose.rotation * DVec3::Z - DVec3::Z).length() < 1e-12
        );
    }

    #[test]
    fn a_camera_without_a_rig_is_its_own_vehicle() {
        // At (1, 2, 3), level, looking north.
        let down = DMat4::from_cols_array_2d(&[
            [1.0, 0.0, 0.0, 0.0],
            [0.0, -1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0, 0.0],
            [1.0, 2.0, 3.0, 1.0],
        ]);
        let camera =
            Camera { world_from_camera: down, intrinsics: [1.0; 4], lens: crate::camera::Lens::Pinhole };
        let (ego, mount) = poses(&Value::Null, &camera);
        assert_eq!(ego.translation, DVec3::new(1.0, -3.0, 2.0));
        assert!((ego.rotation * DVec3::X - DVec3::Y).length() < 1e-12);
        assert!((ego.rotation * DVec3::Z - DVec3::Z).length() < 1e-12);
        assert!((mount.rotation * DVec3::Z - DVec3::X).length() < 1e-12 && mount.translation == DVec3::ZERO);
    }
}
