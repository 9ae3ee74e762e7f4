//! Every sampler against its density, by chi-square.

use fog_core::colour::Observer;
use fog_core::phase::HenyeyGreenstein;
use fog_core::profile::ExtinctionProfile;
use fog_core::random::PathRng;
use fog_core::spectrum::{Spectrum, Wavelengths};
use fog_core::{Vec3A, math, phase_grid, warp};
use fog_optics::advection::AdvectionModel;
use fog_scene::bsdf::Bsdf;
use fog_scene::emitters::{Breadth, EmitterTriangle, Emitters};
use fog_scene::lamp::{Cone, Lamp};
use fog_scene::light::Sun;
use fog_scene::light_tree::{LightTree, Receiver};
use fog_scene::phase::{Phase, PhaseNodes};
use fog_scene::{Hit, SurfaceParameters};
use fog_tests::chi_square::assert_follows;

const SAMPLES: u64 = 1_000_000;

#[test]
fn phase_functions() {
    let model = AdvectionModel::arcata().unwrap();
    let mean_diameter = fog_optics::mean_diameter::mean_diameter_table(&model, 550.0).unwrap();
    let mut phases: Vec<(String, Phase)> = [0.0, 1e-7, 0.3, 0.83, 0.97, -0.4]
        .iter()
        .map(|&g| {
            (format!("Henyey-Greenstein {g}"), Phase::HenyeyGreenstein(HenyeyGreenstein::new(g).unwrap()))
        })
        .collect();
    phases.push(("Mie of the mean diameter".to_owned(), Phase::Table(mean_diameter)));
    phases.push(("two wavelengths and altitudes".to_owned(), Phase::Table(fog_tests::scenes::small_table())));
    let store = PhaseNodes::default();
    let nodes = phase_grid::nodes();
    for (name, phase) in &phases {
        let view = phase.view(&store);
        let lanes = view.lanes(&Wavelengths::monochromatic(520.0));
        // Cells of about equal probability, cut at nodes; the density is linear between nodes or nearly so.
        let p = |m: f64| f64::from(view.eval(0, m as f32, &lanes)[0]);
        let (mut edges, mut expected, mut mass) = (vec![0.0], Vec::new(), 0.0);
        for i in 0..nodes.len() - 1 {
            // Simpson on 8 pieces of the interval
            let (a, h) = (nodes[i], (nodes[i + 1] - nodes[i]) / 8.0);
            for k in 0..8 {
                let x = a + h * f64::from(k);
                mass += math::TAU * h / 6.0 * (p(x) + 4.0 * p(x + 0.5 * h) + p(x + h));
            }
            if mass > 0.01 || i + 2 == nodes.len() {
                edges.push(nodes[i + 1]);
                expected.push(mass * SAMPLES as f64);
                mass = 0.0;
            }
        }
        let total: f64 = expected.iter().sum::<f64>() / SAMPLES as f64;
        assert!((total - 1.0).abs() < 1e-4, "{name} integrates to {total}");
        let mut observed = vec![0u64; expected.len()];
        let mut rng = PathRng::new(11, 0, 0);
        for _ in 0..SAMPLES {
            let m = view.sample(0, &lanes, rng.uniform_f64(), rng.uniform());
            let cell = edges.partition_point(|&e| e <= f64::from(m)).clamp(1, expected.len()) - 1;
            observed[cell] += 1;
        }
        assert_follows(name, &observed, &expected, phases.len());
    }
}

#[test]
fn reflection() {
    let dielectric = |roughness| SurfaceParameters {
        base_color: [0.6, 0.3, 0.1],
        metallic: 0.0,
        roughness,
        f0: [0.04; 3],
        ..SurfaceParameters::default()
    };
    let lambert = SurfaceParameters { f0: [0.0; 3], f90: 0.0, ..dielectric(1.0) };
    let metal = |roughness| SurfaceParameters { metallic: 1.0, ..dielectric(roughness) };
    let materials = [lambert, dielectric(0.3), dielectric(0.8), metal(0.4), metal(1.0)];
    let cosines = [0.05f32, 0.5, 0.99];
    const ROWS: usize = 24;
    const COLUMNS: usize = 24;
    for (k, material) in materials.iter().enumerate() {
        let bsdf = Bsdf::new(material, &[Spectrum::ONE * (1.0 / 3.0); 3]);
        for cos in cosines {
            let wo = Vec3A::new((1.0 - cos * cos).sqrt(), 0.0, cos);
            let cell = |w: Vec3A| {
                let row = ((w.z * ROWS as f32) as usize).min(ROWS - 1);
                let turn = math::f32::atan2(w.y, w.x) / math::TAU_F32 + 0.5;
                row * COLUMNS + ((turn * COLUMNS as f32) as usize).min(COLUMNS - 1)
            };
            // Midpoint quadrature of the density over fine sub-cells, plus one cell for samples that reflect nothing.
            const FINE: usize = 40;
            let mut expected = vec![0.0; ROWS * COLUMNS + 1];
            let step = 1.0 / (ROWS * FINE) as f64 * math::TAU / (COLUMNS * FINE) as f64;
            for i in 0..ROWS * FINE {
                let z = (i as f32 + 0.5) / (ROWS * FINE) as f32;
                for j in 0..COLUMNS * FINE {
                    let phi = ((j as f32 + 0.5) / (COLUMNS * FINE) as f32 - 0.5) * math::TAU_F32;
                    let w = fog_core::warp::spherical(z, (1.0 - z * z).sqrt(), phi);
                    expected[cell(w)] += f64::from(bsdf.eval(wo, w).1) * step * SAMPLES as f64;
                }
            }
            let inside: f64 = expected.iter().sum();
            assert!(inside <= 1.002 * SAMPLES as f64, "density integrates to more than 1: {inside}");
            expected[ROWS * COLUMNS] = (SAMPLES as f64 - inside).max(0.0);
            let mut observed = vec![0u64; expected.len()];
            let mut rng = PathRng::new(17, k as u64, 0);
            for _ in 0..SAMPLES {
                let sample = bsdf.sample(wo, rng.uniform(), rng.uniform2());
                observed[sample.map_or(ROWS * COLUMNS, |s| cell(s.wi))] += 1;
            }
            if expected[ROWS * COLUMNS] < 1000.0 {
                // What is left over here is the quadrature's error: leave the cell out.
                expected.truncate(ROWS * COLUMNS);
                observed.truncate(ROWS * COLUMNS);
            }
            assert_follows(&format!("material {k}, cos {cos}"), &observed, &expected, 15);
        }
    }
}

#[test]
fn reflection_is_reciprocal_and_conserves_energy() {
    let mut rng = PathRng::new(23, 0, 0);
    for _ in 0..2000 {
        let [metallic, roughness] = rng.uniform2();
        let material = SurfaceParameters {
            base_color: [rng.uniform(), rng.uniform(), rng.uniform()],
            metallic,
            roughness: 0.05 + 0.95 * roughness,
            f0: [0.2 * rng.uniform(); 3],
            ..SurfaceParameters::default()
        };
        let bsdf = Bsdf::new(&material, &[Spectrum::ONE * (1.0 / 3.0); 3]);
        let up = |rng: &mut PathRng| {
            let w = fog_core::warp::uniform_sphere(rng.uniform2());
            Vec3A::new(w.x, w.y, w.z.abs().max(0.01)).normalize()
        };
        let (a, b) = (up(&mut rng), up(&mut rng));
        let (ab, ba) = (bsdf.eval(a, b).0[0] / b.z, bsdf.eval(b, a).0[0] / a.z);
        assert!((ab - ba).abs() <= 2e-4 * (ab + ba), "{ab} {ba} for {material:?}");
    }
    for roughness in [0.1, 0.5, 1.0] {
        for metallic in [0.0, 1.0] {
            let material = SurfaceParameters {
                base_color: [1.0; 3],
                metallic,
                roughness,
                f0: [0.04; 3],
                ..SurfaceParameters::default()
            };
            let bsdf = Bsdf::new(&material, &[Spectrum::ONE * (1.0 / 3.0); 3]);
            for cos in [0.1f32, 0.6, 1.0] {
                let wo = Vec3A::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let n = 200_000;
                let albedo = (0..n)
                    .filter_map(|_| bsdf.sample(wo, rng.uniform(), rng.uniform2()))
                    .map(|s| f64::from(s.weight[0]))
                    .sum::<f64>()
                    / f64::from(n);
                assert!((0.3..=1.005).contains(&albedo), "albedo {albedo} at {roughness} {metallic} {cos}");
            }
        }
    }
}

#[test]
fn free_flights() {
    let z = vec![0.0, 10.0, 40.0, 90.0, 100.0];
    let sigma = vec![0.01, 0.05, 0.0, 0.08, 0.02];
    let profile = ExtinctionProfile::new(0.0, z, vec![550.0], sigma, vec![1.0; 5]).unwrap();
    let lanes = profile.lanes(&Wavelengths::monochromatic(550.0));
    let rays = [(5.0, 0.4), (95.0, -0.7), (50.0, 0.0), (5.0, 1e-6), (-20.0, 0.9)];
    for (y0, dy) in rays {
        let length = profile.clip(y0, dy, 500.0).unwrap().exit;
        const CELLS: usize = 60;
        let survive = |k: usize| {
            math::f64::exp(-profile.optical_depth_at(y0, dy, length * k as f64 / CELLS as f64, 550.0))
        };
        let mut expected: Vec<f64> =
            (0..CELLS).map(|k| (survive(k) - survive(k + 1)) * SAMPLES as f64).collect();
        expected.push(survive(CELLS) * SAMPLES as f64);
        let mut observed = vec![0u64; CELLS + 1];
        let mut rng = PathRng::new(31, 0, 0);
        for _ in 0..SAMPLES {
            let tau = -math::f64::ln(1.0 - rng.uniform_f64());
            let cell = match profile.free_flight(y0, dy, length, tau, &lanes) {
                Some(t) => ((t / length * CELLS as f64) as usize).min(CELLS - 1),
                None => CELLS,
            };
            observed[cell] += 1;
        }
        assert_follows(&format!("flight from {y0} at {dy}"), &observed, &expected, rays.len());
    }
}

#[test]
fn wavelengths() {
    let observer = Observer::new();
    const CELLS: usize = 100;
    let mut rng = PathRng::new(41, 0, 0);
    for lane in [0, 3, 7] {
        let mut observed = vec![0u64; CELLS];
        for _ in 0..SAMPLES {
            let nm = observer.sample_wavelengths(rng.uniform()).nm[lane];
            observed[(((nm - 380.0) / 400.0 * CELLS as f32) as usize).min(CELLS - 1)] += 1;
        }
        let expected = vec![SAMPLES as f64 / CELLS as f64; CELLS];
        assert_follows(&format!("wavelength lane {lane}"), &observed, &expected, 3);
    }
}

/// Directions about +Z in cells of equal solid angle, over m = 1 − z from 0 to `range`, against a density in 1/sr.
fn assert_directions(
    name: &str,
    range: f32,
    sample: impl Fn(&mut PathRng) -> Vec3A,
    density: impl Fn(Vec3A) -> f64,
) {
    const ROWS: usize = 20;
    const COLUMNS: usize = 20;
    const FINE: usize = 10;
    const FAMILY: usize = 5;
    let mut expected = vec![0.0; ROWS * COLUMNS];
    let step = f64::from(range) * math::TAU / (ROWS * COLUMNS * FINE * FINE) as f64;
    for i in 0..ROWS * FINE {
        let m = range * (i as f32 + 0.5) / (ROWS * FINE) as f32;
        for j in 0..COLUMNS * FINE {
            let phi = ((j as f32 + 0.5) / (COLUMNS * FINE) as f32 - 0.5) * math::TAU_F32;
            let w = warp::spherical(1.0 - m, (m * (2.0 - m)).sqrt(), phi);
            expected[i / FINE * COLUMNS + j / FINE] += density(w) * step * SAMPLES as f64;
        }
    }
    let total: f64 = expected.iter().sum::<f64>() / SAMPLES as f64;
    assert!((total - 1.0).abs() < 1e-3, "{name}: density integrates to {total}");
    let mut observed = vec![0u64; expected.len()];
    let mut rng = PathRng::new(43, 0, 0);
    for _ in 0..SAMPLES {
        let w = sample(&mut rng);
        assert!((w.length() - 1.0).abs() < 1e-5, "{name}: {w} has no unit length");
        // Near the axis z does not tell m, but x² + y² does.
        let across = w.x * w.x + w.y * w.y;
        let m = if w.z > 0.0 { across / (1.0 + (1.0 - across).max(0.0).sqrt()) } else { 1.0 - w.z };
        let row = ((m / range * ROWS as f32) as usize).min(ROWS - 1);
        let turn = math::f32::atan2(w.y, w.x) / math::TAU_F32 + 0.5;
        observed[row * COLUMNS + ((turn * COLUMNS as f32) as usize).min(COLUMNS - 1)] += 1;
    }
    assert_follows(name, &observed, &expected, FAMILY);
}

#[test]
fn directions() {
    let pi = std::f64::consts::PI;
    assert_directions("cosine", 1.0, |r| warp::cosine_hemisphere(r.uniform2()), |w| f64::from(w.z) / pi);
    assert_directions("sphere", 2.0, |r| warp::uniform_sphere(r.uniform2()), |_| 0.25 / pi);
    for m in [0.3, 1e-5] {
        let density = f64::from(warp::uniform_cone_pdf(m));
        assert_directions("cone", m, |r| warp::uniform_cone(r.uniform2(), m), |_| density);
    }
    // The sun's disc, seen in a frame about its centre.
    let sun = Sun::new(35.0, 150.0, 1.0, 5.0);
    let local = warp::frame(sun.direction).transpose();
    let density = f64::from(sun.pdf());
    assert_directions("sun", sun.one_minus_cos, |r| local * sun.sample(r.uniform2()), |_| density);
}

#[test]
fn points_of_emitters() {
    // Three triangles of other sizes and radiances; cells are thirds along both edges of each.
    let corners = |x: f32, a: f32, b: f32| [Vec3A::X * x, Vec3A::X * (x + a), Vec3A::X * x + Vec3A::Y * b];
    let triangles = [
        (1, corners(0.0, 2.0, 1.0), 3.0),
        (4, corners(10.0, 0.5, 4.0), 1.0),
        (6, corners(20.0, 2.0, 3.0), 7.0),
    ];
    let all = triangles.map(|(triangle, corners, radiance)| EmitterTriangle {
        triangle,
        corners,
        two_sided: false,
        per_edge: 1,
        radiance: vec![radiance],
    });
    let emitters = Emitters::new(&all, 8);
    let from = Vec3A::new(8.0, 2.0, 5.0);
    let pdf_area = |triangle, [u, v]: [f32; 2]| emitters.pdf_area(&Hit { t: 1.0, triangle, u, v }, from);
    const SIDE: usize = 6;
    let cell = |[u, v]: [f32; 2]| {
        let index = |x: f32| ((x * SIDE as f32) as usize).min(SIDE - 1);
        index(u) * SIDE + index(v)
    };
    let mut expected = vec![0.0; 3 * SIDE * SIDE];
    for (k, &(triangle, [a, b, c], _)) in triangles.iter().enumerate() {
        let area = 0.5 * f64::from((b - a).cross(c - a).length());
        let mass = f64::from(pdf_area(triangle, [0.2, 0.3])) * area * SAMPLES as f64;
        // Share of the triangle in each cell: the diagonal halves those that it crosses.
        for i in 0..SIDE {
            for j in 0..SIDE - i {
                let share = if i + j + 1 == SIDE { 0.5 } else { 1.0 };
                expected[k * SIDE * SIDE + i * SIDE + j] = mass * share * 2.0 / (SIDE * SIDE) as f64;
            }
        }
    }
    let mut observed = vec![0u64; expected.len()];
    let mut rng = PathRng::new(47, 0, 0);
    for _ in 0..SAMPLES {
        let point = emitters.sample(Breadth::Compact, from, rng.uniform_f64(), rng.uniform2()).unwrap();
        let k = triangles.iter().position(|t| t.0 == point.triangle).unwrap();
        let [a, b, c] = triangles[k].1;
        let [u, v] = point.barycentric;
        assert!((point.position - (a + (b - a) * u + (c - a) * v)).length() < 1e-5);
        assert_eq!(point.pdf_area, pdf_area(point.triangle, point.barycentric));
        observed[k * SIDE * SIDE + cell(point.barycentric)] += 1;
    }
    assert_follows("points of emitters", &observed, &expected, 1);
}

#[test]
fn choices_of_a_light_tree() {
    // Lamps of very different strength, two of three of them with cones.
    let lamps = (0..200u64).map(|i| {
        let mut rng = PathRng::new(53, 0, i);
        let mut place = || 100.0 * (rng.uniform() - 0.5);
        let position = Vec3A::new(place(), 0.1 * place(), place());
        let axis = warp::uniform_sphere(rng.uniform2());
        let intensity = [0.1 + 50.0 * rng.uniform().powi(4); 3];
        if i % 3 == 0 {
            Lamp::even(position, intensity)
        } else {
            Lamp::spot(position, intensity, Cone { axis, cos_inner: 0.9, cos_outer: -0.3 })
        }
    });
    let tree = LightTree::new(lamps);
    let (origin, direction) = (Vec3A::new(-60.0, 3.0, 8.0), Vec3A::X);
    let receivers = [
        Receiver::Point(Vec3A::new(3.0, 2.0, -5.0)),
        Receiver::Point(Vec3A::new(0.0, 200.0, 0.0)),
        Receiver::Segment { origin, direction, enter: 2.0, exit: 90.0, angles: None },
        Receiver::Segment { origin, direction, enter: 0.0, exit: f32::INFINITY, angles: None },
    ];
    for (k, receiver) in receivers.iter().enumerate() {
        let all = 0..tree.lights().len();
        let mut expected: Vec<f64> =
            all.map(|i| f64::from(tree.probability(i, receiver)) * SAMPLES as f64).collect();
        // The last cell: no light, where both halves of a node turn out to be out of reach.
        let none = SAMPLES as f64 - expected.iter().sum::<f64>();
        assert!(none > -1e-4 * SAMPLES as f64, "receiver {k}: probabilities sum to more than 1");
        expected.push(none.max(0.0));
        let mut observed = vec![0u64; expected.len()];
        let mut rng = PathRng::new(59, 0, k as u64);
        for _ in 0..SAMPLES {
            let chosen = tree.choose(receiver, rng.uniform_f64());
            observed[chosen.map_or(expected.len() - 1, |(light, _)| light)] += 1;
        }
        assert_follows(&format!("lights for receiver {k}"), &observed, &expected, receivers.len());
    }
}

#[test]
fn stratified_dimensions_are_uniform_together() {
    // Position in the pixel, wavelength and first flight of many pixels: cells of the four dimensions by three.
    let mut observed = vec![0u64; 81];
    let (pixels, samples) = (20_000u64, 16u64);
    for pixel in 0..pixels {
        for s in 0..samples {
            let p = fog_core::random::stratified(5, pixel, s, 1);
            let [x, y] = p.pixel;
            let cell = [x, y, p.wavelength, p.flight].iter().fold(0, |cell, u| cell * 3 + (u * 3.0) as usize);
            observed[cell] += 1;
        }
    }
    let expected = vec![(pixels * samples) as f64 / 81.0; 81];
    // The samples of a pixel are more even than independent ones, so that the statistic is small if it is not large.
    assert_follows("first dimensions", &observed, &expected, 1);
}
