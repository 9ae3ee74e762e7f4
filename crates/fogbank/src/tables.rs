//! Optics tables of droplets: each opened once, shared by all fogs of the same droplets.

use crate::error::Error;
use crate::progress::{Event, Progress};
use crate::sources::{DropletSource, found};
use crate::table_cache::TableCache;
use fog_core::diameter_choice::DiameterChoice;
use fog_core::droplet_table::DropletTable;
use fog_core::optics_table::OpticsTable;
use fog_optics::droplet_table;
use fog_optics::droplets::Spectra;
use fog_optics::mean_diameter::{self, diameter_table};
use fog_optics::table::{self, TableSettings};
use std::collections::HashMap;
use std::time::Instant;

/// Tables by fingerprint. One that cannot be made is remembered with its reason.
#[derive(Debug)]
pub(crate) struct Tables {
    cache: TableCache,
    /// Of all droplets together, by [`DropletSource::fingerprint`].
    mixtures: HashMap<blake3::Hash, Result<OpticsTable, String>>,
    /// Of one droplet with the mean diameter, by the bits of that.
    mean_droplets: HashMap<u64, Result<OpticsTable, String>>,
    /// Of each droplet by itself, by the fingerprint of the diameters.
    each_droplet: HashMap<blake3::Hash, DropletTable>,
    /// These with their odds, by [`DropletSource::fingerprint`].
    singles: HashMap<blake3::Hash, Result<(DropletTable, DiameterChoice), String>>,
}

impl Tables {
    pub(crate) fn new(cache: TableCache) -> Self {
        Self {
            cache,
            mixtures: HashMap::new(),
            mean_droplets: HashMap::new(),
            each_droplet: HashMap::new(),
            singles: HashMap::new(),
        }
    }

    /// Makes the table of all droplets together, if it is not there.
    pub(crate) fn prepare_mixture(&mut self, droplets: &DropletSource, progress: &dyn Progress) {
        if !self.mixtures.contains_key(&droplets.fingerprint) {
            let table = self.open_mixture(droplets, progress).map_err(|e| e.to_string());
            self.mixtures.insert(droplets.fingerprint, table);
        }
    }

    /// Makes the table of the mean droplet, if it is not there.
    pub(crate) fn prepare_mean_droplet(&mut self, droplets: &DropletSource) {
        let d_um = droplets.mean_diameter_um;
        let make = || diameter_table(d_um, mean_diameter::WAVELENGTH_NM).map_err(|e| e.to_string());
        self.mean_droplets.entry(d_um.to_bits()).or_insert_with(make);
    }

    /// Makes the tables of single droplets and their odds, if they are not there.
    pub(crate) fn prepare_single(&mut self, droplets: &DropletSource, progress: &dyn Progress) {
        if !self.singles.contains_key(&droplets.fingerprint) {
            let single = self.open_single(droplets, progress).map_err(|e| e.to_string());
            self.singles.insert(droplets.fingerprint, single);
        }
    }

    /// The table of all droplets together.
    ///
    /// # Errors
    /// Why it could not be made.
    pub(crate) fn mixture(&self, droplets: &DropletSource) -> Result<&OpticsTable, Error> {
        found(self.mixtures.get(&droplets.fingerprint), "optics table")
    }

    /// The table of the mean droplet.
    ///
    /// # Errors
    /// Why it could not be made.
    pub(crate) fn mean_droplet(&self, droplets: &DropletSource) -> Result<&OpticsTable, Error> {
        found(self.mean_droplets.get(&droplets.mean_diameter_um.to_bits()), "phase table")
    }

    /// Single droplets, and their odds.
    ///
    /// # Errors
    /// Why they could not be made.
    pub(crate) fn single(&self, droplets: &DropletSource) -> Result<&(DropletTable, DiameterChoice), Error> {
        found(self.singles.get(&droplets.fingerprint), "droplet table")
    }

    fn open_mixture(&self, droplets: &DropletSource, progress: &dyn Progress) -> Result<OpticsTable, Error> {
        let spectra = &droplets.spectra;
        let settings = TableSettings::visible_of(spectra);
        let file = match spectra {
            Spectra::Advection(_) => "polydisperse",
            Spectra::Same(_) => "droplets",
        };
        let started = Instant::now();
        let (table, origin) = self.cache.open(file, &settings.fingerprint_bytes_of(spectra), || {
            let report = |fraction| {
                progress.event(Event::TableProgress(fraction));
            };
            Ok(table::build(spectra, &settings, &report)?)
        })?;
        let seconds = started.elapsed().as_secs_f64();
        progress.event(Event::Table { name: &droplets.name, origin: &origin, seconds });
        Ok(table)
    }

    /// Single droplets at the renderer's wavelengths, and their odds at its altitudes.
    fn open_single(
        &mut self,
        droplets: &DropletSource,
        progress: &dyn Progress,
    ) -> Result<(DropletTable, DiameterChoice), Error> {
        let spectra = &droplets.spectra;
        let TableSettings { zeta, wavelengths_nm, diameters } = TableSettings::visible_of(spectra);
        let fingerprint = droplet_table::fingerprint_bytes(&diameters, &wavelengths_nm);
        let key = blake3::hash(&fingerprint);
        let table = match self.each_droplet.get(&key) {
            Some(table) => table.clone(),
            None => {
                let started = Instant::now();
                let (table, origin) = self.cache.open("single", &fingerprint, || {
                    let report = |fraction| {
                        progress.event(Event::TableProgress(fraction));
                    };
                    Ok(droplet_table::build(&diameters, &wavelengths_nm, &report)?)
                })?;
                let seconds = started.elapsed().as_secs_f64();
                progress.event(Event::Table { name: "single droplets", origin: &origin, seconds });
                self.each_droplet.insert(key, table.clone());
                table
            }
        };
        let choice = droplet_table::choice(&table, &diameters, &zeta, spectra)?;
        Ok((table, choice))
    }
}
