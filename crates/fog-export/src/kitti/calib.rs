//! KITTI's calibration files.

use fog_core::DMat4;

use crate::camera::Camera;

/// Velodyne axes (x forward, y left, z up) into the camera's, at the same place: there is no scanner.
const CAMERA_FROM_VELODYNE: &str = "0 -1 0 0 0 0 -1 0 1 0 0 0";
const IDENTITY: &str = "1 0 0 0 0 1 0 0 0 0 1 0";

/// `calib/NNNNNN.txt` of the object benchmark. The grey cameras are where the colour cameras are.
pub(super) fn object(camera: &Camera, baseline_m: f64) -> String {
    format!(
        "{}R0_rect: 1 0 0 0 1 0 0 0 1\nTr_velo_to_cam: {CAMERA_FROM_VELODYNE}\nTr_imu_to_velo: {IDENTITY}\n",
        projections(camera, baseline_m)
    )
}

/// `calib.txt` of a sequence.
pub(super) fn odometry(camera: &Camera, baseline_m: f64) -> String {
    format!("{}Tr: {CAMERA_FROM_VELODYNE}\n", projections(camera, baseline_m))
}

/// P0 to P3: from the left camera's axes to pixels of the left (0, 2) and right (1, 3) picture.
fn projections(camera: &Camera, baseline_m: f64) -> String {
    let [fx, fy, cx, cy] = camera.intrinsics;
    let line = |i: usize| {
        let shift = if i % 2 == 1 { -fx * baseline_m } else { 0.0 };
        format!("P{i}: {fx:e} 0 {cx:e} {shift:e} 0 {fy:e} {cy:e} 0 0 0 1 0\n")
    };
    (0..4).map(line).collect()
}

/// The upper three rows of a matrix in a line.
pub(super) fn row(m: &DMat4) -> String {
    let numbers = (0..3).flat_map(|r| m.row(r).to_array());
    // Adding zero turns −0 into 0.
    numbers.map(|v| format!("{:.9e}", v + 0.0)).collect::<Vec<_>>().join(" ")
}
