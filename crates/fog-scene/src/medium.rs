//! The fog as the tracer sees it: extinction by altitude, and a phase function.

use crate::phase::{Phase, PhaseNodes, PhaseView};
use fog_core::profile::{ExtinctionProfile, ProfileLanes};
use fog_core::spectrum::{LaneWeights, Wavelengths};

/// A horizontally even layer of fog.
#[derive(Clone, Debug)]
pub struct Medium {
    profile: ExtinctionProfile,
    phase: Phase,
    nodes: PhaseNodes,
}

impl Medium {
    /// A layer with this extinction and phase function.
    #[must_use]
    pub fn new(profile: ExtinctionProfile, phase: Phase) -> Self {
        Self { profile, phase, nodes: PhaseNodes::default() }
    }

    /// True if frames in this fog and others can share paths: its densities can be told at any point, without drawing.
    #[must_use]
    pub fn can_share(&self) -> bool {
        self.phase.has_rows()
    }

    /// Extinction and albedo by altitude.
    #[must_use]
    pub fn profile(&self) -> &ExtinctionProfile {
        &self.profile
    }

    /// Resolves the tables for a loop over paths.
    #[must_use]
    pub fn view(&self) -> MediumView<'_> {
        let phase = self.phase.view(&self.nodes);
        let grey = phase.is_grey() && self.profile.wavelengths_nm().len() == 1;
        MediumView { profile: &self.profile, phase, grey }
    }
}

/// [`Medium`] with its tables resolved to slices.
#[derive(Clone, Copy, Debug)]
pub struct MediumView<'a> {
    /// Extinction and albedo.
    pub profile: &'a ExtinctionProfile,
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
