//! Lights of the runway and its taxiway: AC 150/5340-30J (FAA 2018).

use super::beams::{Hue, Kind};
use super::fixtures::{Beam, Fixtures, SMALL_RADIUS};
use super::ground::{TAXIWAY_ASIDE, TAXIWAY_WIDTH, connectors};
use super::{ApproachLights, End, FT, Runway};
use crate::lamp::{Lamp, colour};
use fog_core::Vec3;

/// Edge lights: greatest spacing, distance from the edge (2 to 10 ft), yellow towards the end.
const EDGE_SPACING: f32 = 200.0 * FT;
pub(super) const EDGE_ASIDE: f32 = 5.0 * FT;
const CAUTION: f32 = 2000.0 * FT;
/// Centre-line lights: spacing, distance of the first, offset from the line, where red begins and is alone.
const CENTRE_SPACING: f32 = 50.0 * FT;
const CENTRE_FIRST: f32 = 75.0 * FT;
const CENTRE_ASIDE: f32 = 2.0 * FT;
const ALTERNATING: f32 = 3000.0 * FT;
const ALL_RED: f32 = 1000.0 * FT;
/// Touchdown-zone lights: rows, spacing of rows, innermost light, spacing within a row of three.
const TOUCHDOWN_END: f32 = 3000.0 * FT;
const TOUCHDOWN_SPACING: f32 = 100.0 * FT;
const TOUCHDOWN_INNER: f32 = 36.0 * FT;
const WITHIN_ROW: f32 = 5.0 * FT;
/// Threshold and end lights: spacing without an approach system; distance before the threshold.
const END_SPACING: f32 = 10.0 * FT;
const END_BEFORE: f32 = 2.0 * FT;
/// Taxiway edge lights: spacing, distance from the edge, intensity (L-861T, AC 150/5345-46: 2 cd at least).
const TAXIWAY_SPACING: f32 = 60.0;
const TAXIWAY_LIGHT_ASIDE: f32 = 1.5;
const TAXIWAY_CANDELA: f32 = 2.0;
/// Elevations of the beams' axes in degrees: the middle of the vertical coverage in CS-ADR-DSN.U.940 where it was at hand
/// (touchdown zone 5.5), the others from general knowledge.
const EDGE_UP: f32 = 3.5;
const CENTRE_UP: f32 = 3.5;
const TOUCHDOWN_UP: f32 = 5.5;
const THRESHOLD_UP: f32 = 4.5;
const END_UP: f32 = 2.5;
/// Toe-in in degrees.
const EDGE_TOE: f32 = 3.5;
const TOUCHDOWN_TOE: f32 = 4.0;
const THRESHOLD_TOE: f32 = 3.5;

/// A beam towards the aircraft that comes to an end: the heading is the pilot's, turned around and toed in.
pub(super) fn towards(end: End, kind: Kind, hue: Hue, elevation_deg: f32, toe_deg: f32) -> Beam {
    let heading_deg = if end == End::Near { 180.0 } else { 0.0 };
    Beam { kind, hue, heading_deg: heading_deg + toe_deg, elevation_deg }
}

/// Toe-in towards the centre line as a turn of the heading, for a light on the pilot's left or right.
fn toe(deg: f32, right: f32) -> f32 {
    if right > 0.0 { deg } else { -deg }
}

pub(super) fn runway_lights(lights: &mut Fixtures<'_>, options: &Runway) {
    edge(lights, options);
    centre_line(lights, options);
    threshold_and_end(lights, options);
    if options.approach == ApproachLights::Alsf2 {
        touchdown_zone(lights, options);
    }
    taxiway(lights, options);
}

fn edge(lights: &mut Fixtures<'_>, options: &Runway) {
    let length = options.length_m;
    let steps = (length / EDGE_SPACING).ceil();
    let aside = 0.5 * options.width_m + EDGE_ASIDE;
    for i in 0..=steps as u32 {
        let along = length * i as f32 / steps;
        for x in [-aside, aside] {
            let hue = |left: f32| if left < CAUTION.min(0.5 * length) { Hue::Yellow } else { Hue::White };
            let near = towards(End::Near, Kind::Edge, hue(length - along), EDGE_UP, toe(EDGE_TOE, x));
            let far = towards(End::Far, Kind::Edge, hue(along), EDGE_UP, toe(EDGE_TOE, -x));
            lights.dome("edge light", super::at(along, x, 0.0), 180.0, [near, far]);
        }
    }
}

/// Colour of a centre-line light for the aircraft that has `left` metres of runway before it; `even` lights are red where
/// both colours alternate.
fn centre_hue(left: f32, even: bool) -> Hue {
    if left < ALL_RED || (left < ALTERNATING && even) { Hue::Red } else { Hue::White }
}

fn centre_line(lights: &mut Fixtures<'_>, options: &Runway) {
    let length = options.length_m;
    let n = ((length - 2.0 * CENTRE_FIRST) / CENTRE_SPACING) as u32;
    let first = 0.5 * (length - n as f32 * CENTRE_SPACING);
    for i in 0..=n {
        let along = first + i as f32 * CENTRE_SPACING;
        let near =
            towards(End::Near, Kind::CentreLine, centre_hue(length - along, i % 2 == 0), CENTRE_UP, 0.0);
        let far = towards(End::Far, Kind::CentreLine, centre_hue(along, i % 2 == 0), CENTRE_UP, 0.0);
        lights.inset("centre line light", super::at(along, CENTRE_ASIDE, 0.0), &[near, far]);
    }
}

fn touchdown_zone(lights: &mut Fixtures<'_>, options: &Runway) {
    let rows = (TOUCHDOWN_END.min(0.5 * options.length_m) / TOUCHDOWN_SPACING) as u32;
    for row in 1..=rows {
        for k in 0..3 {
            let aside = TOUCHDOWN_INNER + WITHIN_ROW * k as f32;
            for x in [-aside, aside] {
                let beam =
                    towards(End::Near, Kind::Touchdown, Hue::White, TOUCHDOWN_UP, toe(TOUCHDOWN_TOE, x));
                lights.inset(
                    "touchdown zone light",
                    super::at(row as f32 * TOUCHDOWN_SPACING, x, 0.0),
                    &[beam],
                );
            }
        }
    }
}

/// Green lights before each threshold that no approach system has, red ones for the aircraft that rolls out.
fn threshold_and_end(lights: &mut Fixtures<'_>, options: &Runway) {
    let outermost = 0.5 * options.width_m + EDGE_ASIDE;
    for (end, other) in [(End::Near, End::Far), (End::Far, End::Near)] {
        for k in 0..4 {
            let aside = outermost - END_SPACING * k as f32;
            for x in [-aside, aside] {
                let at = |before: f32| end.place(options.length_m, -before, x, 0.0).at;
                let red = towards(other, Kind::End, Hue::Red, END_UP, 0.0);
                lights.spotlight("end light", at(END_BEFORE), red);
                if end == End::Far || options.approach == ApproachLights::None {
                    let beam = towards(end, Kind::Threshold, Hue::Green, THRESHOLD_UP, toe(THRESHOLD_TOE, x));
                    lights.spotlight("threshold light", at(2.0 * END_BEFORE), beam);
                }
            }
        }
    }
}

fn taxiway(lights: &mut Fixtures<'_>, options: &Runway) {
    let lamp = Lamp {
        name: "taxiway edge, blue".to_owned(),
        color: colour::BLUE,
        candela: TAXIWAY_CANDELA * 0.01 * lights.percent,
        cone_deg: None,
        table: None,
        radius_m: SMALL_RADIUS,
        source: "FAA AC 150/5345-46, L-861T",
    };
    let aside = 0.5 * TAXIWAY_WIDTH + TAXIWAY_LIGHT_ASIDE;
    let steps = (options.length_m / TAXIWAY_SPACING).ceil();
    let crossings = connectors(options.length_m);
    for i in 0..=steps as u32 {
        let along = options.length_m * i as f32 / steps;
        // None across the mouths of the ways to the runway.
        let open = crossings.iter().any(|c| (along - c).abs() < aside + 5.0);
        for x in [TAXIWAY_ASIDE - aside, TAXIWAY_ASIDE + aside] {
            if x > TAXIWAY_ASIDE || !open {
                lights.omnidirectional("taxiway light", Vec3::new(x, 0.0, -along), &lamp);
            }
        }
    }
}
