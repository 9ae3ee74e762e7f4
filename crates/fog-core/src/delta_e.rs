//! How different two colours look: CIE L\*a\*b\* and the CIEDE2000 colour difference.
//!
//! Sources: CIE 15:2004 (L\*a\*b\*); IEC 61966-2-1:1999 (sRGB and its white, D65); Sharma, Wu & Dalal 2005, "The CIEDE2000
//! color-difference formula: implementation notes, supplementary test data, and mathematical observations", Color Research
//! & Application 30(1), 21–30 (equation numbers below are theirs).

use crate::math::f64::{atan2, cbrt, cos, exp, sin};
use crate::math::{PI, TAU};

/// A colour in CIE 1976 L\*a\*b\*: `l` from 0 (black) to 100 (white), `a` green to red, `b` blue to yellow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lab {
    /// Lightness L\*.
    pub l: f64,
    /// a\*.
    pub a: f64,
    /// b\*.
    pub b: f64,
}

/// CIE XYZ of linear sRGB, Y = 1 for white (the four-digit matrix of IEC 61966-2-1).
const XYZ_FROM_SRGB: [[f64; 3]; 3] =
    [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];

fn xyz(rgb: [f64; 3]) -> [f64; 3] {
    XYZ_FROM_SRGB.map(|row| row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2])
}

impl Lab {
    /// L\*a\*b\* of a linear sRGB colour, 1 being the display's white; the reference white is that of sRGB (D65), so that
    /// R = G = B has a\* = b\* = 0.
    #[must_use]
    pub fn from_linear_srgb(rgb: [f64; 3]) -> Self {
        // CIE 15:2004, 8.2.1.1: a cube root, continued by its tangent below (6/29)³.
        let f = |t: f64| {
            const D: f64 = 6.0 / 29.0;
            if t > D * D * D { cbrt(t) } else { t / (3.0 * D * D) + 4.0 / 29.0 }
        };
        let (c, white) = (xyz(rgb), xyz([1.0; 3]));
        let [fx, fy, fz]: [f64; 3] = core::array::from_fn(|i| f(c[i] / white[i]));
        Self { l: 116.0 * fy - 16.0, a: 500.0 * (fx - fy), b: 200.0 * (fy - fz) }
    }
}

/// The CIEDE2000 colour difference ΔE₀₀ of two colours, with k_L = k_C = k_H = 1; symmetric, 0 for equal colours, about 1 for
/// a difference that is just seen, 100 between black and white. Sharma et al. 2005, eqs. 2–22.
#[must_use]
pub fn delta_e_2000(x: Lab, y: Lab) -> f64 {
    if x == y {
        return 0.0;
    }
    // 1. Chroma and hue, with a* stretched for colours near grey (eqs. 2–7).
    let chroma = |c: Lab| (c.a * c.a + c.b * c.b).sqrt();
    let stretch = 1.5 - 0.5 * high_chroma(0.5 * (chroma(x) + chroma(y)));
    let (x, y) = (Lab { a: stretch * x.a, ..x }, Lab { a: stretch * y.a, ..y });
    let (c1, c2) = (chroma(x), chroma(y));
    let (h1, h2) = (hue(x), hue(y));

    // 2. Differences of lightness, chroma and hue (eqs. 8–11).
    let grey = c1 * c2 == 0.0;
    let turn = |h: f64| if h > PI { h - TAU } else { h };
    let dh = match h2 - h1 {
        _ if grey => 0.0,
        d if d < -PI => d + TAU,
        d => turn(d),
    };
    let (dl, dc, dh) = (y.l - x.l, c2 - c1, 2.0 * (c1 * c2).sqrt() * sin(0.5 * dh));

    // 3. Their means (eqs. 12–14).
    let (l, c) = (0.5 * (x.l + y.l), 0.5 * (c1 + c2));
    let h = match h1 + h2 {
        sum if grey => sum,
        sum if (h1 - h2).abs() <= PI => 0.5 * sum,
        sum if sum < TAU => 0.5 * (sum + TAU),
        sum => 0.5 * (sum - TAU),
    };

    // 4. Weights and the rotation in the blue (eqs. 15–21).
    let deg = PI / 180.0;
    let t = 1.0 - 0.17 * cos(h - 30.0 * deg) + 0.24 * cos(2.0 * h) + 0.32 * cos(3.0 * h + 6.0 * deg)
        - 0.20 * cos(4.0 * h - 63.0 * deg);
    let blue = (h / deg - 275.0) / 25.0;
    let rotation = -2.0 * high_chroma(c) * sin(60.0 * deg * exp(-blue * blue));
    let from_50 = (l - 50.0) * (l - 50.0);
    let dl = dl / (1.0 + 0.015 * from_50 / (20.0 + from_50).sqrt());
    let dc = dc / (1.0 + 0.045 * c);
    let dh = dh / (1.0 + 0.015 * c * t);

    // 5. The length (eq. 22); the form is not negative but for rounding.
    (dl * dl + dc * dc + dh * dh + rotation * dc * dh).max(0.0).sqrt()
}

/// √(C⁷ / (C⁷ + 25⁷)): 0 for greys, 1 for strong colours.
fn high_chroma(chroma: f64) -> f64 {
    let c7 = chroma.powi(7);
    (c7 / (c7 + 25f64.powi(7))).sqrt()
}

/// Hue angle in radians, [0, 2π); 0 for grey.
fn hue(c: Lab) -> f64 {
    let h = if c.a == 0.0 && c.b == 0.0 { 0.0 } else { atan2(c.b, c.a) };
    if h < 0.0 { h + TAU } else { h }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The 34 pairs of Sharma et al. 2005, Table 1.
    const PAIRS: &str = include_str!("../../../tests/data/ciede2000.csv");

    #[test]
    fn all_published_pairs() {
        let mut pairs = 0;
        for line in PAIRS.lines().skip(1) {
            let v: Vec<f64> = line.split(',').map(|t| t.parse().expect("a number")).collect();
            let (x, y) = (Lab { l: v[0], a: v[1], b: v[2] }, Lab { l: v[3], a: v[4], b: v[5] });
            // The table is rounded to four digits.
            for got in [delta_e_2000(x, y), delta_e_2000(y, x)] {
                assert!((got - v[6]).abs() <= 1e-4, "{line}: {got}");
            }
            pairs += 1;
        }
        assert_eq!(pairs, 34);
    }

    #[test]
    fn white_and_primaries_of_srgb() {
        // The usual L*a*b* of the primaries under D65, from matrices of more digits: with Z = 0.0193 for red, as the standard
        // rounds it, b* of red comes out 0.02 higher.
        for (rgb, want) in [
            ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
            ([1.0, 1.0, 1.0], [100.0, 0.0, 0.0]),
            ([1.0, 0.0, 0.0], [53.24, 80.09, 67.20]),
            ([0.0, 1.0, 0.0], [87.73, -86.18, 83.18]),
            ([0.0, 0.0, 1.0], [32.30, 79.19, -107.86]),
        ] {
            let got = Lab::from_linear_srgb(rgb);
            for (got, want) in [got.l, got.a, got.b].into_iter().zip(want) {
                assert!((got - want).abs() < 0.025, "{rgb:?}: {got} is not {want}");
            }
        }
    }

    #[test]
    fn greys_have_no_hue_and_the_ends_are_100_apart() {
        let grey = |v| Lab::from_linear_srgb([v; 3]);
        for v in [0.001, 0.2, 0.7] {
            assert!(grey(v).a.abs() < 1e-12 && grey(v).b.abs() < 1e-12);
            assert_eq!(delta_e_2000(grey(v), grey(v)), 0.0);
        }
        assert!((delta_e_2000(grey(0.0), grey(1.0)) - 100.0).abs() < 1e-9);
        // L* = 50 is a linear value of ((50 + 16) / 116)³; there one step of L* is one of ΔE, but for the mean of the two.
        let l50 = (66.0f64 / 116.0).powi(3);
        assert!((grey(l50).l - 50.0).abs() < 1e-12);
        let step = delta_e_2000(Lab { l: 50.0, a: 0.0, b: 0.0 }, Lab { l: 51.0, a: 0.0, b: 0.0 });
        let weight = 1.0 + 0.015 * 0.25 / 20.25f64.sqrt();
        assert!((step * weight - 1.0).abs() < 1e-12);
    }
}
