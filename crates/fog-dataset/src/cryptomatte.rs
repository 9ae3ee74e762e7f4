//! Instances as a Cryptomatte layer: masks by name that compositors know (Cryptomatte specification 1.2.0, Psyop 2016 to 2020).
//!
//! The id of a thing is the MurmurHash3 (32 bits, seed 0) of its name's UTF-8 bytes, as the bits of a float whose exponent is
//! kept off 0 and 255, so that no id is subnormal, infinite or NaN. `CryptoObject00.R` has the id of a pixel and
//! `CryptoObject00.G` how much of the pixel it covers; 0 and 0 where there is nothing. A pixel's instance is that of the ray
//! through its centre, never a mixture: its coverage is 1 and there is no second rank (`.B` and `.A` are 0).

use std::collections::{BTreeSet, HashSet};

use serde_json::{Map, Value};

/// Name of the layer's type; the numbered layer of its ranks is this and `00`.
const TYPE_NAME: &str = "CryptoObject";

/// What a picture has of a Cryptomatte layer.
pub(crate) struct Cryptomatte {
    /// Channel names and row-major values.
    pub(crate) channels: Vec<(String, Vec<f32>)>,
    /// Whole attribute names and their texts.
    pub(crate) attributes: Vec<(String, String)>,
}

/// The layer of a mask; `names` are those of the things by number, that of instance i at i − 1. `None` when a number in the
/// mask has no name.
pub(crate) fn cryptomatte(mask: &[u16], names: &[String]) -> Option<Cryptomatte> {
    let things = distinct(names);
    let seen: BTreeSet<u16> = mask.iter().copied().filter(|&instance| instance > 0).collect();
    let mut manifest = Map::new();
    for &instance in &seen {
        let (name, bits) = things.get(usize::from(instance) - 1)?;
        manifest.insert(name.clone(), Value::String(format!("{bits:08x}")));
    }
    let id = |&instance: &u16| match instance {
        0 => 0.0,
        _ => f32::from_bits(things[usize::from(instance) - 1].1),
    };
    let nothing = vec![0.0; mask.len()];
    let channels = vec![
        (format!("{TYPE_NAME}00.R"), mask.iter().map(id).collect()),
        (format!("{TYPE_NAME}00.G"), mask.iter().map(|&instance| f32::from(instance.min(1))).collect()),
        (format!("{TYPE_NAME}00.B"), nothing.clone()),
        (format!("{TYPE_NAME}00.A"), nothing),
    ];
    let key = format!("{:08x}", murmur3_32(TYPE_NAME.as_bytes()));
    let attribute = |what: &str, text: String| (format!("cryptomatte/{}/{what}", &key[..7]), text);
    let attributes = vec![
        attribute("name", TYPE_NAME.to_owned()),
        attribute("hash", "MurmurHash3_32".to_owned()),
        attribute("conversion", "uint32_to_float32".to_owned()),
        attribute("manifest", Value::Object(manifest).to_string()),
    ];
    Some(Cryptomatte { channels, attributes })
}

/// Names and ids, no two of them alike: a name that is taken, or whose id is, gets ` #2`, ` #3`, …
fn distinct(names: &[String]) -> Vec<(String, u32)> {
    let mut taken = HashSet::from([0]);
    let mut name_and_id = |name: &String| {
        let mut named = name.clone();
        let mut count = 1;
        while !taken.insert(id_bits(&named)) {
            count += 1;
            named = format!("{name} #{count}");
        }
        let bits = id_bits(&named);
        (named, bits)
    };
    names.iter().map(&mut name_and_id).collect()
}

/// Bits of the float that is the id of a name.
fn id_bits(name: &str) -> u32 {
    let hash = murmur3_32(name.as_bytes());
    let exponent = ((hash >> 23) & 0xff).clamp(1, 254);
    (hash & 0x807f_ffff) | (exponent << 23)
}

/// MurmurHash3_x86_32 with seed 0 (Appleby 2011).
fn murmur3_32(bytes: &[u8]) -> u32 {
    let scramble = |k: u32| k.wrapping_mul(0xcc9e_2d51).rotate_left(15).wrapping_mul(0x1b87_3593);
    let (blocks, rest) = bytes.as_chunks::<4>();
    let mut hash = blocks.iter().fold(0u32, |hash, block| {
        let hash = (hash ^ scramble(u32::from_le_bytes(*block))).rotate_left(13);
        hash.wrapping_mul(5).wrapping_add(0xe654_6b64)
    });
    let mut last = [0; 4];
    last[..rest.len()].copy_from_slice(rest);
    hash ^= scramble(u32::from_le_bytes(last));
    hash ^= bytes.len() as u32;
    hash = (hash ^ (hash >> 16)).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ (hash >> 13)).wrapping_mul(0xc2b2_ae35);
    hash ^ (hash >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_those_of_the_specification() {
        // Its examples, and the published test vector of the empty text.
        assert_eq!(murmur3_32(b""), 0);
        assert_eq!(id_bits("bunny"), 0x1385_1a76);
        assert_eq!(id_bits("default"), 0x42c9_679f);
        assert_eq!(id_bits("bunny_porcelain_mat"), 0xb24b_26d4);
        for i in 0..10_000 {
            assert!(f32::from_bits(id_bits(&format!("thing {i}"))).is_normal(), "{i}");
        }
        assert_eq!(id_bits(""), 1 << 23, "the exponent is kept off 0");
    }

    #[test]
    fn things_of_one_name_are_told_apart() {
        let names = ["car", "car", "tree", "car"].map(str::to_owned);
        let things = distinct(&names);
        assert_eq!(
            things.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
            ["car", "car #2", "tree", "car #3"]
        );
        let layer = cryptomatte(&[0, 2, 2, 3], &names).expect("all are named");
        let (name, ids) = &layer.channels[0];
        assert_eq!(name, "CryptoObject00.R");
        assert_eq!(
            ids.iter().map(|id| id.to_bits()).collect::<Vec<_>>(),
            [0, things[1].1, things[1].1, things[2].1]
        );
        assert_eq!(layer.channels[1].1, [0.0, 1.0, 1.0, 1.0]);
        // The first seven digits of the hash of the name of the type.
        let (key, manifest) = &layer.attributes[3];
        assert_eq!(key, "cryptomatte/3ae39a5/manifest");
        assert_eq!(
            *manifest,
            format!("{{\"car #2\":\"{:08x}\",\"tree\":\"{:08x}\"}}", things[1].1, things[2].1)
        );
        assert!(cryptomatte(&[5], &names).is_none(), "no name");
    }
}
