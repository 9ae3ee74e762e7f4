//! Clear coats, transmitting sheets and normal maps: samplers against densities, reciprocity, energy.

use fog_core::math;
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, warp};
use fog_scene::SurfaceParameters;
use fog_scene::bsdf::Bsdf;
use fog_tests::chi_square::assert_follows;

const GREY: [Spectrum; 3] = [Spectrum([1.0 / 3.0; 8]); 3];

fn plastic(roughness: f32) -> SurfaceParameters {
    SurfaceParameters {
        base_color: [0.6, 0.3, 0.9],
        metallic: 0.0,
        roughness,
        ..SurfaceParameters::default()
    }
}

fn coated(p: SurfaceParameters, clearcoat_roughness: f32) -> SurfaceParameters {
    SurfaceParameters { clearcoat: 0.8, clearcoat_roughness, ..p }
}

fn glass(p: SurfaceParameters, transmission: f32) -> SurfaceParameters {
    SurfaceParameters { transmission, ..p }
}

/// A normal tilted from the surface's own towards +x and a little y.
fn tilted(degrees: f32) -> Vec3A {
    let angle = degrees.to_radians();
    warp::spherical(math::f32::cos(angle), math::f32::sin(angle), 0.3)
}

fn bsdfs() -> Vec<(&'static str, Bsdf)> {
    let chalk = SurfaceParameters { f0: [0.0; 3], f90: 0.0, ..plastic(1.0) };
    let metal = SurfaceParameters { metallic: 1.0, ..plastic(0.5) };
    // Its reflection would be too sharp for the cells.
    let sheet = SurfaceParameters { f0: [0.0; 3], f90: 0.0, ..plastic(0.0) };
    let plain = |p: SurfaceParameters| Bsdf::new(&p, &GREY);
    vec![
        ("coated plastic", plain(coated(plastic(0.7), 0.3))),
        ("coated metal", plain(coated(metal, 0.6))),
        ("rough glass", plain(glass(plastic(0.6), 1.0))),
        ("milky coated glass", plain(coated(glass(plastic(0.5), 0.4), 0.5))),
        ("smooth translucent sheet", plain(coated(glass(sheet, 0.7), 0.4)).beside_clear(0.1)),
        ("chalk with a slight normal map", plain(chalk).with_normal(tilted(15.0))),
        ("chalk with a steep normal map", plain(chalk).with_normal(tilted(65.0))),
        ("plastic with a normal map", plain(plastic(0.6)).with_normal(tilted(35.0))),
        ("metal with a normal map", plain(metal).with_normal(tilted(45.0))),
        ("coated plastic with a normal map", plain(coated(plastic(0.6), 0.5)).with_normal(tilted(35.0))),
    ]
}

/// Direction at an angle whose cosine is `cos`, off the plane of the tilt.
fn view(cos: f32) -> Vec3A {
    warp::spherical(cos, (1.0 - cos * cos).sqrt(), 2.0)
}

#[test]
fn samplers_follow_their_densities() {
    const ROWS: usize = 32;
    const COLUMNS: usize = 16;
    const FINE: usize = 32;
    const SAMPLES: u64 = 300_000;
    let cell = |w: Vec3A| {
        let row = (((w.z + 1.0) * 0.5 * ROWS as f32) as usize).min(ROWS - 1);
        let turn = math::f32::atan2(w.y, w.x) / math::TAU_F32 + 0.5;
        row * COLUMNS + ((turn * COLUMNS as f32) as usize).min(COLUMNS - 1)
    };
    for (k, (name, bsdf)) in bsdfs().iter().enumerate() {
        for cos in [0.15f32, 0.6, 0.97] {
            let wo = view(cos);
            // Midpoint rule over fine cells; the last cell is for what has no density: straight on, or absorbed.
            let mut expected = vec![0.0; ROWS * COLUMNS + 1];
            let step = 2.0 / (ROWS * FINE) as f64 * math::TAU / (COLUMNS * FINE) as f64;
            for i in 0..ROWS * FINE {
                let z = 2.0 * (i as f32 + 0.5) / (ROWS * FINE) as f32 - 1.0;
                for j in 0..COLUMNS * FINE {
                    let phi = ((j as f32 + 0.5) / (COLUMNS * FINE) as f32 - 0.5) * math::TAU_F32;
                    let w = warp::spherical(z, (1.0 - z * z).sqrt(), phi);
                    expected[cell(w)] += f64::from(bsdf.eval(wo, w).1) * step * SAMPLES as f64;
                }
            }
            let inside: f64 = expected.iter().sum();
            assert!(inside <= 1.003 * SAMPLES as f64, "{name}: density integrates to more than 1: {inside}");
            expected[ROWS * COLUMNS] = (SAMPLES as f64 - inside).max(0.0);
            let mut observed = vec![0u64; expected.len()];
            let mut rng = PathRng::new(51, k as u64, 0);
            for _ in 0..SAMPLES {
                let sample = bsdf.sample(wo, rng.uniform(), rng.uniform2()).filter(|s| s.pdf.is_finite());
                observed[sample.map_or(ROWS * COLUMNS, |s| cell(s.wi))] += 1;
            }
            if expected[ROWS * COLUMNS] < 0.01 * SAMPLES as f64 {
                // What is left over here is mostly the quadrature's error: leave the cell out.
                expected.truncate(ROWS * COLUMNS);
                observed.truncate(ROWS * COLUMNS);
            }
            assert_follows(&format!("{name}, cos {cos}"), &observed, &expected, 30);
        }
    }
}

#[test]
fn scattering_is_reciprocal() {
    // Mapped normals are not, as no shading normals are.
    let mut rng = PathRng::new(52, 0, 0);
    let mut compared = 0;
    for (name, bsdf) in bsdfs().into_iter().filter(|(name, _)| !name.contains("normal map")) {
        for _ in 0..4000 {
            let mut direction = || {
                let w = warp::uniform_sphere(rng.uniform2());
                Vec3A::new(w.x, w.y, w.z.abs().max(0.02)).normalize()
            };
            let (a, b) = (direction(), direction());
            let flipped = |w: Vec3A| Vec3A::new(w.x, w.y, -w.z);
            // Reflected, and sent through: then the way back is seen from the other side.
            for (there, back) in [((a, b), (b, a)), ((a, flipped(b)), (b, flipped(a)))] {
                let there = bsdf.eval(there.0, there.1).0[0] / b.z;
                let back = bsdf.eval(back.0, back.1).0[0] / a.z;
                assert!((there - back).abs() <= 1e-3 * (there + back) + 1e-6, "{name}: {there} {back}");
                compared += u32::from(there > 0.0);
            }
        }
    }
    assert!(compared > 20_000);
}

/// Mean weight of samples, and its standard error.
fn albedo(bsdf: &Bsdf, cos: f32) -> (f64, f64) {
    let mut rng = PathRng::new(53, 0, 0);
    let mut moments = Moments::default();
    for _ in 0..100_000 {
        let sample = bsdf.sample(view(cos), rng.uniform(), rng.uniform2());
        moments.add(sample.map_or(0.0, |s| f64::from(s.weight[0])));
    }
    (moments.mean(), moments.standard_error())
}

/// White materials scatter no more than they get, and at least `least` of it.
fn assert_white(name: &str, bsdf: &Bsdf, least: f64) {
    for cos in [0.05f32, 0.2, 0.5, 0.8, 1.0] {
        let (albedo, error) = albedo(bsdf, cos);
        let range = least - 4.5 * error..=1.0001 + 4.5 * error;
        assert!(range.contains(&albedo), "{name}, cos {cos}: albedo {albedo} ± {error}");
    }
}

#[test]
fn white_materials_keep_their_energy() {
    let white = |p: SurfaceParameters| SurfaceParameters { base_color: [1.0; 3], ..p };
    let chalk = SurfaceParameters { f0: [0.0; 3], f90: 0.0, ..white(plastic(1.0)) };
    let mirror = SurfaceParameters { metallic: 1.0, ..white(plastic(0.2)) };
    let plain = |p: SurfaceParameters| Bsdf::new(&p, &GREY);
    let smooth = plain(glass(white(plastic(0.0)), 1.0));
    assert_white("smooth glass", &smooth, 0.99);
    assert_white("rough glass", &plain(glass(white(plastic(0.5)), 1.0)), 0.84);
    assert_white("half-transmitting glass", &plain(glass(white(plastic(0.0)), 0.5)), 0.95);
    assert_white("coated chalk", &plain(coated(chalk, 0.1)), 0.93);
    assert_white("coated glass", &plain(coated(glass(white(plastic(0.0)), 1.0), 0.1)), 0.72);
    // A mapped normal changes nothing of what chalk and a smooth mirror reflect in all.
    for degrees in [10.0, 30.0, 60.0, 89.0, 120.0] {
        assert_white(&format!("chalk at {degrees}°"), &plain(chalk).with_normal(tilted(degrees)), 0.997);
        assert_white(&format!("mirror at {degrees}°"), &plain(mirror).with_normal(tilted(degrees)), 0.89);
    }
    // Glass of which clear light was let pass scatters what is left.
    let clear = glass(white(plastic(0.0)), 1.0).clear_share(0.5);
    let (rest, error) = albedo(&smooth.beside_clear(clear), 0.5);
    assert!(clear > 0.9 && (rest - 1.0).abs() < 4.5 * error + 1e-4, "{clear} {rest}");
}
