//! Single pictures: what is read from which file.

use std::fs;
use std::path::Path;

use fog_core::colour::srgb_decode;
use fog_dataset::{Error, picture_path, read_picture, read_plan, write_png};
use fog_film::{Channels, Scale, Srgb8Picture};
use image::{ImageBuffer, Rgb, Rgba};

use crate::common::{frame, open, store};

fn refused(path: &Path) -> String {
    let e = read_picture(path).expect_err("no picture");
    assert!(matches!(e, Error::NotAPicture { .. }), "{e}");
    e.to_string()
}

#[test]
fn our_own_frames() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 2);
    let f = frame(33, 17, Channels::Rgb, 4);
    store(&set, "f0", &f).expect("written");
    let plan = read_plan(dir.path()).expect("a plan");
    assert_eq!(picture_path(dir.path(), &plan[1]), None, "not rendered");
    let path = picture_path(dir.path(), &plan[0]).expect("rendered");
    assert_eq!(path, dir.path().join("f0.hdr.exr"));
    let p = read_picture(&path).expect("read");
    assert_eq!((p.width, p.height, p.scale), (33, 17, Scale::Radiance { exposure: 1.25 }));
    assert!((0..f.pixel_count()).all(|i| p.rgb[i] == f.image(i)));
    assert_eq!(p.standard_error.as_ref(), Some(&f.standard_error));
    // The PNG is what that picture shows, to half of a byte.
    let shown = read_picture(&dir.path().join("f0.rgb.png")).expect("read");
    assert_eq!((shown.scale, shown.standard_error.is_none()), (Scale::Display, true));
    let c = fog_film::compare(&p, &shown).expect("comparable");
    assert_eq!(c.mse_srgb8, 0.0);
    assert!(c.delta_e.max > 0.0 && c.delta_e.max < 1.0, "{:?}", c.delta_e);
    let mut images_only = plan[0].clone();
    images_only.outputs.hdr = false;
    assert_eq!(picture_path(dir.path(), &images_only), Some(dir.path().join("f0.rgb.png")));
    // Truth is no picture.
    let e = refused(&dir.path().join("f0.gt.exr"));
    assert!(e.contains("neither channels R, G, B nor Y, but CryptoObject00.A, "), "{e}");
}

#[test]
fn one_wavelength_is_grey() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 1);
    let f = frame(8, 6, Channels::Mono { wavelength_nm: 550.0 }, 4);
    store(&set, "f0", &f).expect("written");
    let p = read_picture(&dir.path().join("f0.hdr.exr")).expect("read");
    assert!((0..f.pixel_count()).all(|i| p.rgb[i] == [f.image(i)[0]; 3]));
}

#[test]
fn srgb_of_8_and_16_bits() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let path = |name: &str| dir.path().join(name);
    let decoded = |v: f32| srgb_decode(v);
    ImageBuffer::<Rgba<u16>, _>::from_pixel(2, 1, Rgba([65535, 32768, 0, 7]))
        .save(path("deep.png"))
        .expect("saved");
    let p = read_picture(&path("deep.png")).expect("read");
    assert_eq!(p.rgb, [[1.0, decoded(32768.0 / 65535.0), 0.0]; 2]);
    ImageBuffer::<Rgb<u8>, _>::from_pixel(8, 8, Rgb([128; 3])).save(path("grey.jpg")).expect("saved");
    // Whatever its name.
    fs::rename(path("grey.jpg"), path("grey.txt")).expect("renamed");
    let p = read_picture(&path("grey.txt")).expect("read");
    assert_eq!((p.width, p.height), (8, 8));
    assert!(p.rgb.iter().flatten().all(|v| (v - decoded(128.0 / 255.0)).abs() < 0.01));
}

#[test]
fn maps_are_written_whole() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let bytes: Vec<u8> = (0..18).map(|i| i * 14).collect();
    let map = Srgb8Picture { width: 3, height: 2, bytes };
    write_png(&dir.path().join("map.png"), &map).expect("written");
    let back = image::open(dir.path().join("map.png")).expect("a PNG").into_rgb8();
    assert_eq!((back.dimensions(), back.into_raw()), ((3, 2), map.bytes.clone()));
    let e = write_png(&dir.path().join("no/map.png"), &map).expect_err("no folder").to_string();
    assert!(e.starts_with("cannot write") && e.contains("no/map.png"), "{e}");
}

#[test]
fn what_is_no_picture() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let path = |name: &str| dir.path().join(name);
    for (name, content) in [("a.png", &b"miaow"[..]), ("b.exr", b""), ("c.gif", b"GIF89a........")] {
        fs::write(path(name), content).expect("written");
        let e = refused(&path(name));
        assert!(e.contains(name) && e.contains("neither PNG nor JPEG nor Radiance HDR nor OpenEXR"), "{e}");
    }
    for (name, content) in [("d.png", &b"\x89PNG\r\n\x1a\n...."[..]), ("e.exr", b"\x76\x2f\x31\x01...")] {
        fs::write(path(name), content).expect("written");
        let e = read_picture(&path(name)).expect_err("broken");
        assert!(matches!(e, Error::Picture { .. }) && e.to_string().contains(name), "{e}");
    }
    assert!(matches!(read_picture(&path("nothing.png")), Err(Error::Io { .. })));
    assert!(matches!(read_picture(dir.path()), Err(Error::Io { .. })));
}

#[test]
fn other_primaries_are_refused() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 1);
    store(&set, "f0", &frame(8, 6, Channels::Rgb, 2)).expect("written");
    let mut bytes = fs::read(dir.path().join("f0.hdr.exr")).expect("read");
    let name = b"chromaticities\0chromaticities\0";
    let at = bytes.windows(name.len()).position(|w| w == name).expect("the attribute") + name.len() + 4;
    // Red of ACES AP0 (SMPTE ST 2065-1): x = 0.7347.
    bytes[at..at + 4].copy_from_slice(&0.7347f32.to_le_bytes());
    fs::write(dir.path().join("aces.exr"), bytes).expect("written");
    assert!(refused(&dir.path().join("aces.exr")).contains("primaries are not those of sRGB"));
}

#[test]
fn damaged_pictures_are_errors_and_never_panics() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 1);
    store(&set, "f0", &frame(9, 5, Channels::Rgb, 4)).expect("written");
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x80\x80\x80\x81".to_vec();
    let read = |name: &str| fs::read(dir.path().join(name)).expect("read");
    let path = dir.path().join("bad");
    let mut random = fog_core::random::PathRng::new(5, 0, 0);
    let mut refused = 0;
    for whole in [read("f0.hdr.exr"), read("f0.rgb.png"), hdr] {
        for _ in 0..400 {
            let mut bytes = whole.clone();
            for _ in 0..1 + random.next_u64() % 3 {
                let at = (random.next_u64() % bytes.len() as u64) as usize;
                match random.next_u64() % 4 {
                    0 => bytes[at] ^= 1 << (random.next_u64() % 8),
                    1 => bytes[at] = 0xff,
                    2 => bytes.truncate(at.max(1)),
                    _ => bytes[at] = random.next_u64() as u8,
                }
            }
            fs::write(&path, &bytes).expect("write");
            refused += u32::from(read_picture(&path).is_err());
        }
    }
    assert!(refused > 100, "{refused}");
}

#[test]
fn pictures_that_promise_too_much_are_refused_before_room_is_made() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let path = dir.path().join("huge.hdr");
    fs::write(&path, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n").expect("write");
    assert!(refused(&path).contains("60000 × 60000 px; up to 134217728 px"), "{}", refused(&path));
    // A PNG of no size is none.
    let mut png = Vec::new();
    png.extend(13_u32.to_be_bytes());
    png.extend(b"IHDR");
    png.extend([0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0]);
    png.extend([0; 4]);
    let path = dir.path().join("empty.png");
    fs::write(&path, [&b"\x89PNG\r\n\x1a\n"[..], &png].concat()).expect("write");
    assert!(read_picture(&path).is_err());
}
