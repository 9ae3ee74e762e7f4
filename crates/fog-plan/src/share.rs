//! Which frames may share paths.

use serde::Serialize;
use serde_json::json;

use crate::{
    canonical::canonical,
    frame::{FogModel, FrameSpec},
};

/// What frames that share paths may differ in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Share {
    /// The intensities of their light groups.
    Lights,
    /// Those, and the fog; clear air shares with clear air.
    Fog,
}

impl FrameSpec {
    /// A text that is the same for frames that may share paths; none where `render.share` is absent.
    #[must_use]
    pub fn share_key(&self) -> Option<String> {
        let share = self.render.share?;
        let mut lighting = self.lighting.clone();
        lighting.groups.iter_mut().for_each(|group| group.intensity = 1.0);
        let any_fog = share == Share::Fog && self.fog.model != FogModel::None;
        let fog = (!any_fog).then_some(&self.fog);
        let (scene, camera, sensor) = (&self.scene, &self.camera, &self.sensor);
        let (render, outputs) = (&self.render, &self.outputs);
        let motion = (&self.rig, &self.path, &self.readout_end);
        Some(canonical(&json!([scene, camera, motion, sensor, lighting, render, outputs, fog])))
    }
}
