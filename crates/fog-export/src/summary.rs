//! What an export did.

use std::cell::RefCell;

use serde::Serialize;

/// What an export did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// Frames exported.
    pub exported: u64,
    /// Frames of the plan that have failed, and are not in the export.
    pub failed: u64,
    /// Frames of the plan that nobody has rendered, and are not in the export.
    pub missing: u64,
    /// Whether the same export was there already, so that nothing was done.
    pub was_there: bool,
    /// What the format could not hold, in the order in which it came up.
    pub losses: Vec<Loss>,
}

/// Something that the format could not hold as it was.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, serde::Deserialize)]
pub struct Loss {
    /// Short name, as `depth_beyond_256_m`.
    pub name: String,
    /// How often.
    pub count: u64,
    /// Of what, and what became of it: "pixels with a depth of 256 m or more, stored as 0 (no value)".
    pub what: String,
}

/// Counts losses while frames are written.
#[derive(Debug, Default)]
pub(crate) struct Losses(RefCell<Vec<Loss>>);

impl Losses {
    /// Counts `count` more of a loss; none if it is 0.
    pub(crate) fn add(&self, name: &str, count: u64, what: &str) {
        if count == 0 {
            return;
        }
        let mut all = self.0.borrow_mut();
        match all.iter_mut().find(|loss| loss.name == name) {
            Some(loss) => loss.count += count,
            None => all.push(Loss { name: name.to_owned(), count, what: what.to_owned() }),
        }
    }

    /// All of them.
    pub(crate) fn list(&self) -> Vec<Loss> {
        self.0.borrow().clone()
    }
}
