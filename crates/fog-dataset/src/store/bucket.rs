//! A prefix of a bucket: Amazon S3 and what speaks its language, Google Cloud Storage, Azure Blob Storage.
//!
//! An object appears when its last byte has arrived, and is seen by everybody from then on: these services say so of a PUT and of
//! the end of an upload in parts. Requests that fail are repeated (`object_store`'s retries); the same bytes put twice are the same.
//! The runtime that waits for requests is made when it is needed and given up by [`Bucket::disconnect`].

use std::fs::File;
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use futures_util::{StreamExt, TryStreamExt, stream};
use object_store::aws::AmazonS3Builder;
use object_store::azure::MicrosoftAzureBuilder;
use object_store::gcp::GoogleCloudStorageBuilder;
use object_store::path::Path;
use object_store::{
    BackoffConfig, ClientOptions, Error, ObjectStore, ObjectStoreExt, PutMode, PutPayload, Result,
    RetryConfig, WriteMultipart,
};
use tokio::runtime::{Builder, Runtime};

/// Objects with more bytes are sent in parts of so many.
const PART: usize = 8 << 20;
/// Requests under way at once for one call.
const AT_ONCE: usize = 8;
/// Times that an upload in parts is begun: its last request cannot be repeated when only the answer was lost.
const UPLOADS: usize = 2;

/// Longest time for a request and its answer, and for reaching the service at all.
const REQUEST: Duration = Duration::from_secs(120);
const CONNECT: Duration = Duration::from_secs(10);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Service {
    S3,
    Google,
    Azure,
}

#[derive(Debug)]
pub(super) struct Bucket {
    service: Service,
    name: String,
    prefix: Path,
    client: Mutex<Option<Arc<Client>>>,
}

/// Connections and what drives them.
#[derive(Debug)]
struct Client {
    objects: Arc<dyn ObjectStore>,
    runtime: Runtime,
}

impl Bucket {
    /// The place `SCHEME://REST`.
    pub(super) fn new(scheme: &str, rest: &str) -> io::Result<Self> {
        let wrong = |text: String| io::Error::new(ErrorKind::InvalidInput, text);
        let service = match scheme {
            "s3" => Service::S3,
            "gs" => Service::Google,
            "az" => Service::Azure,
            _ => {
                let known = "a folder, s3://BUCKET/PREFIX, gs://BUCKET/PREFIX or az://CONTAINER/PREFIX";
                return Err(wrong(format!("`{scheme}://` is unknown; expected {known}")));
            }
        };
        let (name, prefix) = rest.split_once('/').unwrap_or((rest, ""));
        if name.is_empty() {
            return Err(wrong(format!("the bucket is missing; expected {scheme}://BUCKET/PREFIX")));
        }
        let prefix = Path::parse(prefix).map_err(|e| wrong(e.to_string()))?;
        Ok(Self { service, name: name.to_owned(), prefix, client: Mutex::new(None) })
    }

    pub(super) fn disconnect(&self) {
        *self.client.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }

    pub(super) fn read(&self, name: &str) -> io::Result<Vec<u8>> {
        let mut content = Vec::new();
        self.read_in_pieces(name, |piece| {
            content.extend_from_slice(piece);
            Ok(())
        })?;
        Ok(content)
    }

    /// Gives an object from its beginning. What breaks off is asked for again from there on.
    pub(super) fn read_in_pieces(
        &self,
        name: &str,
        mut each: impl FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let refuse = |e: io::Error| Error::Generic { store: "local file", source: e.into() };
        self.run(async |objects| {
            let mut pieces = objects.get(&self.object(name)).await?.into_stream();
            while let Some(piece) = pieces.next().await {
                each(&piece?).map_err(refuse)?;
            }
            Ok(())
        })
    }

    /// Puts an object into a file, which is then at its beginning.
    pub(super) fn fetch(&self, name: &str, mut file: File) -> io::Result<File> {
        self.read_in_pieces(name, |piece| file.write_all(piece))?;
        file.rewind()?;
        Ok(file)
    }

    pub(super) fn size(&self, name: &str) -> io::Result<u64> {
        self.run(async |objects| Ok(objects.head(&self.object(name)).await?.size))
    }

    /// Puts objects side by side; the error comes with the name of its object.
    pub(super) fn write_all(
        &self,
        files: Vec<(String, Vec<u8>)>,
    ) -> std::result::Result<(), (String, io::Error)> {
        let files: Vec<(String, PutPayload)> =
            files.into_iter().map(|(n, content)| (n, content.into())).collect();
        // The name of the object that failed.
        let failed = Mutex::new(String::new());
        let written = self.run(async |objects| {
            let put = async |(name, content): &(String, PutPayload)| {
                let result = self.put(objects, name, content).await;
                if result.is_err() {
                    name.clone_into(&mut failed.lock().unwrap_or_else(PoisonError::into_inner));
                }
                result
            };
            stream::iter(&files).map(Ok).try_for_each_concurrent(AT_ONCE, put).await
        });
        written.map_err(|e| (failed.into_inner().unwrap_or_else(PoisonError::into_inner), e))
    }

    async fn put(&self, objects: &Arc<dyn ObjectStore>, name: &str, content: &PutPayload) -> Result<()> {
        let object = self.object(name);
        if content.content_length() <= PART {
            return objects.put(&object, content.clone()).await.map(drop);
        }
        for attempt in 1.. {
            let mut upload = begin(objects, &object).await?;
            for piece in content {
                upload.wait_for_capacity(AT_ONCE).await?;
                upload.put(piece.clone());
            }
            match upload.finish().await {
                Err(_) if attempt < UPLOADS => {}
                finished => return finished.map(drop),
            }
        }
        Ok(())
    }

    /// Puts the whole content of a file.
    pub(super) fn upload(&self, name: &str, mut file: &File) -> io::Result<()> {
        let bytes = file.metadata()?.len();
        if bytes <= PART as u64 {
            let mut content = Vec::new();
            file.rewind()?;
            file.read_to_end(&mut content)?;
            return self.write_all(vec![(name.to_owned(), content)]).map_err(|(_, e)| e);
        }
        for attempt in 1.. {
            file.rewind()?;
            let finished = self.run(async |objects| {
                let mut upload = begin(objects, &self.object(name)).await?;
                let mut buffer = vec![0; PART];
                loop {
                    upload.wait_for_capacity(AT_ONCE).await?;
                    let read = file.read(&mut buffer);
                    match read.map_err(|e| Error::Generic { store: "local file", source: e.into() })? {
                        0 => return upload.finish().await.map(drop),
                        n => upload.write(&buffer[..n]),
                    }
                }
            });
            if finished.is_ok() || attempt == UPLOADS {
                return finished;
            }
        }
        Ok(())
    }

    /// Puts an object that must not be there; false if it is.
    pub(super) fn write_new(&self, name: &str, content: Vec<u8>) -> io::Result<bool> {
        let content = PutPayload::from(content);
        let put = self.run(async |objects| {
            objects.put_opts(&self.object(name), content.clone(), PutMode::Create.into()).await
        });
        match put {
            Ok(_) => Ok(true),
            Err(e) if e.kind() == ErrorKind::AlreadyExists => Ok(false),
            Err(e) => Err(e),
        }
    }

    pub(super) fn remove(&self, name: &str) -> io::Result<()> {
        match self.run(async |objects| objects.delete(&self.object(name)).await) {
            Err(e) if e.kind() == ErrorKind::NotFound => Ok(()),
            removed => removed,
        }
    }

    /// Gives the names below the prefix, but not those of deeper prefixes.
    pub(super) fn list(&self, each: &mut dyn FnMut(&str)) -> io::Result<()> {
        let depth = self.prefix.parts().count() + 1;
        let prefix = (depth > 1).then_some(&self.prefix);
        self.run(async |objects| {
            let mut listing = objects.list(prefix);
            while let Some(object) = listing.try_next().await? {
                if object.location.parts().count() == depth {
                    object.location.filename().into_iter().for_each(&mut *each);
                }
            }
            Ok(())
        })
    }

    fn object(&self, name: &str) -> Path {
        self.prefix.clone().join(name)
    }

    /// Waits for requests on the calling thread.
    fn run<T>(&self, work: impl AsyncFnOnce(&Arc<dyn ObjectStore>) -> Result<T>) -> io::Result<T> {
        let client = self.client()?;
        client.runtime.block_on(work(&client.objects)).map_err(|e| self.explained(e))
    }

    fn client(&self) -> io::Result<Arc<Client>> {
        let mut client = self.client.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(client) = &*client {
            return Ok(Arc::clone(client));
        }
        // Fails if a provider was chosen before, which is as good.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let runtime = Builder::new_current_thread().enable_all().build()?;
        let objects = self.connect().map_err(|e| self.explained(e))?;
        let made = Arc::new(Client { objects, runtime });
        *client = Some(Arc::clone(&made));
        Ok(made)
    }

    fn connect(&self) -> Result<Arc<dyn ObjectStore>> {
        let set = |key: &str| std::env::var(key).ok();
        // A server that is named with http:// is meant so.
        let plain = |keys: &[&str]| keys.iter().any(|key| set(key).is_some_and(|v| v.starts_with("http://")));
        let options = |plain: bool| {
            ClientOptions::new().with_timeout(REQUEST).with_connect_timeout(CONNECT).with_allow_http(plain)
        };
        let max_backoff = Duration::from_secs(4);
        let backoff = BackoffConfig { max_backoff, ..BackoffConfig::default() };
        let retry = RetryConfig { backoff, ..RetryConfig::default() };
        Ok(match self.service {
            Service::S3 => {
                let plain = plain(&["AWS_ENDPOINT_URL_S3", "AWS_ENDPOINT_URL", "AWS_ENDPOINT"]);
                let builder = AmazonS3Builder::from_env().with_bucket_name(&self.name);
                Arc::new(builder.with_client_options(options(plain)).with_retry(retry).build()?)
            }
            Service::Google => {
                let plain = plain(&["GOOGLE_BASE_URL"]);
                let builder = GoogleCloudStorageBuilder::from_env().with_bucket_name(&self.name);
                Arc::new(builder.with_client_options(options(plain)).with_retry(retry).build()?)
            }
            Service::Azure => {
                let emulated = set("AZURE_STORAGE_USE_EMULATOR").is_some_and(|v| v == "true");
                let plain = emulated || plain(&["AZURE_STORAGE_ENDPOINT", "AZURE_ENDPOINT"]);
                let builder = MicrosoftAzureBuilder::from_env().with_container_name(&self.name);
                Arc::new(builder.with_client_options(options(plain)).with_retry(retry).build()?)
            }
        })
    }

    /// The service's refusal with what it means.
    fn explained(&self, e: Error) -> io::Error {
        let kind = match &e {
            Error::NotFound { .. } => ErrorKind::NotFound,
            Error::AlreadyExists { .. } | Error::Precondition { .. } => ErrorKind::AlreadyExists,
            Error::PermissionDenied { .. } | Error::Unauthenticated { .. } => ErrorKind::PermissionDenied,
            _ => ErrorKind::Other,
        };
        let text = e.to_string();
        let missing = ["NoSuchBucket", "ContainerNotFound", "bucket does not exist"];
        if missing.iter().any(|said| text.contains(said)) {
            return io::Error::other(format!("the bucket `{}` does not exist", self.name));
        }
        let (credentials, about) = match self.service {
            Service::S3 => (
                set_any(&["AWS_ACCESS_KEY_ID", "AWS_WEB_IDENTITY_TOKEN_FILE"]),
                "AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY",
            ),
            Service::Google => (
                set_any(&[
                    "GOOGLE_SERVICE_ACCOUNT",
                    "GOOGLE_SERVICE_ACCOUNT_KEY",
                    "GOOGLE_APPLICATION_CREDENTIALS",
                ]),
                "GOOGLE_SERVICE_ACCOUNT or GOOGLE_APPLICATION_CREDENTIALS",
            ),
            Service::Azure => (
                set_any(&["AZURE_STORAGE_ACCOUNT_KEY", "AZURE_CLIENT_ID", "AZURE_STORAGE_SAS_KEY"]),
                "AZURE_STORAGE_ACCOUNT_NAME and AZURE_STORAGE_ACCOUNT_KEY",
            ),
        };
        let hint = match kind {
            ErrorKind::NotFound | ErrorKind::AlreadyExists => String::new(),
            _ if !credentials => format!(" (no credentials are in the environment: {about})"),
            ErrorKind::PermissionDenied => " (the credentials in the environment do not allow it)".to_owned(),
            _ => String::new(),
        };
        io::Error::new(kind, format!("{}{hint}", short(&text)))
    }
}

fn set_any(keys: &[&str]) -> bool {
    keys.iter().any(|key| std::env::var_os(key).is_some_and(|value| !value.is_empty()))
}

async fn begin(objects: &Arc<dyn ObjectStore>, object: &Path) -> Result<WriteMultipart> {
    Ok(WriteMultipart::new_with_chunk_size(objects.put_multipart(object).await?, PART))
}

/// A message with what its XML says instead of the XML.
fn short(text: &str) -> String {
    let Some(at) = text.find("<?xml").or_else(|| text.find("<Error>")) else { return text.to_owned() };
    let said = |tag: &str| {
        let (_, rest) = text.split_once(&format!("<{tag}>"))?;
        Some(rest.split_once('<')?.0)
    };
    let words: Vec<&str> = ["Code", "Message"].into_iter().filter_map(said).collect();
    format!("{}{}", &text[..at], words.join(": "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses() {
        let bucket = Bucket::new("s3", "fog/a/b/").expect("an address");
        assert_eq!((bucket.name.as_str(), bucket.object("x.done").as_ref()), ("fog", "a/b/x.done"));
        assert_eq!(Bucket::new("gs", "fog").expect("an address").object("x").as_ref(), "x");
        let said = |scheme, rest| Bucket::new(scheme, rest).expect_err("refused").to_string();
        assert!(said("ftp", "fog").contains("`ftp://` is unknown; expected a folder, s3://"));
        assert!(said("s3", "/a").contains("the bucket is missing"));
    }

    #[test]
    fn xml_is_put_in_words() {
        let text = "PUT failed: 403: <?xml version=\"1.0\"?><Error><Code>AccessDenied</Code><Message>No.</Message></Error>";
        assert_eq!(short(text), "PUT failed: 403: AccessDenied: No.");
        assert_eq!(short("connection refused"), "connection refused");
    }
}
