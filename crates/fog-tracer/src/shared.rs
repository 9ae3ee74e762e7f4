//! One path in many fogs: traced in one of them and weighed in all.
//!
//! Frames that differ in nothing but the fog have the same geometry, and a path of one is a path of the others, with
//! another probability. As the hero wavelength decides where a path goes and its companions weigh what it finds
//! ([`crate::path`]), here a hero fog decides. Every sample takes one path from each fog, and what a path finds counts in
//! fog j at wavelength i with its throughput there over the mean of the path's densities in all fogs at all wavelengths:
//! the balance heuristic (Veach & Guibas 1995) over fogs and wavelengths at once.
//!
//! This integrator is a second one beside [`crate::path`], because what makes that one fast would make this one useless.
//! There a scattering *draws* the row of the phase function's table, so that layers of different heights would have nearly
//! no path in common; here both rows are always summed. There weights are eight wavelengths; here they are as many in
//! each fog, or one number in each where no fog depends on the wavelength.
//!
//! Fogs in which a path has become all but impossible are dropped from it ([`LEAST_SHARE`]).

mod value;

use self::value::Value;
use crate::groups::GroupLight;
use crate::lights::LightSample;
use crate::lobe::sun_share;
use crate::path::{Lanes, PathTracer, turn_at_surface};
use crate::watch::Visibility;
use fog_core::random::PathRng;
use fog_core::spectrum::{Spectrum, Wavelengths};
use fog_core::{Vec3A, math, warp};
use fog_scene::Hit;
use fog_scene::camera::Ray;
use fog_scene::light_groups::LightSource;
use fog_scene::medium::{Medium, MediumLanes, MediumView};
use fog_scene::phase::PhaseRows;
use fog_scene::scene::Surface;

/// Most fogs that share paths.
pub const MAX_FOGS: usize = 8;
/// Share of a path's density over all fogs below which one is dropped from it. Of the light of that fog, at most the part
/// is lost that comes by such paths, and of all its paths those are no greater a share than this.
const LEAST_SHARE: f32 = 1e-6;
/// Scatterings before Russian roulette may end a path, and its smallest probability of survival.
const ROULETTE: (u32, f32) = (3, 0.5);

/// A scene in several fogs.
pub(crate) struct SharedTracer<'a> {
    pub(crate) base: PathTracer<'a>,
    media: Vec<MediumView<'a>>,
    /// Where nothing depends on the wavelength: the same for all paths.
    grey_lanes: Option<Vec<MediumLanes>>,
    /// One wavelength that choices are made by which must not depend on a path's own.
    reference: Vec<MediumLanes>,
}

/// A path between two events. Weights are relative to the density of the path in the hero fog at the hero wavelength,
/// as in [`crate::path`].
struct SharedPath<V> {
    origin: Vec3A,
    /// The last event's place, from where lights were chosen.
    vertex: Vec3A,
    direction: Vec3A,
    depth: u32,
    hero: usize,
    /// Throughput of the surfaces.
    beta: Spectrum,
    /// Throughput of each fog.
    t: [V; MAX_FOGS],
    /// Density in each fog.
    r_u: [V; MAX_FOGS],
    /// The same if light sampling had found the last vertex.
    r_l: [V; MAX_FOGS],
    /// Fogs in which the path still counts.
    live: [bool; MAX_FOGS],
}

/// The wavelengths of a path.
struct SharedLanes<'l> {
    base: Lanes,
    media: &'l [MediumLanes],
}

enum Event {
    Surface(Hit),
    Collision { t: f64, tau: f64 },
    Escape,
}

impl<'a> SharedTracer<'a> {
    /// `base` is the scene with any fog or none, `media` are 1 to [`MAX_FOGS`] fogs that can be shared.
    pub(crate) fn new(base: PathTracer<'a>, media: &'a [Medium]) -> Self {
        let media: Vec<MediumView<'a>> = media.iter().map(Medium::view).collect();
        let all = Wavelengths::monochromatic(base.settings.wavelength_nm.unwrap_or(550.0));
        let lanes: Vec<MediumLanes> = media.iter().map(|m| m.lanes(&all)).collect();
        let grey = base.settings.wavelength_nm.is_some() || media.iter().all(|m| m.grey);
        Self { base, media, grey_lanes: grey.then(|| lanes.clone()), reference: lanes }
    }

    /// Number of fogs.
    pub(crate) fn fogs(&self) -> usize {
        self.media.len()
    }

    /// Follows a path of fog `hero`, and tells `found` of the light that it finds in each fog.
    pub(crate) fn trace(
        &self,
        ray: Ray,
        wavelengths: &Wavelengths,
        (first_flight, hero): (f32, usize),
        rng: &mut PathRng,
        found: &mut GroupLight<'_>,
    ) {
        let base = self.base.lanes(wavelengths);
        match &self.grey_lanes {
            Some(media) => {
                self.walk::<f32>(ray, &SharedLanes { base, media }, (first_flight, hero), rng, found)
            }
            None => {
                let media: Vec<MediumLanes> = self.media.iter().map(|m| m.lanes(wavelengths)).collect();
                let lanes = SharedLanes { base, media: &media };
                self.walk::<Spectrum>(ray, &lanes, (first_flight, hero), rng, found);
            }
        }
    }

    fn walk<V: Value>(
        &self,
        ray: Ray,
        lanes: &SharedLanes<'_>,
        (first_flight, hero): (f32, usize),
        rng: &mut PathRng,
        found: &mut GroupLight<'_>,
    ) {
        let mut path = SharedPath::<V>::new(ray, hero, self.fogs());
        let mut u = f64::from(first_flight);
        loop {
            let goes_on = match self.fly(&path, lanes, u) {
                Event::Escape => {
                    self.pass(&mut path, lanes, f64::INFINITY);
                    self.escape(&path, lanes, found);
                    false
                }
                Event::Surface(hit) => {
                    self.pass(&mut path, lanes, f64::from(hit.t));
                    let surface = self.base.scene.surface(&hit, path.direction, &lanes.base.basis);
                    self.emitted(&path, &hit, &surface, found);
                    self.may_scatter(&path) && {
                        self.lights_at_surface(&path, &surface, lanes, rng, found);
                        path.scatter_at_surface(&surface, rng)
                    }
                }
                Event::Collision { t, tau } => {
                    found.airlight |= path.depth == 0;
                    self.may_scatter(&path) && {
                        self.collide(&mut path, lanes, t, tau);
                        self.scatter_in_fog(&mut path, lanes, rng, found);
                        true
                    }
                }
            };
            if !goes_on || !path.survives(self.fogs(), self.base.roulette_below, rng) {
                return;
            }
            u = rng.uniform_f64();
        }
    }

    fn may_scatter<V>(&self, path: &SharedPath<V>) -> bool {
        self.base.settings.max_depth.is_none_or(|max| path.depth + 1 < max)
    }

    /// Samples the free flight in the hero fog and looks for a surface before its end.
    fn fly<V>(&self, path: &SharedPath<V>, lanes: &SharedLanes<'_>, u: f64) -> Event {
        let tau = math::neg_ln(1.0 - u);
        let [y, dy] = path.ray();
        let (profile, own) = (self.media[path.hero].profile, &lanes.media[path.hero].profile);
        let collision = profile.free_flight(y, dy, f64::INFINITY, tau, own);
        let t_max = collision.map_or(f32::INFINITY, |t| t as f32);
        match self.base.scene.scatterer(path.origin, path.direction, t_max, u.to_bits()) {
            Some(hit) => Event::Surface(hit),
            None => collision.map_or(Event::Escape, |t| Event::Collision { t, tau }),
        }
    }

    /// Optical depth of a ray in each live fog.
    #[inline(always)]
    fn depths<V: Value>(
        &self,
        path: &SharedPath<V>,
        ray: [f64; 2],
        length: f64,
        lanes: &SharedLanes<'_>,
    ) -> [V; MAX_FOGS] {
        let mut out = [V::ZERO; MAX_FOGS];
        for j in (0..self.fogs()).filter(|&j| path.live[j]) {
            out[j] = V::depth(self.media[j].profile, ray, length, &lanes.media[j]);
        }
        out
    }

    /// Weights a flight of length `t` without collision.
    fn pass<V: Value>(&self, path: &mut SharedPath<V>, lanes: &SharedLanes<'_>, t: f64) {
        let depths = self.depths(path, path.ray(), t, lanes);
        let own = depths[path.hero].hero();
        let inverse = V::exp_neg(V::ZERO, own);
        for j in 0..self.fogs() {
            let ratio = depths[j].exp_neg(own);
            path.t[j] = path.t[j].times(ratio);
            path.r_u[j] = path.r_u[j].times(ratio);
            path.r_l[j] = path.r_l[j].times(inverse);
        }
    }

    /// Moves to a collision at distance `t`, where the hero has crossed `tau`.
    fn collide<V: Value>(&self, path: &mut SharedPath<V>, lanes: &SharedLanes<'_>, t: f64, tau: f64) {
        let [y, dy] = path.ray();
        let hero = self.media[path.hero].profile;
        let y_hit = (y + t * dy).clamp(hero.base_y(), hero.top_y());
        let depths = self.depths(path, [y, dy], t, lanes);
        let inverse = 1.0 / V::sigma_t(hero, y_hit, &lanes.media[path.hero]).hero();
        let live = path.live;
        for j in (0..self.fogs()).filter(|&j| live[j]) {
            let (profile, lanes) = (self.media[j].profile, &lanes.media[j]);
            if y_hit < profile.base_y() || y_hit > profile.top_y() {
                path.drop_fog(j);
                continue;
            }
            let ratio =
                depths[j].exp_neg(tau as f32).times(V::sigma_t(profile, y_hit, lanes)).scaled(inverse);
            path.t[j] = path.t[j].times(ratio).times(V::albedo(profile, y_hit, lanes));
            path.r_u[j] = path.r_u[j].times(ratio);
        }
        path.origin += path.direction * t as f32;
        path.vertex = path.origin;
    }

    /// Connects a collision to the lights, then turns the path by the phase function of the hero.
    fn scatter_in_fog<V: Value>(
        &self,
        path: &mut SharedPath<V>,
        lanes: &SharedLanes<'_>,
        rng: &mut PathRng,
        found: &mut GroupLight<'_>,
    ) {
        let rows: [PhaseRows; MAX_FOGS] = std::array::from_fn(|j| {
            let y = f64::from(path.origin.y);
            self.media.get(j).map_or(PhaseRows::default(), |m| m.phase.rows(m.profile.zeta(y)))
        });
        let (sun, share) = self.towards_sun(path);
        // Phase function and density of a direction in each fog, of which one is known to be at `m` from straight on.
        let at = |path: &SharedPath<V>, after: Vec3A, m: f32| -> [[V; 2]; MAX_FOGS] {
            let around_sun = 0.5 * (after - sun).length_squared();
            let mut out = [[V::ZERO; 2]; MAX_FOGS];
            for j in (0..self.fogs()).filter(|&j| path.live[j]) {
                let phase = V::phase(&self.media[j], rows[j], m, &lanes.media[j]);
                out[j] = [phase, phase];
                if share > 0.0 {
                    let other = V::phase(&self.media[j], rows[j], around_sun, &lanes.media[j]);
                    out[j][1] = phase.scaled(1.0 - share).plus(other.scaled(share));
                }
            }
            out
        };
        let from_straight = |direction: Vec3A| 0.5 * (direction - path.direction).length_squared();

        let light = self.base.lights.sample(self.base.scene, path.origin, &lanes.base, rng);
        if let Some(light) = light {
            let values = at(path, light.direction, from_straight(light.direction));
            self.connect(path, path.origin, &light, &values, Spectrum::ONE, lanes, rng, found);
        }

        let towards_sun = share > 0.0 && rng.uniform() < share;
        let axis = if towards_sun { sun } else { path.direction };
        let PhaseRows { lower, upper, t } = rows[path.hero];
        let row = if rng.uniform() < t { upper } else { lower };
        let phase = &self.media[path.hero].phase;
        let m = phase.sample(row, &lanes.media[path.hero].phase, rng.uniform_f64(), rng.uniform());
        let (sin_phi, cos_phi) = math::sin_cos_turns(rng.uniform());
        let sin = (m * (2.0 - m)).max(0.0).sqrt();
        let after = (warp::frame(axis) * Vec3A::new(sin * cos_phi, sin * sin_phi, 1.0 - m)).normalize();
        let values = at(path, after, if towards_sun { from_straight(after) } else { m });
        let inverse = 1.0 / values[path.hero][1].hero();
        for j in 0..self.fogs() {
            let [phase, density] = values[j];
            path.r_l[j] = path.r_u[j].scaled(inverse);
            path.r_u[j] = path.r_u[j].times(density).scaled(inverse);
            path.t[j] = path.t[j].times(phase).scaled(inverse);
        }
        path.direction = after;
        path.depth += 1;
    }

    /// Direction of the sun, and the share of directions that is drawn around it: by its mean transmittance over the fogs.
    fn towards_sun<V>(&self, path: &SharedPath<V>) -> (Vec3A, f32) {
        let Some(sun) = &self.base.scene.sun else { return (path.direction, 0.0) };
        let ray = [f64::from(path.origin.y), f64::from(sun.direction.y)];
        let beam = |(m, lanes): (&MediumView<'_>, &MediumLanes)| {
            math::fast_exp(-f32::depth(m.profile, ray, f64::INFINITY, lanes))
        };
        let sum: f32 = self.media.iter().zip(&self.reference).map(beam).sum();
        (sun.direction, sun_share(path.direction, sun.direction, sum / self.fogs() as f32))
    }

    /// Next-event estimation from a surface.
    fn lights_at_surface<V: Value>(
        &self,
        path: &SharedPath<V>,
        s: &Surface,
        lanes: &SharedLanes<'_>,
        rng: &mut PathRng,
        found: &mut GroupLight<'_>,
    ) {
        let Some(bsdf) = &s.bsdf else { return };
        let Some(light) = self.base.lights.sample(self.base.scene, s.point.position, &lanes.base, rng) else {
            return;
        };
        let to_local = s.world_from_shading.transpose();
        let wi = to_local * light.direction;
        let (value, pdf) = bsdf.eval(to_local * -path.direction, wi);
        if pdf == 0.0 || s.normal.dot(light.direction) * wi.z <= 0.0 {
            return;
        }
        let density = V::ONE.scaled(pdf);
        let values = [[V::ONE, density]; MAX_FOGS];
        self.connect(path, s.point.spawn_origin(light.direction), &light, &values, value, lanes, rng, found);
    }

    /// Tells of the light that comes from a light sample: `values` are phase function and density of its direction in each fog,
    /// `value` is a factor of the former in all.
    #[expect(clippy::too_many_arguments, reason = "a connection is between two ends, each of several parts")]
    fn connect<V: Value>(
        &self,
        path: &SharedPath<V>,
        origin: Vec3A,
        light: &LightSample,
        values: &[[V; 2]; MAX_FOGS],
        value: Spectrum,
        lanes: &SharedLanes<'_>,
        rng: &mut PathRng,
        found: &mut GroupLight<'_>,
    ) {
        let ray = [f64::from(origin.y), f64::from(light.direction.y)];
        let depths = self.depths(path, ray, f64::from(light.distance), lanes);
        let mut weights = [V::ZERO; MAX_FOGS];
        let mut density = 0.0;
        for j in (0..self.fogs()).filter(|&j| path.live[j]) {
            let transmittance = depths[j].exp_neg(0.0);
            let [phase, scattering] = values[j];
            weights[j] = path.t[j].times(phase).times(transmittance);
            let own = V::ONE.scaled(light.pdf);
            let both = if light.beam { own } else { own.plus(scattering.times(transmittance)) };
            density += path.r_u[j].times(both).mean();
        }
        if density <= 0.0 {
            return;
        }
        let light_in = path.beta * value * light.radiance * (self.fogs() as f32 / density);
        let most = (0..self.fogs()).map(|j| weights[j].weigh(light_in).max_lane()).fold(0.0, f32::max);
        let (keep, visibility) = self.base.shadow(origin, light, most, rng);
        if visibility != Visibility::Free {
            return;
        }
        let scale = 1.0 / keep;
        for j in (0..self.fogs()).filter(|&j| path.live[j]) {
            found.add(j, light.source, weights[j].weigh(light_in * scale));
        }
    }

    /// Tells of light that the path has met by chance, which light sampling would have found with density `pdf`.
    fn met<V: Value>(
        &self,
        path: &SharedPath<V>,
        source: LightSource,
        light: Spectrum,
        pdf: f32,
        found: &mut GroupLight<'_>,
    ) {
        let density: f32 = (0..self.fogs()).map(|j| path.r_u[j].plus(path.r_l[j].scaled(pdf)).mean()).sum();
        let light = path.beta * light * (self.fogs() as f32 / density);
        for j in (0..self.fogs()).filter(|&j| path.live[j]) {
            found.add(j, source, path.t[j].weigh(light));
        }
    }

    /// Light of the environment and the sun's disc that a path which leaves the scene meets.
    fn escape<V: Value>(&self, path: &SharedPath<V>, lanes: &SharedLanes<'_>, found: &mut GroupLight<'_>) {
        let scene = self.base.scene;
        if let Some(environment) = &scene.environment {
            self.met(path, LightSource::Environment, Spectrum::splat(environment.radiance), 0.0, found);
        }
        if let Some(sky) = &scene.sky {
            let (radiance, pdf) = sky.radiance_and_pdf(path.direction, lanes.base.sky());
            let pdf = if path.depth == 0 { 0.0 } else { self.base.lights.sky_probability() * pdf };
            self.met(path, LightSource::Environment, radiance, pdf, found);
        }
        if let Some(sun) = scene.sun.as_ref().filter(|s| s.contains(path.direction)) {
            let pdf = if path.depth == 0 { 0.0 } else { self.base.lights.sun_probability() * sun.pdf() };
            self.met(path, LightSource::Sun, lanes.base.sun * sun.radiance(), pdf, found);
        }
    }

    /// Light that the surface itself emits towards the path.
    fn emitted<V: Value>(
        &self,
        path: &SharedPath<V>,
        hit: &Hit,
        surface: &Surface,
        found: &mut GroupLight<'_>,
    ) {
        if surface.emission.is_zero() {
            return;
        }
        let cos = -surface.normal.dot(path.direction);
        let Self { base, .. } = self;
        let pdf =
            if path.depth == 0 { 0.0 } else { base.lights.emitter_pdf(base.scene, path.vertex, hit, cos) };
        self.met(path, LightSource::Emitter(hit.triangle), surface.emission, pdf, found);
    }
}

impl<V: Value> SharedPath<V> {
    fn new(ray: Ray, hero: usize, fogs: usize) -> Self {
        let live = std::array::from_fn(|j| j < fogs);
        let ones = live.map(|live| if live { V::ONE } else { V::ZERO });
        let Ray { origin, direction } = ray;
        let r_l = [V::ZERO; MAX_FOGS];
        Self {
            origin,
            vertex: origin,
            direction,
            depth: 0,
            hero,
            beta: Spectrum::ONE,
            t: ones,
            r_u: ones,
            r_l,
            live,
        }
    }

    fn scatter_at_surface(&mut self, surface: &Surface, rng: &mut PathRng) -> bool {
        let Some(turn) = turn_at_surface(self.direction, surface, rng) else { return false };
        self.beta *= turn.weight;
        self.r_l = self.r_u.map(|r| r.scaled(1.0 / turn.pdf));
        (self.vertex, self.origin, self.direction) = (turn.vertex, turn.origin, turn.direction);
        self.depth += 1;
        !self.beta.is_zero()
    }

    fn drop_fog(&mut self, j: usize) {
        self.live[j] = false;
        (self.t[j], self.r_u[j], self.r_l[j]) = (V::ZERO, V::ZERO, V::ZERO);
    }

    /// Ends paths in proportion to the throughput that they have lost, keeps the weights in a safe range, and drops fogs.
    fn survives(&mut self, fogs: usize, below: f32, rng: &mut PathRng) -> bool {
        let sum: f32 = self.r_u[..fogs].iter().map(|r| r.mean()).sum();
        let mean = sum / fogs as f32;
        if self.depth > ROULETTE.0 {
            let most = self.t[..fogs].iter().map(|t| t.weigh(self.beta).max_lane()).fold(0.0, f32::max);
            let survival = (most / (mean * below)).max(ROULETTE.1);
            if survival < 1.0 {
                if rng.uniform() >= survival {
                    return false;
                }
                self.beta *= 1.0 / survival;
            }
        }
        for j in 0..fogs {
            if self.live[j] && j != self.hero && self.r_u[j].mean() < LEAST_SHARE * sum {
                self.drop_fog(j);
            }
        }
        if !(1e-6..1e6).contains(&mean) {
            let scale = 1.0 / mean;
            for values in [&mut self.t, &mut self.r_u, &mut self.r_l] {
                values.iter_mut().for_each(|v| *v = v.scaled(scale));
            }
        }
        true
    }
}

impl<V> SharedPath<V> {
    /// Height of the origin and rise per metre.
    fn ray(&self) -> [f64; 2] {
        [f64::from(self.origin.y), f64::from(self.direction.y)]
    }
}
