//! What the loader makes of well-formed files.

mod animations;
#[path = "../common/mod.rs"]
mod common;
mod distributions;
mod materials;

use common::{TRIANGLE, data, document, floats, glb, load_bytes, refusal};
use fog_scene::{AlphaMode, Limits, load};
use glam::{Vec3, Vec3A};
use serde_json::json;

#[test]
fn bench_street_loads_whole() {
    let scene = load(&data("street_grey.glb"), &Limits::default()).unwrap();
    assert_eq!(scene.geometry.triangles().len(), 260);
    assert_eq!(scene.objects.len(), 130);
    assert_eq!((scene.materials.len(), scene.textures.len()), (131, 66));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let [min, max] = scene.geometry.bounds().unwrap();
    assert_eq!((min, max), (Vec3A::new(-1200.0, 0.0, -1200.0), Vec3A::new(1200.0, 120.0, 1200.0)));
    // Straight down onto the street, forward onto the tower.
    let hit = scene.geometry.intersect(Vec3A::new(0.5, 1.7, -1.0), Vec3A::NEG_Y, f32::INFINITY).unwrap();
    let ground = scene.geometry.surface(&hit);
    assert_eq!((ground.geometric_normal, ground.position.y), (Vec3A::Y, 0.0));
    let object = &scene.objects[ground.object as usize];
    assert_eq!((object.name.as_str(), object.class.as_deref()), ("street", Some("road")));
    let tower = scene.geometry.intersect(Vec3A::new(0.5, 1.7, 0.0), Vec3A::NEG_Z, f32::INFINITY).unwrap();
    assert!((tower.t - 400.0).abs() < 1e-3);
    let tower = scene.geometry.surface(&tower);
    assert_eq!(scene.objects[tower.object as usize].instance.as_deref(), Some("tower"));
    // Lambertian and grey.
    let material = &scene.materials[tower.material as usize];
    let p = material.evaluate(&scene.textures, &tower.uv);
    assert_eq!((p.f0, p.f90, p.metallic, p.roughness), ([0.0; 3], 0.0, 0.0, 1.0));
    assert!(p.base_color[0] == p.base_color[2] && p.base_color[0] > 0.1);
    assert_eq!(p.emission, [0.0; 3]);
    let night = load(&data("street_night.glb"), &Limits::default()).unwrap();
    assert_eq!(night.materials.iter().filter(|m| m.is_emissive()).count(), 126);
}

#[test]
fn transforms_mirrors_and_labels() {
    let (mut root, bin) = document(&TRIANGLE, 4);
    root["scenes"] = json!([{"nodes": [1]}]);
    root["nodes"] = json!([
        {"mesh": 0, "translation": [0, 0, 5], "extras": {"instance": "one"}},
        {"name": "parent", "scale": [2, 2, 2], "children": [0, 2, 3], "extras": {"class": "car", "instance": "all"}},
        {"name": "mirror", "mesh": 0, "scale": [-1, 1, 1]},
        {"name": "turned", "mesh": 0, "rotation": [0, 1, 0, 1]},
    ]);
    let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
    let [plain, mirror, turned] = scene.geometry.triangles() else { panic!("three triangles") };
    assert_eq!(
        plain.positions,
        [Vec3::new(0.0, 0.0, 10.0), Vec3::new(2.0, 0.0, 10.0), Vec3::new(0.0, 2.0, 10.0)]
    );
    assert_eq!((plain.normal(), plain.normals[0]), (Vec3A::Z, Vec3::Z));
    // A mirror in x leaves the front of a triangle in the xy plane where it was.
    assert_eq!((mirror.normal(), mirror.normals[0]), (Vec3A::Z, Vec3::Z));
    assert!((turned.normal() - Vec3A::X).length() < 1e-6);
    let labels = |i: usize| {
        let o = &scene.objects[i];
        (o.name.as_str(), o.class.as_deref(), o.instance.as_deref())
    };
    assert_eq!(labels(0), ("thing", Some("car"), Some("one")));
    assert_eq!(labels(1), ("mirror", Some("car"), Some("all")));
    assert_eq!(plain.object, 0);
}

#[test]
fn normals_follow_mirrors_and_the_winding_decides() {
    let (mut root, mut bin) = document(&TRIANGLE, 4);
    bin.extend(floats(&[0.6, 0.0, 0.8, 0.6, 0.0, 0.8, 0.6, 0.0, 0.8]));
    root["buffers"][0]["byteLength"] = bin.len().into();
    root["bufferViews"] =
        json!([{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36}]);
    root["accessors"] =
        json!([root["accessors"][0], {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}]);
    root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1.into();
    root["nodes"][0]["scale"] = json!([-1, 1, 1]);
    let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
    let t = scene.geometry.triangles()[0];
    assert!((t.normals[0] - Vec3::new(-0.6, 0.0, 0.8)).length() < 1e-6, "{}", t.normals[0]);
    // Flattened to a plane along z, and turned inside out: still on the front.
    root["nodes"][0]["scale"] = json!([1, 1, -1]);
    let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
    let t = scene.geometry.triangles()[0];
    assert_eq!(t.normal(), Vec3A::NEG_Z);
    assert!((t.normals[0] - Vec3::new(0.6, 0.0, -0.8)).length() < 1e-6);
}

#[test]
fn strips_fans_and_index_types() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let ring = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    for (vertices, mode) in [(square, 5), (ring, 6)] {
        let (root, bin) = document(&vertices, mode);
        let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
        assert_eq!(scene.geometry.triangles().len(), 2);
        assert!(scene.geometry.triangles().iter().all(|t| t.normal() == Vec3A::Z && t.area() == 0.5));
    }
    for (component, indices) in [
        (5121, vec![0u8, 1, 2, 3, 2, 1]),
        (5123, [0u16, 1, 2, 3, 2, 1].iter().flat_map(|i| i.to_le_bytes()).collect()),
        (5125, [0u32, 1, 2, 3, 2, 1].iter().flat_map(|i| i.to_le_bytes()).collect()),
    ] {
        let (mut root, mut bin) = document(&square, 4);
        root["bufferViews"] = json!([{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": indices.len()}]);
        root["accessors"] = json!([root["accessors"][0], {"bufferView": 1, "componentType": component, "count": 6, "type": "SCALAR"}]);
        root["meshes"][0]["primitives"][0]["indices"] = 1.into();
        bin.extend(indices);
        root["buffers"][0]["byteLength"] = bin.len().into();
        let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
        assert!(scene.geometry.triangles().iter().all(|t| t.normal() == Vec3A::Z), "{component}");
        assert_eq!(scene.geometry.triangles().len(), 2);
        root["accessors"][1]["componentType"] = 5126.into();
        assert!(refusal(&root, &bin).contains("indices"), "{component}");
    }
}

#[test]
fn sparse_accessors_replace_vertices() {
    let (mut root, mut bin) = document(&TRIANGLE, 4);
    bin.extend([2u8, 0, 0, 0]);
    bin.extend(floats(&[0.0, 7.0, 0.0]));
    root["buffers"][0]["byteLength"] = bin.len().into();
    root["bufferViews"] = json!([
        {"buffer": 0, "byteLength": 36},
        {"buffer": 0, "byteOffset": 36, "byteLength": 1},
        {"buffer": 0, "byteOffset": 40, "byteLength": 12},
    ]);
    root["accessors"][0]["sparse"] = json!({"count": 1,
        "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 2}});
    let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
    assert_eq!(scene.geometry.triangles()[0].positions[2], Vec3::new(0.0, 7.0, 0.0));
    bin[36] = 3;
    assert!(refusal(&root, &bin).contains("replaces elements"));
}

#[test]
fn materials_read_factors_textures_and_extensions() {
    let (mut root, mut bin) = document(&TRIANGLE, 4);
    let png = {
        let mut out = std::io::Cursor::new(Vec::new());
        let pixels = image::RgbaImage::from_raw(1, 2, vec![255, 128, 64, 200, 0, 0, 0, 0]).unwrap();
        pixels.write_to(&mut out, image::ImageFormat::Png).unwrap();
        out.into_inner()
    };
    let start = bin.len();
    bin.extend(&png);
    root["buffers"][0]["byteLength"] = bin.len().into();
    root["bufferViews"] =
        json!([{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": start, "byteLength": png.len()}]);
    root["images"] = json!([{"name": "skin", "bufferView": 1, "mimeType": "image/png"}]);
    root["textures"] = json!([{"source": 0}]);
    root["extensionsUsed"] = json!(["KHR_materials_specular", "KHR_materials_sheen"]);
    root["extensionsRequired"] = json!(["KHR_materials_specular", "KHR_materials_ior"]);
    root["materials"] = json!([{
        "name": "paint", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1], "baseColorTexture": {"index": 0},
            "metallicRoughnessTexture": {"index": 0}, "metallicFactor": 0.5, "roughnessFactor": 0.5},
        "normalTexture": {"index": 0},
        "emissiveFactor": [1, 0.5, 0],
        "extensions": {"KHR_materials_ior": {"ior": 1.33}, "KHR_materials_emissive_strength": {"emissiveStrength": 10},
            "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 2, 1]}},
    }]);
    root["meshes"][0]["primitives"][0]["material"] = 0.into();
    let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
    let m = &scene.materials[0];
    assert_eq!((m.name.as_str(), m.double_sided), ("paint", true));
    assert_eq!(m.alpha_mode, AlphaMode::Mask { cutoff: 0.25 });
    assert!(m.normal_map.is_some());
    // One image, decoded twice as sRGB and linear textures; v = 0 is its top row.
    assert_eq!(scene.textures.len(), 2);
    let p = m.evaluate(&scene.textures, &[[0.5, 0.25]; 2]);
    assert!((p.base_color[0] - 0.5).abs() < 1e-6 && (p.base_color[1] - 0.215_861).abs() < 1e-5);
    assert!(
        (p.roughness - 0.5 * 128.0 / 255.0).abs() < 1e-6 && (p.metallic - 0.5 * 64.0 / 255.0).abs() < 1e-6
    );
    assert_eq!(p.emission, [10.0, 5.0, 0.0]);
    let r0 = (0.33f32 / 2.33).powi(2);
    assert!((p.f0[1] - r0).abs() < 1e-6 && (p.f0[0] - 0.5 * r0).abs() < 1e-6 && p.f90 == 0.5);
    let text = scene.warnings.join("; ");
    assert!(text.contains("KHR_materials_sheen") && text.contains("no TEXCOORD_0"), "{text}");

    root["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = json!(1e39);
    assert!(refusal(&root, &bin).contains("material `paint`: roughnessFactor is inf"));
    root["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = json!(1);
    root["materials"][0]["alphaMode"] = json!("BLEND");
    let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
    assert_eq!(scene.materials[0].alpha_mode, AlphaMode::Blend);
    assert!(scene.geometry.has_partial_opacity());
    root["materials"][0]["emissiveTexture"] = json!({"index": 0, "texCoord": 2});
    assert!(refusal(&root, &bin).contains("material `paint`: uses TEXCOORD_2"));
    // Damaged and foreign images name themselves.
    root["materials"][0]["emissiveTexture"] = json!({"index": 0});
    bin[start + 45] ^= 0xff;
    assert!(refusal(&root, &bin).contains("image `skin`: cannot be decoded"));
    bin[start..start + 12].copy_from_slice(b"RIFF\x10\0\0\0WEBP");
    assert!(refusal(&root, &bin).contains("image `skin`: is a WebP image; only PNG and JPEG"));
}
