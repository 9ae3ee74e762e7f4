//! Curves of a sensor's red, green and blue pixels over wavelength, from text.

use fog_core::colour::Observer;
use fog_core::sensor_response::SensorResponse;
use thiserror::Error;

/// The Nikon D5100 as measured by the National Physical Laboratory (`tables/sensor/README.md`).
const NIKON_D5100: &str = include_str!("../../../tables/sensor/nikon_d5100_5nm.csv");

/// Header of probabilities that a photon frees an electron.
const EFFICIENCIES: &str = "wavelength_nm,qe_red,qe_green,qe_blue";
/// Header of responses to radiant energy in any unit.
const RESPONSES: &str = "wavelength_nm,red,green,blue";

/// Why a text is no set of curves; lines count from 1.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CurvesError {
    /// The first line.
    #[error("line 1: expected the header `{EFFICIENCIES}` or `{RESPONSES}`, found `{found}`")]
    Header {
        /// What is there.
        found: String,
    },
    /// A cell.
    #[error("line {line}: {what}")]
    Row {
        /// Where.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// Fewer than two rows.
    #[error("only {rows} rows; at least 2 are needed")]
    Short {
        /// How many.
        rows: usize,
    },
    /// No response to speak of.
    #[error("the green curve sees nothing from 380 to 780 nm")]
    Blind,
    /// No colours.
    #[error("the three curves do not tell colours apart")]
    Alike,
}

/// Three curves, linear between their rows and 0 outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// Whether the values are quantum efficiencies; else responses to energy.
    efficiencies: bool,
    rows: Vec<(f64, [f64; 3])>,
}

impl Curves {
    /// The curves of the Nikon D5100: responses to energy, each with its greatest value 1.
    ///
    /// # Errors
    /// None but for a damaged program.
    pub fn nikon_d5100() -> Result<Self, CurvesError> {
        Self::parse(NIKON_D5100)
    }

    /// Reads CSV with one of the headers `wavelength_nm,qe_red,qe_green,qe_blue` (electrons per photon, 0 to 1) and
    /// `wavelength_nm,red,green,blue` (response to radiant energy in any unit, the same for all three), wavelengths ascending.
    ///
    /// # Errors
    /// The first line that is wrong.
    pub fn parse(text: &str) -> Result<Self, CurvesError> {
        let mut lines = text.trim_start_matches('\u{feff}').lines();
        let header = lines.next().unwrap_or_default().trim();
        let efficiencies = match header {
            EFFICIENCIES => true,
            RESPONSES => false,
            _ => return Err(CurvesError::Header { found: header.chars().take(80).collect() }),
        };
        let most = if efficiencies { 1.0 } else { 1e12 };
        let mut rows: Vec<(f64, [f64; 3])> = Vec::new();
        for (i, text) in lines.enumerate().filter(|(_, text)| !text.trim().is_empty()) {
            let wrong = |what: String| CurvesError::Row { line: i + 2, what };
            let cells: Vec<&str> = text.split(',').map(str::trim).collect();
            let [nm, values @ ..] = &cells[..] else { return Err(wrong("empty".to_owned())) };
            if values.len() != 3 {
                return Err(wrong(format!("expected 4 numbers, found {}", cells.len())));
            }
            let number = |text: &str, least: f64, most: f64| {
                let value = text.parse::<f64>().ok().filter(|v| (least..=most).contains(v));
                let shown = || text.chars().take(60).collect::<String>();
                value.ok_or_else(|| wrong(format!("`{}` is no number from {least} to {most}", shown())))
            };
            let nm = number(nm, 100.0, 10_000.0)?;
            if rows.last().is_some_and(|(before, _)| *before >= nm) {
                return Err(wrong(format!("{nm} nm does not follow the wavelength before it")));
            }
            let mut row = [0.0; 3];
            for (value, text) in row.iter_mut().zip(values) {
                *value = number(text, 0.0, most)?;
            }
            rows.push((nm, row));
        }
        if rows.len() < 2 {
            return Err(CurvesError::Short { rows: rows.len() });
        }
        Ok(Self { efficiencies, rows })
    }

    /// Whether the values are quantum efficiencies, so that they need no `peak`.
    #[must_use]
    pub fn are_efficiencies(&self) -> bool {
        self.efficiencies
    }

    fn at(&self, nm: f64) -> [f64; 3] {
        let above = self.rows.partition_point(|(row, _)| *row < nm);
        match (above.checked_sub(1).map(|i| self.rows[i]), self.rows.get(above)) {
            (_, Some((row, values))) if *row == nm => *values,
            (Some((low, a)), Some((high, b))) => {
                let t = (nm - low) / (high - low);
                [0, 1, 2].map(|c| a[c] + (b[c] - a[c]) * t)
            }
            _ => [0.0; 3],
        }
    }

    /// The sensor with these curves. Responses to energy become quantum efficiencies (∝ response / wavelength) of which
    /// green's greatest is `peak`, in (0, 1].
    ///
    /// # Errors
    /// If green sees nothing of the visible spectrum, or the curves do not tell colours apart.
    pub fn response(&self, observer: &Observer, peak: f64) -> Result<SensorResponse, CurvesError> {
        let greatest = self.rows.iter().map(|(nm, values)| values[1] / nm).fold(0.0, f64::max);
        let efficiency = |nm: f64| {
            if self.efficiencies { self.at(nm) } else { self.at(nm).map(|v| v / nm * peak / greatest) }
        };
        if greatest <= 0.0 {
            return Err(CurvesError::Blind);
        }
        let response = SensorResponse::new(observer, efficiency).ok_or(CurvesError::Blind)?;
        match response.srgb_from_channels(observer) {
            Some(_) => Ok(response),
            None => Err(CurvesError::Alike),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_curves_are_a_camera() {
        let observer = Observer::new();
        let curves = Curves::nikon_d5100().expect("a table");
        assert_eq!((curves.rows.len(), curves.are_efficiencies()), (81, false));
        assert_eq!((curves.at(530.0)[1], curves.at(595.0)[0], curves.at(460.0)[2]), (1.0, 1.0, 1.0));
        let sensor = curves.response(&observer, 0.5).expect("a sensor");
        let white = sensor.channels_of(|_| 1.0);
        assert!((white[1] - 1.0).abs() < 1e-6 && white[0] < 1.0 && white[2] < 1.0, "{white:?}");
        let matrix = sensor.srgb_from_channels(&observer).expect("colours");
        // Like every camera's: more than 1 on the diagonal once white is balanced.
        assert!((0..3).all(|c| matrix[c][c] * white[c] > 1.0), "{matrix:?}");
        let twice = curves.response(&observer, 1.0).expect("a sensor");
        assert!((twice.electrons_per_lx_s_m2() / sensor.electrons_per_lx_s_m2() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn values_are_linear_between_rows_and_end_with_them() {
        let c = Curves::parse("wavelength_nm,qe_red,qe_green,qe_blue\n400,0,0.5,1\n500,0.5,0.5,0\n")
            .expect("curves");
        assert!(c.are_efficiencies());
        assert_eq!(c.at(450.0), [0.25, 0.5, 0.5]);
        assert_eq!((c.at(400.0), c.at(500.0)), ([0.0, 0.5, 1.0], [0.5, 0.5, 0.0]));
        assert_eq!((c.at(399.0), c.at(501.0)), ([0.0; 3], [0.0; 3]));
    }

    #[test]
    fn mistakes_are_named() {
        let of = |text: &str| Curves::parse(text).expect_err("wrong").to_string();
        assert!(of("nm,r,g,b\n").starts_with("line 1: expected the header `wavelength_nm,qe_red"));
        let rows = |text: &str| of(&format!("wavelength_nm,qe_red,qe_green,qe_blue\n{text}"));
        assert_eq!(rows("400,0,0\n"), "line 2: expected 4 numbers, found 3");
        assert_eq!(rows("400,0,0,1.5\n"), "line 2: `1.5` is no number from 0 to 1");
        assert_eq!(rows("400,0,0,nan\n"), "line 2: `nan` is no number from 0 to 1");
        assert_eq!(
            rows("400,0,0,1\n\n400,0,0,1\n"),
            "line 4: 400 nm does not follow the wavelength before it"
        );
        assert_eq!(rows("400,0,0,1\n"), "only 1 rows; at least 2 are needed");
        let observer = Observer::new();
        let response = |text: &str| Curves::parse(text).expect("curves").response(&observer, 0.5).map(|_| ());
        assert_eq!(response("wavelength_nm,red,green,blue\n400,1,0,1\n700,1,0,1\n"), Err(CurvesError::Blind));
        assert_eq!(response("wavelength_nm,red,green,blue\n900,1,1,1\n990,1,1,1\n"), Err(CurvesError::Blind));
        assert_eq!(response("wavelength_nm,red,green,blue\n400,1,1,1\n700,1,1,1\n"), Err(CurvesError::Alike));
    }

    #[test]
    fn damaged_files_are_refused_or_read() {
        let good =
            "\u{feff}wavelength_nm,red,green,blue\r\n400,0,0.1,0.9\r\n550,0.2,1,0.1\r\n700,0.8,0.1,0\r\n";
        assert_eq!(Curves::parse(good).expect("with a byte order mark and CRLF").rows.len(), 3);
        let parts = [
            "NaN", "inf", "-1e999", "1e308", ",", ",,,", "\n", "\u{0}", "\u{feff}", "९", "", "400", "\"", "é",
        ];
        let mut rng = fog_core::random::PathRng::new(17, 0, 0);
        let mut below = |n: usize| (rng.uniform_f64() * n as f64) as usize;
        for _ in 0..3000 {
            let mut text: Vec<char> = good.chars().collect();
            for _ in 0..=below(3) {
                let at = below(text.len());
                let end = (at + below(9)).min(text.len());
                text.splice(at..end, parts[below(parts.len())].chars());
            }
            // Whatever it is, it is read or refused, and shortly.
            if let Err(error) = Curves::parse(&text.iter().collect::<String>()) {
                assert!(error.to_string().chars().count() < 400, "{error}");
            }
        }
        let long = format!("wavelength_nm,red,green,blue\n{},1,1,1", "9".repeat(1 << 20));
        assert!(Curves::parse(&long).expect_err("no number").to_string().len() < 400);
    }
}
