//! Nodes that move.

use crate::common::{TRIANGLE, document, floats, glb};
use fog_core::Vec3A;
use fog_scene::{Limits, SceneError, SceneFile};
use serde_json::{Value, json};
use std::path::Path;

/// A triangle on node `place` below node `cart`, which moves: 0 m at 1 s, 4 m along x at 3 s; the triangle turns about y by
/// 90 degrees in the same time.
fn moving() -> (Value, Vec<u8>) {
    let (mut root, mut bin) = document(&TRIANGLE, 4);
    let mut put = |values: &[f32]| {
        let (offset, bytes) = (bin.len(), floats(values));
        bin.extend(&bytes);
        json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()})
    };
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let views = [
        put(&[1.0, 3.0]),
        put(&[0.0, 0.0, 0.0, 4.0, 0.0, 0.0]),
        put(&[0.0, 0.0, 0.0, 1.0, 0.0, half, 0.0, half]),
    ];
    root["bufferViews"].as_array_mut().unwrap().extend(views);
    let accessor = |view: usize, kind: &str| json!({"bufferView": view, "componentType": 5126, "count": 2, "type": kind});
    let mut times = accessor(1, "SCALAR");
    (times["min"], times["max"]) = (json!([1.0]), json!([3.0]));
    root["accessors"].as_array_mut().unwrap().extend([times, accessor(2, "VEC3"), accessor(3, "VEC4")]);
    root["buffers"][0]["byteLength"] = bin.len().into();
    root["nodes"] = json!([{"name": "place", "mesh": 0}, {"name": "cart", "children": [0]},
                           {"name": "still", "mesh": 0, "translation": [0, 9, 0]}]);
    root["scenes"][0]["nodes"] = json!([1, 2]);
    root["animations"] = json!([{
        "name": "drive",
        "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}},
                     {"sampler": 1, "target": {"node": 0, "path": "rotation"}}],
        "samplers": [{"input": 1, "output": 2}, {"input": 1, "output": 3}],
    }]);
    (root, bin)
}

fn open(root: &Value, bin: &[u8]) -> Result<SceneFile, SceneError> {
    SceneFile::from_bytes(Path::new("scene.glb"), &glb(root, bin), &Limits::default())
}

fn refusal(root: &Value, bin: &[u8]) -> String {
    open(root, bin).expect_err("must not load").to_string()
}

#[test]
fn nodes_are_where_they_are_at_a_time() {
    let (root, bin) = moving();
    let file = open(&root, &bin).unwrap();
    assert!(file.moves());
    let corner = |time_s: f64| {
        let scene = file.at(time_s).unwrap();
        assert_eq!((scene.time_s, scene.warnings.len()), (time_s, 0));
        let v = scene.geometry.triangles()[0].positions;
        Vec3A::from(v[1])
    };
    // The corner at x = 1 of the triangle, which turns towards −z about its own origin.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for (time, want) in [
        (0.0, Vec3A::new(1.0, 0.0, 0.0)),
        (1.0, Vec3A::new(1.0, 0.0, 0.0)),
        (2.0, Vec3A::new(2.0 + half, 0.0, -half)),
        (3.0, Vec3A::new(4.0, 0.0, -1.0)),
        (99.0, Vec3A::new(4.0, 0.0, -1.0)),
    ] {
        assert!((corner(time) - want).length() < 1e-6, "{time}: {}", corner(time));
    }
}

#[test]
fn motion_takes_points_from_one_time_to_another() {
    let (root, bin) = moving();
    let file = open(&root, &bin).unwrap();
    let (now, then) = (file.at(1.5).unwrap(), file.at(2.5).unwrap());
    let motion = now.motion(0, 2.5).expect("it moves");
    for i in 0..3 {
        let [from, to] = [&now, &then].map(|scene| scene.geometry.triangles()[0].positions[i]);
        let moved = motion.transform_point3(from.as_dvec3()).as_vec3();
        assert!((moved - to).length() < 1e-5, "{moved} {to}");
    }
    assert_eq!(now.motion(1, 2.5), None, "the other object stands still");
    assert_eq!(file.at(5.0).unwrap().motion(0, 7.0), None, "after the last key frame nothing moves");
    let animation = now.animation.as_ref().unwrap();
    assert!(animation.moves(0) && !animation.moves(1) && animation.duration_s() == 3.0);
    // Pictures are not read again for another time.
    assert_eq!(now.textures.len(), then.textures.len());
}

#[test]
fn still_scenes_have_no_animation() {
    let (mut root, bin) = moving();
    root.as_object_mut().unwrap().remove("animations");
    let file = open(&root, &bin).unwrap();
    assert!(!file.moves() && file.at(2.0).unwrap().animation.is_none());
}

#[test]
fn bad_animations_are_refused_by_name() {
    let (root, bin) = moving();
    let mut few = root.clone();
    few["accessors"][2]["count"] = 1.into();
    assert!(
        refusal(&few, &bin).contains("animation `drive`, node `cart`")
            && refusal(&few, &bin).contains("1 values for 2 key frames"),
        "{}",
        refusal(&few, &bin)
    );
    let mut backwards = bin.clone();
    let times = 36;
    backwards[times..times + 8].copy_from_slice(&floats(&[3.0, 1.0]));
    assert!(refusal(&root, &backwards).contains("times do not increase"), "{}", refusal(&root, &backwards));
    let mut nothing = bin.clone();
    nothing[times + 32..times + 48].fill(0);
    assert!(refusal(&root, &nothing).contains("not a quaternion"), "{}", refusal(&root, &nothing));
    let mut infinite = bin.clone();
    infinite[times + 8..times + 12].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert!(refusal(&root, &infinite).contains("not finite"), "{}", refusal(&root, &infinite));
    let mut far = root;
    far["accessors"][2]["bufferView"] = 0.into();
    far["accessors"][2]["byteOffset"] = 30.into();
    assert!(refusal(&far, &bin).contains("its values: reaches beyond"), "{}", refusal(&far, &bin));
}

#[test]
fn what_cannot_move_is_told() {
    let (mut root, bin) = moving();
    root["animations"][0]["channels"][0]["target"]["path"] = "weights".into();
    root["animations"].as_array_mut().unwrap().push(json!({
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}],
        "samplers": [{"input": 1, "output": 3}],
    }));
    let scene = open(&root, &bin).unwrap().at(0.0).unwrap();
    assert_eq!(
        scene.warnings,
        [
            "animation `drive`, node `cart`: moves morph targets, which are not supported",
            "animation `1`, node `place`: moves what another animation moves already; the first counts",
        ]
    );
}

#[test]
fn what_cannot_be_deformed_is_told() {
    let (mut root, bin) = moving();
    root["nodes"][2]["skin"] = 0.into();
    root["skins"] = json!([{"name": "bones", "joints": [1]}]);
    root["meshes"][0]["name"] = "cloth".into();
    root["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": 0}]);
    assert_eq!(
        open(&root, &bin).unwrap().at(0.0).unwrap().warnings,
        [
            "node `place`: morph targets of mesh `cloth` are not supported: it has its first shape",
            "node `still`: its skin `bones` is not supported: mesh `cloth` stands still where the node puts it, in the pose it \
             was bound in",
            "node `still`: morph targets of mesh `cloth` are not supported: it has its first shape",
        ]
    );
}
