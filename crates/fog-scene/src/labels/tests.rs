use super::*;
use crate::geometry::Geometry;
use crate::material::Material;
use crate::triangle::Triangle;
use crate::{SceneNode, SceneObject};
use fog_core::Vec3;
use glam::DMat4;

/// Name, parent, class and instance of a node.
type NodeRow<'a> = (&'a str, Option<u32>, Option<&'a str>, Option<&'a str>);

/// A scene of nodes, the objects on some of them, and a triangle of each (object, material).
fn scene(
    nodes: &[NodeRow<'_>],
    objects: &[u32],
    parts: &[(u32, u32)],
    materials: &[(&str, Option<&str>)],
) -> LoadedScene {
    let owned = |text: &Option<&str>| text.map(str::to_owned);
    let node = |(name, parent, class, instance): &NodeRow<'_>| SceneNode {
        name: (*name).to_owned(),
        parent: *parent,
        class: owned(class),
        instance: owned(instance),
        keypoints: Vec::new(),
        world: DMat4::IDENTITY,
    };
    let nodes: Vec<SceneNode> = nodes.iter().map(node).collect();
    let object = |&node: &u32| SceneObject {
        node,
        name: nodes[node as usize].name.clone(),
        mesh: Some(format!("mesh of {}", nodes[node as usize].name)),
        class: None,
        instance: None,
    };
    let objects = objects.iter().map(object).collect();
    // Side by side, for the sake of the hierarchy.
    let triangle = |&(object, material): &(u32, u32)| {
        let corner = |v: Vec3| v + Vec3::new((object % 256) as f32, 0.0, (object / 256) as f32);
        Triangle { object, material, ..Triangle::flat([Vec3::ZERO, Vec3::X, Vec3::Y].map(corner)) }
    };
    let geometry = Geometry::new(parts.iter().map(triangle).collect(), Vec::new());
    let material = |(name, class): &(&str, Option<&str>)| Material {
        name: (*name).to_owned(),
        class: owned(class),
        ..Material::default()
    };
    LoadedScene {
        geometry,
        nodes,
        objects,
        materials: materials.iter().map(material).collect(),
        ..LoadedScene::default()
    }
}

fn rule(class: &str, patterns: &[&str]) -> ClassRule {
    let pattern = |text: &&str| match text.strip_prefix("material:") {
        Some(name) => ClassPattern::Material(name.to_owned()),
        None => ClassPattern::Node((*text).to_owned()),
    };
    ClassRule { class: class.to_owned(), patterns: patterns.iter().map(pattern).collect() }
}

/// Class name and instance of each triangle.
fn found(scene: &LoadedScene, rules: &[ClassRule]) -> (Vec<(String, u16)>, Labels) {
    let labels = Labels::new(scene, rules).unwrap();
    let of = |i| (labels.table().name(labels.of(i).class).to_owned(), labels.of(i).instance);
    let all = (0..scene.geometry.triangles().len() as u32).map(of).collect();
    (all, labels)
}

fn want(pairs: &[(&str, u16)]) -> Vec<(String, u16)> {
    pairs.iter().map(|&(class, instance)| (class.to_owned(), instance)).collect()
}

#[test]
fn extras_are_handed_down_and_parts_of_one_thing_share_an_instance() {
    let nodes = [
        ("town", None, None, None),
        ("car_1", Some(0), Some("car"), Some("car_1")),
        ("plate", Some(1), Some("license plate"), None),
        ("wheel", Some(1), None, None),
        ("house", Some(0), Some("building"), None),
        ("window", Some(4), None, None),
        ("hydrant", Some(0), Some("hydrant"), None),
        ("empty", Some(4), None, None),
        ("leaf", Some(0), None, None),
    ];
    let materials = [("metal", None), ("green", Some("vegetation"))];
    let parts = [(0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (4, 0), (5, 0), (6, 1), (6, 0)];
    let scene = scene(&nodes, &[1, 2, 3, 4, 5, 6, 8], &parts, &materials);
    let (all, labels) = found(&scene, &[]);
    let expected = [
        ("car", 1),
        ("license plate", 1),
        ("car", 1),
        ("building", 2),
        ("building", 2),
        ("building", 2),
        ("unlabeled", 0),
        ("vegetation", 3),
        ("unlabeled", 0),
    ];
    assert_eq!(all, want(&expected));
    let names: Vec<_> = labels.instances().iter().map(|i| (i.name.as_str(), i.nodes.clone())).collect();
    assert_eq!(names, [("car_1", vec![1, 2, 3]), ("house", vec![4, 5]), ("leaf, vegetation", vec![8])]);
    assert_eq!(labels.instances()[1].triangles, [3, 4, 5]);
    assert_eq!(labels.unknown_classes(), ["hydrant"]);
    assert_eq!([3, 7, 0].map(|node| labels.of_node(node)), [1, 2, 0]);
}

#[test]
fn rules_come_before_extras_and_the_nearest_name_before_farther_ones() {
    let nodes = [
        ("land_1", None, Some("terrain"), None),
        ("tree_1", Some(0), None, None),
        ("lot", Some(0), None, None),
        ("van_7", None, Some("car"), None),
    ];
    let materials = [("asphalt 2", None), ("grass", Some("vegetation"))];
    let parts = [(0, 1), (0, 0), (1, 1), (2, 1), (3, 1), (3, 0)];
    let scene = scene(&nodes, &[0, 1, 2, 3], &parts, &materials);
    let rules = [
        rule("delivery van", &["mesh of van*"]),
        rule("road", &["road*", "material:asphalt*"]),
        rule("ground", &["land*"]),
        rule("vegetation", &["tree*"]),
    ];
    let (all, labels) = found(&scene, &rules);
    let expected = [
        ("ground", 1),
        ("road", 2),
        ("vegetation", 3),
        ("ground", 1),
        ("delivery van", 4),
        ("delivery van", 4),
    ];
    assert_eq!(all, want(&expected));
    assert_eq!(labels.instances()[1].name, "land_1, road");
    assert_eq!(labels.table().id("delivery van"), Some(44));
    let idle = Labels::idle_rules(&scene, &rules);
    assert_eq!(idle, [("road", &ClassPattern::Node("road*".to_owned()))]);
    // To take a class away.
    let (all, _) = found(&scene, &[rule("unlabeled", &["*"])]);
    assert!(all.iter().all(|(class, instance)| class == "unlabeled" && *instance == 0));
}

#[test]
fn more_instances_than_sixteen_bits_hold_are_refused() {
    let scene = |count: u32| {
        let names: Vec<String> = (0..count).map(|i| i.to_string()).collect();
        let nodes: Vec<_> = names.iter().map(|name| (name.as_str(), None, Some("pole"), None)).collect();
        let objects: Vec<u32> = (0..count).collect();
        let parts: Vec<(u32, u32)> = objects.iter().map(|&o| (o, 0)).collect();
        scene(&nodes, &objects, &parts, &[("m", None)])
    };
    assert_eq!(Labels::new(&scene(65_535), &[]).unwrap().instances().len(), 65_535);
    assert_eq!(Labels::new(&scene(65_536), &[]).unwrap_err(), TooManyInstances);
}
