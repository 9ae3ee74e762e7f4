//! Making and loading scenes.

use fog_core::Vec3A;
use fog_scene::{Limits, LoadedScene, load};
use fog_worlds::World;
use serde_json::Value;
use std::path::PathBuf;

/// A file of the repository.
pub(crate) fn repository(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// A scene, loaded, and its JSON.
pub(crate) struct Made {
    pub(crate) scene: LoadedScene,
    pub(crate) json: Value,
}

/// Makes a scene with seed 1 and loads it; it must give no warnings.
pub(crate) fn made(world: &World) -> Made {
    let bytes = world.glb(1).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("w.glb");
    std::fs::write(&path, &bytes).unwrap();
    let scene = load(&path, &Limits::default()).unwrap();
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    Made { scene, json: json(&bytes) }
}

/// The JSON chunk of a GLB.
pub(crate) fn json(glb: &[u8]) -> Value {
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&glb[20..20 + length]).unwrap()
}

impl Made {
    /// Nodes whose name begins so.
    pub(crate) fn nodes(&self, prefix: &str) -> Vec<&Value> {
        let begins = |n: &&Value| n["name"].as_str().unwrap().starts_with(prefix);
        self.json["nodes"].as_array().unwrap().iter().filter(begins).collect()
    }

    /// Class of the surface that is seen from `from` along `direction`, and how far away it is.
    pub(crate) fn seen(&self, from: [f32; 3], direction: [f32; 3]) -> (String, f32) {
        let geometry = &self.scene.geometry;
        let direction = Vec3A::from(direction).normalize();
        let hit = geometry.intersect(Vec3A::from(from), direction, 1e5).unwrap();
        let object = geometry.surface(&hit).object as usize;
        (self.scene.objects[object].class.clone().unwrap(), hit.t)
    }

    /// Class of what lies on the ground.
    pub(crate) fn below(&self, x: f32, z: f32) -> String {
        self.seen([x, 60.0, z], [0.0, -1.0, 0.0]).0
    }
}

/// Where a node is.
pub(crate) fn translation(node: &Value) -> [f32; 3] {
    let at = |i: usize| node["translation"][i].as_f64().unwrap_or(0.0) as f32;
    [at(0), at(1), at(2)]
}
