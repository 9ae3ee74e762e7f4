//! Directions after a scattering in the fog.
//!
//! Half of what a droplet scatters stays within a degree of forward, so light of the sun reaches a path mostly where the
//! path happens to point almost at the sun: rare, and bright when it happens. Where the sun's beam is still strong, a share
//! of the directions is therefore drawn from the phase function *around the sun* instead of around the path; both are one
//! mixture density, which bounds what a connection to the sun at the next vertex can weigh.

use fog_core::random::PathRng;
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, math, warp};
use fog_scene::phase::{PhaseView, Scatterer};

/// Share of directions drawn around the sun by paths that travel elsewhere; times the root of the beam's transmittance, so
/// that the many scatterings in the dark depth of a layer are left alone.
const FAR_SHARE: f32 = 0.1;
/// The same for paths that already travel towards the sun, for which both parts of the mixture are nearly one; times the
/// fourth root, for they are about to fly to where the beam is strong.
const NEAR_SHARE: f32 = 0.5;
/// 1 − cos of the angle to the sun at which half of the way from one to the other is gone: 10°.
const NEAR_M: f32 = 0.015;

/// The mixture of one scattering.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FogLobe<'a> {
    phase: &'a PhaseView<'a>,
    scatterer: &'a Scatterer,
    before: Vec3A,
    sun: Vec3A,
    sun_share: f32,
}

/// Phase function and sampling density of one direction, in 1/sr at all lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LobeValue {
    pub(crate) phase: Spectrum,
    pub(crate) density: Spectrum,
}

/// Share of directions drawn around the sun by a path along `before`, where the beam has this transmittance.
#[inline]
pub(crate) fn sun_share(before: Vec3A, sun: Vec3A, transmittance: f32) -> f32 {
    let root = transmittance.sqrt();
    let near = 1.0 / (1.0 + 0.5 * (sun - before).length_squared() / NEAR_M);
    FAR_SHARE * root * (1.0 - near) + NEAR_SHARE * root.sqrt() * near
}

impl<'a> FogLobe<'a> {
    /// Scattering of a path that travelled along `before`, by `scatterer`. `sun` is the direction to the sun and its beam's
    /// transmittance to here, which must not depend on the path's wavelengths.
    #[inline]
    pub(crate) fn new(
        phase: &'a PhaseView<'a>,
        scatterer: &'a Scatterer,
        before: Vec3A,
        sun: Option<(Vec3A, f32)>,
    ) -> Self {
        let (sun, transmittance) = sun.unwrap_or((before, 0.0));
        Self { phase, scatterer, before, sun, sun_share: sun_share(before, sun, transmittance) }
    }

    /// Value and density for a direction of travel after the scattering.
    #[inline]
    pub(crate) fn value(&self, after: Vec3A) -> LobeValue {
        self.mix(self.at(0.5 * (after - self.before).length_squared()), after)
    }

    #[inline]
    fn at(&self, m: f32) -> Spectrum {
        self.phase.eval(self.scatterer.row, m, &self.scatterer.lanes)
    }

    #[inline]
    fn mix(&self, phase: Spectrum, after: Vec3A) -> LobeValue {
        if self.sun_share == 0.0 {
            return LobeValue { phase, density: phase };
        }
        let around_sun = self.at(0.5 * (after - self.sun).length_squared());
        LobeValue { phase, density: phase * (1.0 - self.sun_share) + around_sun * self.sun_share }
    }

    /// Draws a direction at the hero's wavelength.
    #[inline]
    pub(crate) fn sample(&self, rng: &mut PathRng) -> (Vec3A, LobeValue) {
        let towards_sun = self.sun_share > 0.0 && rng.uniform() < self.sun_share;
        let axis = if towards_sun { self.sun } else { self.before };
        let (u, turn) = rng.turn();
        let m = self.phase.sample(self.scatterer.row, &self.scatterer.lanes, u, rng.uniform());
        let (sin_phi, cos_phi) = math::sin_cos_turns(turn);
        let sin = (m * (2.0 - m)).max(0.0).sqrt();
        let local = Vec3A::new(sin * cos_phi, sin * sin_phi, 1.0 - m);
        let after = (warp::frame(axis) * local).normalize();
        let value = if towards_sun { self.value(after) } else { self.mix(self.at(m), after) };
        (after, value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::phase::HenyeyGreenstein;
    use fog_core::spectrum::Wavelengths;
    use fog_scene::phase::{Phase, PhaseNodes};

    /// Cells along the axis and around it, and midpoints of the quadrature in each.
    const ROWS: usize = 16;
    const COLUMNS: usize = 12;
    const FINE: usize = 12;
    const SAMPLES: u64 = 400_000;

    #[test]
    fn directions_follow_their_density() {
        let phase = Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.5).expect("g"));
        let (nodes, wavelengths) = (PhaseNodes::default(), Wavelengths::monochromatic(550.0));
        let view = phase.view(&nodes);
        let mut rng = PathRng::new(61, 0, 0);
        let scatterer = view.scatterer(0.5, &view.lanes(&wavelengths), &mut rng);
        let before = Vec3A::new(0.3, -0.5, 0.8).normalize();
        let aside = Vec3A::new(-0.4, 0.9, 0.1).normalize();
        let near = (before + 0.05 * aside).normalize();
        for sun in [None, Some((aside, 1.0)), Some((near, 0.8)), Some((aside, 0.01))] {
            let lobe = FogLobe::new(&view, &scatterer, before, sun);
            let local = warp::frame(before).transpose();
            let cell = |w: Vec3A| {
                let row = ((0.5 * (1.0 - w.z) * ROWS as f32) as usize).min(ROWS - 1);
                let turn = math::f32::atan2(w.y, w.x) / math::TAU_F32 + 0.5;
                row * COLUMNS + ((turn * COLUMNS as f32) as usize).min(COLUMNS - 1)
            };
            let mut expected = vec![0.0; ROWS * COLUMNS];
            let (rows, columns) = (ROWS * FINE, COLUMNS * FINE);
            for i in 0..rows {
                let z = 1.0 - 2.0 * (i as f32 + 0.5) / rows as f32;
                for j in 0..columns {
                    let phi = ((j as f32 + 0.5) / columns as f32 - 0.5) * math::TAU_F32;
                    let w = warp::spherical(z, (1.0 - z * z).sqrt(), phi);
                    let density = f64::from(lobe.value(local.transpose() * w).density[0]);
                    expected[cell(w)] += density * 2.0 * math::TAU / (rows * columns) as f64 * SAMPLES as f64;
                }
            }
            let total = expected.iter().sum::<f64>() / SAMPLES as f64;
            assert!((total - 1.0).abs() < 2e-4, "{sun:?}: the density integrates to {total}");
            let mut observed = vec![0u64; expected.len()];
            for _ in 0..SAMPLES {
                let (after, value) = lobe.sample(&mut rng);
                let again = lobe.value(after).density[0];
                assert!((value.density[0] / again - 1.0).abs() < 1e-3, "{} for {again}", value.density[0]);
                observed[cell(local * after)] += 1;
            }
            // Chi-square has a mean of its degrees of freedom, and a variance of twice as many.
            let off = |(&o, &e): (&u64, &f64)| (o as f64 - e).powi(2) / e;
            let chi_square: f64 = observed.iter().zip(&expected).map(off).sum();
            let freedom = (ROWS * COLUMNS - 1) as f64;
            assert!(chi_square < freedom + 5.0 * (2.0 * freedom).sqrt(), "{sun:?}: {chi_square}");
        }
    }
}
