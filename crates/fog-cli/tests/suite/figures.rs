//! `fogbank figures`.

use crate::common::{names, repository, run, write};
use std::fs;

#[test]
fn one_figure_in_every_format() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let said = run(&["figures", "--out", "a/b", "--only", "fig5"], dir.path()).ok().stdout;
    assert!(said.starts_with("fig5 ") && said.lines().count() == 1, "{said}");
    let out = dir.path().join("a/b");
    assert_eq!(names(&out), ["fig5.csv", "fig5.png", "fig5.svg"]);
    let read = |name: &str| fs::read(out.join(name)).expect("read");
    assert!(read("fig5.png").starts_with(b"\x89PNG\r\n\x1a\n"));
    assert!(read("fig5.svg").starts_with(b"<svg xmlns=") && read("fig5.svg").ends_with(b"</svg>\n"));
    let csv = String::from_utf8(read("fig5.csv")).expect("UTF-8");
    assert!(csv.starts_with("height_m,altitude_m,number_density_1_m3\n100,0,"), "{}", &csv[..80]);
}

#[test]
fn heights_formats_and_models_are_heeded() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let arcata = fs::read_to_string(repository("tables/advection/arcata.yaml")).expect("read");
    write(
        dir.path(),
        "denser.yaml",
        arcata.replace("number_density_scale: 1.0", "number_density_scale: 3.0"),
    );
    let draw = |more: &[&str]| {
        let mut args = vec!["figures", "--out", "o", "--only", "fig3,fig5", "--format", "csv"];
        args.extend(more);
        let said = run(&args, dir.path()).ok().stdout;
        assert_eq!(names(&dir.path().join("o")), ["fig3.csv", "fig5.csv"]);
        (said, fs::read_to_string(dir.path().join("o/fig5.csv")).expect("read"))
    };
    let (said, thin) = draw(&["--height", "150"]);
    assert!(!said.contains("warning") && thin.lines().skip(1).all(|l| l.starts_with("150,")), "{said}{thin}");
    let (said, dense) = draw(&["--height", "150", "--model", "denser.yaml", "--quiet"]);
    assert_eq!(said, "");
    let base = |csv: &str| {
        csv.lines().nth(1).and_then(|l| l.split(',').nth(2)?.parse::<f64>().ok()).expect("number")
    };
    assert!((base(&dense) / base(&thin) - 3.0).abs() < 1e-9);
    let (said, _) = draw(&["--height", "150", "--height", "50"]);
    assert!(
        said.contains("warning: fog of 50 m extrapolates the model, measured from 100 to 260 m"),
        "{said}"
    );
}

#[test]
fn mistakes_say_what_would_be_right() {
    let dir = tempfile::tempdir().expect("temporary folder");
    write(dir.path(), "broken.yaml", "mu_L: [fog]\n");
    write(dir.path(), "file", "");
    for (args, told) in [
        (&["--out", "o", "--only", "fig8"][..], &["fig8", "fig3", "fig11", "phenomena"][..]),
        (&["--only", "fig5"], &["--out"]),
        (&["--out", "o", "--height", "0"], &["fog height_m is 0", "1 to 2000"]),
        (&["--out", "o", "--height", "5000"], &["fog height_m is 5000", "1 to 2000"]),
        (&["--out", "o", "--height", "tall"], &["tall"]),
        (&["--out", "o", "--format", "pdf"], &["pdf", "svg", "png", "csv"]),
        (&["--out", "o", "--model", "none.yaml"], &["cannot read none.yaml"]),
        (&["--out", "o", "--model", "broken.yaml"], &["broken.yaml"]),
        (&["--out", "file/o", "--only", "fig5"], &["cannot make file/o"]),
    ] {
        let run = run(&[&["figures"], args].concat(), dir.path());
        assert_eq!(run.code, Some(2), "{args:?}: {}", run.stderr);
        assert!(told.iter().all(|word| run.stderr.contains(word)), "{args:?}: {}", run.stderr);
        assert!(!dir.path().join("o").exists());
    }
}
