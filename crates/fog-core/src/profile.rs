//! The extinction of a horizontally even layer by altitude, and its exact optical depths and free flights.
//!
//! σ_t is linear between given altitudes and zero outside them, so the depth between two points is a difference of one
//! cumulative integral, divided by the ray's slope, and a free flight is its inverse: no majorant, no null collisions.

use crate::separable::{LaneCoefficients, MAX_RANK, Separable};
use crate::spectrum::{LANES, Spectrum, Wavelengths};

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
    extinction: Separable,
    /// σ_t and its integral from the base at each altitude, one entry per product of `extinction`.
    nodes: Vec<Node>,
    /// σ_a, by the same segments; `None` where nothing absorbs.
    absorption: Option<Separable>,
    least_albedo: f64,
    /// Segment at the start of each cell of an even grid over the layer: finds a segment without a search.
    by_altitude: Vec<u32>,
    cells_per_m: f64,
    /// Segment at the start of each cell of an even grid over the first product's integral.
    by_depth: Vec<u32>,
}

/// One altitude: a cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
struct Node {
    sigma: [f64; MAX_RANK],
    cumulative: [f64; MAX_RANK],
}

/// Wavelengths of a path in the tables of a profile.
#[derive(Clone, Copy, Debug)]
pub struct ProfileLanes {
    extinction: LaneCoefficients,
    absorption: Option<LaneCoefficients>,
}

/// A point in the layer: segment, and position in it in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    segment: usize,
    t: f64,
}

/// Part of a ray inside the layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Distance to the entry.
    pub enter: f64,
    /// Distance to the exit (at most the limit asked for; may be infinite for a horizontal ray).
    pub exit: f64,
}

impl Span {
    /// Part of the ray y = y0 + t·dy, 0 ≤ t ≤ t_max, between two heights.
    #[inline(always)]
    pub(crate) fn between([low, high]: [f64; 2], y0: f64, dy: f64, t_max: f64) -> Option<Self> {
        let (mut enter, mut exit) = (0.0, t_max);
        if dy != 0.0 {
            let (a, b) = ((low - y0) / dy, (high - y0) / dy);
            enter = a.min(b).max(0.0);
            exit = a.max(b).min(t_max);
        } else if y0 < low || y0 > high {
            return None;
        }
        (enter < exit).then_some(Self { enter, exit })
    }
}

/// Optical depth of a way through a profile before its wavelengths are put in: of each product of the extinction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ProductDepths([f64; MAX_RANK]);

impl ProductDepths {
    pub(crate) const ZERO: Self = Self([0.0; MAX_RANK]);

    #[inline(always)]
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self(self.0.map(|depth| depth * factor))
    }

    #[inline(always)]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
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
        let extinction = Separable::new(&wavelengths_nm, &sigma_t_1_m);
        let mut nodes: Vec<Node> = Vec::with_capacity(n);
        for (i, &sigma) in extinction.basis.iter().enumerate() {
            let mut cumulative = [0.0; MAX_RANK];
            if let Some(below) = nodes.last() {
                let h = altitude_m[i] - altitude_m[i - 1];
                for k in 0..MAX_RANK {
                    cumulative[k] = below.cumulative[k] + 0.5 * h * (below.sigma[k] + sigma[k]);
                }
            }
            nodes.push(Node { sigma, cumulative });
        }
        let sigma_a: Vec<f64> = sigma_t_1_m.iter().zip(&albedo).map(|(s, a)| s * (1.0 - a)).collect();
        let absorption = sigma_a.iter().any(|&s| s > 0.0).then(|| Separable::new(&wavelengths_nm, &sigma_a));

        let count = 4 * n;
        let (bottom, height) = (altitude_m[0], altitude_m[n - 1] - altitude_m[0]);
        let deepest = nodes[n - 1].cumulative[0];
        let below = |values: &[f64], x: f64| (values.partition_point(|&v| v <= x).clamp(1, n - 1) - 1) as u32;
        let share = |c: usize| c as f64 / count as f64;
        let depths: Vec<f64> = nodes.iter().map(|node| node.cumulative[0]).collect();
        let by_altitude = (0..count).map(|c| below(&altitude_m, bottom + height * share(c))).collect();
        let by_depth = (0..count).map(|c| below(&depths, deepest * share(c))).collect();
        Ok(Self {
            datum_m,
            wavelengths_nm,
            extinction,
            nodes,
            absorption,
            least_albedo: albedo.iter().fold(1.0, |a, &b| a.min(b)),
            by_altitude,
            cells_per_m: count as f64 / height,
            by_depth,
            altitude_m,
        })
    }

    /// The same layer with extinctions of `factor` (above 0, up to 1) as much, of which no less absorbs.
    #[must_use]
    pub fn thinned(&self, factor: f64) -> Self {
        let mut out = self.clone();
        let scale = |products: &mut [f64; MAX_RANK]| products.iter_mut().for_each(|value| *value *= factor);
        out.extinction.basis.iter_mut().for_each(scale);
        for node in &mut out.nodes {
            scale(&mut node.sigma);
            scale(&mut node.cumulative);
        }
        out.least_albedo = (1.0 - (1.0 - self.least_albedo) / factor).max(0.0);
        out
    }

    /// Least single-scattering albedo of the rows.
    #[must_use]
    pub fn least_albedo(&self) -> f64 {
        self.least_albedo
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

    /// The greatest σ_t of the layer in 1/m at the hero (lane 0).
    #[must_use]
    pub fn largest_sigma_t(&self, lanes: &ProfileLanes) -> f64 {
        self.nodes.iter().map(|node| self.hero(&node.sigma, lanes)).fold(0.0, f64::max)
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
        Span::between([self.base_y(), self.top_y()], y0, dy, t_max)
    }

    /// Finds a path's wavelengths in the tables.
    #[must_use]
    pub fn lanes(&self, wavelengths: &Wavelengths) -> ProfileLanes {
        ProfileLanes {
            extinction: self.extinction.lanes(wavelengths),
            absorption: self.absorption.as_ref().map(|a| a.lanes(wavelengths)),
        }
    }

    /// Place of world y, clamped to the layer.
    #[inline(always)]
    fn locate(&self, y: f64) -> Place {
        let z = y - self.datum_m;
        let cell = ((z - self.altitude_m[0]) * self.cells_per_m).max(0.0) as usize;
        let mut i = self.by_altitude[cell.min(self.by_altitude.len() - 1)] as usize;
        while i + 2 < self.altitude_m.len() && self.altitude_m[i + 1] <= z {
            i += 1;
        }
        while i > 0 && self.altitude_m[i] > z {
            i -= 1;
        }
        let (a, b) = (self.altitude_m[i], self.altitude_m[i + 1]);
        Place { segment: i, t: ((z - a) / (b - a)).clamp(0.0, 1.0) }
    }

    /// Each product of the extinction at a place.
    #[inline(always)]
    fn sigma_products(&self, p: Place) -> [f64; MAX_RANK] {
        let (a, b) = (&self.nodes[p.segment].sigma, &self.nodes[p.segment + 1].sigma);
        let mut out = [0.0; MAX_RANK];
        for k in 0..MAX_RANK {
            out[k] = a[k] + (b[k] - a[k]) * p.t;
        }
        out
    }

    /// Each product of the depth over the base at a place.
    #[inline(always)]
    fn cumulative_products(&self, p: Place) -> [f64; MAX_RANK] {
        let (a, b) = (&self.nodes[p.segment], &self.nodes[p.segment + 1]);
        let step = (self.altitude_m[p.segment + 1] - self.altitude_m[p.segment]) * p.t;
        let mut out = [0.0; MAX_RANK];
        for k in 0..MAX_RANK {
            out[k] = a.cumulative[k] + step * (a.sigma[k] + 0.5 * p.t * (b.sigma[k] - a.sigma[k]));
        }
        out
    }

    /// Sums the products at all lanes; negative rounding is cut off.
    #[inline(always)]
    fn combine(products: &[f64; MAX_RANK], rank: usize, lanes: &LaneCoefficients) -> Spectrum {
        let mut sum = [0.0f64; LANES];
        for k in 0..rank {
            for lane in 0..LANES {
                sum[lane] += products[k] * lanes.0[k][lane];
            }
        }
        let mut out = Spectrum::ZERO;
        for lane in 0..LANES {
            out[lane] = sum[lane].max(0.0) as f32;
        }
        out
    }

    /// Sums the products at the hero (lane 0).
    #[inline(always)]
    fn hero(&self, products: &[f64; MAX_RANK], lanes: &ProfileLanes) -> f64 {
        (0..self.extinction.rank).map(|k| products[k] * lanes.extinction.0[k][0]).sum()
    }

    /// σ_t in 1/m at world y, which must lie in the layer.
    #[inline]
    #[must_use]
    pub fn sigma_t(&self, y: f64, lanes: &ProfileLanes) -> Spectrum {
        Self::combine(&self.sigma_products(self.locate(y)), self.extinction.rank, &lanes.extinction)
    }

    /// Single-scattering albedo at world y, which must lie in the layer.
    #[inline]
    #[must_use]
    pub fn albedo(&self, y: f64, lanes: &ProfileLanes) -> Spectrum {
        let (Some(absorption), Some(in_absorption)) = (&self.absorption, &lanes.absorption) else {
            return Spectrum::ONE;
        };
        let p = self.locate(y);
        let (a, b) = (&absorption.basis[p.segment], &absorption.basis[p.segment + 1]);
        let mut products = [0.0; MAX_RANK];
        for k in 0..MAX_RANK {
            products[k] = a[k] + (b[k] - a[k]) * p.t;
        }
        let sigma_a = Self::combine(&products, absorption.rank, in_absorption);
        let sigma_t = Self::combine(&self.sigma_products(p), self.extinction.rank, &lanes.extinction);
        sigma_a.zip(sigma_t, |a, t| if t > 0.0 { (1.0 - a / t).max(0.0) } else { 1.0 })
    }

    /// Optical depth of the ray y = y0 + t·dy (dy: rise per metre) for 0 ≤ t ≤ t_max, at all lanes.
    #[inline]
    #[must_use]
    pub fn optical_depth(&self, y0: f64, dy: f64, t_max: f64, lanes: &ProfileLanes) -> Spectrum {
        self.clip(y0, dy, t_max).map_or(Spectrum::ZERO, |span| {
            Self::combine(&self.depth_products(y0, dy, span), self.extinction.rank, &lanes.extinction)
        })
    }

    /// [`ExtinctionProfile::optical_depth`] of each product.
    #[inline]
    pub(crate) fn product_depths(&self, y0: f64, dy: f64, t_max: f64) -> ProductDepths {
        let (base, top, y1) = (self.base_y(), self.top_y(), rise(y0, dy, t_max));
        if (y0 >= top && y1 >= top) || (y0 <= base && y1 <= base) {
            return ProductDepths::ZERO;
        }
        let inside = y0.min(y1) >= base && y0.max(y1) <= top;
        let whole = Some(Span { enter: 0.0, exit: t_max });
        let span = if inside { whole } else { self.clip(y0, dy, t_max) };
        span.map_or(ProductDepths::ZERO, |span| ProductDepths(self.depth_products(y0, dy, span)))
    }

    /// Depth at the hero (lane 0).
    #[inline]
    pub(crate) fn hero_depth(&self, depths: &ProductDepths, lanes: &ProfileLanes) -> f64 {
        self.hero(&depths.0, lanes).max(0.0)
    }

    /// Depth at all lanes.
    #[inline]
    pub(crate) fn lane_depths(&self, depths: &ProductDepths, lanes: &ProfileLanes) -> Spectrum {
        Self::combine(&depths.0, self.extinction.rank, &lanes.extinction)
    }

    /// [`ExtinctionProfile::optical_depth`] at the hero wavelength (lane 0) alone.
    #[inline]
    #[must_use]
    pub fn optical_depth_of_hero(&self, y0: f64, dy: f64, t_max: f64, lanes: &ProfileLanes) -> f64 {
        let depth = |span| self.hero(&self.depth_products(y0, dy, span), lanes).max(0.0);
        self.clip(y0, dy, t_max).map_or(0.0, depth)
    }

    /// [`ExtinctionProfile::sigma_t`] at the hero wavelength (lane 0) alone.
    #[inline]
    #[must_use]
    pub fn sigma_t_of_hero(&self, y: f64, lanes: &ProfileLanes) -> f64 {
        self.hero(&self.sigma_products(self.locate(y)), lanes).max(0.0)
    }

    /// Optical depth in f64 at one wavelength: what ground truth is made of.
    #[must_use]
    pub fn optical_depth_at(&self, y0: f64, dy: f64, t_max: f64, wavelength_nm: f64) -> f64 {
        let lanes = self.lanes(&Wavelengths::monochromatic(wavelength_nm as f32));
        self.clip(y0, dy, t_max)
            .map_or(0.0, |span| self.hero(&self.depth_products(y0, dy, span), &lanes).max(0.0))
    }

    /// σ_t in f64 at one wavelength; zero outside the layer.
    #[must_use]
    pub fn sigma_t_at(&self, y: f64, wavelength_nm: f64) -> f64 {
        if y < self.base_y() || y > self.top_y() {
            return 0.0;
        }
        let lanes = self.lanes(&Wavelengths::monochromatic(wavelength_nm as f32));
        self.hero(&self.sigma_products(self.locate(y)), &lanes).max(0.0)
    }

    /// Each product of the depth of a span. Within one segment it is the mean extinction times the length, which stays
    /// exact however flat the ray; across segments the difference of the cumulative integral over |dy|.
    #[inline(always)]
    fn depth_products(&self, y0: f64, dy: f64, span: Span) -> [f64; MAX_RANK] {
        let a = self.locate(rise(y0, dy, span.enter));
        let b = self.locate(rise(y0, dy, span.exit));
        let mut out = [0.0; MAX_RANK];
        if a.segment == b.segment {
            let mean = self.sigma_products(Place { t: 0.5 * (a.t + b.t), ..a });
            for k in 0..MAX_RANK {
                // A level ray may be endless: no fog stays no depth.
                out[k] = if mean[k] == 0.0 { 0.0 } else { mean[k] * (span.exit - span.enter) };
            }
            return out;
        }
        let (low, high) = (self.cumulative_products(a), self.cumulative_products(b));
        let inverse = 1.0 / dy;
        for k in 0..MAX_RANK {
            out[k] = (high[k] - low[k]) * inverse;
        }
        out
    }

    /// Distance at which the hero wavelength (lane 0) has crossed optical depth `tau`, if that is before `t_max` and
    /// inside the layer.
    #[inline]
    #[must_use]
    pub fn free_flight(&self, y0: f64, dy: f64, t_max: f64, tau: f64, lanes: &ProfileLanes) -> Option<f64> {
        let inside = y0 >= self.base_y() && y0 <= self.top_y();
        // Most flights begin inside and need no clipping: they leave the layer where its depth is used up.
        let enter = if inside { 0.0 } else { self.clip(y0, dy, t_max)?.enter };
        let mut place = self.locate(rise(y0, dy, enter));
        let (mut t, mut rest) = (enter, tau);
        let here = self.hero(&self.cumulative_products(place), lanes);
        let target = here + tau * dy;
        let found = self.find_cumulative(target, lanes);
        if found != place.segment && dy != 0.0 {
            // Jump to the edge of the segment whose cumulative depth holds the target.
            let edge = if dy > 0.0 { found } else { found + 1 };
            rest = ((target - self.hero(&self.nodes[edge].cumulative, lanes)) / dy).max(0.0);
            t = (self.datum_m + self.altitude_m[edge] - y0) / dy;
            place = Place { segment: found, t: if dy > 0.0 { 0.0 } else { 1.0 } };
        }
        match self.flight_in_segment(place, dy, rest, lanes) {
            Flight::Ends(x) => Some(t + x).filter(|&hit| hit < t_max),
            Flight::Leaves if dy == 0.0 => None,
            Flight::Leaves => self.flight_beyond(place, dy, t, t_max),
        }
    }

    /// A flight that rounding put just past the end of the segment that holds its target: it ends on the edge.
    fn flight_beyond(&self, place: Place, dy: f64, t: f64, exit: f64) -> Option<f64> {
        let inner = if dy > 0.0 { place.segment + 2 < self.altitude_m.len() } else { place.segment > 0 };
        let h = self.altitude_m[place.segment + 1] - self.altitude_m[place.segment];
        let to_edge = if dy > 0.0 { (1.0 - place.t) * h / dy } else { place.t * h / -dy };
        Some(t + to_edge).filter(|&edge| inner && edge < exit)
    }

    /// Solves here·x + ½ slope·x² = rest for the distance x within a segment.
    #[inline(always)]
    fn flight_in_segment(&self, p: Place, dy: f64, rest: f64, lanes: &ProfileLanes) -> Flight {
        let s0 = self.hero(&self.nodes[p.segment].sigma, lanes);
        let s1 = self.hero(&self.nodes[p.segment + 1].sigma, lanes);
        let h = self.altitude_m[p.segment + 1] - self.altitude_m[p.segment];
        let here = s0 + (s1 - s0) * p.t;
        let slope = (s1 - s0) / h * dy;
        let discriminant = here * here + 2.0 * slope * rest;
        let denominator = here + discriminant.max(0.0).sqrt();
        let to_edge = if dy > 0.0 {
            (1.0 - p.t) * h / dy
        } else if dy < 0.0 {
            p.t * h / -dy
        } else {
            f64::INFINITY
        };
        if discriminant < 0.0 || denominator <= 0.0 {
            return Flight::Leaves;
        }
        let x = 2.0 * rest / denominator;
        if x <= to_edge && x < f64::INFINITY { Flight::Ends(x) } else { Flight::Leaves }
    }

    /// Segment whose cumulative range of the hero holds `target` (clamped): a guess from the first product, then steps.
    #[inline]
    fn find_cumulative(&self, target: f64, lanes: &ProfileLanes) -> usize {
        let last = self.nodes.len() - 1;
        let total = self.hero(&self.nodes[last].cumulative, lanes);
        let cell = (target / total * self.by_depth.len() as f64).max(0.0) as usize;
        let mut i = self.by_depth[cell.min(self.by_depth.len() - 1)] as usize;
        while i + 1 < last && self.hero(&self.nodes[i + 1].cumulative, lanes) <= target {
            i += 1;
        }
        while i > 0 && self.hero(&self.nodes[i].cumulative, lanes) > target {
            i -= 1;
        }
        i
    }
}

/// What becomes of a flight within one segment.
enum Flight {
    /// It ends after this distance.
    Ends(f64),
    /// It goes on past the segment's edge.
    Leaves,
}

/// World y at distance t; a level ray keeps its height even at infinity.
#[inline(always)]
fn rise(y0: f64, dy: f64, t: f64) -> f64 {
    if dy == 0.0 { y0 } else { y0 + t * dy }
}

#[cfg(test)]
mod tests;
