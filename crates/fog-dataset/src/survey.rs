//! What is there of all frames, by the names of the files alone: one listing, however many frames.

use crate::names::Kind;
use crate::store::Store;
use crate::{FrameList, FrameState, Result};

/// By frame, the kinds of file that are there.
#[derive(Debug)]
pub(crate) struct Survey(Vec<u16>);

impl Survey {
    /// Lists the files of a data set.
    pub(crate) fn of(store: &Store, frames: &FrameList) -> Result<Self> {
        let kinds: Vec<(String, u16)> = Kind::all().map(|kind| (kind.file(""), 1 << kind as u16)).collect();
        let mut found = vec![0; frames.len()];
        store.list(&mut |name| {
            for (suffix, bit) in &kinds {
                if let Some(place) = name.strip_suffix(suffix.as_str()).and_then(|id| frames.find(id)) {
                    found[place] |= bit;
                }
            }
        })?;
        Ok(Self(found))
    }

    pub(crate) fn has(&self, place: usize, kind: Kind) -> bool {
        self.0[place] & (1 << kind as u16) != 0
    }

    /// Done if the marker and the files that the outputs ask for are there: the marker was written when they were.
    pub(crate) fn state(&self, place: usize, frames: &FrameList) -> FrameState {
        let outputs = frames.outputs(place);
        let whole = || Kind::HASHED.iter().all(|&kind| !kind.wanted(outputs) || self.has(place, kind));
        let guess = [Kind::Denoised, Kind::DenoisedImage, Kind::Denoising];
        let denoised = || !outputs.denoised || guess.iter().all(|&kind| self.has(place, kind));
        if self.has(place, Kind::Done) && whole() && denoised() {
            FrameState::Done
        } else if self.has(place, Kind::Failed) {
            FrameState::Failed
        } else {
            FrameState::Missing
        }
    }
}
