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
