//! Checks of `camera` and `cameras`, and what they and the path make of a frame.

use std::{collections::BTreeMap, sync::Arc};

use super::{Check, Place};
use crate::{
    frame::CameraSpec,
    origin::Origin,
    path::{NextSpec, Path, PathSpec},
    ranges,
    rig::{PoseSpec, RigSpec},
    schema::{CameraFile, ConfigFile, RigCameraFile, ShutterFile},
};

/// Longest name of a camera.
const MAX_NAME: usize = 32;

/// Where a frame's camera is, and on what.
pub(super) struct View {
    pub(super) camera: CameraSpec,
    pub(super) rig: Option<RigSpec>,
    pub(super) path: Option<PathSpec>,
    pub(super) readout_end: Option<CameraSpec>,
}

impl Check<'_> {
    /// The camera of the frame at `place`.
    pub(super) fn view(&mut self, file: &ConfigFile, place: &Place<'_>, datum_m: f64) -> Option<View> {
        let path = match (place.path, &file.path) {
            (Some(path), _) => Some(Some(path.clone())),
            (None, Some(path)) => self.path(path).map(Some),
            (None, None) => Some(None),
        };
        let mount = self.rig_camera(file.cameras.as_ref(), place.camera);
        let readout_s = self.readout_s(file.sensor.shutter);
        let (path, mount) = (path?, mount?);
        let Some(path) = path else {
            let body = self.pose_of(&file.camera, datum_m)?;
            if readout_s?.is_some() {
                let message =
                    "without `path` nothing moves: a rolling shutter sees what a global one sees; remove it";
                self.problem("sensor.shutter", message);
                return None;
            }
            let (mut camera, rig) = self.mounted(&body, place.camera, mount.as_ref(), datum_m, None)?;
            if mount.is_none() {
                // As written, without rounding.
                camera.altitude_m = file.camera.altitude_m;
            }
            return Some(View { camera, rig, path: None, readout_end: None });
        };
        let own = self.tree.child("camera").map(|camera| &camera.origin);
        if own.is_some_and(|origin| *origin != Origin::Default) {
            self.problem("camera", "the path says where the camera is: remove `camera`, or `path`");
            return None;
        }
        self.on_path(&path, place, mount.as_ref(), readout_s?, datum_m)
    }

    fn on_path(
        &mut self,
        path: &Arc<Path>,
        place: &Place<'_>,
        mount: Option<&PoseSpec>,
        readout_s: Option<f64>,
        datum_m: f64,
    ) -> Option<View> {
        let index = place.pose.min(path.poses.len() - 1);
        let ends = |check: &mut Self, i: usize| match readout_s {
            None => Some(None),
            Some(seconds) => {
                let Some(end) = path.after(i, seconds) else {
                    let message = "needs a path of two poses or more that are of one motion";
                    check.problem("sensor.shutter", message);
                    return None;
                };
                let mounted = check.mounted(&end, place.camera, mount, datum_m, Some(i))?;
                Some(Some(mounted.0))
            }
        };
        let here = &path.poses[index];
        let (camera, rig) = self.mounted(&here.pose, place.camera, mount, datum_m, Some(index))?;
        let readout_end = ends(self, index)?;
        let next = match path.poses.get(index + 1).filter(|_| path.moves) {
            None => None,
            Some(next) => {
                let (camera, _) = self.mounted(&next.pose, place.camera, mount, datum_m, Some(index + 1))?;
                Some(NextSpec { time_s: next.time_s, camera, readout_end: ends(self, index + 1)? })
            }
        };
        let spec = PathSpec { index, time_s: here.time_s, approach: here.approach, next };
        Some(View { camera, rig, path: Some(spec), readout_end })
    }

    /// The camera's own pose where there is no path.
    fn pose_of(&mut self, camera: &CameraFile, datum_m: f64) -> Option<PoseSpec> {
        let altitude = self.range("camera.altitude_m", camera.altitude_m, ranges::CAMERA_ALTITUDE_M);
        let x = self.range("camera.position_m.0", camera.position_m[0], ranges::POSITION_M);
        let y = self.range("camera.position_m.1", camera.position_m[1], ranges::POSITION_M);
        let z = self.range("camera.position_m.2", camera.position_m[2], ranges::POSITION_M);
        let heading = self.range("camera.heading_deg", camera.heading_deg, ranges::HEADING_DEG);
        let pitch = self.range("camera.pitch_deg", camera.pitch_deg, ranges::PITCH_DEG);
        let roll = self.range("camera.roll_deg", camera.roll_deg, ranges::ROLL_DEG);
        y?;
        Some(PoseSpec::new([x?, datum_m + altitude?, z?], [heading?, pitch?, roll?]))
    }

    /// Pose of the named camera in its rig. The outer option is the check's success.
    fn rig_camera(
        &mut self,
        cameras: Option<&BTreeMap<String, RigCameraFile>>,
        name: Option<&str>,
    ) -> Option<Option<PoseSpec>> {
        let Some(cameras) = cameras else { return Some(None) };
        let Some(name) = name else {
            self.problem(
                "cameras",
                "empty; name at least one camera, such as {left: {position_m: [0, 0, 0]}}",
            );
            return None;
        };
        let fits = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || name.len() > MAX_NAME || !name.chars().all(fits) {
            let message =
                format!("\"{name}\" is not a name: use 1 to {MAX_NAME} letters, digits, `_` and `-`");
            self.problem("cameras", message);
            return None;
        }
        self.mount(name, cameras.get(name)?).map(Some)
    }

    fn mount(&mut self, name: &str, camera: &RigCameraFile) -> Option<PoseSpec> {
        let path = |key: &str| format!("cameras.{name}.{key}");
        for (i, c) in camera.position_m.iter().enumerate() {
            self.range(&path(&format!("position_m.{i}")), *c, ranges::MOUNT_M)?;
        }
        let heading = self.range(&path("heading_deg"), camera.heading_deg, ranges::HEADING_DEG);
        let pitch = self.range(&path("pitch_deg"), camera.pitch_deg, ranges::PITCH_DEG);
        let roll = self.range(&path("roll_deg"), camera.roll_deg, ranges::ROLL_DEG);
        Some(PoseSpec::new(camera.position_m, [heading?, pitch?, roll?]))
    }

    /// The camera with this name on a body, or the body itself; the body is at a pose of the path, if there is one.
    fn mounted(
        &mut self,
        body: &PoseSpec,
        name: Option<&str>,
        mount: Option<&PoseSpec>,
        datum_m: f64,
        pose_index: Option<usize>,
    ) -> Option<(CameraSpec, Option<RigSpec>)> {
        let pose = mount.map_or(*body, |mount| body.mounted(mount));
        let altitude_m = pose.position_m[1] - datum_m;
        if !ranges::CAMERA_ALTITUDE_M.contains(altitude_m) {
            let message = ranges::CAMERA_ALTITUDE_M.message("altitude_m", altitude_m);
            let (section, of) =
                pose_index.map_or(("camera", String::new()), |i| ("path", format!("pose {i}, ")));
            self.problem(section, format!("{of}altitude: {message}"));
            return None;
        }
        let camera = CameraSpec {
            altitude_m,
            position_m: pose.position_m,
            heading_deg: pose.heading_deg,
            pitch_deg: pose.pitch_deg,
            roll_deg: pose.roll_deg,
        };
        let rig = name.zip(mount).map(|(name, mount)| RigSpec {
            camera: name.to_owned(),
            mount: *mount,
            pose: *body,
        });
        Some((camera, rig))
    }

    /// Seconds that a rolling shutter takes. The outer option is the check's success.
    fn readout_s(&mut self, shutter: Option<ShutterFile>) -> Option<Option<f64>> {
        let Some(ShutterFile::Rolling(rolling)) = shutter else { return Some(None) };
        let path = "sensor.shutter.rolling.readout_s";
        self.needed(path, rolling.readout_s, ranges::READOUT_S, "seconds from the upper edge to the lower")
            .map(Some)
    }
}
