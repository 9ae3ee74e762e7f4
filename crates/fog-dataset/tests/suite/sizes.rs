//! The disk estimate against real files.

use std::time::Instant;

use fog_dataset::{OutputSet, estimate_bytes};
use fog_film::Channels;

use crate::common::{contents, frame, open, open_with, planned, store};

#[test]
fn sizes_are_estimated() {
    for (width, height) in [(320, 180), (1920, 1080)] {
        let dir = tempfile::tempdir().expect("temporary folder");
        let set = open(dir.path(), 1);
        let f = frame(width, height, Channels::Rgb, 16);
        let start = Instant::now();
        store(&set, "f0", &f).expect("written");
        let seconds = start.elapsed().as_secs_f64();
        let sizes: Vec<(String, usize)> = contents(dir.path())
            .into_iter()
            .filter(|(name, _)| name.starts_with("f0"))
            .map(|(name, bytes)| (name, bytes.len()))
            .collect();
        let total: usize = sizes.iter().map(|(_, n)| n).sum();
        let estimate = estimate_bytes(width, height, OutputSet::all(), 2);
        println!("{width} x {height}: {seconds:.3} s, {total} bytes, estimated {estimate}, {sizes:?}");
        let ratio = estimate as f64 / total as f64;
        assert!((0.67..1.5).contains(&ratio), "{width} x {height}: {total} bytes, estimated {estimate}");
    }
}

#[test]
fn each_output_is_estimated() {
    let f = frame(320, 180, Channels::Rgb, 16);
    let mut wrong = Vec::new();
    for name in OutputSet::NAMES {
        let dir = tempfile::tempdir().expect("temporary folder");
        let outputs = OutputSet::from_names([name]).expect("known");
        let set = open_with(dir.path(), "a: 1\n", "c", vec![planned("f0", outputs)]).expect("a data set");
        store(&set, "f0", &f).expect("written");
        let own = contents(dir.path()).into_iter().filter(|(file, _)| file.starts_with("f0"));
        let total: usize = own.map(|(_, bytes)| bytes.len()).sum();
        let estimate = estimate_bytes(320, 180, outputs, 2);
        println!("{name}: {:.2} bytes per pixel, estimated {estimate} of {total}", total as f64 / 57_600.0);
        // A real frame's record is not as short as the test's.
        let ratio = estimate as f64 / (total as f64 + 8000.0);
        if !(0.5..2.0).contains(&ratio) {
            wrong.push(format!("{name}: {total} bytes, estimated {estimate}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
