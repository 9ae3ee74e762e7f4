use super::*;
use crate::math::TAU;

const TYPICAL: Patchiness =
    Patchiness { density_sd: 0.5, top_sd_m: 8.0, length_m: 120.0, octaves: 3, seed: 7 };

fn field(density_sd: f64, octaves: u32, seed: u64) -> PatchyField {
    PatchyField::new(Patchiness { density_sd, octaves, seed, ..TYPICAL }).unwrap()
}

/// A position far from everything before it.
fn anywhere(rng: &mut PathRng) -> [f64; 2] {
    [1e6 * (rng.uniform_f64() - 0.5), 1e6 * (rng.uniform_f64() - 0.5)]
}

#[test]
fn moments_over_the_plane_are_the_closed_forms() {
    let n = 200_000;
    let mut rng = PathRng::new(1, 0, 0);
    for (sd, octaves) in [(0.2, 1), (0.5, 3), (1.0, 4)] {
        let field = field(sd, octaves, 11);
        assert!((field.density_covariance(0.0, 0.0) / (sd * sd) - 1.0).abs() < 1e-9);
        assert!((field.top_covariance_m2(0.0, 0.0) / 64.0 - 1.0).abs() < 1e-12);
        // Sums of the factor f and offset h, their squares, and products with the values 13 m and 9 m away.
        let (dx, dz) = (13.0, -9.0);
        let mut sums = [0.0; 8];
        for _ in 0..n {
            let [x, z] = anywhere(&mut rng);
            let (f, h) = (field.density_factor(x, z), field.top_offset_m(x, z));
            let (f2, h2) = (field.density_factor(x + dx, z + dz), field.top_offset_m(x + dx, z + dz));
            let product = (f - 1.0) * (f2 - 1.0);
            let terms = [f, h, (f - 1.0).powi(2), h * h, product, h * h2, f * h, product * product];
            for (s, t) in sums.iter_mut().zip(terms) {
                *s += t / f64::from(n);
            }
        }
        let root = f64::from(n).sqrt();
        let [mean, mean_h, variance, variance_h, covariance, covariance_h, mixed, square] = sums;
        assert!((mean - 1.0).abs() < 5.0 * sd / root, "{sd}: mean {mean}");
        assert!(mean_h.abs() < 5.0 * 8.0 / root, "{sd}: mean of the top {mean_h}");
        assert!((variance / (sd * sd) - 1.0).abs() < 0.05, "{sd}: variance {variance}");
        assert!((variance_h / 64.0 - 1.0).abs() < 0.02, "{sd}: variance of the top {variance_h}");
        let exact = field.density_covariance(dx, dz);
        assert!((covariance - exact).abs() < 5.0 * square.sqrt() / root, "{sd}: {covariance} {exact}");
        let exact = field.top_covariance_m2(dx, dz);
        assert!((covariance_h - exact).abs() < 5.0 * 2.0 * 64.0 / root, "{sd}: {covariance_h} {exact}");
        assert!(mixed.abs() < 5.0 * 8.0 * (1.0 + sd) / root, "{sd}: density and top are related: {mixed}");
    }
}

#[test]
fn over_seeds_the_mean_is_one_and_directions_are_equal() {
    let n = 4000;
    let (mut mean, mut along_x, mut along_z) = (0.0, 0.0, 0.0);
    for seed in 0..n {
        let field = field(0.5, 2, seed);
        mean += field.density_factor(3.0, -5.0) / n as f64;
        along_x += field.top_covariance_m2(20.0, 0.0) / n as f64;
        along_z += field.top_covariance_m2(0.0, 20.0) / n as f64;
    }
    assert!((mean - 1.0).abs() < 5.0 * 0.5 / (n as f64).sqrt(), "{mean}");
    assert!((along_x - along_z).abs() < 0.5, "{along_x} {along_z}");
    // The mean over seeds is ∫ J₀(2π k r) over the band with the spectrum's weights; J₀(t) = mean of cos(t sin φ).
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in 0..200 {
        let up = 2.0 * (f64::from(i) + 0.5) / 200.0;
        let (k, weight) =
            (crate::math::f64::pow(2.0, up) / 120.0, crate::math::f64::pow(2.0, -2.0 * up / 3.0));
        let j0: f64 = (0..64)
            .map(|j| crate::math::f64::cos(TAU * k * 20.0 * crate::math::f64::sin(TAU * f64::from(j) / 64.0)))
            .sum();
        sum += weight * j0 / 64.0;
        weights += weight;
    }
    assert!((along_x - 64.0 * sum / weights).abs() < 0.5, "{along_x} {}", 64.0 * sum / weights);
}

#[test]
fn nothing_is_outside_of_the_band() {
    // Along a line, power at a wavenumber beyond the band is what the window leaks; within it, it is large.
    let field = field(0.5, 2, 3);
    let [low, high] = field.band_1_m();
    assert!((low - 1.0 / 120.0).abs() < 1e-15 && (high - 4.0 / 120.0).abs() < 1e-15);
    let n = 1 << 14;
    let step = 1.0;
    let line: Vec<[f64; 2]> = (0..n)
        .map(|i| {
            // Hann's window squared: leaks fall fast.
            let window = (0.5 - 0.5 * crate::math::cos_turns(f64::from(i) / f64::from(n))).powi(2);
            let x = step * f64::from(i);
            [
                window * field.top_offset_m(0.6 * x, 0.8 * x),
                window * ln(field.density_factor(0.6 * x, 0.8 * x)),
            ]
        })
        .collect();
    let power = |k: f64, which: usize| {
        let (mut re, mut im) = (0.0, 0.0);
        for (i, v) in line.iter().enumerate() {
            re += v[which] * crate::math::cos_turns(k * i as f64);
            im += v[which] * crate::math::cos_turns(k * i as f64 - 0.25);
        }
        re * re + im * im
    };
    for which in 0..2 {
        let inside: f64 =
            (0..64).map(|i| power(high * f64::from(i) / 64.0 + 1e-3, which)).fold(0.0, f64::max);
        for i in 1..20 {
            let beyond = power(1.1 * high + 0.02 * f64::from(i), which);
            assert!(beyond < 1e-9 * inside, "{which}: {beyond:e} {inside:e}");
        }
    }
}

#[test]
fn bounds_are_strict_and_close_on_small_areas() {
    let mut rng = PathRng::new(4, 0, 0);
    for case in 0..150 {
        let field = PatchyField::new(Patchiness {
            density_sd: if case == 0 { 0.0 } else { 2.0 * rng.uniform_f64() },
            top_sd_m: 50.0 * rng.uniform_f64(),
            length_m: 10.0 + 1e3 * rng.uniform_f64() * rng.uniform_f64(),
            octaves: 1 + case % 8,
            seed: rng.next_u64(),
        })
        .unwrap();
        let everywhere = field.density_bounds(&Area::EVERYWHERE);
        let top_everywhere = field.top_bounds_m(&Area::EVERYWHERE);
        for _ in 0..20 {
            let [x, z] = [0.02, 0.02].map(|s: f64| s * 1e6 * (rng.uniform_f64() - 0.5));
            let size = 100.0 * rng.uniform_f64() * rng.uniform_f64() * rng.uniform_f64();
            let area = Area { x_m: [x, x + size], z_m: [z, z + 0.5 * size] };
            let (bounds, top) = (field.density_bounds(&area), field.top_bounds_m(&area));
            assert!(everywhere[0] <= bounds[0] && bounds[1] <= everywhere[1]);
            assert!(top_everywhere[0] <= top[0] && top[1] <= top_everywhere[1]);
            for _ in 0..16 {
                let (px, pz) = (x + size * rng.uniform_f64(), z + 0.5 * size * rng.uniform_f64());
                let (f, h) = (field.density_factor(px, pz), field.top_offset_m(px, pz));
                assert!(f > 0.0 && bounds[0] <= f && f <= bounds[1], "{f} {bounds:?}");
                assert!(top[0] <= h && h <= top[1], "{h} {top:?}");
            }
        }
        let dot = Area { x_m: [5.0, 5.0 + 1e-6], z_m: [-3.0, -3.0 + 1e-6] };
        let [low, high] = field.density_bounds(&dot);
        assert!(high / low < 1.0 + 1e-3 && low > 0.0, "{low} {high}");
        let half = Area { x_m: [f64::NEG_INFINITY, 0.0], z_m: [0.0, 1.0] };
        assert!(field.density_bounds(&half)[1] <= everywhere[1]);
    }
}

#[test]
fn columns_keep_their_mean_optical_depth() {
    let even = |y: f64| if (10.0..=130.0).contains(&y) { 0.02 * (1.0 + (y - 10.0) / 120.0) } else { 0.0 };
    let field = field(0.5, 3, 5);
    let layer = field.layer(10.0, 130.0).unwrap();
    let mut rng = PathRng::new(8, 0, 0);
    let n = 20_000;
    let (mut mean, mut worst) = (0.0, 0.0f64);
    for i in 0..n {
        let [x, z] = anywhere(&mut rng);
        let ratio = field.density_factor(x, z) * (1.0 + field.top_offset_m(x, z) / 120.0);
        mean += ratio / f64::from(n);
        if i % 500 == 0 {
            // By quadrature through the column: midpoints, exact for a linear profile.
            let (top, steps) = (layer.top_m(x, z), 200);
            let dy = (top - 10.0) / f64::from(steps);
            let depth: f64 =
                (0..steps).map(|s| dy * layer.sigma_t([x, 10.0 + dy * (f64::from(s) + 0.5), z], even)).sum();
            worst = worst.max((depth / (ratio * 3.6) - 1.0).abs());
            assert_eq!(layer.sigma_t([x, top + 0.01, z], even), 0.0);
            assert_eq!(layer.sigma_t([x, 9.99, z], even), 0.0);
        }
    }
    assert!((mean - 1.0).abs() < 5.0 * 0.52 / f64::from(n).sqrt(), "{mean}");
    assert!(worst < 1e-10, "{worst:e}");

    let area = Area { x_m: [0.0, 20.0], z_m: [0.0, 20.0] };
    let [low, high] = layer.even_altitude_bounds_m(&area, [0.0, 70.0]);
    for _ in 0..1000 {
        let u = [20.0 * rng.uniform_f64(), 70.0 * rng.uniform_f64(), 20.0 * rng.uniform_f64()];
        let y = layer.even_altitude_m(u);
        assert!(low <= y && y <= high, "{y} {low} {high}");
    }
}

#[test]
fn even_fog_is_the_limit() {
    let even = PatchyField::new(Patchiness { density_sd: 0.0, top_sd_m: 0.0, ..TYPICAL }).unwrap();
    for x in [-1e6, 0.0, 33.3] {
        assert_eq!(even.density_factor(x, 7.0), 1.0);
        assert_eq!(even.top_offset_m(x, 7.0), 0.0);
    }
    assert_eq!(even.density_bounds(&Area::EVERYWHERE), [1.0, 1.0]);
    assert_eq!(even.density_covariance(1.0, 2.0), 0.0);
}

#[test]
fn values_are_pinned_and_depend_on_the_seed() {
    // A change here changes data sets of patchy fog: log it in CHANGELOG as value-breaking.
    let field = PatchyField::new(TYPICAL).unwrap();
    assert_eq!(field.density_factor(12.5, -40.0).to_bits(), 0x3fed4fec72c82d61);
    assert_eq!(field.top_offset_m(12.5, -40.0).to_bits(), 0x401c9b2cacc03111);
    let other = PatchyField::new(Patchiness { seed: 8, ..TYPICAL }).unwrap();
    assert_ne!(field.density_factor(0.0, 0.0), other.density_factor(0.0, 0.0));
}

#[test]
fn mistakes_are_named() {
    let refuse = |p: Patchiness| PatchyField::new(p).unwrap_err().to_string();
    for (wrong, words) in [
        (Patchiness { density_sd: -0.1, ..TYPICAL }, "density_sd is -0.1; valid: 0 to 2"),
        (Patchiness { density_sd: f64::NAN, ..TYPICAL }, "density_sd is NaN"),
        (Patchiness { top_sd_m: 2e3, ..TYPICAL }, "top_sd_m is 2000; valid: 0 to 1000 m"),
        (Patchiness { length_m: 0.0, ..TYPICAL }, "length_m is 0; valid: 0.1 to 1e6 m"),
        (Patchiness { length_m: f64::INFINITY, ..TYPICAL }, "length_m is inf"),
        (Patchiness { octaves: 0, ..TYPICAL }, "octaves is 0; valid: 1 to 8"),
        (Patchiness { octaves: 9, ..TYPICAL }, "octaves is 9; valid: 1 to 8"),
    ] {
        assert!(refuse(wrong).contains(words), "{}", refuse(wrong));
    }
    let field = PatchyField::new(TYPICAL).unwrap();
    assert!(field.layer(0.0, 180.0).is_ok());
    let thin = field.layer(0.0, 20.0).unwrap_err().to_string();
    assert!(thin.contains("top_sd_m is 8") && thin.contains("20 m"), "{thin}");
    for (base, top) in [(10.0, 10.0), (10.0, 0.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
        assert!(matches!(field.layer(base, top), Err(PatchinessError::Extent { .. })));
    }
}
