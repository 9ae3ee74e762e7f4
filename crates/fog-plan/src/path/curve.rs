//! A smooth curve through points, or straight lines between them, by arc length.
//!
//! Centripetal Catmull–Rom splines (Barry & Goldman 1988; Yuksel, Schaefer & Keyser 2011: of all parametrisations only the
//! centripetal one has neither cusps nor loops within a segment). The ends are continued by mirrored points.

/// Parts of a segment whose lengths are tabulated.
const PARTS: usize = 64;

/// A curve; two points make a straight line.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    segments: Vec<Segment>,
    /// Length from the curve's beginning to the end of each part of each segment, and 0 first.
    lengths: Vec<f64>,
}

/// Cubic Hermite between two points; the parameter runs from 0 to 1.
#[derive(Clone, Copy, Debug)]
struct Segment {
    points: [[f64; 3]; 2],
    tangents: [[f64; 3]; 2],
}

fn combine<const N: usize>(terms: [(f64, [f64; 3]); N]) -> [f64; 3] {
    [0, 1, 2].map(|i| terms.iter().map(|(factor, v)| factor * v[i]).sum())
}

fn length(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    combine([(1.0, a), (-1.0, b)])
}

impl Segment {
    fn at(&self, u: f64) -> [f64; 3] {
        let (s, t) = (u * u, u * u * u);
        combine([
            (2.0 * t - 3.0 * s + 1.0, self.points[0]),
            (t - 2.0 * s + u, self.tangents[0]),
            (3.0 * s - 2.0 * t, self.points[1]),
            (t - s, self.tangents[1]),
        ])
    }

    fn slope(&self, u: f64) -> [f64; 3] {
        let s = u * u;
        combine([
            (6.0 * s - 6.0 * u, self.points[0]),
            (3.0 * s - 4.0 * u + 1.0, self.tangents[0]),
            (6.0 * u - 6.0 * s, self.points[1]),
            (3.0 * s - 2.0 * u, self.tangents[1]),
        ])
    }

    /// Length from `a` to `b`, by Simpson's rule twice over.
    fn length(&self, a: f64, b: f64) -> f64 {
        let speed = |k: f64| length(self.slope(a + 0.25 * k * (b - a)));
        (b - a) / 12.0 * (speed(0.0) + 4.0 * speed(1.0) + 2.0 * speed(2.0) + 4.0 * speed(3.0) + speed(4.0))
    }
}

impl Curve {
    /// Through at least two points, of which no two in a row are equal.
    pub(super) fn through(points: &[[f64; 3]]) -> Self {
        let n = points.len();
        let mirrored = |a: [f64; 3], b: [f64; 3]| combine([(2.0, a), (-1.0, b)]);
        let point = |i: isize| match i {
            -1 => mirrored(points[0], points[1]),
            i if i as usize == n => mirrored(points[n - 1], points[n - 2]),
            i => points[i as usize],
        };
        let segments: Vec<Segment> = (0..n as isize - 1)
            .map(|i| {
                let p = [point(i - 1), point(i), point(i + 1), point(i + 2)];
                let knot = |k: usize| length(minus(p[k + 1], p[k])).sqrt();
                let [d0, d1, d2] = [knot(0), knot(1), knot(2)];
                // Derivatives of the spline at the two inner points, over this segment's parameter.
                let tangent = |a: usize, before: f64, after: f64| {
                    let [v0, v1] = [minus(p[a + 1], p[a]), minus(p[a + 2], p[a + 1])];
                    let whole = minus(p[a + 2], p[a]);
                    combine([(d1 / before, v0), (-d1 / (before + after), whole), (d1 / after, v1)])
                };
                Segment { points: [p[1], p[2]], tangents: [tangent(0, d0, d1), tangent(1, d1, d2)] }
            })
            .collect();
        Self::of(segments)
    }

    /// Straight lines from each of at least two points to the next, of which no two in a row are equal.
    pub(super) fn straight(points: &[[f64; 3]]) -> Self {
        let segment = |p: &[[f64; 3]]| Segment { points: [p[0], p[1]], tangents: [minus(p[1], p[0]); 2] };
        Self::of(points.windows(2).map(segment).collect())
    }

    fn of(segments: Vec<Segment>) -> Self {
        let mut lengths = vec![0.0];
        let mut sum = 0.0;
        for segment in &segments {
            for part in 0..PARTS {
                let at = |k: usize| k as f64 / PARTS as f64;
                sum += segment.length(at(part), at(part + 1));
                lengths.push(sum);
            }
        }
        Self { segments, lengths }
    }

    /// Its whole length.
    pub(super) fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// Point and unit tangent at this length from the beginning, 0 to the whole.
    pub(super) fn at(&self, s: f64) -> [[f64; 3]; 2] {
        let part = self.lengths.partition_point(|&l| l <= s).clamp(1, self.lengths.len() - 1) - 1;
        let segment = &self.segments[part / PARTS];
        let begin = (part % PARTS) as f64 / PARTS as f64;
        let (low, high) = (self.lengths[part], self.lengths[part + 1]);
        let mut u = begin + ((s - low) / (high - low)).clamp(0.0, 1.0) / PARTS as f64;
        for _ in 0..3 {
            u += (s - low - segment.length(begin, u)) / length(segment.slope(u));
        }
        let slope = segment.slope(u);
        let size = length(slope);
        [segment.at(u), slope.map(|c| c / size)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_lines_are_straight() {
        let curve = Curve::through(&[[1.0, 2.0, 3.0], [1.0, 2.0, -7.0]]);
        assert!((curve.length() - 10.0).abs() < 1e-12);
        for s in [0.0, 2.5, 10.0] {
            let [point, tangent] = curve.at(s);
            assert!(
                length(minus(point, [1.0, 2.0, 3.0 - s])) < 1e-12
                    && length(minus(tangent, [0.0, 0.0, -1.0])) < 1e-12
            );
        }
    }

    #[test]
    fn curves_go_through_their_points_at_even_speed() {
        let points =
            [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [12.0, 1.0, -9.0], [40.0, 3.0, -9.0], [41.0, 3.0, -8.0]];
        let curve = Curve::through(&points);
        let steps = 20_000;
        let step = curve.length() / f64::from(steps);
        let mut last = curve.at(0.0)[0];
        let mut nearest = [f64::INFINITY; 5];
        for i in 1..=steps {
            let [point, tangent] = curve.at(f64::from(i) * step);
            let moved = minus(point, last);
            // The chord is shorter than the arc by the third power of its length.
            assert!((length(moved) / step - 1.0).abs() < 1e-5, "{i}: {}", length(moved) / step);
            assert!(length(minus(moved.map(|c| c / step), tangent)) < 0.02);
            for (nearest, p) in nearest.iter_mut().zip(points) {
                *nearest = nearest.min(length(minus(point, p)));
            }
            last = point;
        }
        assert!(nearest.iter().all(|d| *d <= step), "{nearest:?}");
        assert!(length(minus(last, points[4])) < 1e-9);
    }
}
