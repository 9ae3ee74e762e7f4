//! The emitters of a loaded scene and their twins. Frames of a scene share them, so that a frame need not find them again.

use crate::emitters::{Breadth, EmitterTriangle, Emitters, pieces};
use crate::gltf_load::LoadedScene;
use crate::light_groups::Grouping;
use crate::material::AlphaMode;
use crate::triangle::Triangle;
use crate::twins::Twins;
use fog_core::Vec3A;
use std::sync::{Arc, OnceLock};

/// Parts of a triangle's edge by whose middles a textured emission is averaged.
const POWER_GRID: u32 = 24;
/// Pieces of an edge into which a triangle is cut whose emission varies, where emitting triangles are few ...
const FINEST_PIECES: u32 = 8;
/// ... up to this number. Beyond it half as many ...
const FEW_EMITTERS: usize = 2_000;
/// ... and beyond this none: there are then pieces enough.
const MANY_EMITTERS: usize = 20_000;
/// Greatest radiance of a piece over the triangle's mean from which on it pays to tell the pieces apart.
const CONTRAST: f32 = 1.5;

/// What is known of a scene's emission, found when it is first asked for. A clone knows nothing yet: what it is a part of may be
/// changed.
#[derive(Debug, Default)]
pub struct Emission {
    emitters: OnceLock<Arc<Emitters>>,
    twins: OnceLock<Arc<Twins>>,
}

impl Clone for Emission {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Emission {
    /// All emitting triangles of the scene that this is a part of.
    pub(crate) fn emitters(&self, loaded: &LoadedScene) -> Arc<Emitters> {
        Arc::clone(self.emitters.get_or_init(|| Arc::new(find_emitters(loaded, None))))
    }

    /// The twins of its broad emitters.
    pub(crate) fn twins(&self, loaded: &LoadedScene) -> Arc<Twins> {
        let find = || Arc::new(find_twins(loaded, &self.emitters(loaded)));
        Arc::clone(self.twins.get_or_init(find))
    }
}

/// All triangles whose material emits, with the radiance of their pieces.
pub(crate) fn find_emitters(loaded: &LoadedScene, grouping: Option<&Grouping>) -> Emitters {
    let all = loaded.geometry.triangles();
    let material = |t: &Triangle| &loaded.materials[t.material as usize];
    let emitting = || all.iter().enumerate().filter(|(_, t)| material(t).is_emissive());
    let finest = match emitting().count() {
        ..=FEW_EMITTERS => FINEST_PIECES,
        n if n <= MANY_EMITTERS => FINEST_PIECES / 2,
        _ => 1,
    };
    let triangles: Vec<_> = emitting()
        .map(|(id, triangle)| {
            let material = material(triangle);
            // Red, green and blue count alike, for all must be found.
            let radiance = |[u, v]: [f32; 2]| {
                let uv = triangle.uv_at(u, v);
                let rgb = material.emission(&loaded.textures, &uv);
                rgb.iter().sum::<f32>() * material.coverage(&loaded.textures, &uv, 1.0)
            };
            let even = material.emissive_texture.is_none() && material.alpha_mode == AlphaMode::Opaque;
            let per_edge = if even { 1 } else { finest };
            let steps = if even { 1 } else { (POWER_GRID / per_edge).min(POWER_GRID / 2) };
            let mut means: Vec<f32> =
                pieces(per_edge).map(|corners| mean(corners, steps, radiance)).collect();
            let whole = means.iter().sum::<f32>() / means.len() as f32;
            let varies = means.iter().any(|&m| m > CONTRAST * whole);
            if !varies {
                means = vec![whole];
            }
            let group = |g: &Grouping| g.groups.intensity(g.of_surface(triangle.object, triangle.material));
            let intensity = grouping.map_or(1.0, group);
            EmitterTriangle {
                triangle: id as u32,
                corners: triangle.positions.map(Vec3A::from),
                two_sided: material.double_sided,
                per_edge: if varies { per_edge } else { 1 },
                radiance: means.into_iter().map(|m| m * intensity).collect(),
            }
        })
        .collect();
    Emitters::new(&triangles, all.len())
}

/// Pairs of places on the broad emitters of a scene that has not too many, and no surfaces that are passed by chance.
fn find_twins(loaded: &LoadedScene, emitters: &Emitters) -> Twins {
    let geometry = &loaded.geometry;
    let broad = || emitters.triangles().filter(|&id| emitters.breadth(id) == Breadth::Broad);
    if geometry.has_partial_opacity() || broad().nth(FEW_EMITTERS).is_some() {
        return Twins::default();
    }
    Twins::new(broad(), geometry.triangles(), &loaded.materials, &loaded.textures)
}

/// Mean of `value` over the centres of `steps`² even parts of a triangle.
fn mean(corners: [[f32; 2]; 3], steps: u32, value: impl Fn([f32; 2]) -> f32) -> f32 {
    let [a, b, c] = corners;
    let place = |[u, v]: [f32; 2]| [0, 1].map(|k| a[k] + (b[k] - a[k]) * u + (c[k] - a[k]) * v);
    let centre = |[p, q, r]: [[f32; 2]; 3]| [0, 1].map(|k| (p[k] + q[k] + r[k]) / 3.0);
    let sum: f32 = pieces(steps).map(|part| value(place(centre(part)))).sum();
    sum / (steps * steps) as f32
}
