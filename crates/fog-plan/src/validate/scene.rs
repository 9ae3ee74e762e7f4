//! Checks of `scene`.

use super::Check;
use crate::{
    ranges::{self, Range},
    scene::{ApproachSystem, SceneLimits, SceneSource, SceneSpec, SignStyle, WorldSpec},
    schema::{
        ApproachFile, LimitsFile, OrNone, SceneFile, StyleFile, WorldName,
        WorldName::{Highway, Runway, Targets, Urban},
    },
};

/// Seed of a scene that names none.
const DEFAULT_SEED: u64 = 1;
/// Widths of runways that there are markings for.
const RUNWAY_WIDTHS_M: [f64; 3] = [30.0, 45.0, 60.0];

impl Check<'_> {
    pub(super) fn scene(&mut self, scene: Option<&OrNone<SceneFile>>) -> Option<Option<SceneSpec>> {
        let why = "give {file: …}, {generate: …} or `none`";
        let scene = match self.required("scene", scene, why)? {
            OrNone::None(_) => return Some(None),
            OrNone::Some(scene) => scene,
        };
        let limits = self.limits(scene.limits.as_ref());
        self.foreign_scene_keys(scene);
        let source = match scene.generate {
            Some(_) if scene.file.is_some() => {
                self.problem("scene.file", "not with scene.generate: a scene is a file or made by formula");
                None
            }
            Some(name) => self.world(scene, name).map(SceneSource::Made),
            None if scene.file.is_none() && self.reported("scene.generate") => None,
            None => self.scene_file(scene),
        };
        let time_s = self.range("scene.time_s", scene.time_s.unwrap_or(0.0), ranges::TIME_S);
        Some(Some(SceneSpec { source: source?, time_s: time_s?, limits: limits? }))
    }

    fn scene_file(&mut self, scene: &SceneFile) -> Option<SceneSource> {
        let why = "path of a .glb or .gltf file; or generate, the name of a scene by formula";
        let file = self.required("scene.file", scene.file.as_deref(), why)?;
        let lower = file.to_ascii_lowercase();
        if !(lower.ends_with(".glb") || lower.ends_with(".gltf")) {
            self.problem("scene.file", format!("\"{file}\" is not a .glb or .gltf file"));
            return None;
        }
        Some(SceneSource::File { file: file.into() })
    }

    /// Options of another formula, or of a file.
    fn foreign_scene_keys(&mut self, file: &SceneFile) {
        const WITH_SEED: &[WorldName] = &[Urban, Highway, Runway];
        const ROADS: &[WorldName] = &[Urban, Highway];
        let keys: [(&'static str, bool, &[WorldName]); 17] = [
            ("seed", file.seed.is_some(), WITH_SEED),
            ("length_m", file.length_m.is_some(), WITH_SEED),
            ("style", file.style.is_some(), ROADS),
            ("traffic", file.traffic.is_some(), ROADS),
            ("people", file.people.is_some(), &[Urban]),
            ("limit", file.limit.is_some(), &[Urban]),
            ("gantries_m", file.gantries_m.is_some(), &[Highway]),
            ("width_m", file.width_m.is_some(), &[Runway]),
            ("designator", file.designator.is_some(), &[Runway]),
            ("approach", file.approach.is_some(), &[Runway]),
            ("papi_deg", file.papi_deg.is_some(), &[Runway]),
            ("lights_percent", file.lights_percent.is_some(), &[Runway]),
            ("flashers", file.flashers.is_some(), &[Runway]),
            ("boards_m", file.boards_m.is_some(), &[Targets]),
            ("black_m", file.black_m.is_some(), &[Targets]),
            ("black_deg", file.black_deg.is_some(), &[Targets]),
            ("eye_m", file.eye_m.is_some(), &[Targets]),
        ];
        let own = file.generate;
        let owned = |owners: &[WorldName]| own.is_some_and(|name| owners.contains(&name));
        let foreign = keys.into_iter().filter(|(_, given, owners)| *given && !owned(owners));
        let found = own.map_or("a file", WorldName::name);
        for (key, _, owners) in foreign {
            let names: Vec<&str> = owners.iter().map(|owner| owner.name()).collect();
            self.belongs("scene", key, ("generate", &names), found);
        }
    }

    fn world(&mut self, file: &SceneFile, name: WorldName) -> Option<WorldSpec> {
        let seed = file.seed.unwrap_or(DEFAULT_SEED);
        let mut number = |key: &str, value: Option<f64>, range: Range| {
            self.optional(&format!("scene.{key}"), value, range)
        };
        let style = file.style.map(|style| match style {
            StyleFile::Vienna => SignStyle::Vienna,
            StyleFile::Mutcd => SignStyle::Mutcd,
        });
        match name {
            WorldName::Street => Some(WorldSpec::Street),
            Urban => {
                let length_m = number("length_m", file.length_m, ranges::URBAN_LENGTH_M);
                let traffic = number("traffic", file.traffic, ranges::FULLNESS);
                let people = number("people", file.people, ranges::FULLNESS);
                let limit = match file.limit {
                    None => Some(None),
                    Some(limit) => self.whole("scene.limit", limit, ranges::SPEED_LIMIT).map(Some),
                };
                let (length_m, traffic, people, limit) = (length_m?, traffic?, people?, limit?);
                Some(WorldSpec::Urban { seed, length_m, style, traffic, people, limit })
            }
            Highway => {
                let length_m = number("length_m", file.length_m, ranges::HIGHWAY_LENGTH_M);
                let traffic = number("traffic", file.traffic, ranges::FULLNESS);
                let gantries_m = number("gantries_m", file.gantries_m, ranges::GANTRIES_M);
                let (length_m, traffic, gantries_m) = (length_m?, traffic?, gantries_m?);
                Some(WorldSpec::Highway { seed, length_m, style, traffic, gantries_m })
            }
            Runway => self.runway_scene(file, seed),
            Targets => {
                let black_deg = number("black_deg", file.black_deg, ranges::BLACK_DEG);
                let eye_m = number("eye_m", file.eye_m, ranges::EYE_M);
                let boards_m = self.distances("boards_m", file.boards_m.as_deref(), 5, ranges::BOARD_M);
                let black_m = self.distances("black_m", file.black_m.as_deref(), 8, ranges::BLACK_M);
                let (boards_m, black_m) = (boards_m?, black_m?);
                Some(WorldSpec::Targets { boards_m, black_m, black_deg: black_deg?, eye_m: eye_m? })
            }
        }
    }

    fn runway_scene(&mut self, file: &SceneFile, seed: u64) -> Option<WorldSpec> {
        let length_m = self.optional("scene.length_m", file.length_m, ranges::RUNWAY_LENGTH_M);
        let papi_deg = self.optional("scene.papi_deg", file.papi_deg, ranges::PAPI_DEG);
        let percent = self.optional("scene.lights_percent", file.lights_percent, ranges::LIGHTS_PERCENT);
        let width = file.width_m.filter(|width| !RUNWAY_WIDTHS_M.contains(width));
        if let Some(width) = width {
            self.problem(
                "scene.width_m",
                format!("{width} m is no width of a runway here; valid: 30, 45 or 60 m"),
            );
        }
        let approach = file.approach.map(|approach| match approach {
            ApproachFile::None => ApproachSystem::None,
            ApproachFile::Malsr => ApproachSystem::Malsr,
            ApproachFile::Alsf2 => ApproachSystem::Alsf2,
        });
        let (length_m, papi_deg, lights_percent) = (length_m?, papi_deg?, percent?);
        let (width_m, designator, flashers) = (file.width_m, file.designator.clone(), file.flashers);
        width.is_none().then_some(WorldSpec::Runway {
            seed,
            length_m,
            width_m,
            designator,
            approach,
            papi_deg,
            lights_percent,
            flashers,
        })
    }

    /// A list of distances, 1 to `most` of them.
    fn distances(
        &mut self,
        key: &str,
        values: Option<&[f64]>,
        most: usize,
        range: Range,
    ) -> Option<Option<Vec<f64>>> {
        let Some(values) = values else { return Some(None) };
        let path = format!("scene.{key}");
        if !(1..=most).contains(&values.len()) {
            self.problem(&path, format!("{} distances; valid: 1 to {most}", values.len()));
            return None;
        }
        let fine = |(i, value): (usize, &f64)| self.range(&format!("{path}.{i}"), *value, range);
        let checked: Vec<Option<f64>> = values.iter().enumerate().map(fine).collect();
        checked.into_iter().collect::<Option<Vec<f64>>>().map(Some)
    }

    fn limits(&mut self, file: Option<&LimitsFile>) -> Option<SceneLimits> {
        let Some(LimitsFile { triangles, texture_px, file_bytes, nodes }) = file.cloned() else {
            return Some(SceneLimits::default());
        };
        let mut fine = true;
        for (key, value) in [
            ("triangles", triangles),
            ("texture_px", texture_px),
            ("file_bytes", file_bytes),
            ("nodes", nodes),
        ] {
            if value == Some(0) {
                self.problem(&format!("scene.limits.{key}"), "0 leaves no scene; valid: 1 or more");
                fine = false;
            }
        }
        fine.then_some(SceneLimits { triangles, texture_px, file_bytes, nodes })
    }
}
