//! `include`: other files that a configuration is laid over.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use crate::{
    error::{Problem, Problems},
    merge::merge,
    node::{Node, Value},
    origin::{Origin, Source},
    set::remove,
    text_file, yaml,
};

/// The key, at the top of a file.
pub(crate) const KEY: &str = "include";
/// Longest chain of files that include one another.
const MAX_DEPTH: usize = 16;
/// Most files that one configuration is made of.
const MAX_FILES: usize = 100;
/// Largest configuration file in MiB: anything bigger is another kind of file.
const MAX_MIB: u64 = 16;

/// The text of a configuration file.
///
/// # Errors
/// If it cannot be read, is larger than 16 MiB or no UTF-8.
pub(crate) fn read_text(path: &Path) -> std::io::Result<String> {
    text_file::read_up_to(path, MAX_MIB, ": not a configuration")
}

/// Lays the tree of the file `name` over the files that it includes, and takes the key out. Their paths are relative to the
/// file; later ones lie over earlier ones. What cannot be included is a problem at the place that names it.
pub(crate) fn resolve(tree: Node, name: &str, problems: &mut Problems) -> Node {
    let file = PathBuf::from(name);
    let chain = vec![file.canonicalize().unwrap_or_else(|_| file.clone())];
    Resolver { files: 1, chain, problems }.under(tree, &file)
}

struct Resolver<'p> {
    /// Number of files so far.
    files: usize,
    /// The files that include one another down to the present one, by their true paths.
    chain: Vec<PathBuf>,
    problems: &'p mut Problems,
}

impl Resolver<'_> {
    fn under(&mut self, mut tree: Node, file: &Path) -> Node {
        let Some(node) = tree.child(KEY).cloned() else { return tree };
        remove(&mut tree, &[KEY.to_owned()]);
        let names = match &node.value {
            Value::Text(_) => vec![node],
            Value::List(items) => items.clone(),
            _ => {
                let text =
                    format!("expected the path of a file or a list of paths, found {}", node.describe());
                self.problems.add(Problem::new(&node.origin, KEY, text));
                return tree;
            }
        };
        let mut whole: Option<Node> = None;
        for name in names {
            match self.included(&name, file) {
                Ok(below) => match &mut whole {
                    Some(whole) => merge(whole, below),
                    None => whole = Some(below),
                },
                Err(text) => self.problems.add(Problem::new(&name.origin, KEY, text)),
            }
        }
        match whole {
            Some(mut whole) => {
                merge(&mut whole, tree);
                whole
            }
            None => tree,
        }
    }

    /// The tree of an included file, over those that it includes itself.
    fn included(&mut self, name: &Node, from: &Path) -> Result<Node, String> {
        let Value::Text(text) = &name.value else {
            return Err(format!("expected the path of a file, found {}", name.describe()));
        };
        let path = from.parent().unwrap_or(Path::new("")).join(text);
        let shown = path.display().to_string();
        let real = path.canonicalize().map_err(|e| format!("cannot read {shown}: {e}"))?;
        if self.chain.contains(&real) {
            return Err(format!("{shown} includes itself"));
        }
        if self.chain.len() >= MAX_DEPTH {
            return Err(format!(
                "{shown} is the {}th file that includes the next; at most {MAX_DEPTH}",
                MAX_DEPTH + 1
            ));
        }
        self.files += 1;
        if self.files > MAX_FILES {
            return Err(format!("more than {MAX_FILES} files in all"));
        }
        let text = read_text(&path).map_err(|e| format!("cannot read {shown}: {e}"))?;
        let via: Option<Arc<Origin>> = Some(Arc::new(name.origin.clone()));
        let source = Source { name: shown.as_str().into(), via };
        let tree = match yaml::parse(&text, &source) {
            Ok(tree) => tree,
            Err(problem) => {
                // The file's own place says more than the one that names it.
                self.problems.add(problem);
                return Ok(Node::new(Value::Map(Vec::new()), &Origin::start_of(&source)));
            }
        };
        match tree.value {
            Value::Map(_) => {}
            Value::Null => return Ok(Node::new(Value::Map(Vec::new()), &tree.origin)),
            _ => return Err(format!("{shown} is {}; expected a map", tree.describe())),
        }
        self.chain.push(real);
        let tree = self.under(tree, &path);
        self.chain.pop();
        Ok(tree)
    }
}
