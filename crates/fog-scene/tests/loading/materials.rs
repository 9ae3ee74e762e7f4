//! Materials in files: colours of vertices, transforms of textures, normal maps, alpha, extensions.

use crate::common::{attribute, floats, glb, load_bytes, refusal, textured};
use fog_core::Vec3A;
use fog_core::math::PI_F32;
use fog_core::spectrum::Spectrum;
use fog_scene::scene::Scene;
use fog_scene::{AlphaMode, LoadedScene};
use serde_json::{Value, json};
use std::sync::Arc;

const GREY: [Spectrum; 3] = [Spectrum([1.0 / 3.0; 8]); 3];

fn loaded(root: &Value, bin: &[u8]) -> LoadedScene {
    load_bytes("scene.glb", &glb(root, bin)).unwrap()
}

/// Values of the material at a point of the triangle.
fn base_color(scene: &LoadedScene, u: f32, v: f32) -> [f32; 3] {
    let triangle = scene.geometry.triangles()[0];
    scene.materials[0].evaluate(&scene.textures, &triangle.uv_at(u, v)).base_color
}

#[test]
fn vertex_colours_of_all_kinds() {
    let chalk = json!({"pbrMetallicRoughness": {"metallicFactor": 0}});
    let kinds: [(&str, u32, Vec<u8>); 3] = [
        ("VEC3", 5126, floats(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 7.0])),
        ("VEC4", 5121, vec![255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255]),
        (
            "VEC4",
            5123,
            [65535u16, 0, 0, 65535, 0, 65535, 0, 65535, 0, 0, 65535, 65535].map(u16::to_le_bytes).concat(),
        ),
    ];
    for (kind, component, bytes) in kinds {
        let (mut root, mut bin) = textured(&[[255; 4]], chalk.clone());
        attribute(&mut root, &mut bin, "COLOR_0", kind, component, &bytes);
        let scene = loaded(&root, &bin);
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        let hit = scene.geometry.intersect(Vec3A::new(0.25, 0.25, 1.0), Vec3A::NEG_Z, 9.0).unwrap();
        assert_eq!(scene.geometry.colors().at(&hit), Some([0.5, 0.25, 0.25, 1.0]), "{kind} {component}");
    }
    let (mut root, mut bin) = textured(&[[255; 4]], chalk);
    attribute(&mut root, &mut bin, "COLOR_0", "VEC3", 5126, &floats(&[f32::NAN; 9]));
    let message = refusal(&root, &bin);
    assert!(message.contains("mesh `thing`, primitive 0: COLOR_0 of vertex 0 is [NaN"), "{message}");
}

#[test]
fn vertex_alpha_cuts_and_blends() {
    let (mut root, mut bin) = textured(&[[255; 4]], json!({"alphaMode": "MASK"}));
    let alpha = floats(&[1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    attribute(&mut root, &mut bin, "COLOR_0", "VEC4", 5126, &alpha);
    let seen = |scene: &LoadedScene, x: f32| {
        scene.geometry.intersect(Vec3A::new(x, 0.1, 1.0), Vec3A::NEG_Z, 9.0).is_some()
    };
    let scene = loaded(&root, &bin);
    assert!(seen(&scene, 0.6) && !seen(&scene, 0.2) && !scene.geometry.has_partial_opacity());
    root["materials"][0]["alphaMode"] = "BLEND".into();
    let scene = loaded(&root, &bin);
    assert_eq!(scene.materials[0].alpha_mode, AlphaMode::Blend);
    assert!(seen(&scene, 0.6) && !seen(&scene, 0.2), "without chance, half coverage decides");
    let n = 20_000u64;
    for x in [0.1f32, 0.3, 0.7] {
        let origin = Vec3A::new(x, 0.1, 1.0);
        let stops = |key| scene.geometry.intersect_by_chance(origin, Vec3A::NEG_Z, 9.0, key).is_some();
        let hits = (0..n).filter(|&key| stops(key)).count();
        assert!((hits as f64 / n as f64 - f64::from(x + 0.1)).abs() < 0.02, "{hits} at {x}");
        let occluded = |key| scene.geometry.occluded_by_chance(origin, Vec3A::NEG_Z, 9.0, key);
        assert!((0..100).all(|key| stops(key) == occluded(key) && stops(key) == stops(key)));
    }
}

#[test]
fn textures_are_moved_and_sets_chosen() {
    let red_to_blue = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 255]];
    let info = |extra: Value| {
        json!({"pbrMetallicRoughness": {"metallicFactor": 0,
               "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": extra}}}})
    };
    let color = |extra: Value, u: f32, v: f32| {
        let (mut root, mut bin) = textured(&red_to_blue, info(extra));
        let second = floats(&[0.9, 0.0, 0.9, 0.0, 0.9, 0.0]);
        attribute(&mut root, &mut bin, "TEXCOORD_1", "VEC2", 5126, &second);
        root["extensionsRequired"] = json!(["KHR_texture_transform"]);
        let scene = loaded(&root, &bin);
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        base_color(&scene, u, v)
    };
    assert_eq!(color(json!({}), 0.1, 0.0), [1.0, 0.0, 0.0]);
    assert_eq!(color(json!({"offset": [0.25, 0]}), 0.1, 0.0), [0.0, 1.0, 0.0]);
    assert_eq!(color(json!({"scale": [5, 1]}), 0.1, 0.0), [0.0, 0.0, 1.0]);
    // A quarter turn: u' = v, which falls from 1 at the lower corners to 0 at the upper one.
    assert_eq!(color(json!({"rotation": PI_F32 / 2.0}), 0.1, 0.9), [1.0, 0.0, 0.0]);
    assert_eq!(color(json!({"rotation": PI_F32 / 2.0}), 0.1, 0.1), [1.0, 1.0, 1.0]);
    assert_eq!(color(json!({"texCoord": 1}), 0.1, 0.1), [1.0, 1.0, 1.0]);

    for (extra, message) in [
        (json!({"offset": ["a", 0]}), "offset of KHR_texture_transform is \"a\", must be a number"),
        (json!({"offset": 3}), "offset of KHR_texture_transform is 3, must be two numbers"),
        (json!({"scale": [1e39, 1]}), "scale of KHR_texture_transform is inf, must be a finite number"),
        (json!({"texCoord": 2}), "uses TEXCOORD_2; only sets 0 and 1"),
        (json!({"texCoord": -1}), "texCoord of KHR_texture_transform is -1"),
    ] {
        let (root, bin) = textured(&red_to_blue, info(extra));
        let error = refusal(&root, &bin);
        assert!(error.contains("material `material 0`: ") && error.contains(message), "{error}");
    }
}

/// The normal that chalk on the only triangle is shaded with: of a Lambertian surface, value / reflectance · π = wi · n.
fn shading_normal(scene: LoadedScene, view: Vec3A) -> Vec3A {
    let scene = Scene::new(Arc::new(scene), None, None, None, false);
    let bounds = scene.loaded().geometry.bounds().unwrap();
    // Not a corner and not on the diagonal of the bounds.
    let target = bounds[0] + (bounds[1] - bounds[0]) * 0.3;
    let hit = scene.intersect(target - view, view, 2.0).unwrap();
    let surface = scene.surface(&hit, view, &GREY);
    let bsdf = surface.bsdf.unwrap();
    let to_local = surface.world_from_shading.transpose();
    let n = surface.normal;
    let value = |w: Vec3A| {
        let w = w.normalize();
        bsdf.eval(to_local * -view, to_local * w).0[0] * PI_F32
    };
    let [x, y] = [n.any_orthonormal_vector(), n.cross(n.any_orthonormal_vector())];
    let slope = |along: Vec3A| (value(n + along * 0.1) - value(n - along * 0.1)) * 1.01f32.sqrt() / 0.2;
    n * value(n) + x * slope(x) + y * slope(y)
}

fn chalk_with_normal(red: u8, green: u8) -> (Value, Vec<u8>) {
    textured(
        &[[red, green, 220, 255]],
        json!({"pbrMetallicRoughness": {"metallicFactor": 0}, "normalTexture": {"index": 0}, "doubleSided": true,
               "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}),
    )
}

/// What a texel of these bytes means.
fn decoded(red: u8, green: u8) -> Vec3A {
    let c = |byte: u8| f32::from(byte) / 127.5 - 1.0;
    Vec3A::new(c(red), c(green), c(220)).normalize()
}

fn assert_near(got: Vec3A, want: Vec3A) {
    assert!((got - want).length() < 2e-3, "{got} for {want}");
}

#[test]
fn normal_maps_turn_normals() {
    // u runs along x and v along −y: red leans to +x, green (up in the image) to +y.
    let normal = decoded(200, 90);
    let (mut root, bin) = chalk_with_normal(200, 90);
    assert_near(shading_normal(loaded(&root, &bin), Vec3A::NEG_Z), normal);
    // The back is the negative of the front: bumps are dents.
    assert_near(shading_normal(loaded(&root, &bin), Vec3A::Z), -normal);
    // Turned, stretched and mirrored nodes take the texture with them.
    root["nodes"][0]["rotation"] = json!([0, 0, 0.5f32.sqrt(), 0.5f32.sqrt()]);
    assert_near(shading_normal(loaded(&root, &bin), Vec3A::NEG_Z), Vec3A::new(-normal.y, normal.x, normal.z));
    root["nodes"][0]["rotation"] = json!([0, 0, 0, 1]);
    root["nodes"][0]["scale"] = json!([-1, 1, 1]);
    assert_near(shading_normal(loaded(&root, &bin), Vec3A::NEG_Z), Vec3A::new(-normal.x, normal.y, normal.z));
    // Turned textures turn their tangents.
    root["nodes"][0]["scale"] = json!([1, 1, 1]);
    let quarter = json!({"rotation": PI_F32 / 2.0});
    root["materials"][0]["normalTexture"]["extensions"] = json!({"KHR_texture_transform": quarter});
    // u' = v, v' = −u: red leans to −y, green to +x.
    assert_near(shading_normal(loaded(&root, &bin), Vec3A::NEG_Z), Vec3A::new(normal.y, -normal.x, normal.z));
    root["materials"][0]["normalTexture"]["extensions"] = json!({});
    root["materials"][0]["normalTexture"]["scale"] = 0.5.into();
    let halved = Vec3A::new(0.5 * normal.x, 0.5 * normal.y, normal.z).normalize();
    assert_near(shading_normal(loaded(&root, &bin), Vec3A::NEG_Z), halved);
}

#[test]
fn tangents_of_the_file_win_where_it_has_normals() {
    let normal = decoded(200, 90);
    let (mut root, mut bin) = chalk_with_normal(200, 90);
    // Tangent +y, bitangent sign −1: B = −(z × y) = +x.
    attribute(&mut root, &mut bin, "TANGENT", "VEC4", 5126, &floats(&[0.0, 1.0, 0.0, -1.0].repeat(3)));
    assert_near(shading_normal(loaded(&root, &bin), Vec3A::NEG_Z), normal);
    attribute(&mut root, &mut bin, "NORMAL", "VEC3", 5126, &floats(&[0.0, 0.0, 1.0].repeat(3)));
    assert_near(shading_normal(loaded(&root, &bin), Vec3A::NEG_Z), Vec3A::new(normal.y, normal.x, normal.z));
    // Without texture coordinates there is no map.
    let attributes = root["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap();
    attributes.remove("TANGENT");
    attributes.remove("TEXCOORD_0");
    let scene = loaded(&root, &bin);
    assert!(scene.warnings[0].contains("no TEXCOORD_0"), "{:?}", scene.warnings);
    assert_near(shading_normal(scene, Vec3A::NEG_Z), Vec3A::Z);
}

#[test]
fn extensions_are_read() {
    let texels = [[128, 64, 255, 51]];
    let (mut root, bin) = textured(
        &texels,
        json!({"name": "paint", "pbrMetallicRoughness": {"metallicFactor": 0},
        "extensions": {
            "KHR_materials_specular": {"specularTexture": {"index": 0}, "specularColorTexture": {"index": 0}},
            "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatTexture": {"index": 0},
                "clearcoatRoughnessFactor": 0.5, "clearcoatRoughnessTexture": {"index": 0, "texCoord": 0},
                "clearcoatNormalTexture": {"index": 0}},
            "KHR_materials_transmission": {"transmissionFactor": 0.5, "transmissionTexture": {"index": 0}},
        }}),
    );
    root["extensionsRequired"] =
        json!(["KHR_materials_specular", "KHR_materials_clearcoat", "KHR_materials_transmission"]);
    let scene = loaded(&root, &bin);
    let p = scene.materials[0].evaluate(&scene.textures, &[[0.5; 2]; 2]);
    let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-5, "{a} {b}");
    near(p.clearcoat, 0.5 * 128.0 / 255.0);
    near(p.clearcoat_roughness, 0.5 * 64.0 / 255.0);
    near(p.transmission, 0.5 * 128.0 / 255.0);
    near(p.f90, 0.2);
    near(p.f0[2], 0.04 * 0.2);
    near(p.f0[0], 0.04 * 0.2 * 0.215_861);
    assert!(scene.warnings.join("; ").contains("clearcoatNormalTexture of material `paint`"));
    // Both sides of a transmitting sheet scatter.
    let scene = Scene::new(Arc::new(scene), None, None, None, false);
    let hit = scene.intersect(Vec3A::new(0.2, 0.2, -1.0), Vec3A::Z, 9.0).unwrap();
    assert!(scene.surface(&hit, Vec3A::Z, &GREY).bsdf.is_some());

    root["extensionsRequired"] = json!(["KHR_materials_unlit"]);
    root["materials"][0]["extensions"] = json!({"KHR_materials_unlit": {}});
    root["materials"][0]["emissiveFactor"] = json!([1, 1, 1]);
    let scene = loaded(&root, &bin);
    let p = scene.materials[0].evaluate(&scene.textures, &[[0.5; 2]; 2]);
    assert_eq!((p.metallic, p.f0, p.f90, p.emission), (0.0, [0.0; 3], 0.0, [0.0; 3]));
    assert!(scene.warnings[0].contains("material `paint` is unlit"), "{:?}", scene.warnings);

    root["extensionsRequired"] = json!(["KHR_materials_volume", "KHR_materials_wetness"]);
    let message = refusal(&root, &bin);
    assert!(message.contains("KHR_materials_volume (without it, transmitting"), "{message}");
    assert!(message.ends_with("KHR_materials_wetness"), "{message}");
}

#[test]
fn hostile_factors_are_refused() {
    let message = |extensions: Value| {
        let (root, bin) = textured(
            &[[255; 4]],
            json!({"name": "m", "extensions": extensions, "normalTexture": {"index": 0}}),
        );
        refusal(&root, &bin)
    };
    let coat = |coat: Value| message(json!({"KHR_materials_clearcoat": coat}));
    assert!(coat(json!({"clearcoatFactor": 1e39})).contains("clearcoatFactor is inf, must be from 0 to 1"));
    assert!(coat(json!({"clearcoatFactor": -0.1})).contains("clearcoatFactor is -0.1"));
    assert!(coat(json!({"clearcoatFactor": "x"})).contains("clearcoatFactor is \"x\", must be a number"));
    let index = |index: Value| coat(json!({"clearcoatFactor": 1, "clearcoatTexture": {"index": index}}));
    assert!(index(json!(7)).contains("material `m`: clearcoatTexture names no texture"));
    assert!(index(json!(-1)).contains("names no texture") && index(json!(null)).contains("names no texture"));
    let through = |x: Value| message(json!({"KHR_materials_transmission": {"transmissionFactor": x}}));
    assert!(through(json!(2)).contains("transmissionFactor is 2, must be from 0 to 1"));
    assert!(message(json!({"KHR_materials_ior": {"ior": 1e39}})).contains("ior (if not 0) is inf"));
    // A huge index is a mirror.
    let (mut root, bin) = textured(
        &[[255; 4]],
        json!({"normalTexture": {"index": 0, "scale": -3e38}, "pbrMetallicRoughness": {"metallicFactor": 0},
               "extensions": {"KHR_materials_ior": {"ior": 3e38}}}),
    );
    let scene = loaded(&root, &bin);
    let p = scene.materials[0].evaluate(&scene.textures, &[[0.5; 2]; 2]);
    assert!((p.f0[0] - 1.0).abs() < 1e-6);
    root["materials"][0]["normalTexture"]["scale"] = json!(1e39);
    assert!(refusal(&root, &bin).contains("scale of normalTexture is inf, must be a finite number"));
}
