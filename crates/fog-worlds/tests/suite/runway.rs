//! The runway measured: markings by rays from above, lights by their candelas and beams.

use super::common::{Made, made, translation};
use fog_core::Vec3A;
use fog_scene::lamp::Lamp;
use fog_worlds::{ApproachLights, Runway, World};

const FT: f32 = 0.3048;

fn runway(options: Runway) -> Made {
    made(&World::Runway(options))
}

#[test]
fn markings_lie_where_the_circular_has_them() {
    let made = runway(Runway::default());
    // Inside by 5 cm and outside by 5 cm of an edge, in feet along and to the right.
    let edge = |inside: [f32; 2], outside: [f32; 2]| {
        let class = |[along, right]: [f32; 2]| made.below(right, -along);
        assert_eq!(class(inside), "runway marking", "{inside:?}");
        assert_eq!(class(outside), "runway", "{outside:?}");
    };
    let d = 0.05;
    // Aiming point: 1020 ft from the threshold, 150 ft long, 36 to 66 ft from the centre line.
    let (near, far, inner, outer) = (1020.0 * FT, 1170.0 * FT, 36.0 * FT, 66.0 * FT);
    for side in [-1.0, 1.0] {
        let middle = side * 50.0 * FT;
        edge([near + d, middle], [near - d, middle]);
        edge([far - d, middle], [far + d, middle]);
        edge([near + 10.0, side * (inner + d)], [near + 10.0, side * (inner - d)]);
        edge([near + 10.0, side * (outer - d)], [near + 10.0, side * (outer + d)]);
    }
    // Threshold stripes: 20 ft to 170 ft, the innermost 5.75 to 11.5 ft from the centre line; twelve of them.
    let stripe = 8.0 * FT;
    edge([20.0 * FT + d, stripe], [20.0 * FT - d, stripe]);
    edge([170.0 * FT - d, stripe], [170.0 * FT + d, stripe]);
    let painted: Vec<bool> =
        (-427..430).map(|i| made.below(0.05 * i as f32, -20.0) == "runway marking").collect();
    // Twelve stripes, the side stripes not among them.
    assert_eq!(painted.windows(2).filter(|p| !p[0] && p[1]).count(), 12);
    // Touchdown zone: three bars a side at 500 ft; side stripe 3 ft wide at the edge.
    let bars = |along: f32| {
        let row: Vec<bool> =
            (0..400).map(|i| made.below(0.05 * i as f32, -along) == "runway marking").collect();
        row.windows(2).filter(|p| !p[0] && p[1]).count()
    };
    let counts: Vec<usize> = [500.0, 1500.0, 2000.0, 2500.0].map(|ft| bars((ft + 20.0) * FT)).to_vec();
    assert_eq!(counts, [3, 2, 2, 1]);
    edge([600.0, 22.5 - 0.9], [600.0, 22.5 - 0.92]);
    // The far end is the same turned around.
    assert_eq!(made.below(-50.0 * FT, -(2500.0 - near - d)), "runway marking");
    assert_eq!(made.below(-50.0 * FT, -(2500.0 - near + d)), "runway");
    assert_eq!(made.below(0.0, -10.0), "runway");
    assert_eq!(made.below(100.0, -1700.0), "terrain");
}

/// Candela of all lamps whose node's name begins so, each as often as it stands there.
fn candelas(made: &Made, prefix: &str) -> Vec<f64> {
    let lights = &made.json["extensions"]["KHR_lights_punctual"]["lights"];
    let light = |node: &&serde_json::Value| node["extensions"]["KHR_lights_punctual"]["light"].as_u64();
    let of = |i: u64| lights[i as usize]["extras"]["candela"].as_f64().unwrap();
    made.nodes(prefix).iter().filter_map(light).map(of).collect()
}

#[test]
fn lights_have_their_numbers_and_candelas() {
    let made = runway(Runway::default());
    let all = |prefix: &str, n: usize, candela: f64| {
        let found = candelas(&made, prefix);
        assert_eq!((found.len(), found.iter().all(|&c| c == candela)), (n, true), "{prefix}: {found:?}");
    };
    // 24 bars of five, 16 more in the 1000-ft bar, 8 in the 500-ft bar.
    all("approach_light", 24 * 5 + 16 + 8, 20_000.0);
    all("side_row_light", 9 * 6, 5_000.0);
    all("end_light", 16, 2_500.0);
    // The bar of the ALSF-2 over 150 ft and 45 ft on both sides, every 5 ft; eight at the far end.
    all("threshold_light", 49 - 2 + 8, 10_000.0);
    all("touchdown_zone_light", 30 * 6, 5_000.0);
    let edges = candelas(&made, "edge_light");
    assert_eq!(edges.len(), 2 * 2 * 43);
    assert!(edges.iter().all(|&c| (c - 10_000.0).abs() < 1.0 || (c - 4_000.0).abs() < 1.0));
    // Yellow in the last 2000 ft of both directions: 11 of 43 on each side.
    assert_eq!(edges.iter().filter(|&&c| c < 5_000.0).count(), 2 * 2 * 11);
    // Spacing at most 200 ft.
    let edge_nodes = made.nodes("edge_light_000");
    let z = |i: usize| translation(made.nodes(&format!("edge_light_{i:03}"))[0])[2];
    assert!(!edge_nodes.is_empty() && (z(0) - z(2)).abs() <= 200.0 * FT);
    // Dimmed to a fifth, all lamps are.
    let dim = runway(Runway { lights_percent: 20.0, ..Runway::default() });
    let sum = |made: &Made| made.scene.lights.lamps.iter().map(|l| f64::from(l.strength())).sum::<f64>();
    assert!((sum(&dim) / sum(&made) - 0.2).abs() < 1e-4);
    // Other systems.
    let malsr = runway(Runway { approach: ApproachLights::Malsr, flashers: true, ..Runway::default() });
    assert_eq!(candelas(&malsr, "approach_light").len(), 7 * 5 + 10);
    assert_eq!(candelas(&malsr, "flasher").len(), 5);
    let none = runway(Runway { approach: ApproachLights::None, ..Runway::default() });
    assert_eq!((candelas(&none, "approach").len(), candelas(&none, "threshold_light").len()), (0, 16));
}

/// Candela of a lamp towards an azimuth (to the right of the pilot who comes in, who is seen along +Z) and an elevation.
fn candela(lamp: &Lamp, left_deg: f32, up_deg: f32) -> f32 {
    let sin_cos = |deg: f32| {
        let r = f64::from(deg).to_radians();
        (fog_core::math::f64::sin(r) as f32, fog_core::math::f64::cos(r) as f32)
    };
    let ((sl, cl), (su, cu)) = (sin_cos(left_deg), sin_cos(up_deg));
    let [r, g, b] = lamp.intensity;
    (0.2126 * r + 0.7152 * g + 0.0722 * b) * lamp.falloff(Vec3A::new(cu * sl, su, cu * cl))
}

/// Lamps whose node's name begins so.
fn lamps<'a>(made: &'a Made, prefix: &str) -> Vec<&'a Lamp> {
    let names = made.scene.light_names.lamps.iter().zip(&made.scene.lights.lamps);
    names.filter(|(name, _)| name.starts_with(prefix)).map(|(_, lamp)| lamp).collect()
}

#[test]
fn papi_changes_colour_at_its_angles() {
    let made = runway(Runway::default());
    // Innermost first; white and red of each unit.
    for (unit, boundary) in [3.5f32, 3.0 + 1.0 / 6.0, 3.0 - 1.0 / 6.0, 2.5].into_iter().enumerate() {
        let lamp = |colour: &str| lamps(&made, &format!("papi_{unit}_{colour}"))[0];
        let (white, red) = (lamp("white"), lamp("red"));
        let aside = -(22.5 + (50.0 + 30.0 * unit as f32) * FT);
        assert!((white.position.x - aside).abs() < 0.01 && white.position == red.position);
        for aside in [0.0f32, -3.0, 5.0] {
            // Two minutes of arc over and under the boundary, which sinks by its own cosine away from the axis.
            let here = boundary * fog_core::math::f32::cos(aside.to_radians());
            let [over, under] = [here + 2.0 / 60.0, here - 2.0 / 60.0];
            assert!(candela(white, aside, over) > 10_000.0 && candela(red, aside, over) == 0.0, "{unit}");
            assert!(candela(red, aside, under) > 5_000.0 && candela(white, aside, under) == 0.0, "{unit}");
        }
        // Half of each on the boundary; 30,000 and 15,000 cd beside it.
        assert!(
            (candela(white, 0.0, boundary) - 15_000.0).abs() < 300.0,
            "{}",
            candela(white, 0.0, boundary)
        );
        assert!((candela(red, 0.0, boundary) - 7_500.0).abs() < 150.0, "{}", candela(red, 0.0, boundary));
        assert!((candela(white, 0.0, boundary + 0.03) - 30_000.0).abs() < 100.0);
        assert!((candela(red, 0.0, boundary - 0.03) - 15_000.0).abs() < 50.0);
    }
}

#[test]
fn beams_have_the_candelas_of_their_figures() {
    let made = runway(Runway::default());
    // Name, average intensity, elevation and toe-in of the axis, half-axes of main beam and outermost curve.
    for (prefix, average, up, toe, [a, b], [c, d]) in [
        ("approach_light_119", 20_000.0, 8.0, 0.0, [10.0, 5.5], [15.0, 8.5]),
        ("side_row_light_000", 5_000.0, 5.5, 2.0, [7.0, 5.0], [16.5, 8.0]),
        ("threshold_light_030", 10_000.0, 4.5, 0.0, [5.5, 4.5], [9.0, 8.5]),
        ("edge_light_000_white_to_approach", 10_000.0, 3.5, 3.5, [5.5, 3.5], [9.0, 8.5]),
        ("touchdown_zone_light_000", 5_000.0, 5.5, 4.0, [5.0, 3.5], [8.5, 8.5]),
        ("centre_line_light_000_white_to_approach", 5_000.0, 3.5, 0.0, [5.0, 3.5], [8.5, 8.5]),
    ] {
        let found = lamps(&made, prefix);
        assert_eq!(found.len(), 1, "{prefix}");
        let lamp = found[0];
        // Towards the centre line, that is to +X for a light on the left.
        let toe: f32 = if lamp.position.x < 0.0 { toe } else { -toe };
        for (left, above, want, allowed) in [
            (0.0, 0.0, 1.5, 0.002),
            (a, 0.0, 0.5, 0.02),
            (0.0, b, 0.5, 0.02),
            (0.0, -b, 0.5, 0.02),
            // Azimuths are those of the tilted lamp.
            (c, 0.0, 0.05, 0.01),
            (0.0, d, 0.05, 0.005),
        ] {
            let got = candela(lamp, toe + left, up + above) / average;
            assert!((got - want).abs() < allowed, "{prefix} at {left}, {above}: {got} for {want}");
        }
        assert_eq!(candela(lamp, 180.0, 0.0), 0.0);
    }
}

#[test]
fn approach_beams_look_up_the_glide_path() {
    let made = runway(Runway::default());
    let farthest = made.scene.lights.lamps.iter().filter(|l| (l.position.z - 2400.0 * FT).abs() < 0.5);
    let farthest: Vec<&Lamp> = farthest.collect();
    assert_eq!(farthest.len(), 5);
    for lamp in farthest {
        // 8° up (CS-ADR-DSN, Fig. U-5), and 40.5 in apart.
        let up = lamp.axis().unwrap().y;
        assert!((up - fog_core::math::f32::sin(8.0f32.to_radians())).abs() < 1e-4, "{up}");
        let slot = lamp.position.x / (40.5 / 12.0 * FT);
        assert!((slot - slot.round()).abs() < 1e-3);
    }
}
