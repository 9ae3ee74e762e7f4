//! The numbers of a fog by itself, at any altitude and wavelength: for those who compute rather than render.

use crate::error::Error;
use crate::fog::Fog;
use crate::progress::Silent;
use crate::resources::Resources;
use crate::table_cache::TableCache;
use fog_core::optics_table::MAX_COLUMNS;
use fog_core::spectrum::Wavelengths;
use fog_optics::error::OpticsError;
use fog_optics::state::FogState;
use fog_optics::visibility::{Law, Sight};
use fog_optics::water;
use fog_plan::{FogSpec, Sampling};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Altitudes in m over the datum that may be asked for.
const ALTITUDE_RANGE_M: [f64; 2] = [-1e5, 1e5];
/// Wavelengths in nm of the renderer's tables: within them a fog is the one that is rendered, linear between the table's columns.
const RENDERED_NM: [f64; 2] = [375.0, 800.0];

/// A fog and its optics. Altitudes are in metres over the fog's datum, wavelengths in nm, 200 to 2600; lists of arguments must be
/// of one length, and that is the length of the answer. Of patchy fog the numbers are those of the mean layer.
///
/// From 375 to 800 nm they are what the renderer has. Beyond, the Mie sums are done for the very wavelengths that are asked for,
/// once each (some hundredths of a second); the water's index ends at 200 and 2600 nm.
#[derive(Debug)]
pub struct FogNumbers {
    spec: FogSpec,
    resources: Resources,
    /// As it is rendered; none in clear air.
    rendered: Option<Fog>,
    /// By the bits of wavelengths beyond those of the renderer.
    beyond: Mutex<BTreeMap<u64, Arc<Fog>>>,
}

impl FogNumbers {
    /// Reads the fog's files and opens its tables in `cache`. `sampling: diameter` makes no difference here: all droplets together
    /// scatter the same light.
    ///
    /// # Errors
    /// As [`Fog::new`].
    pub fn new(spec: &FogSpec, cache: TableCache) -> Result<Self, Error> {
        let spec = FogSpec { sampling: Sampling::Table, ..spec.clone() };
        let mut resources = Resources::new(cache);
        resources.prepare_fog(&spec, &Silent);
        let rendered = Fog::new(&spec, &resources)?;
        Ok(Self { spec, resources, rendered, beyond: Mutex::default() })
    }

    /// Altitudes of the layer's base and top in metres; none in clear air.
    #[must_use]
    pub fn extent_m(&self) -> Option<[f64; 2]> {
        self.rendered.as_ref().map(Fog::extent_m)
    }

    /// What the fog is at an altitude, at 550 nm ([`Fog::state`]); nothing in clear air.
    ///
    /// # Errors
    /// If the altitude is no number.
    pub fn state(&self, altitude_m: f64) -> Result<FogState, Error> {
        check("altitude_m", &[altitude_m], ALTITUDE_RANGE_M)?;
        self.rendered.as_ref().map_or_else(|| Ok(FogState::default()), |fog| fog.state(altitude_m))
    }

    /// Extinction coefficients in 1/m; 0 outside of the layer.
    ///
    /// # Errors
    /// If an altitude or a wavelength is out of range.
    pub fn sigma_t_1_m(&self, altitude_m: &[f64], wavelength_nm: &[f64]) -> Result<Vec<f64>, Error> {
        self.by_point(altitude_m, wavelength_nm, 0.0, |fog, i| {
            let profile = fog.medium.profile();
            Ok(profile.sigma_t_at(profile.datum_m() + altitude_m[i], wavelength_nm[i]))
        })
    }

    /// Single-scattering albedos, in single precision as they are traced; NaN outside of the layer.
    ///
    /// # Errors
    /// If an altitude or a wavelength is out of range.
    pub fn albedo(&self, altitude_m: &[f64], wavelength_nm: &[f64]) -> Result<Vec<f64>, Error> {
        self.by_point(altitude_m, wavelength_nm, f64::NAN, |fog, i| {
            let profile = fog.medium.profile();
            let lanes = profile.lanes(&Wavelengths::monochromatic(wavelength_nm[i] as f32));
            Ok(f64::from(profile.albedo(profile.datum_m() + altitude_m[i], &lanes)[0]))
        })
    }

    /// Phase functions in 1/sr for cosines of the angle between the directions of travel before and after, in single precision
    /// as they are traced; NaN outside of the layer. Over the sphere they integrate to 1.
    ///
    /// # Errors
    /// If an altitude, a wavelength or a cosine is out of range.
    pub fn phase_1_sr(
        &self,
        altitude_m: &[f64],
        wavelength_nm: &[f64],
        cosine: &[f64],
    ) -> Result<Vec<f64>, Error> {
        check("cos_theta", cosine, [-1.0, 1.0])?;
        self.by_point(altitude_m, wavelength_nm, f64::NAN, |fog, i| {
            let (profile, phase) = (fog.medium.profile(), fog.medium.phase());
            let lanes = phase.lanes(&Wavelengths::monochromatic(wavelength_nm[i] as f32));
            let rows = phase.rows(profile.zeta(profile.datum_m() + altitude_m[i]));
            Ok(f64::from(phase.eval_between(rows, (1.0 - cosine[i]) as f32, &lanes)[0]))
        })
    }

    /// Visual ranges in metres by a law each, along elevation angles in degrees (−90 straight down, 90 straight up; exact depths),
    /// or without them horizontally. +inf where nothing limits them. The ground does not end them.
    ///
    /// # Errors
    /// If an altitude, a wavelength, an angle or a number of a law is out of range.
    pub fn visibility_m(
        &self,
        altitude_m: &[f64],
        wavelength_nm: &[f64],
        laws: &[Law],
        elevation_deg: Option<&[f64]>,
    ) -> Result<Vec<f64>, Error> {
        let mut sights = BTreeMap::new();
        self.check(altitude_m, wavelength_nm)?;
        (0..altitude_m.len())
            .map(|i| {
                let Some(fog) = self.at(wavelength_nm[i])? else { return Ok(laws[i].range_m(0.0)) };
                let sight = match sights.entry(wavelength_nm[i].to_bits()) {
                    std::collections::btree_map::Entry::Occupied(found) => found.into_mut(),
                    std::collections::btree_map::Entry::Vacant(place) => {
                        place.insert(Sight::at(fog.layer(), wavelength_nm[i])?)
                    }
                };
                Ok(match elevation_deg {
                    Some(angles) => sight.along_m(&laws[i], altitude_m[i], angles[i])?,
                    None => sight.horizontal_m(&laws[i], altitude_m[i])?,
                })
            })
            .collect()
    }

    /// `value` of the fog at each point's wavelength, or `outside` where there is none.
    fn by_point(
        &self,
        altitude_m: &[f64],
        wavelength_nm: &[f64],
        outside: f64,
        value: impl Fn(&Fog, usize) -> Result<f64, Error>,
    ) -> Result<Vec<f64>, Error> {
        self.check(altitude_m, wavelength_nm)?;
        let [base, top] = self.extent_m().unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
        // Most lists have runs of one wavelength.
        let mut last: Option<(u64, Found<'_>)> = None;
        let mut values = Vec::with_capacity(altitude_m.len());
        for (i, (altitude, nm)) in altitude_m.iter().zip(wavelength_nm).enumerate() {
            if !(base..=top).contains(altitude) {
                values.push(outside);
                continue;
            }
            if last.as_ref().is_none_or(|(bits, _)| *bits != nm.to_bits()) {
                last = self.at(*nm)?.map(|fog| (nm.to_bits(), fog));
            }
            values.push(last.as_ref().map_or(Ok(outside), |(_, fog)| value(fog, i))?);
        }
        Ok(values)
    }

    /// Whether the sums for these wavelengths are done ([`FogNumbers::prepare`]), or not needed.
    #[must_use]
    pub fn is_ready(&self, wavelength_nm: &[f64]) -> bool {
        let beyond = self.beyond.lock().unwrap_or_else(PoisonError::into_inner);
        let ready = |nm: &f64| !is_beyond(*nm) || beyond.contains_key(&nm.to_bits());
        self.rendered.is_none() || wavelength_nm.iter().all(ready)
    }

    /// Does the sums for wavelengths that are new, on the current rayon pool; the other functions do so too.
    ///
    /// # Errors
    /// If a wavelength is out of range.
    pub fn prepare(&self, wavelength_nm: &[f64]) -> Result<(), Error> {
        check("wavelength_nm", wavelength_nm, water::WAVELENGTH_RANGE_NM)?;
        let Some(fog) = &self.rendered else { return Ok(()) };
        let mut beyond = self.beyond.lock().unwrap_or_else(PoisonError::into_inner);
        let mut wanted: Vec<f64> = wavelength_nm.iter().copied().filter(|&nm| is_beyond(nm)).collect();
        wanted.sort_by(f64::total_cmp);
        wanted.dedup();
        wanted.retain(|nm| !beyond.contains_key(&nm.to_bits()));
        for some in wanted.chunks(MAX_COLUMNS) {
            let fog = Arc::new(fog.at_wavelengths(&self.spec, &self.resources, some)?);
            beyond.extend(some.iter().map(|nm| (nm.to_bits(), Arc::clone(&fog))));
        }
        Ok(())
    }

    fn check(&self, altitude_m: &[f64], wavelength_nm: &[f64]) -> Result<(), Error> {
        check("altitude_m", altitude_m, ALTITUDE_RANGE_M)?;
        self.prepare(wavelength_nm)
    }

    /// The fog at a wavelength that was checked; none in clear air.
    fn at(&self, nm: f64) -> Result<Option<Found<'_>>, Error> {
        if !is_beyond(nm) {
            return Ok(self.rendered.as_ref().map(Found::Rendered));
        }
        let beyond = self.beyond.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(beyond.get(&nm.to_bits()).cloned().map(Found::Beyond))
    }
}

/// A fog, where it is kept.
enum Found<'a> {
    Rendered(&'a Fog),
    Beyond(Arc<Fog>),
}

impl std::ops::Deref for Found<'_> {
    type Target = Fog;

    fn deref(&self) -> &Fog {
        match self {
            Self::Rendered(fog) => fog,
            Self::Beyond(fog) => fog,
        }
    }
}

fn is_beyond(nm: f64) -> bool {
    !(RENDERED_NM[0]..=RENDERED_NM[1]).contains(&nm)
}

fn check(what: &'static str, values: &[f64], [low, high]: [f64; 2]) -> Result<(), Error> {
    match values.iter().find(|value| !(low..=high).contains(*value)) {
        None => Ok(()),
        Some(&value) => Err(OpticsError::Range { what, value, valid: format!("{low} to {high}") }.into()),
    }
}
