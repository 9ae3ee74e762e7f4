//! Named groups of lights, whose light is told apart in the picture.

use crate::gltf_load::LoadedScene;
use crate::name_pattern::fits;

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightSource {
    /// The environment, uniform or an image.
    Environment,
    /// The sun.
    Sun,
    /// An emitting surface: the triangle of the geometry.
    Emitter(u32),
    /// A point or spot: index in [`crate::light_tree::LightTree::lights`].
    Lamp(usize),
    /// A directional light: index in [`crate::scene::Scene::beams`].
    Beam(usize),
}

/// Some of a scene's lights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightPattern {
    /// The environment.
    Environment,
    /// The sun.
    Sun,
    /// All points and spots of the scene file.
    Lamps,
    /// All directional lights of the scene file.
    Beams,
    /// All emitting surfaces.
    Emitters,
    /// Points, spots, directional lights and emitting surfaces of nodes with this name, in which `*` stands for any text.
    Node(String),
    /// Emitting surfaces of materials with this name, in which `*` stands for any text.
    Material(String),
}

impl LightPattern {
    /// False if it is a name that no node or no material of the scene has.
    #[must_use]
    pub fn is_known(&self, loaded: &LoadedScene) -> bool {
        match self {
            Self::Node(pattern) => {
                let lights = loaded.light_names.lamps.iter().chain(&loaded.light_names.beams);
                let mut nodes = loaded.objects.iter().map(|o| &o.name).chain(lights);
                nodes.any(|name| fits(pattern, name))
            }
            Self::Material(pattern) => loaded.materials.iter().any(|m| fits(pattern, &m.name)),
            _ => true,
        }
    }
}

/// A group of lights.
#[derive(Clone, Debug, PartialEq)]
pub struct LightGroup {
    /// Its name.
    pub name: String,
    /// What belongs to it unless an earlier group has it.
    pub lights: Vec<LightPattern>,
    /// Factor on the light of all of them, 0 or more.
    pub intensity: f32,
}

/// Groups in order: a light belongs to the first that it fits, or else to one more group, the [`LightGroups::REST`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightGroups {
    groups: Vec<LightGroup>,
}

impl LightGroups {
    /// Name of the group of all lights that belong to no other.
    pub const REST: &'static str = "rest";

    /// These groups and the rest.
    #[must_use]
    pub fn new(groups: Vec<LightGroup>) -> Self {
        Self { groups }
    }

    /// The names, the rest's last.
    pub fn names(&self) -> impl ExactSizeIterator<Item = &str> {
        (0..self.groups.len() + 1).map(|i| self.groups.get(i).map_or(Self::REST, |g| g.name.as_str()))
    }

    /// Factor on the light of a group; 1 for the rest.
    #[must_use]
    pub fn intensity(&self, group: usize) -> f32 {
        self.groups.get(group).map_or(1.0, |g| g.intensity)
    }

    fn first(&self, fits: impl Fn(&LightPattern) -> bool) -> usize {
        self.groups.iter().position(|g| g.lights.iter().any(&fits)).unwrap_or(self.groups.len())
    }

    fn of_node(&self, all: &LightPattern, node: &str) -> usize {
        self.first(|p| p == all || matches!(p, LightPattern::Node(pattern) if fits(pattern, node)))
    }
}

/// The group of every light of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Grouping {
    pub(crate) groups: LightGroups,
    pub(crate) environment: usize,
    pub(crate) sun: usize,
    /// As the lights of the loaded scene.
    pub(crate) lamps: Vec<usize>,
    pub(crate) beams: Vec<usize>,
    /// First group that has the emitting surfaces of each node, and those of each material.
    objects: Vec<usize>,
    materials: Vec<usize>,
}

impl Grouping {
    pub(crate) fn new(groups: LightGroups, loaded: &LoadedScene) -> Self {
        let name = |names: &[String], i: usize| names.get(i).cloned().unwrap_or_default();
        let all = |count: usize, pattern: &LightPattern, names: &[String]| -> Vec<usize> {
            (0..count).map(|i| groups.of_node(pattern, &name(names, i))).collect()
        };
        let lights = &loaded.lights;
        let of_material = |name: &str| {
            groups.first(|p| matches!(p, LightPattern::Material(pattern) if fits(pattern, name)))
        };
        Self {
            environment: groups.first(|p| *p == LightPattern::Environment),
            sun: groups.first(|p| *p == LightPattern::Sun),
            lamps: all(lights.lamps.len(), &LightPattern::Lamps, &loaded.light_names.lamps),
            beams: all(lights.beams.len(), &LightPattern::Beams, &loaded.light_names.beams),
            objects: loaded
                .objects
                .iter()
                .map(|o| groups.of_node(&LightPattern::Emitters, &o.name))
                .collect(),
            materials: loaded.materials.iter().map(|m| of_material(&m.name)).collect(),
            groups,
        }
    }

    /// Group of an emitting surface by its node and its material.
    pub(crate) fn of_surface(&self, object: u32, material: u32) -> usize {
        let rest = self.groups.groups.len();
        // A scene without nodes still has the pattern of all emitters.
        let by_object = self.objects.get(object as usize).copied();
        let by_object = by_object.unwrap_or_else(|| self.groups.first(|p| *p == LightPattern::Emitters));
        by_object.min(self.materials.get(material as usize).copied().unwrap_or(rest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_group_that_fits() {
        let group =
            |name: &str, lights: Vec<LightPattern>| LightGroup { name: name.into(), lights, intensity: 2.0 };
        let groups = LightGroups::new(vec![
            group("a", vec![LightPattern::Node("left*".into()), LightPattern::Sun]),
            group("b", vec![LightPattern::Lamps, LightPattern::Sun]),
        ]);
        assert_eq!(groups.names().collect::<Vec<_>>(), ["a", "b", "rest"]);
        assert_eq!(groups.of_node(&LightPattern::Lamps, "left 1"), 0);
        assert_eq!(groups.of_node(&LightPattern::Lamps, "right 1"), 1);
        assert_eq!(groups.of_node(&LightPattern::Beams, "right 1"), 2);
        assert_eq!(groups.first(|p| *p == LightPattern::Sun), 0);
        assert_eq!((groups.intensity(1), groups.intensity(2)), (2.0, 1.0));
    }
}
