//! What can be wrong with a scene file, and where.

use std::path::{Path, PathBuf};

/// A scene that cannot be loaded: the file, the place inside it, and what is wrong there.
#[derive(Debug, thiserror::Error)]
#[error("{}: {}{}", file.display(), prefix(place), kind)]
pub struct SceneError {
    /// The scene file as it was named.
    pub file: PathBuf,
    /// Node, mesh, material or image (`` node `tree`, mesh `leaf` ``); empty if the file as a whole is wrong.
    pub place: String,
    /// What is wrong.
    pub kind: SceneErrorKind,
}

/// What is wrong with a scene file.
#[derive(Debug, thiserror::Error)]
pub enum SceneErrorKind {
    /// The operating system's answer.
    #[error("cannot be read: {0}")]
    Read(std::io::Error),
    /// More bytes than [`crate::Limits::max_file_bytes`].
    #[error("the scene and the files that it names are larger than {limit} bytes together")]
    TooLarge {
        /// The limit in bytes.
        limit: u64,
    },
    /// More triangles than [`crate::Limits::max_triangles`].
    #[error("the scene has more than {limit} triangles")]
    TooManyTriangles {
        /// The limit.
        limit: usize,
    },
    /// More nodes than [`crate::Limits::max_nodes`].
    #[error("the scene has {found} nodes; at most {limit} are read")]
    TooManyNodes {
        /// The limit.
        limit: usize,
        /// How many there are.
        found: usize,
    },
    /// More pixels than [`crate::Limits::max_texture_pixels`].
    #[error("the scene's textures have more than {limit} pixels together")]
    TooManyPixels {
        /// The limit.
        limit: u64,
    },
    /// Neither GLB nor JSON.
    #[error("is neither binary glTF (GLB) nor glTF JSON")]
    NotGltf,
    /// A GLB shorter than its own header says.
    #[error("is truncated: {what} needs {need} bytes, there are {have}")]
    Truncated {
        /// The part that is cut off.
        what: &'static str,
        /// Bytes that it needs.
        need: u64,
        /// Bytes that are there.
        have: u64,
    },
    /// A GLB with a wrong version or chunk order.
    #[error("is not a valid GLB: {0}")]
    Container(String),
    /// JSON that is not glTF.
    #[error("is not valid glTF JSON: {0}")]
    Json(String),
    /// References or values that break glTF's rules.
    #[error("is not valid glTF: {0}")]
    Invalid(String),
    /// `extensionsRequired` that this program does not know.
    #[error("requires glTF extensions that are not supported: {0}")]
    RequiredExtensions(String),
    /// A URI that is refused or cannot be read.
    #[error("URI \"{uri}\" {reason}")]
    Uri {
        /// The URI, shortened.
        uri: String,
        /// Why it was refused.
        reason: String,
    },
    /// An image that cannot be decoded.
    #[error("{0}")]
    Image(String),
    /// Vertex data or indices that are missing, out of range or of the wrong type.
    #[error("{0}")]
    Accessor(String),
    /// A vertex that is not a point of the world.
    #[error("vertex {vertex} is at ({}, {}, {}) m: not finite, or farther than 1e9 m from the origin", position[0], position[1], position[2])]
    Vertex {
        /// Index of the vertex in its mesh primitive.
        vertex: u32,
        /// Its position in the world.
        position: [f64; 3],
    },
    /// A node hierarchy that is no tree, or a transform that is no transform.
    #[error("{0}")]
    Node(String),
    /// A light whose numbers are out of range.
    #[error("{0}")]
    Light(String),
    /// A material factor that is not a number of its range.
    #[error("{0}")]
    Material(String),
}

fn prefix(place: &str) -> String {
    if place.is_empty() { String::new() } else { format!("{place}: ") }
}

/// An error inside a file whose name the caller adds.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) place: String,
    pub(crate) kind: SceneErrorKind,
}

impl From<SceneErrorKind> for Failure {
    fn from(kind: SceneErrorKind) -> Self {
        Self { place: String::new(), kind }
    }
}

impl Failure {
    /// The error in the file that is named so.
    pub(crate) fn of(self, file: &Path) -> SceneError {
        SceneError { file: file.to_owned(), place: self.place, kind: self.kind }
    }

    /// Says where it happened, unless a deeper place is known.
    pub(crate) fn at(mut self, place: impl FnOnce() -> String) -> Self {
        if self.place.is_empty() {
            self.place = place();
        }
        self
    }
}

impl SceneErrorKind {
    /// This error at a place.
    pub(crate) fn at(self, place: impl FnOnce() -> String) -> Failure {
        Failure::from(self).at(place)
    }
}
