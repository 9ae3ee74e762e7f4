//! Ground truth: transmittance and optical depth against an independent integral, distances against geometry.

use fog_core::{Vec3A, math};
use fog_optics::advection::AdvectionModel;
use fog_optics::water::refractive_index;
use fog_optics::{layer, mie, table};
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::truth::truth;

/// σ_t of the advection layer at 550 nm straight from the droplets, by quadrature over diameters and the Mie series.
struct Droplets {
    model: AdvectionModel,
    area_efficiency_m2: Vec<f64>,
}

impl Droplets {
    fn new() -> Self {
        let model = AdvectionModel::arcata().unwrap();
        let grid = *model.diameters();
        let m = refractive_index(550.0).unwrap();
        let area_efficiency_m2 = (0..grid.count())
            .map(|i| {
                let d = grid.diameter_um(i);
                let q = mie::efficiencies(m, std::f64::consts::PI * d / 0.55).unwrap().q_ext;
                q * std::f64::consts::PI * 0.25 * d * d * 1e-12
            })
            .collect();
        Self { model, area_efficiency_m2 }
    }

    fn sigma_t(&self, altitude: f64, height: f64) -> f64 {
        let grid = self.model.diameters();
        (0..grid.count())
            .map(|i| {
                let n = self.model.density_1_m3_um(grid.diameter_um(i), altitude / height, height);
                n * self.area_efficiency_m2[i] * grid.weight_um(i)
            })
            .sum()
    }
}

#[test]
fn transmittance_is_the_integral_of_the_droplets() {
    let height = 100.0;
    let droplets = Droplets::new();
    let model = AdvectionModel::arcata().unwrap();
    let settings = table::TableSettings {
        wavelengths_nm: vec![525.0, 550.0, 575.0],
        ..table::TableSettings::visible(&model)
    };
    let optics = table::build_table(&model, &settings, &|_| ()).unwrap();
    let profile = layer::advection(&optics, &model, height, 1.0).unwrap().profile(0.0).unwrap();
    let medium = Medium::new(profile, Phase::Table(optics));
    let scene = Scene::new(scenes::load("street_day.glb"), Some(medium), None, None, false);
    for (altitude, pitch) in [(2.0, 3.0), (60.0, -20.0), (150.0, -35.0)] {
        let camera = scenes::camera(altitude, 10.0, pitch, 24, 14, 60.0);
        let t = truth(&scene, &camera, None);
        // σ_t on an even grid of altitudes, once; Simpson along each ray.
        let table: Vec<f64> =
            (0..=4000).map(|i| droplets.sigma_t(height * i as f64 / 4000.0, height)).collect();
        let sigma = |y: f64| {
            let x = (y / height * 4000.0).clamp(0.0, 4000.0);
            let i = (x as usize).min(3999);
            if (0.0..=height).contains(&y) {
                table[i] + (table[i + 1] - table[i]) * (x - i as f64)
            } else {
                0.0
            }
        };
        for i in 0..camera.width as usize * camera.height as usize {
            let from_tau = math::f64::exp(-f64::from(t.tau[i]));
            assert!((f64::from(t.transmittance[i][1]) - from_tau).abs() < 1e-6, "exp(-tau), pixel {i}");
            let ray = camera.ray((i % 24) as f64 + 0.5, (i / 24) as f64 + 0.5).expect("seen");
            let (y0, dy) = (f64::from(ray.origin.y), f64::from(ray.direction.y));
            // The part inside the layer, so that the quadrature meets no jump.
            let (a, b) = if dy == 0.0 {
                (0.0, f64::INFINITY)
            } else {
                let (p, q) = ((0.0 - y0) / dy, (height - y0) / dy);
                (p.min(q).max(0.0), p.max(q))
            };
            let b = b.min(f64::from(t.distance_m[i]));
            if b <= a {
                assert_eq!(t.tau[i], 0.0, "pixel {i} sees no fog");
                continue;
            }
            let n = 4000;
            let h = (b - a) / f64::from(n);
            let want: f64 = (0..n)
                .map(|k| {
                    let s = a + h * f64::from(k);
                    h / 6.0
                        * (sigma((y0 + s * dy).clamp(0.0, height))
                            + 4.0 * sigma((y0 + (s + 0.5 * h) * dy).clamp(0.0, height))
                            + sigma((y0 + (s + h) * dy).clamp(0.0, height)))
                })
                .sum();
            let (got, want) = (f64::from(t.transmittance[i][1]), math::f64::exp(-want));
            assert!((got - want).abs() < 1e-5, "pixel {i} from {altitude} m: {got} for {want}");
        }
    }
}

#[test]
fn depth_and_distance_meet_the_street() {
    let scene = Scene::new(scenes::load("street_day.glb"), None, None, None, false);
    let camera = scenes::camera(1.7, 0.0, 0.0, 600, 400, 60.0);
    let t = truth(&scene, &camera, None);
    let at = |x: usize, y: usize| y * 600 + x;
    // Straight ahead stands the tower, 400 m away; the sky is open above the street, the ground lies below.
    assert!((t.depth_m[at(300, 195)] - 400.0).abs() < 0.01, "{}", t.depth_m[at(300, 195)]);
    assert_eq!(t.depth_m[at(360, 20)], f32::INFINITY);
    assert_eq!(t.distance_m[at(360, 20)], f32::INFINITY);
    for y in 300..400 {
        let ray = camera.ray(300.5, y as f64 + 0.5).expect("seen");
        let want = 1.7 / -ray.direction.y;
        assert!((t.distance_m[at(300, y)] / want - 1.0).abs() < 1e-5, "row {y}");
        let along = ray.direction.dot(Vec3A::NEG_Z);
        assert!((t.depth_m[at(300, y)] / (want * along) - 1.0).abs() < 1e-5, "row {y}");
    }
    assert!(t.transmittance.iter().all(|t| *t == [1.0; 3]) && t.tau.iter().all(|&t| t == 0.0));
}
