//! Everything that one frame's paths can meet, immutable and shared by all threads.

use crate::bsdf::Bsdf;
use crate::bvh::Hit;
use crate::emission::find_emitters;
use crate::emitters::Emitters;
use crate::gltf_load::LoadedScene;
use crate::lamp::{Beam, Lamp, LampTree};
use crate::light::{Environment, Sun};
use crate::light_groups::{Grouping, LightGroups, LightSource};
use crate::material::AlphaMode;
use crate::medium::{LateMedium, Medium};
use crate::sky_map::SkyMap;
use crate::triangle::SurfacePoint;
use crate::twins::Twins;
use fog_core::colour::{Rgb, upsample};
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, warp};
use glam::Mat3A;
use std::sync::Arc;

/// Geometry and materials (shared between frames), the fog and the lights of one frame.
#[derive(Clone, Debug)]
pub struct Scene {
    loaded: Arc<LoadedScene>,
    /// The fog, if any.
    pub medium: Option<Medium>,
    /// What the fog is taken for along paths that have scattered often, if that is another.
    pub late: Option<LateMedium>,
    /// Uniform environment, if any.
    pub environment: Option<Environment>,
    /// Surroundings with structure, if any; they shine beside the uniform ones.
    pub sky: Option<SkyMap>,
    /// Sun, if any.
    pub sun: Option<Sun>,
    emitters: Arc<Emitters>,
    lamps: LampTree,
    beams: Vec<Beam>,
    /// Relative radiance of 1 cd/m² in the scene file.
    of_one_nit: f32,
    grouping: Option<Grouping>,
    /// Groups of the lamps and beams that shine.
    lamp_groups: Vec<usize>,
    beam_groups: Vec<usize>,
}

/// A surface point seen from a ray, ready for shading.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// The point: position, plane normal, material.
    pub point: SurfacePoint,
    /// Unit normal of the triangle on the side that the ray came from.
    pub normal: Vec3A,
    /// World from shading frame (z = shading normal on that side).
    pub world_from_shading: Mat3A,
    /// Scattering; `None` on the back of a single-sided material, which is black unless it is a transmitting sheet.
    pub bsdf: Option<Bsdf>,
    /// Relative radiance emitted towards the ray's origin.
    pub emission: Spectrum,
}

/// Largest share of light that counts as having passed before a surface is met, so that something is left to divide by.
const LARGEST_CLEAR: f32 = 0.999_999;

impl Scene {
    /// Puts a frame's scene together; `scene_emitters` switches the emission of all materials and the lights of the scene
    /// file. Its photometric units are taken for relative ones: 1 cd/m² for the radiance 1, and so on (see
    /// [`Scene::with_luminance_of_one`]).
    #[must_use]
    pub fn new(
        loaded: Arc<LoadedScene>,
        medium: Option<Medium>,
        environment: Option<Environment>,
        sun: Option<Sun>,
        scene_emitters: bool,
    ) -> Self {
        let emitters = if scene_emitters { loaded.emission.emitters(&loaded) } else { Arc::default() };
        let mut scene = Self {
            loaded,
            medium,
            late: None,
            environment,
            sky: None,
            sun,
            emitters,
            lamps: LampTree::default(),
            beams: Vec::new(),
            of_one_nit: 1.0,
            grouping: None,
            lamp_groups: Vec::new(),
            beam_groups: Vec::new(),
        };
        if scene_emitters {
            scene.light_lamps();
        }
        scene
    }

    /// The same scene whose fog is taken for a simpler one along paths that have scattered often: see [`LateMedium`]. Fog that
    /// cannot be told so (patchy, single droplets) stays as it is.
    #[must_use]
    pub fn with_similar_fog(mut self) -> Self {
        self.late = self.medium.as_ref().and_then(LateMedium::similar);
        self
    }

    /// The same scene in clear air.
    #[must_use]
    pub fn without_fog(&self) -> Self {
        Self { medium: None, late: None, ..self.clone() }
    }

    /// Optical depths along a ray (unit direction) up to `t_max` metres, at these wavelengths in nm; 0 without fog.
    #[must_use]
    pub fn optical_depths_at<const N: usize>(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f64,
        wavelengths_nm: [f64; N],
    ) -> [f64; N] {
        let depths = |medium: &Medium| medium.optical_depths_at(origin, direction, t_max, wavelengths_nm);
        self.medium.as_ref().map_or([0.0; N], depths)
    }

    /// The same scene under this sky.
    #[must_use]
    pub fn with_sky(mut self, sky: Option<SkyMap>) -> Self {
        self.sky = sky;
        self
    }

    /// The same scene where the relative radiance 1 stands for a luminance of `cd_m2`, above 0: what the scene file gives in
    /// cd/m², cd and lx is divided by it. Environment, sky and sun are relative already.
    #[must_use]
    pub fn with_luminance_of_one(mut self, cd_m2: f64) -> Self {
        self.of_one_nit = (1.0 / cd_m2) as f32;
        if !(self.lamps.lights().is_empty() && self.beams.is_empty()) {
            self.light_lamps();
        }
        self
    }

    /// The same scene with its lights in groups, each as bright as its group says.
    #[must_use]
    pub fn with_light_groups(mut self, groups: LightGroups) -> Self {
        let grouping = Grouping::new(groups, &self.loaded);
        let intensity = |group| grouping.groups.intensity(group);
        if let Some(environment) = &mut self.environment {
            environment.radiance *= intensity(grouping.environment);
        }
        let factor = intensity(grouping.environment);
        self.sky = self.sky.filter(|_| factor > 0.0).map(|sky| sky.scaled(f64::from(factor)));
        if let Some(sun) = &mut self.sun {
            sun.irradiance *= intensity(grouping.sun);
        }
        let even = (0..grouping.groups.names().len()).all(|group| intensity(group) == 1.0);
        if !(even || self.emitters.is_empty()) {
            self.emitters = Arc::new(find_emitters(&self.loaded, Some(&grouping)));
        }
        self.grouping = Some(grouping);
        if !(self.lamps.lights().is_empty() && self.beams.is_empty()) {
            self.light_lamps();
        }
        self
    }

    /// The groups of its lights, if they are told apart.
    #[must_use]
    pub fn light_groups(&self) -> Option<&LightGroups> {
        self.grouping.as_ref().map(|g| &g.groups)
    }

    /// Group of a light: the position of its name among [`LightGroups::names`]; 0 where there are no groups.
    #[must_use]
    pub fn light_group(&self, source: LightSource) -> usize {
        let Some(grouping) = &self.grouping else { return 0 };
        match source {
            LightSource::Environment => grouping.environment,
            LightSource::Sun => grouping.sun,
            LightSource::Lamp(lamp) => self.lamp_groups[lamp],
            LightSource::Beam(beam) => self.beam_groups[beam],
            LightSource::Emitter(triangle) => {
                let triangle = &self.loaded.geometry.triangles()[triangle as usize];
                grouping.of_surface(triangle.object, triangle.material)
            }
        }
    }

    /// Number of lights that shine in each group: environment, sun, lamps, beams and emitting triangles. Empty where there are
    /// no groups.
    #[must_use]
    pub fn light_counts(&self) -> Vec<usize> {
        let Some(grouping) = &self.grouping else { return Vec::new() };
        let mut counts = vec![0; grouping.groups.names().len()];
        let single = [
            self.environment.map(|_| LightSource::Environment),
            self.sky.as_ref().map(|_| LightSource::Environment),
            self.sun.map(|_| LightSource::Sun),
        ];
        let emitters = self.emitters.triangles().map(LightSource::Emitter);
        let lamps = (0..self.lamp_groups.len()).map(LightSource::Lamp);
        let beams = (0..self.beam_groups.len()).map(LightSource::Beam);
        for source in single.into_iter().flatten().chain(emitters).chain(lamps).chain(beams) {
            counts[self.light_group(source)] += 1;
        }
        counts
    }

    fn light_lamps(&mut self) {
        let lights = &self.loaded.lights;
        let group = |of: fn(&Grouping) -> &[usize], i: usize| self.grouping.as_ref().map_or(0, |g| of(g)[i]);
        let scale = |group: usize| {
            self.of_one_nit * self.grouping.as_ref().map_or(1.0, |g| g.groups.intensity(group))
        };
        let lamps = lights.lamps.iter().enumerate().map(|(i, lamp)| {
            let group = group(|g| &g.lamps, i);
            (Lamp { intensity: lamp.intensity.map(|c| c * scale(group)), ..lamp.clone() }, group)
        });
        let (lamps, lamp_groups): (Vec<_>, _) = lamps.filter(|(lamp, _)| lamp.strength() > 0.0).unzip();
        let beams = lights.beams.iter().enumerate().map(|(i, beam)| {
            let group = group(|g| &g.beams, i);
            (Beam { illuminance: beam.illuminance.map(|c| c * scale(group)), ..*beam }, group)
        });
        let (beams, beam_groups) = beams.filter(|(beam, _)| beam.strength() > 0.0).unzip();
        (self.lamps, self.lamp_groups) = (LampTree::new(lamps), lamp_groups);
        (self.beams, self.beam_groups) = (beams, beam_groups);
    }

    /// Relative radiance of 1 cd/m² of a surface.
    #[inline]
    fn of_one_nit(&self, object: u32, material: u32) -> f32 {
        let Some(grouping) = &self.grouping else { return self.of_one_nit };
        self.of_one_nit * grouping.groups.intensity(grouping.of_surface(object, material))
    }

    /// Points and spots of the scene file, relative; none when they are switched off.
    #[must_use]
    pub fn lamps(&self) -> &LampTree {
        &self.lamps
    }

    /// Factor of its group on the light of a lamp of the scene file, by its index there; 1 where there are no groups.
    #[must_use]
    pub fn lamp_factor(&self, lamp: usize) -> f32 {
        let group = self.grouping.as_ref().and_then(|g| Some((g, *g.lamps.get(lamp)?)));
        group.map_or(1.0, |(grouping, group)| grouping.groups.intensity(group))
    }

    /// Whether nothing shines but emitting surfaces.
    #[must_use]
    pub fn emitters_alone(&self) -> bool {
        let distant = self.environment.is_some() || self.sky.is_some() || self.sun.is_some();
        !distant && self.beams().is_empty() && self.lamps().lights().is_empty()
    }

    /// Directional lights of the scene file that shine, relative; none when they are switched off.
    #[must_use]
    pub fn beams(&self) -> &[Beam] {
        &self.beams
    }

    /// Geometry, materials and objects.
    #[must_use]
    pub fn loaded(&self) -> &LoadedScene {
        &self.loaded
    }

    /// The emitting triangles; empty when they are switched off.
    #[must_use]
    pub fn emitters(&self) -> &Emitters {
        &self.emitters
    }

    /// Places on broad emitters that shine differently, in pairs; none where some surfaces are passed by chance.
    #[must_use]
    pub fn twins(&self) -> Arc<Twins> {
        if self.emitters.is_empty() { Arc::default() } else { self.loaded.emission.twins(&self.loaded) }
    }

    /// Closest surface along a ray before `t_max`; blended surfaces are there where they cover at least half, and glass is
    /// a surface.
    #[inline]
    #[must_use]
    pub fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<Hit> {
        self.loaded.geometry.intersect(origin, direction, t_max)
    }

    /// True if paths need random bits ([`Scene::scatterer`]'s key) because some materials are partly transparent.
    #[inline]
    #[must_use]
    pub fn has_partial_opacity(&self) -> bool {
        self.loaded.geometry.has_partial_opacity()
    }

    /// Closest surface that stops a ray before `t_max`. Partly transparent ones are passed by chance, which `key`, random
    /// bits of this ray, decides.
    #[inline]
    #[must_use]
    pub fn scatterer(&self, origin: Vec3A, direction: Vec3A, t_max: f32, key: u64) -> Option<Hit> {
        self.loaded.geometry.intersect_by_chance(origin, direction, t_max, key)
    }

    /// True if any surface stops a ray before `t_max`: `scatterer(..).is_some()`, sooner.
    #[inline]
    #[must_use]
    pub fn occluded(&self, origin: Vec3A, direction: Vec3A, t_max: f32, key: u64) -> bool {
        self.loaded.geometry.occluded_by_chance(origin, direction, t_max, key)
    }

    /// Share of light that comes straight through all surfaces before `t_max`: what [`Scene::occluded`] lets pass in the mean.
    #[must_use]
    pub fn clear_share(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> f32 {
        self.loaded.geometry.clear_share(origin, direction, t_max)
    }

    /// Shading data of a hit seen along `direction`, at the wavelengths whose colour basis is `basis`.
    ///
    /// The hit is one that [`Scene::scatterer`] found: of clear glass it stands for the rays that were not let pass.
    #[must_use]
    pub fn surface(&self, hit: &Hit, direction: Vec3A, basis: &[Spectrum; 3]) -> Surface {
        let LoadedScene { geometry, materials, textures, .. } = &*self.loaded;
        let point = geometry.surface(hit);
        let material = &materials[point.material as usize];
        let front = point.geometric_normal.dot(direction) < 0.0;
        let side = if front { 1.0 } else { -1.0 };
        let world_from_shading = warp::frame(point.shading_normal * side);
        let mut surface = Surface {
            point,
            normal: point.geometric_normal * side,
            world_from_shading,
            bsdf: None,
            emission: Spectrum::ZERO,
        };
        // Both sides of a transmitting sheet are surfaces of it.
        if !(front || material.double_sided || material.transmission > 0.0) {
            return surface;
        }
        let mut values = material.evaluate(textures, &point.uv);
        if let Some(color) = geometry.colors().at(hit) {
            values = values.tinted(color);
        }
        let mut bsdf = Bsdf::new(&values, basis);
        if let Some(normal) = material.mapped_normal(textures, &point.uv) {
            let mapped = tangent_frame(&point, geometry.tangents().at(hit)).map(|frame| frame * normal);
            bsdf = mapped.map_or(bsdf, |n| bsdf.with_normal(world_from_shading.transpose() * (n * side)));
        }
        let cos = point.shading_normal.dot(direction).abs();
        let clear = values.clear_share(cos);
        surface.bsdf = Some(if clear > 0.0 { bsdf.beside_clear(clear.min(LARGEST_CLEAR)) } else { bsdf });
        if !self.emitters.is_empty() && (front || material.double_sided) {
            let share = values.coat_transmittance(cos) / (1.0 - clear.min(LARGEST_CLEAR));
            let of_one_nit = self.of_one_nit(point.object, point.material);
            surface.emission = upsample(values.emission, basis) * (share * of_one_nit);
        }
        surface
    }

    /// Relative radiance that a point of an emitting triangle sends towards `-direction` (the ray's origin), weighted by
    /// the share of the surface that is there; and the triangle's normal.
    #[must_use]
    pub fn emission_towards(&self, hit: &Hit, direction: Vec3A) -> (Rgb, Vec3A) {
        let LoadedScene { geometry, materials, textures, .. } = &*self.loaded;
        let point = geometry.surface(hit);
        let material = &materials[point.material as usize];
        let front = point.geometric_normal.dot(direction) < 0.0;
        if !(front || material.double_sided) {
            return ([0.0; 3], point.geometric_normal);
        }
        let mut rgb = material.emission(textures, &point.uv);
        if material.alpha_mode != AlphaMode::Opaque || material.clearcoat > 0.0 {
            let alpha = geometry.colors().at(hit).map_or(1.0, |c| c[3]);
            let coat = material.evaluate(textures, &point.uv);
            let share = material.coverage(textures, &point.uv, alpha)
                * coat.coat_transmittance(point.shading_normal.dot(direction).abs());
            rgb = rgb.map(|c| c * share);
        }
        let of_one_nit = self.of_one_nit(point.object, point.material);
        (rgb.map(|c| c * of_one_nit), point.geometric_normal)
    }
}

/// World from tangent space at a point with an interpolated tangent: tangent, bitangent, normal (glTF 2.0, sec. 3.7.2.1).
fn tangent_frame(point: &SurfacePoint, tangent: Option<[f32; 4]>) -> Option<Mat3A> {
    let [x, y, z, sign] = tangent?;
    let normal = point.shading_normal;
    let along = Vec3A::new(x, y, z);
    let tangent = (along - normal * normal.dot(along)).try_normalize()?;
    Some(Mat3A::from_cols(tangent, normal.cross(tangent) * 1.0f32.copysign(sign), normal))
}
