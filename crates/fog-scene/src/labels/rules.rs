//! Which rule fits what.

use super::ClassTable;
use crate::gltf_load::LoadedScene;
use crate::name_pattern::fits;
use std::collections::BTreeSet;

/// What a rule looks at; `*` in a name stands for any text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ClassPattern {
    /// Nodes and meshes of this name, and what is below such nodes.
    Node(String),
    /// Surfaces of materials of this name.
    Material(String),
}

/// Surfaces that are of a class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassRule {
    /// Name of the class.
    pub class: String,
    /// Any of these fits.
    pub patterns: Vec<ClassPattern>,
}

impl ClassPattern {
    /// False if no node, mesh or material of the scene has such a name.
    pub(super) fn is_known(&self, loaded: &LoadedScene) -> bool {
        match self {
            Self::Node(pattern) => {
                let meshes = loaded.objects.iter().filter_map(|object| object.mesh.as_deref());
                let mut names = loaded.nodes.iter().map(|node| node.name.as_str()).chain(meshes);
                names.any(|name| fits(pattern, name))
            }
            Self::Material(pattern) => loaded.materials.iter().any(|m| fits(pattern, &m.name)),
        }
    }
}

/// Where a class comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NodeClass {
    Unlabeled,
    /// From this node.
    Of {
        class: u8,
        origin: u32,
    },
    OfMaterial {
        class: u8,
    },
}

/// A rule that fits, by its place among the rules, and where.
type Fit = Option<(usize, u32)>;

/// What fits the nodes, objects and materials of a scene.
pub(super) struct Matches<'a> {
    rules: Vec<u8>,
    /// By node, from its name or those of its ancestors.
    node_rules: Vec<Fit>,
    /// By object, its mesh's name included.
    object_rules: Vec<Fit>,
    object_nodes: Vec<u32>,
    material_rules: Vec<Option<usize>>,
    /// `extras.class` that are classes, by node and by material.
    node_extras: Vec<Option<(u8, u32)>>,
    material_extras: Vec<Option<u8>>,
    /// Names in extras that are no classes.
    pub(super) unknown: BTreeSet<&'a str>,
}

impl<'a> Matches<'a> {
    pub(super) fn new(loaded: &'a LoadedScene, rules: &[ClassRule], table: &ClassTable) -> Self {
        let first =
            |fits: &dyn Fn(&ClassPattern) -> bool| rules.iter().position(|r| r.patterns.iter().any(fits));
        let by_name =
            |name: &str| first(&|p| matches!(p, ClassPattern::Node(pattern) if fits(pattern, name)));
        let by_material =
            |name: &str| first(&|p| matches!(p, ClassPattern::Material(pattern) if fits(pattern, name)));
        let mut unknown = BTreeSet::new();
        let mut class = |name: &'a Option<String>| {
            let name = name.as_deref()?;
            let id = table.id(name);
            if id.is_none() {
                unknown.insert(name);
            }
            id
        };
        // Parents come before their children.
        let mut node_rules: Vec<Fit> = Vec::with_capacity(loaded.nodes.len());
        let mut node_extras: Vec<Option<(u8, u32)>> = Vec::with_capacity(loaded.nodes.len());
        for (node, i) in loaded.nodes.iter().zip(0u32..) {
            let above = node.parent.map(|parent| parent as usize);
            let own = by_name(&node.name).map(|rule| (rule, i));
            node_rules.push(own.or_else(|| node_rules[above?]));
            // A class that is none hides what is above: it was meant to be another.
            node_extras.push(match &node.class {
                Some(_) => class(&node.class).map(|class| (class, i)),
                None => above.and_then(|above| node_extras[above]),
            });
        }
        let object_rules = loaded.objects.iter().map(|object| {
            let own = by_name(&loaded.nodes[object.node as usize].name).map(|rule| (rule, object.node));
            let of_mesh = || by_name(object.mesh.as_deref()?).map(|rule| (rule, object.node));
            own.or_else(of_mesh).or(node_rules[object.node as usize])
        });
        Self {
            object_rules: object_rules.collect(),
            object_nodes: loaded.objects.iter().map(|object| object.node).collect(),
            material_rules: loaded.materials.iter().map(|m| by_material(&m.name)).collect(),
            material_extras: loaded.materials.iter().map(|m| class(&m.class)).collect(),
            rules: rules.iter().map(|rule| table.id(&rule.class).unwrap_or_default()).collect(),
            node_rules,
            node_extras,
            unknown,
        }
    }

    /// What fits an object: its rule, and its extras.
    pub(super) fn of_node(&self, object: u32) -> (Fit, Option<(u8, u32)>) {
        let object = object as usize;
        let extras = self.object_nodes.get(object).and_then(|&node| self.node_extras[node as usize]);
        (self.object_rules.get(object).copied().flatten(), extras)
    }

    /// What fits a material: its rule, and its extras.
    pub(super) fn of_material(&self, material: u32) -> (Option<usize>, Option<u8>) {
        let material = material as usize;
        let rule = self.material_rules.get(material).copied().flatten();
        (rule, self.material_extras.get(material).copied().flatten())
    }

    /// The class of a surface of an object and a material.
    pub(super) fn choose(
        &self,
        (node_rule, node_extras): (Fit, Option<(u8, u32)>),
        (material_rule, material_extras): (Option<usize>, Option<u8>),
    ) -> NodeClass {
        let found = match (node_rule, material_rule) {
            (Some((rule, origin)), other) if other.is_none_or(|other| rule <= other) => {
                NodeClass::Of { class: self.rules[rule], origin }
            }
            (_, Some(rule)) => NodeClass::OfMaterial { class: self.rules[rule] },
            _ => match (node_extras, material_extras) {
                (Some((class, origin)), _) => NodeClass::Of { class, origin },
                (None, Some(class)) => NodeClass::OfMaterial { class },
                _ => NodeClass::Unlabeled,
            },
        };
        match found {
            NodeClass::Of { class: ClassTable::UNLABELED, .. }
            | NodeClass::OfMaterial { class: ClassTable::UNLABELED } => NodeClass::Unlabeled,
            found => found,
        }
    }

    /// The class that a node hands on, whatever its materials.
    pub(super) fn class_of_node(&self, node: u32) -> NodeClass {
        let node = node as usize;
        self.choose((self.node_rules[node], self.node_extras[node]), (None, None))
    }
}
