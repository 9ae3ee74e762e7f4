//! WebDataset: tar files in which the files of a frame stand together, with one name up to the first point.
//!
//! `NAME-000000.tar`, …; members are the data set's own files under `NUMBER-ID.` and their usual endings, frames in the order of the
//! plan and members in that of their names, so that the keys are sorted. Nothing in a header depends on when or where it was
//! made.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tar::{Builder, EntryType, Header};

use crate::frame::Frame;
use crate::job::{Job, Writer};
use crate::{Error, Result};

/// The outputs that frames must have.
pub(crate) const NEEDS: &[&str] = &["image"];

/// Bytes of a member's header, and the unit to which its content is filled up.
const BLOCK: u64 = 512;

/// The writer; one shard is open at a time.
pub(crate) struct WebDataset<'a> {
    job: &'a Job<'a>,
    shards: u64,
    open: Option<Shard>,
}

struct Shard {
    builder: Builder<BufWriter<File>>,
    path: PathBuf,
    bytes: u64,
}

impl<'a> WebDataset<'a> {
    pub(crate) fn begin(job: &'a Job<'a>) -> Self {
        Self { job, shards: 0, open: None }
    }

    /// The shard that takes this many bytes more; a shard has one frame at least.
    fn shard(&mut self, more: u64) -> Result<&mut Shard> {
        if self.open.as_ref().is_some_and(|shard| shard.bytes + more > self.job.options.shard_bytes()) {
            self.close()?;
        }
        let shard = match self.open.take() {
            Some(shard) => shard,
            None => {
                let name = format!("{}-{:06}.tar", self.job.file_stem(), self.shards);
                self.shards += 1;
                let path = self.job.folder.path(&name)?;
                let file = File::create(&path).map_err(Error::io("create", &path))?;
                Shard { builder: Builder::new(BufWriter::new(file)), path, bytes: 0 }
            }
        };
        Ok(self.open.insert(shard))
    }

    fn close(&mut self) -> Result<()> {
        if let Some(Shard { builder, path, .. }) = self.open.take() {
            let whole = builder.into_inner().and_then(|mut file| file.flush());
            whole.map_err(Error::io("write", &path))?;
        }
        Ok(())
    }
}

impl Writer for WebDataset<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()> {
        let key = format!("{:08}-{}", frame.number, frame.id().replace('.', "_"));
        let mut files = frame.files()?;
        files.sort_by(|a, b| a.name.cmp(&b.name));
        let padded = |bytes: u64| BLOCK + bytes.next_multiple_of(BLOCK);
        let bytes = files.iter().map(|file| padded(file.bytes)).sum();
        let dir = self.job.reader.dir();
        let shard = self.shard(bytes)?;
        shard.bytes += bytes;
        for file in &files {
            let ending = &file.name[frame.id().len()..];
            add(&mut shard.builder, &format!("{key}{ending}"), &dir.join(&file.name), file.bytes)?;
        }
        Ok(())
    }

    fn finish(&mut self) -> Result<()> {
        self.close()
    }
}

/// Adds a file of a known size.
fn add(builder: &mut Builder<impl Write>, name: &str, path: &Path, bytes: u64) -> Result<()> {
    let file = File::open(path).map_err(Error::io("read", path))?;
    let now = file.metadata().map_err(Error::io("read", path))?.len();
    if now != bytes {
        let changed = io::Error::other(format!("it has {now} bytes instead of {bytes}"));
        return Err(Error::io("read", path)(changed));
    }
    let mut header = Header::new_gnu();
    header.set_entry_type(EntryType::Regular);
    header.set_mode(0o644);
    header.set_size(bytes);
    builder.append_data(&mut header, name, file).map_err(Error::io("pack", path))
}
