//! Named points of things.

use super::LabelledView;
use crate::flow::is_seen;
use crate::truth::TAU_NM;
use fog_core::{DVec3, math};

/// A named point, as a camera sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Keypoint {
    /// Its name.
    pub name: String,
    /// In the world, in metres.
    pub world: DVec3,
    /// Image point in pixels from the top left corner; none where the lens does not see it.
    pub image: Option<[f64; 2]>,
    /// Whether it lies in the image and nothing solid stands in front of it.
    pub is_visible: bool,
    /// Distance from the camera in metres.
    pub distance_m: f64,
    /// Transmittance from it to the camera at 550 nm.
    pub transmittance: f64,
}

/// A name and a point in the world.
pub(super) type Named = (String, DVec3);

/// Named points of each instance, by its number.
pub(super) fn by_instance(view: &LabelledView<'_>) -> Vec<Vec<Named>> {
    let mut all = vec![Vec::new(); view.labels.instances().len() + 1];
    for (node, i) in view.scene.loaded().nodes.iter().zip(0u32..) {
        if !node.keypoints.is_empty() {
            let points =
                node.keypoints.iter().map(|(name, p)| (name.clone(), node.world.transform_point3(*p)));
            all[usize::from(view.labels.of_node(i))].extend(points);
        }
    }
    all
}

impl Keypoint {
    pub(super) fn seen(view: &LabelledView<'_>, (name, world): &Named) -> Self {
        let point = world.as_vec3a();
        let image = view.camera.project(point);
        // A rolling shutter has moved on by the time of the point's row.
        let ray = image.and_then(|image| view.camera.ray(image[0], image[1]));
        let eye = ray.map_or(view.camera.pose.position, |ray| ray.origin);
        let way = point - eye;
        let distance = way.length();
        let in_image = image.is_some_and(|image| view.camera.contains(image));
        let direction = way.normalize_or_zero();
        let [depth] = view.scene.optical_depths_at(eye, direction, f64::from(distance), [TAU_NM]);
        Self {
            name: name.clone(),
            world: *world,
            image,
            is_visible: in_image && is_seen(&view.scene.loaded().geometry, eye, point, false),
            distance_m: f64::from(distance),
            transmittance: math::f64::exp(-depth),
        }
    }
}
