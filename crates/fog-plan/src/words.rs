//! Words of the messages: suggestions, units, short numbers.

/// The candidate that was probably meant by `word`, if one is near enough: at most two edits (one for short words).
pub(crate) fn did_you_mean<'c>(word: &str, candidates: &[&'c str]) -> Option<&'c str> {
    let limit = if word.chars().count() <= 4 { 1 } else { 2 };
    let nearest = candidates.iter().map(|c| (edits(word, c), *c)).min_by_key(|(distance, _)| *distance)?;
    (nearest.0 <= limit).then_some(nearest.1)
}

/// Edit distance with swaps of neighbours counted as one edit (optimal string alignment).
fn edits(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    // A user's word can be arbitrarily long; far apart in length is far apart.
    if a.len().abs_diff(b.len()) > 2 {
        return usize::MAX;
    }
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = match (i, j) {
                (0, _) => j,
                (_, 0) => i,
                _ => {
                    let same = a[i - 1] == b[j - 1];
                    let step = rows[i - 1][j - 1] + usize::from(!same);
                    let mut best = step.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
                    if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                        best = best.min(rows[i - 2][j - 2] + 1);
                    }
                    best
                }
            };
        }
    }
    rows[a.len()][b.len()]
}

/// Unit named by a key's suffix: symbol for values, and word for what is expected.
pub(crate) fn unit_of(key: &str) -> Option<(&'static str, &'static str)> {
    const UNITS: [(&str, &str, &str); 16] = [
        ("_cd_m2", "cd/m²", "candela per square metre"),
        ("_1_m3", "1/m³", "per cubic metre"),
        ("_1_m", "1/m", "per metre"),
        ("_m", "m", "metres"),
        ("_deg", "deg", "degrees"),
        ("_px", "px", "pixels"),
        ("_nm", "nm", "nanometres"),
        ("_um", "µm", "micrometres"),
        ("_lx", "lx", "lux"),
        ("_k", "K", "kelvins"),
        ("_e_s", "e/s", "electrons per second"),
        ("_m_s", "m/s", "metres per second"),
        ("_s", "s", "seconds"),
        ("_hz", "Hz", "hertz"),
        ("_e", "e", "electrons"),
        ("_du", "DU", "Dobson units"),
    ];
    UNITS.iter().find(|unit| key.ends_with(unit.0)).map(|unit| (unit.1, unit.2))
}

/// `; expected one of a, b; did you mean `a`?` for a word that is none of `expected`.
pub(crate) fn expected_one_of(word: &str, expected: &[&str]) -> String {
    let list = if expected.len() == 1 {
        format!("; expected {}", expected[0])
    } else {
        format!("; expected one of {}", expected.join(", "))
    };
    match did_you_mean(word, expected) {
        Some(meant) => format!("{list}; did you mean `{meant}`?"),
        None => list,
    }
}

/// A number with at most six significant digits and no trailing zeros: `0.3`, `157.2`, `1e-7`.
pub(crate) fn short_number(x: f64) -> String {
    let rounded = format!("{x:.5e}").parse().unwrap_or(x);
    let magnitude = f64::abs(rounded);
    if magnitude != 0.0 && !(1e-4..1e15).contains(&magnitude) {
        format!("{rounded:e}")
    } else {
        // Adding zero turns -0 into 0.
        format!("{}", rounded + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_only_near_words() {
        let keys = ["model", "height_m", "phase"];
        assert_eq!(did_you_mean("heigth_m", &keys), Some("height_m"));
        assert_eq!(did_you_mean("phse", &keys), Some("phase"));
        assert_eq!(did_you_mean("height", &keys), Some("height_m"));
        assert_eq!(did_you_mean("altitude", &keys), None);
        assert_eq!(did_you_mean("x", &keys), None);
    }

    #[test]
    fn units_come_from_suffixes() {
        assert_eq!(unit_of("sigma_t_1_m"), Some(("1/m", "per metre")));
        assert_eq!(unit_of("height_m"), Some(("m", "metres")));
        assert_eq!(unit_of("samples"), None);
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(short_number(0.1 + 0.2), "0.3");
        assert_eq!(short_number(-5.0), "-5");
        assert_eq!(short_number(1e-7), "1e-7");
        assert_eq!(short_number(-0.0), "0");
        assert_eq!(short_number(1_000_000.0), "1000000");
    }
}
