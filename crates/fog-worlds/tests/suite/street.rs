//! The street against the bench's.

use super::common::{made, repository};
use fog_scene::{Limits, LoadedScene, load};
use fog_worlds::World;

#[test]
fn street_is_the_bench_street() {
    let made = made(&World::Street).scene;
    let bench = load(&repository("tests/data/street_night.glb"), &Limits::default()).unwrap();
    let (a, b) = (made.geometry.triangles(), bench.geometry.triangles());
    assert_eq!((a.len(), b.len()), (260, 260));
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        assert_eq!((a.positions, a.normals), (b.positions, b.normals), "triangle {i}");
        let (ma, mb) = (&made.materials[a.material as usize], &bench.materials[b.material as usize]);
        let object = |s: &LoadedScene, o: u32| {
            (s.objects[o as usize].class.clone(), s.objects[o as usize].instance.clone())
        };
        assert_eq!(object(&made, a.object), object(&bench, b.object), "triangle {i}");
        // The middle of every square, at most 200 × 200 of them, on this side of the quad's diagonal or the other.
        let [o, u, v] = [a.positions[0], a.positions[1] - a.positions[0], a.positions[2] - a.positions[0]];
        let squares = |e: fog_core::Vec3| (e.abs().max_element() / 2.0).round() as usize;
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
