//! What a fog is made from beside its own numbers: the advection model, and files.

use std::path::Path;

use crate::{
    droplets::{DropletsSpec, VerticalSpec},
    frame::{FogModel, FogSpec, MeanCosine, Phase},
};

impl FogSpec {
    /// Whether anything of this fog comes from the advection model: its extinction, the profile of its droplets, or a phase
    /// function that names no droplets of its own.
    #[must_use]
    pub fn takes_advection_model(&self) -> bool {
        let phase_of_droplets = match self.phase {
            Phase::Mie | Phase::Hg(MeanCosine::Layer) | Phase::MieMeanDiameter => true,
            Phase::JendersieDeon { diameter_um } => diameter_um.is_none(),
            Phase::Hg(MeanCosine::Value(_)) => false,
        };
        match &self.model {
            FogModel::None => false,
            FogModel::Droplets { vertical, .. } => *vertical == VerticalSpec::Advection,
            _ => phase_of_droplets || self.model.advection_height_m().is_some(),
        }
    }

    /// Files that the fog is read from, as written in the configuration.
    #[must_use]
    pub fn files(&self) -> Vec<&Path> {
        let mut files: Vec<&Path> = self.coefficients.iter().map(AsRef::as_ref).collect();
        match &self.model {
            FogModel::Layered { file, .. } => files.push(file),
            FogModel::Droplets { droplets, vertical, .. } => {
                if let DropletsSpec::File(file) = droplets {
                    files.push(file);
                }
                if let VerticalSpec::File(file) = vertical {
                    files.push(file);
                }
            }
            _ => {}
        }
        files
    }
}

impl FogModel {
    /// Height in metres of the advection model's layer whose extinction or number of droplets the fog takes, in whole or in
    /// part; none if it takes neither.
    #[must_use]
    pub fn advection_height_m(&self) -> Option<f64> {
        let (height_m, taken) = match self {
            Self::None | Self::Layered { .. } => return None,
            Self::Advection { height_m, .. } => (height_m, true),
            Self::Droplets { height_m, vertical, .. } => (height_m, *vertical == VerticalSpec::Advection),
            Self::Homogeneous { height_m, sigma_t_1_m, .. } => (height_m, sigma_t_1_m.is_none()),
            Self::LinearGradient { height_m, sigma_t_base_1_m, sigma_t_top_1_m, .. } => {
                (height_m, sigma_t_base_1_m.is_none() || sigma_t_top_1_m.is_none())
            }
        };
        taken.then_some(*height_m)
    }
}
