//! The generated scenes: the files in `scenes/`, and the street against the bench's.

mod common;

use fog_scene::{Limits, LoadedScene, generate, load};

fn scene_file(name: &str) -> std::path::PathBuf {
    common::repository().join("scenes").join(format!("{name}.glb"))
}

/// `FOGBANK_BLESS=1` writes the files.
#[test]
fn files_are_what_the_generators_write() {
    for name in generate::NAMES {
        let bytes = generate::generate(name).unwrap();
        assert_eq!(Some(&bytes), generate::generate(name).as_ref());
        let path = scene_file(name);
        if std::env::var_os("FOGBANK_BLESS").is_some_and(|v| v == "1") {
            std::fs::write(&path, &bytes).unwrap();
        }
        assert!(
            std::fs::read(&path).unwrap() == bytes,
            "{} differs: FOGBANK_BLESS=1 rewrites it",
            path.display()
        );
        assert!(bytes.len() < 200_000);
    }
    assert!(generate::generate("moon").is_none());
}

fn loaded(path: &std::path::Path) -> LoadedScene {
    load(path, &Limits::default()).unwrap()
}

#[test]
fn street_is_the_bench_street() {
    let made = loaded(&scene_file("street"));
    let bench = loaded(&common::data("street_night.glb"));
    let (a, b) = (made.geometry.triangles(), bench.geometry.triangles());
    assert_eq!((a.len(), b.len()), (260, 260));
    assert!(made.warnings.is_empty(), "{:?}", made.warnings);
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        assert_eq!((a.positions, a.normals), (b.positions, b.normals), "triangle {i}");
        let (ma, mb) = (&made.materials[a.material as usize], &bench.materials[b.material as usize]);
        let object = |s: &LoadedScene, o: u32| {
            (s.objects[o as usize].class.clone(), s.objects[o as usize].instance.clone())
        };
        assert_eq!(object(&made, a.object), object(&bench, b.object), "triangle {i}");
        // The middle of every square, at most 200 × 200 of them, on this side of the quad's diagonal or the other.
        let [o, u, v] = [a.positions[0], a.positions[1] - a.positions[0], a.positions[2] - a.positions[0]];
        let squares = |e: glam::Vec3| (e.abs().max_element() / 2.0).round() as usize;
        let (nu, nv) = (squares(u).max(1), squares(v).max(1));
        for j in (0..nv).step_by(nv.div_ceil(200)) {
            for i in (0..nu).step_by(nu.div_ceil(200)) {
                // Off the texel borders, which rounding may decide either way.
                let (s, t) = ((i as f32 + 0.37) / nu as f32, (j as f32 + 0.21) / nv as f32);
                if s + t > 1.0 {
                    continue;
                }
                let pa = ma.evaluate(&made.textures, &a.uv_at(s, t));
                let pb = mb.evaluate(&bench.textures, &b.uv_at(s, t));
                assert_eq!(pa, pb, "at {}", o + u * s + v * t);
            }
        }
    }
}

#[test]
fn airfield_is_flat_and_lit() {
    let scene = loaded(&scene_file("airfield"));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let [min, max] = scene.geometry.bounds().unwrap();
    assert_eq!((min.x, max.x, min.z, max.z), (-4000.0, 4000.0, -4000.0, 4000.0));
    assert!(min.y > -0.1 && max.y < 1.0);
    let down = |x: f32, z: f32| {
        let hit = scene.geometry.intersect(glam::Vec3A::new(x, 100.0, z), glam::Vec3A::NEG_Y, 200.0).unwrap();
        scene.objects[scene.geometry.surface(&hit).object as usize].class.clone().unwrap()
    };
    assert_eq!(down(0.3, -10.0), "runway");
    assert_eq!(down(0.3, -70.0), "marking");
    assert_eq!(down(2.7, -20.0), "marking");
    assert_eq!(down(24.0, -60.0), "light");
    assert_eq!(down(100.0, 1000.0), "terrain");
    assert_eq!(scene.materials.iter().filter(|m| m.is_emissive()).count(), 1);
}
