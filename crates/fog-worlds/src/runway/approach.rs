//! Approach lights: FAA JO 6850.2B (2010) and UFC 3-535-01 (2005), Sec. 3-1 and 3-2.
//!
//! Not verified against the order's figures: the number and spacing of the threshold lights, the bars of the MALSR.

use super::beams::{Hue, Kind};
use super::fixtures::Fixtures;
use super::lights::{EDGE_ASIDE, towards};
use super::{ApproachLights, End, FT, Runway, at};

/// Distance between stations.
const STATION: f32 = 100.0 * FT;
/// Spacing in a bar of five, in crossbars and side rows.
const IN_BAR: f32 = 40.5 / 12.0 * FT;
const IN_ROW: f32 = 5.0 * FT;
/// Innermost light of the side rows, outermost light of the 1000-ft bar.
const SIDE_ROW: f32 = 36.0 * FT;
const CROSSBAR: f32 = 50.0 * FT;
/// The threshold bar of the ALSF-2: how far it goes beyond the runway's edges.
const WING: f32 = 45.0 * FT;
/// Where threshold lights stand before the threshold.
const BEFORE: f32 = 4.0 * FT;
const THRESHOLD_UP: f32 = 4.5;
const SIDE_ROW_TOE: f32 = 2.0;

/// Elevation of the axis of a white light by its distance from the threshold: the middle of the vertical coverage (Fig. U-5).
fn white_up(distance: f32) -> f32 {
    match distance {
        d if d < 315.5 => 5.5,
        d if d < 475.5 => 6.0,
        d if d < 640.5 => 7.0,
        _ => 8.0,
    }
}

/// The same of the red side rows (Fig. U-6).
fn red_up(distance: f32) -> f32 {
    match distance {
        d if d < 115.5 => 5.5,
        d if d < 215.5 => 6.0,
        _ => 6.5,
    }
}

pub(super) fn approach_lights(lights: &mut Fixtures<'_>, options: &Runway) {
    match options.approach {
        ApproachLights::None => {}
        ApproachLights::Alsf2 => alsf2(lights, options),
        ApproachLights::Malsr => malsr(lights, options),
    }
}

/// White lights at a station, by distance from the centre line.
fn white(lights: &mut Fixtures<'_>, station: u32, asides: impl Iterator<Item = f32>) {
    let distance = station as f32 * STATION;
    let beam = towards(End::Near, Kind::Approach, Hue::White, white_up(distance), 0.0);
    for x in asides {
        lights.spotlight("approach light", at(-distance, x, 0.0), beam);
    }
}

/// Both sides of a row that begins at `inner`.
fn row(inner: f32, n: u32) -> impl Iterator<Item = f32> {
    (0..n).map(move |k| inner + IN_ROW * k as f32).flat_map(|x| [-x, x])
}

fn bar_of_five() -> impl Iterator<Item = f32> {
    (-2..=2).map(|k| IN_BAR * k as f32)
}

fn green(lights: &mut Fixtures<'_>, asides: impl Iterator<Item = f32>) {
    for x in asides {
        let beam = towards(End::Near, Kind::Threshold, Hue::Green, THRESHOLD_UP, 0.0);
        lights.spotlight("threshold light", at(-BEFORE, x, 0.0), beam);
    }
}

fn flashers(lights: &mut Fixtures<'_>, options: &Runway, stations: impl Iterator<Item = u32>) {
    if !options.flashers {
        return;
    }
    for station in stations {
        let distance = station as f32 * STATION;
        let beam = towards(End::Near, Kind::Flasher, Hue::White, white_up(distance), 0.0);
        // Before and below the steady lights.
        lights.spotlight("flasher", at(-distance - 1.5, 0.0, 0.0), beam);
    }
}

fn alsf2(lights: &mut Fixtures<'_>, options: &Runway) {
    for station in 1..=24 {
        white(lights, station, bar_of_five());
    }
    // Eight lights a side, the outermost 50 ft from the centre line.
    white(lights, 10, row(CROSSBAR - 7.0 * IN_ROW, 8));
    // Four lights a side, centred between the bar of five and the side rows.
    let middle = 0.5 * (2.0 * IN_BAR + SIDE_ROW);
    white(lights, 5, row(middle - 1.5 * IN_ROW, 4));
    for station in 1..=9 {
        let distance = station as f32 * STATION;
        for x in row(SIDE_ROW, 3) {
            let toe = if x > 0.0 { SIDE_ROW_TOE } else { -SIDE_ROW_TOE };
            let beam = towards(End::Near, Kind::SideRow, Hue::Red, red_up(distance), toe);
            lights.spotlight("side row light", at(-distance, x, 0.0), beam);
        }
    }
    let n = ((0.5 * options.width_m + WING) / IN_ROW) as i32;
    green(lights, (-n..=n).map(|k| IN_ROW * k as f32));
    flashers(lights, options, 10..=24);
}

fn malsr(lights: &mut Fixtures<'_>, options: &Runway) {
    for station in (2..=14).step_by(2) {
        white(lights, station, bar_of_five());
    }
    // A bar of five on each side, 66 ft from end to end.
    white(lights, 10, (0..5).map(|k| 33.0 * FT - IN_BAR * k as f32).flat_map(|x| [-x, x]));
    let outermost = 0.5 * options.width_m + EDGE_ASIDE;
    green(lights, (0..18).map(|k| outermost * (2.0 * k as f32 / 17.0 - 1.0)));
    flashers(lights, options, (16..=24).step_by(2));
}
