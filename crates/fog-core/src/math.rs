//! Transcendental functions with the same bits on every machine.
//!
//! `std` forwards `exp`, `sin`, … to the platform's libm, whose last bits differ between systems and even between CPUs of
//! one system. Fogbank promises the same bytes for the same plan everywhere, so these come from the pure-Rust `libm`
//! crate, or are written here from IEEE basic operations only (never fused), so that vectorised and scalar code agree.

pub use core::f32::consts::{FRAC_1_PI as INV_PI_F32, PI as PI_F32, TAU as TAU_F32};
pub use core::f64::consts::{PI, TAU};

macro_rules! forward {
    ($($name:ident($($arg:ident),*) = $f32:ident / $f64:ident: $doc:literal;)*) => {
        /// Single precision.
        pub mod f32 {
            $(#[doc = $doc] #[inline] #[must_use] pub fn $name($($arg: f32),*) -> f32 { libm::$f32($($arg),*) })*
        }
        /// Double precision.
        pub mod f64 {
            $(#[doc = $doc] #[inline] #[must_use] pub fn $name($($arg: f64),*) -> f64 { libm::$f64($($arg),*) })*
        }
    };
}

forward! {
    exp(x) = expf / exp: "Natural exponential.";
    ln(x) = logf / log: "Natural logarithm.";
    sin(x) = sinf / sin: "Sine of an angle in radians.";
    cos(x) = cosf / cos: "Cosine of an angle in radians.";
    tan(x) = tanf / tan: "Tangent of an angle in radians.";
    acos(x) = acosf / acos: "Arc cosine in radians.";
    asin(x) = asinf / asin: "Arc sine in radians.";
    atan2(y, x) = atan2f / atan2: "Angle of the vector (x, y) in radians.";
    pow(x, y) = powf / pow: "x to the power y.";
    cbrt(x) = cbrtf / cbrt: "Cube root.";
    erf(x) = erff / erf: "Error function.";
    ln_gamma(x) = lgammaf / lgamma: "Logarithm of the absolute value of the gamma function.";
    bessel_j1(x) = j1f / j1: "Bessel function of the first kind, of order 1.";
    ln_1p(x) = log1pf / log1p: "Natural logarithm of 1 + x, exact for small x.";
}

/// exp(x) in single precision for the hot loop: relative error below 1.5e-7 for x in [-87, 88]; 0 below, clamped above.
///
/// Branch-free, so that a loop over lanes vectorises; Cephes' polynomial on [-ln2/2, ln2/2].
#[inline(always)]
#[must_use]
pub fn fast_exp(x: f32) -> f32 {
    const LOG2_E: f32 = core::f32::consts::LOG2_E;
    const ROUND: f32 = 12_582_912.0; // 1.5 * 2^23: adding and subtracting it rounds to the nearest integer
    let c = x.clamp(-87.0, 88.0);
    let shifted = c * LOG2_E + ROUND;
    let n = shifted - ROUND;
    let r = (c - n * 0.693_359_4) - n * -2.121_944_4e-4;
    let p = 1.987_569_1e-4;
    let p = p * r + 1.398_199_9e-3;
    let p = p * r + 8.333_452e-3;
    let p = p * r + 4.166_579_6e-2;
    let p = p * r + 1.666_666_5e-1;
    let p = p * r + 0.5;
    let y = p * r * r + r + 1.0;
    let scale = f32::from_bits((((n as i32) + 127) << 23) as u32);
    if x < -87.0 { 0.0 } else { y * scale }
}

/// (sin, cos) of 2πt for t in [0, 1], absolute error below 4e-7: IEEE basic operations only, for azimuths in the hot loop.
#[inline(always)]
#[must_use]
pub fn sin_cos_turns(t: f32) -> (f32, f32) {
    // Quarter turns: quadrant q and the angle r in [-1/8, 1/8] turns from its middle axis.
    let q = (t * 4.0 + 0.5) as u32;
    let x = (t - 0.25 * q as f32) * TAU_F32;
    let x2 = x * x;
    // Taylor series on [-π/4, π/4]: the first terms left out are below 4e-8.
    let sin = x + x * x2 * (-1.0 / 6.0 + x2 * (1.0 / 120.0 - x2 * (1.0 / 5040.0)));
    let cos = 1.0 - x2 * (0.5 - x2 * (1.0 / 24.0 - x2 * (1.0 / 720.0 - x2 * (1.0 / 40320.0))));
    match q & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// −ln(u) for u in (0, 1], relative error below 1e-9: the optical depth of a free flight. IEEE basic operations only.
#[inline(always)]
#[must_use]
pub fn neg_ln(u: f64) -> f64 {
    // u = 2^e · f with f in [√½, √2): ln f = 2 artanh((f − 1) / (f + 1)), whose series needs no table.
    let shifted = u.to_bits().wrapping_sub(0x3fe6_a09e_667f_3bcd);
    let e = (shifted as i64 >> 52) as f64;
    let f = f64::from_bits((shifted & 0x000f_ffff_ffff_ffff).wrapping_add(0x3fe6_a09e_667f_3bcd));
    let s = (f - 1.0) / (f + 1.0);
    let s2 = s * s;
    let p = 1.0 / 3.0
        + s2 * (1.0 / 5.0 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0 + s2 * (1.0 / 11.0 + s2 * (1.0 / 13.0)))));
    -(e * core::f64::consts::LN_2 + 2.0 * s * (1.0 + s2 * p))
}

/// cos(2πt) for |t| < 2^50 turns, absolute error below 6e-16 (so that it can exceed 1 by as much): IEEE basic operations
/// only and free of branches, so that a loop over lanes vectorises and gives the same bits in scalar code.
#[inline(always)]
#[must_use]
pub fn cos_turns(t: f64) -> f64 {
    const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5 * 2^52: adding and subtracting it rounds to the nearest integer
    // Taylor series of sin(2πb) on [-1/4, 1/4]; the first term left out is below 3e-16 there.
    const SINE: [f64; 10] = [
        TAU,
        -41.341_702_240_399_76,
        81.605_249_276_075_06,
        -76.705_859_753_061_39,
        42.058_693_944_897_655,
        -15.094_642_576_822_99,
        3.819_952_584_848_282,
        -0.718_122_301_778_500_6,
        0.104_229_162_208_139_84,
        -0.012_031_585_942_120_627,
    ];
    let turn = t - ((t + ROUND) - ROUND);
    let b = 0.25 - turn.abs();
    let b2 = b * b;
    let mut sum = SINE[9];
    for c in SINE[..9].iter().rev() {
        sum = sum * b2 + c;
    }
    sum * b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fast_exp_is_accurate_to_a_few_ulp() {
        let mut worst = 0.0f64;
        for i in 0..200_000 {
            let x = -87.0 + 175.0 * (i as f32) / 200_000.0;
            let exact = f64::exp(f64::from(x));
            worst = worst.max((f64::from(fast_exp(x)) / exact - 1.0).abs());
        }
        assert!(worst < 1.5e-7, "relative error {worst}");
        assert_eq!(fast_exp(-200.0), 0.0);
        assert_eq!(fast_exp(f32::NEG_INFINITY), 0.0);
        assert_eq!(fast_exp(0.0), 1.0);
    }

    #[test]
    fn cos_turns_is_a_cosine() {
        let mut worst = 0.0f64;
        for i in -20_000..20_000 {
            let t = f64::from(i) / 7919.0;
            worst = worst.max((cos_turns(t) - f64::cos(TAU * (t - t.round()))).abs());
        }
        assert!(worst < 6e-16, "{worst:e}");
        assert!((cos_turns(1e6 + 0.5) + 1.0).abs() < 6e-16);
        assert_eq!(cos_turns(0.25), 0.0);
        assert_eq!(cos_turns(-3.75), 0.0);
    }

    #[test]
    fn flights_and_azimuths_are_accurate() {
        let mut worst = [0.0f64; 2];
        for i in 1..=200_000 {
            let t = f64::from(i) / 200_000.0;
            let (sin, cos) = sin_cos_turns(t as f32);
            let exact = (f64::sin(TAU * f64::from(t as f32)), f64::cos(TAU * f64::from(t as f32)));
            worst[0] = worst[0].max((f64::from(sin) - exact.0).abs()).max((f64::from(cos) - exact.1).abs());
            for u in [t, t * 1e-9, 1.0 - t * 1e-9] {
                let exact = -f64::ln(u);
                worst[1] = worst[1].max((neg_ln(u) - exact).abs() / exact.max(1e-300));
            }
        }
        assert!(worst[0] < 4e-7 && worst[1] < 1e-9, "{worst:?}");
        assert_eq!(neg_ln(1.0), 0.0);
    }

    #[test]
    fn bits_are_pinned() {
        // A change here changes every data set: log it in CHANGELOG as value-breaking.
        assert_eq!(fast_exp(-1.0).to_bits(), 0x3ebc_5ab2);
        assert_eq!(f64::exp(-1.0).to_bits(), 0x3fd7_8b56_362c_ef38);
        assert_eq!(f32::ln(0.3).to_bits(), 0xbf9a_1bc8);
    }
}
