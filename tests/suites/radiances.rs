//! Radiances of plane-parallel fog against the discrete-ordinate method (tests/data/fog_radiance_*.csv).

use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_core::{Vec3A, math};
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

/// Directions closer than this to the beam's own are left out.
const BEAM_DEG: f64 = 2.0;

/// Light that travels with this direction cosine to the vertical and azimuth from the beam's own (which is −Z).
pub(crate) fn travel(mu: f64, phi_deg: f64) -> Vec3A {
    let s = (1.0 - mu * mu).sqrt();
    let phi = phi_deg.to_radians();
    Vec3A::new((s * math::f64::sin(phi)) as f32, mu as f32, (-s * math::f64::cos(phi)) as f32).normalize()
}

fn compare(file: &str, medium: Medium, sun_zenith_deg: f64, ground_albedo: f32, paths: u64) {
    // The beam travels towards −Z (north), so the sun stands in the south.
    let sun = Sun::new(90.0 - sun_zenith_deg, 180.0, 1.0, 0.0);
    let (base, top) = (medium.profile().base_y(), medium.profile().top_y());
    let scene = Scene::new(scenes::lambertian_ground(ground_albedo), Some(medium), None, Some(sun), false);
    let observer = Observer::new();
    let settings = Settings { samples: paths, max_depth: None, wavelength_nm: Some(550.0), stop: None };
    let tracer = PathTracer::new(&scene, &observer, settings);
    let wavelengths = Wavelengths::monochromatic(550.0);
    let levels = csv::text_column(file, "level");
    let (mut compared, mut worst, mut failures) = (0, 0.0f64, Vec::new());
    // Sums over the directions of relative differences and of their weights, which are inverse variances.
    let (mut all, mut weights) = (0.0, 0.0);
    for (row, level) in csv::rows(file).iter().zip(&levels) {
        let direction = travel(row["mu"], row["phi_deg"]);
        if f64::from(direction.dot(-sun.direction)).clamp(-1.0, 1.0) > math::f64::cos(BEAM_DEG.to_radians()) {
            continue;
        }
        let y = if level == "top" { top + 1.0 } else { base + 1e-3 };
        let ray = Ray { origin: Vec3A::new(0.0, y as f32, 0.0), direction: -direction };
        let sum = (0..100u64)
            .into_par_iter()
            .map(|chunk| {
                let mut m = Moments::default();
                for s in 0..paths / 100 {
                    let mut rng = PathRng::new(77, chunk, s);
                    let first = rng.uniform();
                    m.add(f64::from(tracer.radiance(ray, &wavelengths, first, &mut rng).radiance[0]));
                }
                m
            })
            .reduce(Moments::default, Moments::merge);
        let (want, got, error) = (row["radiance"], sum.mean(), sum.standard_error());
        let off = (got - want).abs();
        println!(
            "{level} mu {:.3} phi {}: {got:.6} ± {error:.6} for {want:.6} ({:+.2} %, {:+.1} s.e.)",
            row["mu"],
            row["phi_deg"],
            100.0 * (got / want - 1.0),
            (got - want) / error
        );
        if off >= 0.01 * want && off >= 3.0 * error {
            failures.push(format!("{level} {row:?}: {got} ± {error}"));
        }
        assert!(error < 0.02 * want, "{file}, {level} {row:?}: too noisy to tell, {got} ± {error}");
        compared += 1;
        let weight = (want / error).powi(2);
        all += weight * (got / want - 1.0);
        weights += weight;
        worst = worst.max(off / want);
    }
    println!("{file}: {compared} directions, worst {:.2} %", 100.0 * worst);
    let (all, error) = (all / weights, 1.0 / weights.sqrt());
    println!("{file}: together {:+.2} ± {:.2} %", 100.0 * all, 100.0 * error);
    assert!(all.abs() < 4.0 * error && error < 0.005, "{file}: together {all} ± {error}");
    assert!(failures.is_empty(), "{file}: {failures:#?}");
    assert!(compared >= 30, "{file}: only {compared} directions");
}

#[test]
fn henyey_greenstein_layer() {
    let profile = scenes::grey_profile(100.0, &[0.02, 0.02], 1.0);
    compare("fog_radiance_hg.csv", scenes::hg_fog(profile, 0.83), 60.0, 0.2, 200_000);
}

#[test]
fn advection_layer() {
    let model = AdvectionModel::arcata().unwrap();
    let settings =
        table::TableSettings { wavelengths_nm: vec![550.0], ..table::TableSettings::visible(&model) };
    let optics = table::build_table(&model, &settings, &|_| ()).unwrap();
    let profile = layer::advection(&optics, &model, 180.0, 1.0).unwrap().profile(0.0).unwrap();
    let depth = profile.optical_depth_at(0.0, 1.0, 200.0, 550.0);
    assert!((depth / 8.425_122 - 1.0).abs() < 3e-3, "optical depth {depth}");
    compare("fog_radiance_advection.csv", Medium::new(profile, Phase::Table(optics)), 45.0, 0.15, 600_000);
}
