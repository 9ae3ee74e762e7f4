//! Emitting triangles that are aimed at: irradiances against quadrature over the texels, and the analog integrator, which only
//! runs into them.

use crate::analog::assert_agree;
use fog_core::colour::{Observer, upsample};
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_core::{Vec3A, math};
use fog_scene::camera::Ray;
use fog_scene::emitters::Breadth;
use fog_scene::scene::Scene;
use fog_scene::{
    Encoding, Filter, Geometry, Image, LoadedScene, Material, Texture, TextureRef, Triangle, Wrap,
};
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use glam::Vec3;
use std::f64::consts::PI;
use std::sync::Arc;

const TEXELS: u32 = 16;

/// Dark but for a few bright texels.
fn texel(column: u32, row: u32) -> f32 {
    match (column, row) {
        (2..=3, 12..=13) => 1.0,
        (9, 4) => 0.5,
        (_, 7) => 0.1,
        _ => 0.0,
    }
}

fn spots() -> Texture {
    let texels = (0..TEXELS * TEXELS).map(|i| {
        let value = (255.0 * texel(i % TEXELS, i / TEXELS)) as u8;
        [value, value, value, 255]
    });
    let image = Image::new(TEXELS, TEXELS, texels.collect()).expect("size");
    Texture::new(Arc::new(image), Encoding::Linear, Filter::Nearest, [Wrap::Clamp; 2])
}

/// Two triangles over `origin`, `along_u`, `along_v`, whose texture coordinates are (0, 0) to (1, 1).
fn quad(origin: Vec3, along_u: Vec3, along_v: Vec3, material: u32) -> [Triangle; 2] {
    let place = |[u, v]: [f32; 2]| origin + along_u * u + along_v * v;
    [[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]].map(|uv| Triangle {
        uv: [uv, uv],
        material,
        ..Triangle::flat(uv.map(place))
    })
}

/// A ground of 60 m under a textured emitter at 3 m that shines down, `edge` m wide, and a small lamp panel of 0.2 m.
fn scene(edge: f32) -> LoadedScene {
    let ground = scenes::lambertian_ground(0.5);
    let mut triangles = quad(Vec3::new(-30.0, 0.0, 30.0), Vec3::X * 60.0, Vec3::Z * -60.0, 0).to_vec();
    let corner = Vec3::new(-0.5 * edge, 3.0, -8.0 - 0.5 * edge);
    triangles.extend(quad(corner, Vec3::X * edge, Vec3::Z * edge, 1));
    triangles.extend(quad(Vec3::new(2.0, 1.0, -6.0), Vec3::X * 0.2, Vec3::Z * 0.2, 2));
    let emitting = |emissive: f32, texture| Material {
        emissive: [emissive; 3],
        emissive_texture: texture,
        base_color: [0.3, 0.3, 0.3, 1.0],
        ..ground.materials[0].clone()
    };
    let spots_here = Some(TextureRef { texture: 0, set: 0 });
    let materials = vec![ground.materials[0].clone(), emitting(20.0, spots_here), emitting(30.0, None)];
    let geometry = Geometry::new(triangles, Vec::new());
    LoadedScene { geometry, materials, textures: vec![spots()], ..LoadedScene::default() }
}

/// ∫ L cos θ cos θ' / d² dA over one quad that faces down, from a point of the ground.
fn irradiance(at: Vec3, origin: Vec3, edge: f32, radiance: impl Fn(u32, u32) -> f64) -> f64 {
    let n = TEXELS * 8;
    let mut sum = 0.0;
    for i in 0..n * n {
        let (column, row) = (i % n, i / n);
        let place = |k: u32| edge * (k as f32 + 0.5) / n as f32;
        let offset = (origin + Vec3::new(place(column), 0.0, place(row)) - at).as_dvec3();
        let squared = offset.length_squared();
        sum += radiance(column / 8, row / 8) * offset.y * offset.y / (squared * squared);
    }
    sum * f64::from(edge / n as f32).powi(2)
}

#[test]
fn textured_emitters_light_a_ground() {
    let observer = Observer::new();
    let wavelengths = Wavelengths::monochromatic(550.0);
    let white = f64::from(upsample([1.0; 3], &observer.lane_basis(&wavelengths))[0]);
    // Compact and broad ones; by connections and by chance, which together must count each texel once.
    for (edge, breadth) in [(1.0, Breadth::Compact), (8.0, Breadth::Broad)] {
        let loaded = scene(edge);
        let origin = Vec3::new(-0.5 * edge, 3.0, -8.0 - 0.5 * edge);
        let scene = Scene::new(Arc::new(loaded), None, None, None, true);
        assert!(scene.emitters().has(breadth));
        let settings = Settings { samples: 1, max_depth: Some(2), wavelength_nm: Some(550.0), stop: None };
        let tracer = PathTracer::new(&scene, &observer, settings);
        for at in [Vec3::new(0.2, 0.0, -7.0), Vec3::new(5.0, 0.0, -4.0), Vec3::new(-20.0, 0.0, 11.0)] {
            // From the side, lest the camera look through an emitter.
            let eye = Vec3A::from(at) + Vec3A::new(0.0, 0.5, 0.3);
            let ray = Ray { origin: eye, direction: (Vec3A::from(at) - eye).normalize() };
            let mut seen = Moments::default();
            for s in 0..40_000 {
                let mut rng = PathRng::new(3, 0, s);
                let first = rng.uniform();
                let path = tracer.radiance(ray, &wavelengths, first, &mut rng);
                seen.add(f64::from(path.radiance[0] + path.glow[0]));
            }
            let encoded = |c, r| f64::from((255.0 * texel(c, r)) as u8) / 255.0;
            let large = irradiance(at, origin, edge, |c, r| 20.0 * encoded(c, r));
            let small = irradiance(at, Vec3::new(2.0, 1.0, -6.0), 0.2, |_, _| 30.0);
            let want = 0.5 / PI * (large + small) * white * white;
            let tolerance = 4.5 * seen.standard_error() + 2e-3 * want;
            assert!((seen.mean() - want).abs() < tolerance, "{edge} m, {at}: {} for {want}", seen.mean());
            let deviation = seen.variance().sqrt() / seen.mean();
            // Faint light, as in the third place, is played for before it is looked for.
            assert!(deviation < 4.0 || at.x < 0.0, "{edge} m, {at}: relative deviation {deviation}");
        }
    }
}

#[test]
fn emitters_in_fog() {
    let grey = scenes::hg_fog(scenes::grey_profile(20.0, &[0.05, 0.1, 0.02], 0.9), 0.6);
    for (edge, fog) in [(1.5, grey), (8.0, scenes::coloured_fog(20.0, 0.08, 1.0))] {
        let scene = Scene::new(Arc::new(scene(edge)), Some(fog), None, None, true);
        assert_agree("emitters", &scene, &[(0.0, -12.0), (15.0, 8.0)], Some(6), 400_000);
    }
}

#[test]
fn far_emitters_are_not_left_to_chance() {
    // A wall of 40 m × 30 m that shines, 300 m away: its own light falls on a ground in 0.4 % of all directions.
    let ground = scene(1.0);
    let mut triangles = ground.geometry.triangles()[..2].to_vec();
    let wall = quad(Vec3::new(20.0, 0.0, -300.0), Vec3::NEG_X * 40.0, Vec3::Y * 30.0, 2);
    triangles
        .extend(wall.map(|t| Triangle { positions: [t.positions[0], t.positions[2], t.positions[1]], ..t }));
    let loaded = LoadedScene { geometry: Geometry::new(triangles, Vec::new()), ..ground };
    let scene = Scene::new(Arc::new(loaded), None, None, None, true);
    let observer = Observer::new();
    let settings = Settings { samples: 1, max_depth: Some(2), wavelength_nm: Some(550.0), stop: None };
    let tracer = PathTracer::new(&scene, &observer, settings);
    let wavelengths = Wavelengths::monochromatic(550.0);
    let ray = Ray { origin: Vec3A::Y, direction: Vec3A::NEG_Y };
    let mut seen = Moments::default();
    for s in 0..20_000 {
        let mut rng = PathRng::new(4, 0, s);
        let first = rng.uniform();
        seen.add(f64::from(tracer.radiance(ray, &wavelengths, first, &mut rng).radiance[0]));
    }
    // E = L/2 · (the wall's view factor from the ground's level, whose closed form is a difference of angles).
    let (half, height, d) = (20.0f64, 30.0f64, 300.0f64);
    let slant = d.hypot(height);
    let angle = |x: f64, y: f64| math::f64::atan2(x, y);
    let factor = 2.0 * 0.5 / PI * (angle(half, d) - d / slant * angle(half, slant));
    let white = f64::from(upsample([1.0; 3], &observer.lane_basis(&wavelengths))[0]);
    let want = 0.5 * 30.0 * factor * white * white;
    let tolerance = 4.5 * seen.standard_error() + 2e-3 * want;
    assert!((seen.mean() - want).abs() < tolerance, "{} for {want}", seen.mean());
    assert!(
        seen.variance().sqrt() / seen.mean() < 1.0,
        "relative deviation {}",
        seen.variance().sqrt() / seen.mean()
    );
}
