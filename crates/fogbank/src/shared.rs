//! Frames that share paths (`render.share`).

use crate::error::Error;
use crate::fog::Fog;
use crate::frame::{self, Rendered, finish, settings};
use crate::resources::Resources;
use crate::sensor;
use fog_plan::{FogSpec, FrameSpec};
use fog_scene::medium::Medium;
use fog_scene::scene::Scene;
use fog_tracer::render::Work;
use fog_tracer::render_shared::{MAX_FOGS, Variant, render_shared};
use serde_json::json;
use std::collections::HashMap;

/// Most pixels of the frames of a set together: the sums of all of them are kept at once.
const MOST_PIXELS: u64 = 1 << 24;

/// A frame's scene and fog, or why they cannot be had.
type Made = Result<(Scene, Option<Fog>), Error>;

/// Sets of frames that share paths, as indices in order. A frame that shares with no other is a set of its own.
///
/// The sets are a function of the whole plan, whichever of its frames are rendered: a frame's bytes depend on its set. A set
/// has at most 8 fogs and 16.8 million pixels.
#[must_use]
pub fn share_sets(frames: &[FrameSpec]) -> Vec<Vec<usize>> {
    let mut sets: Vec<Vec<usize>> = Vec::new();
    // By what its frames have in common, the set that still takes some, and its fogs.
    let mut open: HashMap<String, (usize, Vec<&FogSpec>)> = HashMap::new();
    for (i, frame) in frames.iter().enumerate() {
        let pixels = u64::from(frame.sensor.width_px) * u64::from(frame.sensor.height_px);
        let key = frame.share_key();
        if let Some((set, fogs)) = key.as_ref().and_then(|key| open.get_mut(key)) {
            let new_fog = !fogs.contains(&&frame.fog);
            let room = (sets[*set].len() as u64 + 1) * pixels <= MOST_PIXELS;
            if room && !(new_fog && fogs.len() == MAX_FOGS) {
                if new_fog {
                    fogs.push(&frame.fog);
                }
                sets[*set].push(i);
                continue;
            }
        }
        if let Some(key) = key {
            open.insert(key, (sets.len(), vec![&frame.fog]));
        }
        sets.push(vec![i]);
    }
    sets
}

/// Renders the frames of a set on the current rayon pool; each may fail for itself, and one that cannot be put together leaves
/// the set. `progress` hears of samples times frames.
///
/// Frames of several fogs are traced fog by fog where paths cannot be shared between fogs: among lamps, whose halos need
/// points by the distance from them, and in fog of single droplets.
///
/// # Errors
/// If `progress` asked to stop.
pub(crate) fn render_set(
    set: &[&FrameSpec],
    resources: &Resources,
    config_digest: &str,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Result<Vec<Result<Rendered, Error>>, Error> {
    let made: Vec<Made> = set.iter().map(|spec| frame::scene(spec, resources)).collect();
    let members: Vec<usize> = (0..set.len()).filter(|&i| made[i].is_ok()).collect();
    let can_share = |i: &usize| {
        made[*i].as_ref().is_ok_and(|(scene, _)| {
            scene.lamps().lights().is_empty() && scene.medium.as_ref().is_none_or(Medium::can_share)
        })
    };
    let mut passes: Vec<Vec<usize>> = Vec::new();
    if members.iter().all(can_share) {
        passes.push(members);
    } else {
        for i in members {
            match passes.iter_mut().find(|pass| set[pass[0]].fog == set[i].fog) {
                Some(pass) => pass.push(i),
                None => passes.push(vec![i]),
            }
        }
    }
    let mut out: Vec<Option<Result<Rendered, Error>>> = set.iter().map(|_| None).collect();
    for pass in passes.iter().filter(|pass| !pass.is_empty()) {
        let frames = one_pass(set, pass, &made, resources, config_digest, progress)?;
        for (&i, frame) in pass.iter().zip(frames) {
            out[i] = Some(frame);
        }
    }
    let failed = |(frame, made): (Option<Result<Rendered, Error>>, Made)| match (frame, made) {
        (Some(frame), _) => frame,
        (None, made) => Err(made.err().unwrap_or(Error::Cancelled)),
    };
    Ok(out.into_iter().zip(made).map(failed).collect())
}

/// Renders frames from common paths.
fn one_pass(
    set: &[&FrameSpec],
    pass: &[usize],
    made: &[Made],
    resources: &Resources,
    config_digest: &str,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Result<Vec<Result<Rendered, Error>>, Error> {
    let mut fogs: Vec<&FogSpec> = Vec::new();
    let mut media: Vec<Medium> = Vec::new();
    for &i in pass.iter().filter(|&&i| set[i].fog.model != fog_plan::FogModel::None) {
        if !fogs.contains(&&set[i].fog) {
            fogs.push(&set[i].fog);
            media.extend(made[i].as_ref().ok().and_then(|(scene, _)| scene.medium.clone()));
        }
    }
    // Lights are as bright as in the mean over the frames, so that each is aimed at as often as the frames need it.
    let mut base = set[pass[0]].clone();
    let count = pass.len() as f64;
    for (g, group) in base.lighting.groups.iter_mut().enumerate() {
        group.intensity = pass.iter().map(|&i| set[i].lighting.groups[g].intensity).sum::<f64>() / count;
    }
    let variant = |&i: &usize| {
        let groups = set[i].lighting.groups.iter().zip(&base.lighting.groups);
        let factor = |own: f64, mean: f64| if mean > 0.0 { (own / mean) as f32 } else { 0.0 };
        let factors = groups.map(|(own, mean)| factor(own.intensity, mean.intensity)).collect();
        Variant { fog: fogs.iter().position(|&fog| *fog == set[i].fog).unwrap_or(0), factors }
    };
    let variants: Vec<Variant> = pass.iter().map(variant).collect();
    let (scene, _) = frame::scene(&base, resources)?;
    let camera = frame::camera(&base);
    let observer = sensor::observer(&base, resources)?;
    let (settings, view) = (settings(&base), (&camera, &*observer));
    let frames = render_shared(&scene, &media, &variants, view, &settings, base.seed, progress);
    let ids: Vec<&str> = pass.iter().map(|&i| set[i].id.as_str()).collect();
    let share = json!({ "frames": ids, "fogs": fogs.len(), "seed": base.seed });
    let done = |(&i, frame): (&usize, Result<_, fog_film::FrameError>)| {
        let (scene, fog) = made[i].as_ref().map_err(|_| Error::Cancelled)?;
        let own = (scene, fog.as_ref());
        let mut rendered = finish(set[i], resources, own, &observer, frame?, config_digest, progress)?;
        rendered.record["share"] = share.clone();
        Ok(rendered)
    };
    Ok(pass.iter().zip(frames.ok_or(Error::Cancelled)?).map(done).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sets(lines: &str) -> Vec<Vec<usize>> {
        let yaml = format!(
            "version: 1\nname: t\nscene: none\nfog: {{model: advection, height_m: 100}}\n\
             lighting: {{environment: {{radiance: 1}}, groups: [{{name: sky, lights: [environment]}}]}}\n{lines}"
        );
        let plan = fog_plan::parse(&yaml, "t.yaml", &[]).expect("valid plan");
        share_sets(&plan.frames().map(|frame| frame.expect("frame")).collect::<Vec<_>>())
    }

    #[test]
    fn sets_are_of_frames_that_differ_in_what_is_shared() {
        let sweep = "sweep: {axes: {camera.altitude_m: [2, 5], fog.height_m: [100, 120], \
                     lighting.groups.0.intensity: [1, 2]}}\n";
        assert_eq!(sets(sweep).len(), 8);
        let lights = [vec![0, 1], vec![2, 3], vec![4, 5], vec![6, 7]];
        assert_eq!(sets(&format!("render: {{share: lights}}\n{sweep}")), lights);
        let fog = [vec![0, 1, 2, 3], vec![4, 5, 6, 7]];
        assert_eq!(sets(&format!("render: {{share: fog}}\n{sweep}")), fog);
    }

    #[test]
    fn sets_have_bounds_and_clear_air_is_apart() {
        let many = "render: {share: fog}\nsweep: {axes: {fog.height_m: {from: 100, to: 118, count: 10}}}\n";
        assert_eq!(sets(many), [(0..8).collect::<Vec<_>>(), vec![8, 9]]);
        let large = "sensor: {width_px: 4000, height_px: 2000}\n";
        assert_eq!(sets(&format!("{large}{many}")).len(), 5);
        let clear = "render: {share: fog}\nsweep: {axes: {fog: [none, {model: advection, height_m: 90}, \
                     {model: homogeneous, height_m: 9}]}}\n";
        assert_eq!(sets(clear), [vec![0], vec![1, 2]]);
    }
}
