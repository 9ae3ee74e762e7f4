//! The emitting triangles of a scene as one light: a triangle is drawn in proportion to its mean emitted power, a point
//! uniformly on it.

use fog_core::Vec3A;
use fog_core::warp;

/// One emitting triangle.
#[derive(Clone, Copy, Debug)]
pub struct EmitterTriangle {
    /// Id in the geometry.
    pub triangle: u32,
    /// Corners in the world.
    pub corners: [Vec3A; 3],
    /// Emitted power up to a common factor (area × mean radiance, twice if both sides emit).
    pub power: f64,
}

/// All emitting triangles with an alias table over their powers.
#[derive(Clone, Debug, Default)]
pub struct Emitters {
    triangles: Vec<EmitterTriangle>,
    alias: Vec<(f32, u32)>,
    area_m2: f32,
    /// Density in 1/m² of a point on each triangle of the geometry; 0 where nothing emits.
    density_by_triangle: Vec<f32>,
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

impl Emitters {
    /// Prepares the sampling; triangles without power or area are left out. `count` is the geometry's triangle count.
    #[must_use]
    pub fn new(triangles: Vec<EmitterTriangle>, count: usize) -> Self {
        let area = |t: &EmitterTriangle| {
            let [a, b, c] = t.corners;
            0.5 * (b - a).cross(c - a).length()
        };
        let triangles: Vec<_> = triangles.into_iter().filter(|t| t.power > 0.0 && area(t) > 0.0).collect();
        let total: f64 = triangles.iter().map(|t| t.power).sum();
        let mut density_by_triangle = vec![0.0; if triangles.is_empty() { 0 } else { count }];
        for t in &triangles {
            density_by_triangle[t.triangle as usize] = (t.power / total) as f32 / area(t);
        }
        let powers: Vec<f64> = triangles.iter().map(|t| t.power / total).collect();
        let area_m2 = triangles.iter().map(area).sum();
        Self { alias: alias_table(&powers), triangles, area_m2, density_by_triangle }
    }

    /// True if nothing emits.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The emitting triangles: ids in the geometry.
    pub fn triangles(&self) -> impl Iterator<Item = u32> {
        self.triangles.iter().map(|t| t.triangle)
    }

    /// Area of all emitting triangles together, in m².
    #[must_use]
    pub fn area_m2(&self) -> f32 {
        self.area_m2
    }

    /// Density in 1/m² with which [`Emitters::sample`] finds a point of this triangle of the geometry.
    #[inline]
    #[must_use]
    pub fn pdf_area(&self, triangle: u32) -> f32 {
        self.density_by_triangle.get(triangle as usize).copied().unwrap_or(0.0)
    }

    /// Draws a point; `None` if nothing emits.
    #[inline]
    #[must_use]
    pub fn sample(&self, pick: f32, u: [f32; 2]) -> Option<EmitterPoint> {
        let n = self.triangles.len();
        if n == 0 {
            return None;
        }
        let x = pick * n as f32;
        let i = (x as usize).min(n - 1);
        let (keep, other) = self.alias[i];
        let chosen = if x - i as f32 <= keep { i } else { other as usize };
        let t = &self.triangles[chosen];
        let [b1, b2] = warp::uniform_triangle(u);
        let [p0, p1, p2] = t.corners;
        Some(EmitterPoint {
            triangle: t.triangle,
            barycentric: [b1, b2],
            position: p0 + (p1 - p0) * b1 + (p2 - p0) * b2,
            pdf_area: self.pdf_area(t.triangle),
        })
    }
}

/// Vose's alias table: (share of the own entry, other entry) for probabilities that sum to 1.
fn alias_table(probabilities: &[f64]) -> Vec<(f32, u32)> {
    let n = probabilities.len();
    let mut scaled: Vec<f64> = probabilities.iter().map(|p| p * n as f64).collect();
    let mut table: Vec<(f32, u32)> = (0..n).map(|i| (1.0, i as u32)).collect();
    let (mut small, mut large): (Vec<usize>, Vec<usize>) = (0..n).partition(|&i| scaled[i] < 1.0);
    while let (Some(s), Some(&l)) = (small.pop(), large.last()) {
        table[s] = (scaled[s] as f32, l as u32);
        scaled[l] -= 1.0 - scaled[s];
        if scaled[l] < 1.0 {
            large.pop();
            small.push(l);
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::random::PathRng;

    #[test]
    fn points_follow_power() {
        let tri = |i: u32, power: f64| EmitterTriangle {
            triangle: i,
            corners: [Vec3A::ZERO, Vec3A::X * (i + 1) as f32, Vec3A::Y],
            power,
        };
        let e = Emitters::new(vec![tri(0, 1.0), tri(2, 5.0), tri(3, 0.0), tri(5, 2.0)], 7);
        let mut rng = PathRng::new(1, 1, 1);
        let (mut counts, n) = ([0u32; 7], 80_000);
        for _ in 0..n {
            counts[e.sample(rng.uniform(), rng.uniform2()).unwrap().triangle as usize] += 1;
        }
        for (i, want) in [(0, 1.0 / 8.0), (2, 5.0 / 8.0), (5, 2.0 / 8.0), (3, 0.0)] {
            let got = f64::from(counts[i]) / f64::from(n);
            assert!((got - want).abs() < 0.01, "{i}: {got} for {want}");
            let area = 0.5 * (i as f64 + 1.0);
            assert!((f64::from(e.pdf_area(i as u32)) - want / area).abs() < 1e-6);
        }
        assert!(Emitters::new(vec![], 7).sample(0.5, [0.1, 0.2]).is_none());
    }
}
