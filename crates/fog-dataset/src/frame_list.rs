//! The frames of a plan in a few bytes each, for plans of millions.

use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};

use crate::names::check_id;
use crate::{Error, OutputSet, Result};

/// Ids and outputs of a plan's frames, in order.
#[derive(Clone, Debug, Default)]
pub struct FrameList {
    /// All ids one after the other, and where each ends.
    ids: String,
    ends: Vec<usize>,
    /// By frame, which of the sets of outputs it has: a plan has few.
    sets: Vec<u16>,
    outputs: Vec<OutputSet>,
    /// Places by the hash of the id, or the next number that is free.
    places: HashMap<u64, u32>,
    hasher: RandomState,
}

impl FrameList {
    /// The next frame.
    ///
    /// # Errors
    /// [`Error::BadId`] for an id that cannot name files, or that comes twice.
    pub fn push(&mut self, id: &str, outputs: OutputSet) -> Result<()> {
        check_id(id)?;
        let bad = |reason| Error::BadId { id: id.to_owned(), reason };
        let place = u32::try_from(self.len()).map_err(|_| bad("the plan has more than 4 billion frames"))?;
        let mut key = self.hasher.hash_one(id);
        while let Some(&other) = self.places.get(&key) {
            if self.id(other as usize) == id {
                return Err(bad("the plan has it twice"));
            }
            key = key.wrapping_add(1);
        }
        let set = self.outputs.iter().position(|&known| known == outputs).unwrap_or(self.outputs.len());
        self.sets.push(u16::try_from(set).map_err(|_| bad("the plan has more than 65536 sets of outputs"))?);
        if set == self.outputs.len() {
            self.outputs.push(outputs);
        }
        self.places.insert(key, place);
        self.ids.push_str(id);
        self.ends.push(self.ids.len());
        Ok(())
    }

    /// Number of frames.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Id of a frame, which must be there.
    #[must_use]
    pub fn id(&self, place: usize) -> &str {
        let start = if place == 0 { 0 } else { self.ends[place - 1] };
        &self.ids[start..self.ends[place]]
    }

    /// Outputs of a frame, which must be there.
    #[must_use]
    pub fn outputs(&self, place: usize) -> OutputSet {
        self.outputs[usize::from(self.sets[place])]
    }

    /// Place of the frame with this id.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<usize> {
        let mut key = self.hasher.hash_one(id);
        loop {
            let place = *self.places.get(&key)? as usize;
            if self.id(place) == id {
                return Some(place);
            }
            key = key.wrapping_add(1);
        }
    }

    /// Every set of outputs that some frame has.
    pub(crate) fn all_outputs(&self) -> &[OutputSet] {
        &self.outputs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_found_again() {
        let mut list = FrameList::default();
        let outputs = |i: usize| OutputSet { image: true, hdr: i.is_multiple_of(3), ..OutputSet::default() };
        for i in 0..1000 {
            list.push(&format!("f{i}"), outputs(i)).expect("a new id");
        }
        assert_eq!((list.len(), list.all_outputs().len()), (1000, 2));
        for i in 0..1000 {
            let id = format!("f{i}");
            assert_eq!((list.find(&id), list.id(i), list.outputs(i)), (Some(i), id.as_str(), outputs(i)));
        }
        assert_eq!(list.find("f1000"), None);
        assert!(list.push("f7", outputs(0)).is_err() && list.push("../f", outputs(0)).is_err());
        assert_eq!(list.len(), 1000);
    }
}
