//! From JSON to a document whose references all exist.

use super::{Warnings, extensions};
use crate::error::{Failure, SceneErrorKind};
use gltf::Document;
use gltf::json::{self, Root, validation::Checked};

/// Parses and checks the JSON text.
pub(super) fn parse(text: &[u8], warnings: &mut Warnings) -> Result<Document, Failure> {
    let invalid_json = |e: serde_json::Error| SceneErrorKind::Json(e.to_string());
    let mut root: Root = json::deserialize::from_slice(text).map_err(invalid_json)?;

    extensions::check(&root, warnings)?;
    // The gltf crate would refuse KHR_materials_specular here although it reads it.
    root.extensions_required.clear();

    check_references(&root)?;
    Document::from_json(root).map_err(|e| SceneErrorKind::Invalid(describe(e)).into())
}

/// What the gltf crate's own validation would panic on, or let pass and panic on later.
fn check_references(root: &Root) -> Result<(), Failure> {
    for (i, mesh) in root.meshes.iter().enumerate() {
        let place = || format!("mesh `{}`", mesh.name.clone().unwrap_or_else(|| i.to_string()));
        for primitive in &mesh.primitives {
            for (semantic, accessor) in &primitive.attributes {
                if accessor.value() >= root.accessors.len() {
                    let name = match semantic {
                        Checked::Valid(s) => s.to_string(),
                        Checked::Invalid => "an attribute".into(),
                    };
                    let text = format!("{name} names accessor {}, which does not exist", accessor.value());
                    return Err(SceneErrorKind::Accessor(text).at(place));
                }
            }
        }
    }
    for (i, image) in root.images.iter().enumerate() {
        let place = || format!("image `{}`", image.name.clone().unwrap_or_else(|| i.to_string()));
        let wrong = match (&image.buffer_view, &image.uri, &image.mime_type) {
            (None, None, _) => "has neither a URI nor a buffer view",
            (Some(_), _, None) => "is in a buffer view but has no MIME type",
            _ => continue,
        };
        return Err(SceneErrorKind::Image(wrong.into()).at(place));
    }
    for (i, texture) in root.textures.iter().enumerate() {
        if texture.source.value() >= root.images.len() {
            let text = "has no PNG or JPEG source; convert WebP and AVIF images with `gltf-transform png`, KTX2 images with \
                        `gltf-transform ktxdecompress`";
            return Err(SceneErrorKind::Image(text.into()).at(|| format!("texture {i}")));
        }
    }
    Ok(())
}

fn describe(error: gltf::Error) -> String {
    const SHOWN: usize = 3;
    match error {
        gltf::Error::Validation(all) => {
            let mut text: Vec<String> =
                all.iter().take(SHOWN).map(|(path, e)| format!("{path}: {e}")).collect();
            if all.len() > SHOWN {
                text.push(format!("and {} more", all.len() - SHOWN));
            }
            text.join("; ")
        }
        other => other.to_string(),
    }
}
