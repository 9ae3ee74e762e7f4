//! Many writers in one folder.

use std::thread;

use fog_dataset::{Counts, verify};
use fog_film::Channels;

use crate::common::{contents, frame, open, store};

#[test]
fn writers_of_the_same_frames_agree() {
    let (alone, shared) = (tempfile::tempdir().expect("folder"), tempfile::tempdir().expect("folder"));
    let f = frame(40, 30, Channels::Rgb, 2);
    let ids = ["f0", "f1", "f2", "f3"];
    let set = open(alone.path(), ids.len());
    for id in ids {
        store(&set, id, &f).expect("written");
    }
    set.finish().expect("an index");

    // Every thread opens the folder for itself, as a process would, and writes every frame, three times over.
    let dir = shared.path();
    thread::scope(|scope| {
        for offset in 0..6 {
            let f = &f;
            scope.spawn(move || {
                for round in 0..3 {
                    let set = open(dir, ids.len());
                    for i in 0..ids.len() {
                        let id = ids[(i + offset) % ids.len()];
                        if round == 0 && offset % 2 == 0 {
                            set.record_failure(id, "tried too early").expect("recorded");
                        }
                        store(&set, id, f).expect("written");
                        assert!(set.is_done(id));
                    }
                    set.finish().expect("an index");
                }
            });
        }
    });
    assert_eq!(verify(dir).expect("a report").counts, Counts { done: 4, failed: 0, missing: 0 });
    assert!(verify(dir).expect("a report").is_complete());
    assert!(contents(dir) == contents(alone.path()), "other files or bytes");
}

#[test]
fn the_last_to_finish_has_seen_every_frame() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let ids: Vec<String> = (0..12).map(|i| format!("f{i}")).collect();
    thread::scope(|scope| {
        for worker in 0..4 {
            let (dir, ids) = (dir.path(), &ids);
            scope.spawn(move || {
                let set = open(dir, ids.len());
                for id in ids.iter().skip(worker).step_by(4) {
                    store(&set, id, &frame(12, 8, Channels::Rgb, 1)).expect("written");
                }
                set.finish().expect("an index");
            });
        }
    });
    let index = std::fs::read_to_string(dir.path().join("index.csv")).expect("an index");
    assert_eq!(index.matches(",done,").count(), 12, "{index}");
}
