//! Categories of instrument approach and landing operations by runway visual range.

/// Which text of ICAO's Annex 6, Part I is followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edition {
    /// CAT III split in A, B and C: the older definition, as reprinted in AIP India, AD 2.1 VIAR (11 October 2018), with
    /// which the numbers were compared. Earlier editions printed 350 m for CAT II and 200 m for CAT IIIA.
    #[default]
    Split,
    /// CAT III without subdivisions, an RVR of less than 300 m or no limitation: the newer definition, as also in
    /// Commission Regulation (EU) 2021/2237 (quoted from memory of the text: it could not be compared).
    Undivided,
}

impl Edition {
    /// The document.
    #[must_use]
    pub fn source(self) -> &'static str {
        match self {
            Self::Split => "ICAO Annex 6, Part I, with CAT III split in A, B, C",
            Self::Undivided => "ICAO Annex 6, Part I, with CAT III undivided",
        }
    }

    /// Its categories, from the one that needs most visibility to the one that needs least.
    #[must_use]
    pub fn categories(self) -> &'static [Category] {
        match self {
            Self::Split => &SPLIT,
            Self::Undivided => &UNDIVIDED,
        }
    }

    /// The first category whose least RVR is met by `rvr_m` (m, ≥ 0): operations of a later category are open too.
    #[must_use]
    pub fn category(self, rvr_m: f64) -> &'static Category {
        let all = self.categories();
        all.iter().find(|c| rvr_m >= c.least_rvr_m).unwrap_or(&all[all.len() - 1])
    }
}

/// A category of operations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Category {
    /// As it is written: `CAT I`.
    pub name: &'static str,
    /// Decision height over the threshold, in words.
    pub decision_height: &'static str,
    /// Least RVR in m; 0 where there is no limitation.
    pub least_rvr_m: f64,
}

const fn category(name: &'static str, decision_height: &'static str, least_rvr_m: f64) -> Category {
    Category { name, decision_height, least_rvr_m }
}

const CAT_I: Category = category("CAT I", "not lower than 60 m", 550.0);
const CAT_II: Category = category("CAT II", "lower than 60 m, not lower than 30 m", 300.0);

const SPLIT: [Category; 5] = [
    CAT_I,
    CAT_II,
    category("CAT IIIA", "lower than 30 m, or none", 175.0),
    category("CAT IIIB", "lower than 15 m, or none", 50.0),
    category("CAT IIIC", "none", 0.0),
];

const UNDIVIDED: [Category; 3] = [CAT_I, CAT_II, category("CAT III", "lower than 30 m, or none", 0.0)];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_begin_at_their_minima() {
        let name = |rvr| Edition::Split.category(rvr).name;
        assert_eq!([1e9, 550.0, 549.9, 300.0].map(name), ["CAT I", "CAT I", "CAT II", "CAT II"]);
        assert_eq!([299.9, 175.0, 174.9].map(name), ["CAT IIIA", "CAT IIIA", "CAT IIIB"]);
        assert_eq!([50.0, 49.9, 0.0].map(name), ["CAT IIIB", "CAT IIIC", "CAT IIIC"]);
        let name = |rvr| Edition::Undivided.category(rvr).name;
        assert_eq!(
            [550.0, 300.0, 299.9, 0.0, f64::NAN].map(name),
            ["CAT I", "CAT II", "CAT III", "CAT III", "CAT III"]
        );
    }
}
