//! The folder of a data set while it is being filled.

use std::collections::HashMap;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::header::{FORMAT, FORMAT_VERSION, Header};
use crate::marker::{Check, FileEntry, Marker};
use crate::names::{CLASSES, CONFIG, HEADER, Kind, PLAN};
use crate::opening::{self, Opening};
use crate::{Error, FrameFiles, PlanFrame, Result, atomic, denoised, encode, index, plan, read_header};

/// What a data set is made from.
#[derive(Clone, Debug)]
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
    pub plan: Vec<PlanFrame>,
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

    /// Of a frame in a folder that is done or not: then there may be a failure of it.
    pub(crate) fn of(is_done: bool, dir: &Path, id: &str) -> Self {
        match is_done {
            true => Self::Done,
            false if dir.join(Kind::Failed.file(id)).is_file() => Self::Failed,
            false => Self::Missing,
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
    dir: PathBuf,
    header: Header,
    plan: Vec<PlanFrame>,
    places: HashMap<String, usize>,
}

impl DataSet {
    /// Begins a data set in a new or empty folder, or goes on with the same one; removes what killed writers left. `opening`
    /// says what is to become of another one.
    ///
    /// `differ` gets the text of the folder's `config.resolved.yaml` and names the keys in which it differs from this
    /// configuration; it is only called for the message of [`Error::ConfigDiffers`].
    ///
    /// # Errors
    /// [`Error::ConfigDiffers`], [`Error::CodeDiffers`] or [`Error::PlanDiffers`] when the folder holds another data set,
    /// [`Error::NotAnExtension`] when it cannot be extended, [`Error::NotADataSet`] when it holds something else,
    /// [`Error::Damaged`] when its `dataset.json` is unreadable, [`Error::BadId`] for ids that cannot name files,
    /// [`Error::Io`] when the system refuses.
    pub fn create_or_open(
        dir: &Path,
        info: DataSetInfo<'_>,
        opening: Opening,
        differ: &dyn Fn(&str) -> Vec<String>,
    ) -> Result<Self> {
        plan::check(&info.plan)?;
        let lines = plan::to_lines(&info.plan, dir)?;
        let mut texts = vec![(CONFIG, info.config_yaml.as_bytes().to_vec()), (PLAN, lines.into_bytes())];
        texts.extend(info.classes.map(|classes| (CLASSES, encode::pretty(classes))));
        let header = header_of(&info, &texts);

        fs::create_dir_all(dir).map_err(Error::io("create", dir))?;
        atomic::remove_abandoned(dir)?;
        let mut found = claim(dir, &header)?;
        if !found.is_of_one_data_set(&header) {
            found = match opening {
                Opening::Resume => return Err(difference(dir, found, header, differ)),
                Opening::Overwrite => opening::replace(dir, header)?,
                Opening::Extend => opening::extend(dir, &found, header, &info.plan)?,
            };
        }

        // A process that was killed after claiming the folder may have left these out.
        for (entry, (_, text)) in found.files.iter().zip(&texts) {
            if entry.fault(dir, Check::Hash).is_some() {
                atomic::write(dir, &entry.name, text)?;
            }
        }
        atomic::sync_dir(dir)?;

        Ok(Self::of(dir, found, info.plan))
    }

    /// Opens the data set that a folder holds, by its own plan.
    ///
    /// # Errors
    /// [`Error::Io`] or [`Error::Damaged`] when its header or plan cannot be read.
    pub fn open(dir: &Path) -> Result<Self> {
        let header = read_header(dir)?;
        let plan = plan::read(dir)?;
        plan::check(&plan)?;
        Ok(Self::of(dir, header, plan))
    }

    fn of(dir: &Path, header: Header, plan: Vec<PlanFrame>) -> Self {
        let places = plan.iter().enumerate().map(|(i, frame)| (frame.id.clone(), i)).collect();
        Self { dir: dir.to_path_buf(), header, plan, places }
    }

    /// The folder.
    #[must_use]
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// The frames, in order.
    #[must_use]
    pub fn plan(&self) -> &[PlanFrame] {
        &self.plan
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
        self.frame(id).is_ok_and(|frame| self.header.is_complete(&self.dir, frame, check))
    }

    /// Whether the frame is done, failed or neither.
    #[must_use]
    pub fn state(&self, id: &str) -> FrameState {
        FrameState::of(self.is_done(id), &self.dir, id)
    }

    /// States of all frames, in plan order.
    #[must_use]
    pub fn states(&self) -> Vec<FrameState> {
        self.plan.iter().map(|frame| self.state(&frame.id)).collect()
    }

    /// Writes the files that the frame's outputs ask for, then its marker, and forgets an earlier failure.
    ///
    /// # Errors
    /// [`Error::UnknownFrame`], [`Error::Frame`] for a picture that does not fit together, [`Error::Picture`] when it
    /// cannot be encoded, [`Error::Io`] when the system refuses. No marker is written then.
    pub fn write_frame(&self, files: &FrameFiles<'_>) -> Result<()> {
        let outputs = self.frame(files.id)?.outputs;
        files.frame.check().map_err(|source| Error::Frame { id: files.id.to_owned(), source })?;

        let mut entries = Vec::new();
        for kind in Kind::HASHED.into_iter().filter(|k| k.wanted(outputs)) {
            let name = kind.file(files.id);
            let content = encode::hashed(kind, files, outputs, &self.dir.join(&name))?;
            atomic::write(&self.dir, &name, &content)?;
            entries.push(FileEntry::of(name, &content));
        }
        if outputs.denoised {
            denoised::write(&self.dir, files)?;
        }
        atomic::write(&self.dir, &Kind::Timing.file(files.id), &encode::timing(files))?;
        // The files must be on the disk under their names before the marker says so.
        atomic::sync_dir(&self.dir)?;
        let marker = json!(Marker {
            id: files.id.to_owned(),
            config_digest: self.header.config_digest.clone(),
            code_digest: self.header.code_digest.clone(),
            files: entries,
        });
        atomic::write(&self.dir, &Kind::Done.file(files.id), &encode::pretty(&marker))?;
        atomic::remove(&self.dir.join(Kind::Failed.file(files.id)))?;
        atomic::sync_dir(&self.dir)
    }

    /// Records why a frame failed; does nothing when another process has finished it meanwhile.
    ///
    /// # Errors
    /// [`Error::UnknownFrame`], or [`Error::Io`] when the system refuses.
    pub fn record_failure(&self, id: &str, reason: &str) -> Result<()> {
        self.frame(id)?;
        if self.is_done(id) {
            return Ok(());
        }
        let content = encode::pretty(&json!({ "id": id, "reason": reason }));
        atomic::write(&self.dir, &Kind::Failed.file(id), &content)?;
        atomic::sync_dir(&self.dir)
    }

    /// Forgets that a frame is done, or that it failed, so that it is missing.
    ///
    /// # Errors
    /// [`Error::UnknownFrame`], or [`Error::Io`] when the system refuses.
    pub fn forget(&self, id: &str) -> Result<()> {
        self.frame(id)?;
        [Kind::Done, Kind::Failed].iter().try_for_each(|kind| atomic::remove(&self.dir.join(kind.file(id))))
    }

    /// Removes what killed writers left; frames that are being written are not touched.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub fn clean(&self) -> Result<()> {
        atomic::remove_abandoned(&self.dir)
    }

    /// Writes `index.csv` from what the folder holds now, and counts.
    ///
    /// Of several processes that finish at the same time the last one to write has seen every frame.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub fn finish(&self) -> Result<Counts> {
        let mut states = self.states();
        loop {
            for (frame, _) in self.plan.iter().zip(&states).filter(|(_, s)| **s == FrameState::Done) {
                atomic::remove(&self.dir.join(Kind::Failed.file(&frame.id)))?;
            }
            index::write(&self.dir, &self.plan, &states)?;
            atomic::sync_dir(&self.dir)?;
            // A frame finished by another process meanwhile would be missing from an index written over its own.
            let now = self.states();
            if now == states {
                return Ok(Counts::of(&states));
            }
            states = now;
        }
    }

    fn frame(&self, id: &str) -> Result<&PlanFrame> {
        let unknown = || Error::UnknownFrame { dir: self.dir.clone(), id: id.to_owned() };
        self.places.get(id).map(|&i| &self.plan[i]).ok_or_else(unknown)
    }
}

/// Why the folder's data set is not ours.
fn difference(dir: &Path, found: Header, ours: Header, differ: &dyn Fn(&str) -> Vec<String>) -> Error {
    let dir = dir.to_path_buf();
    if found.config_digest != ours.config_digest {
        let keys = fs::read_to_string(dir.join(CONFIG)).map_or_else(|_| Vec::new(), |old| differ(&old));
        return Error::ConfigDiffers { dir, keys };
    }
    if found.code_digest != ours.code_digest {
        return Error::CodeDiffers { dir, found: found.code_digest, expected: ours.code_digest };
    }
    Error::PlanDiffers { dir }
}

fn header_of(info: &DataSetInfo<'_>, texts: &[(&str, Vec<u8>)]) -> Header {
    Header {
        format: FORMAT.to_owned(),
        format_version: FORMAT_VERSION,
        name: info.name.to_owned(),
        frames: info.plan.len() as u64,
        config_digest: info.config_digest.to_owned(),
        extends: Vec::new(),
        code_digest: info.code_digest.to_owned(),
        files: texts.iter().map(|(name, text)| FileEntry::of((*name).to_owned(), text)).collect(),
        details: info.details.clone(),
    }
}

/// The folder's header: the one that is there, or ours if nobody was first.
fn claim(dir: &Path, ours: &Header) -> Result<Header> {
    if let Some(found) = Header::read(dir)? {
        return Ok(found);
    }
    for entry in fs::read_dir(dir).map_err(Error::io("list", dir))? {
        let name = entry.map_err(Error::io("list", dir))?.file_name().to_string_lossy().into_owned();
        // Another process may claim the folder right now.
        if name != HEADER && !atomic::is_temporary(&name) && Header::read(dir)?.is_none() {
            return Err(Error::NotADataSet { dir: dir.to_path_buf(), found: name });
        }
    }
    atomic::write_new(dir, HEADER, &encode::pretty(&json!(ours)))?;
    let path = dir.join(HEADER);
    Header::read(dir)?.ok_or("it vanished").map_err(Error::damaged(&path))
}
