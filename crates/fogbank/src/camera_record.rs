//! What records and EXR files say about a frame's camera.

use fog_core::lens::{Intrinsics, Lens};
use fog_dataset::Attribute;
use fog_scene::camera::{Camera, Pose};
use serde_json::{Value, json};

/// 4×4 camera→world, row by row.
pub(crate) fn pose_json(pose: &Pose) -> Value {
    let m = pose.world_from_camera();
    json!((0..4).map(|r| m.row(r).to_array()).collect::<Vec<_>>())
}

/// Its rotation as a quaternion w, x, y, z.
pub(crate) fn quaternion_json(pose: &Pose) -> Value {
    let q = fog_core::Quat::from_mat4(&pose.world_from_camera());
    json!([q.w, q.x, q.y, q.z])
}

/// Focal lengths, principal point and distortion, in OpenCV's convention; what the columns and rows of an equirectangular
/// image are.
pub(crate) fn intrinsics_json(lens: &Lens) -> Value {
    let Some(Intrinsics { fx_px, fy_px, cx_px, cy_px }) = lens.intrinsics() else {
        return panorama_json(lens);
    };
    json!({
        "fx_px": fx_px,
        "fy_px": fy_px,
        "cx_px": cx_px,
        "cy_px": cy_px,
        "convention": "OpenCV: pixel centres at integer coordinates",
        "distortion": distortion_json(lens),
    })
}

fn distortion_json(lens: &Lens) -> Value {
    match lens {
        Lens::Pinhole(_) | Lens::Equirectangular(_) => json!("none"),
        Lens::RadialTangential(lens) => {
            let ([k1, k2, k3, k4, k5, k6], [p1, p2]) = (lens.distortion().k, lens.distortion().p);
            json!({
                "model": "opencv",
                "coefficients": [k1, k2, p1, p2, k3, k4, k5, k6],
                "order": "k1, k2, p1, p2, k3, k4, k5, k6 (cv2.projectPoints)",
            })
        }
        Lens::Fisheye(lens) => json!({
            "model": "opencv_fisheye",
            "coefficients": lens.coefficients(),
            "order": "k1, k2, k3, k4 (cv2.fisheye.projectPoints)",
            "seen_up_to_deg_from_axis": lens.limit_deg(),
        }),
    }
}

fn panorama_json(lens: &Lens) -> Value {
    let Lens::Equirectangular(lens) = lens else { return Value::Null };
    let ([low, high], fov) = (lens.latitudes_deg(), lens.horizontal_fov_deg());
    json!({
        "model": "equirectangular",
        "longitude_deg": [-0.5 * fov, 0.5 * fov],
        "latitude_deg": [low, high],
        "convention": "even in longitude from the left edge of the image to the right, 0 forward; even in latitude from \
                       the lower edge to the upper, 90 the camera's -y",
    })
}

/// What the truth channel `depth` is with this lens.
pub(crate) fn depth_convention(lens: &Lens) -> &'static str {
    match lens {
        Lens::Pinhole(_) | Lens::RadialTangential(_) => "planar z along the camera axis, m; +inf for sky",
        Lens::Fisheye(_) => {
            "planar z along the camera axis, m, negative beyond 90 degrees from it; +inf for sky; NaN, like all truth, where \
             the lens shows nothing and the picture is black"
        }
        Lens::Equirectangular(_) => "distance, for there is no camera axis, m; +inf for sky",
    }
}

/// Custom attributes of the EXR files.
pub(crate) fn attributes(camera: &Camera) -> Vec<(&'static str, Attribute)> {
    let pose = camera.pose.world_from_camera().transpose().to_cols_array();
    let mut attributes = vec![("world_from_camera", Attribute::Matrix(pose))];
    if let Some(Intrinsics { fx_px, fy_px, cx_px, cy_px }) = camera.lens.intrinsics() {
        for (name, value) in [("fx_px", fx_px), ("fy_px", fy_px), ("cx_px", cx_px), ("cy_px", cy_px)] {
            attributes.push((name, Attribute::Number(value as f32)));
        }
    }
    if !matches!(camera.lens, Lens::Pinhole(_)) {
        attributes.push(("lens", Attribute::Text(intrinsics_json(&camera.lens).to_string())));
    }
    attributes
}
