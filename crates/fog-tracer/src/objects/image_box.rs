//! Boxes around projections.

use fog_core::Vec3A;
use fog_scene::Triangle;
use fog_scene::camera::Camera;

/// A box in the image plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageBox {
    /// Left, top, right and bottom in pixels from the image's top left corner.
    pub sides: [f64; 4],
    /// True if the thing reaches farther: behind the camera, or beyond one image's width or height beside the image, where the
    /// box ends.
    pub is_cut: bool,
}

/// Projected edges are followed until they are straight to this many pixels ...
const STRAIGHT_PX: f64 = 0.25;
/// ... and cut in half so many times at most.
const DEPTH: u32 = 7;
/// Halvings by which the end of what a lens sees of an edge is found.
const BISECTIONS: u32 = 30;
/// Edges shorter than this are straight.
const SHORT_PX: f64 = 2.0;

impl ImageBox {
    /// Box around the projection of triangles, edge by edge; `None` if the lens sees nothing of them.
    pub(super) fn around<'t>(camera: &Camera, triangles: impl Iterator<Item = &'t Triangle>) -> Option<Self> {
        let mut outline = Outline { camera, sides: NOTHING, is_cut: false };
        for triangle in triangles {
            let [a, b, c] = triangle.positions.map(|corner| {
                let corner = Vec3A::from(corner);
                (corner, camera.project(corner))
            });
            for (from, to) in [(a, b), (b, c), (c, a)] {
                outline.edge(from, to, 0);
            }
        }
        let [width, height] = [camera.width, camera.height].map(f64::from);
        let limits = [-width, -height, 2.0 * width, 2.0 * height];
        let [l, t, r, b] = outline.sides;
        if l > r {
            return None;
        }
        let sides = [
            l.clamp(limits[0], limits[2]),
            t.clamp(limits[1], limits[3]),
            r.clamp(limits[0], limits[2]),
            b.clamp(limits[1], limits[3]),
        ];
        Some(Self { sides, is_cut: outline.is_cut || sides != outline.sides })
    }

    /// The box with the pixels of the silhouette inside, or around them alone.
    pub(super) fn or_bounds(projected: Option<Self>, pixels: Option<[u32; 4]>) -> Option<Self> {
        let Some(pixels) = pixels else { return projected };
        // A pixel is inside where its centre is.
        let [l, t, r, b] = pixels.map(f64::from);
        let centres = [l + 0.5, t + 0.5, r - 0.5, b - 0.5];
        let Some(this) = projected else { return Some(Self { sides: centres, is_cut: true }) };
        Some(Self { sides: union(this.sides, centres), ..this })
    }

    /// True if it has a point in an image.
    pub(super) fn meets(&self, camera: &Camera) -> bool {
        let [l, t, r, b] = self.sides;
        r > 0.0 && b > 0.0 && l < f64::from(camera.width) && t < f64::from(camera.height)
    }

    /// True if no point is outside of an image.
    pub(super) fn is_inside(&self, camera: &Camera) -> bool {
        let [l, t, r, b] = self.sides;
        !self.is_cut && l >= 0.0 && t >= 0.0 && r <= f64::from(camera.width) && b <= f64::from(camera.height)
    }
}

const NOTHING: [f64; 4] = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

fn union(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

/// A point and its image.
type Projected = (Vec3A, Option<[f64; 2]>);

struct Outline<'c> {
    camera: &'c Camera,
    sides: [f64; 4],
    is_cut: bool,
}

impl Outline<'_> {
    fn add(&mut self, [x, y]: [f64; 2]) {
        self.sides = union(self.sides, [x, y, x, y]);
    }

    fn project(&self, point: Vec3A) -> Projected {
        (point, self.camera.project(point))
    }

    fn edge(&mut self, a: Projected, b: Projected, depth: u32) {
        match (a.1, b.1) {
            (Some(p), Some(q)) => {
                self.add(p);
                self.add(q);
                if (p[0] - q[0]).hypot(p[1] - q[1]) > SHORT_PX && depth < DEPTH {
                    self.follow((a.0, p), (b.0, q), depth);
                }
            }
            (Some(p), None) => {
                self.add(p);
                self.leave(a.0, b.0);
            }
            (None, Some(q)) => {
                self.add(q);
                self.leave(b.0, a.0);
            }
            // The middle of a long edge may still be seen.
            (None, None) if depth < DEPTH && self.is_long(a.0, b.0) => {
                let middle = self.project(0.5 * (a.0 + b.0));
                self.is_cut = true;
                self.edge(a, middle, depth + 1);
                self.edge(middle, b, depth + 1);
            }
            (None, None) => self.is_cut = true,
        }
    }

    /// Halves an edge that its lens bends.
    fn follow(&mut self, (a, p): (Vec3A, [f64; 2]), (b, q): (Vec3A, [f64; 2]), depth: u32) {
        let middle = self.project(0.5 * (a + b));
        let bent = middle.1.is_none_or(|m| distance_from_segment(m, p, q) > STRAIGHT_PX);
        if bent {
            self.edge((a, Some(p)), middle, depth + 1);
            self.edge(middle, (b, Some(q)), depth + 1);
        }
    }

    /// Adds where an edge from a point that is seen to one that is not leaves what the lens sees.
    fn leave(&mut self, mut seen: Vec3A, mut unseen: Vec3A) {
        self.is_cut = true;
        for _ in 0..BISECTIONS {
            let (middle, image) = self.project(0.5 * (seen + unseen));
            match image {
                Some(image) => {
                    self.add(image);
                    seen = middle;
                }
                None => unseen = middle,
            }
        }
    }

    /// Whether an edge is long for its distance.
    fn is_long(&self, a: Vec3A, b: Vec3A) -> bool {
        let eye = self.camera.pose.position;
        (b - a).length() > 0.1 * (0.5 * (a + b) - eye).length()
    }
}

fn distance_from_segment(m: [f64; 2], p: [f64; 2], q: [f64; 2]) -> f64 {
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    let along = ((m[0] - p[0]) * dx + (m[1] - p[1]) * dy) / (dx * dx + dy * dy);
    let t = along.clamp(0.0, 1.0);
    (m[0] - p[0] - t * dx).hypot(m[1] - p[1] - t * dy)
}
