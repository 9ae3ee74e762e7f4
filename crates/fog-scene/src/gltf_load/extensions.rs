//! Which glTF extensions are honoured, and what to do about the others.

use super::Warnings;
use crate::error::SceneErrorKind;
use gltf::json::Root;

/// Extensions that are honoured.
const SUPPORTED: [&str; 8] = [
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_texture_transform",
];

/// What makes a file with this extension readable (programs of the glTF Transform command line).
fn advice(extension: &str) -> Option<&'static str> {
    Some(match extension {
        "KHR_draco_mesh_compression" => "decompress with `gltf-transform copy in.glb out.glb`",
        "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "decompress with `gltf-transform copy in.glb copy.glb` and `gltf-transform dequantize copy.glb out.glb`"
        }
        "KHR_mesh_quantization" => "convert with `gltf-transform dequantize in.glb out.glb`",
        "KHR_texture_basisu" => "convert KTX2 images with `gltf-transform ktxdecompress in.glb out.glb`",
        "EXT_texture_webp" | "EXT_texture_avif" => "convert images with `gltf-transform png in.glb out.glb`",
        "KHR_materials_pbrSpecularGlossiness" => "convert with `gltf-transform metalrough in.glb out.glb`",
        "KHR_materials_volume" => "without it, transmitting surfaces are thin sheets that do not bend light",
        _ => return None,
    })
}

/// Refuses files that require what is not supported, warns of what is left out.
pub(super) fn check(root: &Root, warnings: &mut Warnings) -> Result<(), SceneErrorKind> {
    let advised = |extension: &str| match advice(extension) {
        Some(advice) => format!("{extension} ({advice})"),
        None => extension.to_owned(),
    };
    let supported = |extension: &String| SUPPORTED.contains(&extension.as_str());
    let unknown: Vec<String> =
        root.extensions_required.iter().filter(|e| !supported(e)).map(|e| advised(e)).collect();
    if !unknown.is_empty() {
        return Err(SceneErrorKind::RequiredExtensions(unknown.join(", ")));
    }
    for extension in root.extensions_used.iter().filter(|e| !supported(e)) {
        warnings.add(match advice(extension) {
            Some(advice) => format!("extension {extension} is not supported and was ignored: {advice}"),
            None => format!("extension {extension} is not supported and was ignored"),
        });
    }
    Ok(())
}
