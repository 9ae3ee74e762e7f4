//! Measured distributions of lights: files that `extras.ies` names, and tables in `extras.photometry`.
//!
//! A light or the node that it hangs on has `"ies": "street.ies"`, a URI like that of an image; the node's counts before the
//! light's. Or the light has `"photometry": {"vertical_deg": […], "horizontal_deg": […], "candela": […]}`, with the
//! intensities of all vertical angles of the first horizontal one, then of the next. With `"pole": "down"` its vertical angles
//! are counted from −Y of the node and its horizontal ones from −Z, as suits beams along −Z: 90° and 0 are the axis of a spot.
//! Either gives the whole intensity: the light's own counts no more, and its colour is the hue alone.

use super::files::Files;
use super::nodes::extra;
use crate::error::SceneErrorKind;
use crate::ies::IesFile;
use crate::lamp::Measured;
use crate::photometry::Photometry;
use fog_core::{Vec3A, math};
use glam::{DMat4, DVec3, Mat3A};
use gltf::Node;
use gltf::khr_lights_punctual::Light;
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Reader of distributions, each once.
pub(super) struct Distributions {
    files: Files,
    by_uri: BTreeMap<String, (IesFile, Arc<Photometry>)>,
    by_light: BTreeMap<usize, Arc<Photometry>>,
}

impl Distributions {
    pub(super) fn new(files: Files) -> Self {
        Self { files, by_uri: BTreeMap::new(), by_light: BTreeMap::new() }
    }

    /// The distribution of the light of a node with this matrix, and a factor on its intensities; `None` if it has none.
    pub(super) fn of(
        &mut self,
        light: &Light<'_>,
        node: &Node<'_>,
        world: &DMat4,
    ) -> Result<Option<(Measured, f64)>, SceneErrorKind> {
        let ies = extra(node.extras(), "ies").or_else(|| extra(light.extras(), "ies"));
        let lamp_from_world = || orientation(world);
        if let Some(ies) = ies {
            let uri =
                ies.as_str().ok_or_else(|| wrong(format!("extras.ies is {ies}; valid: a file's name")))?;
            let lamp_from_world = lamp_from_world()?;
            let (file, photometry) = self.file(uri)?;
            // The axis is −Z of the lamp; straight down is −Y of the world.
            let down = f64::from(lamp_from_world.mul_vec3a(Vec3A::NEG_Y).dot(Vec3A::NEG_Z));
            let factor = file.tilt_factor(math::f64::acos(down.clamp(-1.0, 1.0)).to_degrees());
            return Ok(Some((Measured { photometry: Arc::clone(photometry), lamp_from_world }, factor)));
        }
        let Some(table) = extra(light.extras(), "photometry") else { return Ok(None) };
        let known = self.by_light.get(&light.index()).map(Arc::clone);
        let pole = match table.get("pole").map(|pole| (pole.as_str(), pole)) {
            None | Some((Some("axis"), _)) => Mat3A::IDENTITY,
            // Columns: where +X, +Y and +Z of the node are in the table's axes.
            Some((Some("down"), _)) => Mat3A::from_cols(Vec3A::NEG_Y, Vec3A::Z, Vec3A::NEG_X),
            Some((_, other)) => {
                return Err(wrong(format!("extras.photometry.pole is {other}; valid: \"axis\" or \"down\"")));
            }
        };
        let photometry = match known {
            Some(known) => known,
            None => {
                let read =
                    Arc::new(read_table(&table).map_err(|e| wrong(format!("extras.photometry: {e}")))?);
                self.by_light.insert(light.index(), Arc::clone(&read));
                read
            }
        };
        Ok(Some((Measured { photometry, lamp_from_world: pole * lamp_from_world()? }, 1.0)))
    }

    fn file(&mut self, uri: &str) -> Result<&(IesFile, Arc<Photometry>), SceneErrorKind> {
        if !self.by_uri.contains_key(uri) {
            let bytes = self.files.fetch(uri)?;
            // Names of makers may be in any old encoding; numbers are ASCII.
            let text = String::from_utf8_lossy(&bytes);
            let fault =
                |e| SceneErrorKind::Uri { uri: uri.chars().take(80).collect(), reason: format!("{e}") };
            let file = IesFile::parse(&text).map_err(fault)?;
            let photometry = Arc::new(file.photometry.clone());
            self.by_uri.insert(uri.to_owned(), (file, photometry));
        }
        Ok(&self.by_uri[uri])
    }
}

fn wrong(text: String) -> SceneErrorKind {
    SceneErrorKind::Light(text)
}

fn read_table(table: &Value) -> Result<Photometry, String> {
    let numbers = |key: &str| -> Result<Vec<f64>, String> {
        let list = table.get(key).and_then(Value::as_array).ok_or_else(|| format!("has no list `{key}`"))?;
        list.iter().map(|v| v.as_f64().ok_or_else(|| format!("`{key}` has {v}; valid: numbers"))).collect()
    };
    let candela: Vec<f32> = numbers("candela")?.into_iter().map(|c| c as f32).collect();
    Photometry::new(numbers("vertical_deg")?, &numbers("horizontal_deg")?, &candela)
}

/// Turns directions of the world into those of a node, whatever its scale: −Z first, then +X across it. A mirrored node
/// mirrors its distribution.
fn orientation(world: &DMat4) -> Result<Mat3A, SceneErrorKind> {
    let along = |axis: DVec3| world.transform_vector3(axis).try_normalize();
    let axes = || -> Option<[DVec3; 3]> {
        let z = along(DVec3::Z)?;
        let x = along(DVec3::X)?;
        let x = (x - z * z.dot(x)).try_normalize()?;
        let y = z.cross(x);
        Some([x, if along(DVec3::Y)?.dot(y) < 0.0 { -y } else { y }, z])
    };
    let [x, y, z] = axes().ok_or_else(|| wrong("its node has a scale of 0 along an axis".into()))?;
    let world_from_lamp = Mat3A::from_cols(x.as_vec3a(), y.as_vec3a(), z.as_vec3a());
    Ok(world_from_lamp.transpose())
}
