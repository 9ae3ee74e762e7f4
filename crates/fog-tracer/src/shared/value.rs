//! What a fog does to a path, at all of its wavelengths or, where nothing depends on them, as one number.

use fog_core::math;
use fog_core::profile::ExtinctionProfile;
use fog_core::spectrum::Spectrum;
use fog_scene::medium::{MediumLanes, MediumView};
use fog_scene::phase::PhaseRows;

/// Largest exponent that weights are changed by in one step: what differs by more is as good as impossible in one fog.
const LARGEST_EXPONENT: f32 = 60.0;

/// A factor of a path's weights in one fog.
pub(super) trait Value: Copy {
    const ZERO: Self;
    const ONE: Self;
    /// Of the wavelength that the path is drawn at.
    fn hero(self) -> f32;
    /// Over the wavelengths.
    fn mean(self) -> f32;
    fn times(self, other: Self) -> Self;
    fn plus(self, other: Self) -> Self;
    fn scaled(self, k: f32) -> Self;
    /// exp(`offset` − x).
    fn exp_neg(self, offset: f32) -> Self;
    /// The light of `light` weighted by this.
    fn weigh(self, light: Spectrum) -> Spectrum;
    /// Optical depth of a ray from height `y` on that rises by `dy` per metre.
    fn depth(profile: &ExtinctionProfile, ray: [f64; 2], length: f64, lanes: &MediumLanes) -> Self;
    /// σ_t in 1/m at a height in the layer.
    fn sigma_t(profile: &ExtinctionProfile, y: f64, lanes: &MediumLanes) -> Self;
    /// Scattering over extinction at a height in the layer.
    fn albedo(profile: &ExtinctionProfile, y: f64, lanes: &MediumLanes) -> Self;
    /// Phase function in 1/sr.
    fn phase(medium: &MediumView<'_>, rows: PhaseRows, m: f32, lanes: &MediumLanes) -> Self;
}

fn bounded(exponent: f32) -> f32 {
    exponent.clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT)
}

impl Value for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;

    #[inline(always)]
    fn hero(self) -> f32 {
        self
    }

    #[inline(always)]
    fn mean(self) -> f32 {
        self
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn scaled(self, k: f32) -> Self {
        self * k
    }

    #[inline(always)]
    fn exp_neg(self, offset: f32) -> Self {
        math::fast_exp(bounded(offset - self))
    }

    #[inline(always)]
    fn weigh(self, light: Spectrum) -> Spectrum {
        light * self
    }

    #[inline(always)]
    fn depth(profile: &ExtinctionProfile, [y, dy]: [f64; 2], length: f64, lanes: &MediumLanes) -> Self {
        profile.optical_depth_of_hero(y, dy, length, &lanes.profile) as f32
    }

    #[inline(always)]
    fn sigma_t(profile: &ExtinctionProfile, y: f64, lanes: &MediumLanes) -> Self {
        profile.sigma_t_of_hero(y, &lanes.profile) as f32
    }

    #[inline(always)]
    fn albedo(profile: &ExtinctionProfile, y: f64, lanes: &MediumLanes) -> Self {
        profile.albedo(y, &lanes.profile)[0]
    }

    #[inline(always)]
    fn phase(medium: &MediumView<'_>, rows: PhaseRows, m: f32, lanes: &MediumLanes) -> Self {
        medium.phase.eval_between(rows, m, &lanes.phase)[0]
    }
}

impl Value for Spectrum {
    const ZERO: Self = Self::ZERO;
    const ONE: Self = Self::ONE;

    #[inline(always)]
    fn hero(self) -> f32 {
        self[0]
    }

    #[inline(always)]
    fn mean(self) -> f32 {
        Self::mean(self)
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn scaled(self, k: f32) -> Self {
        self * k
    }

    #[inline(always)]
    fn exp_neg(self, offset: f32) -> Self {
        self.map(|x| math::fast_exp(bounded(offset - x)))
    }

    #[inline(always)]
    fn weigh(self, light: Spectrum) -> Spectrum {
        light * self
    }

    #[inline(always)]
    fn depth(profile: &ExtinctionProfile, [y, dy]: [f64; 2], length: f64, lanes: &MediumLanes) -> Self {
        profile.optical_depth(y, dy, length, &lanes.profile)
    }

    #[inline(always)]
    fn sigma_t(profile: &ExtinctionProfile, y: f64, lanes: &MediumLanes) -> Self {
        profile.sigma_t(y, &lanes.profile)
    }

    #[inline(always)]
    fn albedo(profile: &ExtinctionProfile, y: f64, lanes: &MediumLanes) -> Self {
        profile.albedo(y, &lanes.profile)
    }

    #[inline(always)]
    fn phase(medium: &MediumView<'_>, rows: PhaseRows, m: f32, lanes: &MediumLanes) -> Self {
        medium.phase.eval_between(rows, m, &lanes.phase)
    }
}
