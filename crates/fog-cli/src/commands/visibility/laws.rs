//! Every law at an altitude.

use super::Report;
use super::air::Air;
use super::facts;
use super::section::{Column, Section};
use crate::args::{EditionArg, VisibilityArgs};
use crate::rows::Cell;
use anyhow::{Result, bail};
use fogbank::optics::visibility::category::Edition;
use fogbank::optics::visibility::rvr::{ASSESSMENT_HEIGHT_M, RunwayLights, Rvr};
use fogbank::optics::visibility::slant::{distance_to_altitude_m, path_length_m};
use fogbank::optics::visibility::threshold::{self, Threshold};
use fogbank::optics::visibility::{Law, PAPER_INTENSITIES_CD, Sight};

/// Laws of visual range with their thresholds.
pub(super) struct Laws {
    thresholds: Vec<Threshold>,
    /// Objects, then every light at every threshold.
    all: Vec<Named>,
    runway: RunwayLights,
    edition: Edition,
}

/// A law, and the threshold of a light.
struct Named {
    name: &'static str,
    law: Law,
    light: Option<Threshold>,
}

/// Columns that name a law.
const LAW: [Column; 4] = [
    Column("law", "law"),
    Column("light", "light"),
    Column("threshold_lx", "threshold/lx"),
    Column("intensity_cd", "intensity/cd"),
];

impl Named {
    fn cells(&self) -> Vec<Cell> {
        let intensity = match self.law {
            Law::Allard { intensity_cd, .. } => Some(intensity_cd),
            _ => None,
        };
        let light = self.light.map_or(Cell::Nothing, |t| Cell::from(t.name));
        vec![
            Cell::from(self.name),
            light,
            Cell::from(self.light.map(|t| t.illuminance_lx)),
            Cell::from(intensity),
        ]
    }
}

impl Laws {
    pub(super) fn new(args: &VisibilityArgs) -> Result<Self> {
        let mut thresholds: Vec<Threshold> =
            args.light.iter().filter_map(|name| threshold::named(name)).collect();
        if let Some(background) = args.background {
            thresholds.push(Threshold {
                name: "background",
                illuminance_lx: threshold::icao_continuous_lx(background)?,
                ..threshold::icao_step(background)?
            });
        }
        if thresholds.is_empty() {
            thresholds.extend(threshold::ICAO);
        }
        let intensities = match args.intensity[..] {
            [] => PAPER_INTENSITIES_CD.to_vec(),
            _ => args.intensity.clone(),
        };
        if let Some(bad) = intensities.iter().find(|i| !(1e-6..=1e12).contains(*i)) {
            bail!("--intensity {bad} cd; valid: 1e-6 to 1e12");
        }
        let mut all = vec![
            Named { name: "mor", law: Law::Mor, light: None },
            Named { name: "koschmieder", law: Law::Koschmieder, light: None },
        ];
        for &light in &thresholds {
            for &intensity_cd in &intensities {
                let law = Law::Allard { intensity_cd, threshold_lx: light.illuminance_lx };
                all.push(Named { name: "allard", law, light: Some(light) });
            }
        }
        let [edge_cd, centre_line_cd] = args.runway_lights;
        let edition = match args.categories {
            EditionArg::Split => Edition::Split,
            EditionArg::Undivided => Edition::Undivided,
        };
        let runway = RunwayLights { edge_cd, centre_line_cd, setting_percent: args.light_setting };
        Ok(Self { thresholds, all, runway, edition })
    }

    /// Everything at an altitude in m.
    pub(super) fn report(&self, args: &VisibilityArgs, air: &Air, altitude_m: f64) -> Result<Report> {
        if let Some([base, top]) = air.extent_m
            && !(base..=top).contains(&altitude_m)
        {
            bail!("--altitude {altitude_m} m is outside of the fog; valid: {base} to {top} m");
        }
        let droplets = air.droplets(altitude_m)?;
        let mut report = vec![facts::objects(&air.sight, altitude_m)?];
        if let Some(droplets) = &droplets {
            report.push(facts::water(droplets));
            report.push(facts::regressions(droplets)?);
        }
        report.push(self.lights(&air.sight, altitude_m)?);
        report.push(self.runway(&air.sight)?);
        if altitude_m > 0.0 {
            report.push(self.down_to(&air.sight, altitude_m, 0.0, "ground", None)?);
        }
        if !args.slant.is_empty() {
            report.push(self.slants(&air.sight, altitude_m, &args.slant)?);
        }
        if let Some([to_m, across_m]) = args.to {
            report.push(facts::path(&air.sight, altitude_m, to_m, across_m)?);
            report.push(self.down_to(&air.sight, altitude_m, to_m, "to", Some(across_m))?);
        }
        Ok(report)
    }

    fn lights(&self, sight: &Sight, altitude_m: f64) -> Result<Section> {
        let mut rows = Vec::new();
        for named in self.all.iter().filter(|n| n.light.is_some()) {
            let mut row = named.cells().split_off(1);
            row.push(sight.horizontal_m(&named.law, altitude_m)?.into());
            rows.push(row);
        }
        let [_, light, threshold, intensity] = LAW;
        Ok(Section {
            title: format!("Lights at {altitude_m} m (Allard; {})", sources(&self.thresholds)),
            name: Some("allard"),
            conditions: 3,
            columns: vec![light, threshold, intensity, Column("range_m", "range/m")],
            rows,
        })
    }

    fn runway(&self, sight: &Sight) -> Result<Section> {
        let sigma_t = sight.sigma_t(ASSESSMENT_HEIGHT_M);
        let mut rows = Vec::new();
        for t in &self.thresholds {
            let rvr = Rvr::new(sigma_t, &self.runway, t.illuminance_lx)?;
            let category = self.edition.category(rvr.rvr_m);
            rows.push(vec![
                Cell::from(t.name),
                t.illuminance_lx.into(),
                rvr.markings_m.into(),
                rvr.lights_m.into(),
                rvr.intensity_cd.into(),
                rvr.rvr_m.into(),
                Cell::Text(rvr.reported().to_string()),
                Cell::from(category.name),
                Cell::from(category.decision_height),
            ]);
        }
        Ok(Section {
            title: format!(
                "Runway visual range {ASSESSMENT_HEIGHT_M} m over a runway at altitude 0 (ICAO Doc 9328; lights {} cd edge, \
                 {} cd centre line, setting {} %; categories: {})",
                self.runway.edge_cd,
                self.runway.centre_line_cd,
                self.runway.setting_percent,
                self.edition.source()
            ),
            name: Some("rvr"),
            conditions: 2,
            columns: vec![
                Column("light", "light"),
                Column("threshold_lx", "threshold/lx"),
                Column("markings_m", "markings/m"),
                Column("lights_m", "lights/m"),
                Column("intensity_cd", "intensity/cd"),
                Column("rvr_m", "RVR/m"),
                Column("reported", "reported"),
                Column("category", "category"),
                Column("decision_height", "decision height"),
            ],
            rows,
        })
    }

    /// Farthest sight of things at another altitude, and whether they are seen at a horizontal distance.
    fn down_to(
        &self,
        sight: &Sight,
        from_m: f64,
        to_m: f64,
        name: &'static str,
        across_m: Option<f64>,
    ) -> Result<Section> {
        let mut rows = Vec::new();
        for named in &self.all {
            let mut row = named.cells();
            let range = sight.to_altitude_m(&named.law, from_m, to_m)?;
            row.push(range.into());
            if let Some(across_m) = across_m {
                let length = path_length_m(from_m, to_m, across_m)?;
                let seen = range.is_some_and(|r| r >= length);
                row.push(Cell::Answer(seen));
            }
            rows.push(row);
        }
        let mut columns = LAW.to_vec();
        columns.push(Column("range_m", "slant range/m"));
        if across_m.is_some() {
            columns.push(Column("seen", "seen"));
        }
        let what = if name == "ground" { "the ground".to_owned() } else { format!("things at {to_m} m") };
        let title = format!(
            "Slant visual range from {from_m} m to {what} (exact optical depth; - where not even straight on)"
        );
        Ok(Section { title, name: Some(name), conditions: 4, columns, rows })
    }

    fn slants(&self, sight: &Sight, altitude_m: f64, angles_deg: &[f64]) -> Result<Section> {
        let mut rows = Vec::new();
        for &angle in angles_deg {
            for named in &self.all {
                let mut row = vec![Cell::from(angle)];
                row.extend(named.cells());
                let range_m = sight.along_m(&named.law, altitude_m, angle)?;
                let ground_m = distance_to_altitude_m(altitude_m, 0.0, angle)?;
                row.push(range_m.into());
                row.push(ground_m.into());
                row.push(ground_m.map_or(Cell::Nothing, |g| Cell::Answer(range_m >= g)));
                rows.push(row);
            }
        }
        let mut columns = vec![Column("elevation_deg", "elevation/°")];
        columns.extend(LAW);
        columns.push(Column("range_m", "range/m"));
        columns.push(Column("ground_m", "ground at/m"));
        columns.push(Column("ground_seen", "seen"));
        let title = format!(
            "Along slants from {altitude_m} m (exact optical depth through the fog; inf: to its end and beyond)"
        );
        Ok(Section { title, name: Some("slant"), conditions: 5, columns, rows })
    }
}

/// Documents of the thresholds, each once.
fn sources(thresholds: &[Threshold]) -> String {
    let mut all: Vec<&str> = thresholds.iter().map(|t| t.source).collect();
    all.dedup();
    all.join("; ")
}
