//! What the first surface of each pixel-centre ray is, and where it goes until the next frame. Never filtered: a pixel's truth is
//! that of its centre. Glass is a surface, blended surfaces count from half coverage, as in [`crate::truth`].

use fog_core::Vec3A;
use fog_core::colour::Rgb;
use fog_film::SurfaceTruth;
use fog_scene::Hit;
use fog_scene::camera::{Camera, Ray};
use fog_scene::labels::{ClassTable, Label, Labels};
use fog_scene::scene::Scene;
use rayon::prelude::*;

/// Layers that are asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SurfaceLayers {
    /// Normals: of the interpolated vertex normals, without normal maps, on the side that is seen.
    pub normals: bool,
    /// Positions.
    pub position: bool,
    /// Linear base colour with vertex colours; black backs of single-sided materials are black.
    pub albedo: bool,
}

/// Truth of one pixel.
struct Row {
    normal: Vec3A,
    position: Vec3A,
    albedo: Rgb,
    label: Label,
}

/// Layers of every pixel, and class and instance where there are labels. Sky has the class `sky`, pixels that the lens does not
/// show `out of roi`.
#[must_use]
pub fn surface_truth(
    scene: &Scene,
    camera: &Camera,
    layers: SurfaceLayers,
    labels: Option<&Labels>,
) -> SurfaceTruth {
    let rows: Vec<Row> = (0..camera.width as usize * camera.height as usize)
        .into_par_iter()
        .map(|i| pixel(scene, camera, i, layers, labels))
        .collect();
    let mut truth = SurfaceTruth::default();
    if layers.normals {
        truth.normal = rows.iter().map(|row| row.normal.to_array()).collect();
    }
    if layers.position {
        truth.position = rows.iter().map(|row| row.position.to_array()).collect();
    }
    if layers.albedo {
        truth.albedo = rows.iter().map(|row| row.albedo).collect();
    }
    if labels.is_some() {
        truth.semantic = rows.iter().map(|row| row.label.class).collect();
        truth.instance = rows.iter().map(|row| row.label.instance).collect();
    }
    truth
}

fn pixel(scene: &Scene, camera: &Camera, i: usize, layers: SurfaceLayers, labels: Option<&Labels>) -> Row {
    let nothing = |class| Row {
        normal: Vec3A::ZERO,
        position: Vec3A::NAN,
        albedo: [0.0; 3],
        label: Label { class, instance: 0 },
    };
    let Some(ray) = centre_ray(camera, i) else { return nothing(ClassTable::UNSEEN) };
    let Some(hit) = scene.intersect(ray.origin, ray.direction, f32::INFINITY) else {
        return nothing(ClassTable::SKY);
    };
    let mut row = nothing(ClassTable::UNLABELED);
    if layers.normals || layers.albedo {
        let look = scene.base_features(&hit, ray.direction);
        (row.normal, row.albedo) = (look.normal, look.albedo);
    }
    row.position = seen_point(&ray, &hit);
    if let Some(labels) = labels {
        row.label = labels.of(hit.triangle);
    }
    row
}

/// Ray through the centre of pixel `i`.
pub(crate) fn centre_ray(camera: &Camera, i: usize) -> Option<Ray> {
    let (x, y) = (i % camera.width as usize, i / camera.width as usize);
    camera.ray(x as f64 + 0.5, y as f64 + 0.5)
}

/// The point of a hit on its ray: beside a triangle's plane by the error of the hit's distance alone, so that it projects to where
/// the ray came from.
pub(crate) fn seen_point(ray: &Ray, hit: &Hit) -> Vec3A {
    (ray.origin.as_dvec3() + f64::from(hit.t) * ray.direction.as_dvec3()).as_vec3a()
}
