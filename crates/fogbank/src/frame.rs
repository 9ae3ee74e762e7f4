//! One frame: specification → scene → picture and record.

use crate::aviation;
use crate::clear_air;
use crate::denoise;
use crate::error::Error;
use crate::exposure;
use crate::fog::Fog;
use crate::labels;
use crate::lighting::{DistantLights, distant_lights, light_groups};
use crate::objects::objects_json;
use crate::record::record;
use crate::resources::Resources;
use crate::sensor::{self, Chain};
use fog_core::Vec3A;
use fog_core::colour::Observer;
use fog_dataset::{CameraPicture, ClearPicture, DenoisedPicture};
use fog_film::Frame;
use fog_plan::{Allocate, Approximation, CameraSpec, FrameSpec, Output, SensorSpec, StopSpec};
use fog_scene::camera::{Camera, Pose, Shutter};
use fog_scene::scene::Scene;
use fog_tracer::render::Work;
use fog_tracer::settings::{NoiseTarget, Settings, Stop};

/// A rendered frame and its record.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// Films and truth.
    pub frame: Frame,
    /// Everything about the frame, for `<id>.json`; deterministic.
    pub record: serde_json::Value,
    /// Camera of the frame.
    pub camera: Camera,
    /// Factor on the radiance whose product is 1 at white; in the record too.
    pub exposure: f64,
    /// The picture without its noise, if the frame asks for it.
    pub denoised: Option<DenoisedPicture>,
    /// Records of the things in the picture, if the frame asks for them.
    pub objects: Option<serde_json::Value>,
    /// The pictures of the sensor, if the frame has one.
    pub camera_picture: Option<CameraPicture>,
    /// The view in clear air, if the frame asks for it.
    pub clear: Option<ClearPicture>,
    /// Names of the things by number, that of instance i at i − 1, if the frame asks for labels.
    pub instances: Vec<String>,
}

/// Camera of a frame.
#[must_use]
pub fn camera(spec: &FrameSpec) -> Camera {
    camera_at(&spec.sensor, &spec.camera, spec.readout_end.as_ref())
}

/// The same camera at the next pose of its path, for what moves in the image; none where there is none.
#[must_use]
pub fn next_camera(spec: &FrameSpec) -> Option<Camera> {
    let next = spec.path.as_ref()?.next?;
    Some(camera_at(&spec.sensor, &next.camera, next.readout_end.as_ref()))
}

/// Time of the scene in seconds at the next pose of a frame's path, for [`fog_scene::LoadedScene::motion`]; none where there is
/// none.
#[must_use]
pub fn next_scene_time_s(spec: &FrameSpec) -> Option<f64> {
    let path = spec.path.as_ref()?;
    Some(spec.scene.as_ref()?.time_s - path.time_s + path.next?.time_s)
}

fn camera_at(sensor: &SensorSpec, camera: &CameraSpec, readout_end: Option<&CameraSpec>) -> Camera {
    let at = |c: &CameraSpec| pose(c.position_m, [c.heading_deg, c.pitch_deg, c.roll_deg]);
    let pose = at(camera);
    Camera {
        pose,
        width: sensor.width_px,
        height: sensor.height_px,
        lens: sensor.projection,
        shutter: readout_end.map(|end| Shutter::new(pose, at(end))),
    }
}

/// A pose from world position and angles.
pub(crate) fn pose(position_m: [f64; 3], [heading, pitch, roll]: [f64; 3]) -> Pose {
    let [x, y, z] = position_m.map(|v| v as f32);
    Pose::new(Vec3A::new(x, y, z), heading, pitch, roll)
}

/// What the tracer is asked for.
pub(crate) fn settings(spec: &FrameSpec) -> Settings {
    let target =
        |s: StopSpec| Stop::Noise(NoiseTarget { noise: s.noise, max_samples: u64::from(s.max_samples) });
    let budget = spec.render.allocate.map(|Allocate::RelativeError| Stop::Budget);
    Settings {
        samples: u64::from(spec.render.samples),
        stop: spec.render.stop.map(target).or(budget),
        max_depth: spec.render.max_depth,
        wavelength_nm: spec.render.wavelength_nm.map(|nm| nm as f32),
    }
}

/// Scene of a frame, with its fog.
///
/// # Errors
/// If the scene, the fog or the lights cannot be had.
pub fn scene(spec: &FrameSpec, resources: &Resources) -> Result<(Scene, Option<Fog>), Error> {
    let loaded = resources.scene(spec.scene.as_ref())?;
    aviation::check(spec, &loaded)?;
    let fog = Fog::new(&spec.fog, resources)?;
    let DistantLights { environment, sky, sun } = distant_lights(&spec.lighting, resources)?;
    let medium = fog.as_ref().map(|f| f.medium.clone());
    let mut scene = Scene::new(loaded, medium, environment, sun, spec.lighting.scene_emitters)
        .with_luminance_of_one(spec.lighting.luminance_of_one_cd_m2)
        .with_sky(sky);
    if let Some(groups) = light_groups(&spec.lighting) {
        scene = scene.with_light_groups(groups);
    }
    if spec.render.approximation == Some(Approximation::Similarity) {
        scene = scene.with_similar_fog();
    }
    Ok((scene, fog))
}

/// Renders a frame on the current rayon pool. `progress` hears of the paths and may stop the work.
///
/// # Errors
/// If the scene, the fog or a denoiser that it asks for cannot be had, a pixel is not finite, or `progress` asked to stop.
pub fn render_frame(
    spec: &FrameSpec,
    resources: &Resources,
    config_digest: &str,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Result<Rendered, Error> {
    let (scene, fog) = scene(spec, resources)?;
    // Before any work.
    resources.denoiser(spec)?;
    let observer = sensor::observer(spec, resources)?;
    let camera = camera(spec);
    let settings = settings(spec);
    let frame = fog_tracer::render::render(&scene, &camera, &observer, &settings, spec.seed, progress)?
        .ok_or(Error::Cancelled)?;
    finish(spec, resources, (&scene, fog.as_ref()), &observer, frame, config_digest, progress)
}

/// A frame with its record and, if asked for, the pictures of its sensor, its view in clear air and its denoised picture.
///
/// # Errors
/// If it cannot be denoised, clear air cannot be rendered, or `progress` asked to stop.
pub(crate) fn finish(
    spec: &FrameSpec,
    resources: &Resources,
    (scene, fog): (&Scene, Option<&Fog>),
    observer: &Observer,
    mut frame: Frame,
    config_digest: &str,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Result<Rendered, Error> {
    let camera = camera(spec);
    let labels = labels::labels(spec, scene)?;
    frame.truth.surface = labels::surfaces(spec, scene, &camera, labels.as_ref(), resources)?;
    let mut record = record(spec, fog, scene, &camera, &frame, config_digest);
    let exposure = exposure::factor(spec, &frame);
    exposure::write(spec, exposure, &mut record);
    if let Some(aviation) = aviation::of_frame(spec, (scene, fog), &camera, &frame)? {
        record["aviation"] = serde_json::json!(aviation);
    }
    if let Some(hash) = spec.scene.as_ref().and_then(|scene| resources.scene_hash(scene)) {
        record["scene"]["blake3"] = hash.into();
    }
    if let Some(hash) = resources.surroundings().hash(&spec.lighting) {
        record["lighting"]["environment"]["blake3"] = hash.into();
    }
    if let Some(sky) = resources.surroundings().sky(&spec.lighting)? {
        record["lighting"]["sky"]["state"] = sky.state_json().clone();
    }
    let chain = Chain::new(spec, &camera, exposure, observer);
    if let Some(chain) = &chain {
        chain.write(&frame, resources, &mut record);
    }
    let camera_picture = chain.as_ref().map(|chain| chain.pictures(&frame, 0));
    let clear = if clear_air::is_wanted(spec) {
        let clear = clear_air::render_clear(spec, scene, (&camera, observer), &frame, progress)?;
        record["pair"] = clear_air::record_json(spec, &clear);
        Some(clear_air::picture(clear, chain.as_ref(), exposure))
    } else {
        None
    };
    let denoiser = resources.denoiser(spec)?;
    let denoised = denoiser
        .map(|denoiser| denoise::denoised(scene, &camera, &frame, (denoiser, observer)))
        .transpose()?;
    let instances = labels.iter().flat_map(|labels| labels.instances());
    let instances = instances.map(|instance| instance.name.clone()).collect();
    let objects = labels.filter(|_| spec.outputs.contains(&Output::Objects));
    let objects = objects
        .map(|labels| objects_json(spec, scene, &camera, &labels, &frame, clear.as_ref().map(|c| &c.frame)));
    Ok(Rendered { frame, record, camera, exposure, denoised, objects, camera_picture, clear, instances })
}
