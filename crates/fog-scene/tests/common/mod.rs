//! Small glTF files for tests.
#![allow(dead_code, unreachable_pub, missing_docs)]

use fog_scene::{Limits, LoadedScene, SceneError, load};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A GLB of a JSON text and a binary chunk.
pub fn glb(root: &Value, bin: &[u8]) -> Vec<u8> {
    let mut text = root.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut out = b"glTF\x02\0\0\0".to_vec();
    out.extend((28 + text.len() as u32 + bin.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &bin)] {
        out.extend((chunk.len() as u32).to_le_bytes());
        out.extend_from_slice(kind);
        out.extend_from_slice(chunk);
    }
    out
}

pub fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// A document with one mesh `thing` (mode and vertices given) on one node `place`, in buffer 0.
pub fn document(vertices: &[[f32; 3]], mode: u32) -> (Value, Vec<u8>) {
    let bin = floats(vertices.as_flattened());
    let root = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "place", "mesh": 0}],
        "meshes": [{"name": "thing", "primitives": [{"attributes": {"POSITION": 0}, "mode": mode}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": vertices.len(), "type": "VEC3",
                       "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 1.0]}],
        "bufferViews": [{"buffer": 0, "byteLength": bin.len()}],
        "buffers": [{"byteLength": bin.len()}],
    });
    (root, bin)
}

pub const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Writes bytes to a file in a new folder and loads it.
pub fn load_bytes(name: &str, bytes: &[u8]) -> Result<LoadedScene, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    load(&path, &Limits::default())
}

/// Message of a GLB that must not load.
pub fn refusal(root: &Value, bin: &[u8]) -> String {
    let error = load_bytes("scene.glb", &glb(root, bin)).expect_err("must not load").to_string();
    assert!(error.contains("scene.glb"), "{error}");
    error
}

pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub fn data(name: &str) -> PathBuf {
    repository().join("tests/data").join(name)
}

/// A PNG of one row of texels.
pub fn png(texels: &[[u8; 4]]) -> Vec<u8> {
    let mut out = std::io::Cursor::new(Vec::new());
    let pixels = image::RgbaImage::from_raw(texels.len() as u32, 1, texels.as_flattened().to_vec()).unwrap();
    pixels.write_to(&mut out, image::ImageFormat::Png).unwrap();
    out.into_inner()
}

/// Puts bytes behind a document's binary chunk as a new buffer view; its index.
pub fn append(root: &mut Value, bin: &mut Vec<u8>, bytes: &[u8]) -> usize {
    bin.resize(bin.len().next_multiple_of(4), 0);
    let views = root["bufferViews"].as_array_mut().unwrap();
    views.push(json!({"buffer": 0, "byteOffset": bin.len(), "byteLength": bytes.len()}));
    let view = views.len() - 1;
    bin.extend_from_slice(bytes);
    root["buffers"][0]["byteLength"] = bin.len().into();
    view
}

/// Gives the document's mesh an attribute of this component type (glTF's number).
pub fn attribute(
    root: &mut Value,
    bin: &mut Vec<u8>,
    semantic: &str,
    kind: &str,
    component: u32,
    bytes: &[u8],
) {
    let view = append(root, bin, bytes);
    let count = root["accessors"][0]["count"].clone();
    let accessors = root["accessors"].as_array_mut().unwrap();
    accessors.push(json!({"bufferView": view, "componentType": component, "count": count, "type": kind,
                          "normalized": component != 5126}));
    root["meshes"][0]["primitives"][0]["attributes"][semantic] = (accessors.len() - 1).into();
}

/// A triangle with texture coordinates (u along x, v down from y = 1) and a material that reads the texture of `texels`.
pub fn textured(texels: &[[u8; 4]], material: Value) -> (Value, Vec<u8>) {
    let (mut root, mut bin) = document(&TRIANGLE, 4);
    attribute(&mut root, &mut bin, "TEXCOORD_0", "VEC2", 5126, &floats(&[0.0, 1.0, 1.0, 1.0, 0.0, 0.0]));
    let view = append(&mut root, &mut bin, &png(texels));
    root["images"] = json!([{"name": "skin", "bufferView": view, "mimeType": "image/png"}]);
    root["samplers"] = json!([{"magFilter": 9728, "wrapS": 33071, "wrapT": 33071}]);
    root["textures"] = json!([{"source": 0, "sampler": 0}]);
    root["materials"] = json!([material]);
    root["meshes"][0]["primitives"][0]["material"] = 0.into();
    (root, bin)
}
