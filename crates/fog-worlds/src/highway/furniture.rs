//! Barriers, reflector posts and gantries.

use super::{BEHIND, Highway, POST_ASIDE, POST_STEP, at, edges, lane_middle};
use crate::error::WorldError;
use crate::glb::Glb;
use crate::mesh::{Mesh, Model};
use crate::paint::Paint;
use crate::place::shift;
use crate::shapes::{block, cylinder, rounded_box};
use crate::signs::{self, Sign, Style};
use fog_core::{Vec2, Vec3};

/// Profile of the concrete barrier in the median, half of it from the ground up: New Jersey shape, 0.81 m (32 in) high.
const JERSEY: [[f32; 2]; 5] = [[0.305, 0.0], [0.305, 0.075], [0.18, 0.33], [0.075, 0.81], [0.0, 0.81]];
/// W-beam guard rail: distance from the pavement, height of its middle, its height, step of its posts.
const RAIL_ASIDE: f32 = 1.0;
const RAIL_UP: f32 = 0.6;
const RAIL_HALF: f32 = 0.155;
const RAIL_POST_STEP: f32 = 4.0;
/// Clearance under the panels of a gantry.
const CLEARANCE: f32 = 5.5;
/// Distance over which barriers are one object.
const SECTION: f32 = 100.0;

pub(super) fn furniture(glb: &mut Glb, options: &Highway) -> Result<(), WorldError> {
    barriers(glb, options);
    posts(glb, options);
    gantries(glb, options)
}

/// A strip swept along z over a profile of (x, y), front on the left of the way along the profile.
fn swept(profile: &[[f32; 2]], z0: f32, z1: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for pair in profile.windows(2) {
        let at = |k: usize, z: f32| (Vec3::new(pair[k][0], pair[k][1], z), Vec2::ZERO);
        mesh.polygon(&[at(0, z0), at(0, z1), at(1, z1), at(1, z0)]);
    }
    mesh
}

fn barriers(glb: &mut Glb, options: &Highway) {
    let concrete = glb.material(&Paint::new("barrier concrete", [0.42, 0.41, 0.39]));
    let steel = glb.material(&Paint::new("galvanised steel", [0.45, 0.46, 0.46]).metal(0.5));
    let [_, outer] = edges();
    let mut middle = Model::default();
    let right: Vec<[f32; 2]> = JERSEY.to_vec();
    middle.add(concrete, &swept(&right, 0.0, -SECTION).mirrored());
    let mut rail = Model::default();
    // The beam's two waves, seen from the road at −x.
    let wave: Vec<[f32; 2]> = (0..=16)
        .map(|k| {
            let t = k as f32 / 16.0;
            [0.04 * crate::place::sin_cos(720.0 * t).1, RAIL_UP - RAIL_HALF + 2.0 * RAIL_HALF * t]
        })
        .collect();
    let back: Vec<[f32; 2]> = wave.iter().rev().copied().collect();
    rail.add(steel, &swept(&wave, -SECTION, 0.0));
    rail.add(steel, &swept(&back, -SECTION, 0.0).placed(shift(0.004, 0.0, 0.0)));
    let mut z = -0.5 * RAIL_POST_STEP;
    while z > -SECTION {
        rail.add(steel, &block(Vec3::new(0.05, 0.0, z - 0.05), Vec3::new(0.12, RAIL_UP + 0.1, z + 0.05)));
        z -= RAIL_POST_STEP;
    }
    let shapes = [glb.shape("median barrier", &middle), glb.shape("guard rail", &rail)];
    let sections = ((options.length_m + BEHIND) / SECTION) as usize;
    for k in 0..sections {
        let z = BEHIND - SECTION * k as f32;
        glb.node(&format!("median_{k:02}"), "wall", shapes[0], at(0.0, 0.0, z, 0.0));
        let x = outer + RAIL_ASIDE;
        glb.node(&format!("rail_right_{k:02}"), "guard rail", shapes[1], at(x, 0.0, z, 0.0));
        // Turned around, the section runs the other way.
        glb.node(&format!("rail_left_{k:02}"), "guard rail", shapes[1], at(-x, 0.0, z - SECTION, 180.0));
    }
}

/// Reflector posts: white, 1 m high, a black band slanting down to the road, a reflector of 18 × 4 cm in it.
fn posts(glb: &mut Glb, options: &Highway) {
    let white = glb.material(&Paint::new("white plastic", [0.72, 0.72, 0.70]).smooth(0.5));
    let black = glb.material(&Paint::new("black plastic", [0.02, 0.02, 0.021]).smooth(0.6));
    let reflector = glb.material(&Paint::new("reflector", [0.75, 0.72, 0.6]).smooth(0.15));
    let mut model = Model::default();
    model.add(white, &rounded_box(Vec3::new(-0.06, -0.1, -0.05), Vec3::new(0.06, 1.0, 0.05), 0.03, 3));
    model.add(black, &rounded_box(Vec3::new(-0.063, 0.66, -0.053), Vec3::new(0.063, 0.91, 0.053), 0.03, 3));
    for z in [-0.056, 0.05] {
        model.add(reflector, &block(Vec3::new(-0.02, 0.695, z), Vec3::new(0.02, 0.875, z + 0.006)));
    }
    let shape = glb.shape("reflector post", &model);
    let x = edges()[1] + POST_ASIDE;
    let n = ((options.length_m + BEHIND) / POST_STEP) as usize;
    for k in 0..=n {
        let z = BEHIND - POST_STEP * k as f32;
        for (side, x) in [("right", x), ("left", -x)] {
            glb.node(&format!("post_{side}_{k:02}"), "pole", shape, at(x, 0.0, z, 0.0));
        }
    }
}

/// Gantries over the right carriageway, their signs towards those who come; the first 120 m ahead of the origin.
fn gantries(glb: &mut Glb, options: &Highway) -> Result<(), WorldError> {
    let steel = glb.material(&Paint::new("galvanised steel", [0.45, 0.46, 0.46]).metal(0.5));
    let [_, outer] = edges();
    let right = outer + RAIL_ASIDE + 1.2;
    let mut frame = Model::default();
    for x in [0.0, right] {
        frame.add(
            steel,
            &cylinder(Vec3::new(x, 0.0, 0.0), Vec3::new(x, CLEARANCE + 2.3, 0.0), 0.22, 0.18, 16),
        );
    }
    for y in [CLEARANCE + 0.5, CLEARANCE + 1.9] {
        frame.add(
            steel,
            &rounded_box(Vec3::new(-0.2, y - 0.12, -0.12), Vec3::new(right + 0.2, y + 0.12, 0.12), 0.05, 2),
        );
    }
    for k in 0..8 {
        let x = right * (k as f32 + 0.5) / 8.0;
        frame.add(
            steel,
            &block(Vec3::new(x - 0.05, CLEARANCE + 0.5, -0.05), Vec3::new(x + 0.05, CLEARANCE + 1.9, 0.05)),
        );
    }
    let shape = glb.shape("gantry", &frame);
    let panels: [&'static [&'static str]; 2] = match options.style {
        Style::Vienna => [&["HAFEN", "ZENTRUM"], &["FLUGHAFEN", "NORD 2 KM"]],
        Style::Mutcd => [&["DOWNTOWN", "HARBOR"], &["AIRPORT", "EXIT 27 1/2 MILE"]],
    };
    let mut signs = Vec::new();
    for rows in panels {
        let panel = signs::panel(&Sign::Destination(rows), options.style);
        // The panel faces −Z and its middle is the origin: raised so that all have one lower edge.
        let mut model = Model::default();
        model.join(&panel.model(glb)?, shift(0.0, CLEARANCE + 0.5 * panel.height, -0.2));
        signs.push(glb.shape(&format!("gantry sign {}", panel.name), &model));
    }
    let (mut z, mut n) = (-120.0, 0);
    while z > -options.length_m {
        glb.node(&format!("gantry_{n}"), "pole", shape, at(0.0, 0.0, z, 0.0));
        let outside = lane_middle(2) + 1.2;
        for (k, x) in [(0, 0.5 * (lane_middle(0) + lane_middle(1)) - 0.3), (1, outside)] {
            glb.node(&format!("gantry_sign_{n}_{k}"), "traffic sign", signs[k], at(x, 0.0, z, 180.0));
        }
        z -= options.gantries_m;
        n += 1;
    }
    Ok(())
}
