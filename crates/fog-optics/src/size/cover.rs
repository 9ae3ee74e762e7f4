//! The range of diameters that a continuous spectrum needs.

use super::refused;
use crate::distribution::DiameterGrid;
use crate::error::OpticsError;
use fog_core::math::f64::exp;

/// Least and greatest diameter in µm that is looked at.
const SCAN_UM: [f64; 2] = [1e-3, 5e3];
/// Natural logarithm of the ratio of neighbours that are looked at.
const SCAN_STEP: f64 = 0.004;
/// Share of the droplets that is left out below, and of the water that is left out above.
const TAIL: f64 = 1e-6;
/// Widest step in µm: that of Sec. 5.3 of Kolářová et al. 2024, which resolves most of the ripple of the Mie series.
const STEP_UM: f64 = 0.1;
/// Fewest and most diameters.
const COUNT: [f64; 2] = [300.0, 1000.0];

/// Most of a step over the diameter below which a tenth of the droplets lies.
const STEP_OF_SMALL: f64 = 0.02;

/// A grid from the diameter below which 1e-6 of the droplets lie to that above which 1e-6 of the water lies: equal steps,
/// of 0.1 µm or as much less as the spectrum asks for, where at most 1000 diameters do, 1000 equal ratios otherwise.
pub(super) fn grid(density_1_um: &dyn Fn(f64) -> f64) -> Result<DiameterGrid, OpticsError> {
    let steps = (fog_core::math::f64::ln(SCAN_UM[1] / SCAN_UM[0]) / SCAN_STEP) as usize;
    let d = |i: usize| SCAN_UM[0] * exp(SCAN_STEP * i as f64);
    // In ln d the weights are the diameters.
    let number: Vec<f64> = (0..=steps).map(|i| density_1_um(d(i)) * d(i)).collect();
    let (mut droplets, mut water) = (0.0, 0.0);
    for (i, n) in number.iter().enumerate() {
        droplets += n;
        water += n * d(i).powi(3);
    }
    if !(droplets > 0.0 && droplets.is_finite() && water.is_finite()) {
        return Err(refused("the spectrum has no droplets between 0.001 and 5000 µm".to_owned()));
    }
    let (mut below, mut first) = (0.0, 0);
    while first < steps && below + number[first] < TAIL * droplets {
        below += number[first];
        first += 1;
    }
    let (mut above, mut last) = (0.0, steps);
    while last > first + 1 && above + number[last] * d(last).powi(3) < TAIL * water {
        above += number[last] * d(last).powi(3);
        last -= 1;
    }
    if last == steps {
        return Err(refused("the spectrum reaches beyond 5000 µm".to_owned()));
    }
    let (low, high) = (d(first), d(last));
    let mut sum = 0.0;
    let small = number.iter().take_while(|&n| {
        sum += n;
        sum < 0.1 * droplets
    });
    let step = STEP_UM.min((high - low) / COUNT[0]).min(STEP_OF_SMALL * d(small.count()));
    if (high - low) / step <= COUNT[1] - 1.0 {
        DiameterGrid::covering(low, high, step)
    } else {
        DiameterGrid::geometric(low, high, COUNT[1] as usize)
    }
}
