//! Approaches whose numbers have closed forms.

use super::*;
use fog_core::Vec3A;
use fog_core::math::f64::{atan2, exp, tan};
use fog_optics::visibility::{allard_m, koschmieder::MOR_OPTICAL_DEPTH};
use fog_scene::camera::Pose;
use fog_scene::lamp::{Cone, Lamp, Pattern};
use serde_json::{Value, json};

/// A runway along −Z with its threshold at the origin.
fn north() -> RunwaySite {
    RunwaySite {
        threshold_m: [0.0; 3],
        heading_deg: 0.0,
        length_m: 2500.0,
        width_m: 45.0,
        glide_slope_deg: 3.0,
        touchdown_m: 300.0,
    }
}

/// A camera that looks along the glide path.
fn camera(x: f32, y: f32, z: f32) -> Camera {
    Camera::new(Pose::new(Vec3A::new(x, y, z), 0.0, -3.0, 0.0), 320, 180, 40.0)
}

/// A lamp that shines all around with this intensity.
fn lamp(node: &str, z: f32, cd: f32) -> RunwayLamp {
    let lamp = Lamp::even(Vec3A::new(0.0, 0.0, z), [cd; 3]);
    RunwayLamp { node: node.to_owned(), lamp }
}

/// The approach in homogeneous fog.
fn approach(camera: &Camera, lamps: &[RunwayLamp], sigma: f64, background: f64) -> Aviation {
    let tau = |from: DVec3, to: DVec3| sigma * (to - from).length();
    let air = Air { tau: &tau, sigma_t_1_m: sigma, hidden: &|_, _| false };
    aviation(&north(), camera, lamps, &air, background).expect("in range")
}

fn near(value: f64, want: f64, tolerance: f64) {
    assert!((value - want).abs() <= tolerance, "{value} for {want}");
}

#[test]
fn positions_are_exact() {
    // On the glide path, 1700 m before the threshold.
    let height = 2000.0 * tan(3.0f64.to_radians());
    let on = Position::new(&north(), DVec3::new(0.0, height, 1700.0));
    near(on.height_above_threshold_m, height, 0.0);
    near(on.along_track_m, 1700.0, 1e-9);
    near(on.cross_track_m, 0.0, 1e-9);
    near(on.slant_range_to_threshold_m, (1700.0f64 * 1700.0 + height * height).sqrt(), 1e-9);
    near(on.glide_path_angle_deg.expect("before"), 3.0, 1e-12);
    near(on.glide_path_deviation_dots.expect("before"), 0.0, 1e-11);
    near(on.lateral_angle_deg.expect("before"), 0.0, 1e-12);

    // Any heading and place: the same position, turned and moved.
    for heading in [37.0, 90.0, 211.5, 359.0] {
        let site = RunwaySite { threshold_m: [120.0, 35.0, -900.0], heading_deg: heading, ..north() };
        let eye = site.threshold() - site.forward() * 800.0 + site.right() * 60.0 + DVec3::Y * 70.0;
        let there = Position::new(&site, eye);
        near(there.along_track_m, 800.0, 1e-9);
        near(there.cross_track_m, 60.0, 1e-9);
        near(there.height_above_threshold_m, 70.0, 1e-9);
        near(there.lateral_angle_deg.expect("before"), atan2(60.0, 1100.0).to_degrees(), 1e-9);
        let level = (1100.0f64 * 1100.0 + 60.0 * 60.0).sqrt();
        let angle = atan2(70.0, level).to_degrees();
        near(there.glide_path_angle_deg.expect("before"), angle, 1e-9);
        near(there.glide_path_deviation_deg.expect("before"), angle - 3.0, 1e-9);
        near(there.glide_path_deviation_dots.expect("before"), (angle - 3.0) / 0.36, 1e-9);
    }
    // East is to the right of a runway to the north, and beyond the aiming point there is no glide path.
    assert!(Position::new(&north(), DVec3::new(5.0, 10.0, 100.0)).cross_track_m > 0.0);
    let beyond = Position::new(&north(), DVec3::new(0.0, 2.0, -400.0));
    assert_eq!(
        (beyond.along_track_m, beyond.glide_path_angle_deg, beyond.lateral_angle_deg),
        (-400.0, None, None)
    );
}

#[test]
fn lights_are_seen_as_far_as_allard_says() {
    let sigma = MOR_OPTICAL_DEPTH / 300.0;
    // Night: 8e-7 lx.
    let range = allard_m(5000.0, 8e-7, sigma);
    let eye = camera(0.0, 0.0, 0.0);
    let row: Vec<RunwayLamp> =
        (1..200).map(|i| lamp(&format!("centre_line_light_{i:03}"), -15.0 * i as f32, 5000.0)).collect();
    let night = approach(&eye, &row, sigma, 10.0);
    let group = &night.lights[0];
    let want = (range / 15.0).floor();
    assert_eq!((group.name, group.lamps, group.visible), ("centre_line", 199, want as usize));
    near(group.share_visible, want / 199.0, 1e-12);
    near(group.farthest_visible_m.expect("some"), 15.0 * want, 1e-3);
    near(group.greatest_illuminance_lx, 5000.0 * exp(-sigma * 15.0) / 225.0, 1e-3);
    let segment = night.visible_segment.clone().expect("some");
    near(segment.length_m, 15.0 * (want - 1.0), 1e-3);
    assert_eq!(segment.lights, want as usize);
    assert!(night.runway_in_sight && night.three_consecutive_lights && !night.approach_lights_in_sight);
    // RVR: the centre-line lights alone, so that the edge lights are dark.
    assert_eq!(night.visual_range.threshold.name, "night");
    near(night.visual_range.rvr_koschmieder_m, 300.0, 1e-9);

    // The same by bright day: 1e-3 lx.
    let day = approach(&eye, &row, sigma, 20_000.0);
    assert_eq!(day.visual_range.threshold.name, "bright_day");
    assert_eq!(day.lights[0].visible, (allard_m(5000.0, 1e-3, sigma) / 15.0).floor() as usize);
}

#[test]
fn runway_visual_range_is_that_of_its_lights() {
    let sigma = MOR_OPTICAL_DEPTH / 200.0;
    let lamps = [lamp("edge_light_000", -500.0, 10_000.0), lamp("centre_line_light_000", -500.0, 5000.0)];
    let eye = camera(0.0, 61.0, 900.0);
    let night = approach(&eye, &lamps, sigma, 1.0).visual_range;
    let alone = [5000.0, 10_000.0].map(|cd| allard_m(cd, 8e-7, sigma));
    assert!((alone[0]..alone[1]).contains(&night.rvr_allard_m), "{night:?}");
    near(night.rvr_m, night.rvr_allard_m, 0.0);
    assert_eq!(night.category, if night.rvr_m >= 550.0 { "CAT I" } else { "CAT II" });
    assert_eq!(night.decision_heights.iter().map(|d| d.reached).collect::<Vec<_>>(), [false, false]);
    let low = approach(&camera(0.0, 45.0, 600.0), &lamps, sigma, 1.0).visual_range;
    assert_eq!(low.decision_heights.iter().map(|d| d.reached).collect::<Vec<_>>(), [true, false]);
    // Dark lights leave the markings.
    let dark = approach(&eye, &[], sigma, 1.0).visual_range;
    assert_eq!((dark.rvr_allard_m, dark.rvr_reported.as_str(), dark.category), (0.0, "0200", "CAT IIIA"));
}

#[test]
fn ground_and_markings_are_seen_at_five_percent() {
    let sigma = 0.01;
    let slant: f64 = MOR_OPTICAL_DEPTH / sigma;
    let seen = approach(&camera(0.0, 100.0, 500.0), &[], sigma, 5000.0).visual_range;
    near(seen.ground_seen_ahead_m, (slant * slant - 100.0 * 100.0).sqrt(), 1e-6);
    near(seen.tau_to_threshold, sigma * (500.0f64 * 500.0 + 100.0 * 100.0).sqrt(), 1e-6);
    assert!(!seen.threshold_markings_in_sight);
    assert!(approach(&camera(0.0, 50.0, 290.0), &[], sigma, 5000.0).runway_in_sight);
    assert_eq!(
        approach(&camera(0.0, 400.0, 500.0), &[], sigma, 5000.0).visual_range.ground_seen_ahead_m,
        0.0
    );
    let clear = approach(&camera(0.0, 100.0, 500.0), &[], 0.0, 5000.0).visual_range;
    assert!(clear.ground_seen_ahead_m.is_infinite() && clear.rvr_m.is_infinite());
    assert_eq!((clear.rvr_reported.as_str(), clear.transmittance_to_threshold), ("P2000", 1.0));
    assert_eq!(json!(clear)["mor_m"], Value::Null);
}

#[test]
fn beams_sides_and_obstacles_count() {
    let towards = |axis: Vec3A| Pattern::Cone(Cone { axis, cos_inner: 0.99, cos_outer: 0.95 });
    let mut lamps = vec![
        lamp("approach_light_000_white_to_approach", 300.0, 1e4),
        lamp("approach_light_001_white_to_approach", 300.0, 1e4),
        lamp("edge_light_000_white_to_far_end", -50.0, 1e4),
        lamp("approach_light_002", 900.0, 1e4),
        lamp("tree_000", 100.0, 1e4),
    ];
    lamps[0].lamp.pattern = towards(Vec3A::Z);
    lamps[1].lamp.pattern = towards(Vec3A::new(0.0, 0.6, 0.8));
    lamps[2].lamp.pattern = towards(Vec3A::NEG_Z);
    let eye = camera(0.0, 10.0, 500.0);
    let clear = approach(&eye, &lamps, 0.0, 0.0);
    // One is in its beam; one shines over the eye; one is behind it; the edge light's beam is for the other end; a tree is no light.
    assert_eq!(clear.lights.len(), 1, "{:?}", clear.lights);
    assert_eq!((clear.lights[0].lamps, clear.lights[0].visible, clear.lights[0].in_picture), (3, 1, 1));
    assert!(clear.approach_lights_in_sight);
    let wall = Air { tau: &|_, _| 0.0, sigma_t_1_m: 0.0, hidden: &|_, _| true };
    let hidden = aviation(&north(), &eye, &lamps, &wall, 0.0).expect("in range");
    assert!(hidden.lights[0].visible == 0 && !hidden.approach_lights_in_sight && !hidden.runway_in_sight);
    assert_eq!(hidden.visible_segment, None);
}

#[test]
fn a_gap_ends_the_segment() {
    // Every 30 m from 900 m before the threshold; those between 500 and 400 m are dark.
    let lamps: Vec<RunwayLamp> = (0..31)
        .map(|i| 900.0 - 30.0 * i as f32)
        .map(|z| lamp("approach_light_000", z, if (400.0..500.0).contains(&z) { 0.0 } else { 2e4 }))
        .collect();
    let segment = approach(&camera(0.0, 60.0, 1000.0), &lamps, 0.0, 0.0).visible_segment.expect("some");
    assert_eq!((segment.from_m, segment.to_m, segment.length_m, segment.lights), (900.0, 510.0, 390.0, 14));
    // Alone lamps of a bar across are one place.
    let bar: Vec<RunwayLamp> = (0..5).map(|_| lamp("approach_light_000", 300.0, 2e4)).collect();
    let bar = approach(&camera(0.0, 60.0, 1000.0), &bar, 0.0, 0.0);
    assert_eq!(bar.visible_segment.map(|s| (s.length_m, s.lights)), Some((0.0, 1)));
    assert!(!bar.three_consecutive_lights);
}

#[test]
fn the_papi_counts_its_units() {
    let mut lamps = Vec::new();
    for unit in 0..4 {
        let [mut white, mut red] =
            ["white", "red"].map(|colour| lamp(&format!("papi_{unit}_{colour}"), -300.0, 15_000.0));
        (red.lamp.intensity[1], red.lamp.intensity[2]) = (0.0, 0.0);
        // The inner two look red, the outer two white.
        let dim = if unit < 2 { &mut white } else { &mut red };
        dim.lamp.intensity = dim.lamp.intensity.map(|c| 0.01 * c);
        lamps.extend([white, red]);
    }
    let seen = approach(&camera(0.0, 60.0, 1000.0), &lamps, 0.001, 0.0);
    assert_eq!(seen.papi, Some([2, 2]));
    assert!(seen.runway_in_sight);
}

#[test]
fn a_scene_tells_its_runway() {
    let extras = json!({"runway": {
        "threshold_corners_m": [[-22.5, 4, 0], [22.5, 4, 0]], "end_corners_m": [[-22.5, 4, -2500], [22.5, 4, -2500]],
        "aiming_point_m": [0, 4, -310], "glide_path_deg": 3.2}});
    let site = RunwaySite::new(None, &extras).expect("a runway");
    assert_eq!((site.threshold_m, site.heading_deg), ([0.0, 4.0, 0.0], 0.0));
    assert_eq!(
        (site.length_m, site.width_m, site.touchdown_m, site.glide_slope_deg),
        (2500.0, 45.0, 310.0, 3.2)
    );
    for broken in ["threshold_corners_m", "end_corners_m"] {
        let mut extras = extras.clone();
        extras["runway"][broken] = json!([[1, 2], "x"]);
        assert_eq!(RunwaySite::new(None, &extras), None);
    }
    assert_eq!(RunwaySite::new(None, &Value::Null), None);
    let spec = fog_plan::RunwaySpec { glide_slope_deg: Some(4.0), ..Default::default() };
    assert_eq!(RunwaySite::new(Some(&spec), &extras).map(|site| site.glide_slope_deg), Some(4.0));
    assert_eq!(RunwaySite::new(Some(&spec), &Value::Null), None);
}
