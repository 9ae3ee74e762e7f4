//! Files of measured light distributions: ANSI/IESNA LM-63 of 1991, 1995 and 2002, and ANSI/IES LM-63-19.
//!
//! Photometry of type C is read; types A and B are refused. The layout was taken from ANSI/IESNA LM-63-2002; that the edition
//! of 2019 puts the kind of the file's origin where that of 2002 has the number "for future use" is general knowledge.

use crate::photometry::{Photometry, check_counts};

/// Angles of lamps in their luminaires that a file may have at most (`TILT=INCLUDE`).
const MAX_TILTS: usize = 1000;

/// A file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {what}")]
pub struct IesError {
    /// Line, counted from 1.
    pub line: usize,
    /// What is wrong there.
    pub what: String,
}

/// A file's content.
#[derive(Clone, Debug, PartialEq)]
pub struct IesFile {
    /// Intensities in cd, with the multiplier and the ballast's factors.
    pub photometry: Photometry,
    /// Lumens that the file claims for all lamps together; none where it says that its photometry is absolute.
    pub lamps_lm: Option<f64>,
    /// Angles in degrees between the axis and straight down, and the factors of the intensity there; empty where tilt changes
    /// nothing.
    pub tilt: Vec<[f64; 2]>,
}

impl IesFile {
    /// Reads a file.
    ///
    /// # Errors
    /// Line and reason.
    pub fn parse(text: &str) -> Result<Self, IesError> {
        let mut numbers = Numbers::after_keywords(text)?;
        let tilt = numbers.tilt()?;
        let lamps = numbers.within("the number of lamps", 1.0, 1e6)?;
        let lumens = numbers.number("the lumens per lamp")?;
        let multiplier = numbers.within("the candela multiplier", 0.0, 1e9)?;
        let vertical = numbers.count("the number of vertical angles")?;
        let horizontal = numbers.count("the number of horizontal angles")?;
        check_counts(vertical, horizontal).map_err(|what| numbers.error(what))?;
        match numbers.within("the photometric type", 1.0, 3.0)? {
            1.0 => {}
            other => {
                let kind = if other == 2.0 { "B" } else { "A" };
                return Err(numbers.error(format!("photometry of type {kind}; valid: 1, type C")));
            }
        }
        for name in ["the units type", "the width", "the length", "the height"] {
            numbers.number(name)?;
        }
        let ballast = numbers.within("the ballast factor", 0.0, 1e3)?;
        let second = numbers.number("the ballast-lamp photometric factor")?;
        numbers.number("the input watts")?;
        let factor = if numbers.second_factor { second } else { 1.0 } * ballast * multiplier;
        if factor.is_nan() || factor < 0.0 {
            return Err(numbers.error(format!("the intensities' factor is {factor}; valid: 0 or more")));
        }

        let vertical_deg = numbers.several(vertical, "vertical angles")?;
        let horizontal_deg = numbers.several(horizontal, "horizontal angles")?;
        let candela = numbers.several(vertical * horizontal, "candela values")?;
        let candela: Vec<f32> = candela.into_iter().map(|c| (c * factor) as f32).collect();
        let photometry = Photometry::new(vertical_deg, &horizontal_deg, &candela);
        let photometry = photometry.map_err(|what| numbers.error(what))?;
        let lamps_lm = (lumens > 0.0).then_some(lamps * lumens);
        Ok(Self { photometry, lamps_lm, tilt })
    }

    /// Factor of the intensity where the axis is so many degrees from straight down: linear between the file's angles, and
    /// that of the nearest beyond them.
    #[must_use]
    pub fn tilt_factor(&self, tilt_deg: f64) -> f64 {
        let Some(&[_, last]) = self.tilt.last() else { return 1.0 };
        let next = self.tilt.iter().position(|[angle, _]| *angle > tilt_deg);
        match next {
            None => last,
            Some(0) => self.tilt[0][1],
            Some(k) => {
                let ([a, f], [b, g]) = (self.tilt[k - 1], self.tilt[k]);
                f + (g - f) * (tilt_deg - a) / (b - a)
            }
        }
    }
}

/// The numbers of a file, separated by white space or commas.
struct Numbers<'a> {
    rest: Vec<(usize, &'a str)>,
    next: usize,
    tilt: &'a str,
    /// True if the number after the ballast factor is a factor too: not in 2002 ("future use") and 2019 (kind of origin).
    second_factor: bool,
}

impl<'a> Numbers<'a> {
    fn after_keywords(text: &'a str) -> Result<Self, IesError> {
        let mut lines = text.lines().zip(1..);
        let header = lines.next().map_or("", |(line, _)| line.trim().trim_start_matches('\u{feff}'));
        let editions = ["IESNA91", "IESNA:LM-63-1995", "IESNA:LM-63-2002", "IES:LM-63-2019"];
        let Some(edition) = editions.iter().position(|known| header == *known) else {
            let what = format!("begins with `{}`; valid: {}", shortened(header), editions.join(", "));
            return Err(IesError { line: 1, what });
        };
        let mut last = 1;
        let tilt = lines.by_ref().find_map(|(line, number)| {
            last = number;
            line.trim().strip_prefix("TILT=")
        });
        let tilt = tilt.ok_or_else(|| IesError { line: last, what: "ends without a line TILT=".into() })?;
        let words = lines.flat_map(|(line, number)| {
            let words = line.split(|c: char| c.is_whitespace() || c == ',');
            words.filter(|word| !word.is_empty()).map(move |word| (number, word))
        });
        let rest: Vec<_> = core::iter::once((last, "")).chain(words).collect();
        Ok(Self { rest, next: 1, tilt: tilt.trim(), second_factor: edition < 2 })
    }

    /// At the last number that was read.
    fn error(&self, what: String) -> IesError {
        IesError { line: self.rest[self.next - 1].0, what }
    }

    fn number(&mut self, name: &str) -> Result<f64, IesError> {
        let Some(&(_, word)) = self.rest.get(self.next) else {
            return Err(self.error(format!("ends before {name}")));
        };
        self.next += 1;
        let number = word.parse::<f64>().ok().filter(|x| x.is_finite());
        number.ok_or_else(|| self.error(format!("{name}: `{}` is not a number", shortened(word))))
    }

    fn within(&mut self, name: &str, least: f64, most: f64) -> Result<f64, IesError> {
        let number = self.number(name)?;
        if (least..=most).contains(&number) {
            return Ok(number);
        }
        Err(self.error(format!("{name} is {number}; valid: {least} to {most}")))
    }

    fn count(&mut self, name: &str) -> Result<usize, IesError> {
        let number = self.within(name, 1.0, 1e6)?;
        if number.fract() == 0.0 {
            Ok(number as usize)
        } else {
            Err(self.error(format!("{name} is {number}")))
        }
    }

    /// As many numbers as there are left at least, so that no count makes room for what is not there.
    fn several(&mut self, count: usize, name: &str) -> Result<Vec<f64>, IesError> {
        let left = self.rest.len() - self.next;
        if left < count {
            return Err(self.error(format!("ends before all {name}: {count} are announced, {left} follow")));
        }
        (0..count).map(|_| self.number(name)).collect()
    }

    fn tilt(&mut self) -> Result<Vec<[f64; 2]>, IesError> {
        match self.tilt {
            "NONE" => return Ok(Vec::new()),
            "INCLUDE" => {}
            other => {
                let what = format!("TILT={}; valid: NONE or INCLUDE", shortened(other));
                return Err(self.error(what));
            }
        }
        self.within("the lamp-to-luminaire geometry", 1.0, 3.0)?;
        let count = self.count("the number of tilt angles")?;
        if count > MAX_TILTS {
            return Err(self.error(format!("{count} tilt angles; valid: 1 to {MAX_TILTS}")));
        }
        let angles = self.several(count, "tilt angles")?;
        let factors = self.several(count, "tilt factors")?;
        if angles.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(self.error("tilt angles do not ascend".into()));
        }
        if let Some(wrong) = factors.iter().find(|f| !(0.0..=1e3).contains(*f)) {
            return Err(self.error(format!("a tilt factor is {wrong}; valid: 0 to 1000")));
        }
        Ok(angles.into_iter().zip(factors).map(|(angle, factor)| [angle, factor]).collect())
    }
}

fn shortened(text: &str) -> String {
    text.chars().take(40).flat_map(char::escape_debug).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, tilt: &str, numbers: &str) -> Result<IesFile, IesError> {
        IesFile::parse(&format!("{header}\n[TEST] none\n[MANUFAC] nobody\nTILT={tilt}\n{numbers}"))
    }

    const SMALL: &str = "1 1000 2.5 3 1 1 2 0 0 0\n0.9 0.8 50\n0 45 90\n0\n100, 50\n 0\n";

    #[test]
    fn factors_count() {
        let lamp = file("IESNA:LM-63-2002", "NONE", SMALL).unwrap();
        assert_eq!(lamp.lamps_lm, Some(1000.0));
        assert!((lamp.photometry.candela_at(0.0, 33.0) - 225.0).abs() < 1e-4);
        assert!((lamp.photometry.candela_at(67.5, 0.0) - 56.25).abs() < 1e-4);
        assert_eq!(lamp.photometry.candela_at(90.5, 0.0), 0.0);
        let older = file("IESNA:LM-63-1995", "NONE", SMALL).unwrap();
        assert!((older.photometry.greatest_candela() - 180.0).abs() < 1e-4);
        let newer = file("IES:LM-63-2019", "NONE", &SMALL.replace("0.8", "1.10000")).unwrap();
        assert!((newer.photometry.greatest_candela() - 225.0).abs() < 1e-4);
        let absolute = file("IESNA91", "NONE", &SMALL.replace("1000", "-1")).unwrap();
        assert_eq!(absolute.lamps_lm, None);
    }

    #[test]
    fn tilt_is_interpolated() {
        let lamp =
            file("IESNA:LM-63-2002", "INCLUDE", &format!("1\n3\n0 30 90\n1 0.9 0.6\n{SMALL}")).unwrap();
        for (tilt, want) in [(0.0, 1.0), (15.0, 0.95), (60.0, 0.75), (90.0, 0.6), (170.0, 0.6)] {
            assert!((lamp.tilt_factor(tilt) - want).abs() < 1e-12, "{tilt}");
        }
        assert_eq!(file("IESNA:LM-63-2002", "NONE", SMALL).unwrap().tilt_factor(50.0), 1.0);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let wrong =
            |header: &str, tilt: &str, numbers: &str| file(header, tilt, numbers).unwrap_err().to_string();
        let v = "IESNA:LM-63-2002";
        for (message, start) in [
            (wrong("IESNA:LM-63-1886", "NONE", SMALL), "line 1: begins with `IESNA:LM-63-1886`"),
            (wrong(v, "tilt.dat", SMALL), "line 4: TILT=tilt.dat; valid: NONE or INCLUDE"),
            (wrong(v, "NONE", "1 1000 2.5 3 1 2 2 0 0 0"), "line 5: photometry of type B"),
            (wrong(v, "NONE", &SMALL.replace("100,", "1e2x")), "line 9: candela values: `1e2x` is not"),
            (wrong(v, "NONE", &SMALL.replace("100,", "NaN")), "line 9: candela values: `NaN` is not"),
            (wrong(v, "NONE", &SMALL.replace("100,", "-1")), "line 10: an intensity of -2.25 cd"),
            (wrong(v, "NONE", "1 1000 1 1000000 1000000 1"), "line 5: 1000000 vertical angles"),
            (wrong(v, "NONE", "1 1000 1 4000 4000 1"), "line 5: 4000 × 4000 intensities"),
            (wrong(v, "NONE", "1 1000 1 4000 200 1 2 0 0 0 1 1 1"), "line 5: ends before all vertical"),
            (wrong(v, "NONE", "1 1000 1 2.5"), "line 5: the number of vertical angles is 2.5"),
            (wrong(v, "NONE", "1 1000"), "line 5: ends before the candela multiplier"),
            (wrong(v, "NONE", ""), "line 4: ends before the number of lamps"),
            (wrong(v, "INCLUDE", "1 100000"), "line 5: 100000 tilt angles"),
        ] {
            assert!(message.starts_with(start), "{message}\nshould begin {start}");
        }
        assert_eq!(IesFile::parse("").unwrap_err().line, 1);
        assert!(IesFile::parse("IESNA91\n[A]").unwrap_err().to_string().contains("TILT="));
    }
}
