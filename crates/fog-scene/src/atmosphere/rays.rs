//! Straight rays through the shells of the air.

use super::air::{GROUND_KM, TOP_KM};

/// Bounds between shells, even in the root of the altitude.
pub(super) const SHELLS: usize = 28;
/// Longest piece of a ray in km: half of a degree of the sun's zenith angle.
const LONGEST_KM: f64 = 55.0;
/// Largest optical depth of a piece, about.
const DEEPEST: f64 = 0.3;

/// Altitude of a bound in km.
pub(super) fn shell_km(i: usize) -> f64 {
    let x = i as f64 / (SHELLS - 1) as f64;
    TOP_KM * x * x
}

/// A piece of a ray: the distance of its middle from the ray's start, and its length, both in km.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) middle_km: f64,
    pub(super) length_km: f64,
}

/// Cuts a ray, which starts at an altitude at a cosine of its zenith angle, into pieces. Returns whether it ends on the ground,
/// and then the distance to it.
pub(super) fn cut(altitude_km: f64, cosine: f64, pieces: &mut Vec<Piece>) -> Option<f64> {
    pieces.clear();
    let radius = GROUND_KM + altitude_km;
    let along = radius * cosine;
    let nearest2 = (radius * radius - along * along).max(0.0);
    let half_chord = |i: usize| {
        let r = GROUND_KM + shell_km(i);
        (r * r - nearest2).max(0.0).sqrt()
    };
    let hits = cosine < 0.0 && nearest2 <= GROUND_KM * GROUND_KM;
    let mut from = 0.0;
    let mut advance = |to: f64, lower_km: f64| {
        if to > from {
            subdivide(from, to, lower_km, pieces);
            from = to;
        }
    };
    if cosine < 0.0 {
        // Down to the lowest shell that the ray enters: the ground, or the point nearest to it.
        for i in (0..SHELLS).rev().filter(|&i| shell_km(i) < altitude_km) {
            let r = GROUND_KM + shell_km(i);
            if r * r <= nearest2 {
                break;
            }
            advance(-along - half_chord(i), shell_km(i));
        }
        if hits {
            return Some((-along - half_chord(0)).max(0.0));
        }
        advance(-along, nearest2.sqrt() - GROUND_KM);
    }
    for i in 0..SHELLS {
        let r = GROUND_KM + shell_km(i);
        if r * r > nearest2 && (cosine < 0.0 || shell_km(i) > altitude_km) {
            advance(half_chord(i) - along, shell_km(i.saturating_sub(1)));
        }
    }
    None
}

fn subdivide(from: f64, to: f64, lower_km: f64, pieces: &mut Vec<Piece>) {
    let length = to - from;
    // About the extinction at 450 nm: molecules at 8 km of scale height, aerosol at 1.2 km.
    let extinction = 0.03 / (1.0 + lower_km * lower_km / 16.0) + 0.08 / (1.0 + lower_km * lower_km);
    let parts = (length / LONGEST_KM).max(length * extinction / DEEPEST).ceil().clamp(1.0, 12.0);
    let step = length / parts;
    for k in 0..parts as usize {
        pieces.push(Piece { middle_km: from + (k as f64 + 0.5) * step, length_km: step });
    }
}
