//! The street in layered fog against Mitsuba 3 (tests/data/street_grey_*_reference.csv), as radiance and block by block.

use fog_optics::{layer, layer_csv};
use fog_scene::light::Environment;
use fog_scene::scene::Scene;
use fog_tests::{csv, data, scenes};

const COLUMNS: usize = 16;
const ROWS: usize = 9;
const BLOCK: usize = 30;

fn street(file: &str, day: bool) -> Scene {
    let text = std::fs::read_to_string(data("fog_layers.csv")).unwrap();
    let rows = layer_csv::parse_layers(&text, "fog_layers.csv").unwrap();
    let profile = layer::layered(&rows, 1.0).unwrap().profile(0.0).unwrap();
    let environment = day.then_some(Environment { radiance: 1.0 });
    Scene::new(scenes::load(file), Some(scenes::hg_fog(profile, 0.83)), environment, None, !day)
}

/// Compares the means of the whole image (relative tolerance) and of each block (1 % or 4 standard errors of both).
fn compare(scene: &Scene, reference: &str, mean_tolerance: f64, samples: u64, channels: &[usize]) {
    let camera = scenes::camera(1.7, 0.0, 0.0, 480, 270, 60.0);
    let frame = scenes::render(scene, &camera, samples, None, 1);
    let names = ["r", "g", "b"];
    let rows = csv::rows(reference);
    assert_eq!(rows.len(), COLUMNS * ROWS);
    for &c in channels {
        let want = rows.iter().map(|r| r[&format!("mean_{}", names[c])]).sum::<f64>() / rows.len() as f64;
        let got = scenes::mean(&frame, c);
        println!("{reference}, {}: mean {got:.5} for {want:.5} ({:+.3} %)", names[c], 100.0 * (got / want - 1.0));
        assert!((got / want - 1.0).abs() < mean_tolerance, "{reference}: mean {got} for {want}");
    }
    let mut worst = 0.0f64;
    for (k, row) in rows.iter().enumerate() {
        let (x0, y0) = (k % COLUMNS * BLOCK, k / COLUMNS * BLOCK);
        let pixels = (0..BLOCK * BLOCK).map(|i| (y0 + i / BLOCK) * 480 + x0 + i % BLOCK);
        let variance: f64 = pixels.clone().map(|i| f64::from(frame.standard_error[i]).powi(2)).sum();
        for &c in channels {
            let n = (BLOCK * BLOCK) as f64;
            let got = pixels.clone().map(|i| f64::from(frame.image(i)[c])).sum::<f64>() / n;
            let (want, se) = (row[&format!("mean_{}", names[c])], row[&format!("se_{}", names[c])]);
            // A channel's own noise is at most about three times that of the luminance.
            let error = se.hypot(3.0 * variance.sqrt() / n);
            let off = (got - want).abs();
            worst = worst.max(off / want);
            assert!(
                off < 0.01 * want || off < 4.0 * error,
                "{reference}, block {k} channel {c}: {got} for {want} ± {error}"
            );
        }
    }
    println!("{reference}: worst block off by {:.2} %", 100.0 * worst);
}

#[test]
fn grey_day() {
    compare(&street("street_grey.glb", true), "street_grey_day_reference.csv", 0.005, 96, &[0, 1, 2]);
}

#[test]
fn grey_night() {
    let scene = street("street_grey_night.glb", false);
    compare(&scene, "street_grey_night_reference.csv", 0.005, 64, &[0, 2]);
}
