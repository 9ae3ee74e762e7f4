//! The extinction of a horizontally even layer by altitude, and its exact optical depths and free flights.
//!
//! σ_t is linear between given altitudes and zero outside them, so the depth between two points is a difference of one
//! cumulative integral, divided by the ray's slope, and a free flight is its inverse: no majorant, no null collisions.

use crate::spectrum::{LaneWeights, Spectrum};

/// Why a profile was refused.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum ProfileError {
    /// Fewer than two altitudes, or no wavelength.
    #[error("a fog profile needs at least two altitudes and one wavelength")]
    TooShort,
    /// Altitudes must ascend.
    #[error("altitude {altitude_m} m (row {row}) is not above the row before it")]
    Order {
        /// Index of the offending row.
        row: usize,
        /// Its altitude.
        altitude_m: f64,
    },
    /// Extinction must be finite and not negative, albedo within [0, 1].
    #[error("{what} at altitude {altitude_m} m is {value}; valid: {valid}")]
    Value {
        /// Which quantity.
        what: &'static str,
        /// Where.
        altitude_m: f64,
        /// What was given.
        value: f64,
        /// What is valid.
        valid: &'static str,
    },
}

/// σ_t and albedo by altitude and wavelength; linear in both.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtinctionProfile {
    datum_m: f64,
    altitude_m: Vec<f64>,
    wavelengths_nm: Vec<f64>,
    sigma_t: Vec<f64>,
    cumulative: Vec<f64>,
    albedo: Vec<f64>,
    /// Segment at the start of each cell of an even grid over the layer: finds a segment without a search.
    cells: Vec<u32>,
    cells_per_m: f64,
}

/// Part of a ray inside the layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Distance to the entry.
    pub enter: f64,
    /// Distance to the exit (at most the limit asked for; may be infinite for a horizontal ray).
    pub exit: f64,
}

impl ExtinctionProfile {
    /// Profile over `datum_m` (world y of altitude 0) from rows over altitude: `sigma_t_1_m` and `albedo` are
    /// \[altitude\]\[wavelength\].
    ///
    /// # Errors
    /// If the altitudes do not ascend, or a value is out of range.
    ///
    /// # Panics
    /// If a length does not fit the axes (a bug of the caller).
    pub fn new(
        datum_m: f64,
        altitude_m: Vec<f64>,
        wavelengths_nm: Vec<f64>,
        sigma_t_1_m: Vec<f64>,
        albedo: Vec<f64>,
    ) -> Result<Self, ProfileError> {
        let (n, w) = (altitude_m.len(), wavelengths_nm.len());
        assert!(sigma_t_1_m.len() == n * w && albedo.len() == n * w, "profile lengths");
        if n < 2 || w == 0 {
            return Err(ProfileError::TooShort);
        }
        if let Some(row) = (1..n).find(|&i| altitude_m[i].is_nan() || altitude_m[i] <= altitude_m[i - 1]) {
            return Err(ProfileError::Order { row, altitude_m: altitude_m[row] });
        }
        for (i, (&s, &a)) in sigma_t_1_m.iter().zip(&albedo).enumerate() {
            let altitude_m = altitude_m[i / w];
            if !(0.0..=1e6).contains(&s) {
                let valid = "0 to 1e6 1/m";
                return Err(ProfileError::Value { what: "sigma_t", altitude_m, value: s, valid });
            }
            if !(0.0..=1.0).contains(&a) {
                let valid = "0 to 1";
                return Err(ProfileError::Value { what: "albedo", altitude_m, value: a, valid });
            }
        }
        let mut cumulative = vec![0.0; n * w];
        for i in w..n * w {
            let h = altitude_m[i / w] - altitude_m[i / w - 1];
            cumulative[i] = cumulative[i - w] + 0.5 * h * (sigma_t_1_m[i - w] + sigma_t_1_m[i]);
        }
        let count = 4 * n;
        let (bottom, height) = (altitude_m[0], altitude_m[n - 1] - altitude_m[0]);
        let cells = (0..count)
            .map(|c| {
                let z = bottom + height * c as f64 / count as f64;
                (altitude_m.partition_point(|&a| a <= z).clamp(1, n - 1) - 1) as u32
            })
            .collect();
        let cells_per_m = count as f64 / height;
        Ok(Self {
            datum_m,
            altitude_m,
            wavelengths_nm,
            sigma_t: sigma_t_1_m,
            cumulative,
            albedo,
            cells,
            cells_per_m,
        })
    }

    /// World y of altitude 0.
    #[must_use]
    pub fn datum_m(&self) -> f64 {
        self.datum_m
    }

    /// World y of the layer's base.
    #[must_use]
    pub fn base_y(&self) -> f64 {
        self.datum_m + self.altitude_m[0]
    }

    /// World y of the layer's top.
    #[must_use]
    pub fn top_y(&self) -> f64 {
        self.datum_m + self.altitude_m[self.altitude_m.len() - 1]
    }

    /// Altitude within the layer as a fraction of its height, clamped to [0, 1].
    #[inline]
    #[must_use]
    pub fn zeta(&self, y: f64) -> f32 {
        let bottom = self.altitude_m[0];
        let height = self.altitude_m[self.altitude_m.len() - 1] - bottom;
        ((y - self.datum_m - bottom) / height).clamp(0.0, 1.0) as f32
    }

    /// Wavelengths of the rows, in nm.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// Part of the ray y = y0 + t·dy, 0 ≤ t ≤ t_max, inside the layer.
    #[inline]
    #[must_use]
    pub fn clip(&self, y0: f64, dy: f64, t_max: f64) -> Option<Span> {
        let (base, top) = (self.base_y(), self.top_y());
        let (mut enter, mut exit) = (0.0, t_max);
        if dy != 0.0 {
            let (a, b) = ((base - y0) / dy, (top - y0) / dy);
            enter = a.min(b).max(0.0);
            exit = a.max(b).min(t_max);
        } else if y0 < base || y0 > top {
            return None;
        }
        (enter < exit).then_some(Span { enter, exit })
    }

    /// Segment that holds world y (clamped to the layer) and the position in it, in [0, 1].
    #[inline(always)]
    fn locate(&self, y: f64) -> (usize, f64) {
        let z = y - self.datum_m;
        let cell = ((z - self.altitude_m[0]) * self.cells_per_m).max(0.0) as usize;
        let mut i = self.cells[cell.min(self.cells.len() - 1)] as usize;
        while i + 2 < self.altitude_m.len() && self.altitude_m[i + 1] <= z {
            i += 1;
        }
        while i > 0 && self.altitude_m[i] > z {
            i -= 1;
        }
        let (a, b) = (self.altitude_m[i], self.altitude_m[i + 1]);
        (i, ((z - a) / (b - a)).clamp(0.0, 1.0))
    }

    #[inline(always)]
    fn lane(&self, values: &[f64], row: usize, lanes: &LaneWeights, lane: usize) -> f64 {
        let w = self.wavelengths_nm.len();
        if w == 1 {
            return values[row];
        }
        let i = row * w + lanes.index[lane] as usize;
        values[i] + (values[i + 1] - values[i]) * f64::from(lanes.weight[lane])
    }

    #[inline(always)]
    fn at(&self, values: &[f64], y: f64, lanes: &LaneWeights) -> Spectrum {
        let (i, t) = self.locate(y);
        let one = |lane: usize| {
            let (a, b) = (self.lane(values, i, lanes, lane), self.lane(values, i + 1, lanes, lane));
            (a + (b - a) * t) as f32
        };
        if self.wavelengths_nm.len() == 1 {
            return Spectrum::splat(one(0));
        }
        Spectrum(core::array::from_fn(one))
    }

    /// σ_t in 1/m at world y, which must lie in the layer.
    #[inline]
    #[must_use]
    pub fn sigma_t(&self, y: f64, lanes: &LaneWeights) -> Spectrum {
        self.at(&self.sigma_t, y, lanes)
    }

    /// Single-scattering albedo at world y, which must lie in the layer.
    #[inline]
    #[must_use]
    pub fn albedo(&self, y: f64, lanes: &LaneWeights) -> Spectrum {
        self.at(&self.albedo, y, lanes)
    }

    /// Optical depth of the ray y = y0 + t·dy (dy: rise per metre) for 0 ≤ t ≤ t_max, at all lanes.
    #[inline]
    #[must_use]
    pub fn optical_depth(&self, y0: f64, dy: f64, t_max: f64, lanes: &LaneWeights) -> Spectrum {
        let Some(span) = self.clip(y0, dy, t_max) else { return Spectrum::ZERO };
        if self.wavelengths_nm.len() == 1 {
            return Spectrum::splat(self.span_depth(y0, dy, span, lanes, 0) as f32);
        }
        let (ia, ta) = self.locate(rise(y0, dy, span.enter));
        let (ib, tb) = self.locate(rise(y0, dy, span.exit));
        let length = span.exit - span.enter;
        Spectrum(core::array::from_fn(|lane| {
            self.depth_between(ia, ta, ib, tb, dy, length, lanes, lane) as f32
        }))
    }

    /// Optical depth in f64 at one wavelength: what ground truth is made of.
    #[must_use]
    pub fn optical_depth_at(&self, y0: f64, dy: f64, t_max: f64, wavelength_nm: f64) -> f64 {
        let lanes = self.lanes_at(wavelength_nm);
        self.clip(y0, dy, t_max).map_or(0.0, |span| self.span_depth(y0, dy, span, &lanes, 0))
    }

    /// σ_t in f64 at one wavelength; zero outside the layer.
    #[must_use]
    pub fn sigma_t_at(&self, y: f64, wavelength_nm: f64) -> f64 {
        if y < self.base_y() || y > self.top_y() {
            return 0.0;
        }
        let lanes = self.lanes_at(wavelength_nm);
        let (i, t) = self.locate(y);
        let (a, b) = (self.lane(&self.sigma_t, i, &lanes, 0), self.lane(&self.sigma_t, i + 1, &lanes, 0));
        a + (b - a) * t
    }

    fn lanes_at(&self, wavelength_nm: f64) -> LaneWeights {
        let all = crate::spectrum::Wavelengths::monochromatic(wavelength_nm as f32);
        LaneWeights::new(&self.wavelengths_nm, &all)
    }

    fn span_depth(&self, y0: f64, dy: f64, span: Span, lanes: &LaneWeights, lane: usize) -> f64 {
        let (ia, ta) = self.locate(rise(y0, dy, span.enter));
        let (ib, tb) = self.locate(rise(y0, dy, span.exit));
        self.depth_between(ia, ta, ib, tb, dy, span.exit - span.enter, lanes, lane)
    }

    /// Depth between two located points `length` apart. Within one segment it is the mean extinction times the length,
    /// which stays exact however flat the ray; across segments the difference of the cumulative integral over |dy|.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn depth_between(
        &self,
        ia: usize,
        ta: f64,
        ib: usize,
        tb: f64,
        dy: f64,
        length: f64,
        lanes: &LaneWeights,
        lane: usize,
    ) -> f64 {
        let s0 = self.lane(&self.sigma_t, ia, lanes, lane);
        let s1 = self.lane(&self.sigma_t, ia + 1, lanes, lane);
        if ia == ib {
            let mean = s0 + (s1 - s0) * 0.5 * (ta + tb);
            return if mean > 0.0 { mean * length } else { 0.0 };
        }
        let part = |i: usize, t: f64, s0: f64, s1: f64| {
            let h = self.altitude_m[i + 1] - self.altitude_m[i];
            self.lane(&self.cumulative, i, lanes, lane) + h * t * (s0 + 0.5 * t * (s1 - s0))
        };
        let r0 = self.lane(&self.sigma_t, ib, lanes, lane);
        let r1 = self.lane(&self.sigma_t, ib + 1, lanes, lane);
        (part(ib, tb, r0, r1) - part(ia, ta, s0, s1)).abs() / dy.abs()
    }

    /// Distance at which the hero wavelength (lane 0) has crossed optical depth `tau`, if that is before `t_max` and
    /// inside the layer.
    #[inline]
    #[must_use]
    pub fn free_flight(&self, y0: f64, dy: f64, t_max: f64, tau: f64, lanes: &LaneWeights) -> Option<f64> {
        let span = self.clip(y0, dy, t_max)?;
        let mut rest = tau;
        let mut t = span.enter;
        let (mut i, mut pos) = self.locate(rise(y0, dy, span.enter));
        let last = self.altitude_m.len() - 2;
        if dy.abs() * self.cells_per_m * (span.exit - span.enter) > 32.0 {
            // Many segments may lie ahead: jump to the one whose cumulative depth holds the target.
            let target = self.cumulative_at(i, pos, lanes) + tau * dy;
            let found = self.find_cumulative(target, lanes);
            if found != i {
                let (from, to) = if dy > 0.0 { (found, 0.0) } else { (found, 1.0) };
                rest = (target - self.cumulative_at(from, to, lanes)) / dy;
                let y_start = self.datum_m + self.altitude_m[if dy > 0.0 { found } else { found + 1 }];
                t = (y_start - y0) / dy;
                (i, pos) = (from, to);
            }
        }
        loop {
            let s0 = self.lane(&self.sigma_t, i, lanes, 0);
            let s1 = self.lane(&self.sigma_t, i + 1, lanes, 0);
            let h = self.altitude_m[i + 1] - self.altitude_m[i];
            let here = s0 + (s1 - s0) * pos;
            // Solve here·x + ½ slope·x² = rest for the distance x; a negative root means that it never gets there.
            let slope = (s1 - s0) / h * dy;
            let discriminant = here * here + 2.0 * slope * rest;
            let x =
                if discriminant >= 0.0 { 2.0 * rest / (here + discriminant.sqrt()) } else { f64::INFINITY };
            let to_edge = if dy > 0.0 {
                (1.0 - pos) * h / dy
            } else if dy < 0.0 {
                pos * h / -dy
            } else {
                f64::INFINITY
            };
            if x <= to_edge {
                let hit = t + x;
                return (hit < span.exit).then_some(hit);
            }
            t += to_edge;
            let next = here + slope * to_edge;
            rest = (rest - 0.5 * (here + next) * to_edge).max(0.0);
            if t >= span.exit || (dy > 0.0 && i == last) || (dy < 0.0 && i == 0) {
                return None;
            }
            (i, pos) = if dy > 0.0 { (i + 1, 0.0) } else { (i - 1, 1.0) };
        }
    }

    fn cumulative_at(&self, i: usize, t: f64, lanes: &LaneWeights) -> f64 {
        let s0 = self.lane(&self.sigma_t, i, lanes, 0);
        let s1 = self.lane(&self.sigma_t, i + 1, lanes, 0);
        let h = self.altitude_m[i + 1] - self.altitude_m[i];
        self.lane(&self.cumulative, i, lanes, 0) + h * t * (s0 + 0.5 * t * (s1 - s0))
    }

    /// Segment whose cumulative range of the hero wavelength holds `target` (clamped).
    fn find_cumulative(&self, target: f64, lanes: &LaneWeights) -> usize {
        let (mut low, mut high) = (0, self.altitude_m.len() - 1);
        while high - low > 1 {
            let middle = (low + high) / 2;
            if self.lane(&self.cumulative, middle, lanes, 0) <= target {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }
}

/// World y at distance t; a level ray keeps its height even at infinity.
#[inline(always)]
fn rise(y0: f64, dy: f64, t: f64) -> f64 {
    if dy == 0.0 { y0 } else { y0 + t * dy }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::PathRng;
    use crate::spectrum::Wavelengths;

    fn bumpy() -> ExtinctionProfile {
        let n = 129;
        let z: Vec<f64> = (0..n).map(|i| 180.0 * i as f64 / (n - 1) as f64).collect();
        let (mut s, mut a) = (Vec::new(), Vec::new());
        for &z in &z {
            for l in 0..3 {
                let x = z / 180.0;
                s.push((0.004 + 0.05 * x * (1.2 - x)) * (1.0 + 0.1 * l as f64));
                a.push(1.0 - 0.1 * x);
            }
        }
        ExtinctionProfile::new(10.0, z, vec![400.0, 500.0, 700.0], s, a).unwrap()
    }

    #[test]
    fn depth_equals_brute_force_at_every_slope() {
        let p = bumpy();
        for &dy in &[1.0, -1.0, 0.3, -0.01, 1e-4, 1e-9, 0.0, -1e-14] {
            for &(y0, t_max) in &[(12.0, 100.0), (150.0, 700.0), (80.0, 3.0), (5.0, 400.0), (250.0, 600.0)] {
                let n = 200_000;
                let brute: f64 = (0..n)
                    .map(|i| p.sigma_t_at(y0 + dy * t_max * (i as f64 + 0.5) / n as f64, 450.0))
                    .sum::<f64>()
                    * t_max
                    / n as f64;
                let exact = p.optical_depth_at(y0, dy, t_max, 450.0);
                assert!((exact - brute).abs() < 1e-4 * (1e-3 + brute), "{dy} {y0} {t_max}: {exact} {brute}");
                let lanes = LaneWeights::new(p.wavelengths_nm(), &Wavelengths::monochromatic(450.0));
                let lane = p.optical_depth(y0, dy, t_max, &lanes)[3];
                assert!((f64::from(lane) - exact).abs() <= 1e-6 * exact);
            }
        }
    }

    #[test]
    fn free_flight_inverts_depth() {
        let p = bumpy();
        let lanes = LaneWeights::new(p.wavelengths_nm(), &Wavelengths::monochromatic(460.0));
        let mut rng = PathRng::new(9, 0, 0);
        let (mut hits, mut misses) = (0, 0);
        for _ in 0..50_000 {
            let dy = 2.0 * rng.uniform_f64() - 1.0;
            let dy = if rng.uniform() < 0.3 { dy * 1e-5 } else { dy };
            let y0 = 300.0 * rng.uniform_f64() - 20.0;
            let tau = -crate::math::f64::ln(1.0 - rng.uniform_f64());
            let t_max = 2000.0 * rng.uniform_f64();
            match p.free_flight(y0, dy, t_max, tau, &lanes) {
                Some(t) => {
                    hits += 1;
                    let depth = p.optical_depth_at(y0, dy, t, 460.0);
                    assert!((depth - tau).abs() < 1e-8 * (1.0 + tau), "{y0} {dy} {tau}: {depth}");
                }
                None => {
                    misses += 1;
                    let depth = p.optical_depth_at(y0, dy, t_max, 460.0);
                    assert!(depth <= tau * (1.0 + 1e-9) + 1e-9, "{y0} {dy} {t_max} {tau}: {depth}");
                }
            }
        }
        assert!(hits > 1000 && misses > 1000);
    }

    #[test]
    fn infinite_rays_end_at_the_top_or_never() {
        let p = bumpy();
        assert!(p.optical_depth_at(20.0, 0.5, f64::INFINITY, 500.0).is_finite());
        assert_eq!(p.optical_depth_at(20.0, 0.0, f64::INFINITY, 500.0), f64::INFINITY);
        assert_eq!(p.optical_depth_at(200.0, 0.5, f64::INFINITY, 500.0), 0.0);
        let lanes = LaneWeights::new(p.wavelengths_nm(), &Wavelengths::monochromatic(500.0));
        assert!(p.free_flight(20.0, 0.0, f64::INFINITY, 30.0, &lanes).is_some());
    }

    #[test]
    fn bad_rows_are_refused() {
        let make = |z: &[f64], s: &[f64]| {
            ExtinctionProfile::new(0.0, z.to_vec(), vec![550.0], s.to_vec(), vec![1.0; s.len()])
        };
        assert_eq!(make(&[0.0], &[1.0]).unwrap_err(), ProfileError::TooShort);
        assert!(matches!(make(&[0.0, 0.0], &[1.0, 1.0]), Err(ProfileError::Order { row: 1, .. })));
        assert!(matches!(make(&[0.0, 1.0], &[1.0, -1.0]), Err(ProfileError::Value { .. })));
        assert!(matches!(make(&[0.0, 1.0], &[1.0, f64::NAN]), Err(ProfileError::Value { .. })));
    }
}
