//! Targets at known places: checkerboards, ArUco markers and black targets for Koschmieder's law.
//!
//! Everything is measured from the eye at (0, `eye_m`, 0). Boards with a checkerboard between two markers stand to the north
//! (−Z), black targets to the east (+X), each facing the eye on a bearing of its own so that none hides another. The node
//! of each has its measures in `extras`.

use crate::aruco;
use crate::error::{WorldError, within};
use crate::glb::{Glb, Sampling, merge};
use crate::mesh::{Mat, Model};
use crate::paint::Paint;
use crate::picture::Picture;
use crate::place::{Place, sin_cos};
use crate::shapes::{block, cylinder};
use fog_core::{Vec2, Vec3, math};
use serde_json::{Map, Value, json};

/// Options of [`crate::World::Targets`].
#[derive(Clone, Debug, PartialEq)]
pub struct Targets {
    /// Distances of the boards in metres, 1 to 5 of them, 1 to 1000 each.
    pub boards_m: Vec<f32>,
    /// Distances of the black targets in metres, 1 to 8 of them, 5 to 20,000 each.
    pub black_m: Vec<f32>,
    /// Width that each black target subtends, in degrees, 0.1 to 4.
    pub black_deg: f32,
    /// Height of the eye above the ground in metres, 0.5 to 100.
    pub eye_m: f32,
}

impl Default for Targets {
    fn default() -> Self {
        Self {
            boards_m: vec![5.0, 10.0, 20.0, 40.0],
            black_m: vec![25.0, 50.0, 100.0, 200.0, 400.0, 800.0],
            black_deg: 2.0,
            eye_m: 2.0,
        }
    }
}

/// Squares of a checkerboard along its edges.
const SQUARES: [usize; 2] = [9, 6];
/// Edge of a square, and of a marker's black square, by distance.
const SQUARE_BY_DISTANCE: f32 = 1.0 / 60.0;
const MARKER_BY_DISTANCE: f32 = 1.0 / 20.0;
/// Distance of the markers' middles from the board's, by distance.
const MARKER_ASIDE: f32 = 0.13;
/// Bearings between boards and between black targets, in degrees.
const BOARD_STEP_DEG: f32 = 19.5;
const BLACK_STEP_DEG: f32 = 6.0;
/// Half the edge of the ground in metres, beyond the farthest target.
const REACH: f32 = 2000.0;

/// Checks the options and makes the scene.
pub(crate) fn targets(options: &Targets) -> Result<Vec<u8>, WorldError> {
    count("boards", options.boards_m.len(), 5)?;
    count("black targets", options.black_m.len(), 8)?;
    for &d in &options.boards_m {
        within("distance of a board", d, (1.0, 1000.0), "1 to 1000 m")?;
    }
    for &d in &options.black_m {
        within("distance of a black target", d, (5.0, 20_000.0), "5 to 20000 m")?;
    }
    within("width of the black targets", options.black_deg, (0.1, 4.0), "0.1 to 4 degrees")?;
    within("height of the eye", options.eye_m, (0.5, 100.0), "0.5 to 100 m")?;

    let mut glb = Glb::default();
    let far = options.black_m.iter().fold(0.0f32, |a, &b| a.max(b)) + REACH;
    let ground = glb.material(&Paint::lambertian("grey ground", [0.2; 3]));
    let mut model = Model::default();
    model.part(ground).quad(Vec3::new(-far, 0.0, far), Vec3::X * 2.0 * far, Vec3::NEG_Z * 2.0 * far);
    let shape = glb.shape("ground", &model);
    glb.node("ground", "terrain", shape, Place::at(0.0, 0.0, 0.0));

    let mut boards = Boards::new(&mut glb)?;
    let n = options.boards_m.len() as f32;
    for (i, &distance) in options.boards_m.iter().enumerate() {
        let bearing = BOARD_STEP_DEG * (i as f32 - 0.5 * (n - 1.0));
        boards.station(i, distance, bearing, options.eye_m)?;
    }
    let black = glb.material(&Paint::lambertian("black", [0.0; 3]));
    let n = options.black_m.len() as f32;
    for (i, &distance) in options.black_m.iter().enumerate() {
        let bearing = 90.0 + BLACK_STEP_DEG * (i as f32 - 0.5 * (n - 1.0));
        black_target(&mut glb, black, i, distance, bearing, options);
    }
    glb.note("eye_m", json!([0.0, options.eye_m, 0.0]));
    Ok(glb.finish())
}

fn count(option: &'static str, n: usize, most: usize) -> Result<(), WorldError> {
    if (1..=most).contains(&n) {
        return Ok(());
    }
    let valid = if most == 5 { "1 to 5 distances" } else { "1 to 8 distances" };
    Err(WorldError::Option { option, value: format!("a list of {n}"), valid })
}

/// A place at a distance and bearing from the eye, at its height, whose +Z looks back at it.
fn seen_at(distance: f32, bearing_deg: f32, y: f32) -> Place {
    let (s, c) = sin_cos(bearing_deg);
    Place::at(distance * s, y, -distance * c).facing(bearing_deg)
}

/// Materials of the boards.
struct Boards<'a> {
    glb: &'a mut Glb,
    checker: Mat,
    post: Mat,
    markers: usize,
}

impl<'a> Boards<'a> {
    fn new(glb: &'a mut Glb) -> Result<Self, WorldError> {
        let (white, black) = ([0.8; 3], [0.03; 3]);
        let [nx, ny] = SQUARES;
        // A white rim one square wide; the square next to its upper left is black.
        let texel = |i: usize| {
            let (x, y) = (i % (nx + 2), i / (nx + 2));
            let rim = x == 0 || y == 0 || x > nx || y > ny;
            if rim || (x + y) % 2 == 1 { white } else { black }
        };
        let picture = Picture::from_pixels(nx + 2, (0..(nx + 2) * (ny + 2)).map(texel).collect());
        let texture = glb.texture("checkerboard", &picture, Sampling::Squares)?;
        let checker = glb.material(&Paint::lambertian("checkerboard", [1.0; 3]).textured(texture));
        let post = glb.material(&Paint::lambertian("grey post", [0.3; 3]));
        Ok(Self { glb, checker, post, markers: 0 })
    }

    /// A checkerboard between two markers.
    fn station(&mut self, i: usize, distance: f32, bearing: f32, eye: f32) -> Result<(), WorldError> {
        let square = SQUARE_BY_DISTANCE * distance;
        let [nx, ny] = SQUARES.map(|n| n as f32);
        // At the eye's height, or as low as clears the ground.
        let place = seen_at(distance, bearing, eye.max(0.5 * (ny + 3.0) * square));
        let corner = Vec3::new(-0.5 * (nx - 2.0), 0.5 * (ny - 2.0), 0.0) * square;
        let facts = json!({
            "target": "checkerboard", "distance_m": distance, "bearing_deg": bearing, "square_m": square,
            "inner_corners": [SQUARES[0] - 1, SQUARES[1] - 1],
            "first_corner_m": place.point(corner).to_array(),
            "along_m": (place.point(Vec3::X * square) - place.at).to_array(),
            "down_m": (place.point(Vec3::NEG_Y * square) - place.at).to_array(),
        });
        let half = Vec2::new(0.5 * (nx + 2.0), 0.5 * (ny + 2.0)) * square;
        self.panel(&format!("checkerboard_{i}"), self.checker, half, place, facts);
        for side in [-1.0, 1.0] {
            let middle = place.point(Vec3::X * side * MARKER_ASIDE * distance);
            self.marker(distance, Place { at: middle, ..place })?;
        }
        Ok(())
    }

    fn marker(&mut self, distance: f32, place: Place) -> Result<(), WorldError> {
        let id = self.markers;
        self.markers += 1;
        let (white, black) = ([0.8; 3], [0.03; 3]);
        let texel = |i: usize| if aruco::is_white(id, i % 8, i / 8) { white } else { black };
        let picture = Picture::from_pixels(8, (0..64).map(texel).collect());
        let name = format!("aruco_{id}");
        let texture = self.glb.texture(&name, &picture, Sampling::Squares)?;
        let material = self.glb.material(&Paint::lambertian(&name, [1.0; 3]).textured(texture));
        let edge = MARKER_BY_DISTANCE * distance;
        let corner = |x: f32, y: f32| place.point(0.5 * edge * Vec3::new(x, y, 0.0)).to_array();
        let facts = json!({
            "target": "aruco", "dictionary": "DICT_4X4_50", "id": id, "size_m": edge, "distance_m": place.at.with_y(0.0).length(),
            "corners_m": [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)],
        });
        // The white rim is as wide as a bit: a sixth of the marker.
        self.panel(&name, material, Vec2::splat(0.5 * edge * 8.0 / 6.0), place, facts);
        Ok(())
    }

    /// A panel of half-sizes in the plane z = 0 of its place, and its post behind.
    fn panel(&mut self, name: &str, material: Mat, half: Vec2, place: Place, facts: Value) {
        let mut model = Model::default();
        let corner = Vec3::new(-half.x, -half.y, 0.0);
        model.part(material).quad(corner, Vec3::X * 2.0 * half.x, Vec3::Y * 2.0 * half.y);
        let thickness = 0.05 * half.y;
        let mut back =
            block(corner - Vec3::Z * thickness, corner + Vec3::new(2.0 * half.x, 2.0 * half.y, 0.0));
        // Its front would lie in the panel: the first face is left out.
        back.indices.drain(..6);
        model.add(self.post, &back);
        let foot = Vec3::new(0.0, -place.at.y, -2.0 * thickness);
        model.add(self.post, &cylinder(foot, foot.with_y(half.y * 0.5), thickness, thickness, 12));
        let shape = self.glb.shape(name, &model);
        self.glb.node_with(name, "traffic sign", shape, place, members(facts));
    }
}

fn members(value: Value) -> Map<String, Value> {
    let mut object = json!({});
    merge(&mut object, value);
    if let Value::Object(map) = object { map } else { Map::new() }
}

/// A black board from the ground to as far above the horizon as it is wide.
fn black_target(glb: &mut Glb, black: Mat, i: usize, distance: f32, bearing: f32, options: &Targets) {
    let half = distance * math::f32::tan((0.5 * options.black_deg).to_radians());
    let height = options.eye_m + 2.0 * half;
    let mut model = Model::default();
    // The front is at the stated distance.
    let depth = 0.02 * half;
    model.add(black, &block(Vec3::new(-half, 0.0, -depth), Vec3::new(half, height, 0.0)));
    let name = format!("black_{i}");
    let shape = glb.shape(&name, &model);
    let place = seen_at(distance, bearing, 0.0);
    let facts = json!({
        "target": "black", "distance_m": distance, "bearing_deg": bearing, "width_m": 2.0 * half, "height_m": height,
    });
    glb.node_with(&name, "traffic sign", shape, place, members(facts));
}
