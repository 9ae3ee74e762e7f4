use super::*;
use std::fs;

/// The library that `FOGBANK_OIDN` names; tests of it have nothing to test without.
fn denoiser() -> Option<Denoiser> {
    let Some(path) = std::env::var_os("FOGBANK_OIDN") else {
        eprintln!("FOGBANK_OIDN names no library: not tested");
        return None;
    };
    Some(Denoiser::load(Some(path.as_ref())).expect("the library that FOGBANK_OIDN names"))
}

const SIZE: [u32; 2] = [96, 64];

/// A grey wall of radiance 4 left and 0.5 right, without noise and with noise of more than half of that.
fn wall() -> [Vec<[f32; 3]>; 2] {
    let (mut clean, mut noisy) = (Vec::new(), Vec::new());
    let mut state = 1u32;
    for i in 0..SIZE[0] * SIZE[1] {
        let value = if i % SIZE[0] < SIZE[0] / 2 { 4.0 } else { 0.5 };
        clean.push([value; 3]);
        noisy.push([0; 3].map(|_| {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            value * (1.0 + ((state >> 8) as f32 / (1 << 23) as f32 - 1.0))
        }));
    }
    [clean, noisy]
}

fn error(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    let sum: f32 = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a / b - 1.0).powi(2)).sum();
    (sum / (3 * a.len()) as f32).sqrt()
}

#[test]
fn noise_goes_and_the_picture_stays() {
    let Some(denoiser) = denoiser() else { return };
    assert!(denoiser.version().starts_with("2."), "{}", denoiser.version());
    let [clean, noisy] = wall();
    let albedo: Vec<_> = clean.iter().map(|c| c.map(|v| v / 8.0)).collect();
    let normal = vec![[0.0, 0.0, 1.0]; clean.len()];
    let [width, height] = SIZE;
    let images = Images { width, height, radiance: &noisy, albedo: &albedo, normal: &normal };
    let denoised = denoiser.denoise(&images, 2).expect("denoised");
    let (before, after) = (error(&noisy, &clean), error(&denoised, &clean));
    assert!(before > 0.5 && after < 0.05, "{before} {after}");
    // The number of threads is nothing to see.
    let bits = |image: Vec<[f32; 3]>| image.into_iter().flatten().map(f32::to_bits).collect::<Vec<_>>();
    let bits_of_two = bits(denoised);
    for threads in [1, 3] {
        assert_eq!(bits(denoiser.denoise(&images, threads).expect("denoised")), bits_of_two, "{threads}");
    }
    for wrong in [Images { width: 1, ..images }, Images { normal: &normal[1..], ..images }] {
        assert!(matches!(denoiser.denoise(&wrong, 1), Err(Error::Shape { .. })));
    }
}

#[test]
fn what_is_no_such_library_is_refused() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let missing = Denoiser::load(Some(dir.path())).expect_err("an empty folder").to_string();
    assert!(
        missing.contains("cannot load Open Image Denoise from") && missing.contains(FILE_NAME),
        "{missing}"
    );
    let text = dir.path().join("text.so");
    fs::write(&text, "no library").expect("written");
    let refused = Denoiser::load(Some(&text)).expect_err("a text");
    assert!(matches!(&refused, Error::NotFound { reason, .. } if !reason.is_empty()), "{refused}");
}

#[cfg(target_os = "linux")]
#[test]
fn another_library_is_refused() {
    let refused = Denoiser::load(Some("libc.so.6".as_ref())).expect_err("the C library").to_string();
    assert_eq!(refused, "libc.so.6 is not Open Image Denoise 2: it has no function oidnNewDevice");
}
