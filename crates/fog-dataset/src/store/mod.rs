//! Where the files of a data set are: in a folder, or under a prefix of a bucket of an object store.
//!
//! Both keep the same promise: a file appears only when it is whole, under a name that others may write at the same time, and
//! files written before [`Store::sync`] are there when those are that were written after it. The rest of this crate does not know
//! which of the two it has.

mod bucket;
mod folder;

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::{Error, Result};
use bucket::Bucket;

/// Bytes that go to a file or come from it at once.
const BUFFER: usize = 1 << 20;

/// A place with files.
///
/// A place that begins with `s3://BUCKET`, `gs://BUCKET` or `az://CONTAINER` is in an object store, with its credentials in the
/// environment (`AWS_*`, `GOOGLE_*`, `AZURE_*`; `AWS_ENDPOINT_URL` names another server that speaks S3); every other one is a folder.
#[derive(Debug)]
pub struct Store {
    place: PathBuf,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Folder,
    Bucket(Bucket),
}

impl Store {
    /// The store at a place; nothing is read or made yet.
    ///
    /// # Errors
    /// [`Error::Io`] for an address of an unknown kind or without a bucket.
    pub fn at(place: &Path) -> Result<Self> {
        let kind = match place.to_str().and_then(|text| text.split_once("://")) {
            None => Kind::Folder,
            Some((scheme, rest)) => Kind::Bucket(Bucket::new(scheme, rest).map_err(Error::io("use", place))?),
        };
        Ok(Self { place: place.to_path_buf(), kind })
    }

    /// Whether a place is in an object store.
    #[must_use]
    pub fn is_remote(place: &Path) -> bool {
        place.to_str().is_some_and(|text| text.contains("://"))
    }

    /// The place as it was given.
    #[must_use]
    pub fn place(&self) -> &Path {
        &self.place
    }

    /// Path or address of a file, for messages.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.place.join(name)
    }

    /// Whether requests wait for a network, so that many at a time are quicker.
    pub(crate) fn waits(&self) -> bool {
        matches!(self.kind, Kind::Bucket(_))
    }

    /// Makes the folder, if it is not there, and removes what killed writers left in it. Buckets are not made; uploads that were
    /// not finished are theirs to remove.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub fn make(&self) -> Result<()> {
        match &self.kind {
            Kind::Folder => {
                fs::create_dir_all(&self.place).map_err(Error::io("create", &self.place))?;
                self.clean()
            }
            Kind::Bucket(_) => Ok(()),
        }
    }

    /// Removes what killed writers left; files that are being written are not touched.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub fn clean(&self) -> Result<()> {
        match &self.kind {
            Kind::Folder => folder::remove_abandoned(&self.place).map_err(Error::io("clean", &self.place)),
            Kind::Bucket(_) => Ok(()),
        }
    }

    /// Content of a file; `None` when there is none.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read.
    pub fn read(&self, name: &str) -> Result<Option<Vec<u8>>> {
        let content = match &self.kind {
            Kind::Folder => fs::read(self.path(name)),
            Kind::Bucket(bucket) => bucket.read(name),
        };
        self.if_there(name, content)
    }

    /// A file to read from its beginning; `None` when there is none. Of an object store it is fetched first, to where the system
    /// has its temporary files.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read.
    pub fn open(&self, name: &str) -> Result<Option<impl BufRead + use<>>> {
        let file = match &self.kind {
            Kind::Folder => File::open(self.path(name)),
            Kind::Bucket(bucket) => tempfile::tempfile().and_then(|file| bucket.fetch(name, file)),
        };
        Ok(self.if_there(name, file)?.map(|file| BufReader::with_capacity(BUFFER, file)))
    }

    /// Puts the content of a file into another, which must be empty, from its beginning; returns whether there was one.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read, or the other not written.
    pub fn fetch(&self, name: &str, mut into: &File) -> Result<bool> {
        let fetched = match &self.kind {
            Kind::Folder => {
                File::open(self.path(name)).and_then(|mut file| io::copy(&mut file, &mut into).map(drop))
            }
            Kind::Bucket(bucket) => into.try_clone().and_then(|file| bucket.fetch(name, file).map(drop)),
        };
        Ok(self.if_there(name, fetched)?.is_some())
    }

    /// Size of a file in bytes.
    ///
    /// # Errors
    /// The system's reason; [`ErrorKind::NotFound`] when there is none.
    pub(crate) fn size(&self, name: &str) -> io::Result<u64> {
        match &self.kind {
            Kind::Folder => match fs::metadata(self.path(name))? {
                m if m.is_file() => Ok(m.len()),
                _ => Err(io::Error::new(ErrorKind::InvalidInput, "it is no file")),
            },
            Kind::Bucket(bucket) => bucket.size(name),
        }
    }

    /// Size of a file in bytes, and its BLAKE3 hash.
    ///
    /// # Errors
    /// The system's reason; [`ErrorKind::NotFound`] when there is none.
    pub(crate) fn hash(&self, name: &str) -> io::Result<(u64, blake3::Hash)> {
        let mut hasher = blake3::Hasher::new();
        match &self.kind {
            Kind::Folder => hasher.update_reader(File::open(self.path(name))?).map(drop)?,
            Kind::Bucket(bucket) => bucket.read_in_pieces(name, |piece| {
                hasher.update(piece);
                Ok(())
            })?,
        }
        Ok((hasher.count(), hasher.finalize()))
    }

    /// Writes a file whole, replacing what is there.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub fn write(&self, name: &str, content: Vec<u8>) -> Result<()> {
        self.write_all(vec![(name.to_owned(), content)])
    }

    /// Writes several files whole, in any order, replacing what is there.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses one of them; others may be there then.
    pub(crate) fn write_all(&self, files: Vec<(String, Vec<u8>)>) -> Result<()> {
        match &self.kind {
            Kind::Folder => files.iter().try_for_each(|(name, content)| {
                folder::write(&self.place, name, content).map_err(Error::io("write", &self.path(name)))
            }),
            Kind::Bucket(bucket) => {
                bucket.write_all(files).map_err(|(name, e)| Error::io("write", &self.path(&name))(e))
            }
        }
    }

    /// Writes a file whole unless it is there; returns whether it was written.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub(crate) fn write_new(&self, name: &str, content: Vec<u8>) -> Result<bool> {
        let written = match &self.kind {
            Kind::Folder => folder::write_new(&self.place, name, &content),
            Kind::Bucket(bucket) => bucket.write_new(name, content),
        };
        written.map_err(Error::io("write", &self.path(name)))
    }

    /// A file that is written piece by piece and appears when it is finished.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub(crate) fn create(&self, name: &str) -> Result<Writer<'_>> {
        let temp = match &self.kind {
            Kind::Folder => folder::temporary(&self.place),
            Kind::Bucket(_) => NamedTempFile::new(),
        };
        let file = BufWriter::with_capacity(BUFFER, temp.map_err(Error::io("write", &self.path(name)))?);
        Ok(Writer { store: self, name: name.to_owned(), file })
    }

    /// Writes a file whole with the content of another.
    ///
    /// # Errors
    /// [`Error::Io`] when that cannot be read, or the system refuses.
    pub fn upload(&self, name: &str, from: &Path) -> Result<()> {
        let mut file = File::open(from).map_err(Error::io("read", from))?;
        let mut writer = self.create(name)?;
        io::copy(&mut file, &mut writer).map_err(Error::io("write", &self.path(name)))?;
        writer.finish()
    }

    /// Removes a file; it is no error if there is none.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub(crate) fn remove(&self, name: &str) -> Result<()> {
        let path = self.path(name);
        let removed = match &self.kind {
            Kind::Folder => folder::remove(&path),
            Kind::Bucket(bucket) => bucket.remove(name),
        };
        removed.map_err(Error::io("remove", &path))
    }

    /// Gives the names of all files one by one, in any order.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub(crate) fn list(&self, each: &mut dyn FnMut(&str)) -> Result<()> {
        let listed = match &self.kind {
            Kind::Folder => folder::list(&self.place, each),
            Kind::Bucket(bucket) => bucket.list(each),
        };
        listed.map_err(Error::io("list", &self.place))
    }

    /// The name of some file with another name than this.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub(crate) fn other_than(&self, name: &str) -> Result<Option<String>> {
        let mut other = None;
        self.list(&mut |found| {
            if found != name && other.is_none() {
                other = Some(found.to_owned());
            }
        })?;
        Ok(other)
    }

    /// Returns when all that was written and removed will survive a loss of power.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub(crate) fn sync(&self) -> Result<()> {
        match &self.kind {
            Kind::Folder => folder::sync_dir(&self.place).map_err(Error::io("sync", &self.place)),
            Kind::Bucket(_) => Ok(()),
        }
    }

    /// Gives up connections and threads, which the next request makes anew: a process must have neither when it is forked.
    pub fn disconnect(&self) {
        if let Kind::Bucket(bucket) = &self.kind {
            bucket.disconnect();
        }
    }

    fn if_there<T>(&self, name: &str, result: io::Result<T>) -> Result<Option<T>> {
        match result {
            Ok(found) => Ok(Some(found)),
            Err(e) if e.kind() == ErrorKind::NotFound => Ok(None),
            Err(e) => Err(Error::io("read", &self.path(name))(e)),
        }
    }
}

/// A file of a [`Store`] that is being written.
#[derive(Debug)]
pub(crate) struct Writer<'a> {
    store: &'a Store,
    name: String,
    file: BufWriter<NamedTempFile>,
}

impl Writer<'_> {
    /// The file appears.
    ///
    /// # Errors
    /// [`Error::Io`] when the system refuses.
    pub(crate) fn finish(self) -> Result<()> {
        let path = self.store.path(&self.name);
        let temp = self.file.into_inner().map_err(io::IntoInnerError::into_error);
        let finished = temp.and_then(|temp| match &self.store.kind {
            Kind::Folder => folder::keep(temp, &path),
            Kind::Bucket(bucket) => bucket.upload(&self.name, temp.as_file()),
        });
        finished.map_err(Error::io("write", &path))
    }
}

impl Write for Writer<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
