//! Rays through a patchy layer: optical depths and free flights.

use super::along::Along;
use super::{Area, PatchinessError, PatchyField, PatchyLayer};
use crate::Vec3A;
use crate::math::fast_exp;
use crate::profile::{ExtinctionProfile, ProductDepths, ProfileLanes, Span};
use crate::spectrum::{Spectrum, Wavelengths};

/// Farthest that a ray sees fog, in metres; beyond it air counts as clear. Only rays that are nearly level and graze the tops
/// of the billows come that far; on the round earth the horizon of an eye at 30 m is as near.
const REACH_M: f64 = 20_000.0;

/// Standard deviations over its mean above which the top counts as cut off: one in 3e5 of the area of a Gaussian surface,
/// which sums of many waves are nearly.
const HIGHEST_SD: f64 = 4.5;

/// Optical depth of the hero wavelength at which a flight counts as dark: exp(−40) is 4e-18.
const DARK: f64 = 40.0;

/// How finely a ray is cut.
#[derive(Clone, Copy, Debug)]
struct Resolution {
    /// Points per shortest wave where the field is evaluated.
    nodes_per_wave: f64,
    /// Straight pieces between them, at least.
    pieces: u32,
    /// Pieces over the layer's thickness, at least.
    pieces_per_thickness: f64,
}

/// For paths: the root mean square error of a transmittance is 2e-4 to 2e-3 (one octave, strong patches), its mean a tenth of
/// it or less (the tests measure them).
const PATHS: Resolution = Resolution { nodes_per_wave: 6.0, pieces: 2, pieces_per_thickness: 32.0 };

/// An even layer and the field that makes it patchy.
///
/// The field is smooth and has no wave shorter than its band's, so along a ray it is known between a few points per shortest
/// wave: cubics through values and slopes. Between them the ray is cut into pieces, in each of which the fog is the even
/// layer with a constant factor on its density, crossed along a straight line of its altitudes; what a piece crosses is then
/// a closed form ([`crate::profile`]), exact for any profile by altitude, its jumps included, and inverted exactly by a free
/// flight. Optical depths are thus deterministic and all wavelengths of a path share one walk. Cut twice as fine, errors fall
/// to a quarter or less.
#[derive(Clone, Copy, Debug)]
pub struct PatchyFog<'a> {
    profile: &'a ExtinctionProfile,
    field: &'a PatchyField,
    layer: PatchyLayer<'a>,
    thickness_m: f64,
    /// World y that next to no part of the top exceeds.
    highest_y: f64,
}

/// What a flight has behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossed {
    /// Distance in m.
    pub t: f64,
    /// Optical depth at all lanes.
    pub depth: Spectrum,
    /// World y in the even layer whose droplets are at the end: within the layer.
    pub even_y: f64,
    /// Factor on their density.
    pub density: f64,
    /// True if the flight ended in the fog, and not at its greatest length.
    pub collided: bool,
}

/// A part of a ray in which the fog is an even layer crossed straight.
struct Piece {
    /// Distance of its start in m.
    t: f64,
    /// Length in m.
    length: f64,
    /// World y in the even layer at the start.
    y: f64,
    /// Rise in the even layer per m.
    dy: f64,
    /// Factor on the density.
    density: f64,
}

/// A ray in f64.
struct Line {
    origin: [f64; 3],
    direction: [f64; 3],
}

impl Line {
    fn new(origin: Vec3A, direction: Vec3A) -> Self {
        Self { origin: origin.to_array().map(f64::from), direction: direction.to_array().map(f64::from) }
    }

    /// World y at a distance; a level ray keeps its height even at infinity.
    fn y(&self, t: f64) -> f64 {
        let dy = self.direction[1];
        if dy == 0.0 { self.origin[1] } else { self.origin[1] + t * dy }
    }

    fn over_ground(&self) -> [f64; 2] {
        [self.direction[0], self.direction[2]]
    }
}

impl<'a> PatchyFog<'a> {
    /// The field over an even layer.
    ///
    /// # Errors
    /// If the top's displacement can leave less than a tenth of the layer's thickness.
    pub fn new(profile: &'a ExtinctionProfile, field: &'a PatchyField) -> Result<Self, PatchinessError> {
        let layer = field.layer(profile.base_y(), profile.top_y())?;
        let thickness_m = profile.top_y() - profile.base_y();
        let offset = field.top_bounds_m(&Area::EVERYWHERE)[1].min(HIGHEST_SD * field.parameters().top_sd_m);
        let highest_y = profile.top_y() + offset;
        Ok(Self { profile, field, layer, thickness_m, highest_y })
    }

    /// The layer point by point; its altitudes are world y.
    #[must_use]
    pub fn layer(&self) -> PatchyLayer<'a> {
        self.layer
    }

    /// Part of a ray, 0 ≤ t ≤ t_max, outside of which there is no fog.
    #[must_use]
    pub fn clip(&self, origin: Vec3A, direction: Vec3A, t_max: f64) -> Option<Span> {
        self.span(&Line::new(origin, direction), t_max)
    }

    fn span(&self, line: &Line, t_max: f64) -> Option<Span> {
        let slab = [self.profile.base_y(), self.highest_y];
        Span::between(slab, line.origin[1], line.direction[1], t_max.min(REACH_M))
    }

    /// Flies along a ray (unit direction) to where the hero wavelength (lane 0) has crossed optical depth `tau`, or to
    /// `t_max` (m) where that is nearer; flights through more than an optical depth of 40 may end sooner.
    #[must_use]
    pub fn fly(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f64,
        tau: f64,
        lanes: &ProfileLanes,
    ) -> Crossed {
        let line = Line::new(origin, direction);
        let mut crossed = Crossed {
            t: t_max,
            depth: Spectrum::ZERO,
            even_y: self.profile.base_y(),
            density: 0.0,
            collided: false,
        };
        let mut sum = ProductDepths::ZERO;
        let (mut hero, dark) = (0.0, tau.min(DARK));
        self.walk(&line, t_max, PATHS, |piece| {
            let length = piece.length.min(t_max - piece.t);
            let depths = self.profile.product_depths(piece.y, piece.dy, length).scaled(piece.density);
            let here = self.profile.hero_depth(&depths, lanes);
            let end = |t: f64| (piece.y + t * piece.dy).clamp(self.profile.base_y(), self.profile.top_y());
            if hero + here < dark {
                hero += here;
                sum = sum.plus(&depths);
                (crossed.even_y, crossed.density) = (end(length), piece.density);
                return true;
            }
            let rest = (tau - hero) / piece.density;
            // Rounding may put the end just past the piece.
            let t = self.profile.free_flight(piece.y, piece.dy, length, rest, lanes).unwrap_or(length);
            sum = sum.plus(&self.profile.product_depths(piece.y, piece.dy, t).scaled(piece.density));
            crossed.t = piece.t + t;
            (crossed.even_y, crossed.density) = (end(t), piece.density);
            crossed.collided = tau <= DARK;
            false
        });
        crossed.depth = self.profile.lane_depths(&sum, lanes);
        crossed
    }

    /// Optical depths in f64 of a ray (unit direction) up to `t_max` (m) at some wavelengths: what ground truth is made of.
    ///
    /// The ray is cut ever finer until halving all pieces changes the extrapolated depth by less than 1e-5 of itself or
    /// 1e-6, the more of both; after six times it is left at that.
    #[must_use]
    pub fn optical_depths_at<const N: usize>(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f64,
        wavelengths_nm: [f64; N],
    ) -> [f64; N] {
        let line = Line::new(origin, direction);
        if line.direction[1] == 0.0 && t_max == f64::INFINITY {
            // The waves come near to any sum of theirs again and again: a level ray below the highest top meets endless fog.
            let inside = self.span(&line, t_max).is_some();
            return [if inside { f64::INFINITY } else { 0.0 }; N];
        }
        let lanes = wavelengths_nm.map(|nm| self.profile.lanes(&Wavelengths::monochromatic(nm as f32)));
        let depths = |resolution: Resolution| {
            let mut sum = ProductDepths::ZERO;
            self.walk(&line, t_max, resolution, |piece| {
                let length = piece.length.min(t_max - piece.t);
                let depths = self.profile.product_depths(piece.y, piece.dy, length);
                sum = sum.plus(&depths.scaled(piece.density));
                true
            });
            lanes.map(|lanes| self.profile.hero_depth(&sum, &lanes))
        };
        let mut resolution = Resolution { nodes_per_wave: 6.0, pieces: 4, pieces_per_thickness: 64.0 };
        let mut coarse = depths(resolution);
        let mut before = coarse;
        for _ in 0..6 {
            resolution.nodes_per_wave *= 2.0;
            resolution.pieces_per_thickness *= 2.0;
            let fine = depths(resolution);
            // The error is that of a midpoint rule, of second order: Richardson's extrapolation.
            let better: [f64; N] = std::array::from_fn(|i| fine[i] + (fine[i] - coarse[i]) / 3.0);
            let settled = (0..N).all(|i| (better[i] - before[i]).abs() <= (1e-5 * better[i]).max(1e-6));
            (coarse, before) = (fine, better);
            if settled {
                break;
            }
        }
        before.map(|depth| depth.max(0.0))
    }

    /// Visits the pieces of a ray in order until one returns false or starts at or beyond `t_max`. Where pieces begin and
    /// end does not depend on `t_max`, so that a flight and its density see the same fog.
    #[inline]
    fn walk(&self, line: &Line, t_max: f64, resolution: Resolution, mut visit: impl FnMut(&Piece) -> bool) {
        let Some(span) = self.span(line, f64::INFINITY) else { return };
        let [dx, dz] = line.over_ground();
        let shortest = 1.0 / self.field.band_1_m()[1];
        // Steep rays meet the waves stretched.
        let spacing = shortest / (resolution.nodes_per_wave * (dx * dx + dz * dz).sqrt());
        let step = spacing.min(span.exit - span.enter);
        let at = [line.origin[0] + span.enter * dx, line.origin[2] + span.enter * dz];
        let mut density = Along::new(&self.field.density, at, [dx * step, dz * step]);
        let mut top = Along::new(&self.field.top, at, [dx * step, dz * step]);
        let factor = |density: &Along| {
            let [value, slope] = density.value();
            let f = f64::from(fast_exp((value - self.field.ln_mean) as f32));
            [f, f * slope]
        };
        let rise = step * line.direction[1].abs() / self.thickness_m;
        let pieces = resolution.pieces.max((rise * resolution.pieces_per_thickness).ceil() as u32);
        let (mut start, mut node) = ([factor(&density), top.value()], 0u32);
        loop {
            let t = span.enter + f64::from(node) * step;
            if t >= span.exit.min(t_max) {
                return;
            }
            density.advance();
            top.advance();
            let end = [factor(&density), top.value()];
            let cubics = [Cubic::new(start[0], end[0]), Cubic::new(start[1], end[1])];
            if !self.visit_pieces(line, [t, step], &cubics, pieces, t_max, &mut visit) {
                return;
            }
            (start, node) = (end, node + 1);
        }
    }

    /// The pieces between two nodes; false if one was the last to be visited.
    #[inline]
    fn visit_pieces(
        &self,
        line: &Line,
        [t, step]: [f64; 2],
        [density, top]: &[Cubic; 2],
        pieces: u32,
        t_max: f64,
        visit: &mut impl FnMut(&Piece) -> bool,
    ) -> bool {
        let base = self.profile.base_y();
        let even = |t: f64, offset: f64| base + (line.y(t) - base) / (1.0 + offset / self.thickness_m);
        let share = 1.0 / f64::from(pieces);
        let length = step * share;
        let inverse = 1.0 / length;
        let mut y = even(t, top.at(0.0));
        for k in 0..pieces {
            let (low, high) = (share * f64::from(k), share * f64::from(k + 1));
            let (start, end) = (t + step * low, t + step * high);
            if start >= t_max {
                return false;
            }
            let y_end = even(end, top.at(high));
            let middle = density.at(0.5 * (low + high));
            // Simpson's rule is exact for cubics.
            let mean = (density.at(low) + 4.0 * middle + density.at(high)) * (1.0 / 6.0);
            let piece = Piece { t: start, length, y, dy: (y_end - y) * inverse, density: mean.max(0.0) };
            if !visit(&piece) {
                return false;
            }
            y = y_end;
        }
        true
    }
}

/// The cubic over [0, 1] with given values and slopes at its ends.
struct Cubic([f64; 4]);

impl Cubic {
    fn new([a, slope_a]: [f64; 2], [b, slope_b]: [f64; 2]) -> Self {
        let rise = b - a;
        Self([a, slope_a, 3.0 * rise - 2.0 * slope_a - slope_b, slope_a + slope_b - 2.0 * rise])
    }

    #[inline]
    fn at(&self, s: f64) -> f64 {
        let c = &self.0;
        c[0] + s * (c[1] + s * (c[2] + s * c[3]))
    }
}

#[cfg(test)]
#[path = "fog_tests.rs"]
mod tests;
