//! Writing a binary glTF file.

use crate::error::WorldError;
use crate::lamp::Lamp;
use crate::mesh::{Mat, Mesh, Model};
use crate::paint::Paint;
use crate::picture::Picture;
use crate::place::Place;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// A texture of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tex(pub(crate) usize);

/// A mesh of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape(usize);

/// How a texture is read between and beyond its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sampling {
    /// Nearest texel, repeated.
    Squares,
    /// Linear, repeated.
    Repeated,
    /// Linear, clamped.
    Smooth,
}

/// A glTF document in the making.
#[derive(Default)]
pub(crate) struct Glb {
    tables: Map<String, Value>,
    bin: Vec<u8>,
    nodes: Vec<usize>,
    textured: Vec<bool>,
    paints: BTreeMap<String, Mat>,
    lights: Vec<Value>,
    extras: Map<String, Value>,
}

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

impl Glb {
    /// Appends to one of the document's arrays; returns the index.
    fn push(&mut self, table: &str, value: Value) -> usize {
        let entry = self.tables.entry(table).or_insert_with(|| json!([]));
        let Value::Array(array) = entry else { return 0 };
        array.push(value);
        array.len() - 1
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let mut view = json!({"buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len()});
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.bin.extend_from_slice(bytes);
        self.push("bufferViews", view)
    }

    fn vectors<const N: usize>(&mut self, vectors: &[[f32; N]], bounds: bool) -> usize {
        // Adding 0 turns −0 into 0.
        let bytes: Vec<u8> = vectors.iter().flatten().flat_map(|x| (x + 0.0).to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ARRAY_BUFFER));
        let mut accessor = json!({
            "bufferView": view, "componentType": 5126, "count": vectors.len(), "type": format!("VEC{N}"),
        });
        if bounds {
            let extreme = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
                (0..N).map(|i| vectors.iter().map(|v| v[i] + 0.0).reduce(pick).unwrap_or(0.0)).collect()
            };
            accessor["min"] = json!(extreme(f32::min));
            accessor["max"] = json!(extreme(f32::max));
        }
        self.push("accessors", accessor)
    }

    fn indices(&mut self, indices: &[u32], vertices: usize) -> usize {
        let small = vertices < 65536;
        let bytes: Vec<u8> = if small {
            indices.iter().flat_map(|&i| (i as u16).to_le_bytes()).collect()
        } else {
            indices.iter().flat_map(|i| i.to_le_bytes()).collect()
        };
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        let component = if small { 5123 } else { 5125 };
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": component, "count": indices.len(), "type": "SCALAR"}),
        )
    }

    /// A picture as a texture.
    ///
    /// # Errors
    /// If the encoder refuses it.
    pub(crate) fn texture(
        &mut self,
        name: &str,
        picture: &Picture,
        sampling: Sampling,
    ) -> Result<Tex, WorldError> {
        let view = self.view(&picture.png()?, None);
        let image = self.push("images", json!({"name": name, "bufferView": view, "mimeType": "image/png"}));
        if !self.tables.contains_key("samplers") {
            for (filter, wrap) in [(9728, 10497), (9729, 10497), (9729, 33071)] {
                let sampler = json!({"magFilter": filter, "minFilter": filter, "wrapS": wrap, "wrapT": wrap});
                self.push("samplers", sampler);
            }
        }
        let texture = json!({"name": name, "sampler": sampling as usize, "source": image});
        Ok(Tex(self.push("textures", texture)))
    }

    /// A material; one of the same name is taken for the same.
    pub(crate) fn material(&mut self, paint: &Paint) -> Mat {
        if let Some(&known) = self.paints.get(&paint.name) {
            return known;
        }
        let material = Mat(self.push("materials", paint.json()));
        self.textured.push(paint.texture.is_some() || paint.emissive_texture.is_some());
        self.paints.insert(paint.name.clone(), material);
        material
    }

    /// An object as a mesh, a primitive for each material.
    pub(crate) fn shape(&mut self, name: &str, model: &Model) -> Shape {
        let parts = model.parts.iter().filter(|(_, mesh)| !mesh.indices.is_empty());
        let primitives: Vec<Value> = parts.map(|(mat, mesh)| self.primitive(*mat, mesh)).collect();
        Shape(self.push("meshes", json!({"name": name, "primitives": primitives})))
    }

    fn primitive(&mut self, material: Mat, mesh: &Mesh) -> Value {
        let positions: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.to_array()).collect();
        let normals: Vec<[f32; 3]> = mesh.normals.iter().map(|n| n.to_array()).collect();
        let mut attributes =
            json!({"POSITION": self.vectors(&positions, true), "NORMAL": self.vectors(&normals, false)});
        if self.textured[material.0] {
            let uv: Vec<[f32; 2]> = mesh.uv.iter().map(|t| t.to_array()).collect();
            attributes["TEXCOORD_0"] = self.vectors(&uv, false).into();
        }
        let indices = self.indices(&mesh.indices, mesh.positions.len());
        json!({"attributes": attributes, "indices": indices, "material": material.0})
    }

    /// A node of the scene with a mesh; class and instance are for the labels.
    pub(crate) fn node(&mut self, instance: &str, class: &str, shape: Shape, place: Place) {
        self.node_with(instance, class, shape, place, Map::new());
    }

    /// The same, with more `extras`.
    pub(crate) fn node_with(
        &mut self,
        instance: &str,
        class: &str,
        shape: Shape,
        place: Place,
        extras: Map<String, Value>,
    ) {
        let node = json!({"name": instance, "mesh": shape.0});
        self.place(node, class, instance, place, extras);
    }

    /// A node with a mesh that is a part of another node's instance.
    pub(crate) fn part(&mut self, name: &str, class: &str, instance: &str, shape: Shape, place: Place) {
        let node = json!({"name": name, "mesh": shape.0});
        self.place(node, class, instance, place, Map::new());
    }

    /// A node with a lamp that belongs to `instance`; −Z of its place is the axis of a spot.
    pub(crate) fn lamp(&mut self, name: &str, class: &str, instance: &str, lamp: &Lamp, place: Place) {
        let light = lamp.json();
        let index = self.lights.iter().position(|known| *known == light).unwrap_or_else(|| {
            self.lights.push(light);
            self.lights.len() - 1
        });
        let node = json!({"name": name, "extensions": {"KHR_lights_punctual": {"light": index}}});
        let place =
            if lamp.cone_deg.is_some() { place } else { Place { rotation: [0.0, 0.0, 0.0, 1.0], ..place } };
        self.place(node, class, instance, place, Map::new());
    }

    fn place(
        &mut self,
        mut node: Value,
        class: &str,
        instance: &str,
        place: Place,
        more: Map<String, Value>,
    ) {
        let at = place.at.to_array().map(|c| c + 0.0);
        if at != [0.0; 3] {
            node["translation"] = json!(at);
        }
        if place.rotation != [0.0, 0.0, 0.0, 1.0] {
            node["rotation"] = json!(place.rotation.map(|c| c + 0.0));
        }
        let mut extras = json!({"class": class, "instance": instance});
        merge(&mut extras, Value::Object(more));
        node["extras"] = extras;
        let index = self.push("nodes", node);
        self.nodes.push(index);
    }

    /// A member of the scene's `extras`.
    pub(crate) fn note(&mut self, key: &str, value: Value) {
        self.extras.insert(key.to_owned(), value);
    }

    /// The file's bytes.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let materials = self.tables.get("materials").map(Value::to_string).unwrap_or_default();
        let mut used: Vec<&str> =
            ["KHR_materials_specular", "KHR_materials_emissive_strength", "KHR_materials_clearcoat"]
                .into_iter()
                .filter(|extension| materials.contains(extension))
                .collect();
        let mut scene = json!({"nodes": self.nodes});
        if !self.extras.is_empty() {
            scene["extras"] = Value::Object(self.extras);
        }
        let mut root = json!({"asset": {"version": "2.0", "generator": "fogbank"}});
        if !self.lights.is_empty() {
            used.push("KHR_lights_punctual");
            root["extensions"] = json!({"KHR_lights_punctual": {"lights": self.lights}});
        }
        if !used.is_empty() {
            root["extensionsUsed"] = json!(used);
        }
        root["scene"] = 0.into();
        root["scenes"] = json!([scene]);
        root["buffers"] = json!([{"byteLength": self.bin.len()}]);
        merge(&mut root, Value::Object(self.tables));
        let mut text = root.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');

        let mut out = Vec::with_capacity(28 + text.len() + self.bin.len());
        let word = |n: usize| (n as u32).to_le_bytes();
        out.extend_from_slice(b"glTF");
        out.extend(word(2));
        out.extend(word(28 + text.len() + self.bin.len()));
        for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &self.bin)] {
            out.extend(word(chunk.len()));
            out.extend_from_slice(kind);
            out.extend_from_slice(chunk);
        }
        out
    }
}

/// Adds the members of one JSON object to another.
pub(crate) fn merge(into: &mut Value, from: Value) {
    if let (Value::Object(into), Value::Object(from)) = (into, from) {
        into.extend(from);
    }
}
