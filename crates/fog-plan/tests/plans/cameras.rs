//! Rigs, paths and lenses in plans.

use std::path::Path;

use fog_plan::{FrameSpec, LensSpec, Plan};

const BASE: &str = "version: 1\nname: t\nscene: none\nfog: none\n";

fn plan(lines: &str) -> Plan {
    fog_plan::parse(&format!("{BASE}{lines}"), "t.yaml", &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn frames(lines: &str) -> Vec<FrameSpec> {
    plan(lines).frames().map(|frame| frame.unwrap_or_else(|error| panic!("{error}"))).collect()
}

fn close(a: [f64; 3], b: [f64; 3]) {
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} {b:?}");
}

const STEREO: &str = "cameras: {left: {position_m: [-0.06, 0, 0]}, right: {position_m: [0.06, 0, 0], heading_deg: 5, \
                      sensor: {width_px: 64, intrinsics: {fx_px: 50, fy_px: 50, cx_px: 31.5, cy_px: 89.5}}}}\n";

#[test]
fn a_rig_multiplies_frames_by_its_cameras() {
    let frames = frames(&format!(
        "camera: {{altitude_m: 2, heading_deg: 90}}\n{STEREO}sweep: {{axes: {{camera.altitude_m: [2, 5]}}}}\n"
    ));
    let names: Vec<_> = frames.iter().map(|f| f.id.rsplit_once('-').unwrap().0).collect();
    assert_eq!(names, ["2_left", "2_right", "5_left", "5_right"]);
    // Looking along +X, right is +Z.
    close(frames[0].camera.position_m, [0.0, 2.0, -0.06]);
    close(frames[3].camera.position_m, [0.0, 5.0, 0.06]);
    assert_eq!((frames[0].camera.heading_deg, frames[3].camera.heading_deg), (90.0, 95.0));
    let rig = frames[3].rig.as_ref().unwrap();
    assert_eq!(
        (rig.camera.as_str(), rig.pose.position_m, rig.mount.heading_deg),
        ("right", [0.0, 5.0, 0.0], 5.0)
    );
    assert_eq!((frames[0].sensor.width_px, frames[1].sensor.width_px), (320, 64));
    assert_eq!(
        (frames[0].sensor.horizontal_fov_deg, frames[1].sensor.horizontal_fov_deg),
        (Some(60.0), None)
    );
    assert_eq!(frames[1].axes[1], ("rig.camera".to_owned(), "right".into()));
}

#[test]
fn a_path_multiplies_frames_by_its_poses() {
    let path = "path: {poses: [{position_m: [0, 2, 0]}, {position_m: [0, 2, -4], heading_deg: 10}, \
                {position_m: [0, 2, -6], heading_deg: 30}]}\n";
    let text = format!("{path}{STEREO}sweep: {{axes: {{lighting: [day, night]}}}}\n");
    let plan = plan(&text);
    let frames: Vec<FrameSpec> = plan.frames().map(Result::unwrap).collect();
    assert_eq!(frames.len(), 12);
    assert!(frames[9].id.starts_with("night_0001_right-"), "{}", frames[9].id);
    let on = |f: &FrameSpec| f.path.clone().unwrap();
    assert_eq!((on(&frames[9]).index, on(&frames[9]).time_s), (1, 1.0));
    // The next pose is that of the same camera, and there is none after the last.
    let next = on(&frames[9]).next.unwrap();
    assert_eq!((next.camera, next.time_s), (frames[11].camera, 2.0));
    assert_eq!(on(&frames[11]).next, None);
    let axes: Vec<_> = plan.axes().into_iter().map(|a| (a.path, a.len, a.values.join(" "))).collect();
    assert_eq!(
        axes[1..],
        [
            ("path".to_owned(), Some(3), "0 s 1 s 2 s".to_owned()),
            ("cameras".to_owned(), Some(2), "left right".to_owned())
        ]
    );
    // The resolved configuration means the same.
    let again = fog_plan::parse(&plan.resolved_yaml(), "again.yaml", &[]).unwrap();
    assert_eq!(again.frames().map(Result::unwrap).collect::<Vec<_>>(), frames);
    assert_eq!(again.config_digest(), plan.config_digest());
}

#[test]
fn a_path_may_depend_on_an_axis() {
    let frames = frames(
        "path: {glide_slope: {from_m: 1000, to_m: 500, step_m: 100}}\n\
         sweep: {axes: {path.glide_slope.step_m: [500, 200], path.glide_slope.lateral_deviation_deg: [0, 1]}}\n",
    );
    // 2 + 2 + 3 + 3 poses.
    let along: Vec<f64> =
        frames.iter().map(|f| f.path.as_ref().unwrap().approach.unwrap().along_track_m).collect();
    assert_eq!(along, [1000.0, 500.0, 1000.0, 500.0, 1000.0, 800.0, 600.0, 1000.0, 800.0, 600.0]);
    assert_eq!(frames.iter().enumerate().filter(|(i, f)| f.index == *i).count(), 10);
    assert!(frames[2].camera.position_m[0] > 17.0 && frames[1].camera.position_m[0] == 0.0);
    let ids: std::collections::BTreeSet<_> = frames.iter().map(|f| &f.id).collect();
    assert_eq!(ids.len(), 10);
}

#[test]
fn paths_from_files_way_points_and_roads() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("flight.csv");
    std::fs::write(
        &file,
        "time_s,x_m,y_m,z_m,heading_deg,pitch_deg,roll_deg\n0,0,9,0,0,0,0\n0.1,1,9,0,0,0,5\n",
    )
    .unwrap();
    let flown = frames(&format!("path: {{csv: {file:?}}}\n"));
    assert_eq!((flown.len(), flown[1].camera.roll_deg, flown[1].camera.altitude_m), (2, 5.0, 9.0));
    // A file is read once, so that a plan is one whatever happens to it.
    let plan = plan(&format!("path: {{csv: {file:?}}}\nsweep: {{axes: {{path.csv: [{file:?}]}}}}\n"));
    std::fs::remove_file(&file).unwrap();
    assert_eq!(plan.frame(1).unwrap().camera, flown[1].camera);

    let points = frames("path: {waypoints: [[0, 5, 0], [0, 5, -20]], speed_m_s: 10, rate_hz: 1}\n");
    close(points[2].camera.position_m, [0.0, 5.0, -20.0]);
    let road =
        frames("path: {drive: {points: [[0, 0], [30, 0]], lane_offset_m: 1.5, speed_m_s: 10, rate_hz: 2}}\n");
    assert_eq!(road.len(), 7);
    close(road[1].camera.position_m, [5.0, 1.2, 1.5]);
    assert_eq!(road[1].camera.heading_deg, 90.0);
    let lard = frames("path: {glide_slope: {lard: {count: 5, seed: 3}}}\n");
    assert!(lard.len() == 5 && lard.iter().all(|f| f.path.as_ref().unwrap().next.is_none()));
}

#[test]
fn a_rolling_shutter_ends_between_two_poses() {
    let rolling = frames(
        "path: {poses: [{position_m: [0, 2, 0]}, {position_m: [4, 2, 0], heading_deg: 20}]}\n\
         sensor: {shutter: {rolling: {readout_s: 0.25}}}\n",
    );
    let ends: Vec<_> = rolling.iter().map(|f| f.readout_end.unwrap()).collect();
    close(ends[0].position_m, [1.0, 2.0, 0.0]);
    // Beyond the last pose the motion before goes on.
    close(ends[1].position_m, [5.0, 2.0, 0.0]);
    assert!((ends[0].heading_deg - 5.0).abs() < 1e-9 && (ends[1].heading_deg - 25.0).abs() < 1e-9);
    assert_eq!(rolling[0].path.as_ref().unwrap().next.unwrap().readout_end, Some(ends[1]));
}

#[test]
fn lenses_and_their_defaults() {
    let sensor = |keys: &str| frames(&format!("sensor: {{{keys}}}\n"))[0].sensor.clone();
    assert_eq!(sensor("lens: pinhole").projection, sensor("width_px: 320").projection);
    assert_eq!(sensor("lens: fisheye").horizontal_fov_deg, Some(180.0));
    assert_eq!(sensor("lens: equirectangular").horizontal_fov_deg, Some(360.0));
    let fisheye = sensor("lens: {fisheye: {k1: -0.02}}");
    assert!(matches!(fisheye.lens, LensSpec::Fisheye { k1: -0.02, field_of_view_deg: 360.0, .. }));
    // Half of 180 degrees over half of the width.
    assert!((fisheye.projection.intrinsics().unwrap().fx_px - 320.0 / std::f64::consts::PI).abs() < 1e-9);
    let json = serde_json::to_value(sensor("lens: {opencv: {k1: -0.1, p2: 0.001}}")).unwrap();
    assert_eq!((&json["lens"]["opencv"]["k1"], &json["lens"]["opencv"]["k6"]), (&(-0.1).into(), &0.0.into()));
    // An axis over lenses: no field of view is filled in for all.
    let both = plan("sweep: {axes: {sensor.lens: [pinhole, equirectangular]}}\n");
    assert_eq!(both.frame(0).unwrap().sensor.horizontal_fov_deg, Some(60.0));
    assert_eq!(both.frame(1).unwrap().sensor.horizontal_fov_deg, Some(360.0));
    assert!(fog_plan::parse(&both.resolved_yaml(), "again.yaml", &[]).is_ok());
}

#[test]
fn the_approach_is_a_glide_slope() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/approach.yaml");
    let set = |key: &str| vec![format!("path.glide_slope.{key}")];
    let plan = fog_plan::load(&path, &set("vertical_deviation_deg=0.5")).unwrap();
    let slope = plan.frame(0).unwrap().path.unwrap().approach.unwrap().vertical_angle_deg;
    assert!((slope - 3.5).abs() < 1e-12);
}

#[test]
fn the_scene_moves_with_the_path() {
    let base = "version: 1\nname: t\nscene: {file: a.glb, time_s: 10}\nfog: none\n";
    let times = |lines: &str| -> Vec<f64> {
        let plan = fog_plan::parse(&format!("{base}{lines}"), "t.yaml", &[]).unwrap();
        plan.frames().map(|f| f.unwrap().scene.unwrap().time_s).collect()
    };
    assert_eq!(times(""), [10.0]);
    assert_eq!(times("path: {poses: [{position_m: [0, 2, 0]}, {position_m: [0, 2, 1]}]}\n"), [10.0, 11.0]);
    let none = fog_plan::parse(&base.replace(", time_s: 10", ""), "t.yaml", &[]).unwrap().frame(0).unwrap();
    assert!(serde_json::to_value(&none).unwrap()["scene"].get("time_s").is_none());
}
