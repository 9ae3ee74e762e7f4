//! Optical flow between two frames: the motion of the camera and of the scene.

use crate::surface_truth::{centre_ray, seen_point};
use fog_core::{DVec3, Vec3A};
use fog_film::SurfaceTruth;
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;
use fog_scene::{Geometry, Hit};
use rayon::prelude::*;

/// Distance at which the sky stands in for points at infinity, in metres.
const FAR: f32 = 1e6;
/// A surface hides a point behind it if it is nearer by more than this share of the distance and by this many metres.
const NEARER: [f32; 2] = [1e-3, 1e-3];

/// The next frame.
#[derive(Clone, Copy, Debug)]
pub struct NextView<'a> {
    /// Its camera.
    pub camera: &'a Camera,
    /// The scene's triangles then: as many as now and in the same order.
    pub geometry: &'a Geometry,
}

/// Where a pixel's point goes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Motion {
    flow: [f32; 2],
    valid: bool,
}

const LOST: Motion = Motion { flow: [f32::NAN; 2], valid: false };

/// Fills in flow and validity of every pixel of `camera`, in pixels from this frame to the next.
///
/// A point of a triangle moves with the triangle's corners; sky is infinitely far away. The flow is NaN where the next camera
/// has no image of the point, as behind it. It is valid where the point lies in the next image and nothing is in front of it; it
/// is told, but not valid, where the point leaves the image or is hidden then. Without a next frame everything is NaN.
pub fn add_flow(truth: &mut SurfaceTruth, scene: &Scene, camera: &Camera, next: Option<NextView<'_>>) {
    let now = &scene.loaded().geometry;
    let next = next.filter(|next| next.geometry.triangles().len() == now.triangles().len());
    let motions: Vec<Motion> = (0..camera.width as usize * camera.height as usize)
        .into_par_iter()
        .map(|i| next.as_ref().and_then(|next| motion(now, camera, i, next)).unwrap_or(LOST))
        .collect();
    truth.flow = motions.iter().map(|motion| motion.flow).collect();
    truth.flow_valid = motions.iter().map(|motion| f32::from(motion.valid)).collect();
}

fn motion(now: &Geometry, camera: &Camera, i: usize, next: &NextView<'_>) -> Option<Motion> {
    let ray = centre_ray(camera, i)?;
    let hit = now.intersect(ray.origin, ray.direction, f32::INFINITY);
    let target = match &hit {
        Some(hit) => (seen_point(&ray, hit).as_dvec3() + displacement(now, next.geometry, hit)).as_vec3a(),
        None => next.camera.pose.position + ray.direction * FAR,
    };
    let image = next.camera.project(target)?;
    let (x, y) = (i % camera.width as usize, i / camera.width as usize);
    let flow = [image[0] - (x as f64 + 0.5), image[1] - (y as f64 + 0.5)].map(|d| d as f32);
    let back = next.camera.ray(image[0], image[1]).filter(|_| next.camera.contains(image));
    let valid = back.is_some_and(|back| is_seen(next.geometry, back.origin, target, hit.is_none()));
    Some(Motion { flow, valid })
}

/// How far the point of a hit moves with its triangle.
fn displacement(now: &Geometry, next: &Geometry, hit: &Hit) -> DVec3 {
    let corners = |geometry: &Geometry| geometry.triangles()[hit.triangle as usize].positions;
    let (before, after) = (corners(now), corners(next));
    let moved = |k: usize| after[k].as_dvec3() - before[k].as_dvec3();
    let (u, v) = (f64::from(hit.u), f64::from(hit.v));
    moved(0) * (1.0 - u - v) + moved(1) * u + moved(2) * v
}

/// Whether nothing stands between an eye and a point, or the sky in its direction.
pub(crate) fn is_seen(geometry: &Geometry, eye: Vec3A, point: Vec3A, sky: bool) -> bool {
    let way = point - eye;
    let distance = way.length();
    let reach = if sky { f32::INFINITY } else { distance * (1.0 - NEARER[0]) - NEARER[1] };
    distance == 0.0 || reach <= 0.0 || !geometry.occluded(eye, way / distance, reach)
}
