//! Colours for numbers.

/// Every fifth of the 256 colours of "magma" by N. Smith & S. van der Walt (github.com/BIDS/colormap, 2015, CC0), 0xRRGGBB in
/// sRGB: evenly spaced to the eye and in lightness, from black over purple and orange to pale yellow.
const MAGMA: [u32; 52] = [
    0x000004, 0x02020b, 0x050416, 0x090720, 0x0e0b2b, 0x140e36, 0x1a1042, 0x21114e, 0x29115a, 0x311165,
    0x390f6e, 0x420f75, 0x4a1079, 0x52137c, 0x5a167e, 0x621980, 0x6a1c81, 0x721f81, 0x792282, 0x812581,
    0x892881, 0x912b81, 0x992d80, 0xa1307e, 0xaa337d, 0xb2357b, 0xba3878, 0xc23b75, 0xca3e72, 0xd2426f,
    0xd9466b, 0xe04c67, 0xe75263, 0xec5860, 0xf1605d, 0xf4695c, 0xf7725c, 0xf97b5d, 0xfb8560, 0xfc8e64,
    0xfd9869, 0xfea16e, 0xfeaa74, 0xfeb47b, 0xfebd82, 0xfec68a, 0xfecf92, 0xfed89a, 0xfde2a3, 0xfdebac,
    0xfcf4b6, 0xfcfdbf,
];

/// sRGB bytes for a number from 0 (black) to 1 (pale yellow), clamped to that range.
#[must_use]
pub fn magma(x: f32) -> [u8; 3] {
    let place = x.clamp(0.0, 1.0) * (MAGMA.len() - 1) as f32;
    let low = (place as usize).min(MAGMA.len() - 2);
    let part = place - low as f32;
    let byte = |i: usize, shift: u32| (MAGMA[i] >> shift & 0xff) as f32;
    [16, 8, 0].map(|shift| {
        let (from, to) = (byte(low, shift), byte(low + 1, shift));
        (from + (to - from) * part + 0.5) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::colour::srgb_decode;
    use fog_core::delta_e::Lab;

    #[test]
    fn lightness_rises_evenly() {
        let lightness = |i: u16| {
            let rgb = magma(f32::from(i) / 255.0);
            Lab::from_linear_srgb(rgb.map(|b| f64::from(srgb_decode(f32::from(b) / 255.0)))).l
        };
        let all: Vec<f64> = (0..=255).map(lightness).collect();
        assert!(all[0] < 0.5 && all[255] > 97.0);
        for (i, pair) in all.windows(9).enumerate() {
            let step = (pair[8] - pair[0]) / 8.0;
            assert!((0.1..0.6).contains(&step), "step {step} at {i}");
        }
    }

    #[test]
    fn colours_between_are_those_of_the_original() {
        // Entries 7, 128 and 253 of the 256.
        for (i, want) in [(7, [3, 3, 15]), (128, [183, 55, 121]), (253, [252, 249, 187])] {
            for (got, want) in magma(i as f32 / 255.0).into_iter().zip(want) {
                assert!(got.abs_diff(want) <= 1, "entry {i}: {got} is not {want}");
            }
        }
        assert_eq!((magma(-1.0), magma(2.0)), ([0, 0, 4], [252, 253, 191]));
    }
}
