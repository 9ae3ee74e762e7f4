//! Rays against one thing alone.

use super::{ImageBox, grow};
use fog_scene::Geometry;
use fog_scene::camera::Camera;
use rayon::prelude::*;

/// Pixels that may show a thing: left, top, right, bottom.
pub(super) struct Window([u32; 4]);

impl Window {
    /// The pixels of a box and of the visible pixels; `None` where neither is in the image.
    pub(super) fn of(camera: &Camera, full: Option<&ImageBox>, seen: Option<[u32; 4]>) -> Option<Self> {
        let [width, height] = [camera.width, camera.height].map(f64::from);
        // A pixel more on each side: the box is right to its rounding.
        let of_box = full.filter(|full| full.meets(camera)).map(|full| {
            let [l, t, r, b] = full.sides;
            let low = |v: f64, most: f64| (v.floor() - 1.0).clamp(0.0, most) as u32;
            let high = |v: f64, most: f64| (v.ceil() + 1.0).clamp(0.0, most) as u32;
            [low(l, width), low(t, height), high(r, width), high(b, height)]
        });
        match (of_box, seen) {
            (Some(a), Some(b)) => {
                Some(Self([a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]))
            }
            (a, b) => a.or(b).map(Self),
        }
    }
}

/// Pixels whose centres a thing covers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Silhouette {
    pub(super) pixels: u64,
    pub(super) bounds: Option<[u32; 4]>,
}

impl Silhouette {
    fn with(self, other: Self) -> Self {
        let corners = |[l, t, r, b]: [u32; 4]| [(l, t), (r - 1, b - 1)];
        let mut bounds = self.bounds;
        other.bounds.into_iter().flat_map(corners).for_each(|(x, y)| grow(&mut bounds, x, y));
        Self { pixels: self.pixels + other.pixels, bounds }
    }
}

/// The pixels of a window whose centre rays meet the triangles of `part`; where the mask shows the thing, it is there.
pub(super) fn inside(
    camera: &Camera,
    part: &Geometry,
    (mask, id): (&[u16], u16),
    Window([left, top, right, bottom]): &Window,
) -> Silhouette {
    let row = |y: u32| {
        let mut found = Silhouette::default();
        for x in *left..*right {
            let hit = mask[(y * camera.width + x) as usize] == id
                || camera
                    .ray(f64::from(x) + 0.5, f64::from(y) + 0.5)
                    .is_some_and(|ray| part.occluded(ray.origin, ray.direction, f32::INFINITY));
            if hit {
                found.pixels += 1;
                grow(&mut found.bounds, x, y);
            }
        }
        found
    };
    (*top..*bottom).into_par_iter().map(row).reduce(Silhouette::default, Silhouette::with)
}

/// Most rays that look for the part outside of the image.
const OUTSIDE_RAYS: f64 = 16_384.0;

/// Share of a projection outside of the image, within its full box: pixels inside against rays on a grid outside.
pub(super) fn truncation(camera: &Camera, part: &Geometry, full: &ImageBox, pixels_inside: u64) -> f64 {
    if full.is_inside(camera) {
        return 0.0;
    }
    // Whole pixels, so that small things are counted as inside of the image.
    let [left, top, right, bottom] =
        [full.sides[0].floor(), full.sides[1].floor(), full.sides[2].ceil(), full.sides[3].ceil()];
    let area = (right - left).max(1.0) * (bottom - top).max(1.0);
    let step = (area / OUTSIDE_RAYS).sqrt().ceil().max(1.0);
    let count = |length: f64| (length / step).ceil().max(1.0) as u32;
    let (columns, rows) = (count(right - left), count(bottom - top));
    let hits: u64 = (0..rows)
        .into_par_iter()
        .map(|row| {
            let y = top + (f64::from(row) + 0.5) * step;
            let beside = |&column: &u32| {
                let x = left + (f64::from(column) + 0.5) * step;
                !camera.contains([x, y]) && meets(camera, part, [x, y])
            };
            (0..columns).filter(beside).count() as u64
        })
        .sum();
    let outside = hits as f64 * step * step;
    if outside > 0.0 { outside / (outside + pixels_inside as f64) } else { 0.0 }
}

/// Whether the ray of an image point meets a thing there. Beside its image a lens may show the same direction twice.
fn meets(camera: &Camera, part: &Geometry, [x, y]: [f64; 2]) -> bool {
    let Some(ray) = camera.ray(x, y) else { return false };
    let Some(hit) = part.intersect(ray.origin, ray.direction, f32::INFINITY) else { return false };
    let back = camera.project(ray.origin + hit.t * ray.direction);
    back.is_some_and(|back| (back[0] - x).hypot(back[1] - y) < 0.5)
}
