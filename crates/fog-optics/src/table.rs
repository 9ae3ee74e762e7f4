//! The optics table of a fog's droplets, and the bytes that name it in a cache.

use crate::advection::AdvectionModel;
use crate::distribution::DiameterGrid;
use crate::droplets::Spectra;
use crate::error::{OpticsError, check_range};
use crate::polydisperse::{DropletSpectra, average};
use crate::water;
use fog_core::optics_table::OpticsTable;
use fog_core::phase_grid::NODES;

/// Raised whenever the numbers in a table change for the same settings: old caches are then not found.
pub const KERNEL_VERSION: u32 = 2;

/// The axes of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableSettings {
    /// Relative altitudes ζ of the rows, ascending, within [0, 1].
    pub zeta: Vec<f64>,
    /// Wavelengths in nm, ascending, within [`water::WAVELENGTH_RANGE_NM`].
    pub wavelengths_nm: Vec<f64>,
    /// Diameters that the sums run over.
    pub diameters: DiameterGrid,
}

impl TableSettings {
    /// The table of the renderer: ζ = 0, 1/32, … 1; 375, 400, … 800 nm; the model's diameters.
    #[must_use]
    pub fn visible(model: &AdvectionModel) -> Self {
        let zeta = (0..=32).map(|i| f64::from(i) / 32.0).collect();
        Self { zeta, wavelengths_nm: visible_nm(), diameters: *model.diameters() }
    }

    /// As [`TableSettings::visible`], for any spectra: one row if they are the same at every altitude.
    #[must_use]
    pub fn visible_of(spectra: &Spectra) -> Self {
        match spectra {
            Spectra::Advection(model) => Self::visible(model),
            Spectra::Same(distribution) => {
                Self { zeta: vec![0.0], wavelengths_nm: visible_nm(), diameters: *distribution.grid() }
            }
        }
    }

    fn check(&self) -> Result<(), OpticsError> {
        let ascends = |axis: &[f64]| axis.windows(2).all(|w| w[0] < w[1]);
        for (name, axis) in [("zeta", &self.zeta), ("wavelengths_nm", &self.wavelengths_nm)] {
            if axis.is_empty() || !ascends(axis) {
                return Err(OpticsError::Settings(format!("{name} needs ascending values")));
            }
        }
        self.zeta.iter().try_for_each(|&z| check_range("zeta", z, 0.0, 1.0))
    }

    /// Everything that the table of `model` depends on, as bytes to be hashed for the name of its file: kernel version,
    /// number of angles, axes, shape polynomials, and the text of the table of water. The number of droplets is not among
    /// them: cross sections are per droplet.
    #[must_use]
    pub fn fingerprint_bytes(&self, model: &AdvectionModel) -> Vec<u8> {
        let mut fingerprint = self.fingerprint("advection table");
        for coefficients in model.shape_coefficients() {
            fingerprint.numbers(coefficients);
        }
        fingerprint.bytes
    }

    /// As [`TableSettings::fingerprint_bytes`], for any spectra. One that is the same at every altitude is known by its
    /// density at the table's diameters, wherever it came from.
    #[must_use]
    pub fn fingerprint_bytes_of(&self, spectra: &Spectra) -> Vec<u8> {
        match spectra {
            Spectra::Advection(model) => self.fingerprint_bytes(model),
            Spectra::Same(distribution) => {
                let mut fingerprint = self.fingerprint("droplet table");
                let d = &self.diameters;
                let densities: Vec<f64> =
                    (0..d.count()).map(|i| distribution.density_1_um(d.diameter_um(i))).collect();
                fingerprint.numbers(&densities);
                fingerprint.bytes
            }
        }
    }

    fn fingerprint(&self, kind: &str) -> Fingerprint {
        let mut fingerprint = Fingerprint::new(kind);
        fingerprint.numbers(&self.zeta);
        fingerprint.numbers(&self.wavelengths_nm);
        fingerprint.numbers(&self.diameters.bounds_um());
        fingerprint
    }
}

/// Canonical bytes: every part is preceded by its length.
pub(crate) struct Fingerprint {
    pub(crate) bytes: Vec<u8>,
}

impl Fingerprint {
    pub(crate) fn new(kind: &str) -> Self {
        let mut new = Self { bytes: Vec::new() };
        new.text(kind);
        new.numbers(&[f64::from(KERNEL_VERSION), NODES as f64]);
        new.text(water::HALE_QUERRY_1973);
        new
    }

    fn text(&mut self, text: &str) {
        self.bytes.extend((text.len() as u64).to_le_bytes());
        self.bytes.extend(text.as_bytes());
    }

    pub(crate) fn numbers(&mut self, numbers: &[f64]) {
        self.bytes.extend((numbers.len() as u64).to_le_bytes());
        self.bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
    }
}

/// Wavelengths of the renderer's tables in nm.
fn visible_nm() -> Vec<f64> {
    (0..18).map(|i| 375.0 + 25.0 * f64::from(i)).collect()
}

/// Builds the table of an advection model: [`build`] of its spectra.
///
/// # Errors
/// As there.
pub fn build_table(
    model: &AdvectionModel,
    settings: &TableSettings,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<OpticsTable, OpticsError> {
    settings.check()?;
    let density = |zeta: f64, d_um: f64| model.shape(zeta).density_1_um(d_um);
    build_from(settings, density, progress)
}

/// Builds the table of droplet spectra: cross sections, mean cosines and phase functions by relative altitude and
/// wavelength, as [`average`] defines them.
///
/// `progress` is told the share that is done, in (0, 1].
///
/// # Errors
/// If an axis is empty, does not ascend or leaves its range, or a row has no droplets at the table's diameters.
pub fn build(
    spectra: &Spectra,
    settings: &TableSettings,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<OpticsTable, OpticsError> {
    match spectra {
        Spectra::Advection(model) => build_table(model, settings, progress),
        Spectra::Same(distribution) => {
            settings.check()?;
            build_from(settings, |_, d_um| distribution.density_1_um(d_um), progress)
        }
    }
}

fn build_from(
    settings: &TableSettings,
    density_1_um: impl Fn(f64, f64) -> f64,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<OpticsTable, OpticsError> {
    let spectra = DropletSpectra::new(&settings.zeta, &settings.diameters, density_1_um)?;
    Ok(OpticsTable::new(&average(&spectra, &settings.wavelengths_nm, progress)?)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size::SizeDistribution;

    #[test]
    fn fingerprint_changes_with_everything_but_the_number_of_droplets() {
        let model = AdvectionModel::arcata().unwrap();
        let settings = TableSettings::visible(&model);
        let base = settings.fingerprint_bytes(&model);
        assert_eq!(base, settings.clone().fingerprint_bytes(&model));
        let denser = crate::advection::ARCATA.replace("density_scale: 1.0", "density_scale: 3.0");
        assert_eq!(base, settings.fingerprint_bytes(&AdvectionModel::from_yaml(&denser).unwrap()));

        let wider = crate::advection::ARCATA.replace("sigma_L: [0.79]", "sigma_L: [0.80]");
        assert_ne!(base, settings.fingerprint_bytes(&AdvectionModel::from_yaml(&wider).unwrap()));
        let mut other = settings.clone();
        other.zeta.pop();
        assert_ne!(base, other.fingerprint_bytes(&model));
        let mut other = settings.clone();
        other.wavelengths_nm[3] += 1.0;
        assert_ne!(base, other.fingerprint_bytes(&model));
        let mut other = settings;
        other.diameters = DiameterGrid::new(0.5, 60.0, 0.7).unwrap();
        assert_ne!(base, other.fingerprint_bytes(&model));
    }

    #[test]
    fn spectra_that_are_the_same_everywhere_have_a_row_and_a_fingerprint_of_their_own() {
        let spectra = |r, v| Spectra::Same(SizeDistribution::gamma(r, v).unwrap());
        let fingerprint = |s: &Spectra| TableSettings::visible_of(s).fingerprint_bytes_of(s);
        let five = spectra(5.0, 0.1);
        assert_eq!(fingerprint(&five), fingerprint(&five.clone()));
        assert_ne!(fingerprint(&five), fingerprint(&spectra(5.0, 0.101)));
        assert_ne!(fingerprint(&five), fingerprint(&spectra(5.001, 0.1)));
        assert_eq!(TableSettings::visible_of(&five).zeta, [0.0]);
        // A formula and a name that mean the same droplets share a table.
        let c1 = crate::catalogue::named("deirmendjian_cloud_c1").unwrap();
        let radiation = crate::catalogue::named("shettle_fenn_radiation_heavy").unwrap();
        let fingerprints = [c1, radiation].map(|named| fingerprint(&Spectra::Same(named.distribution)));
        assert_eq!(fingerprints[0], fingerprints[1]);

        let model = AdvectionModel::arcata().unwrap();
        let settings = TableSettings::visible(&model);
        let advection = Spectra::Advection(model.clone());
        assert_eq!(TableSettings::visible_of(&advection), settings);
        assert_eq!(fingerprint(&advection), settings.fingerprint_bytes(&model));
    }

    #[test]
    fn bad_axes_are_refused() {
        let model = AdvectionModel::arcata().unwrap();
        let good = TableSettings {
            zeta: vec![0.5],
            wavelengths_nm: vec![550.0],
            diameters: DiameterGrid::new(1.0, 3.0, 0.5).unwrap(),
        };
        let build = |settings: &TableSettings| build_table(&model, settings, &|_| ()).map(|_| ());
        assert_eq!(build(&good), Ok(()));
        for (zeta, nm) in [
            (vec![], vec![550.0]),
            (vec![0.5, 0.2], vec![550.0]),
            (vec![1.5], vec![550.0]),
            (vec![0.5], vec![]),
        ] {
            let bad = TableSettings { zeta, wavelengths_nm: nm, ..good.clone() };
            assert!(build(&bad).is_err(), "{bad:?}");
        }
        let dark = TableSettings { wavelengths_nm: vec![150.0], ..good };
        assert!(build(&dark).unwrap_err().to_string().contains("wavelength_nm is 150"));
    }
}
