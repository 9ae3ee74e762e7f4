//! What a watch is told of a path.

use super::{Event, Lanes, Path, PathTracer};
use crate::watch::{FlightEnd, Step};
use fog_core::math;
use fog_core::spectrum::Spectrum;
use fog_scene::phase::Scatterer;

impl PathTracer<'_> {
    /// A flight for a watch.
    pub(super) fn flight(&self, path: &Path, lanes: &Lanes, u: f64, event: &Event) -> Step {
        let (length_m, end) = match event {
            Event::Surface(hit) => (f64::from(hit.t), FlightEnd::Surface),
            Event::Collision { t, .. } => (*t, FlightEnd::Fog),
            Event::Escape => (f64::INFINITY, FlightEnd::Nowhere),
        };
        let (y, dy) = (f64::from(path.origin.y), f64::from(path.direction.y));
        let fog = self.fog(path.depth, lanes);
        let even =
            || fog.map(|(medium, lanes)| medium.profile.optical_depth(y, dy, length_m, &lanes.profile));
        let tau = path.crossed.map_or_else(even, |crossed| Some(crossed.depth));
        Step::Flight {
            origin: path.origin,
            direction: path.direction,
            length_m,
            drawn_tau: -math::f64::ln(1.0 - u),
            tau: tau.unwrap_or(Spectrum::ZERO),
            end,
        }
    }

    /// A collision for a watch.
    pub(super) fn collision(&self, path: &Path, lanes: &Lanes, scatterer: &Scatterer) -> Step {
        let (medium, lanes) = self.fog(path.depth, lanes).expect("collision needs fog");
        let (y, density) = self.even_place(path);
        let sigma_t = medium.profile.sigma_t(y, &lanes.profile) * density;
        let here = [sigma_t, medium.profile.albedo(y, &lanes.profile)];
        Step::collision(path.origin, here, scatterer, path.weights())
    }
}
