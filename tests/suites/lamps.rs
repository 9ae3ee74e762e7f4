//! Lamps and beams: closed forms, quadrature, and the analog integrator, which connects to all of them everywhere.

use crate::analog::assert_agree;
use fog_core::colour::{Observer, upsample};
use fog_core::moments::Moments;
use fog_core::phase::HenyeyGreenstein;
use fog_core::profile::ExtinctionProfile;
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_core::{Vec3A, math};
use fog_scene::camera::Ray;
use fog_scene::ies::IesFile;
use fog_scene::lamp::{Beam, Cone, Lamp, LampTree, Measured, Pattern, PunctualLights};
use fog_scene::light_tree::Receiver;
use fog_scene::medium::Medium;
use fog_scene::phase::{Phase, PhaseView};
use fog_scene::phase_angles::PhaseAngles;
use fog_scene::scene::Scene;
use fog_scene::{Geometry, LoadedScene, Triangle};
use fog_tests::{chi_square, scenes};
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use glam::{Mat3A, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;

fn lit(scene: &LoadedScene, lamps: Vec<Lamp>, beams: Vec<Beam>) -> Arc<LoadedScene> {
    Arc::new(LoadedScene { lights: PunctualLights { lamps, beams }, ..scene.clone() })
}

fn point(x: f32, y: f32, z: f32, intensity: [f32; 3]) -> Lamp {
    Lamp::even(Vec3A::new(x, y, z), intensity)
}

fn spot(x: f32, y: f32, z: f32, intensity: f32, axis: Vec3A) -> Lamp {
    let cone = Cone { axis: axis.normalize(), cos_inner: 0.95, cos_outer: 0.7 };
    Lamp::spot(Vec3A::new(x, y, z), [intensity; 3], cone)
}

/// A lamp at a point whose axis looks down, from a file of I = `candela` cosⁿ θ in steps of a degree, in two planes.
fn measured(at: Vec3A, candela: f32, n: i32, lamp_from_world: Mat3A) -> Lamp {
    let angles: Vec<f64> = (0..=90).map(f64::from).collect();
    let row: Vec<String> =
        angles.iter().map(|a| format!("{}", math::f64::cos(a.to_radians()).max(0.0).powi(n))).collect();
    let (row, angles) = (row.join(" "), angles.iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
    let text = format!(
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 {candela} 91 2 1 2 0 0 0\n1 1 10\n{angles}\n0 90\n{row}\n{row}\n"
    );
    let photometry = IesFile::parse(&text).unwrap().photometry;
    let want = f64::from(candela) * 2.0 * PI / f64::from(n + 1);
    assert!((photometry.flux_lm() / want - 1.0).abs() < 1e-3, "{} lm for {want}", photometry.flux_lm());
    let pattern = Pattern::Measured(Measured { photometry: Arc::new(photometry), lamp_from_world });
    Lamp { pattern, ..Lamp::even(at, [candela; 3]) }
}

/// −Y of the world to −Z of a lamp.
fn looking_down() -> Mat3A {
    Mat3A::from_cols(Vec3A::X, Vec3A::Z, Vec3A::NEG_Y)
}

/// White of the three basis colours at one wavelength: 1 within 0.3 %.
fn white(nm: f64) -> f64 {
    let basis = Observer::new().lane_basis(&Wavelengths::monochromatic(nm as f32));
    f64::from(upsample([1.0; 3], &basis)[0])
}

/// Mean over paths along one ray, at one wavelength.
fn seen(scene: &Scene, ray: Ray, max_depth: Option<u32>, nm: f32, samples: u64) -> Moments {
    let observer = Observer::new();
    let tracer = PathTracer::new(
        scene,
        &observer,
        Settings { samples, max_depth, wavelength_nm: Some(nm), stop: None },
    );
    let mut moments = Moments::default();
    for s in 0..samples {
        let mut rng = PathRng::new(11, 0, s);
        let first = rng.uniform();
        let path = tracer.radiance(ray, &Wavelengths::monochromatic(nm), first, &mut rng);
        moments.add(f64::from(path.radiance[0] + path.glow[0]));
    }
    moments
}

#[test]
fn one_candela_over_a_ground() {
    // L = ρ/π · E, with E = I cos θ / d² of a lamp, and E cos θ of a beam; all over the luminance that 1 stands for.
    // 40 m wide: on the 400 km of the shared ground, places are known to a centimetre.
    let [a, b, c, d] =
        [(-20.0, -20.0), (-20.0, 20.0), (20.0, 20.0), (20.0, -20.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let triangles = vec![Triangle::flat([a, b, c]), Triangle::flat([a, c, d])];
    let geometry = Geometry::new(triangles, Vec::new());
    let ground = LoadedScene { geometry, ..(*scenes::lambertian_ground(0.4)).clone() };
    let down = Ray { origin: Vec3A::new(3.0, 2.0, 0.0), direction: Vec3A::NEG_Y };
    let lamp = lit(&ground, vec![point(0.0, 4.0, 0.0, [100.0; 3])], vec![]);
    let off_axis = lit(&ground, vec![spot(0.0, 4.0, 0.0, 100.0, Vec3A::NEG_Y)], vec![]);
    let direction = Vec3A::new(0.6, 0.8, 0.0);
    let beam = lit(&ground, vec![], vec![Beam { direction, illuminance: [5.0; 3] }]);
    let ies = lit(&ground, vec![measured(Vec3A::new(0.0, 4.0, 0.0), 100.0, 4, looking_down())], vec![]);
    let ramp: f64 = (0.8 - 0.7) / (0.95 - 0.7);
    let e = 100.0 * 0.8 / 25.0;
    for (name, loaded, want) in [
        ("point", lamp, e),
        ("spot", off_axis, e * ramp * ramp),
        ("measured", ies, e * 0.8f64.powi(4)),
        ("beam", beam, 5.0 * 0.8),
    ] {
        for luminance in [1.0, 50.0] {
            let scene = Scene::new(loaded.clone(), None, None, None, true).with_luminance_of_one(luminance);
            let got = seen(&scene, down, Some(2), 550.0, 4000);
            let want = want * 0.4 / PI / luminance * white(550.0).powi(2);
            let tolerance = 4.5 * got.standard_error() + 1e-3 * want;
            assert!((got.mean() - want).abs() < tolerance, "{name}: {} for {want}", got.mean());
        }
        let off = Scene::new(loaded, None, None, None, false);
        assert_eq!(seen(&off, down, None, 550.0, 10).mean(), 0.0, "{name} is switched off");
    }
}

const G: f64 = 0.6;

/// A thick layer with more red extinction than blue, at whose middle the camera stands.
fn layer() -> ExtinctionProfile {
    let sigma = vec![0.01, 0.03, 0.03, 0.05, 0.01, 0.02];
    ExtinctionProfile::new(0.0, vec![0.0, 50.0, 120.0], vec![400.0, 700.0], sigma, vec![0.9; 6]).unwrap()
}

/// ∫ σ_s T p(θ) T' I f / d² dt along the ray, by the midpoint rule.
fn single_scattering(profile: &ExtinctionProfile, ray: &Ray, lamps: &[Lamp], nm: f64, end: f64) -> f64 {
    let hg = HenyeyGreenstein::new(G).unwrap();
    let (y, dy) = (f64::from(ray.origin.y), f64::from(ray.direction.y));
    let n = 20_000;
    let sum: f64 = (0..n)
        .map(|i| {
            let t = end * (i as f64 + 0.5) / n as f64;
            let at = ray.origin.as_dvec3() + ray.direction.as_dvec3() * t;
            let flight =
                profile.sigma_t_at(at.y, nm) * math::f64::exp(-profile.optical_depth_at(y, dy, t, nm)) * 0.9;
            let lamps = lamps.iter().map(|lamp| {
                let offset = lamp.position.as_dvec3() - at;
                let d = offset.length();
                let towards = offset / d;
                let m = 1.0 - towards.dot(ray.direction.as_dvec3());
                let depth = profile.optical_depth_at(at.y, towards.y, d, nm);
                f64::from(lamp.intensity[0] * lamp.falloff(-towards.as_vec3a()))
                    * hg.eval(m)
                    * math::f64::exp(-depth)
                    / (d * d)
            });
            flight * lamps.sum::<f64>() * end / n as f64
        })
        .sum();
    sum * white(nm)
}

#[test]
fn halos_against_quadrature() {
    let profile = layer();
    let fog = Medium::new(profile.clone(), Phase::HenyeyGreenstein(HenyeyGreenstein::new(G).unwrap()));
    let lamps = vec![
        point(1.0, 21.0, -15.0, [30.0; 3]),
        point(-8.0, 24.0, -40.0, [200.0; 3]),
        spot(4.0, 30.0, -12.0, 500.0, Vec3A::new(-0.3, -1.0, 0.0)),
        measured(Vec3A::new(-3.0, 32.0, -25.0), 700.0, 8, looking_down()),
    ];
    let scene = Scene::new(lit(&scenes::empty(), lamps.clone(), vec![]), Some(fog), None, None, true);
    for (k, direction) in [Vec3A::NEG_Z, Vec3A::new(0.07, 0.06, -1.0), Vec3A::new(-0.2, 0.3, -1.0), Vec3A::Z]
        .into_iter()
        .enumerate()
    {
        let ray = Ray { origin: Vec3A::new(0.0, 20.0, 0.0), direction: direction.normalize() };
        // At one wavelength, and with all wavelengths of a path together.
        let want = single_scattering(&profile, &ray, &lamps, 600.0, 1500.0);
        let got = seen(&scene, ray, Some(2), 600.0, 60_000);
        let tolerance = 4.5 * got.standard_error() + 2e-3 * want;
        assert!((got.mean() - want).abs() < tolerance, "ray {k}: {} for {want}", got.mean());
        // Equiangular points bound it: the line passes lamps at 1 m.
        let deviation = got.variance().sqrt() / got.mean();
        assert!(deviation < 5.0, "ray {k}: relative deviation {deviation}");
        spectral(&scene, &profile, &ray, &lamps, k);
    }
}

fn spectral(scene: &Scene, profile: &ExtinctionProfile, ray: &Ray, lamps: &[Lamp], k: usize) {
    let observer = Observer::new();
    let settings = Settings { samples: 1, max_depth: Some(2), wavelength_nm: None, stop: None };
    let tracer = PathTracer::new(scene, &observer, settings);
    let mut rgb = [Moments::default(); 3];
    for s in 0..40_000 {
        let mut rng = PathRng::new(12, k as u64, s);
        let wavelengths = observer.sample_wavelengths(rng.uniform());
        let first = rng.uniform();
        let path = tracer.radiance(*ray, &wavelengths, first, &mut rng);
        let light = path.radiance + path.glow;
        let response = observer.lane_response(&wavelengths);
        for (c, moments) in rgb.iter_mut().enumerate() {
            moments.add((0..8).map(|lane| f64::from(light[lane] * response[lane][c])).sum());
        }
    }
    // Quadratures at few wavelengths; between them everything is smooth.
    let nodes: Vec<f64> = (0..=20).map(|i| 380.0 + 20.0 * f64::from(i)).collect();
    let values: Vec<f64> =
        nodes.iter().map(|&nm| single_scattering(profile, ray, lamps, nm, 1500.0)).collect();
    let want = observer.rgb_of(|nm| {
        let x = ((f64::from(nm) - 380.0) / 20.0).clamp(0.0, 19.999);
        let i = x as usize;
        let w = x - i as f64;
        (values[i] * (1.0 - w) + values[i + 1] * w) as f32
    });
    for c in 0..3 {
        let (got, error) = (rgb[c].mean(), rgb[c].standard_error());
        let tolerance = 4.5 * error + 3e-3 * want[c];
        assert!((got - want[c]).abs() < tolerance, "ray {k}, channel {c}: {got} ± {error} for {}", want[c]);
    }
}

#[test]
fn lamps_over_a_foggy_street() {
    // The lamps hang over the layer: inside it, the analog integrator's connections have no variance to speak of.
    let lamps = vec![
        point(3.0, 75.0, -20.0, [3e3, 6e3, 4e3]),
        spot(-6.0, 66.0, -35.0, 2e4, Vec3A::new(0.2, -1.0, 0.1)),
        spot(8.0, 80.0, 30.0, 2e4, Vec3A::new(0.0, -1.0, -0.4)),
        point(90.0, 70.0, 5.0, [2e3; 3]),
    ];
    let beams = vec![Beam { direction: Vec3A::new(0.3, 0.9, 0.2).normalize(), illuminance: [0.5, 1.0, 1.5] }];
    let loaded = lit(&scenes::load("street_day.glb"), lamps, beams);
    let rays = [(0.0, 0.0), (20.0, 8.0), (-35.0, -4.0)];
    let grey = scenes::hg_fog(scenes::grey_profile(60.0, &[0.01, 0.03, 0.02, 0.005], 1.0), 0.7);
    for fog in [None, Some(grey), Some(scenes::coloured_fog(60.0, 0.02, 1.0))] {
        let scene = Scene::new(loaded.clone(), fog, None, None, true);
        assert_agree("lamps", &scene, &rays, None, 100_000);
    }
}

#[test]
fn lamps_in_the_fog_of_a_street() {
    // Two edges, so that the analog connections have a finite variance among lamps.
    let lamps = vec![
        point(2.0, 6.0, -14.0, [30.0, 60.0, 40.0]),
        spot(-3.0, 8.0, -20.0, 200.0, Vec3A::new(0.2, -1.0, 0.1)),
        point(1.0, 3.0, 12.0, [20.0; 3]),
    ];
    let loaded = lit(&scenes::load("street_day.glb"), lamps, vec![]);
    for fog in [scenes::coloured_fog(60.0, 0.02, 0.9), scenes::parcel(60.0, 0.02, true)] {
        let scene = Scene::new(loaded.clone(), Some(fog), None, None, true);
        assert_agree("lamps in fog", &scene, &[(0.0, 0.0), (10.0, 8.0), (-30.0, -4.0)], Some(2), 200_000);
    }
}

#[test]
fn choices_of_lamps_follow_their_probabilities() {
    let lamps: Vec<Lamp> = (0..64u8)
        .map(|i| {
            let (x, z) = (f32::from(i % 8) * 12.0 - 40.0, f32::from(i / 8) * 15.0 - 60.0);
            let strength = 1.0 + f32::from(i * 7 % 13) * 20.0;
            if i % 2 == 0 { point(x, 7.0, z, [strength; 3]) } else { spot(x, 7.0, z, strength, Vec3A::NEG_Y) }
        })
        .collect();
    let tree = LampTree::new(lamps);
    let direction = Vec3A::new(0.3, 0.05, -1.0).normalize();
    let origin = Vec3A::new(5.0, 2.0, 3.0);
    let forward = PhaseAngles::new(&PhaseView::HenyeyGreenstein(HenyeyGreenstein::new(0.95).unwrap()));
    let receivers = [
        Receiver::Point(origin),
        Receiver::Point(Vec3A::new(-200.0, 30.0, 100.0)),
        Receiver::Segment { origin, direction, enter: 0.0, exit: 70.0, angles: None },
        Receiver::Segment { origin, direction, enter: 0.0, exit: 70.0, angles: Some(&forward) },
        Receiver::Segment { origin, direction: Vec3A::X, enter: 0.0, exit: f32::INFINITY, angles: None },
    ];
    for (k, receiver) in receivers.iter().enumerate() {
        let n = 200_000;
        // The last cell counts choices of none.
        let mut observed = vec![0; 65];
        let mut rng = PathRng::new(21, k as u64, 0);
        for _ in 0..n {
            observed[tree.choose(receiver, rng.uniform_f64()).map_or(64, |(lamp, _)| lamp)] += 1;
        }
        let mut expected: Vec<f64> =
            (0..64).map(|i| f64::from(tree.probability(i, receiver)) * f64::from(n)).collect();
        let none = f64::from(n) - expected.iter().sum::<f64>();
        expected.push(if none < 1.0 { 0.0 } else { none });
        chi_square::assert_follows(&format!("lamps, receiver {k}"), &observed, &expected, 4);
    }
}
