//! What one sees in fog and rain: positions and widths of rainbow and fogbow, glory and corona in a phase function by angle,
//! and what ray optics, Airy's and Fraunhofer's theories say about them.
//!
//! The finders work on any phase function ([`Curve`]), best on one that is averaged over a spread of droplet sizes: the curve
//! of a single sphere is covered with interference of its own.

mod curve;
pub mod theory;

pub use curve::{Curve, Extremum};

/// The primary bow of a phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bow {
    /// Scattering angle of the brightest direction in degrees (180 minus the angular radius of the bow).
    pub peak_deg: f64,
    /// Full width in degrees at half of the height over the darkest direction outside of the bow (Alexander's band).
    pub width_deg: f64,
    /// Brightest over darkest, > 1.
    pub contrast: f64,
}

/// The glory of a phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glory {
    /// The phase function at 180° over its least value between 150° and 180°: above 1 where there is a glory.
    pub rise: f64,
    /// Distance of the first dark ring from 180° in degrees.
    pub dark_ring_deg: f64,
    /// Distance of the first bright ring from 180° in degrees.
    pub bright_ring_deg: f64,
}

/// The corona of a phase function.
#[derive(Clone, Debug, PartialEq)]
pub struct Corona {
    /// Angular radii of the dark rings in degrees, from the inside out; at most three.
    pub dark_rings_deg: Vec<f64>,
    /// Angular radii of the bright rings in degrees, from the inside out; at most three, the aureole at 0° not counted.
    pub bright_rings_deg: Vec<f64>,
}

/// The primary rainbow or fogbow: the brightest local maximum between 130° and 165°. None if there is none.
#[must_use]
pub fn bow(curve: &Curve<'_>) -> Option<Bow> {
    let extrema = curve.extrema(130.0, 165.0);
    let peak = extrema.iter().filter(|e| e.is_maximum).max_by(|a, b| a.value.total_cmp(&b.value))?;
    let dark = curve.least(peak.angle_deg - 25.0, peak.angle_deg)?;
    let level = 0.5 * (peak.value + dark.value);
    let left = curve.crossing(peak.angle_deg, dark.angle_deg, level)?;
    // Where the curve does not fall that far before it rises again, the bow ends at the dark arc beside it; dips on its top
    // are interference.
    let top = 0.5 * (peak.value + level);
    let end = (extrema.iter())
        .find(|e| !e.is_maximum && e.angle_deg > peak.angle_deg && e.value < top)
        .map_or(curve.last_deg(), |e| e.angle_deg);
    let right = curve.crossing(peak.angle_deg, end, level).unwrap_or(end);
    Some(Bow { peak_deg: peak.angle_deg, width_deg: right - left, contrast: peak.value / dark.value })
}

/// The glory: rings around 180°. None if the curve does not reach 180°, or has no ring beyond 150°.
#[must_use]
pub fn glory(curve: &Curve<'_>) -> Option<Glory> {
    if curve.last_deg() < 180.0 - 1e-9 {
        return None;
    }
    let rings = curve.extrema(150.0, 180.0);
    let bright = rings.iter().rev().find(|e| e.is_maximum)?;
    let dark = rings.iter().find(|e| !e.is_maximum && e.angle_deg > bright.angle_deg)?;
    let least = curve.least(150.0, 180.0)?;
    Some(Glory {
        rise: curve.at(180.0) / least.value,
        dark_ring_deg: 180.0 - dark.angle_deg,
        bright_ring_deg: 180.0 - bright.angle_deg,
    })
}

/// The corona: rings within 30° of forward. None if the curve has no dark ring there.
#[must_use]
pub fn corona(curve: &Curve<'_>) -> Option<Corona> {
    let extrema = curve.extrema(0.0, 30.0);
    let rings = |bright: bool| -> Vec<f64> {
        extrema.iter().filter(|e| e.is_maximum == bright).take(3).map(|e| e.angle_deg).collect()
    };
    let out = Corona { dark_rings_deg: rings(false), bright_rings_deg: rings(true) };
    (!out.dark_rings_deg.is_empty()).then_some(out)
}

#[cfg(test)]
mod tests;
