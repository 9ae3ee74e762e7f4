//! The emitting triangles of a scene: a piece of a triangle is chosen by a light tree, a point uniformly on it.
//!
//! Triangles whose texture varies are cut into pieces of their own power each, so that bright texels are found more often
//! than dark ones.

use crate::aim::{Aim, Patch};
use crate::bvh::Hit;
use crate::light_tree::{Bound, Light, LightTree, Reach, Receiver};
use fog_core::warp;
use fog_core::{Vec3A, math};

/// Area of a triangle in m² from which on it counts as broad.
const BROAD_M2: f32 = 4.0;

/// Broad emitters are run into anyway and need few connections; compact ones need many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Breadth {
    /// Triangles below 4 m².
    Compact,
    /// The others.
    Broad,
}

/// One emitting triangle.
#[derive(Clone, Debug)]
pub struct EmitterTriangle {
    /// Id in the geometry.
    pub triangle: u32,
    /// Corners in the world.
    pub corners: [Vec3A; 3],
    /// Whether its back emits too.
    pub two_sided: bool,
    /// Pieces along each edge, 1 or more.
    pub per_edge: u32,
    /// Mean radiance of each of the `per_edge`² pieces up to a common factor, in the order of [`piece_at`].
    pub radiance: Vec<f32>,
}

/// A part of a triangle.
#[derive(Clone, Copy, Debug)]
struct Piece {
    triangle: u32,
    /// Barycentric weights (second and third corner of the triangle) of its corners.
    weights: [[f32; 2]; 3],
    corners: [Vec3A; 3],
    normal: Vec3A,
    /// Height of the middle of its box over its plane.
    lift: f32,
    radius: f32,
    two_sided: bool,
    area: f32,
    power: f64,
}

/// Where the pieces of a triangle are in the tree of its breadth.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Of the first piece in `leaves`.
    first: u32,
    /// 0 where nothing emits.
    per_edge: u16,
    breadth: Breadth,
}

/// All emitting triangles.
#[derive(Clone, Debug, Default)]
pub struct Emitters {
    compact: LightTree<Piece>,
    broad: LightTree<Piece>,
    aim: Aim,
    /// By triangle of the geometry; empty if nothing emits.
    places: Vec<Place>,
    /// Index in its tree of each piece; none where it is dark.
    leaves: Vec<Option<u32>>,
}

/// A point drawn on an emitter.
#[derive(Clone, Copy, Debug)]
pub struct EmitterPoint {
    /// Triangle of the geometry.
    pub triangle: u32,
    /// Weights of its second and third corner.
    pub barycentric: [f32; 2],
    /// World position.
    pub position: Vec3A,
    /// Density of the point, in 1/m².
    pub pdf_area: f32,
}

/// Index of the piece of a triangle with `per_edge` pieces along each edge that contains barycentric weights (u, v) of its
/// second and third corner: rows by u, within them by v, upright pieces and upside-down ones in turns.
#[must_use]
pub fn piece_at(per_edge: u32, u: f32, v: f32) -> usize {
    let n = per_edge as usize;
    let (x, y) = (u * n as f32, v * n as f32);
    let i = (x.max(0.0) as usize).min(n - 1);
    let j = (y.max(0.0) as usize).min(n - 1 - i);
    let flipped = i + j + 1 < n && (x - i as f32) + (y - j as f32) > 1.0;
    2 * n * i - i * i + 2 * j + usize::from(flipped)
}

/// Barycentric weights of the corners of each piece, in the order of [`piece_at`].
pub fn pieces(per_edge: u32) -> impl Iterator<Item = [[f32; 2]; 3]> {
    let at = move |i: u32, j: u32| [i as f32 / per_edge as f32, j as f32 / per_edge as f32];
    (0..per_edge).flat_map(move |i| {
        (0..2 * (per_edge - i) - 1).map(move |k| {
            let j = k / 2;
            if k % 2 == 0 {
                [at(i, j), at(i + 1, j), at(i, j + 1)]
            } else {
                [at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)]
            }
        })
    })
}

impl Light for Piece {
    const COSINE: bool = true;

    fn bound(&self) -> Bound {
        let [a, b, c] = self.corners;
        let reach =
            if self.two_sided { Reach::ALL } else { Reach { axis: self.normal, angle: 0.5 * math::PI_F32 } };
        Bound { lower: a.min(b).min(c), upper: a.max(b).max(c), strength: self.power, reach }
    }

    #[inline]
    fn share(&self, offset: Vec3A, squared: f32) -> f32 {
        let height = offset.dot(self.normal) + self.lift;
        let height = if self.two_sided { height.abs() } else { height };
        if height <= 0.0 {
            return 0.0;
        }
        // The cosine of the corner that sees the receiver best, or more.
        ((height + self.radius) / squared.sqrt()).min(1.0)
    }
}

impl Piece {
    fn new(t: &EmitterTriangle, weights: [[f32; 2]; 3], radiance: f32) -> Self {
        let [p0, p1, p2] = t.corners;
        let corners = weights.map(|[b1, b2]| p0 + (p1 - p0) * b1 + (p2 - p0) * b2);
        let [a, b, c] = corners;
        let (lower, upper) = (a.min(b).min(c), a.max(b).max(c));
        let normal = (p1 - p0).cross(p2 - p0).normalize_or_zero();
        let area = 0.5 * (b - a).cross(c - a).length();
        Self {
            triangle: t.triangle,
            weights,
            corners,
            normal,
            lift: (0.5 * (lower + upper) - a).dot(normal),
            radius: 0.5 * (upper - lower).length(),
            two_sided: t.two_sided,
            area,
            power: f64::from(area) * f64::from(radiance),
        }
    }
}

impl Piece {
    fn patch(&self) -> Patch {
        let [a, b, c] = self.corners;
        let Self { two_sided, area, .. } = *self;
        Patch { centre: (a + b + c) / 3.0, two_sided, area }
    }
}

impl Emitters {
    /// Prepares the sampling; pieces without power or area are left out. `count` is the geometry's triangle count.
    #[must_use]
    pub fn new(triangles: &[EmitterTriangle], count: usize) -> Self {
        let (mut trees, mut leaves) = ([Vec::new(), Vec::new()], Vec::new());
        let none = Place { first: 0, per_edge: 0, breadth: Breadth::Compact };
        let mut places = vec![none; if triangles.is_empty() { 0 } else { count }];
        for t in triangles {
            let [a, b, c] = t.corners;
            let broad = 0.5 * (b - a).cross(c - a).length() >= BROAD_M2;
            let breadth = if broad { Breadth::Broad } else { Breadth::Compact };
            let first = leaves.len() as u32;
            places[t.triangle as usize] = Place { first, per_edge: t.per_edge as u16, breadth };
            let tree = &mut trees[usize::from(broad)];
            for (weights, &radiance) in pieces(t.per_edge).zip(&t.radiance) {
                let piece = Piece::new(t, weights, radiance);
                let shines = piece.power > 0.0 && piece.normal != Vec3A::ZERO;
                leaves.push(shines.then_some(tree.len() as u32));
                if shines {
                    tree.push(piece);
                }
            }
        }
        let [compact, broad] = trees.map(LightTree::new);
        let aim = Aim::new(&broad.lights().iter().map(Piece::patch).collect::<Vec<_>>());
        Self { compact, broad, aim, places, leaves }
    }

    /// True if nothing emits.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.compact.lights().is_empty() && self.broad.lights().is_empty()
    }

    /// The emitting triangles: ids in the geometry.
    pub fn triangles(&self) -> impl Iterator<Item = u32> {
        let all = self.places.iter().enumerate();
        all.filter(|(_, place)| place.per_edge > 0).map(|(triangle, _)| triangle as u32)
    }

    /// True if there are emitters of this breadth.
    #[must_use]
    pub fn has(&self, breadth: Breadth) -> bool {
        !self.tree(breadth).lights().is_empty()
    }

    /// World y of the middle of each part of the emitters of this breadth, and its area in m².
    pub fn heights(&self, breadth: Breadth) -> impl Iterator<Item = (f32, f32)> {
        let middle = |piece: &Piece| piece.corners.iter().map(|corner| corner.y).sum::<f32>() / 3.0;
        self.tree(breadth).lights().iter().map(move |piece| (middle(piece), piece.area))
    }

    /// How often a path at a point is to aim at emitters of this breadth, in [0, 1]: never where it runs into them anyway.
    #[inline]
    #[must_use]
    pub fn aim(&self, breadth: Breadth, from: Vec3A) -> f32 {
        match breadth {
            Breadth::Compact => 1.0,
            Breadth::Broad => self.aim.at(from),
        }
    }

    fn tree(&self, breadth: Breadth) -> &LightTree<Piece> {
        match breadth {
            Breadth::Compact => &self.compact,
            Breadth::Broad => &self.broad,
        }
    }

    /// Breadth of a triangle of the geometry.
    #[inline]
    #[must_use]
    pub fn breadth(&self, triangle: u32) -> Breadth {
        self.places.get(triangle as usize).map_or(Breadth::Compact, |place| place.breadth)
    }

    /// Density in 1/m² with which [`Emitters::sample`], for the breadth of the triangle, finds the point of a hit of the
    /// geometry from `from`; 0 where nothing emits.
    #[inline]
    #[must_use]
    pub fn pdf_area(&self, hit: &Hit, from: Vec3A) -> f32 {
        let Some(place) = self.places.get(hit.triangle as usize).filter(|p| p.per_edge > 0) else {
            return 0.0;
        };
        let piece = piece_at(u32::from(place.per_edge), hit.u, hit.v);
        let Some(leaf) = self.leaves[place.first as usize + piece] else { return 0.0 };
        let tree = self.tree(place.breadth);
        let probability = tree.probability(leaf as usize, &Receiver::Point(from));
        probability / tree.lights()[leaf as usize].area
    }

    /// Draws a point of an emitter of this breadth to be seen from `from`; `None` if there is none.
    #[inline]
    #[must_use]
    pub fn sample(&self, breadth: Breadth, from: Vec3A, pick: f64, u: [f32; 2]) -> Option<EmitterPoint> {
        let tree = self.tree(breadth);
        let (chosen, probability) = tree.choose(&Receiver::Point(from), pick)?;
        let piece = &tree.lights()[chosen];
        let [b1, b2] = warp::uniform_triangle(u);
        let [w0, w1, w2] = piece.weights;
        let [p0, p1, p2] = piece.corners;
        Some(EmitterPoint {
            triangle: piece.triangle,
            barycentric: [0, 1].map(|k| w0[k] + (w1[k] - w0[k]) * b1 + (w2[k] - w0[k]) * b2),
            position: p0 + (p1 - p0) * b1 + (p2 - p0) * b2,
            pdf_area: probability / piece.area,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::random::PathRng;

    #[test]
    fn pieces_cover_their_triangle() {
        for per_edge in 1..9 {
            let mut area = 0.0;
            for (i, [a, b, c]) in pieces(per_edge).enumerate() {
                let centre = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
                assert_eq!(piece_at(per_edge, centre[0], centre[1]), i);
                area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
            }
            assert!((area - 0.5).abs() < 1e-5, "{per_edge}: {area}");
            for corner in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]] {
                assert!(piece_at(per_edge, corner[0], corner[1]) < (per_edge * per_edge) as usize);
            }
        }
    }

    fn panel(triangle: u32, at: Vec3A, edge: f32, radiance: &[f32]) -> EmitterTriangle {
        let per_edge = radiance.len().isqrt() as u32;
        let corners = [at, at + Vec3A::X * edge, at + Vec3A::Y * edge];
        EmitterTriangle { triangle, corners, two_sided: triangle == 2, per_edge, radiance: radiance.to_vec() }
    }

    #[test]
    fn points_follow_their_density() {
        // Compact ones with a dark piece, one that emits to both sides, one behind the receiver; and a broad one.
        let triangles = [
            panel(0, Vec3A::ZERO, 1.0, &[1.0, 0.0, 3.0, 0.5]),
            panel(2, Vec3A::new(3.0, 1.0, -2.0), 2.0, &[2.0]),
            panel(3, Vec3A::new(0.0, 0.0, 9.0), 1.0, &[100.0]),
            panel(5, Vec3A::new(-40.0, 0.0, -5.0), 30.0, &[1.0, 2.0, 3.0, 4.0]),
        ];
        let emitters = Emitters::new(&triangles, 7);
        let from = Vec3A::new(0.5, 0.7, 4.0);
        for (breadth, ids) in [(Breadth::Compact, &[0usize, 1, 2][..]), (Breadth::Broad, &[3])] {
            let mut rng = PathRng::new(1, 1, breadth as u64);
            let (mut counts, n) = ([[0u32; 4]; 4], 100_000);
            for _ in 0..n {
                let p = emitters.sample(breadth, from, rng.uniform_f64(), rng.uniform2()).unwrap();
                let id = triangles.iter().position(|t| t.triangle == p.triangle).unwrap();
                let t = &triangles[id];
                let [u, v] = p.barycentric;
                let [a, b, c] = t.corners;
                assert!((a + (b - a) * u + (c - a) * v - p.position).length() < 1e-5);
                let hit = Hit { t: 1.0, triangle: p.triangle, u, v };
                assert!((emitters.pdf_area(&hit, from) / p.pdf_area - 1.0).abs() < 1e-5);
                counts[id][piece_at(t.per_edge, u, v)] += 1;
            }
            let mut total = 0.0;
            for &id in ids {
                let t = &triangles[id];
                assert_eq!(emitters.breadth(t.triangle), breadth);
                for (i, [a, b, c]) in pieces(t.per_edge).enumerate() {
                    let [u, v] = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
                    let hit = Hit { t: 1.0, triangle: t.triangle, u, v };
                    let area = 0.5 * (t.corners[1] - t.corners[0]).length_squared()
                        / (t.per_edge * t.per_edge) as f32;
                    let want = f64::from(emitters.pdf_area(&hit, from) * area);
                    let got = f64::from(counts[id][i]) / f64::from(n);
                    let sigma = (want * (1.0 - want) / f64::from(n)).sqrt();
                    assert!((got - want).abs() < 5.0 * sigma + 1e-9, "{id} {i}: {got} for {want}");
                    total += want;
                    // Dark pieces and the back of a single-sided triangle are never chosen.
                    let dark = t.radiance[i] == 0.0 || t.triangle == 3;
                    assert_eq!(want == 0.0, dark, "{id} {i}");
                }
            }
            assert!((total - 1.0).abs() < 1e-4, "{breadth:?}: {total}");
        }
        assert_eq!(emitters.pdf_area(&Hit { t: 1.0, triangle: 1, u: 0.2, v: 0.2 }, from), 0.0);
        assert!(Emitters::new(&[], 7).sample(Breadth::Compact, from, 0.5, [0.1, 0.2]).is_none());
    }
}
