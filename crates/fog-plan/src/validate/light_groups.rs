//! Checks of `lighting.groups`.

use super::Check;
use crate::{
    light_groups::{LightGroupSpec, LightsSpec},
    ranges,
    schema::LightGroupFile,
    words::expected_one_of,
};

/// Most groups of a frame: each is a layer of three channels.
const MAX_GROUPS: usize = 32;
/// Longest name of a group.
const MAX_NAME: usize = 32;
/// Name of the group that all other lights are in.
const REST: &str = "rest";

impl Check<'_> {
    pub(super) fn light_groups(&mut self, files: &[LightGroupFile]) -> Option<Vec<LightGroupSpec>> {
        if files.len() > MAX_GROUPS {
            self.problem(
                "lighting.groups",
                format!("{} groups are too many; at most {MAX_GROUPS}", files.len()),
            );
            return None;
        }
        let groups: Vec<_> = files.iter().enumerate().map(|(i, file)| self.light_group(i, file)).collect();
        let groups: Vec<LightGroupSpec> = groups.into_iter().collect::<Option<_>>()?;
        let mut unique = true;
        for (i, group) in groups.iter().enumerate() {
            if groups[..i].iter().any(|other| other.name == group.name) {
                self.problem(
                    &format!("lighting.groups.{i}.name"),
                    format!("\"{}\" is named twice", group.name),
                );
                unique = false;
            }
        }
        unique.then_some(groups)
    }

    fn light_group(&mut self, i: usize, file: &LightGroupFile) -> Option<LightGroupSpec> {
        let key = |key: &str| format!("lighting.groups.{i}.{key}");
        let name = self.required(&key("name"), file.name.as_deref(), "a name for the layer, such as sun");
        let name = name.and_then(|name| self.group_name(&key("name"), name));
        let why = "a list such as [sun, environment] or [\"node:street lamp*\"]";
        let words = self.required(&key("lights"), file.lights.as_deref(), why);
        let lights = words.and_then(|words| {
            if words.is_empty() {
                self.problem(&key("lights"), "empty; name at least one light");
            }
            let lights: Vec<_> = words
                .iter()
                .enumerate()
                .map(|(k, word)| self.lights(&key(&format!("lights.{k}")), word))
                .collect();
            lights.into_iter().collect::<Option<Vec<_>>>().filter(|lights| !lights.is_empty())
        });
        let intensity = match file.intensity {
            None => Some(1.0),
            Some(intensity) => self.range(&key("intensity"), intensity, ranges::INTENSITY),
        };
        Some(LightGroupSpec { name: name?, lights: lights?, intensity: intensity? })
    }

    fn group_name(&mut self, path: &str, name: &str) -> Option<String> {
        let fits = |c: char| c.is_ascii_alphanumeric() || "_-".contains(c);
        if name.is_empty() || name.len() > MAX_NAME || !name.chars().all(fits) {
            let rule = format!("use 1 to {MAX_NAME} letters, digits, `_` and `-`");
            self.problem(path, format!("\"{name}\" is not a name of a group: {rule}"));
            return None;
        }
        if name == REST {
            self.problem(path, "`rest` is taken: it is the group of all lights that belong to no other");
            return None;
        }
        Some(name.to_owned())
    }

    fn lights(&mut self, path: &str, word: &str) -> Option<LightsSpec> {
        let lights = LightsSpec::parse(word);
        if lights.is_none() {
            let mut known: Vec<&str> = LightsSpec::WORDS.iter().map(|(word, _)| *word).collect();
            known.extend(["node:NAME", "material:NAME"]);
            self.problem(path, format!("\"{word}\" is no light{}", expected_one_of(word, &known)));
        }
        lights
    }
}
