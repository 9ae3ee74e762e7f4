//! Rays against triangles: no leaks, the nearest hit, the same answers as a test of every triangle.

use fog_core::random::PathRng;
use fog_core::warp::uniform_sphere;
use fog_scene::{
    AlphaMode, Encoding, Filter, Geometry, Image, Material, Opacity, Texture, TextureRef, Triangle, Wrap,
};
use glam::{Vec3, Vec3A};
use std::sync::Arc;

/// A sphere of 2 · n² triangles with every vertex moved in or out, closed exactly.
fn bumpy_sphere(n: u32, centre: Vec3, radius: f32) -> Vec<Triangle> {
    let mut rng = PathRng::new(1, 2, 3);
    let (rows, columns) = (n, n);
    let mut vertices = Vec::new();
    for i in 0..=rows {
        for j in 0..columns {
            let theta = std::f32::consts::PI * i as f32 / rows as f32;
            let phi = 2.0 * std::f32::consts::PI * j as f32 / columns as f32;
            let (st, ct) = (fog_core::math::f32::sin(theta), fog_core::math::f32::cos(theta));
            let (sp, cp) = (fog_core::math::f32::sin(phi), fog_core::math::f32::cos(phi));
            let direction = match i {
                0 => Vec3::Y,
                i if i == rows => Vec3::NEG_Y,
                _ => Vec3::new(st * cp, ct, st * sp),
            };
            let bump = if i == 0 || i == rows { 1.0 } else { 0.9 + 0.2 * rng.uniform() };
            vertices.push(centre + direction * radius * bump);
        }
    }
    let vertex = |i: u32, j: u32| vertices[(i * columns + j % columns) as usize];
    let mut triangles = Vec::new();
    for i in 0..rows {
        for j in 0..columns {
            let (a, b, c, d) = (vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j));
            for corners in [[a, b, c], [a, c, d]] {
                let triangle = Triangle::flat(corners);
                if !triangle.is_degenerate() {
                    triangles.push(triangle);
                }
            }
        }
    }
    triangles
}

fn soup(n: usize, size: f32, seed: u64) -> Vec<Triangle> {
    let mut rng = PathRng::new(seed, 0, 0);
    let mut point =
        |scale: f32| Vec3::new(rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5) * scale;
    (0..n)
        .map(|_| {
            let centre = point(2.0);
            Triangle::flat([centre + point(size), centre + point(size), centre + point(size)])
        })
        .collect()
}

#[test]
fn closed_meshes_do_not_leak() {
    for (centre, radius) in [(Vec3::ZERO, 1.0), (Vec3::new(1000.0, -20.0, 500.0), 1.0), (Vec3::ZERO, 100.0)] {
        let triangles = bumpy_sphere(224, centre, radius);
        assert!(triangles.len() > 99_000);
        let geometry = Geometry::new(triangles.clone(), vec![]);
        let mut rng = PathRng::new(9, 9, 9);
        let mut leaks = 0;
        for i in 0..200_000 {
            let inside =
                Vec3A::from(centre) + uniform_sphere(rng.uniform2()) * (0.5 * radius * rng.uniform());
            let t = &triangles[(rng.next_u64() % triangles.len() as u64) as usize];
            let [a, b, c] = t.positions.map(Vec3A::from);
            let direction = match i % 4 {
                0 => uniform_sphere(rng.uniform2()),
                1 => a - inside,
                2 => (a + b) * 0.5 - inside,
                _ => a.lerp(c, rng.uniform()) - inside,
            };
            if geometry.intersect(inside, direction, f32::INFINITY).is_none()
                || !geometry.occluded(inside, direction, f32::INFINITY)
            {
                leaks += 1;
            }
        }
        assert_eq!(leaks, 0, "centre {centre}, radius {radius}");
    }
}

/// Nearest hit without a hierarchy: one geometry per triangle.
fn brute_force(single: &[Geometry], origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<(f32, u32)> {
    let mut best: Option<(f32, u32)> = None;
    for (i, geometry) in single.iter().enumerate() {
        if let Some(hit) = geometry.intersect(origin, direction, t_max)
            && best.is_none_or(|(t, _)| hit.t < t)
        {
            best = Some((hit.t, i as u32));
        }
    }
    best
}

#[test]
fn nearest_hit_is_that_of_brute_force() {
    let mut hits = 0;
    for (seed, n, size) in [(1, 1, 2.0), (2, 3, 1.0), (3, 17, 0.8), (4, 400, 0.6), (5, 2000, 0.4)] {
        let mut triangles = soup(n, size, seed);
        // Pairs at the same place: ties go to the lower one.
        triangles.extend(triangles.clone());
        let single: Vec<Geometry> = triangles.iter().map(|t| Geometry::new(vec![*t], vec![])).collect();
        let geometry = Geometry::new(triangles, vec![]);
        let mut rng = PathRng::new(seed, 7, 7);
        for i in 0..1500 {
            let origin = Vec3A::new(rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5) * 3.0;
            let mut direction = uniform_sphere(rng.uniform2()) * (0.1 + 3.0 * rng.uniform());
            match i % 5 {
                0 => {
                    direction =
                        [Vec3A::X, Vec3A::NEG_X, Vec3A::Y, Vec3A::NEG_Y, Vec3A::Z, Vec3A::NEG_Z][i / 5 % 6]
                }
                1 => direction[i / 5 % 3] = 0.0,
                2 => direction[i / 5 % 3] = -0.0,
                _ => {}
            }
            let t_max = if i % 2 == 0 { f32::INFINITY } else { rng.uniform() };
            let hit = geometry.intersect(origin, direction, t_max);
            let expected = brute_force(&single, origin, direction, t_max);
            assert_eq!(hit.map(|h| (h.t, h.triangle)), expected, "{origin} {direction} {t_max}");
            assert_eq!(geometry.occluded(origin, direction, t_max), expected.is_some());
            if let Some(hit) = hit {
                hits += 1;
                assert!((hit.triangle as usize) < n, "ties go to the first of a pair");
                let point = geometry.surface(&hit).position;
                assert!((origin + direction * hit.t - point).length() < 1e-5);
            }
        }
    }
    assert!(hits > 500, "only {hits} hits");
}

#[test]
fn extreme_rays_and_trees_are_harmless() {
    let empty = Geometry::default();
    assert!(empty.intersect(Vec3A::ZERO, Vec3A::X, 1.0).is_none() && empty.bounds().is_none());
    assert!(!empty.occluded(Vec3A::ZERO, Vec3A::X, 1.0));

    // Sizes over the whole range of exponents make a deep tree; one place for all a flat one.
    let chain = (0..200).map(|i| {
        let s = 2.0f32.powi(i / 4 - 20);
        Triangle::flat([Vec3::new(s, 0.0, 0.0), Vec3::new(s * 1.5, s * 0.1, 0.0), Vec3::new(s, 0.0, s * 0.1)])
    });
    let same = vec![Triangle::flat([Vec3::ZERO, Vec3::X, Vec3::Y]); 3000];
    for triangles in [chain.collect(), same] {
        let geometry = Geometry::new(triangles, vec![]);
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, 1e-45, f32::MAX] {
            for direction in [Vec3A::splat(bad), Vec3A::new(bad, 1.0, 0.0), Vec3A::new(0.0, -1.0, bad)] {
                let _ = geometry.intersect(Vec3A::ZERO, direction, f32::INFINITY);
                let _ = geometry.intersect(direction, Vec3A::Z, f32::INFINITY);
                let _ = geometry.occluded(Vec3A::ONE, direction, bad);
            }
        }
        for (i, t) in geometry.triangles().iter().enumerate().filter(|(i, _)| i % 37 == 0) {
            let target = Vec3A::from((t.positions[0] + t.positions[1] + t.positions[2]) / 3.0);
            let origin = target + t.normal() * target.length().max(0.1);
            assert!(geometry.occluded(origin, target - origin, 1.01), "triangle {i}");
        }
    }
}

#[test]
fn distance_limits_are_open() {
    let geometry = Geometry::new(
        vec![Triangle::flat([Vec3::NEG_ONE, Vec3::new(3.0, -1.0, -1.0), Vec3::new(-1.0, 3.0, -1.0)])],
        vec![],
    );
    let t = |t_max| geometry.intersect(Vec3A::ZERO, Vec3A::NEG_Z, t_max).map(|h| h.t);
    assert_eq!((t(1.0), t(1.000_001), t(-1.0)), (None, Some(1.0), None));
    assert!(!geometry.occluded(Vec3A::ZERO, Vec3A::NEG_Z, 1.0));
    assert!(geometry.intersect(Vec3A::NEG_Z, Vec3A::NEG_Z, 9.0).is_none(), "t = 0 does not count");
    // Both sides are hit, at distances close to zero too.
    assert!(geometry.intersect(Vec3A::new(0.0, 0.0, -1.000_001), Vec3A::Z, 9.0).is_some());
}

#[test]
fn cut_out_texels_are_passed() {
    // Left half solid, right half a hole, in front of an opaque wall.
    let image = Image::new(2, 1, vec![[255; 4], [255, 255, 255, 10]]).unwrap();
    let texture = Texture::new(Arc::new(image), Encoding::Srgb, Filter::Nearest, [Wrap::Clamp; 2]);
    let leaf = Material {
        base_color_texture: Some(TextureRef { texture: 0, set: 1 }),
        alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
        ..Material::default()
    };
    let corners = |z: f32| [Vec3::new(0.0, 0.0, z), Vec3::new(2.0, 0.0, z), Vec3::new(0.0, 2.0, z)];
    let mut front = Triangle { material: 1, ..Triangle::flat(corners(1.0)) };
    front.uv[1] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let wall = Triangle::flat(corners(0.0));
    let opacities = vec![None, Opacity::new(&leaf, &Arc::from([texture]))];
    let geometry = Geometry::new(vec![wall, front], opacities);
    assert!(!geometry.has_partial_opacity());
    let seen = |x: f32| geometry.intersect(Vec3A::new(x, 0.1, 5.0), Vec3A::NEG_Z, 9.0).map(|h| h.triangle);
    assert_eq!((seen(0.9), seen(1.1), seen(2.5)), (Some(1), Some(0), None));
    let blocked = |x: f32| geometry.occluded(Vec3A::new(x, 0.1, 5.0), Vec3A::NEG_Z, 4.5);
    assert_eq!((blocked(0.9), blocked(1.1)), (true, false));
}

#[test]
fn rays_leave_the_triangle_that_they_start_on() {
    let mut rng = PathRng::new(4, 4, 4);
    for scale in [0.01f32, 1.0, 100.0, 3000.0] {
        for offset in [0.0f32, 10.0, 3000.0] {
            for _ in 0..40 {
                let mut point = || {
                    Vec3::new(rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5) * scale + offset
                };
                let triangle = Triangle::flat([point(), point(), point()]);
                // Slivers have no normal to speak of.
                if triangle.area() < 0.02 * scale * scale {
                    continue;
                }
                let geometry = Geometry::new(vec![triangle], vec![]);
                for _ in 0..50 {
                    let [u, v] = fog_core::warp::uniform_triangle(rng.uniform2());
                    let surface = triangle.surface(u, v);
                    let direction = uniform_sphere(rng.uniform2());
                    let origin = surface.spawn_origin(direction);
                    assert!(!geometry.occluded(origin, direction, f32::INFINITY), "{triangle:?} {direction}");
                    assert!((origin - surface.position).length() < 1e-4 + 6e-6 * (scale + offset));
                }
            }
        }
    }
}
