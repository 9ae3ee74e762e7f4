//! Intensities and beams of aeronautical ground lights.
//!
//! EASA CS-ADR-DSN.U.940, Figures U-5 ff. (2017 and 2023), which are ICAO Annex 14 Vol. I, App. 2, Figures A2-1 ff., draw a
//! beam as three ellipses around its axis, azimuth by elevation: the edge of the main beam, within which every intensity is at
//! least half of the average one, and the curves of a tenth and of a twentieth of it. Here the main beam is a paraboloid from 1.5
//! times the average on the axis to its half on the edge, which has that average and the greatest ratio, 3, that the figures'
//! notes allow; from the edge to the next curve the intensity falls exponentially, then evenly, and is 0 as far again beyond
//! the last curve as that is from the one before. The half-axes of Figures U-5 to U-7 and U-9 were at hand; those of centre
//! line, edge and end, the average intensities and the share of coloured light are given from general knowledge of Annex 14.

use crate::lamp::{Lamp, Table, colour};
use fog_core::math;

/// Kind of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Centre line and crossbars of the approach (Fig. U-5).
    Approach,
    /// Red side rows of the approach (Fig. U-6).
    SideRow,
    /// Green threshold lights (Fig. U-7).
    Threshold,
    /// White lights of the touchdown zone (Fig. U-9).
    Touchdown,
    /// Runway centre line at spacings of 15 m.
    CentreLine,
    /// Runway edge.
    Edge,
    /// Red lights of the runway's end.
    End,
    /// Sequenced flashers.
    Flasher,
}

/// Colour of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hue {
    White,
    Red,
    Green,
    Yellow,
}

impl Hue {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::White => "white",
            Self::Red => "red",
            Self::Green => "green",
            Self::Yellow => "yellow",
        }
    }

    pub(super) fn rgb(self) -> [f32; 3] {
        match self {
            Self::White => colour::HALOGEN,
            Self::Red => colour::RED,
            Self::Green => colour::GREEN,
            Self::Yellow => colour::YELLOW,
        }
    }
}

const SOURCE: &str = "ICAO Annex 14 App. 2; EASA CS-ADR-DSN.U.940";

impl Kind {
    /// Name, average intensity of the main beam in cd, half-axes of the three curves in degrees, aside and up.
    fn data(self) -> (&'static str, f32, [[f32; 2]; 3]) {
        match self {
            Self::Approach => ("approach", 20_000.0, [[10.0, 5.5], [14.0, 6.5], [15.0, 8.5]]),
            Self::SideRow => ("side row", 5_000.0, [[7.0, 5.0], [11.5, 6.0], [16.5, 8.0]]),
            Self::Threshold => ("threshold", 10_000.0, [[5.5, 4.5], [7.5, 6.0], [9.0, 8.5]]),
            Self::Touchdown => ("touchdown zone", 5_000.0, [[5.0, 3.5], [7.0, 6.0], [8.5, 8.5]]),
            Self::CentreLine => ("centre line", 5_000.0, [[5.0, 3.5], [7.0, 6.0], [8.5, 8.5]]),
            Self::Edge => ("edge", 10_000.0, [[5.5, 3.5], [7.5, 6.0], [9.0, 8.5]]),
            Self::End => ("end", 2_500.0, [[6.0, 2.25], [7.5, 5.0], [9.0, 6.75]]),
            Self::Flasher => ("flasher", 15_000.0, [[15.0, 5.0], [17.5, 7.5], [20.0, 10.0]]),
        }
    }

    /// Share of the white intensity that a colour has; lights of one colour alone have their own figure.
    fn share(self, hue: Hue) -> f32 {
        match (self, hue) {
            (Self::CentreLine | Self::Edge, Hue::Red) => 0.15,
            (Self::Edge, Hue::Yellow) => 0.4,
            _ => 1.0,
        }
    }

    /// The lamp at `percent` of its full intensity, behind a lens of this radius.
    pub(super) fn lamp(self, hue: Hue, percent: f32, radius_m: f32) -> Lamp {
        let (name, average, curves) = self.data();
        let candela = average * self.share(hue) * 0.01 * percent;
        Lamp {
            name: format!("{name}, {}", hue.name()),
            color: if self == Self::Flasher { colour::WHITE } else { hue.rgb() },
            candela,
            cone_deg: Some(cone(curves)),
            table: Some(table(curves, candela)),
            radius_m,
            source: SOURCE,
        }
    }
}

/// Steps of the tables in degrees.
const STEP_DEG: f32 = 0.5;

/// The beam with an average intensity of its main part.
fn table(curves: [[f32; 2]; 3], average: f32) -> Table {
    let [a, b] = vanishes(curves);
    let steps = |end: f32| (end / STEP_DEG).ceil() as i32;
    let up = (-steps(b)..=steps(b)).map(|k| STEP_DEG * k as f32).collect();
    let aside = (0..=steps(a)).map(|k| STEP_DEG * k as f32).chain([180.0]).collect();
    Table::new(up, aside, |aside, up| average * share(curves, aside, up))
}

/// Half-axes of the ellipse beyond which there is no light.
fn vanishes(curves: [[f32; 2]; 3]) -> [f32; 2] {
    [0, 1].map(|k| 2.0 * curves[2][k] - curves[1][k])
}

/// Intensity over the average one.
fn share(curves: [[f32; 2]; 3], aside: f32, up: f32) -> f32 {
    // Where the direction lies between the axis, 0, and an ellipse, 1.
    let along = |[a, b]: [f32; 2]| ((aside / a).powi(2) + (up / b).powi(2)).sqrt();
    let inner = along(curves[0]);
    if inner <= 1.0 {
        return 1.5 - inner * inner;
    }
    let rings = [curves[0], curves[1], curves[2], vanishes(curves)].map(along);
    // Between two ellipses along a line from the axis: 0 on the inner one, 1 on the outer one.
    let between = |k: usize| (1.0 - 1.0 / rings[k]) / (1.0 / rings[k + 1] - 1.0 / rings[k]);
    if rings[1] <= 1.0 {
        0.5 * math::f32::exp(between(0) * math::f32::ln(0.2))
    } else if rings[2] <= 1.0 {
        0.1 - 0.05 * between(1)
    } else {
        (0.05 * (1.0 - between(2))).max(0.0)
    }
}

/// Half-angles of the nearest of glTF's round cones, for programs that read no tables: half of the axial intensity on a circle of
/// the main ellipse's area, none outside of the outermost one. Its falloff is the square of (outer² − θ²) / (outer² − inner²) at
/// small angles.
fn cone([[a, b], _, [c, d]]: [[f32; 2]; 3]) -> [f32; 2] {
    let outer2 = c * d;
    let inner2 = outer2 - (outer2 - a * b) * core::f32::consts::SQRT_2;
    [inner2.max(0.0).sqrt(), outer2.sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beams_pass_through_their_curves() {
        for kind in [Kind::Approach, Kind::SideRow, Kind::End, Kind::Edge, Kind::Flasher] {
            let (_, _, curves) = kind.data();
            assert_eq!(share(curves, 0.0, 0.0), 1.5);
            for (curve, want) in curves.into_iter().chain([vanishes(curves)]).zip([0.5, 0.1, 0.05, 0.0]) {
                for (s, c) in [(0.0, 1.0), (1.0, 0.0), (0.6, 0.8), (-0.8, 0.6)] {
                    let got = share(curves, c * curve[0], s * curve[1]);
                    assert!((got - want).abs() < 1e-4, "{kind:?} {curve:?}: {got} for {want}");
                }
            }
            // The average over the main beam, on a grid of tenths of a degree.
            let [a, b] = curves[0];
            let grid = (-200..=200).flat_map(|i| (-120..=120).map(move |j| (0.1 * i as f32, 0.1 * j as f32)));
            let inside: Vec<f32> = grid
                .filter(|&(x, y)| (x / a).powi(2) + (y / b).powi(2) <= 1.0)
                .map(|(x, y)| share(curves, x, y))
                .collect();
            let average = inside.iter().sum::<f32>() / inside.len() as f32;
            assert!((average - 1.0).abs() < 0.01, "{kind:?}: {average}");
        }
    }
}
