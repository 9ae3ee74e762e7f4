//! Reciprocity of whole layers: light that goes from one direction to another is as much as on the way back. Those of the
//! surfaces are in `samplers` and `materials`.

use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_core::{Vec3A, math};
use fog_scene::LoadedScene;
use fog_scene::camera::Ray;
use fog_scene::light::Sun;
use fog_scene::medium::Medium;
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use rayon::prelude::*;
use std::sync::Arc;

const HEIGHT_M: f64 = 60.0;

/// Elevation (of the sun, or of the line of sight away from the layer) and azimuth in degrees; elevations below 0 are seen
/// from below.
type Direction = (f64, f64);

/// Radiance that leaves the layer towards `to` for a beam of unit irradiance from `from`, over the sine of the beam's
/// elevation: a reflectance or transmittance distribution, in 1/sr.
fn distribution(loaded: &Arc<LoadedScene>, fog: &Medium, from: Direction, to: Direction) -> Moments {
    let sun = Sun::new(from.0, from.1, 1.0, 0.0);
    let scene = Scene::new(loaded.clone(), Some(fog.clone()), None, Some(sun), false);
    let observer = Observer::new();
    let settings = Settings { samples: 1, max_depth: None, wavelength_nm: Some(600.0), stop: None };
    let tracer = PathTracer::new(&scene, &observer, settings);
    let away = Sun::new(to.0, to.1, 1.0, 0.0).direction;
    let y = if to.0 > 0.0 { HEIGHT_M as f32 + 1.0 } else { -1.0 };
    let ray = Ray { origin: Vec3A::new(0.0, y, 0.0), direction: -away };
    let scale = 1.0 / math::f64::sin(from.0.to_radians()).abs();
    (0..64u64)
        .into_par_iter()
        .map(|chunk| {
            let mut moments = Moments::default();
            for s in 0..1500 {
                let mut rng = PathRng::new(91, chunk, s);
                let first = rng.uniform();
                let path = tracer.radiance(ray, &Wavelengths::monochromatic(600.0), first, &mut rng);
                moments.add(scale * f64::from(path.radiance[0]));
            }
            moments
        })
        .reduce(Moments::default, Moments::merge)
}

fn assert_reciprocal(name: &str, loaded: &Arc<LoadedScene>, fog: &Medium, pairs: &[(Direction, Direction)]) {
    for &(a, b) in pairs {
        let (there, back) = (distribution(loaded, fog, a, b), distribution(loaded, fog, b, a));
        let error = there.standard_error().hypot(back.standard_error());
        let (x, y) = (there.mean(), back.mean());
        println!("{name} {a:?} {b:?}: {x:.5} and {y:.5} ± {error:.5}");
        assert!((x - y).abs() < 4.5 * error, "{name}, {a:?} to {b:?}: {x} there and {y} back, ± {error}");
        assert!(error < 0.05 * x, "{name}, {a:?} to {b:?}: too noisy to tell, {x} ± {error}");
    }
}

/// Layers that differ between their base and their top in extinction, and one in its phase function as well.
fn fogs() -> [(&'static str, Medium); 2] {
    let grey = scenes::grey_profile(HEIGHT_M, &[0.04, 0.01, 0.002, 0.03], 0.98);
    [("grey", scenes::hg_fog(grey, 0.6)), ("coloured", scenes::coloured_fog(HEIGHT_M, 0.03, 1.0))]
}

#[test]
fn reflection_by_layers_over_a_ground() {
    let ground = scenes::lambertian_ground(0.4);
    let pairs = [((70.0, 0.0), (20.0, 30.0)), ((15.0, 180.0), (50.0, 0.0)), ((40.0, 90.0), (10.0, 0.0))];
    for (name, fog) in fogs() {
        assert_reciprocal(name, &ground, &fog, &pairs);
    }
}

#[test]
fn transmission_through_layers() {
    let pairs = [((70.0, 0.0), (-20.0, 30.0)), ((15.0, 180.0), (-50.0, 60.0)), ((40.0, 90.0), (-80.0, 0.0))];
    for (name, fog) in fogs() {
        assert_reciprocal(name, &scenes::empty(), &fog, &pairs);
    }
}
