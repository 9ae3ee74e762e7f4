//! Thin and thick layers of the advection fog, with its own phase functions, against the discrete-ordinate method
//! (tests/data/fog_layers_*.csv, made by tools/tables/fog_layers_disort.py): four heights of the sun, three wavelengths.

use crate::radiances::travel;
use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::{LANES, Wavelengths};
use fog_core::{Vec3A, warp};
use fog_optics::advection::AdvectionModel;
use fog_optics::{layer, table};
use fog_scene::camera::Ray;
use fog_scene::light::Sun;
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;
use fog_tests::{csv, scenes};
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use rayon::prelude::*;
use std::collections::HashMap;

const WAVELENGTHS_NM: [f32; 3] = [450.0, 550.0, 650.0];
const HEIGHT_M: f64 = 180.0;
/// Paths are traced in so many independent parts, whose means tell the error.
const PARTS: u64 = 64;

/// The layer scaled to this optical depth at 550 nm, checked against the file's depths at all wavelengths.
fn fog(tau: f64, rows: &[HashMap<String, f64>]) -> Medium {
    let model = AdvectionModel::arcata().unwrap();
    let settings = table::TableSettings {
        wavelengths_nm: WAVELENGTHS_NM.map(f64::from).to_vec(),
        ..table::TableSettings::visible(&model)
    };
    let optics = table::build_table(&model, &settings, &|_| ()).unwrap();
    let profile = |scale| layer::advection(&optics, &model, HEIGHT_M, scale).unwrap().profile(0.0).unwrap();
    let depth = |scale, nm| profile(scale).optical_depth_at(0.0, 1.0, 2.0 * HEIGHT_M, nm);
    let scale = tau / depth(1.0, 550.0);
    for row in rows {
        let got = depth(scale, row["wavelength_nm"]);
        assert!((got / row["tau"] - 1.0).abs() < 1e-3, "optical depth {got} for {}", row["tau"]);
    }
    Medium::new(profile(scale), Phase::Table(optics))
}

/// Light that leaves the layer: a row of the file without its wavelength. Without a direction it is a flux.
#[derive(Clone, Copy, Debug)]
struct Place {
    top: bool,
    direction: Option<[f64; 2]>,
}

impl Place {
    /// A ray against the light, and what its radiance counts.
    fn ray(&self, rng: &mut PathRng) -> (Ray, f64) {
        let (y, up) = if self.top { (HEIGHT_M as f32 + 1.0, 1.0) } else { (1e-3, -1.0) };
        let (travel, weight) = match self.direction {
            Some([mu, phi_deg]) => (travel(mu, phi_deg), 1.0),
            None => {
                let w = warp::cosine_hemisphere(rng.uniform2());
                (Vec3A::new(w.x, up * w.z, w.y), std::f64::consts::PI)
            }
        };
        (Ray { origin: Vec3A::new(0.0, y, 0.0), direction: -travel }, weight)
    }
}

/// Means at some wavelengths, from paths that carry all of them: each of the lanes is the hero of as many paths.
fn seen(scene: &Scene, place: &Place, paths: u64, wavelengths_nm: &[f32], seed: u64) -> Vec<Moments> {
    let observer = Observer::new();
    let settings = Settings { samples: paths, max_depth: None, wavelength_nm: Some(550.0), stop: None };
    let tracer = PathTracer::new(scene, &observer, settings);
    let each = (paths / PARTS).next_multiple_of(LANES as u64);
    (0..PARTS)
        .into_par_iter()
        .map(|part| {
            let mut sums = vec![0.0; wavelengths_nm.len()];
            for s in 0..each {
                let mut rng = PathRng::new(seed, part, s);
                // First flights are stratified within the paths of one hero.
                let (hero, turn) = ((s % LANES as u64) as usize, s / LANES as u64);
                let nm =
                    core::array::from_fn(|lane| wavelengths_nm[(lane + hero) % LANES % wavelengths_nm.len()]);
                let (ray, weight) = place.ray(&mut rng);
                let first = (turn as f32 + rng.uniform()) / (each / LANES as u64) as f32;
                let radiance =
                    tracer.radiance(ray, &Wavelengths { nm }, first.min(0.999_999), &mut rng).radiance;
                for (sum, &wanted) in sums.iter_mut().zip(wavelengths_nm) {
                    let lane = nm.iter().position(|&nm| nm == wanted).expect("every wavelength is carried");
                    *sum += weight * f64::from(radiance[lane]) / each as f64;
                }
            }
            sums
        })
        .collect::<Vec<_>>()
        .iter()
        .fold(vec![Moments::default(); wavelengths_nm.len()], |mut all, sums| {
            all.iter_mut().zip(sums).for_each(|(moments, &mean)| moments.add(mean));
            all
        })
}

/// A file and how it is compared.
struct Case {
    file: &'static str,
    tau: f64,
    ground: Option<f32>,
    sun_diameter_deg: f64,
    /// Paths carry all wavelengths; in deep fog those drift apart, and each has paths of its own.
    together: bool,
    /// Paths a place and set of wavelengths.
    paths: u64,
    /// Standard errors are at most this share of the values.
    resolution: f64,
}

/// Renders the rows that `chosen` takes; each must be within 1 % or 4 standard errors.
fn compare(case: &Case, chosen: impl Fn(&Place) -> bool) {
    let Case { file, tau, ground, sun_diameter_deg, together, paths, resolution } = *case;
    let (rows, levels) = (csv::rows(file), csv::text_column(file, "level"));
    let medium = fog(tau, &rows);
    let loaded = ground.map_or_else(scenes::empty, scenes::lambertian_ground);
    let third = rows.len() / 3;
    let (mut compared, mut failures) = (0u32, Vec::new());
    let (mut deviations, mut ratios, mut variance) = (Moments::default(), 0.0, 0.0);
    for i in 0..third {
        let direction = rows[i].get("mu").map(|&mu| [mu, rows[i]["phi_deg"]]);
        let place = Place { top: levels[i] == "top", direction };
        if !chosen(&place) {
            continue;
        }
        let sun = Sun::new(90.0 - rows[i]["sun_zenith_deg"], 180.0, 1.0, sun_diameter_deg);
        let scene = Scene::new(loaded.clone(), Some(medium.clone()), None, Some(sun), false);
        let sets = WAVELENGTHS_NM.chunks(if together { 3 } else { 1 });
        let all = sets.flat_map(|nm| seen(&scene, &place, paths, nm, 83 + 1000 * i as u64 + nm[0] as u64));
        for (k, seen) in all.enumerate() {
            let row = &rows[i + k * third];
            assert_eq!(row["wavelength_nm"], f64::from(WAVELENGTHS_NM[k]));
            let (want, got, error) = (row["value"], seen.mean(), seen.standard_error());
            let text = format!(
                "{} nm, sun at {}°, {place:?}: {got:.6} ± {error:.6} for {want:.6} ({:+.2} %, {:+.1} s.e.)",
                row["wavelength_nm"],
                row["sun_zenith_deg"],
                100.0 * (got / want - 1.0),
                (got - want) / error
            );
            println!("{text}");
            if (got - want).abs() >= (0.01 * want).max(4.0 * error) {
                failures.push(text.clone());
            }
            assert!(error < resolution * want, "too noisy to tell: {text}");
            deviations.add(((got - want) / error).powi(2));
            ratios += got / want;
            variance += (error / want).powi(2);
            compared += 1;
        }
    }
    // Wavelengths of the same paths err together. All rows count alike: weights by their errors would favour low values.
    let n = f64::from(compared);
    let (off, error) = (ratios / n - 1.0, (if together { 3.0 } else { 1.0 } * variance).sqrt() / n);
    println!(
        "{file}: {compared} compared, together off by {:+.3} % ± {:.3} %, mean square {:.2} s.e.²",
        100.0 * off,
        100.0 * error,
        deviations.mean()
    );
    assert!(off.abs() < 4.0 * error + 1e-3, "{file}: together off by {off} ± {error}");
    assert!(deviations.mean() < 2.0, "{file}: mean square of the deviations {}", deviations.mean());
    assert!(failures.is_empty(), "{file}: {failures:#?}");
    assert!(compared >= 24, "{file}: only {compared} compared");
}

#[test]
fn thin_layer() {
    // Not the flux at the bottom: half of it comes from within a degree of the sun, where few of its rays would point.
    let chosen = |p: &Place| p.top || p.direction.is_some();
    let case = Case {
        file: "fog_layers_thin.csv",
        tau: 0.1,
        ground: None,
        sun_diameter_deg: 0.0,
        together: true,
        paths: 60_000,
        resolution: 0.08,
    };
    compare(&case, chosen);
}

#[test]
fn thick_layer() {
    let case = Case {
        file: "fog_layers_thick.csv",
        tau: 20.0,
        ground: Some(0.3),
        sun_diameter_deg: 16.0,
        together: false,
        paths: 20_000,
        resolution: 0.2,
    };
    compare(&case, |_| true);
}
