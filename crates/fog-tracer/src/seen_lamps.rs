//! Lamps that the camera sees: their own light, as the fog leaves it, in the pixels where they stand.
//!
//! A point has no radiance, but it gives the pupil an illuminance: E = I T / d² (Allard 1876). Spread over the solid angle Ω of
//! the pixel that it stands in, that is a mean radiance of E / Ω, what the renderer's box filter makes of any light smaller than
//! a pixel; the sum of radiance times solid angle over the pixels is E. No path finds a point by chance, and none is
//! needed: all of it is known, and added to the finished frame without noise.
//!
//! Lamps with a radius are discs, across the lamp's axis or towards the camera where it has none, and fill the pixels that
//! they cover; whether anything stands before them is asked of their middle. Reflections of lamps in mirrors and in wet roads
//! are still left to surfaces that are rough.

use fog_core::colour::{Observer, Rgb, VISIBLE_MIN_NM, upsample};
use fog_core::spectrum::Wavelengths;
use fog_core::{Vec3A, math, warp};
use fog_film::PointLight;
use fog_scene::camera::Camera;
use fog_scene::lamp::Lamp;
use fog_scene::light_groups::LightSource;
use fog_scene::scene::Scene;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Wavelengths at which transmittances are taken: every 5 nm from 380 to 780 nm, where colours are tabulated.
const STEP_NM: f32 = 5.0;
const ROWS: usize = 81;
/// Points of a disc for each pixel that it covers, and at least and at most.
const POINTS_PER_PIXEL: f64 = 64.0;
const POINTS: [f64; 2] = [64.0, 65_536.0];

/// Light of the scene's lamps that comes straight to the camera, pixel by pixel of each lamp; in a frame of one wavelength,
/// channel 0 holds the radiance there.
#[must_use]
pub fn seen_lamps(
    scene: &Scene,
    camera: &Camera,
    observer: &Observer,
    wavelength_nm: Option<f32>,
) -> Vec<PointLight> {
    let lamps: Vec<Vec<PointLight>> = scene
        .lamps()
        .lights()
        .par_iter()
        .enumerate()
        .map(|(i, lamp)| {
            let pixels = footprint(camera, lamp);
            if pixels.is_empty() {
                return Vec::new();
            }
            let Some(illuminance) = illuminance(scene, camera.pose.position, lamp, observer, wavelength_nm)
            else {
                return Vec::new();
            };
            let group = scene.light_group(LightSource::Lamp(i));
            let light = |(pixel, per_illuminance): (usize, f64)| {
                let [radiance, sensor] = illuminance.map(|rgb| rgb.map(|e| (e * per_illuminance) as f32));
                PointLight { pixel, group, radiance, sensor }
            };
            pixels.into_iter().map(light).collect()
        })
        .collect();
    lamps.concat()
}

/// Pixels that a lamp is seen in, each with its share of the lamp over its solid angle in sr.
fn footprint(camera: &Camera, lamp: &Lamp) -> BTreeMap<usize, f64> {
    let offset = lamp.position - camera.pose.position;
    let distance = f64::from(offset.length());
    let pixel = |point: Vec3A| {
        let image = camera.project(point).filter(|&image| camera.contains(image))?;
        let [x, y] = image.map(|c| c as u32);
        let solid_angle = camera.pixel_solid_angle(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let index = y as usize * camera.width as usize + x as usize;
        (solid_angle > 0.0).then_some((index, solid_angle))
    };
    let mut shares = BTreeMap::new();
    if lamp.radius_m == 0.0 || distance == 0.0 {
        shares.extend(pixel(lamp.position).map(|(index, solid_angle)| (index, 1.0 / solid_angle)));
        return shares;
    }
    let middle = camera.project(lamp.position);
    let solid_angle = middle.map_or(0.0, |[x, y]| camera.pixel_solid_angle(x, y));
    let covered = core::f64::consts::PI * f64::from(lamp.radius_m).powi(2) / (distance * distance);
    // A lens that sees nothing there, or so near that the disc fills everything: as many points as there may be.
    let wanted = if solid_angle > 0.0 { POINTS_PER_PIXEL * covered / solid_angle } else { POINTS[1] };
    let points = wanted.clamp(POINTS[0], POINTS[1]).ceil();
    let frame = warp::frame(lamp.axis().unwrap_or(-offset.normalize()));
    for k in 0..points as u32 {
        // A spiral of equal areas; the fraction of the turns is the golden section's.
        let r = f64::from(lamp.radius_m) * ((f64::from(k) + 0.5) / points).sqrt();
        let turns = (f64::from(k) * 0.618_033_988_749_894_9).fract();
        let (sin, cos) = math::sin_cos_turns(turns as f32);
        let place = frame * Vec3A::new(r as f32 * cos, r as f32 * sin, 0.0);
        if let Some((index, solid_angle)) = pixel(lamp.position + place) {
            *shares.entry(index).or_insert(0.0) += 1.0 / (points * solid_angle);
        }
    }
    shares
}

/// Illuminance that a lamp gives the camera, in the units of relative radiance times sr, and in those of the channels of a
/// sensor if the observer has one; `None` if none of it arrives.
fn illuminance(
    scene: &Scene,
    camera: Vec3A,
    lamp: &Lamp,
    observer: &Observer,
    wavelength_nm: Option<f32>,
) -> Option<[[f64; 3]; 2]> {
    let offset = lamp.position - camera;
    let distance = offset.length();
    let direction = offset / distance;
    let share = f64::from(lamp.falloff(-direction)) / f64::from(distance).powi(2);
    if !(share > 0.0 && share.is_finite()) {
        return None;
    }
    let clear = f64::from(scene.clear_share(camera, direction, distance * (1.0 - 1e-4)));
    if clear == 0.0 {
        return None;
    }
    let ray = (camera, direction, f64::from(distance));
    let colour = |nm: f32| upsampled(lamp.intensity, observer, nm);
    let arriving = match wavelength_nm {
        Some(nm) => {
            let radiance = f64::from(colour(nm)) * transmittances(scene, ray, [f64::from(nm)])[0];
            [[radiance, 0.0, 0.0], [0.0; 3]]
        }
        None => {
            let row_nm = |i: usize| f64::from(VISIBLE_MIN_NM + STEP_NM * i as f32);
            let transmittances = transmittances::<ROWS>(scene, ray, core::array::from_fn(row_nm));
            let spectrum = |nm: f32| {
                let row = ((nm - VISIBLE_MIN_NM) / STEP_NM).round() as usize;
                colour(nm) * transmittances[row.min(ROWS - 1)] as f32
            };
            let sensor = observer.sensor().map(|sensor| sensor.channels_of(spectrum));
            [observer.rgb_of(spectrum), sensor.unwrap_or([0.0; 3])]
        }
    };
    Some(arriving.map(|rgb| rgb.map(|c| c * share * clear)))
}

/// Transmittances of the fog along a ray.
fn transmittances<const N: usize>(
    scene: &Scene,
    (origin, direction, distance): (Vec3A, Vec3A, f64),
    wavelengths_nm: [f64; N],
) -> [f64; N] {
    scene.optical_depths_at(origin, direction, distance, wavelengths_nm).map(|tau| math::f64::exp(-tau))
}

/// Value of a colour's spectrum at one wavelength.
fn upsampled(rgb: Rgb, observer: &Observer, nm: f32) -> f32 {
    upsample(rgb, &observer.lane_basis(&Wavelengths::monochromatic(nm)))[0]
}
