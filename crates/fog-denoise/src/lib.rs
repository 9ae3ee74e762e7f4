//! Denoised pictures by Open Image Denoise (Áfra, <https://www.openimagedenoise.org>), version 2.
//!
//! The library is loaded when it is asked for and is no part of the program: who does not denoise needs none. It is a neural
//! network: what it returns is a guess, not a measurement. Its bits depend on the library's version and, as its authors
//! say (RenderKit/oidn, issue 205), on the processor; not on the number of threads (tested here).

mod api;
mod error;

pub use error::Error;

use api::{Api, Filter};
use std::path::{Path, PathBuf};

/// Name of the library's file on this system.
pub const FILE_NAME: &str = if cfg!(target_os = "windows") {
    "OpenImageDenoise.dll"
} else if cfg!(target_os = "macos") {
    "libOpenImageDenoise.2.dylib"
} else {
    "libOpenImageDenoise.so.2"
};

/// What a picture is denoised from; row-major, width × height pixels each.
#[derive(Clone, Copy, Debug)]
pub struct Images<'a> {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear radiance in any unit, finite; noisy.
    pub radiance: &'a [[f32; 3]],
    /// Colour of what is seen, in [0, 1], without noise.
    pub albedo: &'a [[f32; 3]],
    /// Normals of what is seen in any fixed frame, components in [−1, 1], zero for none; without noise.
    pub normal: &'a [[f32; 3]],
}

/// The library, loaded.
#[derive(Debug)]
pub struct Denoiser {
    api: Api,
    file: PathBuf,
    version: [u32; 3],
}

impl Denoiser {
    /// Loads the library from `path`, a file or a folder that has [`FILE_NAME`]; without it from where the system looks for
    /// libraries. Foreign code runs in this process from then on.
    ///
    /// # Errors
    /// [`Error::NotFound`], [`Error::NotOidn`] when it is another library or an older version, [`Error::Refused`] when it
    /// does not work on this processor.
    pub fn load(path: Option<&Path>) -> Result<Self, Error> {
        let file = match path {
            Some(path) if path.is_dir() => path.join(FILE_NAME),
            Some(path) => path.to_path_buf(),
            None => PathBuf::from(FILE_NAME),
        };
        let api = Api::load(&file)?;
        let version = api.device(1)?.version();
        if version[0] != 2 {
            let reason = format!("it is version {}, and version 2 is needed", version[0]);
            return Err(Error::NotOidn { file, reason });
        }
        Ok(Self { api, file, version })
    }

    /// The file that was loaded, as it was named.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The library's version, as `2.5.1`.
    #[must_use]
    pub fn version(&self) -> String {
        self.version.map(|part| part.to_string()).join(".")
    }

    /// An estimate of the picture without its noise, on `threads` threads, whose number changes no bit of it; radiances are
    /// not negative.
    ///
    /// # Errors
    /// [`Error::Shape`] when an image has not width × height pixels, [`Error::Refused`] when the library fails.
    pub fn denoise(&self, images: &Images<'_>, threads: usize) -> Result<Vec<[f32; 3]>, Error> {
        let Images { width, height, radiance, albedo, normal } = *images;
        let size = [width as usize, height as usize];
        let pixels = size[0] * size[1];
        if pixels == 0 || [radiance, albedo, normal].iter().any(|image| image.len() != pixels) {
            return Err(Error::Shape { width, height });
        }
        let mut output = vec![[0.0f32; 3]; pixels];
        let device = self.api.device(threads)?;
        let inputs = [(c"color", radiance), (c"albedo", albedo), (c"normal", normal)];
        // Auxiliary images without noise; radiance beyond 1.
        device.execute(Filter { size, inputs: &inputs, switches: &[c"hdr", c"cleanAux"] }, &mut output)?;
        for value in output.iter_mut().flatten() {
            *value = value.max(0.0);
        }
        Ok(output)
    }
}

#[cfg(test)]
mod tests;
