//! Blended surfaces, glass and normal maps in whole scenes, against closed forms and the analog integrator.

use crate::analog::assert_agree;
use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_core::{Vec3, Vec3A, math};
use fog_scene::camera::Ray;
use fog_scene::light::{Environment, Sun};
use fog_scene::scene::Scene;
use fog_scene::{
    AlphaMode, CornerValues, Encoding, Filter, Geometry, Image, LoadedScene, Material, NormalMap, Opacity,
    Texture, TextureRef, Triangle, Wrap,
};
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use std::sync::Arc;

const WHITE: Option<Environment> = Some(Environment { radiance: 1.0 });

fn black() -> Material {
    Material { base_color: [0.0, 0.0, 0.0, 1.0], metallic: 0.0, specular: 0.0, ..Material::default() }
}

fn pane(base_color: [f32; 3]) -> Material {
    let [r, g, b] = base_color;
    Material {
        base_color: [r, g, b, 1.0],
        metallic: 0.0,
        roughness: 0.0,
        transmission: 1.0,
        ..Material::default()
    }
}

/// The same geometry with other materials.
fn with_materials(loaded: &LoadedScene, materials: Vec<Material>) -> LoadedScene {
    let textures: Arc<[Texture]> = loaded.textures.iter().cloned().collect();
    let opacities = materials.iter().map(|m| Opacity::new(m, &textures)).collect();
    let geometry = Geometry::new(loaded.geometry.triangles().to_vec(), opacities);
    LoadedScene { geometry, materials, ..loaded.clone() }
}

/// Level squares of 2 km, seen from above, at these heights.
fn floors(all: Vec<(f32, Material)>) -> LoadedScene {
    let mut triangles = Vec::new();
    for (i, (y, _)) in all.iter().enumerate() {
        let corner = |x: f32, z: f32| Vec3::new(1e3 * x, *y, 1e3 * z);
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
        for corners in [[a, b, c], [a, c, d]] {
            triangles.push(Triangle { material: i as u32, ..Triangle::flat(corners) });
        }
    }
    let plain = LoadedScene { geometry: Geometry::new(triangles, Vec::new()), ..LoadedScene::default() };
    with_materials(&plain, all.into_iter().map(|(_, m)| m).collect())
}

/// Mean radiance at one wavelength along a ray downwards from `y`, at this cosine to the vertical, and its error.
fn down(scene: &Scene, y: f32, cos: f32, max_depth: Option<u32>, samples: u64) -> (f64, f64) {
    let observer = Observer::new();
    let settings = Settings { samples, max_depth, wavelength_nm: Some(550.0), stop: None };
    let tracer = PathTracer::new(scene, &observer, settings);
    let direction = Vec3A::new((1.0 - cos * cos).sqrt(), -cos, 0.0);
    let ray = Ray { origin: Vec3A::new(0.3, y, 0.2), direction };
    let mut moments = Moments::default();
    for s in 0..samples {
        let mut rng = PathRng::new(61, 0, s);
        let first = rng.uniform();
        let path = tracer.radiance(ray, &Wavelengths::monochromatic(550.0), first, &mut rng);
        moments.add(f64::from(path.radiance[0]));
    }
    (moments.mean(), moments.standard_error())
}

fn assert_is(name: &str, (mean, error): (f64, f64), want: f64) {
    assert!((mean - want).abs() < 4.5 * error + 1e-4, "{name}: {mean} ± {error} for {want}");
    assert!(error < 0.02, "{name}: too noisy to tell ({error})");
}

/// Schlick's reflectance of glass of index 1.5.
fn fresnel(cos: f64) -> f64 {
    0.04 + 0.96 * (1.0 - cos).powi(5)
}

#[test]
fn what_is_behind_shines_through() {
    let seen = |material: Material, cos: f32| {
        let loaded = Arc::new(floors(vec![(0.0, material)]));
        down(&Scene::new(loaded, None, WHITE, None, false), 2.0, cos, None, 40_000)
    };
    let blended = Material {
        base_color: [0.0, 0.0, 0.0, 0.3],
        alpha_mode: AlphaMode::Blend,
        double_sided: true,
        ..black()
    };
    assert_is("black that covers 0.3", seen(blended, 0.7), 0.7);
    for cos in [1.0f32, 0.4, 0.1] {
        assert_is("white glass", seen(pane([1.0; 3]), cos), 1.0);
        // Grey glass is let pass; of orange glass the blue share is, and the rest goes through as a scattering.
        let f = fresnel(f64::from(cos));
        assert_is("grey glass", seen(pane([0.5; 3]), cos), f + 0.5 * (1.0 - f));
        let rough = Material { roughness: 0.1, ..pane([0.5; 3]) };
        let (mean, error) = seen(rough, cos);
        assert!((mean - (f + 0.5 * (1.0 - f))).abs() < 0.03 + 4.5 * error, "rough glass at {cos}: {mean}");
    }
    let observer = Observer::new();
    let basis = observer.lane_basis(&Wavelengths::monochromatic(550.0));
    let orange = [0.9, 0.5, 0.1];
    let tint = f64::from(fog_core::colour::upsample(orange, &basis)[0]);
    let f = fresnel(0.8);
    assert_is("orange glass", seen(pane(orange), 0.8), f + tint * (1.0 - f));
}

#[test]
fn light_is_found_through_blended_surfaces_and_glass() {
    let ground = Material { base_color: [0.5, 0.5, 0.5, 1.0], ..black() };
    // A parallel beam, which only light sampling finds.
    let sun = Sun::new(40.0, 30.0, 2.0, 0.0);
    let cos = math::f64::sin(40.0f64.to_radians());
    let open = 0.5 / math::PI * 2.0 * cos;
    let under = |material: Material, depth: u32| {
        let loaded = Arc::new(floors(vec![(0.0, ground.clone()), (1.0, material)]));
        down(&Scene::new(loaded, None, None, Some(sun), false), 0.5, 0.9, Some(depth), 40_000)
    };
    let blended = Material {
        base_color: [0.0, 0.0, 0.0, 0.25],
        alpha_mode: AlphaMode::Blend,
        double_sided: true,
        ..black()
    };
    assert_is("shadow of a quarter", under(blended, 8), 0.75 * open);
    assert_is("shadow of a window", under(pane([1.0; 3]), 2), (1.0 - fresnel(cos)) * open);
    assert_is("shadow of a grey window", under(pane([0.5; 3]), 2), 0.5 * (1.0 - fresnel(cos)) * open);
    assert_is("shadow of a wall", under(black(), 8), 0.0);
}

#[test]
fn white_glass_and_white_normal_maps_vanish_in_a_white_room() {
    // A street of white glass in fog that only scatters.
    let street = scenes::load("street_day.glb");
    let glass = with_materials(&street, vec![pane([1.0; 3]); street.materials.len()]);
    let fog = scenes::coloured_fog(60.0, 0.02, 1.0);
    // Chalk whose normals are tilted by 50° in one direction.
    let chalk = |mut loaded: LoadedScene| {
        let image = Image::new(1, 1, vec![[225, 128, 210, 255]]).unwrap();
        let wrap = [Wrap::Repeat; 2];
        loaded.textures = vec![Texture::new(Arc::new(image), Encoding::Linear, Filter::Nearest, wrap)];
        let mut tangents = CornerValues::default();
        for id in 0..loaded.geometry.triangles().len() as u32 {
            tangents.push(id, [[1.0, 0.1, 0.0, 1.0]; 3]);
        }
        loaded.geometry = loaded.geometry.with_attributes(CornerValues::default(), tangents);
        loaded
    };
    let map = NormalMap { texture: TextureRef { texture: 0, set: 0 }, scale: 1.5 };
    let white = Material { base_color: [1.0; 4], normal_map: Some(map), double_sided: true, ..black() };
    let bumpy = chalk(with_materials(&street, vec![white; street.materials.len()]));
    for (name, loaded, fog) in [
        ("glass in fog", glass, Some(fog)),
        ("bumpy chalk", bumpy.clone(), None),
        ("bumpy chalk in fog", bumpy, Some(scenes::coloured_fog(60.0, 0.02, 1.0))),
    ] {
        let scene = Scene::new(Arc::new(loaded), fog, WHITE, None, false);
        let frame = scenes::render(&scene, &scenes::camera(20.0, 30.0, -5.0, 16, 9, 90.0), 256, None, 7);
        for c in 0..3 {
            let mean = scenes::mean(&frame, c);
            let allowed = 4.5 * scenes::standard_error(&frame).max(2e-4);
            assert!((mean - 1.0).abs() < allowed, "{name}: channel {c} is {mean}, allowed {allowed}");
        }
    }
}

#[test]
fn both_integrators_agree_on_all_materials() {
    let street = scenes::load("street_night.glb");
    let materials = street.materials.iter().enumerate().map(|(i, m)| match i % 5 {
        0 => Material { clearcoat: 1.0, clearcoat_roughness: 0.3, ..m.clone() },
        1 => Material { transmission: 0.8, roughness: 0.0, specular: 1.0, metallic: 0.0, ..m.clone() },
        2 => Material { transmission: 0.9, roughness: 0.4, metallic: 0.0, ..m.clone() },
        3 => Material {
            base_color: [m.base_color[0], m.base_color[1], m.base_color[2], 0.6],
            alpha_mode: AlphaMode::Blend,
            ..m.clone()
        },
        _ => m.clone(),
    });
    let loaded = Arc::new(with_materials(&street, materials.collect()));
    let env = Some(Environment { radiance: 0.2 });
    let sun = Some(Sun::new(50.0, 20.0, 1.0, 10.0));
    let fog = || Some(scenes::coloured_fog(80.0, 0.02, 0.95));
    let rays = [(0.0, 0.0), (20.0, 8.0), (-35.0, -4.0)];
    for (name, fog) in [("clear", None), ("fog", fog())] {
        let scene = Scene::new(loaded.clone(), fog, env, sun, true);
        assert_agree(name, &scene, &rays, None, 200_000);
    }
}
