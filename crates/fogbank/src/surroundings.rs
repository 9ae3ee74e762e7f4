//! What surrounds scenes: images, each read once, and skies, each computed once.

use crate::error::Error;
use crate::skies::{Skies, Sky};
use fog_core::colour::Observer;
use fog_plan::{EnvironmentSpec, LightingSpec};
use fog_scene::sky_map::{MAX_TEXELS, SkyMap};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Images by their path as written, skies by what they are made from. What cannot be had is remembered with its reason and fails the frames that need it.
#[derive(Debug, Default)]
pub(crate) struct Surroundings {
    images: HashMap<PathBuf, Result<Image, String>>,
    made: HashMap<String, Result<Sky, String>>,
    skies: Skies,
}

#[derive(Debug)]
struct Image {
    map: SkyMap,
    blake3: String,
}

impl Surroundings {
    /// Reads or computes what the lighting of a frame needs and is not there yet.
    pub(crate) fn prepare(&mut self, lighting: &LightingSpec, observer: &Observer) {
        if let Some(EnvironmentSpec::Image { image, .. }) = &lighting.environment
            && !self.images.contains_key(image)
        {
            self.images.insert(image.clone(), read(image));
        }
        if let Some(spec) = &lighting.sky
            && !self.made.contains_key(&key(lighting))
        {
            let sky = self.skies.make(spec, lighting, observer);
            self.made.insert(key(lighting), sky);
        }
    }

    /// The sky of a lighting; `None` if it has none.
    ///
    /// # Errors
    /// Why it cannot be had.
    pub(crate) fn sky(&self, lighting: &LightingSpec) -> Result<Option<&Sky>, Error> {
        if lighting.sky.is_none() {
            return Ok(None);
        }
        match self.made.get(&key(lighting)) {
            Some(Ok(sky)) => Ok(Some(sky)),
            Some(Err(reason)) => Err(Error::Lighting(reason.clone())),
            None => Err(Error::Lighting("lighting.sky was not prepared".to_owned())),
        }
    }

    /// The image of a lighting, scaled and turned; `None` if it has none.
    ///
    /// # Errors
    /// Why it cannot be had.
    pub(crate) fn image(&self, lighting: &LightingSpec) -> Result<Option<SkyMap>, Error> {
        let Some(EnvironmentSpec::Image { image, scale, rotation_deg }) = &lighting.environment else {
            return Ok(None);
        };
        match self.images.get(image) {
            Some(Ok(found)) => Ok(Some(found.map.scaled(*scale).turned(*rotation_deg))),
            Some(Err(reason)) => Err(Error::Lighting(reason.clone())),
            None => Err(Error::Lighting(format!("{} was not prepared", image.display()))),
        }
    }

    /// BLAKE3 of the image of a lighting, in hexadecimal.
    pub(crate) fn hash(&self, lighting: &LightingSpec) -> Option<&str> {
        Some(&self.images.get(lighting.image()?)?.as_ref().ok()?.blake3)
    }
}

/// All that a sky depends on, as text.
fn key(lighting: &LightingSpec) -> String {
    serde_json::json!([lighting.sky, lighting.sun, lighting.moon]).to_string()
}

fn read(path: &Path) -> Result<Image, String> {
    let named = |reason: String| format!("lighting.environment.image: {}: {reason}", path.display());
    // Hashed without holding it in memory; read again by the decoder.
    let hashed = std::fs::File::open(path).and_then(|file| {
        let mut hasher = blake3::Hasher::new();
        hasher.update_reader(file)?;
        Ok(hasher.finalize().to_hex().to_string())
    });
    let blake3 = hashed.map_err(|e| named(format!("cannot be read: {e}")))?;
    let picture = fog_dataset::read_picture(path).map_err(|e| format!("lighting.environment.image: {e}"))?;
    let (width, height) = (picture.width as usize, picture.height as usize);
    if width != 2 * height {
        return Err(named(format!(
            "{width} × {height} px; an equirectangular image is twice as wide as high, up to {MAX_TEXELS} px in all"
        )));
    }
    let map = SkyMap::from_rgb(width, height, picture.rgb).map_err(|e| named(e.to_string()))?;
    Ok(Image { map, blake3 })
}
