//! Intensities and beams of aeronautical ground lights.
//!
//! Beams: EASA CS-ADR-DSN.U.940, Figures U-5 ff. (2023), which are ICAO Annex 14 Vol. I, App. 2: ellipses of half-axes a × b
//! within which a light has at least half of its intensity, and beyond which it has at most 5 %. glTF's cones are round:
//! they have the ellipses' areas. Intensities are the average ones of the main beam in Annex 14's Figures A2-1 ff. and the
//! share of coloured light in their notes; these were not at hand in print and are given from general knowledge.

use crate::lamp::{Lamp, colour};

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
    /// Name, average intensity of the main beam in cd, half-axes of main beam and outermost curve in degrees.
    fn data(self) -> (&'static str, f32, [f32; 2], [f32; 2]) {
        match self {
            Self::Approach => ("approach", 20_000.0, [10.0, 5.5], [15.0, 8.5]),
            Self::SideRow => ("side row", 5_000.0, [7.0, 5.0], [16.5, 8.0]),
            Self::Threshold => ("threshold", 10_000.0, [5.5, 4.5], [9.0, 8.5]),
            Self::Touchdown => ("touchdown zone", 5_000.0, [5.0, 3.5], [8.5, 8.5]),
            Self::CentreLine => ("centre line", 5_000.0, [5.0, 3.5], [8.5, 8.5]),
            Self::Edge => ("edge", 10_000.0, [5.5, 3.5], [9.0, 8.5]),
            Self::End => ("end", 2_500.0, [6.0, 2.25], [9.0, 6.75]),
            Self::Flasher => ("flasher", 15_000.0, [15.0, 5.0], [20.0, 10.0]),
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

    /// The lamp at `percent` of its full intensity.
    pub(super) fn lamp(self, hue: Hue, percent: f32) -> Lamp {
        let (name, candela, main, outermost) = self.data();
        Lamp {
            name: format!("{name}, {}", hue.name()),
            color: if self == Self::Flasher { colour::WHITE } else { hue.rgb() },
            candela: candela * self.share(hue) * 0.01 * percent,
            cone_deg: Some(cone(main, outermost)),
            source: SOURCE,
        }
    }
}

/// Half-angles of glTF's cone that has half of the intensity on a circle of the main ellipse's area and none outside of the
/// outermost one: its falloff is the square of (outer² − θ²) / (outer² − inner²) at small angles.
fn cone([a, b]: [f32; 2], [c, d]: [f32; 2]) -> [f32; 2] {
    let outer2 = c * d;
    let inner2 = outer2 - (outer2 - a * b) * core::f32::consts::SQRT_2;
    [inner2.max(0.0).sqrt(), outer2.sqrt()]
}
