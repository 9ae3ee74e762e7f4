//! Loading a glTF 2.0 scene (.glb or .gltf) from a file that nobody vouches for.

mod accessor;
mod container;
mod distributions;
mod document;
mod extensions;
mod files;
mod images;
mod lights;
mod material_reader;
mod materials;
mod nodes;
mod primitives;
mod tangents;
mod uri;

use crate::error::{Failure, SceneError, SceneErrorKind};
use crate::geometry::Geometry;
use crate::lamp::{LightNames, PunctualLights};
use crate::material::{Material, Opacity};
use crate::texture::Texture;
use std::path::Path;
use std::sync::Arc;

/// What a scene file may cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of the scene file and of all files that it names, together.
    pub max_file_bytes: u64,
    /// Triangles over all nodes, dropped ones included.
    pub max_triangles: usize,
    /// Pixels of all images in use, together; each takes 4 bytes.
    pub max_texture_pixels: u64,
    /// Nodes of the file, whether in use or not.
    pub max_nodes: usize,
}

impl Default for Limits {
    /// 2 GiB of files, 20 million triangles, 268 million pixels, 4 million nodes.
    fn default() -> Self {
        Self {
            max_file_bytes: 1 << 31,
            max_triangles: 20_000_000,
            max_texture_pixels: 1 << 28,
            max_nodes: 4_000_000,
        }
    }
}

/// A node with a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneObject {
    /// Name of the node, else of its mesh, else `node N`.
    pub name: String,
    /// `extras.class` of the node, its mesh or its nearest ancestor that has one.
    pub class: Option<String>,
    /// `extras.instance`, found in the same way.
    pub instance: Option<String>,
}

/// A scene in memory; the default one is empty space.
#[derive(Clone, Debug, Default)]
pub struct LoadedScene {
    /// All triangles, in the order of the nodes (depth first), in world space.
    pub geometry: Geometry,
    /// Materials; [`crate::Triangle::material`] is an index of them.
    pub materials: Vec<Material>,
    /// Textures; [`crate::TextureRef::texture`] is an index of them.
    pub textures: Vec<Texture>,
    /// Nodes with meshes; [`crate::Triangle::object`] is an index of them.
    pub objects: Vec<SceneObject>,
    /// Lights without extent, in cd and lx.
    pub lights: PunctualLights,
    /// Whose they are.
    pub light_names: LightNames,
    /// `extras` of the scene; null if it has none.
    pub extras: serde_json::Value,
    /// What was left out or is not supported, one sentence each.
    pub warnings: Vec<String>,
}

/// Sentences without repetition, at most a hundred.
#[derive(Debug, Default)]
struct Warnings(Vec<String>);

impl Warnings {
    const MOST: usize = 100;

    fn add(&mut self, text: String) {
        if self.0.len() < Self::MOST && !self.0.contains(&text) {
            self.0.push(text);
        } else if self.0.len() == Self::MOST {
            self.0.push("more warnings were left out".into());
        }
    }
}

/// Loads a scene: its default one, or its first.
///
/// Reads `path` and nothing outside of its folder; URIs with a scheme (other than `data:`), absolute paths and paths that
/// leave the folder, links included, are refused.
///
/// # Errors
/// [`SceneError`] names the file, the node, mesh, material or image, and what is wrong; damaged, hostile or oversized
/// files are errors, never panics.
pub fn load(path: &Path, limits: &Limits) -> Result<LoadedScene, SceneError> {
    let mut files = files::Files::beside(path, limits.max_file_bytes);
    let loaded =
        files.read_scene(path).map_err(Failure::from).and_then(|bytes| decode(&bytes, files, limits));
    loaded.map_err(|failure| failure.of(path))
}

/// As [`load`], from the bytes of a file; `name` is for messages. There is no folder: whatever the scene needs is inside of it.
///
/// # Errors
/// As those of [`load`].
pub fn load_bytes(name: &Path, bytes: &[u8], limits: &Limits) -> Result<LoadedScene, SceneError> {
    let mut files = files::Files::nowhere(limits.max_file_bytes);
    let loaded = files.count(bytes).map_err(Failure::from).and_then(|()| decode(bytes, files, limits));
    loaded.map_err(|failure| failure.of(name))
}

/// A scene from the bytes of its file; `files` fetches those that it names.
fn decode(bytes: &[u8], mut files: files::Files, limits: &Limits) -> Result<LoadedScene, Failure> {
    let mut warnings = Warnings::default();
    let container::Parts { json, blob } = container::split(bytes)?;
    let document = document::parse(json, &mut warnings)?;
    if document.nodes().len() > limits.max_nodes {
        return Err(
            SceneErrorKind::TooManyNodes { limit: limits.max_nodes, found: document.nodes().len() }.into()
        );
    }
    let extras = nodes::default_scene(&document).and_then(|scene| {
        let extras = scene.extras().as_ref()?;
        serde_json::from_str(extras.get()).ok()
    });
    let buffers = accessor::Buffers::load(&document, blob, &mut files)?;

    let mut images = images::Images::new(&document, &buffers, &mut files, limits.max_texture_pixels);
    let mut materials = document
        .materials()
        .map(|material| materials::convert(&material, &mut images, &mut warnings))
        .collect::<Result<Vec<_>, Failure>>()?;
    let textures = images.into_textures();
    // Primitives without a material use glTF's default one, which comes last.
    materials.push(Material::default());

    let mut distributions = distributions::Distributions::new(&mut files);
    let (surfaces, most) = ((&materials[..], &textures[..]), limits.max_triangles);
    let nodes::Flat { triangles, colors, tangents, objects, lights, light_names } =
        nodes::flatten(&document, &buffers, surfaces, &mut distributions, most, &mut warnings)?;
    let shared: Arc<[Texture]> = textures.iter().cloned().collect();
    let opacities = materials.iter().map(|material| Opacity::new(material, &shared)).collect();
    let geometry = Geometry::new(triangles, opacities).with_attributes(colors, tangents);
    Ok(LoadedScene {
        geometry,
        materials,
        textures,
        objects,
        lights,
        light_names,
        extras: extras.unwrap_or_default(),
        warnings: warnings.0,
    })
}
