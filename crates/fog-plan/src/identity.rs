//! Names that depend on a frame's content alone: digest, id, pair id and seed.

use serde_json::Value;

use crate::{canonical::canonical, validate::Content};

/// Longest readable part of an id.
const SLUG_LEN: usize = 60;

/// The digests of a frame.
pub(crate) struct Identity {
    /// Of the whole content.
    pub(crate) digest: blake3::Hash,
    /// Of the content without its fog.
    without_fog: blake3::Hash,
}

impl Identity {
    pub(crate) fn of(content: &Content) -> Self {
        let mut json = serde_json::to_value(content).unwrap_or_default();
        let digest = hash(&json);
        if let Value::Object(map) = &mut json {
            map.shift_remove("fog");
        }
        Self { digest, without_fog: hash(&json) }
    }

    /// Id with a readable part made of `words`.
    pub(crate) fn id(&self, words: &[String]) -> String {
        format!("{}-{}", slug(words), &self.digest.to_hex()[..16])
    }

    pub(crate) fn pair_id(&self) -> String {
        self.without_fog.to_hex()[..16].to_owned()
    }

    /// The frame's seed: the first eight bytes of blake3(seed ‖ digest without fog ‖ digest), little-endian.
    pub(crate) fn seed(&self, config_seed: u64) -> u64 {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&config_seed.to_le_bytes());
        hasher.update(self.without_fog.as_bytes());
        hasher.update(self.digest.as_bytes());
        let bytes = *hasher.finalize().as_bytes();
        u64::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3], bytes[4], bytes[5], bytes[6], bytes[7]])
    }
}

/// blake3 of the canonical text.
pub(crate) fn hash(json: &Value) -> blake3::Hash {
    blake3::hash(canonical(json).as_bytes())
}

/// Words joined by `_`, in `[a-z0-9._-]`, beginning with a letter or digit.
fn slug(words: &[String]) -> String {
    let allowed = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '-' };
    let mut slug: String =
        words.join("_").to_ascii_lowercase().chars().map(allowed).take(SLUG_LEN - 1).collect();
    if !slug.starts_with(|c: char| c.is_ascii_alphanumeric()) {
        slug.insert(0, 'x');
    }
    slug.trim_end_matches(['.', '_', '-']).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slug_of(words: &[&str]) -> String {
        slug(&words.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn slugs_are_file_names() {
        assert_eq!(slug_of(&["advection-100", "2", "day"]), "advection-100_2_day");
        assert_eq!(slug_of(&["-3", "scenes/Straße.glb"]), "x-3_scenes-stra-e.glb");
        assert_eq!(slug_of(&["a", "..."]), "a");
        assert_eq!(slug_of(&[&"y".repeat(200)]).len(), 59);
        assert_eq!(slug_of(&["/"]), "x");
    }
}
