//! Section `scene`.

use fog_plan::{SceneSource, WorldSpec};

/// Messages about this scene, which is on line 3.
fn errors(scene: &str) -> Vec<String> {
    crate::errors_with(&format!("version: 1\nname: t\nscene: {scene}\nfog: none\n"), &[])
}

#[test]
fn options_have_ranges_and_owners() {
    assert_eq!(
        errors("{generate: urban, length_m: 20, traffic: 1.5, limit: 300}"),
        [
            "configs/x.yaml:3:36: scene.length_m: 20 m is out of range; valid: 80 to 600 m",
            "configs/x.yaml:3:49: scene.traffic: 1.5 is out of range; valid: 0 to 1",
            "configs/x.yaml:3:61: scene.limit: 300 is out of range; valid: 5 to 130",
        ]
    );
    assert_eq!(
        errors("{generate: highway, people: 1, papi_deg: 3}"),
        [
            "configs/x.yaml:3:36: scene.people: `people` belongs to generate urban, not highway",
            "configs/x.yaml:3:49: scene.papi_deg: `papi_deg` belongs to generate runway, not highway",
        ]
    );
    assert_eq!(
        errors("{file: a.glb, style: mutcd}"),
        ["configs/x.yaml:3:29: scene.style: `style` belongs to generates urban, highway, not a file"]
    );
    assert_eq!(
        errors("{file: a.glb, generate: street}"),
        ["configs/x.yaml:3:15: scene.file: not with scene.generate: a scene is a file or made by formula"]
    );
    assert_eq!(
        errors("{generate: runway, width_m: 50, length_m: 100}"),
        [
            "configs/x.yaml:3:50: scene.length_m: 100 m is out of range; valid: 1200 to 5000 m",
            "configs/x.yaml:3:36: scene.width_m: 50 m is no width of a runway here; valid: 30, 45 or 60 m",
        ]
    );
    assert_eq!(
        errors("{generate: targets, boards_m: [5, 0], black_m: []}"),
        [
            "configs/x.yaml:3:42: scene.boards_m.1: 0 m is out of range; valid: 1 to 1000 m",
            "configs/x.yaml:3:55: scene.black_m: 0 distances; valid: 1 to 8",
        ]
    );
    assert_eq!(
        errors("{generate: town}"),
        [
            "configs/x.yaml:3:19: scene.generate: unknown value \"town\"; expected one of street, urban, highway, runway, \
             targets"
        ]
    );
    assert_eq!(
        errors("{file: a.glb, limits: {triangles: 0, vertices: 3}}"),
        [
            "configs/x.yaml:3:45: scene.limits.vertices: unknown key; expected one of triangles, texture_px, file_bytes, \
             nodes",
            "configs/x.yaml:3:42: scene.limits.triangles: 0 leaves no scene; valid: 1 or more",
        ]
    );
}

#[test]
fn options_are_part_of_a_frame_and_limits_are_not() {
    let frame = |scene: &str| {
        let text = format!("version: 1\nname: t\nscene: {scene}\nfog: none\n");
        fog_plan::parse(&text, "c.yaml", &[]).expect("a plan").frame(0).expect("a frame")
    };
    let plain = frame("{generate: urban}");
    let WorldSpec::Urban { seed: 1, length_m: None, .. } =
        (match &plain.scene.as_ref().expect("a scene").source {
            SceneSource::Made(world) => world.clone(),
            SceneSource::File { .. } => panic!("not a file"),
        })
    else {
        panic!("{:?}", plain.scene)
    };
    let json = serde_json::to_value(&plain).expect("JSON");
    assert_eq!(json["scene"], serde_json::json!({"generate": "urban", "seed": 1}));
    assert_eq!(frame("{generate: urban, limits: {triangles: 9}}").digest, plain.digest);
    assert_ne!(frame("{generate: urban, seed: 2}").digest, plain.digest);
    assert_ne!(frame("{generate: urban, traffic: 0.5}").digest, plain.digest);
}
