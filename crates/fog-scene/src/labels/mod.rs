//! What surfaces are: a class and an instance for each triangle.
//!
//! The class of a surface is, first, that of the first rule of the configuration that fits (a node's name, its mesh's, that of
//! its nearest ancestor that fits any, or the material's); else `extras.class` of the node, its mesh or its nearest ancestor;
//! else `extras.class` of the material; else it is unlabeled.
//!
//! An instance is all that has one `extras.instance`, on the node, its mesh or an ancestor; else all that got its class from one
//! node; else, where a material says the class, that node's part of this class. Instances are numbered from 1 in the order of
//! their first triangles. Unlabeled surfaces have none: their instance is 0, as that of the sky.

mod rules;
mod table;

pub use rules::{ClassPattern, ClassRule};
pub use table::{Class, ClassTable};

use crate::gltf_load::LoadedScene;
use rules::{Matches, NodeClass};
use std::collections::HashMap;

/// Class and instance of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Label {
    /// Number of the class.
    pub class: u8,
    /// Number of the instance; 0: none.
    pub instance: u16,
}

/// A thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instance {
    /// `extras.instance`, or the name of the node that it is.
    pub name: String,
    /// Class of its first part.
    pub class: u8,
    /// Indices of its nodes with meshes ([`LoadedScene::nodes`]), in order.
    pub nodes: Vec<u32>,
    /// Its triangles, in order.
    pub triangles: Vec<u32>,
}

/// More instances than a 16-bit picture can tell apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the scene has more than 65535 labelled instances; give parts of one thing one `extras.instance`, or fewer classes"
)]
pub struct TooManyInstances;

/// Classes and instances of a scene.
#[derive(Clone, Debug)]
pub struct Labels {
    triangles: Vec<Label>,
    instances: Vec<Instance>,
    /// Instance of each node, 0 where it has none: whose keypoints it holds.
    nodes: Vec<u16>,
    table: ClassTable,
    unknown: Vec<String>,
}

/// What parts of one instance have in common.
#[derive(PartialEq, Eq, Hash)]
enum Key<'a> {
    Named(&'a str),
    Node(u32),
    Part(u32, u8),
}

impl Labels {
    /// Labels of all triangles of a scene.
    ///
    /// # Errors
    /// If there are too many instances.
    pub fn new(loaded: &LoadedScene, rules: &[ClassRule]) -> Result<Self, TooManyInstances> {
        let table = ClassTable::new(rules.iter().map(|rule| rule.class.as_str()));
        let matches = Matches::new(loaded, rules, &table);
        let mut this = Self {
            triangles: Vec::with_capacity(loaded.geometry.triangles().len()),
            instances: Vec::new(),
            nodes: vec![0; loaded.nodes.len()],
            unknown: matches.unknown.iter().map(|&name| name.to_owned()).collect(),
            table,
        };
        let mut known: HashMap<Key<'_>, u16> = HashMap::new();
        let mut last = None;
        for (triangle, t) in loaded.geometry.triangles().iter().enumerate() {
            let surface = (t.object, t.material);
            let label = match last {
                Some((same, label)) if same == surface => label,
                _ => this.label(loaded, &matches, surface, &mut known)?,
            };
            last = Some((surface, label));
            this.triangles.push(label);
            if let Some(instance) = this.instances.get_mut(usize::from(label.instance).wrapping_sub(1)) {
                instance.triangles.push(triangle as u32);
            }
        }
        this.own_nodes(loaded, &matches, &known);
        Ok(this)
    }

    /// Label of a node's part of one material.
    fn label<'a>(
        &mut self,
        loaded: &'a LoadedScene,
        matches: &Matches<'a>,
        (object, material): (u32, u32),
        known: &mut HashMap<Key<'a>, u16>,
    ) -> Result<Label, TooManyInstances> {
        let node = loaded.objects.get(object as usize).map_or(0, |object| object.node);
        let of_node = matches.of_node(object);
        let of_material = matches.of_material(material);
        let (class, key) = match matches.choose(of_node, of_material) {
            NodeClass::Unlabeled => return Ok(Label::default()),
            NodeClass::Of { class, origin } => (class, Key::Node(origin)),
            NodeClass::OfMaterial { class } => (class, Key::Part(node, class)),
        };
        let key = loaded.instance_name(node).map_or(key, Key::Named);
        let name = match &key {
            Key::Named(name) => (*name).to_owned(),
            Key::Node(origin) => loaded.node_name(*origin).to_owned(),
            Key::Part(node, class) => format!("{}, {}", loaded.node_name(*node), self.table.name(*class)),
        };
        let instance = match known.get(&key) {
            Some(&instance) => instance,
            None => {
                let id = u16::try_from(self.instances.len() + 1).map_err(|_| TooManyInstances)?;
                self.instances.push(Instance { name, class, nodes: Vec::new(), triangles: Vec::new() });
                known.insert(key, id);
                id
            }
        };
        let nodes = &mut self.instances[usize::from(instance) - 1].nodes;
        if nodes.last() != Some(&node) {
            nodes.push(node);
        }
        Ok(Label { class, instance })
    }

    /// Gives nodes without a mesh of their own, too, the instance that they are parts of.
    fn own_nodes<'a>(
        &mut self,
        loaded: &'a LoadedScene,
        matches: &Matches<'a>,
        known: &HashMap<Key<'a>, u16>,
    ) {
        for node in 0..loaded.nodes.len() as u32 {
            let by_name = loaded.instance_name(node).and_then(|name| known.get(&Key::Named(name)));
            let by_class = || match matches.class_of_node(node) {
                NodeClass::Of { origin, .. } => known.get(&Key::Node(origin)),
                _ => None,
            };
            self.nodes[node as usize] = by_name.or_else(by_class).copied().unwrap_or(0);
        }
    }

    /// Class and instance of a triangle.
    ///
    /// # Panics
    /// If the scene has no such triangle.
    #[inline]
    #[must_use]
    pub fn of(&self, triangle: u32) -> Label {
        self.triangles[triangle as usize]
    }

    /// Things by number: that of instance i is at i − 1.
    #[must_use]
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// Instance that a node is a part of; 0: none.
    ///
    /// # Panics
    /// If the scene has no such node.
    #[must_use]
    pub fn of_node(&self, node: u32) -> u16 {
        self.nodes[node as usize]
    }

    /// The classes.
    #[must_use]
    pub fn table(&self) -> &ClassTable {
        &self.table
    }

    /// Names of `extras.class` that are none of the classes, sorted: what has them is unlabeled.
    #[must_use]
    pub fn unknown_classes(&self) -> &[String] {
        &self.unknown
    }

    /// Rules that fit nothing in a scene, as class and pattern.
    pub fn idle_rules<'r>(loaded: &LoadedScene, rules: &'r [ClassRule]) -> Vec<(&'r str, &'r ClassPattern)> {
        let patterns = rules.iter().flat_map(|rule| rule.patterns.iter().map(|p| (rule.class.as_str(), p)));
        patterns.filter(|(_, pattern)| !pattern.is_known(loaded)).collect()
    }
}

#[cfg(test)]
mod tests;
