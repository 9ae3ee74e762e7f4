//! Synthetic flights: counts that an aircraft would bring home from a fog that is known, to test a fit or plan a campaign.

use super::csv::write_counts;
use super::measurements::{Measurements, Observation, Quantity};
use super::poisson::poisson;
use crate::advection::AdvectionModel;
use crate::error::{OpticsError, check_range};
use crate::fit::bins::{Shape, shares};
use crate::fit::measurements::Bin;
use fog_core::random::{PathRng, mix64};

/// Area in m² that a scattering probe sees: nominal effective sampling area of an FSSP-100ER, 0.300 mm² (EUFAR instrument
/// 247, 2022).
const PROBE_AREA_M2: f64 = 0.300e-6;
/// sin 3°, of the glide slope that the flights of Zak (NASA CR-4585, 1994) came down on.
const SIN_GLIDE_SLOPE: f64 = 0.052_335_956_242_943_83;

/// How synthetic flights are flown.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightSettings {
    /// Fog heights in m.
    pub heights_m: Vec<f64>,
    /// Vertical distance of the altitudes in m; they are the middles of such steps from the layer's base up.
    pub altitude_step_m: f64,
    /// Edges of the diameter bins in µm, ascending.
    pub bin_edges_um: Vec<f64>,
    /// Volume of air in m³ that each approach samples at each altitude.
    pub sample_volume_m3: f64,
    /// Approaches flown through the fog of each height.
    pub approaches: usize,
    /// Seed of the counting noise.
    pub seed: u64,
}

impl FlightSettings {
    /// As in Zak 1994 and the paper: fog of 100, 180 and 260 m, steps of 10 m, 15 bins of 3 µm with middles from 3 to 45 µm
    /// (widest range of an FSSP-100: NCAR EOL, "Bin sizes for original FSSP-100"), two approaches, each of which samples what
    /// the probe's area sweeps on 10 m of a 3° glide slope: 57 cm³.
    #[must_use]
    pub fn arcata() -> Self {
        Self {
            heights_m: vec![100.0, 180.0, 260.0],
            altitude_step_m: 10.0,
            bin_edges_um: (0..=15).map(|i| 1.5 + 3.0 * f64::from(i)).collect(),
            sample_volume_m3: PROBE_AREA_M2 * 10.0 / SIN_GLIDE_SLOPE,
            approaches: 2,
            seed: 1,
        }
    }

    fn check(&self, model: &AdvectionModel) -> Result<(), OpticsError> {
        check_range("number of fog heights", self.heights_m.len() as f64, 1.0, 1000.0)?;
        for height in &self.heights_m {
            model.check_height(*height)?;
        }
        // The lowest altitude, half a step, must lie in every fog.
        let lowest = self.heights_m.iter().copied().fold(f64::INFINITY, f64::min);
        check_range("altitude step in m", self.altitude_step_m, 0.1, 2.0 * lowest)?;
        check_range("sample volume in m³", self.sample_volume_m3, 1e-12, 1000.0)?;
        check_range("number of approaches", self.approaches as f64, 1.0, 1000.0)?;
        check_range("number of bin edges", self.bin_edges_um.len() as f64, 2.0, 1000.0)?;
        let mut below = 0.0;
        for (i, edge) in self.bin_edges_um.iter().enumerate() {
            let least = if i == 0 { 0.0 } else { below };
            check_range("bin edge in µm", *edge, least, 1000.0)?;
            if i > 0 && *edge <= below {
                let valid = format!("above the edge before it, {below}");
                return Err(OpticsError::Range { what: "bin edge in µm", value: *edge, valid });
            }
            below = *edge;
        }
        Ok(())
    }
}

/// Counts of flights through fog of the given model: each a Poisson count whose mean is the sampled volume times the number
/// density times the bin's share of the droplets.
///
/// A count depends on the seed and its place (height, approach, altitude, bin) alone. Rows come by height, approach,
/// altitude and bin.
///
/// # Errors
/// If a setting is outside its range.
pub fn flights(model: &AdvectionModel, settings: &FlightSettings) -> Result<Vec<Observation>, OpticsError> {
    settings.check(model)?;
    let bins: Vec<Bin> = (settings.bin_edges_um.windows(2))
        .map(|w| Bin { low_um: w[0], high_um: w[1], droplets: 0.0, volume_m3: 1.0, line: 0, rows: 1 })
        .collect();
    let volume = settings.sample_volume_m3;
    let mut rows = Vec::new();
    let mut share = Vec::new();
    for &height in &settings.heights_m {
        // Middles of the steps, up to the layer's top.
        let steps = (height / settings.altitude_step_m + 0.5).floor() as u64;
        for (approach, step) in (0..settings.approaches as u64).flat_map(|a| (0..steps).map(move |s| (a, s)))
        {
            let altitude = ((step as f64 + 0.5) * settings.altitude_step_m).min(height);
            let shape: Shape = model.shape(altitude / height).parameters();
            shares(&shape, &bins, &mut share);
            let number = model.number_density_1_m3(altitude / height, height);
            let place = mix64(height.to_bits()) ^ mix64((approach << 32) | step);
            let mut random = PathRng::new(settings.seed, place, 0);
            for (bin, share) in bins.iter().zip(&share) {
                rows.push(Observation {
                    line: rows.len() + 1,
                    fog_height_m: height,
                    altitude_m: altitude,
                    low_um: bin.low_um,
                    high_um: bin.high_um,
                    value: poisson(number * volume * share.value, &mut random),
                    sample_volume_m3: Some(volume),
                });
            }
        }
    }
    Ok(rows)
}

/// [`flights`] as CSV text that [`parse`](super::parse) reads, with a comment that says how they were made.
///
/// # Errors
/// As [`flights`].
pub fn csv(
    model: &AdvectionModel,
    settings: &FlightSettings,
    model_name: &str,
) -> Result<String, OpticsError> {
    let rows = flights(model, settings)?;
    let comment = format!(
        "Synthetic flights: Poisson counts drawn from the fog model {model_name} with seed {}.\n\
         {} approaches per fog height, {:e} m3 of air sampled at each altitude of each approach.",
        settings.seed, settings.approaches, settings.sample_volume_m3
    );
    Ok(write_counts(&rows, &comment))
}

/// [`flights`] as measurements.
///
/// # Errors
/// As [`flights`].
pub fn measurements(model: &AdvectionModel, settings: &FlightSettings) -> Result<Measurements, OpticsError> {
    Measurements::new("synthetic flights", Quantity::Count, &flights(model, settings)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flights_have_the_model_s_means() {
        let model = AdvectionModel::arcata().unwrap();
        let settings =
            FlightSettings { heights_m: vec![100.0], sample_volume_m3: 0.01, ..FlightSettings::arcata() };
        let data = measurements(&model, &settings).unwrap();
        assert_eq!(data.spectra().len(), 10);
        let spectrum = &data.spectra()[4];
        assert_eq!((spectrum.altitude_m, spectrum.bins.len(), spectrum.bins[3].rows), (45.0, 15, 2));
        assert!((spectrum.bins[3].volume_m3 - 0.02).abs() < 1e-15);
        for bin in &spectrum.bins {
            // Simpson's rule over the bin.
            let density = |d: f64| model.density_1_m3_um(d, 0.45, 100.0);
            let middle = 0.5 * (bin.low_um + bin.high_um);
            let quarters =
                4.0 * (density(0.5 * (bin.low_um + middle)) + density(0.5 * (middle + bin.high_um)));
            let mean = (density(bin.low_um) + density(bin.high_um) + quarters + 2.0 * density(middle)) / 12.0;
            let expected = 0.02 * 3.0 * mean;
            let deviation = (bin.droplets - expected).abs() / expected.sqrt();
            assert!(deviation < 5.0 + 0.003 * expected.sqrt(), "{bin:?}: {expected}");
        }
        assert_eq!(flights(&model, &settings).unwrap(), flights(&model, &settings).unwrap());
        let other = FlightSettings { seed: 2, ..settings.clone() };
        assert_ne!(flights(&model, &settings).unwrap(), flights(&model, &other).unwrap());
    }

    #[test]
    fn settings_are_checked() {
        let model = AdvectionModel::arcata().unwrap();
        let good = FlightSettings::arcata();
        for (bad, what) in [
            (FlightSettings { heights_m: vec![], ..good.clone() }, "number of fog heights"),
            (FlightSettings { heights_m: vec![0.0], ..good.clone() }, "height_m"),
            (FlightSettings { altitude_step_m: 0.0, ..good.clone() }, "altitude step"),
            (FlightSettings { altitude_step_m: 201.0, ..good.clone() }, "altitude step"),
            (FlightSettings { sample_volume_m3: -1.0, ..good.clone() }, "sample volume"),
            (FlightSettings { approaches: 0, ..good.clone() }, "approaches"),
            (FlightSettings { bin_edges_um: vec![3.0], ..good.clone() }, "number of bin edges"),
            (FlightSettings { bin_edges_um: vec![3.0, 2.0], ..good.clone() }, "bin edge"),
            (FlightSettings { bin_edges_um: vec![3.0, 3.0], ..good }, "above the edge before it"),
        ] {
            let message = flights(&model, &bad).unwrap_err().to_string();
            assert!(message.contains(what), "{message}");
        }
    }
}
