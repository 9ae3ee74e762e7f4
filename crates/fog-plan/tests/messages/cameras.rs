//! Mistakes in lenses, rigs and paths.

use crate::errors;

fn sensor(keys: &str) -> Vec<String> {
    errors(&format!("fog: none\nsensor: {{{keys}}}\n"))
}

#[test]
fn intrinsics() {
    assert_eq!(
        sensor("intrinsics: {fx_px: 0, fy_px: 300, cx_px: 1e9}"),
        [
            "configs/x.yaml:7:30: sensor.intrinsics.fx_px: 0 px is out of range; valid: above 0 up to 1000000 px",
            "configs/x.yaml:7:52: sensor.intrinsics.cx_px: 1000000000 px is out of range; valid: -1000000 to 1000000 px",
            "configs/x.yaml:7:22: sensor.intrinsics.cy_px: missing; intrinsics are fx_px, fy_px, cx_px and cy_px",
        ]
    );
    assert_eq!(
        sensor("horizontal_fov_deg: 50, intrinsics: {fx_px: 300, fy_px: 300, cx_px: 160, cy_px: 90}"),
        [
            "configs/x.yaml:7:46: sensor.intrinsics: sensor.horizontal_fov_deg and these both give the focal length: \
             keep one of them"
        ]
    );
    assert_eq!(
        sensor("lens: equirectangular, intrinsics: {fx_px: 300, fy_px: 300, cx_px: 160, cy_px: 90}"),
        ["configs/x.yaml:7:45: sensor.intrinsics: an equirectangular image has none; remove them"]
    );
}

#[test]
fn lenses() {
    assert_eq!(
        sensor("lens: fishey"),
        [
            "configs/x.yaml:7:16: sensor.lens: unknown value \"fishey\"; expected one of pinhole, opencv, fisheye, \
             equirectangular; did you mean `fisheye`?"
        ]
    );
    assert_eq!(
        sensor("lens: opencv"),
        ["configs/x.yaml:7:16: sensor.lens: `opencv` needs a value: {opencv: …}"]
    );
    assert_eq!(
        sensor("lens: {opencv: {k7: 1}}"),
        [
            "configs/x.yaml:7:26: sensor.lens.opencv.k7: unknown key; expected one of k1, k2, p1, p2, k3, k4, k5, k6; \
             did you mean `k1`?"
        ]
    );
    assert_eq!(
        sensor("lens: {opencv: {k1: -0.9}}"),
        [
            "configs/x.yaml:7:16: sensor.lens: the distortion folds back at 0.6086 (tangent of the angle) from the axis, where \
             the image radius is 112.4 px: inside the image, whose farthest corner is 183.6 px from the principal point"
        ]
    );
    assert_eq!(
        sensor("lens: {fisheye: {k1: -0.2, field_of_view_deg: 400}}"),
        [
            "configs/x.yaml:7:56: sensor.lens.fisheye.field_of_view_deg: 400 deg is out of range; valid: 0.1 to 360 deg"
        ]
    );
    assert_eq!(
        sensor("lens: {equirectangular: {latitude_deg: [30, -30]}}"),
        [
            "configs/x.yaml:7:49: sensor.lens.equirectangular.latitude_deg: [30, -30]: the lower edge comes first, and \
             below the upper"
        ]
    );
    assert_eq!(
        sensor("horizontal_fov_deg: 180"),
        ["configs/x.yaml:7:30: sensor.horizontal_fov_deg: 180 deg is out of range; valid: 0.1 to 170 deg"]
    );
}

#[test]
fn paths() {
    let path = |keys: &str| errors(&format!("fog: none\npath: {{{keys}}}\n"));
    assert_eq!(
        path("poses: [{position_m: [0, 1, 2]}], csv: a.csv"),
        [
            "configs/x.yaml:7:7: path: expected one of poses, csv, waypoints, drive, glide_slope; found poses and csv"
        ]
    );
    assert_eq!(path("pose: []").len(), 1, "an unknown key is one mistake");
    assert_eq!(
        path("poses: [{position_m: [0, 1, 2], time_s: 1}, {position_m: [0, 1, 2], time_s: 1}]"),
        ["configs/x.yaml:7:84: path.poses.1.time_s: 1 s does not come after 1 s of the pose before"]
    );
    assert_eq!(
        path("poses: [{position_m: [0, 1, 2], heading_deg: 400}]"),
        ["configs/x.yaml:7:53: path.poses.0.heading_deg: 400 deg is out of range; valid: -360 to 360 deg"]
    );
    assert_eq!(
        path("poses: [{position_m: [0, 30000, 2]}]"),
        ["configs/x.yaml:7:7: path: pose 0, altitude: 30000 m is out of range; valid: -500 to 20000 m"]
    );
    assert_eq!(
        path("csv: /nowhere/a.csv"),
        ["configs/x.yaml:7:13: path.csv: cannot read /nowhere/a.csv: No such file or directory (os error 2)"]
    );
    assert_eq!(
        path("waypoints: [[0, 1, 2], [0, 1, 2]], rate_hz: 0"),
        [
            "configs/x.yaml:7:31: path.waypoints.1: the same as the point before",
            "configs/x.yaml:7:7: path.speed_m_s: missing; speed along the curve",
            "configs/x.yaml:7:52: path.rate_hz: 0 Hz is out of range; valid: above 0 up to 10000 Hz",
        ]
    );
    assert_eq!(
        path("csv: a.csv, rate_hz: 3"),
        ["configs/x.yaml:7:29: path.rate_hz: belongs to waypoints, not to csv"]
    );
}

#[test]
fn lines() {
    assert_eq!(
        errors("fog: none\npath: {poses: [{position_m: [0, 0, 0]}], line: straight}\n"),
        ["configs/x.yaml:7:48: path.line: belongs to waypoints, not to poses"]
    );
    assert_eq!(
        errors(
            "fog: none\npath: {drive: {points: [[0, 0], [0, 9]], speed_m_s: 1, rate_hz: 1, line: bent}}\n"
        ),
        ["configs/x.yaml:7:74: path.drive.line: unknown value \"bent\"; expected one of curve, straight"]
    );
}

#[test]
fn approaches() {
    let slope = |keys: &str| errors(&format!("fog: none\npath: {{glide_slope: {{{keys}}}}}\n"));
    assert_eq!(
        slope("from_m: 3000, to_m: 60"),
        [
            "configs/x.yaml:7:21: path.glide_slope: expected one of step_m, count and rate_hz: how many poses there are"
        ]
    );
    assert_eq!(
        slope("from_m: 60, to_m: 3000, count: 3"),
        ["configs/x.yaml:7:40: path.glide_slope.to_m: 3000 m is not less than from_m, 60 m"]
    );
    assert_eq!(
        slope("lard: {count: 3}, roll_deg: 3"),
        [
            "configs/x.yaml:7:50: path.glide_slope.roll_deg: lard draws it; beside lard only threshold_m, heading_deg and \
             aiming_point_m are of use"
        ]
    );
    assert_eq!(
        slope("from_m: 9, to_m: 3, count: 3, dispersion: {roll_deg: -1}"),
        [
            "configs/x.yaml:7:75: path.glide_slope.dispersion.roll_deg: -1 deg is out of range; valid: 0 to 20 deg"
        ]
    );
}

#[test]
fn rigs_and_shutters() {
    assert_eq!(
        errors("fog: none\ncameras: {}\n"),
        [
            "configs/x.yaml:7:10: cameras: empty; name at least one camera, such as {left: {position_m: [0, 0, 0]}}"
        ]
    );
    assert_eq!(
        errors("fog: none\ncameras: {left eye: {}}\n"),
        [
            "configs/x.yaml:7:10: cameras: \"left eye\" is not a name: use 1 to 32 letters, digits, `_` and `-`"
        ]
    );
    assert_eq!(
        errors(
            "fog: none\ncameras: {a: {}, b: {position_m: [0, 0, 2000], sensor: {width_px: 0, hight: 3}}}\n"
        ),
        [
            "configs/x.yaml:7:70: cameras.b.sensor.hight: unknown key; expected one of width_px, height_px, \
             horizontal_fov_deg, intrinsics, lens, shutter, exposure, model",
            "configs/x.yaml:7:67: cameras.b.sensor.width_px: 0 px is out of range; valid: 1 to 16384 px",
            "configs/x.yaml:7:41: cameras.b.position_m.2: 2000 m is out of range; valid: -1000 to 1000 m",
        ]
    );
    assert_eq!(
        errors("fog: none\ncamera: {altitude_m: 3}\npath: {poses: [{position_m: [0, 1, 2]}]}\n"),
        ["configs/x.yaml:7:9: camera: the path says where the camera is: remove `camera`, or `path`"]
    );
    assert_eq!(
        sensor("shutter: {rolling: {readout_s: 0.01}}"),
        [
            "configs/x.yaml:7:19: sensor.shutter: without `path` nothing moves: a rolling shutter sees what a global one \
             sees; remove it"
        ]
    );
    assert_eq!(
        sensor("shutter: {rolling: {readout_s: 2}}"),
        [
            "configs/x.yaml:7:41: sensor.shutter.rolling.readout_s: 2 s is out of range; valid: above 0 up to 1 s"
        ]
    );
    assert_eq!(
        errors(
            "fog: none\npath: {poses: [{position_m: [0, 1, 2]}]}\nsensor: {shutter: {rolling: {readout_s: 0.1}}}\n"
        ),
        ["configs/x.yaml:8:19: sensor.shutter: needs a path of two poses or more that are of one motion"]
    );
}
