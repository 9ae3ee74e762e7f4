//! `fogbank optics`: what droplets do to light, by altitude and wavelength.

use super::fog_source::FogSource;
use crate::args::OpticsArgs;
use crate::rows::{self, Cell};
use anyhow::{Result, bail};
use fogbank::optics::lidar::{self, BackscatterKernel};
use fogbank::optics::parcel::{FogOptics, FogParcel};
use std::io::Write;
use std::process::ExitCode;

const COLUMNS: [&str; 15] = [
    "altitude_m",
    "wavelength_nm",
    "q_ext",
    "q_sca",
    "q_back",
    "g",
    "sigma_t_1_m",
    "sigma_s_1_m",
    "albedo",
    "number_density_m3",
    "liquid_water_content_g_m3",
    "mor_m",
    "effective_radius_um",
    "backscatter_1_m_sr",
    "lidar_ratio_sr",
];

pub(crate) fn run(args: &OpticsArgs) -> Result<ExitCode> {
    let mut wavelengths_nm = args.wavelength.clone();
    if let Some(preset) = args.preset.as_deref().and_then(lidar::preset) {
        wavelengths_nm.extend(preset.wavelengths_nm);
    }
    let fogs = fogs(args)?;
    let mut by_wavelength = Vec::new();
    for &nm in &wavelengths_nm {
        by_wavelength.push(all_at(&fogs, nm)?);
    }

    // A row per altitude and wavelength, in this order.
    let mut table = Vec::new();
    for (i, (altitude, fog)) in fogs.iter().enumerate() {
        for (nm, optics) in wavelengths_nm.iter().zip(&by_wavelength) {
            table.push(row(*altitude, *nm, fog.as_ref().zip(optics[i].as_ref())));
        }
    }
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    rows::print_tall(args.form.form(), &COLUMNS, &table, &mut out)?;
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}

/// Altitudes (none where it does not matter) with the fog there; no fog where the model has no droplets.
fn fogs(args: &OpticsArgs) -> Result<Vec<(Option<f64>, Option<FogParcel>)>> {
    let altitudes = &args.fog.altitude;
    match FogSource::new(&args.fog)? {
        FogSource::Advection { model, height_m, mor_m } => {
            if altitudes.is_empty() {
                bail!("--model needs --altitude: the fog depends on it");
            }
            let mut fogs = Vec::new();
            for &altitude in altitudes {
                fogs.push((Some(altitude), FogParcel::advection(&model, height_m, altitude)?));
            }
            if let Some(mor_m) = mor_m {
                let Some(first) = &fogs[0].1 else {
                    bail!("--mor {mor_m}: there is no fog at {} m to be scaled", altitudes[0]);
                };
                let factor = first.factor_for_mor(mor_m)?;
                for (_, fog) in &mut fogs {
                    *fog = fog.as_ref().map(|f| f.scaled(factor)).transpose()?;
                }
            }
            Ok(fogs)
        }
        FogSource::Droplets { fog, .. } => match altitudes[..] {
            [] => Ok(vec![(None, Some(fog))]),
            _ => Ok(altitudes.iter().map(|&a| (Some(a), Some(fog.clone()))).collect()),
        },
        FogSource::Extinction(_) => bail!(
            "--mor or --sigma alone says nothing of the droplets: add --distribution, --number or --lwc"
        ),
    }
}

/// Every fog at one wavelength. Fogs over the same diameters share the sums over spheres.
fn all_at(fogs: &[(Option<f64>, Option<FogParcel>)], nm: f64) -> Result<Vec<Option<FogOptics>>> {
    let Some(first) = fogs.iter().find_map(|(_, fog)| fog.as_ref()) else {
        return Ok(vec![None; fogs.len()]);
    };
    let kernel = BackscatterKernel::new(first.distribution().grid(), nm)?;
    let mut all = Vec::new();
    for (_, fog) in fogs {
        all.push(fog.as_ref().map(|fog| fog.optics_with(&kernel)).transpose()?);
    }
    Ok(all)
}

fn row(altitude_m: Option<f64>, wavelength_nm: f64, fog: Option<(&FogParcel, &FogOptics)>) -> Vec<Cell> {
    let mut row = vec![Cell::from(altitude_m), Cell::from(wavelength_nm)];
    let Some((fog, o)) = fog else {
        // Clear air: no extinction and no droplets; what they would be like is not defined.
        row.extend(COLUMNS[2..].iter().map(|name| match *name {
            "sigma_t_1_m"
            | "sigma_s_1_m"
            | "number_density_m3"
            | "liquid_water_content_g_m3"
            | "backscatter_1_m_sr" => Cell::Number(0.0),
            _ => Cell::Nothing,
        }));
        return row;
    };
    row.extend(
        [
            o.q_ext,
            o.q_sca,
            o.q_back,
            o.g,
            o.sigma_t_1_m,
            o.sigma_s_1_m,
            o.albedo,
            fog.number_density_1_m3(),
            fog.liquid_water_content_g_m3(),
            fog.mor_m(),
            fog.moments().effective_radius_um,
            o.backscatter_1_m_sr,
            o.lidar_ratio_sr,
        ]
        .map(Cell::from),
    );
    row
}
