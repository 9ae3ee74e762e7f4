//! Writing a binary glTF file.

use super::quads::Quads;
use fog_core::colour::{Rgb, srgb_encode};
use serde_json::{Map, Value, json};

/// A glTF document in the making.
#[derive(Default)]
pub(super) struct Glb {
    tables: Map<String, Value>,
    bin: Vec<u8>,
    nodes: Vec<usize>,
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

    fn vectors<const N: usize>(&mut self, vectors: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = vectors.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ARRAY_BUFFER));
        let extreme = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..N).map(|i| vectors.iter().map(|v| v[i]).reduce(pick).unwrap_or(0.0)).collect()
        };
        self.push(
            "accessors",
            json!({
                "bufferView": view, "componentType": 5126, "count": vectors.len(), "type": format!("VEC{N}"),
                "min": extreme(f32::min), "max": extreme(f32::max),
            }),
        )
    }

    fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": 5123, "count": indices.len(), "type": "SCALAR"}),
        )
    }

    /// A texture of 2 × 2 texels, colour a at the upper left and lower right, b at the others; it repeats, unfiltered.
    pub(super) fn checker(&mut self, name: &str, a: Rgb, b: Rgb) -> usize {
        let byte = |c: f32| (srgb_encode(c) * 255.0 + 0.5) as u8;
        let pixels: Vec<u8> = [a, b, b, a].into_iter().flatten().map(byte).collect();
        let view = self.view(&png_2x2(&pixels), None);
        let image = self.push("images", json!({"name": name, "bufferView": view, "mimeType": "image/png"}));
        if !self.tables.contains_key("samplers") {
            let repeat = json!({"magFilter": 9728, "minFilter": 9728, "wrapS": 10497, "wrapT": 10497});
            self.push("samplers", repeat);
        }
        self.push("textures", json!({"name": name, "sampler": 0, "source": image}))
    }

    /// A Lambertian material; `colour` is the JSON of `pbrMetallicRoughness`, `more` further members of the material.
    pub(super) fn lambertian(&mut self, name: &str, colour: Value, more: Value) -> usize {
        let mut pbr = json!({"metallicFactor": 0, "roughnessFactor": 1});
        let mut material =
            json!({"name": name, "extensions": {"KHR_materials_specular": {"specularFactor": 0}}});
        merge(&mut pbr, colour);
        merge(&mut material, json!({"pbrMetallicRoughness": pbr}));
        merge(&mut material, more);
        self.push("materials", material)
    }

    /// A mesh of one material.
    pub(super) fn mesh(&mut self, name: &str, quads: &Quads, material: usize) -> usize {
        let mut attributes = json!({
            "POSITION": self.vectors(&quads.positions), "NORMAL": self.vectors(&quads.normals),
        });
        if !quads.uv.is_empty() {
            attributes["TEXCOORD_0"] = self.vectors(&quads.uv).into();
        }
        let indices = self.indices(&quads.indices);
        let primitive = json!({"attributes": attributes, "indices": indices, "material": material});
        self.push("meshes", json!({"name": name, "primitives": [primitive]}))
    }

    /// A node of the scene with a mesh; class and instance are for the labels.
    pub(super) fn node(&mut self, name: &str, class: &str, mesh: usize, translation: Option<[f32; 3]>) {
        let mut node = json!({"name": name, "mesh": mesh});
        if let Some(translation) = translation {
            node["translation"] = json!(translation);
        }
        node["extras"] = json!({"class": class, "instance": name});
        let index = self.push("nodes", node);
        self.nodes.push(index);
    }

    /// The file's bytes.
    pub(super) fn finish(mut self) -> Vec<u8> {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let materials = self.tables.get("materials").map(Value::to_string).unwrap_or_default();
        let used: Vec<&str> = ["KHR_materials_specular", "KHR_materials_emissive_strength"]
            .into_iter()
            .filter(|extension| materials.contains(extension))
            .collect();
        let mut root = json!({
            "asset": {"version": "2.0", "generator": "fogbank"},
            "extensionsUsed": used,
            "scene": 0,
            "scenes": [{"nodes": self.nodes}],
            "buffers": [{"byteLength": self.bin.len()}],
        });
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
fn merge(into: &mut Value, from: Value) {
    if let (Value::Object(into), Value::Object(from)) = (into, from) {
        into.extend(from);
    }
}

/// PNG of 2 × 2 RGB pixels, written by hand (stored, not compressed): the same bytes with every version of any encoder.
fn png_2x2(rgb: &[u8]) -> Vec<u8> {
    let mut out = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |kind: &[u8; 4], data: &[u8]| {
        let body: Vec<u8> = kind.iter().chain(data).copied().collect();
        out.extend((data.len() as u32).to_be_bytes());
        out.extend_from_slice(&body);
        out.extend(crc32(&body).to_be_bytes());
    };
    chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 2, 8, 2, 0, 0, 0]);
    // Each row begins with filter type 0.
    let rows: Vec<u8> = rgb.chunks(6).flat_map(|row| [0u8].into_iter().chain(row.iter().copied())).collect();
    let length = rows.len() as u16;
    let mut zlib = vec![0x78, 0x01, 0x01];
    zlib.extend(length.to_le_bytes());
    zlib.extend((!length).to_le_bytes());
    zlib.extend_from_slice(&rows);
    zlib.extend(adler32(&rows).to_be_bytes());
    chunk(b"IDAT", &zlib);
    chunk(b"IEND", &[]);
    out
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { c >> 1 ^ 0xedb8_8320 } else { c >> 1 })
    })
}

fn adler32(bytes: &[u8]) -> u32 {
    let (a, b) = bytes.iter().fold((1u32, 0u32), |(a, b), &byte| {
        let a = (a + u32::from(byte)) % 65521;
        (a, (b + a) % 65521)
    });
    b << 16 | a
}
