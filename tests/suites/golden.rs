//! Golden images: small renderings of everything together, against stored means and variances of many samples.
//!
//! They say that the picture stays the same in expectation whatever becomes of the estimators: no pixel is compared but in
//! standard errors, so any unbiased change of the tracer passes. A picture that is *meant* to change (another scene,
//! another material, other units) is stored anew, and the reason told in the commit; so is one that has passed with an estimator
//! whose errors are much smaller than the stored ones, for the comparison is as sharp as those:
//!
//!     cargo test --release -p fog-tests --test slow golden::store -- --ignored          (minutes)
//!     GOLDEN=lamps cargo test --release -p fog-tests --test slow golden::store -- --ignored
//!
//! A file of tests/data/golden holds, by pixel of 64 × 36, the mean of red, green and blue over [`STORED`] samples and the
//! variance of one sample of each.

use fog_core::Vec3A;
use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_optics::advection::AdvectionModel;
use fog_optics::{layer, layer_csv, table};
use fog_scene::lamp::{Cone, Lamp, PunctualLights};
use fog_scene::light::{Environment, Sun};
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;
use fog_scene::{AlphaMode, Geometry, LoadedScene, Material, Opacity, Texture};
use fog_tests::npy::Array;
use fog_tests::{data, scenes};
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

const SIZE: [usize; 2] = [64, 36];
const PIXELS: usize = SIZE[0] * SIZE[1];
/// Samples a pixel of the stored images, and of those that are compared with them.
const STORED: u64 = 4096;
const COMPARED: u64 = 128;
/// Seeds of the two.
const SEEDS: [u64; 2] = [1001, 2002];

/// A scene and the pitch of its camera.
struct Golden {
    name: &'static str,
    scene: Scene,
    pitch_deg: f64,
}

fn layered() -> Medium {
    let text = std::fs::read_to_string(data("fog_layers.csv")).unwrap();
    let rows = layer_csv::parse_layers(&text, "fog_layers.csv").unwrap();
    scenes::hg_fog(layer::layered(&rows, 1.0).unwrap().profile(0.0).unwrap(), 0.83)
}

/// The advection fog as the command line makes it.
fn advection(height_m: f64) -> Medium {
    let model = AdvectionModel::arcata().unwrap();
    let optics = table::build_table(&model, &table::TableSettings::visible(&model), &|_| ()).unwrap();
    let profile = layer::advection(&optics, &model, height_m, 1.0).unwrap().profile(0.0).unwrap();
    Medium::new(profile, Phase::Table(optics))
}

/// The street with a few lamps above it.
fn lamplit() -> Arc<LoadedScene> {
    let lamp = |x: f32, y: f32, z: f32, intensity: [f32; 3]| Lamp::even(Vec3A::new(x, y, z), intensity);
    let cone = Cone { axis: Vec3A::new(0.1, -1.0, 0.05).normalize(), cos_inner: 0.9, cos_outer: 0.6 };
    let lamps = vec![
        lamp(-5.0, 6.0, -18.0, [60.0, 45.0, 20.0]),
        lamp(5.0, 7.0, -30.0, [40.0, 60.0, 80.0]),
        Lamp::spot(Vec3A::new(0.0, 9.0, -24.0), [300.0, 250.0, 200.0], cone),
        lamp(3.0, 5.0, -70.0, [400.0; 3]),
    ];
    let street = scenes::load("street_day.glb");
    Arc::new(LoadedScene { lights: PunctualLights { lamps, beams: vec![] }, ..(*street).clone() })
}

/// The street with a coat, a pane, rough glass, a metal and a half-covering sheet among its materials.
fn many_materials() -> Arc<LoadedScene> {
    let street = scenes::load("street_night.glb");
    let materials: Vec<Material> = (street.materials.iter().enumerate())
        .map(|(i, m)| {
            let m = Material { specular: 1.0, roughness: 0.5, ..m.clone() };
            match i % 6 {
                0 => Material { clearcoat: 1.0, clearcoat_roughness: 0.3, ..m },
                1 => Material { transmission: 0.8, roughness: 0.0, ..m },
                2 => Material { transmission: 0.9, roughness: 0.4, ..m },
                3 => Material { metallic: 1.0, roughness: 0.4, ..m },
                4 => Material {
                    base_color: [m.base_color[0], m.base_color[1], m.base_color[2], 0.6],
                    alpha_mode: AlphaMode::Blend,
                    ..m
                },
                _ => m,
            }
        })
        .collect();
    let textures: Arc<[Texture]> = street.textures.iter().cloned().collect();
    let opacities = materials.iter().map(|m| Opacity::new(m, &textures)).collect();
    let geometry = Geometry::new(street.geometry.triangles().to_vec(), opacities);
    Arc::new(LoadedScene { geometry, materials, ..(*street).clone() })
}

fn goldens() -> Vec<Golden> {
    let sky = |radiance| Some(Environment { radiance });
    let street = |file| scenes::load(file);
    let sun = Some(Sun::new(12.0, 20.0, 1.0, 2.0));
    let golden = |name, pitch_deg, scene| Golden { name, scene, pitch_deg };
    let (day, night) = ("street_day.glb", "street_night.glb");
    vec![
        golden("day", 0.0, Scene::new(street(day), Some(layered()), sky(1.0), None, false)),
        golden("night", 0.0, Scene::new(street(night), Some(layered()), None, None, true)),
        golden("mie", 0.0, Scene::new(street(day), Some(advection(100.0)), sky(1.0), None, false)),
        golden(
            "droplets",
            5.0,
            Scene::new(street(day), Some(scenes::parcel(60.0, 0.01, true)), sky(0.2), sun, false),
        ),
        golden(
            "sky",
            15.0,
            Scene::new(street(day), Some(scenes::coloured_fog(60.0, 0.01, 1.0)), sky(0.2), sun, false),
        ),
        golden(
            "lamps",
            0.0,
            Scene::new(lamplit(), Some(scenes::coloured_fog(60.0, 0.01, 1.0)), None, None, true),
        ),
        golden(
            "materials",
            0.0,
            Scene::new(many_materials(), Some(scenes::coloured_fog(60.0, 0.005, 0.97)), sky(0.2), sun, true),
        ),
    ]
}

/// Red, green and blue of every pixel.
fn render(golden: &Golden, samples: u64, seed: u64) -> Vec<[Moments; 3]> {
    let observer = Observer::new();
    let settings = Settings { samples, max_depth: None, wavelength_nm: None, stop: None };
    let tracer = PathTracer::new(&golden.scene, &observer, settings);
    let camera = scenes::camera(1.7, 0.0, golden.pitch_deg, SIZE[0] as u32, SIZE[1] as u32, 60.0);
    let pixel = |i: usize| {
        let mut moments = [Moments::default(); 3];
        for s in 0..samples {
            let value = tracer.sample(&camera, i, seed, s).value();
            (0..3).for_each(|c| moments[c].add(f64::from(value[c])));
        }
        moments
    };
    (0..PIXELS).into_par_iter().map(pixel).collect()
}

fn file(name: &str) -> PathBuf {
    data("golden").join(format!("{name}.npy"))
}

/// Compares a rendering with the stored one, channel by channel: the image's mean, every pixel, and all pixels together.
fn compare(golden: &Golden) {
    let name = golden.name;
    let stored = Array::read(&file(name), [SIZE[1], SIZE[0], 6]).values;
    let pixels = render(golden, COMPARED, SEEDS[1]);
    // Channels are told apart in units of the brightest: the green of a night in red and blue is nearly nothing.
    let light = |c: usize| stored.chunks_exact(6).map(|p| f64::from(p[c])).sum::<f64>();
    let brightest = light(0).max(light(1)).max(light(2));
    for c in 0..3 {
        let (mut chi_square, mut seen, mut worst) = (0.0, 0.0, 0.0f64);
        let (mut sum, mut expected, mut variance) = (0.0, 0.0, 0.0);
        for (pixel, stored) in pixels.iter().zip(stored.chunks_exact(6)) {
            let (got, want) = (pixel[c].mean(), f64::from(stored[c]));
            // The larger of the two variances: few samples do not know their rare bright ones. Samples of a pixel are
            // stratified, so that this overestimates a little.
            let one = pixel[c].variance().max(f64::from(stored[3 + c]));
            let error_squared = one / COMPARED as f64 + f64::from(stored[3 + c]) / STORED as f64;
            let off = got - want;
            if error_squared == 0.0 {
                assert!(
                    off.abs() <= 1e-5 * want.abs(),
                    "{name}, channel {c}: {got} for {want} without noise"
                );
                continue;
            }
            let z = off / error_squared.sqrt();
            chi_square += z * z;
            seen += 1.0;
            worst = worst.max(z.abs());
            sum += got;
            expected += want;
            variance += error_squared;
        }
        let (off, error) = ((sum - expected) / brightest, variance.sqrt() / brightest);
        println!(
            "{name}, channel {c}: mean {:+.3} % ± {:.3} %, worst pixel {worst:.1} s.e., chi² {chi_square:.0} of {seen}",
            100.0 * off,
            100.0 * error
        );
        assert!(seen > 0.5 * PIXELS as f64, "{name}, channel {c}: only {seen} pixels have light");
        assert!(off.abs() < 4.5 * error, "{name}, channel {c}: mean off by {off} ± {error}");
        assert!(error < 0.01, "{name}, channel {c}: too noisy to tell, ± {error}");
        // Means of skewed samples have longer tails than the normal distribution's.
        assert!(worst < 8.0, "{name}, channel {c}: a pixel is off by {worst} standard errors");
        let allowed = seen + 6.0 * (2.0 * seen).sqrt();
        assert!(chi_square < allowed, "{name}, channel {c}: chi² {chi_square} of {seen} pixels");
        assert!(chi_square > 0.25 * seen, "{name}, channel {c}: errors are overestimated, chi² {chi_square}");
    }
}

#[test]
fn pictures_are_the_stored_ones() {
    for golden in goldens() {
        compare(&golden);
    }
}

#[test]
#[ignore = "stores the golden images anew: only if they are meant to change"]
fn store() {
    let only = std::env::var("GOLDEN").ok();
    for golden in goldens().iter().filter(|g| only.as_deref().is_none_or(|name| name == g.name)) {
        let mut values = Vec::with_capacity(6 * PIXELS);
        for pixel in render(golden, STORED, SEEDS[0]) {
            values.extend(pixel.map(|m| m.mean() as f32));
            values.extend(pixel.map(|m| m.variance() as f32));
        }
        Array { shape: [SIZE[1], SIZE[0], 6], values }.write(&file(golden.name));
        println!("{} stored", golden.name);
    }
}
