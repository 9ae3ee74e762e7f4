//! Walking the node tree: every mesh instance becomes triangles in world space.

use super::accessor::Buffers;
use super::distributions::Distributions;
use super::primitives::{self, Primitive, mesh_name};
use super::{SceneNode, SceneObject, Warnings, lights};
use crate::animation::Animation;
use crate::attributes::CornerValues;
use crate::error::{Failure, SceneErrorKind};
use crate::lamp::{LightNames, PunctualLights};
use crate::material::Material;
use crate::texture::Texture;
use crate::triangle::Triangle;
use glam::{DMat3, DMat4, DQuat, DVec3, Vec3};
use gltf::scene::Transform;
use gltf::{Document, Mesh, Node};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Vertices farther than this from the origin are refused, in metres.
pub(super) const FARTHEST: f64 = 1e9;

/// The scene without its hierarchy.
#[derive(Default)]
pub(super) struct Flat {
    pub(super) triangles: Vec<Triangle>,
    pub(super) colors: CornerValues,
    pub(super) tangents: CornerValues,
    pub(super) nodes: Vec<SceneNode>,
    pub(super) objects: Vec<SceneObject>,
    /// glTF's index of each object's node.
    pub(super) object_nodes: Vec<usize>,
    /// The node above each node; none of those of the scene itself, and of those that are not in it.
    pub(super) parents: Vec<Option<usize>>,
    pub(super) lights: PunctualLights,
    pub(super) light_names: LightNames,
}

/// The animation that moves the nodes, and the time.
type Motion<'a> = Option<(&'a Animation, f64)>;

/// What a node hands down to its children.
#[derive(Clone)]
struct Inherited {
    node: Option<u32>,
    world: DMat4,
    class: Option<Rc<str>>,
    instance: Option<Rc<str>>,
}

/// The default scene, or the first.
fn default_scene(document: &Document) -> Option<gltf::Scene<'_>> {
    document.default_scene().or_else(|| document.scenes().next())
}

/// `extras` of that scene; null if it has none.
pub(super) fn scene_extras(document: &Document) -> serde_json::Value {
    let scene = default_scene(document);
    let extras = scene.as_ref().and_then(|scene| scene.extras().as_ref());
    extras.and_then(|extras| serde_json::from_str(extras.get()).ok()).unwrap_or_default()
}

/// Collects the triangles of the default scene, or of the first. The last of `materials` is the default one. With an animation
/// everything is where it is at the time.
pub(super) fn flatten(
    (document, motion): (&Document, Motion<'_>),
    buffers: &Buffers,
    look: (&[Material], &[Texture]),
    distributions: &mut Distributions,
    max_triangles: usize,
    warnings: &mut Warnings,
) -> Result<Flat, Failure> {
    let scene = default_scene(document).ok_or_else(|| SceneErrorKind::Invalid("it has no scene".into()))?;
    let mut flat = Flat::default();
    let mut meshes = Meshes::new(buffers, look, max_triangles);

    let root = Inherited { node: None, world: DMat4::IDENTITY, class: None, instance: None };
    let mut open: Vec<(Node<'_>, Inherited)> = scene.nodes().map(|node| (node, root.clone())).collect();
    open.reverse();
    let mut seen = vec![false; document.nodes().len()];
    flat.parents = vec![None; seen.len()];
    while let Some((node, above)) = open.pop() {
        let name = node_name(&node);
        let place = || format!("node `{name}`");
        // A tree meets each node once: this also ends cycles.
        if core::mem::replace(&mut seen[node.index()], true) {
            let text = "is below itself, or has two parents: nodes must form a tree";
            return Err(SceneErrorKind::Node(text.into()).at(place));
        }
        let here = add_node(&node, &name, &above, motion, &mut flat).map_err(|e| e.at(place))?;
        if let Some(light) = node.light() {
            let out = (&mut flat.lights, &mut flat.light_names);
            lights::place((&light, &node), (&name, &here.world), distributions, out, warnings)?;
        }
        if let Some(mesh) = node.mesh() {
            flat.object_nodes.push(node.index());
            warn_of_deformation(&node, &mesh, &name, warnings);
            meshes.place(&mesh, &name, &here, &mut flat, warnings)?;
        }
        for child in node.children() {
            flat.parents[child.index()] = Some(node.index());
        }
        let first_child = open.len();
        open.extend(node.children().map(|child| (child, here.clone())));
        open[first_child..].reverse();
    }
    if meshes.degenerate > 0 {
        warnings.add(format!("{} triangles without area were left out", meshes.degenerate));
    }
    Ok(flat)
}

/// Skins and morph targets are not supported: says of which node, and what is seen instead.
fn warn_of_deformation(node: &Node<'_>, mesh: &Mesh<'_>, name: &str, warnings: &mut Warnings) {
    if let Some(skin) = node.skin() {
        let skin = skin.name().map_or_else(|| skin.index().to_string(), str::to_owned);
        warnings.add(format!(
            "node `{name}`: its skin `{skin}` is not supported: mesh `{}` stands still where the node puts it, in the pose it was \
             bound in",
            mesh_name(mesh)
        ));
    }
    if mesh.primitives().any(|primitive| primitive.morph_targets().len() > 0) {
        warnings.add(format!(
            "node `{name}`: morph targets of mesh `{}` are not supported: it has its first shape",
            mesh_name(mesh)
        ));
    }
}

/// Adds a node to the list of all; what it hands down.
fn add_node(
    node: &Node<'_>,
    name: &str,
    above: &Inherited,
    motion: Motion<'_>,
    flat: &mut Flat,
) -> Result<Inherited, SceneErrorKind> {
    let mesh = node.mesh();
    let label = |key: &str| {
        let of_mesh = || mesh.as_ref().and_then(|mesh| text(mesh.extras(), key));
        text(node.extras(), key).or_else(of_mesh)
    };
    let (class, instance) = (label("class"), label("instance"));
    let local = match motion {
        Some((animation, time_s)) => animation.nodes[node.index()].local_at(time_s),
        None => local_transform(node)?,
    };
    let world = above.world * local;
    flat.nodes.push(SceneNode {
        name: name.to_owned(),
        parent: above.node,
        class: owned(&class),
        instance: owned(&instance),
        keypoints: keypoints(node.extras()),
        world,
    });
    Ok(Inherited {
        node: Some(flat.nodes.len() as u32 - 1),
        world,
        class: class.or_else(|| above.class.clone()),
        instance: instance.or_else(|| above.instance.clone()),
    })
}

fn owned(label: &Option<Rc<str>>) -> Option<String> {
    label.as_deref().map(str::to_owned)
}

/// The meshes of a document, each read once, and how many triangles may still be placed.
struct Meshes<'a> {
    buffers: &'a Buffers,
    look: (&'a [Material], &'a [Texture]),
    max_triangles: usize,
    left: usize,
    /// Triangles without area.
    degenerate: u64,
    known: BTreeMap<usize, Rc<[Primitive]>>,
}

impl<'a> Meshes<'a> {
    fn new(buffers: &'a Buffers, look: (&'a [Material], &'a [Texture]), max_triangles: usize) -> Self {
        // Triangles are counted in 31 bits.
        let max_triangles = max_triangles.min(i32::MAX as usize);
        Self { buffers, look, max_triangles, left: max_triangles, degenerate: 0, known: BTreeMap::new() }
    }

    fn read(&mut self, mesh: &Mesh<'_>, warnings: &mut Warnings) -> Result<Rc<[Primitive]>, Failure> {
        if let Some(known) = self.known.get(&mesh.index()) {
            return Ok(Rc::clone(known));
        }
        let read = primitives::read(mesh, self.buffers, self.look, self.max_triangles, warnings)?;
        check_texture_sets(&read, &mesh_name(mesh), self.look.0, warnings);
        let read: Rc<[Primitive]> = read.into();
        self.known.insert(mesh.index(), Rc::clone(&read));
        Ok(read)
    }

    /// Adds the mesh of the node that was added last, of this name.
    fn place(
        &mut self,
        mesh: &Mesh<'_>,
        name: &str,
        here: &Inherited,
        flat: &mut Flat,
        warnings: &mut Warnings,
    ) -> Result<(), Failure> {
        let primitives = self.read(mesh, warnings)?;
        let object = flat.objects.len() as u32;
        flat.objects.push(SceneObject {
            node: flat.nodes.len() as u32 - 1,
            name: name.to_owned(),
            mesh: mesh.name().map(str::to_owned),
            class: owned(&here.class),
            instance: owned(&here.instance),
        });
        for primitive in primitives.iter() {
            let too_many = || SceneErrorKind::TooManyTriangles { limit: self.max_triangles };
            self.left = self.left.checked_sub(primitive.triangles.len()).ok_or_else(too_many)?;
            let material = primitive.material.unwrap_or(self.look.0.len() - 1) as u32;
            let place = || format!("node `{name}`, mesh `{}`", mesh_name(mesh));
            self.degenerate +=
                place_triangles(primitive, &here.world, material, object, flat).map_err(|e| e.at(place))?;
        }
        Ok(())
    }
}

pub(super) fn node_name(node: &Node<'_>) -> String {
    let of_mesh = || node.mesh().and_then(|mesh| mesh.name().map(str::to_owned));
    node.name().map(str::to_owned).or_else(of_mesh).unwrap_or_else(|| format!("node {}", node.index()))
}

/// A member of `extras`.
pub(super) fn extra(extras: &gltf::json::Extras, key: &str) -> Option<serde_json::Value> {
    let mut extras: serde_json::Value = serde_json::from_str(extras.as_ref()?.get()).ok()?;
    extras.get_mut(key).map(serde_json::Value::take)
}

/// A string in `extras`.
pub(super) fn text(extras: &gltf::json::Extras, key: &str) -> Option<Rc<str>> {
    extra(extras, key)?.as_str().map(Rc::from)
}

/// Points in `extras` that are three finite numbers.
fn keypoints(extras: &gltf::json::Extras) -> Vec<(String, DVec3)> {
    let Some(extras) = extras.as_ref() else { return Vec::new() };
    let Ok(extras) = serde_json::from_str::<serde_json::Value>(extras.get()) else { return Vec::new() };
    let own = extras["keypoint"].as_str().map(|name| (name.to_owned(), DVec3::ZERO));
    let listed = extras["keypoints"].as_object().into_iter().flatten().filter_map(|(name, point)| {
        let [x, y, z] = point.as_array()?.as_slice() else { return None };
        let point = DVec3::new(x.as_f64()?, y.as_f64()?, z.as_f64()?);
        point.is_finite().then(|| (name.clone(), point))
    });
    own.into_iter().chain(listed).collect()
}

/// A node's own matrix, in f64.
pub(super) fn local_transform(node: &Node<'_>) -> Result<DMat4, SceneErrorKind> {
    let matrix = match node.transform() {
        Transform::Matrix { matrix } => {
            DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from)))
        }
        Transform::Decomposed { translation, rotation, scale } => {
            let rotation = DQuat::from_array(rotation.map(f64::from));
            let Some(inverse_length) = Some(rotation.length_recip()).filter(|l| l.is_finite()) else {
                return Err(SceneErrorKind::Node("has a rotation that is not a quaternion".into()));
            };
            DMat4::from_scale_rotation_translation(
                DVec3::from_array(scale.map(f64::from)),
                rotation * inverse_length,
                DVec3::from_array(translation.map(f64::from)),
            )
        }
    };
    let last_row = matrix.row(3).to_array();
    if !matrix.is_finite() || last_row != [0.0, 0.0, 0.0, 1.0] {
        return Err(SceneErrorKind::Node("has a matrix that is not finite or not affine".into()));
    }
    Ok(matrix)
}

/// Appends a primitive's triangles in world space; returns how many were dropped for having no area.
fn place_triangles(
    primitive: &Primitive,
    world: &DMat4,
    material: u32,
    object: u32,
    out: &mut Flat,
) -> Result<u64, SceneErrorKind> {
    // Normals turn with the cofactor matrix, det · inverse transpose; a mirror also turns the winding.
    let linear = DMat3::from_mat4(*world);
    let mirrored = linear.determinant() < 0.0;
    let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
    let cofactor = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * if mirrored { -1.0 } else { 1.0 };

    let mut dropped = 0;
    for (index, &vertices) in primitive.triangles.iter().enumerate() {
        let turned = |[a, b, c]: [u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        let corners = turned(vertices);
        let mut positions = [Vec3::ZERO; 3];
        for (position, vertex) in positions.iter_mut().zip(corners) {
            let local = DVec3::from_array(primitive.positions[vertex as usize].map(f64::from));
            let point = world.transform_point3(local);
            // Comparison with NaN is false: it is refused too.
            if !point.to_array().iter().all(|c| c.abs() <= FARTHEST) {
                return Err(SceneErrorKind::Vertex { vertex, position: point.to_array() });
            }
            *position = point.as_vec3();
        }
        let mut triangle = Triangle { material, object, ..Triangle::flat(positions) };
        if triangle.is_degenerate() {
            dropped += 1;
            continue;
        }
        if !primitive.normals.is_empty() {
            let flat = triangle.normals[0];
            triangle.normals = corners.map(|vertex| {
                let local = DVec3::from_array(primitive.normals[vertex as usize].map(f64::from));
                (cofactor * local).try_normalize().map_or(flat, DVec3::as_vec3)
            });
            // Normals that all point behind the winding's front were exported inside out: the winding decides.
            if triangle.normals.iter().all(|n| n.dot(flat) < 0.0) {
                triangle.normals = triangle.normals.map(|n| -n);
            }
        }
        for (uv, set) in triangle.uv.iter_mut().zip(&primitive.uv) {
            *uv = corners.map(|vertex| set.get(vertex as usize).copied().unwrap_or_default());
        }
        let id = out.triangles.len() as u32;
        if !primitive.colors.is_empty() {
            out.colors.push(id, corners.map(|vertex| primitive.colors[vertex as usize]));
        }
        if let Some(tangents) = primitive.tangents.get(index) {
            // A mirror turns the side that the bitangent is on.
            let sign = if mirrored { -1.0 } else { 1.0 };
            let placed = tangents.map(|[x, y, z, w]| {
                let world = linear * DVec3::new(x.into(), y.into(), z.into());
                let [x, y, z] = world.normalize_or_zero().as_vec3().to_array();
                [x, y, z, w * sign]
            });
            out.tangents.push(id, turned([0, 1, 2]).map(|corner| placed[corner as usize]));
        }
        out.triangles.push(triangle);
    }
    Ok(dropped)
}

/// Warns where a material reads texture coordinates that a mesh does not have.
fn check_texture_sets(primitives: &[Primitive], mesh: &str, materials: &[Material], warnings: &mut Warnings) {
    for primitive in primitives {
        let Some(material) = primitive.material.and_then(|index| materials.get(index)) else { continue };
        for texture in material.textures() {
            if primitive.uv[usize::from(texture.set & 1)].is_empty() && !primitive.positions.is_empty() {
                warnings.add(format!(
                    "mesh `{mesh}` has no TEXCOORD_{} for material `{}`: its texture is read at (0, 0)",
                    texture.set, material.name
                ));
            }
        }
    }
}
