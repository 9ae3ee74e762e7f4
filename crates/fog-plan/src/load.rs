//! From text to plan.

use std::path::Path;

use crate::{
    error::{PlanError, Problem, Problems},
    fill::{fill_fov, fill_model, fill_sections, fill_sky},
    include,
    node::{Node, Value},
    origin::{Origin, Source},
    plan::Plan,
    read::read,
    schema::{ConfigFile, DEFAULT_SEED},
    set::set,
    sweep::Sweep,
    words::expected_one_of,
    yaml,
};

/// The version of the configuration format.
const VERSION: i64 = 1;
/// Longest name of a configuration.
const MAX_NAME: usize = 100;

/// Reads, overrides and checks a configuration file. `sets` are `KEY=VALUE` arguments, applied in order.
///
/// Only the file itself and those that it includes are read: whether the scene and other files that it names exist is for the
/// caller to see.
///
/// # Errors
/// The file cannot be read (or has more than 16 MiB), or its problems: all that can be found at once, 20 at most.
pub fn load(path: &Path, sets: &[String]) -> Result<Plan, PlanError> {
    let read = include::read_text(path);
    let text = read.map_err(|source| PlanError::Read { path: path.to_owned(), source })?;
    parse(&text, &path.to_string_lossy(), sets)
}

/// As [`load`], from text; `file_name` is for messages, and files that the text includes are looked for beside it.
///
/// ```
/// let text = "version: 1\nname: demo\nscene: none\nfog: {model: advection, height_m: 180}\n";
/// let plan = fog_plan::parse(text, "demo.yaml", &["fog.height_m=260".to_owned()])?;
/// assert_eq!(plan.len(), 1);
///
/// let wrong = fog_plan::parse("version: 1\nname: demo\nscene: none\nfog: nune\n", "demo.yaml", &[]);
/// assert!(wrong.unwrap_err().to_string().starts_with("demo.yaml:4:6: fog: expected `none` or a map"));
/// # Ok::<(), fog_plan::PlanError>(())
/// ```
///
/// # Errors
/// The problems of the configuration: all that can be found at once, 20 at most.
pub fn parse(text: &str, file_name: &str, sets: &[String]) -> Result<Plan, PlanError> {
    let fatal = |problem| PlanError::Invalid(vec![problem]);
    let mut tree = yaml::parse(text, &Source::named(file_name)).map_err(fatal)?;
    if !matches!(tree.value, Value::Map(_)) {
        let message = format!("expected a configuration (a map), found {}", tree.describe());
        return Err(fatal(Problem::new(&tree.origin, "", message)));
    }
    let mut problems = Problems::default();
    tree = include::resolve(tree, file_name, &mut problems);
    // Defaults first: overrides may step into them. Then again, for what the overrides have added.
    fill_sections(&mut tree);
    for argument in sets {
        if let Err(problem) = apply(&mut tree, argument) {
            problems.add(problem);
        }
    }
    fill_sections(&mut tree);
    // The document as a whole; keys that frames lack are found with the frames.
    let reading = read::<ConfigFile>(&tree);
    problems.extend(reading.problems);
    let file = reading.value.unwrap_or_default();
    let dropped =
        |key: &str| reading.dropped.iter().any(|path| path.first().is_some_and(|first| first == key));
    if !dropped("version") {
        check_version(&tree, file.version, &mut problems);
    }
    if !dropped("name") {
        check_name(&tree, file.name.as_deref(), &mut problems);
    }
    let sweep_node = tree.child("sweep").filter(|node| node.value != Value::Null);
    let sweep = sweep_node.map(|node| Sweep::read(node, &mut problems));
    if let Some(None) = sweep {
        // Without axes there are no frames to check.
        return Err(PlanError::Invalid(problems.into_vec()));
    }
    let sweep = sweep.flatten();
    let changes = |key: &str| {
        let mut axes = sweep.iter().flat_map(|sweep| &sweep.axes).flat_map(|axis| &axis.paths);
        axes.any(|path| path == key)
    };
    if !changes("fog.model") {
        fill_model(&mut tree);
    }
    if !changes("lighting.sky.model") {
        fill_sky(&mut tree);
    }
    let lens = |path: &str| path.starts_with("sensor.intrinsics") || path.starts_with("sensor.lens");
    let mut axes = sweep.iter().flat_map(|sweep| &sweep.axes).flat_map(|axis| &axis.paths);
    if !axes.any(|path| lens(path)) {
        fill_fov(&mut tree);
    }
    tree.sort_sections();
    let mut plan = Plan::new(file.name.unwrap_or_default(), file.seed.unwrap_or(DEFAULT_SEED), tree, sweep);
    plan.lay_out(&mut problems);
    plan.check_quickly(&mut problems);
    problems.into_result()?;
    Ok(plan)
}

/// Applies one `--set KEY=VALUE`.
fn apply(tree: &mut Node, argument: &str) -> Result<(), Problem> {
    let origin = Origin::Set(argument.into());
    let Some((path, text)) = argument.split_once('=') else {
        return Err(Problem::new(&origin, "", "expected KEY=VALUE, such as camera.altitude_m=30"));
    };
    let path = path.trim();
    if path.split('.').next() == Some(include::KEY) {
        return Err(Problem::new(
            &origin,
            path,
            "can only be written in a file: its files are read before anything is set",
        ));
    }
    let mut value = yaml::parse(text, &Source::named(""))
        .map_err(|problem| Problem::new(&origin, path, problem.message))?;
    value.set_origin(&origin);
    set(tree, path, &origin, value).map_err(|message| Problem::new(&origin, path, message))
}

fn check_version(tree: &Node, version: Option<i64>, problems: &mut Problems) {
    let message = match version {
        Some(VERSION) => return,
        Some(other) => format!("version {other} is unknown{}", expected_one_of(&other.to_string(), &["1"])),
        None => "missing; write `version: 1`".to_owned(),
    };
    problems.add(Problem::new(tree.origin_of("version"), "version", message));
}

fn check_name(tree: &Node, name: Option<&str>, problems: &mut Problems) {
    let fits = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
    let message = match name {
        None => "missing; give the data set a name, such as `name: quickstart`".to_owned(),
        Some(name) if name.is_empty() || name.len() > MAX_NAME || !name.chars().all(fits) => {
            format!("\"{name}\" is not a name: use 1 to {MAX_NAME} letters, digits, `.`, `_` and `-`")
        }
        Some(_) => return,
    };
    problems.add(Problem::new(tree.origin_of("name"), "name", message));
}
