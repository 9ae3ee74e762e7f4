use super::*;
use fog_core::colour::srgb_decode;

const RADIANCE: Scale = Scale::Radiance { exposure: 1.0 };

fn row(scale: Scale, rgb: &[[f32; 3]]) -> Picture {
    Picture { width: rgb.len() as u32, height: 1, scale, rgb: rgb.to_vec(), standard_error: None }
}

fn greys(values: &[f32]) -> Picture {
    row(RADIANCE, &values.iter().map(|&v| [v; 3]).collect::<Vec<_>>())
}

#[test]
fn equal_pictures_do_not_differ() {
    let p = row(RADIANCE, &[[0.0; 3], [0.2, 0.7, 0.1], [3.0, -0.1, 0.5]]);
    let c = compare(&p, &p).expect("comparable");
    assert_eq!(c.delta_e, DeltaE::default());
    assert_eq!(c.map, [0.0; 3]);
    assert_eq!((c.relative_mse, c.mean_relative_difference, c.relative_difference_of_means), (0.0, 0.0, 0.0));
    assert_eq!(c.mse_srgb8, 0.0);
    assert_eq!(c.psnr_db(), f64::INFINITY);
    assert_eq!(c.z_scores, None);
    assert!(c.of_radiance);
}

#[test]
fn a_uniform_change_of_radiance() {
    let (b, a) = (greys(&[0.2; 5]), greys(&[0.22; 5]));
    let c = compare(&a, &b).expect("comparable");
    let b2 = f64::from(0.2f32).powi(2);
    let d = f64::from(0.22f32) - f64::from(0.2f32);
    assert!((c.relative_mse / (d * d / (1.01 * b2)) - 1.0).abs() < 1e-12);
    assert!((c.relative_difference_of_means - d / f64::from(0.2f32)).abs() < 1e-12);
    assert!((c.mean_relative_difference - c.relative_difference_of_means).abs() < 1e-12);
    // The other way round only the sign of the means' difference and the reference change.
    let r = compare(&b, &a).expect("comparable");
    assert!(r.relative_difference_of_means < 0.0 && r.mean_relative_difference > 0.0);
    assert_eq!(r.map, c.map);
    // L* of 0.2 and 0.22 by hand: 116 ∛y − 16; mean over 50, so S_L > 1.
    let l = |y: f32| 116.0 * fog_core::math::f64::cbrt(f64::from(y)) - 16.0;
    let from_50 = (0.5 * (l(0.2) + l(0.22)) - 50.0).powi(2);
    let want = (l(0.22) - l(0.2)) / (1.0 + 0.015 * from_50 / (20.0 + from_50).sqrt());
    assert!((c.delta_e.mean - want).abs() < 1e-6, "{} is not {want}", c.delta_e.mean);
    // 0.2 and 0.22 are the bytes 124 and 129.
    assert_eq!(c.mse_srgb8, 25.0);
    assert!((c.psnr_db() - 34.151_403).abs() < 1e-6, "{}", c.psnr_db());
}

#[test]
fn one_pixel_of_many() {
    let mut values = vec![0.5; 101];
    let b = greys(&values);
    values[70] = 0.0;
    let c = compare(&greys(&values), &b).expect("comparable");
    assert_eq!((c.delta_e.median, c.delta_e.p95, c.delta_e.p99), (0.0, 0.0, 0.0));
    assert!((c.delta_e.mean * 101.0 / c.delta_e.max - 1.0).abs() < 1e-12);
    assert_eq!(c.map[70], c.delta_e.max as f32);
    assert!((c.relative_mse * 101.0 - 1.0 / 1.01).abs() < 1e-12);
    assert!((c.mean_relative_difference - 1.0 / 101.0).abs() < 1e-12);
}

#[test]
fn percentiles_are_linear_between_values() {
    let d = DeltaE::of(&[4.0, 1.0, 3.0, 2.0]);
    assert_eq!((d.mean, d.median, d.max), (2.5, 2.5, 4.0));
    assert!((d.p95 - 3.85).abs() < 1e-12 && (d.p99 - 3.97).abs() < 1e-12);
    assert_eq!(DeltaE::of(&[7.0]), DeltaE { mean: 7.0, median: 7.0, p95: 7.0, p99: 7.0, max: 7.0 });
}

#[test]
fn radiance_and_display() {
    // Radiance 1.5 and 3 at exposure 0.5 are shown as 0.75 and 1, whatever was clipped.
    let a = row(Scale::Radiance { exposure: 0.5 }, &[[1.5; 3], [3.0; 3]]);
    let b = row(Scale::Display, &[[0.75; 3], [1.0; 3]]);
    let c = compare(&a, &b).expect("comparable");
    assert!(!c.of_radiance);
    assert_eq!((c.delta_e.max, c.mse_srgb8, c.relative_mse), (0.0, 0.0, 0.0));
    // Both as radiance: not exposed and not clipped.
    let c = compare(&a, &row(RADIANCE, &[[0.75; 3], [1.0; 3]])).expect("comparable");
    assert!(c.of_radiance && c.delta_e.max == 0.0);
    assert_eq!(c.mean_luminance[0] / c.mean_luminance[1], 4.5 / 1.75);
}

#[test]
fn known_colours_of_bytes() {
    let decoded = |bytes: [u8; 3]| bytes.map(|b| srgb_decode(f32::from(b) / 255.0));
    let (red, green) = (decoded([255, 0, 0]), decoded([0, 255, 0]));
    let c = compare(&row(Scale::Display, &[red]), &row(Scale::Display, &[green])).expect("comparable");
    // 86.6 by every published calculator.
    assert!((c.delta_e.mean - 86.61).abs() < 0.02, "{}", c.delta_e.mean);
    assert_eq!(c.mse_srgb8, 2.0 * 255.0 * 255.0 / 3.0);
}

#[test]
fn black_references() {
    let (black, grey) = (greys(&[0.0; 2]), greys(&[0.5; 2]));
    assert_eq!(compare(&black, &black).expect("comparable").relative_mse, 0.0);
    let c = compare(&grey, &black).expect("comparable");
    assert!(
        [c.relative_mse, c.mean_relative_difference, c.relative_difference_of_means]
            .iter()
            .all(|v| *v == f64::INFINITY)
    );
}

#[test]
fn z_scores_weigh_with_both_errors() {
    let with =
        |values: &[f32], errors: &[f32]| Picture { standard_error: Some(errors.to_vec()), ..greys(values) };
    let a = with(&[1.5, 1.0, 7.0], &[0.3, 0.1, 0.0]);
    let b = with(&[1.0, 1.5, 1.0], &[0.4, 0.0, 0.0]);
    let z = compare(&a, &b).expect("comparable").z_scores.expect("errors are known");
    assert_eq!(z.pixels, 2);
    assert!((z.mean + 2.0).abs() < 1e-6 && (z.max - 5.0).abs() < 1e-6, "{z:?}");
    assert!((z.rms - 13f64.sqrt()).abs() < 1e-6 && z.beyond_3 == 0.5, "{z:?}");
    // One without errors counts as exact; none of radiance has none.
    let exact = greys(&[1.0, 1.5, 1.0]);
    let z = compare(&a, &exact).expect("comparable").z_scores.expect("errors are known");
    assert!((z.max - 5.0).abs() < 1e-6 && (z.mean + (5.0 - 5.0 / 3.0) / 2.0).abs() < 1e-6, "{z:?}");
    let display = Picture { scale: Scale::Display, ..exact };
    assert_eq!(compare(&a, &display).expect("comparable").z_scores, None);
}

#[test]
fn what_cannot_be_compared() {
    let e = compare(&greys(&[1.0]), &greys(&[1.0, 2.0])).expect_err("sizes differ").to_string();
    assert_eq!(e, "the pictures differ in size: A has 1 x 1 pixels, B has 2 x 1");
    let e = compare(&greys(&[1.0]), &greys(&[f32::NAN])).expect_err("not finite").to_string();
    assert_eq!(e, "B: the radiance of pixel (0, 0) is not finite");
}
