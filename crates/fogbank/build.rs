//! Digest of the code and data that a frame depends on, recorded in every data set: sources, lock file, tables and
//! lighting presets.

use std::fs;
use std::path::{Path, PathBuf};

fn collect(dir: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(dir) else { return };
    for path in entries.flatten().map(|e| e.path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && !["target", "cache", "tests"].contains(&name.as_str()) {
            collect(&path, files);
        } else if ["rs", "toml", "csv", "yaml"]
            .contains(&path.extension().unwrap_or_default().to_str().unwrap_or(""))
        {
            files.push(path);
        }
    }
}

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = vec![root.join("Cargo.lock"), root.join("Cargo.toml")];
    for dir in ["crates", "tables", "configs/lighting"] {
        println!("cargo:rerun-if-changed={}", root.join(dir).display());
        collect(&root.join(dir), &mut files);
    }
    println!("cargo:rerun-if-changed={}", root.join("Cargo.lock").display());
    files.sort();
    let mut hash = blake3::Hasher::new();
    for file in files {
        let name = file.strip_prefix(&root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        let text = fs::read(&file).unwrap_or_default();
        hash.update(name.as_bytes()).update(&(text.len() as u64).to_le_bytes()).update(&text);
    }
    println!("cargo:rustc-env=FOGBANK_CODE_DIGEST={}", &hash.finalize().to_hex()[..32]);
}
