//! Where the fit of a spectrum starts.

use super::bins::Shape;
use super::measurements::Bin;
use fog_core::math::f64::ln;

/// Shapes to start from, made from the spectrum's most frequent diameter and its quartiles.
pub(super) fn starts(bins: &[Bin]) -> Vec<Shape> {
    let [q1, q2, q3] = [0.25, 0.5, 0.75].map(|share| quantile(bins, share));
    let densest = |best: &Bin, bin: &Bin| bin.density_1_m3_um() > best.density_1_m3_um();
    let mode = bins.iter().fold(bins[0], |best, bin| if densest(&best, bin) { *bin } else { best });
    let mode = 0.5 * (mode.low_um + mode.high_um);
    let mut starts = Vec::new();
    for centre in [mode, q2, q3] {
        for (mu_l, sigma_l) in [(q2, 0.8), (q1, 0.5), (q3, 0.9)] {
            starts.push([ln(mu_l), sigma_l, centre, 0.25 * centre, 0.0]);
        }
    }
    starts.push([ln(q2), 0.8, mode, 0.12 * mode, -1.0]);
    starts
}

/// Diameter in µm below which a share of the measured droplets lies, linear within bins.
fn quantile(bins: &[Bin], share: f64) -> f64 {
    let number = |bin: &Bin| bin.droplets / bin.volume_m3;
    let mut left = share * bins.iter().map(number).sum::<f64>();
    for bin in bins {
        if number(bin) >= left && number(bin) > 0.0 {
            return (bin.low_um + bin.width_um() * left / number(bin)).max(0.1);
        }
        left -= number(bin);
    }
    bins[bins.len() - 1].high_um
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_lie_where_the_droplets_are() {
        let bin = |i: usize, droplets: f64| Bin {
            low_um: 2.0 + 3.0 * i as f64,
            high_um: 5.0 + 3.0 * i as f64,
            droplets,
            volume_m3: 1e-4,
            line: 0,
            rows: 1,
        };
        let bins = [bin(0, 100.0), bin(1, 200.0), bin(2, 100.0), bin(3, 0.0)];
        assert!((quantile(&bins, 0.25) - 5.0).abs() < 1e-12 && (quantile(&bins, 0.5) - 6.5).abs() < 1e-12);
        let starts = starts(&bins);
        assert_eq!(starts.len(), 10);
        assert!(starts.iter().all(|s| (5.0..=8.0).contains(&s[2]) && s[1] > 0.0 && s[3] > 0.0));
        assert_eq!(starts[0][2], 6.5, "the middle of the densest bin");
    }
}
