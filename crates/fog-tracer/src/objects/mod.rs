//! The things in a picture: where they are, how much of each is seen, and whether it stands out.
//!
//! Rays and projections are those of [`Camera::ray`] and [`Camera::project`] alone, so that every lens will do.

mod contrast;
mod detect;
mod image_box;
mod keypoints;
mod nearest;
mod oriented_box;
mod silhouette;

pub use contrast::Contrast;
pub use detect::{Hidden, Verdict};
pub use image_box::ImageBox;
pub use keypoints::Keypoint;
pub use oriented_box::OrientedBox;

use contrast::Surroundings;
use fog_film::Frame;
use fog_scene::camera::Camera;
use fog_scene::labels::Labels;
use fog_scene::scene::Scene;
use rayon::prelude::*;
use silhouette::Window;

/// A frame whose things are asked for.
#[derive(Clone, Copy, Debug)]
pub struct LabelledView<'a> {
    /// The scene, with its fog.
    pub scene: &'a Scene,
    /// The camera.
    pub camera: &'a Camera,
    /// Its instances.
    pub labels: &'a Labels,
    /// The picture, with the instance of every pixel.
    pub frame: &'a Frame,
    /// The same view in clear air, if it is known.
    pub clear: Option<&'a Frame>,
}

/// A thing, as a camera sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectTruth {
    /// Its number.
    pub instance: u16,
    /// Box around its projection, in the image and beside it, as if nothing stood in front of it.
    pub full_box: ImageBox,
    /// Box around its visible pixels: left, top, right and bottom edges in whole pixels.
    pub visible_box: Option<[u32; 4]>,
    /// Number of pixels whose centres show it.
    pub visible_pixels: u64,
    /// Number of pixels whose centres would show it if nothing else were there.
    pub silhouette_pixels: u64,
    /// Share of the silhouette's pixels that something else hides; none where it has no pixels.
    pub occlusion: Option<f64>,
    /// Share of the projection that is outside of the image, within the full box; 0 to 1.
    pub truncation: f64,
    /// Box in the world.
    pub oriented_box: OrientedBox,
    /// Least distance of its surface from the camera in metres.
    pub nearest_m: f64,
    /// Its named points.
    pub keypoints: Vec<Keypoint>,
    /// Mean transmittance over the visible pixels, as the frame's; none without visible pixels.
    pub transmittance: Option<[f64; 3]>,
    /// Contrast with its surroundings in the picture; none without visible pixels or surroundings.
    pub contrast: Option<Contrast>,
    /// The same of what the surfaces send off themselves: the light that came straight, over its transmittance. None where the
    /// fog is too deep to tell.
    pub unveiled_contrast: Option<f64>,
    /// The same in clear air.
    pub clear_contrast: Option<Contrast>,
}

/// All things that reach into the image, hidden ones too, in the order of their numbers.
///
/// # Panics
/// If the frame has no instances, or is of another size than the camera's image.
#[must_use]
pub fn objects(view: &LabelledView<'_>) -> Vec<ObjectTruth> {
    let seen = visible(view);
    let keypoints = keypoints::by_instance(view);
    (1..=view.labels.instances().len())
        .into_par_iter()
        .filter_map(|id| object(view, id as u16, &seen[id], &keypoints[id]))
        .collect()
}

/// Visible pixels of a thing.
#[derive(Clone, Debug, Default)]
struct Visible {
    pixels: u64,
    bounds: Option<[u32; 4]>,
}

/// Grows bounds (left, top, right, bottom) by a pixel.
fn grow(bounds: &mut Option<[u32; 4]>, x: u32, y: u32) {
    let [l, t, r, b] = bounds.unwrap_or([x, y, x + 1, y + 1]);
    *bounds = Some([l.min(x), t.min(y), r.max(x + 1), b.max(y + 1)]);
}

/// Visible pixels by instance; those of instance 0 are sky and unlabeled.
fn visible(view: &LabelledView<'_>) -> Vec<Visible> {
    let mut all = vec![Visible::default(); view.labels.instances().len() + 1];
    for (i, &id) in view.frame.truth.surface.instance.iter().enumerate() {
        let one = &mut all[usize::from(id)];
        one.pixels += 1;
        grow(&mut one.bounds, i as u32 % view.camera.width, i as u32 / view.camera.width);
    }
    all
}

fn object(
    view: &LabelledView<'_>,
    id: u16,
    seen: &Visible,
    keypoints: &[keypoints::Named],
) -> Option<ObjectTruth> {
    let instance = &view.labels.instances()[usize::from(id) - 1];
    let geometry = &view.scene.loaded().geometry;
    let triangles = || instance.triangles.iter().map(|&t| &geometry.triangles()[t as usize]);
    let projected = ImageBox::around(view.camera, triangles());
    let window = Window::of(view.camera, projected.as_ref(), seen.bounds)?;
    let part = geometry.part(&instance.triangles);
    let mask = (&view.frame.truth.surface.instance[..], id);
    let silhouette = silhouette::inside(view.camera, &part, mask, &window);
    let full_box = ImageBox::or_bounds(projected, silhouette.bounds)?;
    let truncation = silhouette::truncation(view.camera, &part, &full_box, silhouette.pixels);
    let around = seen.bounds.and_then(|bounds| Surroundings::new(view, id, seen.pixels, bounds));
    let share = |hidden: u64| hidden as f64 / silhouette.pixels as f64;
    Some(ObjectTruth {
        instance: id,
        full_box,
        visible_box: seen.bounds,
        visible_pixels: seen.pixels,
        silhouette_pixels: silhouette.pixels,
        occlusion: (silhouette.pixels > 0).then(|| share(silhouette.pixels - seen.pixels)),
        truncation,
        oriented_box: OrientedBox::of(view.scene.loaded(), instance),
        nearest_m: nearest::distance(view.camera.pose.position.as_dvec3(), triangles()),
        keypoints: keypoints.iter().map(|named| Keypoint::seen(view, named)).collect(),
        transmittance: (seen.pixels > 0).then(|| mean_transmittance(view, id, seen)),
        contrast: around.as_ref().and_then(|around| around.contrast(view.frame)),
        unveiled_contrast: around.as_ref().and_then(|around| around.unveiled(view.frame)),
        clear_contrast: around.as_ref().and_then(|around| around.contrast(view.clear?)),
    })
}

/// Mean over the visible pixels.
fn mean_transmittance(view: &LabelledView<'_>, id: u16, seen: &Visible) -> [f64; 3] {
    let [left, top, right, bottom] = seen.bounds.unwrap_or_default();
    let truth = &view.frame.truth;
    let mut sum = [0.0; 3];
    for y in top..bottom {
        for x in left..right {
            let i = (y * view.camera.width + x) as usize;
            if truth.surface.instance[i] == id {
                for (sum, t) in sum.iter_mut().zip(truth.transmittance[i]) {
                    *sum += f64::from(t);
                }
            }
        }
    }
    sum.map(|sum| sum / seen.pixels as f64)
}
