//! Reading node animations.

use super::Warnings;
use super::accessor::Buffers;
use super::nodes::{local_transform, node_name};
use crate::animation::{Animation, Interpolation, MovingNode, Rest, Track};
use crate::error::{Failure, SceneErrorKind};
use glam::{DQuat, DVec3};
use gltf::animation::{Channel, Property};
use gltf::scene::Transform;
use gltf::{Document, Node};

/// Most key frames of a track.
const MAX_KEYS: usize = 10_000_000;

/// The animations of a document, played together; none where no node moves. Objects and parents come with the tree.
pub(super) fn read(
    document: &Document,
    buffers: &Buffers,
    warnings: &mut Warnings,
) -> Result<Option<Animation>, Failure> {
    let count = document.nodes().len();
    let mut nodes: Vec<MovingNode> = Vec::new();
    for animation in document.animations() {
        let name = animation.name().map_or_else(|| format!("{}", animation.index()), str::to_owned);
        for channel in animation.channels() {
            let node = channel.target().node();
            let place = || format!("animation `{name}`, node `{}`", node_name(&node));
            if channel.target().property() == Property::MorphTargetWeights {
                warnings.add(format!("{}: moves morph targets, which are not supported", place()));
                continue;
            }
            if !matches!(node.transform(), Transform::Decomposed { .. }) {
                warnings.add(format!("{}: a node with a matrix cannot be animated; left out", place()));
                continue;
            }
            nodes.resize_with(count, MovingNode::default);
            let target = &mut nodes[node.index()];
            let fresh =
                add(&channel, buffers, target).map_err(|text| SceneErrorKind::Node(text).at(place))?;
            if !fresh {
                warnings.add(format!(
                    "{}: moves what another animation moves already; the first counts",
                    place()
                ));
            }
            target.rest = Some(rest(&node).map_err(|e| e.at(place))?);
        }
    }
    if !nodes.iter().any(MovingNode::moves) {
        return Ok(None);
    }
    for node in document.nodes() {
        let place = || format!("node `{}`", node_name(&node));
        nodes[node.index()].local = local_transform(&node).map_err(|e| e.at(place))?;
    }
    Ok(Some(Animation { nodes, objects: Vec::new() }))
}

/// Adds a channel's track; false if the node has one for that property.
fn add(channel: &Channel<'_>, buffers: &Buffers, node: &mut MovingNode) -> Result<bool, String> {
    fn put<const N: usize>(slot: &mut Option<Track<N>>, track: Track<N>) -> bool {
        let fresh = slot.is_none();
        slot.get_or_insert(track);
        fresh
    }
    Ok(match channel.target().property() {
        Property::Translation => put(&mut node.translation, track(channel, buffers)?),
        Property::Scale => put(&mut node.scale, track(channel, buffers)?),
        Property::Rotation => {
            let track: Track<4> = track(channel, buffers)?;
            let step = if track.interpolation == Interpolation::CubicSpline { 3 } else { 1 };
            let mut keys = track.values.iter().skip(step / 2).step_by(step);
            if keys.any(|q| q.iter().map(|c| c * c).sum::<f32>() < 1e-12) {
                return Err("has a key frame with a rotation that is not a quaternion".into());
            }
            put(&mut node.rotation, track)
        }
        Property::MorphTargetWeights => false,
    })
}

fn track<const N: usize>(channel: &Channel<'_>, buffers: &Buffers) -> Result<Track<N>, String> {
    let sampler = channel.sampler();
    let times = buffers.floats::<1>(&sampler.input(), MAX_KEYS).map_err(|e| format!("its times: {e}"))?;
    let times: Vec<f64> = times.iter().map(|[t]| f64::from(*t)).collect();
    let values =
        buffers.floats::<N>(&sampler.output(), 3 * MAX_KEYS).map_err(|e| format!("its values: {e}"))?;
    let (interpolation, each) = match sampler.interpolation() {
        gltf::animation::Interpolation::Step => (Interpolation::Step, 1),
        gltf::animation::Interpolation::Linear => (Interpolation::Linear, 1),
        gltf::animation::Interpolation::CubicSpline => (Interpolation::CubicSpline, 3),
    };
    if times.is_empty() || values.len() != each * times.len() {
        return Err(format!("has {} values for {} key frames", values.len(), times.len()));
    }
    // Comparison with NaN is false: it is refused too.
    let rising = times.windows(2).all(|t| t[0] < t[1]) && times.iter().all(|t| t.is_finite());
    if !rising {
        return Err("has key frames whose times do not increase".into());
    }
    if !values.as_flattened().iter().all(|v| v.is_finite()) {
        return Err("has values that are not finite".into());
    }
    Ok(Track { times, values, interpolation })
}

fn rest(node: &Node<'_>) -> Result<Rest, SceneErrorKind> {
    // Checked on the way.
    local_transform(node)?;
    let (translation, rotation, scale) = node.transform().decomposed();
    Ok(Rest {
        translation: DVec3::from_array(translation.map(f64::from)),
        rotation: DQuat::from_array(rotation.map(f64::from)).normalize(),
        scale: DVec3::from_array(scale.map(f64::from)),
    })
}
