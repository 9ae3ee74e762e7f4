//! What is one number each: objects, droplets, a path.

use super::section::Section;
use anyhow::Result;
use fogbank::optics::parcel::FogParcel;
use fogbank::optics::visibility::slant::path_length_m;
use fogbank::optics::visibility::{Law, Sight, parametrised, transmittance};

pub(super) fn objects(sight: &Sight, altitude_m: f64) -> Result<Section> {
    let title = format!("Objects at {altitude_m} m (Koschmieder)");
    Ok(Section::facts(
        title,
        vec![
            ("altitude_m", "altitude/m", altitude_m.into()),
            ("sigma_t_1_m", "extinction coefficient at 550 nm/(1/m)", sight.sigma_t(altitude_m).into()),
            ("mor_m", "MOR, 5 % contrast (WMO-No. 8)/m", sight.horizontal_m(&Law::Mor, altitude_m)?.into()),
            (
                "koschmieder_m",
                "visual range, 2 % contrast/m",
                sight.horizontal_m(&Law::Koschmieder, altitude_m)?.into(),
            ),
        ],
    ))
}

pub(super) fn water(fog: &FogParcel) -> Section {
    let m = fog.moments();
    Section::facts(
        "Droplets".to_owned(),
        vec![
            ("number_density_m3", "number density/(1/m³)", fog.number_density_1_m3().into()),
            (
                "liquid_water_content_g_m3",
                "liquid water content/(g/m³)",
                fog.liquid_water_content_g_m3().into(),
            ),
            ("effective_radius_um", "effective radius/µm", m.effective_radius_um.into()),
            ("effective_variance", "effective variance", m.effective_variance.into()),
            ("mean_diameter_um", "mean diameter/µm", m.mean_diameter_um.into()),
        ],
    )
}

pub(super) fn regressions(fog: &FogParcel) -> Result<Section> {
    let (water, number) = (fog.liquid_water_content_g_m3(), fog.number_density_1_m3());
    let kunkel = Law::Koschmieder.range_m(parametrised::kunkel_1984_sigma_t(water)?);
    let gultepe = parametrised::gultepe_2006_visibility_m(water, number)?;
    Ok(Section::facts(
        "For comparison: regressions on measurements, 2 % contrast".to_owned(),
        vec![
            ("kunkel_1984_m", "from water, Kunkel 1984/m", kunkel.into()),
            ("gultepe_2006_m", "from water and number, Gultepe et al. 2006/m", gultepe.into()),
        ],
    ))
}

pub(super) fn path(sight: &Sight, from_m: f64, to_m: f64, across_m: f64) -> Result<Section> {
    let depth = sight.optical_depth_between(from_m, to_m, across_m)?;
    let title = format!("Path from {from_m} m to a point at {to_m} m, {across_m} m away");
    Ok(Section::facts(
        title,
        vec![
            ("to_altitude_m", "altitude of the point/m", to_m.into()),
            ("to_distance_m", "horizontal distance/m", across_m.into()),
            ("path_length_m", "length/m", path_length_m(from_m, to_m, across_m)?.into()),
            ("optical_depth", "optical depth", depth.into()),
            ("transmittance", "transmittance", transmittance(depth).into()),
        ],
    ))
}
