//! The aviation record: where an eye is on its approach to a runway, how far it sees, and which of the runway's lights.
//!
//! Everything is computed from positions, intensities and optical depths, nothing is taken from the picture but the luminance of
//! the background. `docs/approach.md` has the definitions and their sources.

mod air;
mod lights;
mod position;
mod segment;
mod site;

pub use air::{Air, DecisionHeight, VisualRange};
pub use lights::{GroupSeen, RunwayLamp};
pub use position::Position;
pub use segment::Segment;
pub use site::RunwaySite;

use crate::error::Error;
use crate::fog::Fog;
use fog_core::DVec3;
use fog_film::Frame;
use fog_optics::visibility::threshold::{self, Threshold};
use fog_plan::FrameSpec;
use fog_scene::LoadedScene;
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;
use fog_tracer::truth::TAU_NM;
use serde::Serialize;

/// Consecutive lights that an operation of CAT II must have in sight at its decision height (AMC1 CAT.OP.MPA.305(e) to
/// Regulation (EU) 965/2012, as the UK CAA publishes it).
const CONSECUTIVE_LIGHTS: usize = 3;

/// What a frame's record says about the approach. Lengths that have no end are infinite here and `null` in JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Aviation {
    /// The runway.
    pub runway: RunwaySite,
    /// Where the eye is.
    pub position: Position,
    /// How far one sees from the runway and from the eye.
    pub visual_range: VisualRange,
    /// The groups of lights that serve this approach, those that the scene has.
    pub lights: Vec<GroupSeen>,
    /// Longest row of lights along the runway's axis that are all seen; absent if none is.
    pub visible_segment: Option<Segment>,
    /// Units of the PAPI that look white and red; absent if none is seen.
    pub papi: Option<[usize; 2]>,
    /// Whether any light of the approach lighting system is seen.
    pub approach_lights_in_sight: bool,
    /// Whether the threshold's markings or any light of the runway itself or its PAPI is seen.
    pub runway_in_sight: bool,
    /// Whether three consecutive lights of approach, touchdown zone, centre line or edge are seen.
    pub three_consecutive_lights: bool,
}

/// Everything about an approach.
///
/// `lamps` are those of the runway with intensities in cd as they shine in the frame, `background_cd_m2` is the luminance that they
/// are seen against (0 to 1e6).
///
/// # Errors
/// If the background's luminance or the air's extinction is out of its range.
pub fn aviation(
    site: &RunwaySite,
    camera: &Camera,
    lamps: &[RunwayLamp],
    air: &Air<'_>,
    background_cd_m2: f64,
) -> Result<Aviation, Error> {
    let threshold = threshold::icao_step(background_cd_m2)?;
    let eye = camera.pose.position.as_dvec3();
    let position = Position::new(site, eye);
    let seen = lights::look(site, camera, lamps, air, &threshold);
    let lights = lights::groups(&seen);
    let peak = |name: &str| lights.iter().find(|g| g.name == name).map_or(0.0, |g| g.peak_cd);
    let visual_range = air::visual_range(
        (site, &position, eye),
        air,
        (background_cd_m2, &threshold),
        [peak("edge"), peak("centre_line")],
    )?;
    let visible_segment = segment::longest(&seen);
    let any = |of: fn(&lights::Kind) -> bool| seen.iter().any(|lamp| lamp.visible && of(&lamp.kind));
    Ok(Aviation {
        runway: site.clone(),
        approach_lights_in_sight: any(lights::Kind::is_approach),
        runway_in_sight: visual_range.threshold_markings_in_sight || any(lights::Kind::is_runway),
        three_consecutive_lights: visible_segment.as_ref().is_some_and(|s| s.lights >= CONSECUTIVE_LIGHTS),
        papi: lights::papi(&seen),
        position,
        visual_range,
        lights,
        visible_segment,
    })
}

/// Sees to it that a runway that the configuration speaks of can be had.
///
/// # Errors
/// If its place is neither in the configuration nor in the scene.
pub(crate) fn check(spec: &FrameSpec, loaded: &LoadedScene) -> Result<(), Error> {
    if spec.runway.is_some() && RunwaySite::new(spec.runway.as_ref(), &loaded.extras).is_none() {
        let text = "runway: the scene does not say where it is (extras.runway of the scene): give threshold_m, heading_deg, \
                    length_m and width_m";
        return Err(Error::Scene(text.to_owned()));
    }
    Ok(())
}

/// The record of a frame; `None` if neither scene nor configuration has a runway.
///
/// # Errors
/// As those of [`aviation`].
pub(crate) fn of_frame(
    spec: &FrameSpec,
    (scene, fog): (&Scene, Option<&Fog>),
    camera: &Camera,
    frame: &Frame,
) -> Result<Option<Aviation>, Error> {
    let Some(site) = RunwaySite::new(spec.runway.as_ref(), &scene.loaded().extras) else { return Ok(None) };
    let tau = |from: DVec3, to: DVec3| {
        let way = to - from;
        let direction = way.normalize_or_zero().as_vec3a();
        scene.optical_depths_at(from.as_vec3a(), direction, way.length(), [TAU_NM])[0]
    };
    let sigma_t =
        |y: f64| fog.map_or(Ok(0.0), |fog| fog.state(fog.altitude_m(y)).map(|state| state.sigma_t_550_1_m));
    // Short of the lamp by a metre: it stands in its own housing.
    let hidden = |from: DVec3, to: DVec3| {
        let way = to - from;
        let reach = (way.length() - 1.0) as f32;
        reach > 0.0 && scene.intersect(from.as_vec3a(), way.normalize().as_vec3a(), reach).is_some()
    };
    let air = Air { tau: &tau, sigma_t_1_m: sigma_t(site.assessment_y())?, hidden: &hidden };
    let lamps = lights::of_scene(scene, spec.lighting.scene_emitters);
    let given = spec.runway.as_ref().and_then(|runway| runway.background_luminance_cd_m2);
    let background = given.unwrap_or_else(|| median_luminance(frame) * spec.lighting.luminance_of_one_cd_m2);
    aviation(&site, camera, &lamps, &air, background.clamp(0.0, 1e6)).map(Some)
}

/// Median luminance of the picture, relative: that of the background, which lamps in it do not change.
fn median_luminance(frame: &Frame) -> f64 {
    let mut all: Vec<f64> =
        (0..frame.pixel_count()).map(|i| frame.luminance(i)).filter(|l| l.is_finite()).collect();
    let middle = all.len() / 2;
    if all.is_empty() { 0.0 } else { *all.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// A visual threshold as it is recorded.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ThresholdUsed {
    /// ICAO's step: `night`, `twilight`, `day` or `bright_day`.
    pub name: &'static str,
    /// Illuminance at the eye from which a light is seen, in lx.
    pub illuminance_lx: f64,
    /// Where it is from.
    pub source: &'static str,
}

impl From<&Threshold> for ThresholdUsed {
    fn from(t: &Threshold) -> Self {
        Self { name: t.name, illuminance_lx: t.illuminance_lx, source: t.source }
    }
}

#[cfg(test)]
mod tests;
