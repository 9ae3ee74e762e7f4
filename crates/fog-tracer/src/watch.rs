//! Watching one path: what the integrator did, step by step, in numbers.
//!
//! The integrator tells a [`Watch`] of each step. Rendering watches with `()`, which compiles to nothing; a `Vec` of steps
//! keeps them for [`crate::replay`].

use crate::lights::LightSample;
use fog_core::Vec3A;
use fog_core::spectrum::Spectrum;
use fog_scene::Hit;
use fog_scene::light_groups::LightSource;
use fog_scene::phase::Scatterer;
use fog_scene::scene::Surface;

/// One who is told of the steps of a path.
pub trait Watch {
    /// Takes a step, which is put together only for those who want it.
    fn see(&mut self, step: impl FnOnce() -> Step);

    /// Takes light that the path adds to its sum, and whether it is [`crate::path::PathRadiance::glow`].
    fn light(&mut self, source: LightSource, light: Spectrum, glow: bool);
}

impl Watch for () {
    #[inline(always)]
    fn see(&mut self, _: impl FnOnce() -> Step) {}

    #[inline(always)]
    fn light(&mut self, _: LightSource, _: Spectrum, _: bool) {}
}

impl Watch for Vec<Step> {
    fn see(&mut self, step: impl FnOnce() -> Step) {
        self.push(step());
    }

    /// The steps tell of it.
    fn light(&mut self, _: LightSource, _: Spectrum, _: bool) {}
}

/// Weights of a path at its wavelengths: `beta` over the mean of `r_u` over the lanes weighs what light it meets by chance.
/// See [`crate::path`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Throughput over the density of the hero wavelength.
    pub beta: Spectrum,
    /// Density of the path at each wavelength over the hero's.
    pub r_u: Spectrum,
    /// The same if light sampling had found the last vertex.
    pub r_l: Spectrum,
}

/// What ends a flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlightEnd {
    /// A droplet.
    Fog,
    /// A surface.
    Surface,
    /// Nothing: out of the scene.
    Nowhere,
}

/// What became of a connection to a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Visibility {
    /// No light would come along it, so nothing was traced.
    Dark,
    /// It lost the game for connections of little light, so nothing was traced.
    Dropped,
    /// A surface is in between.
    Blocked,
    /// The light is seen.
    Free,
}

/// Something that happened to a path. Spectra are at the path's wavelengths; positions in metres, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// From one event to the next.
    Flight {
        /// Start.
        origin: Vec3A,
        /// Unit vector.
        direction: Vec3A,
        /// Metres; infinite if it leads out of the scene.
        length_m: f64,
        /// Optical depth at the hero wavelength at which a droplet was to be met.
        drawn_tau: f64,
        /// Optical depth of the way flown.
        tau: Spectrum,
        /// What came at the end.
        end: FlightEnd,
    },
    /// Met a droplet.
    Collision {
        /// Where.
        position: Vec3A,
        /// Extinction coefficient there in 1/m.
        sigma_t: Spectrum,
        /// Scattering over extinction there.
        albedo: Spectrum,
        /// Row of the table of phase functions; 0 where there is none.
        row: usize,
        /// Odds of that row at each wavelength over those at the hero.
        probability_ratio: Spectrum,
        /// After the collision.
        weights: Weights,
    },
    /// Met a surface.
    Surface {
        /// Where.
        position: Vec3A,
        /// Of the triangle, on the side of the path.
        normal: Vec3A,
        /// For shading.
        shading_normal: Vec3A,
        /// Index of the triangle in the scene.
        triangle: u32,
        /// Index of the material.
        material: u32,
        /// Index of the node.
        object: u32,
        /// Whether it reflects or transmits at all.
        scatters: bool,
        /// Radiance that it emits.
        emission: Spectrum,
        /// What of it the path adds to the sum.
        added: Spectrum,
    },
    /// Left the scene.
    Escape {
        /// What the path adds to the sum: environment, sky and disc of the sun.
        added: Spectrum,
    },
    /// Chose a point of the last flight by its nearness to a lamp; the connection that follows starts there.
    NearLamp {
        /// Where.
        position: Vec3A,
        /// Along the flight, in metres.
        distance_m: f64,
    },
    /// Looked for light from the last event on (next-event estimation) and found a direction to a light.
    Connection {
        /// To the light.
        direction: Vec3A,
        /// In metres; infinite to sun and sky.
        distance_m: f32,
        /// Radiance of the light, or irradiance of a light without extent.
        radiance: Spectrum,
        /// Density of the light sampling in 1/sr with the choice of the light; the choice's probability for a light without extent.
        density: f32,
        /// Whether the light has no extent: a lamp or a parallel beam.
        beam: bool,
        /// Phase function in 1/sr, or BSDF times cosine.
        value: Spectrum,
        /// Of the fog, from here to the light.
        transmittance: Spectrum,
        /// What the connection is worth if nothing is in between.
        worth: Spectrum,
        /// Probability with which it was traced at all.
        kept: f32,
        /// What came of it.
        visibility: Visibility,
        /// What the path adds to the sum.
        added: Spectrum,
    },
    /// Turned: by the phase function of a droplet, or by the BSDF of a surface.
    Turn {
        /// Unit vector.
        direction: Vec3A,
        /// Cosine of the angle between the directions of travel before and after.
        cosine: f32,
        /// Number of turns so far.
        depth: u32,
        /// After the turn.
        weights: Weights,
    },
    /// Went back to the first collision, from where several branches go on.
    Branch {
        /// The one that begins, from 1: the first has ended before it.
        branch: u64,
        /// How many there are.
        of: u64,
    },
    /// Took the light that the layer of fog would have by itself for what lies ahead, instead of what was taken before.
    Layer {
        /// What the path adds to the sum: the difference.
        added: Spectrum,
    },
    /// The surface took the path in.
    Absorbed,
    /// The path has as many edges as `max_depth` allows.
    TooLong,
    /// Russian roulette.
    Roulette {
        /// Probability of going on.
        survival: f32,
        /// Whether it did.
        survived: bool,
    },
}

impl Step {
    /// What the step adds to the path's sum; none for steps that never add.
    #[must_use]
    pub fn added(&self) -> Option<Spectrum> {
        match self {
            Self::Surface { added, .. }
            | Self::Escape { added }
            | Self::Layer { added }
            | Self::Connection { added, .. } => Some(*added),
            _ => None,
        }
    }

    pub(crate) fn surface(hit: &Hit, surface: &Surface, added: Spectrum) -> Self {
        Self::Surface {
            position: surface.point.position,
            normal: surface.normal,
            shading_normal: surface.world_from_shading.z_axis,
            triangle: hit.triangle,
            material: surface.point.material,
            object: surface.point.object,
            scatters: surface.bsdf.is_some(),
            emission: surface.emission,
            added,
        }
    }

    pub(crate) fn collision(
        position: Vec3A,
        [sigma_t, albedo]: [Spectrum; 2],
        scatterer: &Scatterer,
        weights: Weights,
    ) -> Self {
        let Scatterer { row, probability_ratio, .. } = *scatterer;
        Self::Collision { position, sigma_t, albedo, row, probability_ratio, weights }
    }
}

/// What a connection is worth, before it is known whether anything is in between.
pub(crate) struct Offer<'a> {
    pub(crate) light: &'a LightSample,
    pub(crate) value: Spectrum,
    pub(crate) transmittance: Spectrum,
    pub(crate) worth: Spectrum,
    /// Whether it is light that the fog scatters along the first flight, whatever that ends at.
    pub(crate) glow: bool,
}

impl Offer<'_> {
    /// The connection with its outcome.
    pub(crate) fn step(&self, kept: f32, visibility: Visibility) -> Step {
        let added = if visibility == Visibility::Free { self.worth * (1.0 / kept) } else { Spectrum::ZERO };
        Step::Connection {
            direction: self.light.direction,
            distance_m: self.light.distance,
            radiance: self.light.radiance,
            density: self.light.pdf,
            beam: self.light.beam,
            value: self.value,
            transmittance: self.transmittance,
            worth: self.worth,
            kept,
            visibility,
            added,
        }
    }
}
