//! The path tracer: spectral, volumetric, unidirectional with next-event estimation.
//!
//! A path is sampled at its hero wavelength (lane 0). `beta` is its throughput at each wavelength over the density of the
//! hero, `r_u` the density of the same path at each wavelength, and `r_l` that of its last vertex found by light sampling,
//! both relative to the hero's density: dividing by the mean of `r_u + r_l·p` over the lanes is the balance heuristic over
//! wavelengths and strategies at once (Wilkie et al. 2014; Miller et al. 2019; names after pbrt-v4, sec. 14.2).
//!
//! Free flights are exact in the layer, so there are no null collisions; see [`fog_core::profile`], and
//! [`fog_core::patchiness`] for patchy fog.

mod connect;
mod glow;
mod layer;
mod patchy;
mod surface_turn;
mod told;
mod twin;

use self::glow::Flight;
pub(crate) use self::surface_turn::{scatter_at_surface, turn_at_surface};
use self::twin::Turn;
use crate::equiangular::Segment;
use crate::layer_light::{LayerLanes, LayerLight};
use crate::lights::LightMix;
use crate::lobe::FogLobe;
use crate::settings::Settings;
use crate::watch::{Step, Watch, Weights};
use fog_core::bands::BandLanes;
use fog_core::colour::Observer;
use fog_core::patchiness::Crossed;
use fog_core::profile::ProfileLanes;
use fog_core::random::PathRng;
use fog_core::spectrum::{Spectrum, Wavelengths};
use fog_core::{Vec3A, math};
use fog_scene::Hit;
use fog_scene::camera::Ray;
use fog_scene::emitters::Breadth;
use fog_scene::light_groups::LightSource;
use fog_scene::medium::{MediumLanes, MediumView};
use fog_scene::phase::Scatterer;
use fog_scene::phase_angles::PhaseAngles;
use fog_scene::scene::Scene;
use fog_scene::sky_map::SkyLanes;
use fog_scene::twins::Twins;
use std::sync::Arc;

/// Scatterings before Russian roulette may end a path.
const ROULETTE_DEPTH: u32 = 3;
/// The same where broad emitters are all the light; until [`ROULETTE_DEPTH`] by the throughput alone, wherever the path is.
const ROULETTE_DEPTH_BROAD: u32 = 1;
/// Smallest probability of survival: bounds the weight of survivors.
const ROULETTE_MIN: f32 = 0.5;
/// The same where the layer tells what a path is worth.
const ROULETTE_MIN_KNOWN: f32 = 0.3;
/// Throughput below which roulette is played where every path ends in an environment: faint paths still tell much.
const ROULETTE_BELOW_SKY: f32 = 0.3;
/// The same without an environment, where late parts of a path seldom meet light (both measured on the quickstart).
const ROULETTE_BELOW: f32 = 1.0;
/// Paths that go on from the first collision where broad emitters are all the light: they fill the view of a droplet, and what
/// tells is into how many directions one looks.
const BRANCHES: u64 = 3;

/// A scene prepared for tracing paths.
#[derive(Debug)]
pub struct PathTracer<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) medium: Option<MediumView<'a>>,
    /// The fog of paths that have scattered often, and after how many scatterings.
    late: Option<(MediumView<'a>, u32)>,
    pub(crate) observer: &'a Observer,
    pub(crate) lights: LightMix,
    pub(crate) settings: Settings,
    /// One wavelength that every path uses where its choices must not depend on its own.
    reference_lanes: Option<ProfileLanes>,
    pub(crate) roulette_below: f32,
    roulette_depth: u32,
    layer_light: Option<LayerLight>,
    /// Paths that go on from the first collision.
    pub(crate) branches: u64,
    /// Of the fog among lamps.
    phase_angles: Option<PhaseAngles>,
    /// The twins of what paths run into, if they look at them.
    twins: Option<Arc<Twins>>,
}

/// What one path saw.
#[derive(Clone, Copy, Debug)]
pub struct PathRadiance {
    /// Relative radiance at the path's wavelengths.
    pub radiance: Spectrum,
    /// True if the path's first event was a scattering in the fog.
    pub airlight: bool,
    /// Further radiance: light of lamps that the fog scatters along the first flight, whatever that flight ended at. It is
    /// airlight too.
    pub glow: Spectrum,
}

/// State of a path between two events.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    pub(crate) origin: Vec3A,
    /// The last event's place, of which `origin` is a bit off at surfaces: from where lights were chosen.
    vertex: Vec3A,
    pub(crate) direction: Vec3A,
    pub(crate) beta: Spectrum,
    r_u: Spectrum,
    r_l: Spectrum,
    /// Scatterings so far.
    depth: u32,
    /// Part of `beta` that is for being one of several branches.
    share: f32,
    /// What the last flight crossed, in patchy fog.
    crossed: Option<Crossed>,
    /// How the last event turned it.
    turn: Turn,
}

/// What the wavelengths of a path need to be looked up.
pub(crate) struct Lanes {
    pub(crate) basis: [Spectrum; 3],
    pub(crate) bands: BandLanes,
    /// Colour of the sun.
    pub(crate) sun: Spectrum,
    pub(crate) medium: Option<MediumLanes>,
    late: Option<MediumLanes>,
    /// In the layer's own light; `None` where paths do not use it.
    layer: Option<LayerLanes>,
}

impl Lanes {
    pub(crate) fn sky(&self) -> SkyLanes<'_> {
        SkyLanes { basis: &self.basis, bands: &self.bands }
    }
}

/// A path at its first collision, from where several branches go on.
struct Fork {
    path: Path,
    t: f64,
    tau: f64,
    /// The one that goes now.
    branch: u64,
    of: u64,
}

impl Fork {
    /// The next branch, if one is left.
    #[inline]
    fn next(&mut self, rng: &mut PathRng, watch: &mut impl Watch) -> Option<(Path, Event)> {
        self.branch += 1;
        if self.branch >= self.of {
            return None;
        }
        rng.branch(self.branch);
        watch.see(|| Step::Branch { branch: self.branch, of: self.of });
        Some((self.path, Event::Collision { t: self.t, tau: self.tau }))
    }
}

/// What ends a flight.
enum Event {
    Surface(Hit),
    Collision { t: f64, tau: f64 },
    Escape,
}

impl<'a> PathTracer<'a> {
    /// Prepares a scene.
    #[must_use]
    pub fn new(scene: &'a Scene, observer: &'a Observer, settings: Settings) -> Self {
        let medium = scene.medium.as_ref().map(|m| m.view());
        let all = Wavelengths::monochromatic(550.0);
        let late = scene.late.as_ref().map(|late| (late.medium.view(), late.after));
        let reference_lanes = medium.as_ref().map(|m| m.profile.lanes(&all));
        let surrounded = scene.environment.is_some() || scene.sky.is_some();
        let roulette_below = if surrounded { ROULETTE_BELOW_SKY } else { ROULETTE_BELOW };
        let lights = LightMix::new(scene);
        let layer_light = medium.as_ref().and_then(|m| LayerLight::new(scene, m, observer));
        let (roulette_depth, branches) = if scene.emitters_alone() && scene.emitters().has(Breadth::Broad) {
            (ROULETTE_DEPTH_BROAD, BRANCHES)
        } else {
            (ROULETTE_DEPTH, 1)
        };
        let among_lamps = medium.as_ref().filter(|_| lights.lamp_probability() > 0.0);
        let phase_angles = among_lamps.map(|m| PhaseAngles::new(&m.phase));
        Self {
            scene,
            medium,
            late,
            observer,
            lights,
            settings,
            reference_lanes,
            roulette_below,
            roulette_depth,
            layer_light,
            branches,
            phase_angles,
            twins: twin::of_scene(scene),
        }
    }

    /// Radiance along a camera ray. `first_flight`, uniform in [0, 1), decides where the first collision would be.
    #[must_use]
    pub fn radiance(
        &self,
        ray: Ray,
        wavelengths: &Wavelengths,
        first_flight: f32,
        rng: &mut PathRng,
    ) -> PathRadiance {
        self.watched(ray, wavelengths, first_flight, rng, &mut ())
    }

    /// [`PathTracer::radiance`], which tells `watch` of its steps.
    ///
    /// It is compiled twice, once for `()`. What has two callers by that would no longer be inlined, which costs 3 % of the
    /// instructions; hence `inline(always)` on what it calls.
    #[inline]
    pub(crate) fn watched(
        &self,
        ray: Ray,
        wavelengths: &Wavelengths,
        first_flight: f32,
        rng: &mut PathRng,
        watch: &mut impl Watch,
    ) -> PathRadiance {
        let lanes = self.lanes(wavelengths);
        let mut path = Path::new(ray.origin, ray.direction);
        let mut out = PathRadiance { radiance: Spectrum::ZERO, airlight: false, glow: Spectrum::ZERO };
        let mut fork: Option<Fork> = None;
        let mut u = f64::from(first_flight);
        loop {
            // Fly to the next collision in the fog, or to a surface before it.
            let (mut event, end) = self.fly(&mut path, &lanes, u);
            watch.see(|| self.flight(&path, &lanes, u, &event));
            let segment = self.lit_segment(&path, end);
            if let Some(segment) = &segment {
                let glow = self.glow(&path, segment, &lanes, rng, watch);
                if path.depth == 0 {
                    out.glow = glow;
                } else {
                    out.radiance += glow;
                }
            }
            if let Event::Collision { t, tau } = event
                && path.depth == 0
            {
                out.airlight = true;
                fork = self.fork(&mut path, t, tau);
            }
            // Scatter, or end here: then the next branch scatters where the first flight ended.
            loop {
                let goes_on = match event {
                    Event::Escape => self.leave(&mut path, &lanes, &mut out, watch),
                    Event::Surface(hit) => self.meet(&mut path, &hit, &lanes, &mut out, rng, watch),
                    Event::Collision { t, tau } => {
                        self.scatter(&mut path, [t, tau], segment.as_ref(), &lanes, &mut out, rng, watch)
                    }
                };
                if goes_on && self.survives_roulette(&mut path, rng, watch) {
                    break;
                }
                let Some(next) = fork.as_mut().and_then(|fork| fork.next(rng, watch)) else { return out };
                (path, event) = next;
            }
            u = rng.flight();
        }
    }

    /// What is left for further branches at the first collision.
    #[inline(always)]
    fn fork(&self, path: &mut Path, t: f64, tau: f64) -> Option<Fork> {
        if self.branches == 1 {
            return None;
        }
        path.share = 1.0 / self.branches as f32;
        path.beta *= path.share;
        Some(Fork { path: *path, t, tau, branch: 0, of: self.branches })
    }

    /// A path leaves the scene; false, for it ends there.
    #[inline(always)]
    fn leave(&self, path: &mut Path, lanes: &Lanes, out: &mut PathRadiance, watch: &mut impl Watch) -> bool {
        self.pass(path, lanes, f64::INFINITY);
        let sum = self.escape(path, lanes, watch);
        watch.see(|| Step::Escape { added: sum });
        out.radiance += sum;
        let beyond = f64::INFINITY.copysign(f64::from(path.direction.y));
        let expected = self.layer_beside(path, lanes, beyond);
        self.add_difference(out, expected, Spectrum::ZERO, watch);
        false
    }

    /// A path meets a surface; false if it ends there.
    #[inline(always)]
    fn meet(
        &self,
        path: &mut Path,
        hit: &Hit,
        lanes: &Lanes,
        out: &mut PathRadiance,
        rng: &mut PathRng,
        watch: &mut impl Watch,
    ) -> bool {
        self.pass(path, lanes, f64::from(hit.t));
        let surface = self.scene.surface(hit, path.direction, &lanes.basis);
        let sum = self.emitted(path, hit, &surface, lanes);
        let expected = self.layer_beside(path, lanes, f64::from(surface.point.position.y));
        watch.see(|| Step::surface(hit, &surface, sum));
        watch.light(LightSource::Emitter(hit.triangle), sum, false);
        out.radiance += sum;
        if !self.may_scatter(path, watch) {
            return false;
        }
        out.radiance += self.lights_at_surface(path, &surface, lanes, rng, watch);
        let before = path.direction;
        let scattered = scatter_at_surface(path, &surface, rng);
        if self.twins.is_some() {
            path.turn = Turn::at_surface(&surface);
        }
        watch.see(|| if scattered { path.turned(before) } else { Step::Absorbed });
        let after = if scattered { self.layer_ahead(path, lanes) } else { Spectrum::ZERO };
        self.add_difference(out, expected, after, watch);
        scattered
    }

    /// A path meets a droplet at distance `t`, where the hero has crossed `tau`; false if it ends there.
    #[expect(clippy::too_many_arguments, reason = "a path, where it is, and who hears of it")]
    #[inline(always)]
    fn scatter(
        &self,
        path: &mut Path,
        [t, tau]: [f64; 2],
        segment: Option<&Segment>,
        lanes: &Lanes,
        out: &mut PathRadiance,
        rng: &mut PathRng,
        watch: &mut impl Watch,
    ) -> bool {
        if !self.may_scatter(path, watch) {
            return false;
        }
        let before = (path.r_u, path.direction);
        let scatterer = self.collide(path, lanes, t, tau, rng);
        watch.see(|| self.collision(path, lanes, &scatterer));
        let flight = segment.map(|segment| Flight {
            segment,
            t,
            before: before.0 * scatterer.probability_ratio * (1.0 / self.flight_density(path, lanes, tau)),
        });
        out.radiance += self.scatter_in_fog(path, &scatterer, flight.as_ref(), lanes, rng, watch);
        watch.see(|| path.turned(before.1));
        let after = self.layer_at_collision(path, lanes, rng);
        self.add_difference(out, Spectrum::ZERO, after, watch);
        true
    }

    /// What the wavelengths of a path need to be looked up.
    #[inline(always)]
    pub(crate) fn lanes(&self, wavelengths: &Wavelengths) -> Lanes {
        let bands = BandLanes::new(wavelengths);
        Lanes {
            basis: self.observer.lane_basis(wavelengths),
            bands,
            sun: self.scene.sun.as_ref().map_or(Spectrum::ONE, |sun| bands.gather(&sun.colour.0)),
            medium: self.medium.as_ref().map(|m| m.lanes(wavelengths)),
            late: self.late.as_ref().map(|(m, _)| m.lanes(wavelengths)),
            layer: self.layer_lanes(wavelengths),
        }
    }

    /// The fog that a path flies and scatters in after so many scatterings, with its wavelengths there.
    #[inline(always)]
    fn fog<'b>(&'b self, depth: u32, lanes: &'b Lanes) -> Option<(&'b MediumView<'a>, &'b MediumLanes)> {
        let late = self.late.as_ref().zip(lanes.late.as_ref());
        match late {
            Some(((medium, after), lanes)) if depth >= *after => Some((medium, lanes)),
            _ => self.medium.as_ref().zip(lanes.medium.as_ref()),
        }
    }

    /// Samples the free flight at the hero wavelength and looks for a surface before its end. Among lamps, also the distance
    /// of the first surface behind it.
    #[inline(always)]
    fn fly(&self, path: &mut Path, lanes: &Lanes, u: f64) -> (Event, f64) {
        if self.is_patchy() {
            let (event, end, crossed) = self.fly_through_patches(path.origin, path.direction, lanes, u);
            path.crossed = Some(crossed);
            return (event, end);
        }
        let collision = self.fog(path.depth, lanes).and_then(|(medium, lanes)| {
            let tau = math::neg_ln(1.0 - u);
            let (y, dy) = (f64::from(path.origin.y), f64::from(path.direction.y));
            medium.profile.free_flight(y, dy, f64::INFINITY, tau, &lanes.profile).map(|t| (t, tau))
        });
        let t_max = collision.map_or(f32::INFINITY, |(t, _)| t as f32);
        let reach = if self.lights.lamp_probability() > 0.0 { f32::INFINITY } else { t_max };
        // The number that chose the flight's length also tells partly transparent surfaces from holes.
        let hit = self.scene.scatterer(path.origin, path.direction, reach, u.to_bits());
        let end = hit.as_ref().map_or(f64::INFINITY, |hit| f64::from(hit.t));
        let event = match (hit, collision) {
            (Some(hit), _) if hit.t <= t_max => Event::Surface(hit),
            (_, Some((t, tau))) => Event::Collision { t, tau },
            (_, None) => Event::Escape,
        };
        (event, end)
    }

    /// Weights a flight of length `t` without collision: transmittance at each wavelength over the hero's.
    #[inline(always)]
    fn pass(&self, path: &mut Path, lanes: &Lanes, t: f64) {
        let Some((medium, lanes)) = self.fog(path.depth, lanes) else { return };
        if medium.grey && !self.lights.any() {
            return;
        }
        let (y, dy) = (f64::from(path.origin.y), f64::from(path.direction.y));
        let even = || medium.profile.optical_depth(y, dy, t, &lanes.profile);
        let tau = path.crossed.map_or_else(even, |crossed| crossed.depth);
        path.r_l *= math::fast_exp(tau[0]);
        if !medium.grey {
            let ratio = (tau - Spectrum::splat(tau[0])).exp_neg();
            path.beta *= ratio;
            path.r_u *= ratio;
        }
    }

    /// Moves to a collision at distance `t`, where the hero has crossed `tau`; returns what the path collides with.
    #[inline(always)]
    fn collide(&self, path: &mut Path, lanes: &Lanes, t: f64, tau: f64, rng: &mut PathRng) -> Scatterer {
        let (medium, lanes) = self.fog(path.depth, lanes).expect("collision needs fog");
        let (y, dy) = (f64::from(path.origin.y), f64::from(path.direction.y));
        let even_y = || (y + t * dy).clamp(medium.profile.base_y(), medium.profile.top_y());
        let y_hit = path.crossed.map_or_else(even_y, |crossed| crossed.even_y);
        if !medium.grey {
            let even = || medium.profile.optical_depth(y, dy, t, &lanes.profile);
            let depth = path.crossed.map_or_else(even, |crossed| crossed.depth);
            let sigma_t = medium.profile.sigma_t(y_hit, &lanes.profile);
            let ratio = (depth - Spectrum::splat(tau as f32)).exp_neg() * sigma_t * (1.0 / sigma_t[0]);
            path.beta *= ratio;
            path.r_u *= ratio;
        }
        path.beta *= medium.profile.albedo(y_hit, &lanes.profile);
        path.origin += path.direction * t as f32;
        path.vertex = path.origin;
        let scatterer = medium.phase.scatterer(medium.profile.zeta(y_hit), &lanes.phase, rng);
        path.beta *= scatterer.probability_ratio;
        path.r_u *= scatterer.probability_ratio;
        scatterer
    }

    /// Connects a collision to the lights, then turns the path by the phase function of the hero; returns the light.
    #[inline]
    fn scatter_in_fog(
        &self,
        path: &mut Path,
        scatterer: &Scatterer,
        flight: Option<&Flight<'_>>,
        lanes: &Lanes,
        rng: &mut PathRng,
        watch: &mut impl Watch,
    ) -> Spectrum {
        let (medium, _) = self.fog(path.depth, lanes).expect("collision needs fog");
        let sun = self.scene.sun.zip(self.reference_lanes.as_ref()).map(|(sun, reference)| {
            let (y, dy) = (f64::from(path.origin.y), f64::from(sun.direction.y));
            let tau = medium.profile.optical_depth(y, dy, f64::INFINITY, reference);
            (sun.direction, math::fast_exp(-tau[0]))
        });
        let lobe = FogLobe::new(&medium.phase, scatterer, path.direction, sun);
        let sum = self.lights_in_fog(path, &lobe, flight, lanes, rng, watch);

        let (direction, value) = lobe.sample(rng);
        if !medium.grey || self.lights.any() {
            let inverse = 1.0 / value.density[0];
            path.r_l = path.r_u * inverse;
            path.r_u *= value.density * inverse;
            path.beta *= value.phase * inverse;
        }
        if self.twins.is_some() {
            path.turn = Turn::Droplet { before: path.direction, row: scatterer.row };
        }
        path.direction = direction;
        path.depth += 1;
        sum
    }

    /// Light of the environment, the sky and the sun's disc that a path which leaves the scene meets.
    #[inline(always)]
    fn escape(&self, path: &Path, lanes: &Lanes, watch: &mut impl Watch) -> Spectrum {
        let mut sum = Spectrum::ZERO;
        if let Some(environment) = &self.scene.environment {
            sum += path.beta * (environment.radiance / path.r_u.mean());
            watch.light(LightSource::Environment, sum, false);
        }
        if let Some(sky) = &self.scene.sky {
            let (radiance, pdf) = sky.radiance_and_pdf(path.direction, lanes.sky());
            let pdf = if path.depth == 0 { 0.0 } else { self.lights.sky_probability() * pdf };
            let light = path.beta * radiance * (1.0 / (path.r_u + path.r_l * pdf).mean());
            watch.light(LightSource::Environment, light, false);
            sum += light;
        }
        if let Some(sun) = self.scene.sun.as_ref().filter(|s| s.contains(path.direction)) {
            let pdf = if path.depth == 0 { 0.0 } else { self.lights.sun_probability() * sun.pdf() };
            let density = (path.r_u + path.r_l * pdf).mean();
            let light = path.beta * lanes.sun * (sun.radiance() / density);
            watch.light(LightSource::Sun, light, false);
            sum += light;
        }
        sum
    }

    /// Ends paths in proportion to the throughput that they have lost, and keeps the weights in a safe range.
    #[inline(always)]
    fn survives_roulette(&self, path: &mut Path, rng: &mut PathRng, watch: &mut impl Watch) -> bool {
        let mean = path.r_u.mean();
        if path.depth > self.roulette_depth {
            let [below, least] = self.roulette(path);
            let survival = (path.beta.max_lane() / (mean * below * path.share)).max(least);
            if survival < 1.0 {
                let survived = rng.uniform() < survival;
                watch.see(|| Step::Roulette { survival, survived });
                if !survived {
                    return false;
                }
                path.beta *= 1.0 / survival;
            }
        }
        if !(1e-6..1e6).contains(&mean) {
            let scale = 1.0 / mean;
            path.beta *= scale;
            path.r_u *= scale;
            path.r_l *= scale;
        }
        true
    }

    /// False if another scattering would make the path longer than was asked for.
    #[inline]
    fn may_scatter(&self, path: &Path, watch: &mut impl Watch) -> bool {
        let may = self.settings.max_depth.is_none_or(|max| path.depth + 1 < max);
        if !may {
            watch.see(|| Step::TooLong);
        }
        may
    }
}

impl Path {
    pub(crate) fn new(origin: Vec3A, direction: Vec3A) -> Self {
        let (beta, r_u, r_l) = (Spectrum::ONE, Spectrum::ONE, Spectrum::ZERO);
        Self {
            origin,
            vertex: origin,
            direction,
            beta,
            r_u,
            r_l,
            depth: 0,
            share: 1.0,
            crossed: None,
            turn: Turn::Untold,
        }
    }

    fn weights(&self) -> Weights {
        Weights { beta: self.beta, r_u: self.r_u, r_l: self.r_l }
    }

    /// A turn for a watch.
    fn turned(&self, before: Vec3A) -> Step {
        let (direction, depth) = (self.direction, self.depth);
        Step::Turn { direction, cosine: before.dot(direction), depth, weights: self.weights() }
    }
}
