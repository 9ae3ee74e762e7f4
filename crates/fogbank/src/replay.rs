//! One path of a frame again, for people.

mod json;
mod words;

use crate::error::Error;
use crate::frame::{camera, scene, settings};
use crate::progress::Progress;
use crate::resources::Resources;
use crate::selection::one_frame;
use crate::shared::share_sets;
use fog_core::spectrum::Spectrum;
use fog_plan::{FrameSpec, Plan};
use fog_scene::scene::Scene;
use fog_tracer::path::PathTracer;
use fog_tracer::replay::Replay;
use fog_tracer::settings::MOST_OF_BUDGET;

/// A path with the frame that it belongs to; displays as a story, a step per paragraph.
#[derive(Clone, Debug)]
pub struct Replayed {
    spec: FrameSpec,
    scene: Scene,
    pixel: [u32; 2],
    number: u64,
    path: Replay,
}

/// Traces sample `number` of a pixel (column, row) of the selected frame again, as rendering does.
///
/// # Errors
/// If the plan has several frames and none is selected, the frame has no such pixel or sample, or the scene or the fog
/// cannot be had.
pub fn replay(
    plan: &Plan,
    frame: Option<&str>,
    pixel: [u32; 2],
    number: u64,
    resources: &mut Resources,
    progress: &dyn Progress,
) -> Result<Replayed, Error> {
    let (frames, index) = one_frame(plan, frame)?;
    let spec = frames[index].clone();
    let ([x, y], [width, height]) = (pixel, [spec.sensor.width_px, spec.sensor.height_px]);
    if x >= width || y >= height {
        let range = format!("columns go from 0 to {}, rows from 0 to {}", width - 1, height - 1);
        return Err(Error::UnknownPath(format!("the frame has no pixel {x},{y}: {range}")));
    }
    let most = if spec.render.allocate.is_some() { MOST_OF_BUDGET } else { 1 };
    let count = spec.render.stop.map_or(spec.render.samples, |stop| stop.max_samples);
    let count = u64::from(count) * most;
    if number >= count {
        let range = format!("its pixels have {count} at most, counted from 0");
        return Err(Error::UnknownPath(format!("the frame has no sample {number}: {range}")));
    }
    if share_sets(&frames).iter().any(|set| set.len() > 1 && set.contains(&index)) {
        let text =
            format!("frame {} shares its paths with others (render.share): they cannot be replayed", spec.id);
        return Err(Error::UnknownPath(text));
    }
    resources.prepare(&spec, progress);
    let (scene, _) = scene(&spec, resources)?;
    let camera = camera(&spec);
    let tracer = PathTracer::new(&scene, &resources.observer, settings(&spec));
    let i = y as usize * width as usize + x as usize;
    let unseen = || Error::UnknownPath(format!("the lens sees nothing at pixel {x},{y}, sample {number}"));
    let path = tracer.replay(&camera, i, spec.seed, number).ok_or_else(unseen)?;
    Ok(Replayed { spec, scene, pixel, number, path })
}

impl Replayed {
    /// Linear sRGB of a radiance at the path's wavelengths; of a frame of one wavelength the radiance there.
    fn value(&self, radiance: &Spectrum) -> Vec<f32> {
        let Some(response) = &self.path.response else { return vec![radiance[0]] };
        let sum = |c: usize| response.iter().zip(radiance.0).map(|(rgb, v)| rgb[c] * v).sum();
        (0..3).map(sum).collect()
    }

    /// The channels that the frame has: three, or one.
    fn channels<'a>(&self, value: &'a [f32; 3]) -> &'a [f32] {
        let used = if self.path.response.is_some() { 3 } else { 1 };
        &value[..used]
    }

    fn material(&self, index: u32) -> &str {
        self.scene.loaded().materials.get(index as usize).map_or("", |m| &m.name)
    }

    fn object(&self, index: u32) -> &str {
        self.scene.loaded().objects.get(index as usize).map_or("", |o| &o.name)
    }

    /// Height above the fog's datum in metres.
    fn altitude_m(&self, y: f64) -> f64 {
        y - self.spec.fog.datum_m
    }
}
