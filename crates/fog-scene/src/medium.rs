//! The fog as the tracer sees it: extinction by altitude, and a phase function.

use crate::phase::{Phase, PhaseNodes, PhaseView};
use fog_core::Vec3A;
use fog_core::patchiness::{PatchinessError, PatchyField, PatchyFog};
use fog_core::profile::{ExtinctionProfile, ProfileLanes};
use fog_core::spectrum::{LaneWeights, Wavelengths};

/// A layer of fog: horizontally even, or patchy about an even one.
#[derive(Clone, Debug)]
pub struct Medium {
    profile: ExtinctionProfile,
    patches: Option<PatchyField>,
    phase: Phase,
    nodes: PhaseNodes,
}

impl Medium {
    /// An even layer with this extinction and phase function.
    #[must_use]
    pub fn new(profile: ExtinctionProfile, phase: Phase) -> Self {
        Self { profile, patches: None, phase, nodes: PhaseNodes::default() }
    }

    /// The same layer made patchy by a field.
    ///
    /// # Errors
    /// If the top's displacement can leave less than a tenth of the layer's thickness.
    pub fn with_patches(mut self, field: PatchyField) -> Result<Self, PatchinessError> {
        PatchyFog::new(&self.profile, &field)?;
        self.patches = Some(field);
        Ok(self)
    }

    /// The same fog with a share `straight` of its scatterings taken for none ([`Phase::truncated`]); `None` for fog that
    /// cannot be told so: patchy, or of single droplets.
    #[must_use]
    pub fn truncated(&self, straight: f64) -> Option<Self> {
        let phase = self.patches.is_none().then(|| self.phase.truncated(straight))??;
        Some(Self::new(self.profile.thinned(1.0 - straight), phase))
    }

    /// True if frames in this fog and others can share paths: its densities can be told at any point, without drawing,
    /// and by altitude alone.
    #[must_use]
    pub fn can_share(&self) -> bool {
        self.patches.is_none() && self.phase.has_rows()
    }

    /// Extinction and albedo by altitude: of the even layer, where the fog is patchy.
    #[must_use]
    pub fn profile(&self) -> &ExtinctionProfile {
        &self.profile
    }

    /// What makes the layer patchy, if anything.
    #[must_use]
    pub fn patches(&self) -> Option<&PatchyField> {
        self.patches.as_ref()
    }

    /// The phase function by itself.
    #[must_use]
    pub fn phase(&self) -> PhaseView<'_> {
        self.phase.view(&self.nodes)
    }

    /// Optical depths in f64 of a ray (unit direction) up to `t_max` (m) at some wavelengths: what ground truth is made of.
    #[must_use]
    pub fn optical_depths_at<const N: usize>(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f64,
        wavelengths_nm: [f64; N],
    ) -> [f64; N] {
        match self.patchy() {
            Some(patchy) => patchy.optical_depths_at(origin, direction, t_max, wavelengths_nm),
            None => {
                let (y0, dy) = (f64::from(origin.y), f64::from(direction.y));
                wavelengths_nm.map(|nm| self.profile.optical_depth_at(y0, dy, t_max, nm))
            }
        }
    }

    fn patchy(&self) -> Option<PatchyFog<'_>> {
        // The field was checked when it came.
        self.patches.as_ref().and_then(|field| PatchyFog::new(&self.profile, field).ok())
    }

    /// Resolves the tables for a loop over paths.
    #[must_use]
    pub fn view(&self) -> MediumView<'_> {
        let phase = self.phase();
        let grey = phase.is_grey() && self.profile.wavelengths_nm().len() == 1;
        MediumView { profile: &self.profile, patchy: self.patchy(), phase, grey }
    }
}

/// What stands for a fog along paths that have scattered often: light that has lost its direction spreads by extinction times
/// 1 − g alone (the similarity relation; Wyman, Patterson & Wilson, J. Comput. Phys. 81, 1989).
#[derive(Clone, Debug)]
pub struct LateMedium {
    /// The fog that is taken for it.
    pub medium: Medium,
    /// Scatterings after which it is.
    pub after: u32,
}

impl LateMedium {
    /// Share of the scatterings that is taken for none.
    pub const STRAIGHT: f64 = 0.6;
    /// Scatterings before that.
    pub const AFTER: u32 = 8;

    /// For this fog; `None` if it cannot be told ([`Medium::truncated`]).
    #[must_use]
    pub fn similar(medium: &Medium) -> Option<Self> {
        medium.truncated(Self::STRAIGHT).map(|medium| Self { medium, after: Self::AFTER })
    }
}

/// [`Medium`] with its tables resolved to slices.
#[derive(Clone, Copy, Debug)]
pub struct MediumView<'a> {
    /// Extinction and albedo: of the even layer, where the fog is patchy.
    pub profile: &'a ExtinctionProfile,
    /// The patchy layer, where the fog is patchy.
    pub patchy: Option<PatchyFog<'a>>,
    /// Phase function.
    pub phase: PhaseView<'a>,
    /// True if nothing depends on the wavelength.
    pub grey: bool,
}

/// Where a path's wavelengths fall in a medium's tables.
#[derive(Clone, Copy, Debug)]
pub struct MediumLanes {
    /// In the extinction profile.
    pub profile: ProfileLanes,
    /// In the phase function.
    pub phase: LaneWeights,
}

impl MediumView<'_> {
    /// Finds a path's wavelengths in the tables.
    #[must_use]
    pub fn lanes(&self, wavelengths: &Wavelengths) -> MediumLanes {
        MediumLanes { profile: self.profile.lanes(wavelengths), phase: self.phase.lanes(wavelengths) }
    }
}
