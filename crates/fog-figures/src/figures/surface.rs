//! Droplet spectra over altitude as a surface, for the figures that show one.

use super::{CM3, steps};
use crate::chart::{Axis, Ridges};
use crate::sheet::Sheet;

/// Curves of a surface, from base to top.
pub(crate) const CURVES: usize = 31;
/// Points of a curve.
const POINTS: usize = 159;
/// Columns of the rows that a surface adds to a CSV.
pub(crate) const COLUMNS: [&str; 4] = ["fog", "altitude_m", "diameter_um", "density_1_m3_um"];

/// What the surface shows.
pub(crate) struct Surface<'a> {
    pub(crate) heading: &'a str,
    /// Name of the fog in the CSV.
    pub(crate) fog: &'a str,
    pub(crate) height_m: f64,
    /// Greatest diameter that is drawn, in µm.
    pub(crate) last_um: f64,
    /// Droplets in m⁻³ µm⁻¹ for a diameter in µm and an altitude in m.
    pub(crate) density: &'a dyn Fn(f64, f64) -> f64,
}

impl Surface<'_> {
    pub(crate) fn ridges(&self, sheet: &mut Sheet) -> Ridges {
        let (mut profiles, mut all) = (Vec::new(), Vec::new());
        for altitude in steps(0.0, self.height_m, CURVES) {
            let mut points = Vec::new();
            for d in steps(0.5, self.last_um, POINTS) {
                let n = (self.density)(d, altitude);
                sheet.named_row(&[self.fog], &[altitude, d, n]);
                points.push([d, n * CM3]);
                all.push(n * CM3);
            }
            profiles.push((altitude, points));
        }
        Ridges {
            heading: self.heading.to_owned(),
            x: Axis::linear("Droplet diameter (µm)", 0.0, self.last_um),
            y: Axis::linear("Altitude (m)", 0.0, self.height_m),
            z: Axis::from_zero("Droplets (cm⁻³ µm⁻¹)", all),
            profiles,
        }
    }
}
