//! Images of the surroundings: aimed at without bias, in the right place, and where they are even no other than even light.

use crate::analog::assert_agree;
use crate::furnace::assert_white;
use fog_core::bands::{BandLanes, BandSpectrum};
use fog_core::colour::{Observer, Rgb};
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_core::{Vec3A, math, warp};
use fog_scene::cie_sky::CieSky;
use fog_scene::dome::Dome;
use fog_scene::medium::Medium;
use fog_scene::scene::Scene;
use fog_scene::sky_map::{SkyLanes, SkyMap};
use fog_tests::chi_square::assert_follows;
use fog_tests::scenes;

/// A dim coloured gradient with a bright patch, an eighth of the width of the image wide, 20° to 45° high in the east.
fn patchy_image(width: usize) -> SkyMap {
    let height = width / 2;
    let texel = |i: usize| -> Rgb {
        let (u, v) = ((i % width) as f32 / width as f32, (i / width) as f32 / height as f32);
        let bright = (0.6875..0.8125).contains(&u) && (0.25..0.39).contains(&v);
        if bright { [9.0, 8.0, 6.0] } else { [0.2 * u, 0.1, 0.5 * (1.0 - v)] }
    };
    SkyMap::from_rgb(width, height, (0..width * height).map(texel).collect()).expect("an image")
}

#[test]
fn an_even_image_is_a_white_furnace() {
    let image = SkyMap::from_rgb(8, 4, vec![[1.0; 3]; 32]).expect("an image");
    let profile = scenes::grey_profile(100.0, &[0.03, 0.06, 0.015], 1.0);
    let fogs = [None, Some(scenes::hg_fog(profile, 0.83)), Some(scenes::coloured_fog(100.0, 0.03, 1.0))];
    for (k, fog) in fogs.into_iter().enumerate() {
        let scene = Scene::new(scenes::white_street(), fog, None, None, false);
        assert_white(&format!("even image {k}"), &scene.with_sky(Some(image.clone())), 20.0, -5.0, 48);
    }
    // An even sky over white ground, whose texels are spectra.
    let dome = Dome::of_colour(|_, _| 1.0, BandSpectrum::ONE, 1.0).expect("a sky");
    let scene = Scene::new(scenes::white_street(), None, None, None, false);
    assert_white("even sky", &scene.with_sky(Some(dome.map)), 20.0, -5.0, 48);
}

#[test]
fn aiming_agrees_with_running_into_it() {
    let grey = scenes::grey_profile(60.0, &[0.01, 0.03, 0.02, 0.005], 1.0);
    let fogs: [Option<Medium>; 3] =
        [None, Some(scenes::hg_fog(grey, 0.7)), Some(scenes::coloured_fog(80.0, 0.02, 0.95))];
    for fog in fogs {
        let scene = Scene::new(scenes::load("street_day.glb"), fog, None, None, false);
        let scene = scene.with_sky(Some(patchy_image(64).turned(70.0).scaled(0.5)));
        assert_agree("image", &scene, &[(20.0, 8.0), (-35.0, -4.0)], None, 60_000);
        assert_agree("image, short paths", &scene, &[(-35.0, -4.0)], Some(2), 60_000);
    }
}

#[test]
fn directions_follow_their_density() {
    const SAMPLES: u64 = 200_000;
    const ROWS: usize = 32;
    const COLUMNS: usize = 64;
    let basis = Observer::new().lane_basis(&Wavelengths::monochromatic(550.0));
    let bands = BandLanes::new(&Wavelengths::monochromatic(550.0));
    let lanes = SkyLanes { basis: &basis, bands: &bands };
    let clear = CieSky::General { kind: 12, sun_elevation_deg: 40.0 };
    let dome =
        Dome::of_colour(|e, h| clear.relative_luminance(e, h - 70.0), BandSpectrum::ONE, 0.2).expect("a sky");
    // The wide image has two by two texels in each cell of the sampler, and a row and a column that do not fill one.
    for (k, image) in [patchy_image(64), patchy_image(2300).turned(-100.0), dome.map].into_iter().enumerate()
    {
        let cell = |d: Vec3A| {
            let row = ((0.5 - 0.5 * d.y) * ROWS as f32) as usize;
            let turn = math::f32::atan2(d.z, d.x) / math::TAU_F32 + 0.5;
            row.min(ROWS - 1) * COLUMNS + ((turn * COLUMNS as f32) as usize).min(COLUMNS - 1)
        };
        const FINE: usize = 12;
        let mut expected = vec![0.0; ROWS * COLUMNS];
        let step = 2.0 * math::TAU / (ROWS * COLUMNS * FINE * FINE) as f64;
        for i in 0..ROWS * FINE {
            let y = 1.0 - 2.0 * (i as f32 + 0.5) / (ROWS * FINE) as f32;
            for j in 0..COLUMNS * FINE {
                let phi = ((j as f32 + 0.5) / (COLUMNS * FINE) as f32 - 0.5) * math::TAU_F32;
                let d = warp::spherical(y, (1.0 - y * y).sqrt(), phi);
                let d = Vec3A::new(d.x, d.z, d.y);
                expected[cell(d)] += f64::from(image.pdf(d)) * step * SAMPLES as f64;
            }
        }
        let total = expected.iter().sum::<f64>() / SAMPLES as f64;
        assert!((total - 1.0).abs() < 2e-3, "image {k}: the density integrates to {total}");
        let mut observed = vec![0; expected.len()];
        let mut rng = PathRng::new(3, k as u64, 0);
        for _ in 0..SAMPLES {
            let sample = image.sample([rng.uniform_f64(), rng.uniform_f64()], lanes);
            observed[cell(sample.direction)] += 1;
            let (radiance, pdf) = image.radiance_and_pdf(sample.direction, lanes);
            // Cells' edges may fall either way.
            if (pdf - sample.pdf).abs() < 1e-4 * pdf {
                assert!((radiance[0] - sample.radiance[0]).abs() < 2e-3 * (1.0 + radiance[0]));
            }
        }
        // The midpoint rule misplaces the patch's edges by half a step of 12 in a cell.
        let edges: Vec<usize> = (0..expected.len()).filter(|&i| uneven(&image, i, ROWS, COLUMNS)).collect();
        for i in edges {
            (observed[i], expected[i]) = (0, 0.0);
        }
        assert_follows(&format!("image {k}"), &observed, &expected, 3);
    }
}

/// Whether the density differs between the corners of a test cell by more than a fifth.
fn uneven(image: &SkyMap, cell: usize, rows: usize, columns: usize) -> bool {
    let at = |i: f32, j: f32| {
        let y = (1.0 - 2.0 * ((cell / columns) as f32 + i) / rows as f32).clamp(-1.0, 1.0);
        let phi = (((cell % columns) as f32 + j) / columns as f32 - 0.5) * math::TAU_F32;
        let d = warp::spherical(y, (1.0 - y * y).max(0.0).sqrt(), phi);
        image.pdf(Vec3A::new(d.x, d.z, d.y))
    };
    let corners = [at(-0.1, -0.1), at(1.1, -0.1), at(-0.1, 1.1), at(1.1, 1.1), at(0.5, 0.5)];
    let (least, most) = corners.iter().fold((f32::INFINITY, 0.0f32), |(a, b), &c| (a.min(c), b.max(c)));
    most > 1.2 * least
}

#[test]
fn a_bright_texel_is_where_it_should_be() {
    // Column 40 of 64 is 48° right of the centre (its middle), row 12 of 32 is 19.7° high.
    let mut texels = vec![[0.0; 3]; 64 * 32];
    texels[12 * 64 + 40] = [1.0; 3];
    let image = SkyMap::from_rgb(64, 32, texels).expect("an image");
    let middle = (40.5 / 64.0 - 0.5) * 360.0;
    let elevation = 90.0 - 12.5 / 32.0 * 180.0;
    for rotation in [0.0, 77.0, -200.0] {
        let scene = Scene::new(scenes::empty(), None, None, None, false);
        let scene = scene.with_sky(Some(image.turned(rotation)));
        let camera = scenes::camera(2.0, rotation + middle, elevation, 33, 33, 20.0);
        let frame = scenes::render(&scene, &camera, 16, None, 1);
        let brightest =
            (0..frame.pixel_count()).max_by(|&a, &b| frame.luminance(a).total_cmp(&frame.luminance(b)));
        let (x, y) = (brightest.unwrap() % 33, brightest.unwrap() / 33);
        assert!(x.abs_diff(16) <= 1 && y.abs_diff(16) <= 1, "rotation {rotation}: brightest at {x},{y}");
        assert!((frame.luminance(16 * 33 + 16) - 1.0).abs() < 0.1, "{}", frame.luminance(16 * 33 + 16));
    }
}
