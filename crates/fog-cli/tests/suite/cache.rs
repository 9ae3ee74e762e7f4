//! The optics table: built by one process for all, and rebuilt when damaged.

use crate::common::{assert_same, cache, command, folder, names, run, sweep};
use std::fs;
use std::path::Path;

const FOG: &str = "fog: {model: advection, height_m: 100}\n";

/// The table files in a cache.
fn tables(cache: &Path) -> Vec<String> {
    names(cache).into_iter().filter(|n| !n.ends_with(".lock")).collect()
}

#[test]
fn damaged_table_is_rebuilt() {
    let dir = folder(FOG);
    let said = sweep(dir.path(), "before").ok().stdout;
    let own = dir.path().join("own");
    fs::create_dir(&own).unwrap();
    // The shared cache has tables of other tests too.
    let used = |name: &String| name.ends_with(".fogtable") && said.contains(name.as_str());
    let name = &tables(Path::new(&cache())).into_iter().find(used).unwrap_or_else(|| panic!("{said}"));
    let good = fs::read(Path::new(&cache()).join(name)).unwrap();
    let mut bad = good.clone();
    bad[good.len() / 3] ^= 4;
    fs::write(own.join(name), bad).unwrap();

    let again = |out| run(&["sweep", "c.yaml", "--out", out, "--cache-dir", "own"], dir.path()).ok().stdout;
    let said = again("rebuilt");
    assert!(said.contains("built in") && said.contains("the old file was damaged: checksum"), "{said}");
    assert!(fs::read(own.join(name)).unwrap() == good, "the same table");
    assert_same(&dir.path().join("before"), &dir.path().join("rebuilt"));
    let said = again("found");
    assert!(said.contains(&format!("own/{name}")) && !said.contains("built in"), "{said}");
}

#[test]
fn two_processes_share_one_build() {
    let dir = folder(FOG);
    let start = |out| {
        command(&["sweep", "c.yaml", "--out", out, "--cache-dir", "new/cache"], dir.path()).spawn().unwrap()
    };
    let both = [start("a"), start("b")].map(|child| child.wait_with_output().unwrap());
    assert!(both.iter().all(|run| run.status.success() && run.stderr.is_empty()));
    let builders =
        both.iter().filter(|run| String::from_utf8_lossy(&run.stdout).contains("built in")).count();
    assert_eq!(builders, 1);
    assert_eq!(tables(&dir.path().join("new/cache")).len(), 1);
    assert_same(&dir.path().join("a"), &dir.path().join("b"));
}
