//! Damaged and malicious files: one clear message each, never a panic.

mod common;

use common::{TRIANGLE, attribute, data, document, floats, glb, load_bytes, refusal, textured};
use fog_core::Vec3A;
use fog_core::random::PathRng;
use fog_core::spectrum::Spectrum;
use fog_scene::lamp::{Lamp, Pattern};
use fog_scene::scene::Scene;
use fog_scene::{Limits, LoadedScene, SceneErrorKind, load};
use serde_json::{Value, json};

#[test]
fn files_that_are_no_scene() {
    let message = |bytes: &[u8]| load_bytes("x.glb", bytes).expect_err("must not load").to_string();
    assert!(message(b"").contains("neither binary glTF"));
    assert!(message(b"hello").contains("neither binary glTF"));
    assert!(message(b"{").contains("not valid glTF JSON"));
    assert!(message(b"glTF\x01\0\0\0\x0c\0\0\0").contains("version is 1"));
    assert!(message(b"glTF\x02\0\0\0\0\0\0\0").contains("truncated"));
    assert!(message(br#"{"asset": {"version": "2.0"}}"#).contains("no scene"));
    let missing = load(std::path::Path::new("/nonexistent/a.glb"), &Limits::default()).unwrap_err();
    assert!(missing.to_string().starts_with("/nonexistent/a.glb: cannot be read"), "{missing}");
    let folder = load(&common::repository(), &Limits::default()).unwrap_err().to_string();
    assert!(folder.contains("cannot be read"), "{folder}");
}

#[test]
fn truncation_at_any_length() {
    let bytes = std::fs::read(data("street_grey.glb")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cut.glb");
    for length in (0..bytes.len()).step_by(1499).chain(0..64) {
        std::fs::write(&path, &bytes[..length]).unwrap();
        let error = load(&path, &Limits::default()).expect_err("must not load").to_string();
        let expected = if length < 4 { "neither binary glTF" } else { "truncated" };
        assert!(error.contains(expected), "{length}: {error}");
        // With a header that lies about it, too.
        if length >= 12 {
            let mut lying = bytes[..length].to_vec();
            lying[8..12].copy_from_slice(&(length as u32).to_le_bytes());
            std::fs::write(&path, &lying).unwrap();
            load(&path, &Limits::default()).expect_err("must not load");
        }
    }
}

/// A small file with every kind of material.
fn rich() -> Vec<u8> {
    let info =
        json!({"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1}}});
    let (mut root, mut bin) = textured(
        &[[200, 90, 220, 255], [128, 128, 255, 99]],
        json!({"normalTexture": {"index": 0, "scale": 0.5}, "alphaMode": "BLEND", "doubleSided": true,
               "pbrMetallicRoughness": {"baseColorTexture": info, "metallicFactor": 0.5},
               "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatTexture": info}}}),
    );
    attribute(&mut root, &mut bin, "COLOR_0", "VEC3", 5126, &floats(&[0.5; 9]));
    let glass = json!({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": info}},
                       "pbrMetallicRoughness": {"roughnessFactor": 0, "metallicFactor": 0}});
    root["materials"].as_array_mut().unwrap().push(glass);
    root["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "spot", "intensity": 40, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.75}}]}});
    root["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
    let mut pane = root["meshes"][0]["primitives"][0].clone();
    pane["material"] = 1.into();
    root["meshes"][0]["primitives"].as_array_mut().unwrap().push(pane);
    glb(&root, &bin)
}

/// Rays through the middle of whatever was loaded, and what they scatter, are numbers.
fn look_at(scene: LoadedScene) {
    let Some([low, high]) = scene.geometry.bounds() else { return };
    let target = low + (high - low) * 0.3;
    let scene = Scene::new(std::sync::Arc::new(scene), None, None, None, true);
    let basis = [Spectrum::ONE * (1.0 / 3.0); 3];
    let mut rng = PathRng::new(4, 0, 0);
    for direction in [Vec3A::NEG_Z, Vec3A::Z] {
        let origin = target - direction * 2.0;
        let Some(hit) = scene.scatterer(origin, direction, f32::INFINITY, rng.next_u64()) else { continue };
        let surface = scene.surface(&hit, direction, &basis);
        let to_local = surface.world_from_shading.transpose();
        for _ in 0..4 {
            let sample =
                surface.bsdf.and_then(|b| b.sample(to_local * -direction, rng.uniform(), rng.uniform2()));
            let Some(sample) = sample else { continue };
            assert!(sample.wi.is_finite() && sample.weight.max_lane().is_finite(), "{sample:?}");
        }
    }
}

#[test]
fn flipped_bytes_never_panic() {
    let (mut root, bin) = document(&TRIANGLE, 4);
    root["materials"] = json!([{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1]}}]);
    let small = glb(&root, &bin);
    let street = std::fs::read(common::repository().join("scenes/street.glb")).unwrap();
    assert_eq!(load_bytes("rich.glb", &rich()).unwrap().geometry.triangles().len(), 2);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flipped.glb");
    let mut loaded = 0;
    for (bytes, rounds) in [(small, 3000), (rich(), 2000), (street, 1500)] {
        for round in 0..rounds {
            let mut rng = PathRng::new(3, round, bytes.len() as u64);
            let mut bad = bytes.clone();
            for _ in 0..1 + rng.next_u64() % 3 {
                let at = (rng.next_u64() % bad.len() as u64) as usize;
                bad[at] = match rng.next_u64() % 3 {
                    0 => bad[at] ^ (1 << (rng.next_u64() % 8)),
                    1 => b"0123456789-.,:{}[]\"e"[(rng.next_u64() % 20) as usize],
                    _ => rng.next_u64() as u8,
                };
            }
            std::fs::write(&path, &bad).unwrap();
            if let Ok(scene) = load(&path, &Limits::default()) {
                loaded += 1;
                look_at(scene);
            }
        }
    }
    assert!(loaded > 0);
}

#[test]
fn geometry_errors_name_their_place() {
    let broken = |change: &dyn Fn(&mut Value, &mut Vec<u8>)| {
        let (mut root, mut bin) = document(&TRIANGLE, 4);
        change(&mut root, &mut bin);
        refusal(&root, &bin)
    };
    let message = broken(&|_, bin| bin[4..8].copy_from_slice(&f32::NAN.to_le_bytes()));
    assert!(message.contains("node `place`, mesh `thing`: vertex 0 is at (NaN, NaN, NaN) m"), "{message}");
    let message = broken(&|_, bin| bin[0..4].copy_from_slice(&f32::INFINITY.to_le_bytes()));
    assert!(message.contains("vertex 0"), "{message}");
    let message = broken(&|root, _| root["nodes"][0]["scale"] = json!([1e30, 1e30, 1e30]));
    assert!(message.contains("farther than 1e9 m"), "{message}");
    let message = broken(&|root, _| root["accessors"][0]["count"] = 4.into());
    assert!(
        message.contains("mesh `thing`, primitive 0: POSITION reaches beyond buffer view 0"),
        "{message}"
    );
    let message = broken(&|root, _| root["accessors"][0]["count"] = 4_000_000_000_000_000_000u64.into());
    assert!(message.contains("POSITION has 4000000000000000000 elements"), "{message}");
    let message = broken(&|root, _| root["accessors"][0]["byteOffset"] = u64::MAX.into());
    assert!(message.contains("reaches beyond"), "{message}");
    let message = broken(&|root, _| root["bufferViews"][0]["byteOffset"] = u64::MAX.into());
    assert!(message.contains("reaches beyond its buffer"), "{message}");
    let message = broken(&|root, _| root["bufferViews"][0]["byteStride"] = 4.into());
    assert!(message.contains("12 bytes at distances of 4"), "{message}");
    let message = broken(&|root, _| root["accessors"][0]["componentType"] = 5123.into());
    assert!(message.contains("POSITION has components of type U16"), "{message}");
    let message = broken(&|root, _| root["accessors"][0]["type"] = "VEC2".into());
    assert!(message.contains("not a vector of 3"), "{message}");
    let message = broken(&|root, _| root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7.into());
    assert!(message.contains("mesh `thing`: POSITION names accessor 7"), "{message}");
    let message = broken(&|root, _| root["buffers"][0]["byteLength"] = 5000.into());
    assert!(message.contains("buffer 0: is cut off: 36 of 5000 bytes"), "{message}");
    let message = broken(&|root, _| root["nodes"][0]["mesh"] = 3.into());
    assert!(message.contains("nodes[0].mesh"), "{message}");
    let message = broken(&|root, _| root["meshes"][0]["primitives"][0]["attributes"] = json!({}));
    assert!(message.contains("POSITION"), "{message}");
    let message = broken(&|root, _| root["nodes"][0]["rotation"] = json!([0, 0, 0, 0]));
    assert!(message.contains("node `place`: has a rotation"), "{message}");
    let message = broken(&|root, _| {
        root["nodes"][0]["matrix"] = json!([1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    });
    assert!(message.contains("not affine"), "{message}");
}

#[test]
fn nodes_must_form_a_tree() {
    let (mut root, bin) = document(&TRIANGLE, 4);
    root["nodes"] = json!([{"name": "a", "children": [1]}, {"name": "b", "children": [0]}]);
    assert!(refusal(&root, &bin).contains("node `a`: is below itself"));
    root["nodes"] = json!([{"name": "a", "children": [1, 1]}, {"name": "b", "mesh": 0}]);
    assert!(refusal(&root, &bin).contains("node `b`: is below itself, or has two parents"));
    // A chain of 100,000 nodes is a tree.
    let chain =
        (1..=100_000).map(|i| if i < 100_000 { json!({"children": [i]}) } else { json!({"mesh": 0}) });
    root["nodes"] = chain.collect();
    assert_eq!(load_bytes("deep.glb", &glb(&root, &bin)).unwrap().geometry.triangles().len(), 1);
}

#[test]
fn lights_say_what_is_wrong() {
    let (mut root, bin) = document(&TRIANGLE, 4);
    root["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
    let with = |light: serde_json::Value| {
        let mut root = root.clone();
        root["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}});
        root
    };
    for (light, expected) in [
        (
            json!({"type": "point", "name": "lamp", "intensity": -1}),
            "light `lamp`: intensity is -1; valid: 0 or more, finite",
        ),
        (
            json!({"type": "point", "color": [0, 2, 0]}),
            "light `0`: color has the component 2; valid: 0 to 1, linear",
        ),
        (
            json!({"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}}),
            "light `0`: innerConeAngle is 0.5 and outerConeAngle 0.5 rad; valid: 0 <= inner < outer <= pi/2",
        ),
    ] {
        let message = refusal(&with(light), &bin);
        assert!(message.ends_with(expected), "{message}");
    }
    // References to nothing, and kinds that do not exist, are errors too.
    refusal(&root, &bin);
    refusal(&with(json!({"type": "laser"})), &bin);
    refusal(&with(json!({"type": "spot"})), &bin);
    let mut flat = with(json!({"type": "directional"}));
    flat["nodes"][0]["scale"] = json!([1, 1, 0]);
    let message = refusal(&flat, &bin);
    assert!(message.ends_with("its node has a scale of 0 along the light's axis"), "{message}");
}

#[test]
fn lights_are_placed_by_their_nodes() {
    let (mut root, bin) = document(&TRIANGLE, 4);
    let half = 0.5f64.sqrt();
    root["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "spot", "intensity": 40, "color": [1, 0.5, 0.25], "range": 20,
         "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.75}},
        {"type": "directional", "intensity": 3},
        {"type": "point"}]}});
    let turned = json!([-half, 0, 0, half]);
    root["nodes"] = json!([
        {"mesh": 0, "translation": [1, 2, 3], "scale": [2, 2, 2], "children": [1]},
        {"translation": [0, 5, 0], "rotation": turned, "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"rotation": turned, "extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"extensions": {"KHR_lights_punctual": {"light": 2}}}]);
    root["scenes"] = json!([{"nodes": [0, 2, 3]}]);
    let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
    let [spot, point] = &scene.lights.lamps[..] else { panic!("{:?}", scene.lights) };
    let Pattern::Cone(cone) = &spot.pattern else { panic!("{spot:?}") };
    // A quarter turn about X takes −Z to −Y; the parent's scale stretches the way there and nothing else.
    assert!((spot.position - Vec3A::new(1.0, 12.0, 3.0)).length() < 1e-5);
    assert!((cone.axis - Vec3A::NEG_Y).length() < 1e-6);
    assert_eq!(spot.intensity, [40.0, 20.0, 10.0]);
    assert!((cone.cos_inner - 0.968_912_4).abs() < 1e-6 && (cone.cos_outer - 0.731_688_9).abs() < 1e-6);
    assert_eq!(*point, Lamp::even(Vec3A::ZERO, [1.0; 3]));
    let [beam] = scene.lights.beams[..] else { panic!("{:?}", scene.lights) };
    assert!((beam.direction - Vec3A::Y).length() < 1e-6 && beam.illuminance == [3.0; 3]);
    assert!(scene.warnings.iter().any(|w| w.contains("its range")), "{:?}", scene.warnings);
    assert!(!scene.warnings.iter().any(|w| w.contains("not supported")), "{:?}", scene.warnings);
}

#[test]
fn extensions_and_images() {
    let (mut root, bin) = document(&TRIANGLE, 4);
    root["extensionsRequired"] =
        json!(["KHR_materials_ior", "KHR_draco_mesh_compression", "KHR_texture_basisu"]);
    let message = refusal(&root, &bin);
    let expected = "not supported: KHR_draco_mesh_compression (decompress with `gltf-transform copy in.glb out.glb`), \
                    KHR_texture_basisu (convert KTX2 images with `gltf-transform ktxdecompress in.glb out.glb`)";
    assert!(message.ends_with(expected), "{message}");
    root["extensionsRequired"] = json!([]);
    root["textures"] = json!([{"extensions": {"EXT_texture_webp": {"source": 0}}}]);
    assert!(refusal(&root, &bin).contains("texture 0: has no PNG or JPEG source"));
    root["textures"] = json!([]);
    root["images"] = json!([{"name": "sky"}]);
    assert!(refusal(&root, &bin).contains("image `sky`: has neither a URI nor a buffer view"));
    root["images"] = json!([{"name": "sky", "bufferView": 0}]);
    assert!(refusal(&root, &bin).contains("image `sky`: is in a buffer view but has no MIME type"));
}

#[test]
fn limits_hold() {
    let (mut root, bin) = document(&TRIANGLE, 4);
    root["nodes"] = json!([{"mesh": 0}, {"mesh": 0}, {"mesh": 0}]);
    root["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.glb");
    let bytes = glb(&root, &bin);
    std::fs::write(&path, &bytes).unwrap();
    let size = bytes.len() as u64;
    let kind = |limits: Limits| load(&path, &limits).map_err(|e| e.kind);
    let all = Limits::default();
    assert!(matches!(
        kind(Limits { max_triangles: 2, ..all }),
        Err(SceneErrorKind::TooManyTriangles { limit: 2 })
    ));
    assert!(kind(Limits { max_triangles: 3, max_file_bytes: size, ..all }).is_ok());
    assert!(matches!(kind(Limits { max_file_bytes: size - 1, ..all }), Err(SceneErrorKind::TooLarge { .. })));
    let street = load(&data("street_grey.glb"), &Limits { max_texture_pixels: 1000, ..all });
    assert!(matches!(street.map_err(|e| e.kind), Err(SceneErrorKind::TooManyPixels { limit: 1000 })));
}

#[test]
fn triangles_without_area_are_counted() {
    let (mut root, bin) = document(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 5);
    let scene = load_bytes("scene.glb", &glb(&root, &bin)).unwrap();
    assert_eq!(scene.geometry.triangles().len(), 1);
    assert_eq!(scene.warnings, ["1 triangles without area were left out"]);
    root["nodes"][0]["scale"] = json!([0, 0, 0]);
    assert!(load_bytes("scene.glb", &glb(&root, &bin)).unwrap().geometry.triangles().is_empty());
}

#[test]
fn uris_stay_in_the_folder() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("scene");
    std::fs::create_dir_all(folder.join("parts")).unwrap();
    let (mut root, bin) = document(&TRIANGLE, 4);
    std::fs::write(outer.path().join("secret.bin"), &bin).unwrap();
    std::fs::write(folder.join("parts/my vertices.bin"), &bin).unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(outer.path().join("secret.bin"), folder.join("link.bin")).unwrap();
        std::os::unix::fs::symlink(outer.path(), folder.join("out")).unwrap();
    }
    let path = folder.join("scene.gltf");
    let mut attempt = |uri: &str| {
        root["buffers"][0]["uri"] = uri.into();
        std::fs::write(&path, root.to_string()).unwrap();
        load(&path, &Limits::default()).map(|s| s.geometry.triangles().len()).map_err(|e| e.to_string())
    };
    assert_eq!(attempt("parts/my%20vertices.bin"), Ok(1));
    assert_eq!(attempt("parts/../parts/my vertices.bin"), Ok(1));
    let embedded = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    assert_eq!(attempt(embedded), Ok(1));
    let outside = outer.path().join("secret.bin").display().to_string();
    for (uri, reason) in [
        ("../secret.bin", "leaves the scene's folder"),
        ("%2e%2e/secret.bin", "leaves the scene's folder"),
        ("parts/../../secret.bin", "leaves the scene's folder"),
        ("../scene/../secret.bin", "leaves the scene's folder"),
        (outside.as_str(), "is an absolute path"),
        (&format!("file://{outside}"), "has a scheme"),
        ("https://example.org/a.bin", "has a scheme"),
        #[cfg(unix)]
        ("link.bin", "through a link"),
        #[cfg(unix)]
        ("out/secret.bin", "through a link"),
        ("parts", "is not a file"),
        ("absent.bin", "cannot be read"),
        ("data:application/octet-stream;base64,AAAA", "cut off"),
        ("data:application/octet-stream;base64,?", "not valid base64"),
    ] {
        let message = attempt(uri).expect_err(uri);
        assert!(message.contains("buffer 0") && message.contains(reason), "{uri}: {message}");
    }
    assert!(attempt("parts/\u{1b}[2J").unwrap_err().contains("\\u{1b}"), "control characters are escaped");
}

#[test]
fn images_that_are_none() {
    let skin = |bytes: &[u8]| {
        let (mut root, mut bin) =
            textured(&[[0; 4]], json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
        let view = common::append(&mut root, &mut bin, bytes);
        root["images"][0]["bufferView"] = view.into();
        refusal(&root, &bin)
    };
    // The header of a PNG: so many columns and rows, and nothing else.
    let header = |width: u32, height: u32| {
        let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
        png.extend([width.to_be_bytes(), height.to_be_bytes()].concat());
        png.extend([8, 6, 0, 0, 0]);
        let crc = png[12..].iter().fold(u32::MAX, |crc, byte| {
            (0..8).fold(crc ^ u32::from(*byte), |c, _| (c >> 1) ^ (0xedb8_8320 & (c & 1).wrapping_neg()))
        });
        png.extend((!crc).to_be_bytes());
        png.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
        png
    };
    for bytes in [header(0, 0), header(0, 5), vec![], b"\x89PNG".to_vec()] {
        let message = skin(&bytes);
        assert!(message.contains("image `skin`"), "{message}");
    }
    let huge = skin(&header(100_000, 100_000));
    assert!(
        huge.ends_with("image `skin`: the scene's textures have more than 268435456 pixels together"),
        "{huge}"
    );
    assert!(skin(b"RIFF....WEBPVP8 ").contains("is a WebP image; only PNG and JPEG are supported"));

    let (mut root, bin) =
        textured(&[[0; 4]], json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
    for (uri, reason) in [
        ("absent.png", "cannot be read"),
        ("http://example.org/a.png", "has a scheme"),
        ("../a.png", "leaves the scene's folder"),
    ] {
        root["images"] = json!([{"name": "skin", "uri": uri}]);
        let message = refusal(&root, &bin);
        assert!(message.contains("image `skin`") && message.contains(reason), "{message}");
    }
}

#[test]
fn scenes_in_memory_have_no_folder() {
    let (mut root, bin) = document(&TRIANGLE, 4);
    let name = std::path::Path::new("made");
    let load = |root: &Value, limits: Limits| fog_scene::load_bytes(name, &glb(root, &bin), &limits);
    assert_eq!(load(&root, Limits::default()).unwrap().geometry.triangles().len(), 1);
    let limits = Limits { max_nodes: 2, ..Limits::default() };
    root["nodes"] = json!([{"mesh": 0}, {}, {}]);
    assert_eq!(
        load(&root, limits).unwrap_err().to_string(),
        "made: the scene has 3 nodes; at most 2 are read"
    );
    root["buffers"][0]["uri"] = "a.bin".into();
    let message = load(&root, Limits::default()).unwrap_err().to_string();
    assert!(
        message.contains("made: buffer 0: URI \"a.bin\" is beside the scene, which is in memory"),
        "{message}"
    );
}

#[test]
fn missing_normals_are_those_of_the_triangles_and_bad_indices_are_named() {
    let (mut root, mut bin) = document(&TRIANGLE, 4);
    let triangle = load_bytes("flat.glb", &glb(&root, &bin)).unwrap().geometry.triangles()[0];
    assert_eq!(triangle.normals.map(|n| n.to_array()), [[0.0, 0.0, 1.0]; 3]);
    let view = common::append(&mut root, &mut bin, &[0, 1, 9]);
    let accessors = root["accessors"].as_array_mut().unwrap();
    accessors.push(json!({"bufferView": view, "componentType": 5121, "count": 3, "type": "SCALAR"}));
    root["meshes"][0]["primitives"][0]["indices"] = 1.into();
    let message = refusal(&root, &bin);
    assert!(message.contains("mesh `thing`") && message.contains('9'), "{message}");
}

/// Replaces one value of a JSON text, chosen by chance, with one that nobody expects there.
fn disturb(root: &mut Value, rng: &mut PathRng) {
    let strange = [
        Value::Null,
        json!(-1),
        json!(1e300),
        json!(u64::MAX),
        json!(""),
        json!([]),
        json!({}),
        json!(4_294_967_295_u32),
        json!("data:,"),
        json!([1e38, -1e38, 0]),
    ];
    let mut here = root;
    loop {
        let count = match &*here {
            Value::Object(map) => map.len(),
            Value::Array(items) => items.len(),
            _ => 0,
        } as u64;
        if count == 0 || rng.next_u64().is_multiple_of(40) {
            *here = strange[(rng.next_u64() % strange.len() as u64) as usize].clone();
            return;
        }
        let at = (rng.next_u64() % count) as usize;
        here = match here {
            Value::Object(map) => map.values_mut().nth(at).unwrap(),
            Value::Array(items) => &mut items[at],
            _ => return,
        };
    }
}

#[test]
fn strange_values_never_panic() {
    let bytes = rich();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let root: Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    let bin = &bytes[28 + length..];
    // Many more by hand: ROUNDS=1000000.
    let rounds = std::env::var("ROUNDS").ok().and_then(|n| n.parse().ok()).unwrap_or(2000);
    let mut loaded = 0;
    for round in 0..rounds {
        let mut rng = PathRng::new(11, round, 0);
        let mut strange = root.clone();
        for _ in 0..1 + rng.next_u64() % 2 {
            disturb(&mut strange, &mut rng);
        }
        let limits = Limits { max_texture_pixels: 1 << 20, max_triangles: 100_000, ..Limits::default() };
        match fog_scene::load_bytes("strange.glb".as_ref(), &glb(&strange, bin), &limits) {
            Ok(scene) => {
                loaded += 1;
                look_at(scene);
            }
            Err(error) => assert!(error.to_string().starts_with("strange.glb: "), "{error}"),
        }
    }
    assert!(loaded > rounds / 100, "{loaded}");
}
