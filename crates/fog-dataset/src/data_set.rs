//! The folder of a data set while it is being filled.

use std::fmt;

use serde_json::{Value, json};

use crate::header::{FORMAT, FORMAT_VERSION, Header};
use crate::marker::{Check, FileEntry, Marker};
use crate::names::{CLASSES, CONFIG, HEADER, Kind, PLAN};
use crate::opening::{self, Opening};
use crate::plan::{self, EachFrame, Planned};
use crate::read::{read_header_of, read_record_of};
use crate::side_by_side::side_by_side;
use crate::store::Store;
use crate::survey::Survey;
use crate::{Error, FrameFiles, FrameList, OutputSet, Result, denoised, encode, index};

/// What a data set is made from.
pub struct DataSetInfo<'a> {
    /// Its name.
    pub name: &'a str,
    /// Text of `config.resolved.yaml`.
    pub config_yaml: &'a str,
    /// Digest of the configuration: the same folder never holds two.
    pub config_digest: &'a str,
    /// Digest of the code that renders; the same folder never holds frames of two.
    pub code_digest: &'a str,
    /// All frames in order, also when this process renders only some.
    pub plan: Planned,
    /// Gives the same frames again, for the text of `plan.jsonl` where it is not there yet.
    pub frames: &'a EachFrame<'a>,
    /// Content of `classes.json`, where frames have classes.
    pub classes: Option<&'a Value>,
    /// Anything else for `dataset.json`, deterministic.
    pub details: &'a Value,
}

/// Whether a frame is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameState {
    /// Its marker and every file that its outputs ask for are there.
    Done,
    /// It is not done, and a failure is recorded.
    Failed,
    /// Neither.
    Missing,
}

impl FrameState {
    /// Lower-case word, as in `index.csv`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Failed => "failed",
            Self::Missing => "missing",
        }
    }
}

/// Numbers of frames by state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Complete frames.
    pub done: u64,
    /// Frames with a recorded failure.
    pub failed: u64,
    /// Frames that nobody has finished.
    pub missing: u64,
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} done, {} failed, {} missing", self.done, self.failed, self.missing)
    }
}

impl Counts {
    /// Counts a list of states.
    #[must_use]
    pub fn of(states: &[FrameState]) -> Self {
        let count = |state| states.iter().filter(|&&s| s == state).count() as u64;
        Self {
            done: count(FrameState::Done),
            failed: count(FrameState::Failed),
            missing: count(FrameState::Missing),
        }
    }
}

/// An open data set. Threads and processes may hold any number of them on one folder and write at the same time.
#[derive(Debug)]
pub struct DataSet {
    store: Store,
    header: Header,
    frames: FrameList,
}

impl DataSet {
    /// Begins a data set in a new or empty place, or goes on with the same one; removes what killed writers left. `opening`
    /// says what is to become of another one.
    ///
    /// `differ` gets the text of the folder's `config.resolved.yaml` and names the keys in which it differs from this
    /// configuration; it is only called for the message of [`Error::ConfigDiffers`].
    ///
    /// # Errors
    /// [`Error::ConfigDiffers`], [`Error::CodeDiffers`] or [`Error::PlanDiffers`] when the folder holds another data set,
    /// [`Error::NotAnExtension`] when it cannot be extended, [`Error::NotADataSet`] when it holds something else,
    /// [`Error::Damaged`] when its `dataset.json` is unreadable, [`Error::Io`] when the system refuses.
    pub fn create_or_open(
        store: Store,
        info: DataSetInfo<'_>,
        opening: Opening,
        differ: &dyn Fn(&str) -> Vec<String>,
    ) -> Result<Self> {
        let config = info.config_yaml.as_bytes().to_vec();
        let classes = info.classes.map(encode::pretty);
        let mut files = vec![FileEntry::of(CONFIG.to_owned(), &config), info.plan.entry()];
        files.extend(classes.as_ref().map(|classes| FileEntry::of(CLASSES.to_owned(), classes)));
        let header = header_of(&info, files);

        store.make()?;
        let mut found = claim(&store, &header)?;
        let (each, list) = (info.frames, info.plan.into_frames());
        if !found.is_of_one_data_set(&header) {
            found = match opening {
                Opening::Resume => return Err(difference(&store, found, header, differ)),
                Opening::Overwrite => opening::replace(&store, header)?,
                Opening::Extend => opening::extend(&store, &found, header, &list, each)?,
            };
        }

        // A process that was killed after claiming the folder may have left these out.
        for entry in &found.files {
            let text = match entry.name.as_str() {
                PLAN if entry.fault(&store, Check::Hash).is_some() => {
                    plan::write(&store, each)?;
                    continue;
                }
                PLAN => continue,
                CONFIG => &config,
                _ => classes.as_ref().unwrap_or(&config),
            };
            if entry.fault(&store, Check::Hash).is_some() {
                store.write(&entry.name, text.clone())?;
            }
        }
        store.sync()?;
        Ok(Self { store, header: found, frames: list })
    }

    /// Opens the data set that a place holds, by its own plan.
    ///
    /// # Errors
    /// [`Error::Io`] or [`Error::Damaged`] when its header or plan cannot be read.
    pub fn open(store: Store) -> Result<Self> {
        let header = read_header_of(&store)?;
        let frames = plan::read_list(&store)?;
        Ok(Self { store, header, frames })
    }

    /// Where it is.
    #[must_use]
    pub fn store(&self) -> &Store {
        &self.store
    }

    /// The frames, in order.
    #[must_use]
    pub fn frames(&self) -> &FrameList {
        &self.frames
    }

    /// Whether the frame's marker is whole, of this configuration and code, and every file that its outputs ask for is
    /// there with the recorded size. Anything unreadable counts as not done.
    #[must_use]
    pub fn is_done(&self, id: &str) -> bool {
        self.is_complete(id, Check::Size)
    }

    /// As [`DataSet::is_done`], with the hashes of the files too.
    #[must_use]
    pub fn is_intact(&self, id: &str) -> bool {
        self.is_complete(id, Check::Hash)
    }

    fn is_complete(&self, id: &str, check: Check) -> bool {
        let Ok(outputs) = self.outputs(id) else { return false };
        let Ok(Some(marker)) = Marker::read(&self.store, id) else { return false };
        self.header.takes(&marker.config_digest)
            && marker.code_digest == self.header.code_digest
            && marker.faults(&self.store, outputs, check).is_empty()
    }

    /// By frame, whether it is done, failed or neither, in plan order.
    ///
    /// One listing tells what is there. In a folder, where somebody may have cut a file, the sizes of frames that seem done are
    /// compared too ([`DataSet::is_done`]); a bucket has whole objects alone, and is not asked for each of them.
    ///
    /// # Errors
    /// [`Error::Io`] when the place cannot be listed.
    pub fn states(&self) -> Result<Vec<FrameState>> {
        Ok(self.states_of(&Survey::of(&self.store, &self.frames)?))
    }

    fn states_of(&self, survey: &Survey) -> Vec<FrameState> {
        side_by_side(&self.store, self.frames.len(), &|place| {
            let state = survey.state(place, &self.frames);
            let cut = state == FrameState::Done
                && !self.store.waits()
                && !self.is_complete(self.frames.id(place), Check::Size);
            match state {
                _ if cut && survey.has(place, Kind::Failed) => FrameState::Failed,
                _ if cut => FrameState::Missing,
                state => state,
            }
        })
    }

    /// The record of a frame.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read, [`Error::Damaged`] when it does not parse.
    pub fn read_record(&self, id: &str) -> Result<Value> {
        read_record_of(&self.store, id)
    }

    /// Writes the files that the frame's outputs ask for, then its marker, and forgets an earlier failure.
    ///
    /// # Errors
    /// [`Error::UnknownFrame`], [`Error::Frame`] for a picture that does not fit together, [`Error::Picture`] when it
    /// cannot be encoded, [`Error::Io`] when the system refuses. No marker is written then.
    pub fn write_frame(&self, files: &FrameFiles<'_>) -> Result<()> {
        let outputs = self.outputs(files.id)?;
        files.frame.check().map_err(|source| Error::Frame { id: files.id.to_owned(), source })?;

        let (mut entries, mut contents) = (Vec::new(), Vec::new());
        for kind in Kind::HASHED.into_iter().filter(|k| k.wanted(outputs)) {
            let name = kind.file(files.id);
            let content = encode::hashed(kind, files, outputs, &self.store.path(&name))?;
            entries.push(FileEntry::of(name.clone(), &content));
            contents.push((name, content));
        }
        if outputs.denoised {
            contents.extend(denoised::files(&self.store, files)?);
        }
        contents.push((Kind::Timing.file(files.id), encode::timing(files)));
        self.store.write_all(contents)?;
        // The files must be on the disk under their names before the marker says so.
        self.store.sync()?;
        let marker = json!(Marker {
            id: files.id.to_owned(),
            config_digest: self.header.config_digest.clone(),
            code_digest: self.header.code_digest.clone(),
            files: entries,
        });
        self.store.write(&Kind::Done.file(files.id), encode::pretty(&marker))?;
        self.store.remove(&Kind::Failed.file(files.id))?;
        self.store.sync()
    }

    /// Records why a frame failed; does nothing when another process has finished it meanwhile.
    ///
    /// # Errors
    /// [`Error::UnknownFrame`], or [`Error::Io`] when the system refuses.
    pub fn record_failure(&self, id: &str, reason: &str) -> Result<()> {
        self.outputs(id)?;
        if self.is_done(id) {
            return Ok(());
        }
        let content = encode::pretty(&json!({ "id": id, "reason": reason }));
        self.store.write(&Kind::Failed.file(id), content)?;
        self.store.sync()
    }

    /// Forgets that a frame is done, or that it failed, so that it is missing.
    ///
    /// # Errors
    /// [`Error::UnknownFrame`], or [`Error::Io`] when the system refuses.
    pub fn forget(&self, id: &str) -> Result<()> {
        self.outputs(id)?;
        [Kind::Done, Kind::Failed].iter().try_for_each(|kind| self.store.remove(&kind.file(id)))
    }

    /// Writes `index.csv` from what the folder holds now, and counts.
    ///
    /// Of several processes that finish at the same time the last one to write has seen every frame.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub fn finish(&self) -> Result<Counts> {
        let mut survey = Survey::of(&self.store, &self.frames)?;
        loop {
            let states = self.states_of(&survey);
            for (place, _) in states.iter().enumerate().filter(|(_, s)| **s == FrameState::Done) {
                if survey.has(place, Kind::Failed) {
                    self.store.remove(&Kind::Failed.file(self.frames.id(place)))?;
                }
            }
            index::write(&self.store, self.frames.all_outputs(), &states)?;
            self.store.sync()?;
            // A frame finished by another process meanwhile would be missing from an index written over its own.
            survey = Survey::of(&self.store, &self.frames)?;
            if self.states_of(&survey) == states {
                return Ok(Counts::of(&states));
            }
        }
    }

    fn outputs(&self, id: &str) -> Result<OutputSet> {
        let unknown = || Error::UnknownFrame { dir: self.store.place().to_path_buf(), id: id.to_owned() };
        self.frames.find(id).map(|place| self.frames.outputs(place)).ok_or_else(unknown)
    }
}

/// Why the folder's data set is not ours.
fn difference(store: &Store, found: Header, ours: Header, differ: &dyn Fn(&str) -> Vec<String>) -> Error {
    let dir = store.place().to_path_buf();
    if found.config_digest != ours.config_digest {
        let old = store.read(CONFIG).ok().flatten().and_then(|old| String::from_utf8(old).ok());
        return Error::ConfigDiffers { dir, keys: old.map_or_else(Vec::new, |old| differ(&old)) };
    }
    if found.code_digest != ours.code_digest {
        return Error::CodeDiffers { dir, found: found.code_digest, expected: ours.code_digest };
    }
    Error::PlanDiffers { dir }
}

fn header_of(info: &DataSetInfo<'_>, files: Vec<FileEntry>) -> Header {
    Header {
        format: FORMAT.to_owned(),
        format_version: FORMAT_VERSION,
        name: info.name.to_owned(),
        frames: info.plan.frames().len() as u64,
        config_digest: info.config_digest.to_owned(),
        extends: Vec::new(),
        code_digest: info.code_digest.to_owned(),
        files,
        details: info.details.clone(),
    }
}

/// The folder's header: the one that is there, or ours if nobody was first.
fn claim(store: &Store, ours: &Header) -> Result<Header> {
    if let Some(found) = Header::read(store)? {
        return Ok(found);
    }
    let other = store.other_than(HEADER)?;
    // Another process may claim the folder right now.
    if let Some(found) = other
        && Header::read(store)?.is_none()
    {
        return Err(Error::NotADataSet { dir: store.place().to_path_buf(), found });
    }
    store.write_new(HEADER, encode::pretty(&json!(ours)))?;
    Header::read(store)?.ok_or("it vanished").map_err(Error::damaged(&store.path(HEADER)))
}
