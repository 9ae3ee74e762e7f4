//! Choosing a light for next-event estimation.
//!
//! A sky is among them where its light is concentrated. The uniform environment is not: to connect to a light that shines
//! alike from everywhere one would draw the direction from the phase function or the BSDF, and that is what continuing the
//! path does.

mod haze;

use self::haze::Haze;
use crate::path::Lanes;
use fog_core::Vec3A;
use fog_core::colour::upsample;
use fog_core::random::PathRng;
use fog_core::spectrum::Spectrum;
use fog_scene::Hit;
use fog_scene::emitters::Breadth;
use fog_scene::light_groups::LightSource;
use fog_scene::light_tree::Receiver;
use fog_scene::scene::Scene;

/// Evenness of a sky ([`fog_scene::sky_map::SkyMap::evenness`]) from which on it is not aimed at, as the uniform environment
/// is not. Skies of clear air and overcast ones are more even than that: in the street under them, aiming at them with a share
/// of 0.3 takes 1.2 to 1.6 times as long, in fog and in clear air, and is no less noisy.
const EVEN_SKY: f32 = 0.2;
/// Distance at which the strongest lamp says what light of lamps is faint, in metres.
const LAMP_LEVEL_M: f32 = 100.0;

/// Probabilities of aiming at the sun, the sky, the emitters, the lamps and the beams; what they leave is no connection at all.
#[derive(Clone, Debug)]
pub(crate) struct LightMix {
    sun: f32,
    sky: f32,
    compact: f32,
    broad: f32,
    /// What the fog leaves of broad emitters' light, by altitude.
    haze: Haze,
    lamps: f32,
    beams: f32,
    shadow_scale: f32,
}

/// A light seen from a point.
pub(crate) struct LightSample {
    pub(crate) direction: Vec3A,
    pub(crate) distance: f32,
    /// Relative radiance; irradiance of a light without extent, across its direction.
    pub(crate) radiance: Spectrum,
    /// Density in 1/sr including the choice of the light; the probability of the choice for a light without extent.
    pub(crate) pdf: f32,
    pub(crate) beam: bool,
    pub(crate) source: LightSource,
}

impl LightSample {
    /// Index of the lamp, if it is one.
    #[inline]
    pub(crate) fn lamp(&self) -> Option<usize> {
        if let LightSource::Lamp(lamp) = self.source { Some(lamp) } else { None }
    }

    /// Density of light sampling plus that of running into the light by chance (`scattering`, 1/sr).
    #[inline]
    pub(crate) fn density(&self, scattering: Spectrum) -> Spectrum {
        let own = Spectrum::splat(self.pdf);
        if self.beam { own } else { own + scattering }
    }
}

impl LightMix {
    pub(crate) fn new(scene: &Scene) -> Self {
        let uneven = scene.sky.as_ref().map_or(0.0, |sky| (1.0 - sky.evenness() / EVEN_SKY).max(0.0));
        let (sun, sky) = (scene.sun.is_some(), uneven > 0.0);
        let [compact, broad] = [Breadth::Compact, Breadth::Broad].map(|b| scene.emitters().has(b));
        let (lamps, beams) = (!scene.lamps().lights().is_empty(), !scene.beams().is_empty());
        let kinds = [sun, sky, compact, broad, lamps, beams].map(|there| if there { 1.0 } else { 0.0 });
        let share = 1.0 / kinds.iter().sum::<f32>().max(1.0);
        // Contributions below a fraction of what the scene's lights give are played for (expected value unchanged).
        let sun_level = scene.sun.map_or(0.0, |s| s.irradiance / core::f32::consts::PI);
        let strongest = |values: &mut dyn Iterator<Item = f32>| values.fold(0.0f32, f32::max);
        let lamp_level = strongest(&mut scene.lamps().lights().iter().map(|l| l.strength()))
            / (LAMP_LEVEL_M * LAMP_LEVEL_M * core::f32::consts::PI);
        let beam_level = strongest(&mut scene.beams().iter().map(|b| b.strength())) / core::f32::consts::PI;
        let sky_level = scene.sky.as_ref().map_or(0.0, |sky| sky.mean());
        let emitter_level = if compact || broad { 0.1 } else { 0.0 };
        let level = sun_level.max(sky_level).max(emitter_level).max(lamp_level).max(beam_level);
        Self {
            sun: if sun { share } else { 0.0 },
            sky: share * uneven,
            compact: if compact { share } else { 0.0 },
            broad: if broad { share } else { 0.0 },
            haze: Haze::new(scene),
            lamps: if lamps { share } else { 0.0 },
            beams: if beams { share } else { 0.0 },
            shadow_scale: if level > 0.0 { 1.0 / (0.02 * level) } else { 1.0 },
        }
    }

    #[inline]
    pub(crate) fn any(&self) -> bool {
        self.sun + self.sky + self.compact + self.broad + self.lamps + self.beams > 0.0
    }

    #[inline]
    pub(crate) fn sun_probability(&self) -> f32 {
        self.sun
    }

    #[inline]
    pub(crate) fn sky_probability(&self) -> f32 {
        self.sky
    }

    /// Probability of aiming at emitters of this breadth.
    #[inline]
    fn emitters(&self, scene: &Scene, breadth: Breadth, from: Vec3A) -> f32 {
        let aim = || scene.emitters().aim(breadth, from);
        match breadth {
            Breadth::Compact => self.compact,
            Breadth::Broad if self.broad == 0.0 => 0.0,
            // Nearly all of them in a street: looked up first.
            Breadth::Broad => match aim() {
                0.0 => 0.0,
                aim => self.broad * aim * self.haze.at(from.y),
            },
        }
    }

    /// Density in 1/sr with which [`LightMix::sample`] finds, from the start of a ray, the emitting point that the ray hits
    /// under this cosine.
    #[inline]
    pub(crate) fn emitter_pdf(&self, scene: &Scene, from: Vec3A, hit: &Hit, cos: f32) -> f32 {
        let emitters = scene.emitters();
        let aimed = self.emitters(scene, emitters.breadth(hit.triangle), from);
        if aimed == 0.0 || cos <= 0.0 {
            return 0.0;
        }
        aimed * emitters.pdf_area(hit, from) * hit.t * hit.t / cos
    }

    /// Probability of aiming at any lamp.
    #[inline]
    pub(crate) fn lamp_probability(&self) -> f32 {
        self.lamps
    }

    /// Reciprocal of the contribution from which on a shadow ray is always traced.
    #[inline]
    pub(crate) fn shadow_scale(&self) -> f32 {
        self.shadow_scale
    }

    /// Draws a light and a direction to it; `None` if there is none to be seen from here.
    #[inline]
    pub(crate) fn sample(
        &self,
        scene: &Scene,
        from: Vec3A,
        lanes: &Lanes,
        rng: &mut PathRng,
    ) -> Option<LightSample> {
        if !self.any() {
            return None;
        }
        let pick = rng.uniform();
        if let Some(sun) = scene.sun.as_ref().filter(|_| pick < self.sun) {
            let beam = sun.is_beam();
            let value = if beam { sun.irradiance } else { sun.radiance() };
            return Some(LightSample {
                direction: sun.sample(rng.uniform2()),
                distance: f32::INFINITY,
                radiance: lanes.sun * value,
                pdf: if beam { self.sun } else { self.sun * sun.pdf() },
                beam,
                source: LightSource::Sun,
            });
        }
        let mut pick = pick - self.sun;
        if let Some(sky) = scene.sky.as_ref().filter(|_| pick < self.sky) {
            let sample = sky.sample([rng.uniform_f64(), rng.uniform_f64()], lanes.sky());
            return Some(LightSample {
                direction: sample.direction,
                distance: f32::INFINITY,
                radiance: sample.radiance,
                pdf: self.sky * sample.pdf,
                beam: false,
                source: LightSource::Environment,
            });
        }
        pick -= self.sky;
        for breadth in [Breadth::Compact, Breadth::Broad] {
            let share = self.emitters(scene, breadth, from);
            if pick < share {
                return emitter_light(scene, breadth, from, share, &lanes.basis, rng);
            }
            pick -= share;
        }
        self.without_extent(scene, from, pick, &lanes.basis, rng)
    }

    /// Draws a lamp or a beam; `pick` is what remains of the choice of its kind.
    fn without_extent(
        &self,
        scene: &Scene,
        from: Vec3A,
        pick: f32,
        basis: &[Spectrum; 3],
        rng: &mut PathRng,
    ) -> Option<LightSample> {
        if pick < self.lamps {
            let (lamp, probability) = scene.lamps().choose(&Receiver::Point(from), rng.uniform_f64())?;
            return lamp_light(scene, lamp, from, self.lamps * probability, basis);
        }
        let count = scene.beams().len();
        if pick >= self.lamps + self.beams || count == 0 {
            return None;
        }
        let index = ((rng.uniform() * count as f32) as usize).min(count - 1);
        let beam = &scene.beams()[index];
        Some(LightSample {
            direction: beam.direction,
            distance: f32::INFINITY,
            radiance: upsample(beam.illuminance, basis),
            pdf: self.beams / count as f32,
            beam: true,
            source: LightSource::Beam(index),
        })
    }
}

/// A point of an emitter of this breadth, which is drawn with `probability`, seen from a point; `None` if none is lit.
fn emitter_light(
    scene: &Scene,
    breadth: Breadth,
    from: Vec3A,
    probability: f32,
    basis: &[Spectrum; 3],
    rng: &mut PathRng,
) -> Option<LightSample> {
    let point = scene.emitters().sample(breadth, from, rng.uniform_f64(), rng.uniform2())?;
    let offset = point.position - from;
    let distance = offset.length();
    let direction = offset / distance;
    let [u, v] = point.barycentric;
    let (rgb, normal) =
        scene.emission_towards(&Hit { t: distance, triangle: point.triangle, u, v }, direction);
    let cos = normal.dot(direction).abs();
    if rgb == [0.0; 3] || cos <= 0.0 || distance <= 0.0 {
        return None;
    }
    Some(LightSample {
        direction,
        distance,
        radiance: upsample(rgb, basis),
        pdf: probability * point.pdf_area * distance * distance / cos,
        beam: false,
        source: LightSource::Emitter(point.triangle),
    })
}

/// A lamp seen from a point, found with this probability; `None` where it does not shine.
pub(crate) fn lamp_light(
    scene: &Scene,
    index: usize,
    from: Vec3A,
    probability: f32,
    basis: &[Spectrum; 3],
) -> Option<LightSample> {
    let lamp = &scene.lamps().lights()[index];
    let offset = lamp.position - from;
    let distance = offset.length();
    let direction = offset / distance;
    let falloff = lamp.falloff(-direction);
    let share = falloff / (distance * distance);
    // Also false for the lamp's own place, where no direction leads to it.
    (falloff > 0.0 && share.is_finite()).then(|| LightSample {
        direction,
        distance,
        radiance: upsample(lamp.intensity, basis) * share,
        pdf: probability,
        beam: true,
        source: LightSource::Lamp(index),
    })
}
