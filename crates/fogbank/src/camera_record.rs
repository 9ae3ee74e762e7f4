//! What records and EXR files say about a frame's camera.

use crate::frame::pose;
use fog_core::lens::{Intrinsics, Lens};
use fog_core::{Mat4, Vec3A};
use fog_dataset::{Attribute, View};
use fog_plan::{FrameSpec, PoseSpec};
use fog_scene::camera::{Camera, Pose};
use serde_json::{Value, json};

/// 4×4 camera→world, row by row.
fn pose_json(pose: &Pose) -> Value {
    matrix_json(&pose.world_from_camera())
}

/// Row by row.
fn matrix_json(m: &Mat4) -> Value {
    json!((0..4).map(|r| m.row(r).to_array()).collect::<Vec<_>>())
}

/// Its rotation as a quaternion w, x, y, z.
fn quaternion_json(pose: &Pose) -> Value {
    let q = fog_core::Quat::from_mat4(&pose.world_from_camera());
    json!([q.w, q.x, q.y, q.z])
}

/// Focal lengths, principal point and distortion, in OpenCV's convention; what the columns and rows of an equirectangular
/// image are.
fn intrinsics_json(lens: &Lens) -> Value {
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

/// Adds what the camera is to a record.
pub(crate) fn write(spec: &FrameSpec, camera: &Camera, record: &mut Value) {
    let own = &mut record["camera"];
    own["world_from_camera"] = pose_json(&camera.pose);
    own["quaternion_wxyz"] = quaternion_json(&camera.pose);
    own["axes"] = json!("OpenCV: x right, y down, z forward; world +Y up, metres");
    record["sensor"]["intrinsics"] = intrinsics_json(&camera.lens);
    if let Some(rig) = &spec.rig {
        let pose = |p: &PoseSpec| pose(p.position_m, [p.heading_deg, p.pitch_deg, p.roll_deg]);
        let world_from_rig = pose(&rig.pose).world_from_camera();
        let rig_from_camera = world_from_rig.inverse() * camera.pose.world_from_camera();
        record["rig"]["world_from_rig"] = matrix_json(&world_from_rig);
        record["rig"]["rig_from_camera"] = matrix_json(&rig_from_camera);
        record["rig"]["axes"] = json!("of the rig as of its cameras: x right, y down, z forward");
    }
    if let Some(end) = &spec.readout_end {
        let end = pose(end.position_m, [end.heading_deg, end.pitch_deg, end.roll_deg]);
        record["readout_end"]["world_from_camera"] = pose_json(&end);
        record["readout_end"]["definition"] = json!(
            "pose when the lower edge of the image is exposed; `camera` is that of the upper edge. Row y of height h, its \
             centre at y + 0.5, has gone (y + 0.5) / h of the way and of the turn. The scene stands still"
        );
    }
}

/// The view for attributes of the EXR files that OpenEXR defines; with a rolling shutter that of the upper edge.
pub(crate) fn view(spec: &FrameSpec, camera: &Camera) -> View {
    let pose = &camera.pose;
    let from = pose.position.as_dvec3();
    // What a world point's coordinate along an axis of the camera is, as coefficients of x, y, z, 1.
    let along = |axis: Vec3A| -> [f64; 4] {
        let axis = axis.as_dvec3();
        [axis.x, axis.y, axis.z, -axis.dot(from)]
    };
    let [right, down, forward] = [pose.right, pose.down, pose.forward].map(along);
    const ONE: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
    // Points are rows, so what gives one of their coordinates is a column. No zero is negative.
    let stored = |columns: [[f64; 4]; 4]| std::array::from_fn(|i| columns[i % 4][i / 4] as f32 + 0.0);
    let world_to_ndc = match (&camera.lens, camera.lens.intrinsics()) {
        (Lens::Pinhole(_), Some(Intrinsics { fx_px, fy_px, cx_px, cy_px })) => {
            let share = |focal: f64, axis: [f64; 4], centre: f64, pixels: u32| -> [f64; 4] {
                std::array::from_fn(|i| (focal * axis[i] + (centre + 0.5) * forward[i]) / f64::from(pixels))
            };
            let (x, y) = (share(fx_px, right, cx_px, camera.width), share(fy_px, down, cy_px, camera.height));
            // The third is of no account; with this one the matrix has an inverse.
            Some(stored([x, y, ONE, forward]))
        }
        _ => None,
    };
    View {
        world_to_camera: Some(stored([right, down.map(|v| -v), forward, ONE])),
        world_to_ndc,
        white_luminance_cd_m2: Some(spec.lighting.luminance_of_one_cd_m2 as f32),
    }
}

/// Custom attributes of the EXR files.
pub(crate) fn attributes(camera: &Camera) -> Vec<(&'static str, Attribute)> {
    let mut attributes = Vec::new();
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
