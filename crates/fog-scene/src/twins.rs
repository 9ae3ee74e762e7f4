//! Pairs of places on textured emitters that shine differently.
//!
//! A path that runs into a façade of lit and dark windows finds one of them, by chance. Where it could as well have run into the
//! next one, both together say more about the façade: each place has a twin, some texels beside it, whose twin it is in turn.
//! Moving a path's end from one to the other changes no areas, so that a path and its twin can be weighed by their densities
//! (a shift mapping with Jacobian 1: Lehtinen et al., "Gradient-domain Metropolis light transport", ACM TOG 32(4), 2013).

use crate::bvh::Hit;
use crate::emitters::pieces;
use crate::material::{AlphaMode, Material};
use crate::texture::Texture;
use crate::triangle::Triangle;
use fog_core::colour::Rgb;

/// Parts of a triangle's edge at whose middles its emission is compared with that of the twins.
const GRID: u32 = 16;
/// Twins must be expected to take away this share of the variance ...
const LEAST_GAIN: f32 = 0.25;
/// ... and twins that are farther apart so much more.
const FARTHER_GAIN: f32 = 1.1;
/// Greatest distance of twins in texels.
const FARTHEST: u32 = 64;

/// How points of a triangle are paired: those of even cells with those of the odd cells after them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pairing {
    /// The cell's number is the floor of `cell[0] + cell[1] u + cell[2] v` at barycentric weights (1 − u − v, u, v).
    cell: [f32; 3],
    /// From a point of an even cell to its twin, in (u, v).
    shift: [f32; 2],
}

impl Pairing {
    /// The twin of a point; `None` if it is not on the triangle.
    #[inline]
    fn twin(&self, [u, v]: [f32; 2]) -> Option<[f32; 2]> {
        let cell = (self.cell[0] + self.cell[1] * u + self.cell[2] * v).floor();
        let even = cell * 0.5 == (cell * 0.5).floor();
        let sign = if even { 1.0 } else { -1.0 };
        let (u, v) = (u + sign * self.shift[0], v + sign * self.shift[1]);
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some([u, v])
    }
}

/// The pairings of a scene's emitters.
#[derive(Clone, Debug, Default)]
pub struct Twins {
    pairings: Vec<Pairing>,
    /// Index in `pairings` by triangle, `NONE` without one; empty if there are none.
    places: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Twins {
    /// Finds pairings for triangles (ids) of a scene where they pay.
    #[must_use]
    pub(crate) fn new(
        ids: impl Iterator<Item = u32>,
        triangles: &[Triangle],
        materials: &[Material],
        textures: &[Texture],
    ) -> Self {
        let mut twins = Self::default();
        for id in ids {
            let triangle = &triangles[id as usize];
            let found = pairing(triangle, &materials[triangle.material as usize], textures);
            if let Some(found) = found {
                if twins.places.is_empty() {
                    twins.places = vec![NONE; triangles.len()];
                }
                twins.places[id as usize] = twins.pairings.len() as u32;
                twins.pairings.push(found);
            }
        }
        twins
    }

    /// True if no place has a twin.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pairings.is_empty()
    }

    /// Barycentric weights (second and third corner) of the twin of a hit, on the same triangle; `None` if it has none.
    #[inline]
    #[must_use]
    pub fn of(&self, hit: &Hit) -> Option<[f32; 2]> {
        let &place = self.places.get(hit.triangle as usize)?;
        self.pairings.get(place as usize)?.twin([hit.u, hit.v])
    }
}

/// The pairing of a triangle that takes away most of the variance of its emission, if it is enough.
fn pairing(triangle: &Triangle, material: &Material, textures: &[Texture]) -> Option<Pairing> {
    let reference = material.emissive_texture?;
    let plain =
        material.alpha_mode == AlphaMode::Opaque && material.clearcoat == 0.0 && material.transmission == 0.0;
    let texture = textures.get(reference.texture as usize).filter(|_| plain)?;
    let size = texture.image().size();
    let corners = triangle.uv[usize::from(reference.set & 1)].map(|uv| texture.image_coordinates(uv));
    // Texel coordinates as affine functions of the barycentric weights.
    let axis = |i: usize| {
        let [a, b, c] = corners.map(|corner| corner[i] * size[i] as f32);
        [a, b - a, c - a]
    };
    let (x, y) = (axis(0), axis(1));
    let determinant = x[1] * y[2] - x[2] * y[1];
    if !determinant.is_normal() {
        return None;
    }
    let emission = |[u, v]: [f32; 2]| material.emission(textures, &triangle.uv_at(u, v));
    let points: Vec<[f32; 2]> =
        pieces(GRID).map(|part| [0, 1].map(|k| part.iter().map(|p| p[k]).sum::<f32>() / 3.0)).collect();
    let values: Vec<Rgb> = points.iter().map(|&point| emission(point)).collect();
    let mut best: Option<(f32, Pairing)> = None;
    let mut texels = 1;
    while texels <= FARTHEST {
        for (along, cell) in [x, y].into_iter().enumerate() {
            let step = texels as f32 / determinant;
            let shift = if along == 0 { [step * y[2], -step * y[1]] } else { [-step * x[2], step * x[1]] };
            let candidate = Pairing { cell: cell.map(|c| c / texels as f32), shift };
            let gain = gain(&candidate, &points, &values, emission);
            let bar = best.map_or(LEAST_GAIN, |(most, _)| most * FARTHER_GAIN);
            if gain > bar {
                best = Some((gain, candidate));
            }
        }
        texels *= 2;
    }
    best.map(|(_, pairing)| pairing)
}

/// Share of the variance of an emission that the means of twins do not have.
fn gain(pairing: &Pairing, points: &[[f32; 2]], values: &[Rgb], emission: impl Fn([f32; 2]) -> Rgb) -> f32 {
    let mean: Rgb = [0, 1, 2].map(|c| values.iter().map(|v| v[c]).sum::<f32>() / values.len() as f32);
    let product = |a: &Rgb, b: &Rgb| (0..3).map(|c| (a[c] - mean[c]) * (b[c] - mean[c])).sum::<f32>();
    let (mut whole, mut left) = (0.0, 0.0);
    for (&point, value) in points.iter().zip(values) {
        let own = product(value, value);
        whole += own;
        // Points without a twin keep their own variance.
        left += pairing.twin(point).map_or(own, |twin| 0.5 * (own + product(value, &emission(twin))));
    }
    if whole > 0.0 { 1.0 - left / whole } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::TextureRef;
    use crate::texture::{Encoding, Filter, Image, Wrap};
    use glam::Vec3;
    use std::sync::Arc;

    /// Half of a wall whose texture has `columns` × 8 texels, lit where `lit(column, row)` says.
    fn twins(columns: u32, lit: impl Fn(u32, u32) -> bool) -> Twins {
        let texel = |i: u32| if lit(i % columns, i / columns) { [255, 200, 0, 255] } else { [0, 0, 50, 255] };
        let image = Image::new(columns, 8, (0..8 * columns).map(texel).collect()).unwrap();
        let texture = Texture::new(Arc::new(image), Encoding::Linear, Filter::Nearest, [Wrap::Repeat; 2]);
        let reference = TextureRef { texture: 0, set: 0 };
        let material =
            Material { emissive: [1.0; 3], emissive_texture: Some(reference), ..Material::default() };
        let mut triangle = Triangle::flat([Vec3::ZERO, Vec3::X * 16.0, Vec3::Y * 16.0]);
        triangle.uv[0] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        Twins::new([1].into_iter(), &[triangle; 2], &[material], &[texture])
    }

    #[test]
    fn twins_are_each_others_and_shine_differently() {
        let checks = |column: u32, row: u32| (column + row).is_multiple_of(2);
        for twins in [twins(8, checks), twins(32, |column, row| checks(column / 4, row))] {
            let mut paired = 0;
            for i in 0..1000 {
                let (u, v) = ((i % 40) as f32 / 40.0 + 0.003, (i / 40) as f32 / 40.0 + 0.002);
                if u + v > 1.0 {
                    continue;
                }
                let hit = Hit { t: 1.0, triangle: 1, u, v };
                assert_eq!(twins.of(&Hit { triangle: 0, ..hit }), None);
                let Some([a, b]) = twins.of(&hit) else { continue };
                paired += 1;
                assert!((a - u).hypot(b - v) > 0.1);
                let back = twins.of(&Hit { u: a, v: b, ..hit }).expect("twin of the twin");
                assert!((back[0] - u).abs() < 1e-5 && (back[1] - v).abs() < 1e-5, "{u} {v}");
                let colour = |u: f32, v: f32| checks((u * 8.0) as u32, (v * 8.0) as u32);
                assert_ne!(colour(u, v), colour(a, b), "{u} {v}");
            }
            assert!(paired > 300, "{paired}");
        }
    }

    #[test]
    fn even_walls_have_none() {
        assert!(twins(8, |_, _| true).is_empty());
    }
}
