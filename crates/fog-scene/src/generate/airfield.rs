//! A runway in flat grassland, for approaches from the south.
//!
//! Y up; the runway is 45 m × 2500 m, its threshold at z = 0, and runs along −Z (heading 0); its surface has altitude 0,
//! the touchdown point is the origin. Edge lights stand every 60 m. All surfaces are Lambertian.

use super::glb::Glb;
use super::quads::Quads;
use serde_json::json;

const WIDTH: f32 = 45.0;
const LENGTH: f32 = 2500.0;
/// Half the edge of the ground, in metres.
const REACH: f32 = 4000.0;
/// Altitude of the grass under the runway's surface, and of the paint over it: metres.
const GRASS: f32 = -0.05;
const PAINT: f32 = 0.02;
/// Edge of the grass' squares in metres.
const FIELD: f32 = 100.0;
/// Edge lights: distance along the runway and from its edge, edge of the box: metres.
const LIGHT_STEP: f32 = 60.0;
const LIGHT_ASIDE: f32 = 1.5;
const LIGHT_SIZE: f32 = 0.3;
/// Radiance of the edge lights, on the scale on which a bright sky is 1.
const LIGHT_RADIANCE: f32 = 200.0;

/// The scene as GLB.
pub(super) fn airfield() -> Vec<u8> {
    let mut glb = Glb::default();
    let grass = glb.checker("grass", [0.09, 0.16, 0.05], [0.11, 0.19, 0.06]);
    let grass = glb.lambertian("grass", json!({"baseColorTexture": {"index": grass}}), json!({}));
    let asphalt = glb.lambertian("asphalt", json!({"baseColorFactor": [0.08, 0.08, 0.085, 1]}), json!({}));
    let paint = glb.lambertian("paint", json!({"baseColorFactor": [0.8, 0.8, 0.8, 1]}), json!({}));
    let lamp = glb.lambertian(
        "edge light",
        json!({"baseColorFactor": [0.5, 0.5, 0.5, 1]}),
        json!({"emissiveFactor": [1, 1, 1], "extensions": {
            "KHR_materials_specular": {"specularFactor": 0},
            "KHR_materials_emissive_strength": {"emissiveStrength": LIGHT_RADIANCE},
        }}),
    );

    let mut ground = Quads::default();
    ground.checkered([-REACH, GRASS, REACH], [2.0 * REACH, 0.0, 0.0], [0.0, 0.0, -2.0 * REACH], FIELD);
    let ground = glb.mesh("ground", &ground, grass);
    glb.node("ground", "terrain", ground, None);

    let mut slab = Quads::default();
    let half = 0.5 * WIDTH;
    Quads::each_face([-half, GRASS, -LENGTH], [half, 0.0, 0.0], |o, u, v| slab.plain(o, u, v));
    let slab = glb.mesh("runway", &slab, asphalt);
    glb.node("runway", "runway", slab, None);

    let markings = glb.mesh("markings", &markings(), paint);
    glb.node("markings", "marking", markings, None);

    let mut light = Quads::default();
    let r = 0.5 * LIGHT_SIZE;
    Quads::each_face([-r, 0.0, -r], [r, LIGHT_SIZE, r], |o, u, v| light.plain(o, u, v));
    let light = glb.mesh("edge light", &light, lamp);
    let steps = (LENGTH / LIGHT_STEP) as u32;
    for (side, x) in [("L", -half - LIGHT_ASIDE), ("R", half + LIGHT_ASIDE)] {
        for i in 0..=steps {
            let position = [x, GRASS, -(i as f32) * LIGHT_STEP];
            glb.node(&format!("edge_light_{side}{i:02}"), "light", light, Some(position));
        }
    }
    glb.finish()
}

/// Threshold bars at both ends, aiming points and the centre line.
fn markings() -> Quads {
    let mut quads = Quads::default();
    let mut bar = |x: f32, near: f32, width: f32, length: f32| {
        quads.plain([x - 0.5 * width, PAINT, -near], [width, 0.0, 0.0], [0.0, 0.0, -length]);
    };
    for start in [6.0, LENGTH - 36.0] {
        // Six bars a side, 1.8 m wide and as far apart, a double gap in the middle.
        for i in 0..6 {
            let x = 2.7 + 3.6 * i as f32;
            bar(-x, start, 1.8, 30.0);
            bar(x, start, 1.8, 30.0);
        }
    }
    for start in [400.0, LENGTH - 445.0] {
        bar(-12.0, start, 6.0, 45.0);
        bar(12.0, start, 6.0, 45.0);
    }
    // Dashes of 30 m every 50 m, clear of the threshold bars.
    for i in 0..48 {
        let start = 56.0 + 50.0 * i as f32;
        if start + 30.0 < LENGTH - 40.0 {
            bar(0.0, start, 0.9, 30.0);
        }
    }
    quads
}
