//! Widths of text in the embedded font, for layout.

/// Advance widths of U+0020 to U+007E in thousandths of the font size: table `hmtx` of DejaVu Sans 2.37.
const ASCII: [u16; 95] = [
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337, 636, 636, 636, 636, 636,
    636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632, 575, 775, 752, 295,
    295, 656, 557, 863, 748, 787, 603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838,
    500, 500, 613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612, 635, 635, 411, 521,
    392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838,
];

/// Width of one line of text at a font size, in the unit of the size. Characters beyond ASCII count as the mean Greek
/// letter, superscripts as digits of theirs: within 0.2 of the size of each.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let thousandths: f64 = text
        .chars()
        .map(|c| match c {
            ' '..='~' => f64::from(ASCII[c as usize - 32]),
            '²' | '³' | '¹' | '\u{2070}'..='\u{208e}' => 401.0,
            '−' | '×' | '≤' | '≥' | '≈' => 838.0,
            _ => 620.0,
        })
        .sum();
    thousandths * size / 1000.0
}

/// Breaks text at spaces into lines no wider than `limit`; a single longer word keeps a line of its own.
pub(crate) fn wrap(text: &str, size: f64, limit: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(" ", size) + width(word, size) <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// An integer as superscript: 10 and `superscript(-3)` make 10⁻³.
pub(crate) fn superscript(n: i32) -> String {
    (n.to_string().chars())
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            digit => char::from_u32(0x2070 + digit as u32 - '0' as u32).unwrap_or(digit),
        })
        .collect()
}

/// A number as 8·10⁻⁷.
pub(crate) fn scientific(number: f64) -> String {
    let text = format!("{number:e}");
    match text.split_once('e').and_then(|(m, e)| Some((m, e.parse().ok()?))) {
        Some((mantissa, exponent)) => format!("{mantissa}·10{}", superscript(exponent)),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_keep_every_word_and_the_limit() {
        let text = "Extinction coefficient by altitude, at 550 nm, of three layers of advection fog";
        let lines = wrap(text, 12.0, 150.0);
        assert!(lines.len() > 2 && lines.iter().all(|l| width(l, 12.0) <= 150.0));
        assert_eq!(lines.join(" "), text);
        assert_eq!(wrap("Donaudampfschifffahrt", 12.0, 1.0).len(), 1);
    }

    #[test]
    fn superscripts_are_signed() {
        assert_eq!(superscript(-12), "⁻¹²");
        assert_eq!(scientific(8e-7), "8·10⁻⁷");
        assert_eq!(superscript(405), "⁴⁰⁵");
    }
}
