//! Loading a glTF 2.0 scene (.glb or .gltf) from a file that nobody vouches for.

mod accessor;
mod animations;
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

use crate::animation::Animation;
use crate::emission::Emission;
use crate::error::{Failure, SceneError, SceneErrorKind};
use crate::geometry::Geometry;
use crate::lamp::{LightNames, PunctualLights};
use crate::material::{Material, Opacity};
use crate::texture::Texture;
use fog_core::{DMat4, DVec3};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

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

/// A node, with a mesh or without.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneNode {
    /// Its name, else that of its mesh, else `node N`.
    pub name: String,
    /// Index of the node that it hangs on; always less than its own.
    pub parent: Option<u32>,
    /// `extras.class` of the node or its mesh.
    pub class: Option<String>,
    /// `extras.instance` of the node or its mesh.
    pub instance: Option<String>,
    /// Named points in the node's own axes, in metres: those of `extras.keypoints` (a map of x, y, z), and the node's origin under
    /// the name `extras.keypoint`.
    pub keypoints: Vec<(String, DVec3)>,
    /// World from the node's axes.
    pub world: DMat4,
}

/// A node with a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneObject {
    /// Index of the node.
    pub node: u32,
    /// Name of the node, else of its mesh, else `node N`.
    pub name: String,
    /// Name of the mesh.
    pub mesh: Option<String>,
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
    /// All nodes, depth first.
    pub nodes: Vec<SceneNode>,
    /// Nodes with meshes; [`crate::Triangle::object`] is an index of them.
    pub objects: Vec<SceneObject>,
    /// Lights without extent, in cd and lx.
    pub lights: PunctualLights,
    /// Whose they are.
    pub light_names: LightNames,
    /// `extras` of the scene; null if it has none.
    pub extras: serde_json::Value,
    /// Time in seconds at which everything is where it is.
    pub time_s: f64,
    /// What moves; none where nothing does.
    pub animation: Option<Arc<Animation>>,
    /// What is known of its emission.
    pub emission: Emission,
    /// What was left out or is not supported, one sentence each.
    pub warnings: Vec<String>,
}

impl LoadedScene {
    /// Name of a node, or nothing if there is no such node.
    #[must_use]
    pub fn node_name(&self, node: u32) -> &str {
        self.nodes.get(node as usize).map_or("", |node| &node.name)
    }

    /// `extras.instance` of a node, or of its nearest ancestor that has one.
    #[must_use]
    pub fn instance_name(&self, node: u32) -> Option<&str> {
        let mut node = self.nodes.get(node as usize)?;
        loop {
            if let Some(name) = &node.instance {
                return Some(name);
            }
            node = &self.nodes[node.parent? as usize];
        }
    }
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

/// A scene file in memory, from which scenes at different times are made. They share materials and textures with it.
pub struct SceneFile {
    path: PathBuf,
    document: gltf::Document,
    buffers: accessor::Buffers,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    /// Of its lights; each is read once, whatever the time.
    distributions: Mutex<distributions::Distributions>,
    animation: Option<Animation>,
    max_triangles: usize,
    warnings: Vec<String>,
}

impl std::fmt::Debug for SceneFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SceneFile").field("path", &self.path).finish_non_exhaustive()
    }
}

/// Loads a scene, its default one or its first, as it is at time 0.
///
/// Reads `path` and nothing outside of its folder; URIs with a scheme (other than `data:`), absolute paths and paths that
/// leave the folder, links included, are refused.
///
/// # Errors
/// [`SceneError`] names the file, the node, mesh, material or image, and what is wrong; damaged, hostile or oversized
/// files are errors, never panics.
pub fn load(path: &Path, limits: &Limits) -> Result<LoadedScene, SceneError> {
    SceneFile::open(path, limits)?.at(0.0)
}

/// As [`load`], from the bytes of a file; `name` is for messages. There is no folder: whatever the scene needs is inside of it.
///
/// # Errors
/// As those of [`load`].
pub fn load_bytes(name: &Path, bytes: &[u8], limits: &Limits) -> Result<LoadedScene, SceneError> {
    SceneFile::from_bytes(name, bytes, limits)?.at(0.0)
}

impl SceneFile {
    /// Reads a file as [`load`] does.
    ///
    /// # Errors
    /// As those of [`load`].
    pub fn open(path: &Path, limits: &Limits) -> Result<Self, SceneError> {
        let mut files = files::Files::beside(path, limits.max_file_bytes);
        let read = files.read_scene(path).map_err(Failure::from);
        read.and_then(|bytes| Self::decode(path, &bytes, files, limits)).map_err(|failure| failure.of(path))
    }

    /// Reads bytes as [`load_bytes`] does.
    ///
    /// # Errors
    /// As those of [`load`].
    pub fn from_bytes(name: &Path, bytes: &[u8], limits: &Limits) -> Result<Self, SceneError> {
        let mut files = files::Files::nowhere(limits.max_file_bytes);
        let counted = files.count(bytes).map_err(Failure::from);
        counted.and_then(|()| Self::decode(name, bytes, files, limits)).map_err(|failure| failure.of(name))
    }

    /// `files` fetches the files that the scene names.
    fn decode(path: &Path, bytes: &[u8], mut files: files::Files, limits: &Limits) -> Result<Self, Failure> {
        let mut warnings = Warnings::default();
        let container::Parts { json, blob } = container::split(bytes)?;
        let document = document::parse(json, &mut warnings)?;
        if document.nodes().len() > limits.max_nodes {
            return Err(SceneErrorKind::TooManyNodes {
                limit: limits.max_nodes,
                found: document.nodes().len(),
            }
            .into());
        }
        let buffers = accessor::Buffers::load(&document, blob, &mut files)?;

        let mut images = images::Images::new(&document, &buffers, &mut files, limits.max_texture_pixels);
        let mut materials = document
            .materials()
            .map(|material| materials::convert(&material, &mut images, &mut warnings))
            .collect::<Result<Vec<_>, Failure>>()?;
        let textures = images.into_textures();
        // Primitives without a material use glTF's default one, which comes last.
        materials.push(Material::default());
        let animation = animations::read(&document, &buffers, &mut warnings)?;
        Ok(Self {
            path: path.to_owned(),
            document,
            buffers,
            materials,
            textures,
            distributions: Mutex::new(distributions::Distributions::new(files)),
            animation,
            max_triangles: limits.max_triangles,
            warnings: warnings.0,
        })
    }

    /// Whether anything moves; if not, the scene is the same at all times.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.animation.is_some()
    }

    /// The scene at a time in seconds.
    ///
    /// # Errors
    /// As those of [`load`].
    pub fn at(&self, time_s: f64) -> Result<LoadedScene, SceneError> {
        self.flatten(time_s).map_err(|failure| failure.of(&self.path))
    }

    fn flatten(&self, time_s: f64) -> Result<LoadedScene, Failure> {
        let Self { document, buffers, materials, textures, animation, .. } = self;
        let mut warnings = Warnings(self.warnings.clone());
        let motion = animation.as_ref().map(|animation| (animation, time_s));
        let look = (&materials[..], &textures[..]);
        let mut distributions = self.distributions.lock().unwrap_or_else(PoisonError::into_inner);
        let nodes::Flat {
            triangles,
            colors,
            tangents,
            objects,
            nodes,
            object_nodes,
            parents,
            lights,
            light_names,
        } = nodes::flatten(
            (document, motion),
            buffers,
            look,
            &mut distributions,
            self.max_triangles,
            &mut warnings,
        )?;
        let shared: Arc<[Texture]> = textures.iter().cloned().collect();
        let opacities = materials.iter().map(|material| Opacity::new(material, &shared)).collect();
        let geometry = Geometry::new(triangles, opacities).with_attributes(colors, tangents);
        let animation =
            animation.clone().map(|animation| Arc::new(animation.in_tree(&parents, object_nodes)));
        Ok(LoadedScene {
            geometry,
            materials: materials.clone(),
            textures: textures.clone(),
            nodes,
            objects,
            lights,
            light_names,
            time_s,
            animation,
            extras: nodes::scene_extras(document),
            emission: Emission::default(),
            warnings: warnings.0,
        })
    }
}

impl LoadedScene {
    /// What moves the points of an object from where they are in this scene to where they are at another time: world from
    /// world. `None` if the object stands still.
    #[must_use]
    pub fn motion(&self, object: u32, time_s: f64) -> Option<DMat4> {
        let animation = self.animation.as_ref().filter(|animation| animation.moves(object))?;
        let (now, then) =
            (animation.world_from_object(object, self.time_s), animation.world_from_object(object, time_s));
        (now != then).then(|| then * now.inverse())
    }
}
