//! Figures over the pixels of a comparison.

use fog_core::colour::luminance;

use crate::Picture;

/// Statistics of the CIEDE2000 difference over the pixels of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DeltaE {
    /// Mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// 95th percentile, linear between the ordered values (Hyndman & Fan 1996, definition 7; NumPy's default).
    pub p95: f64,
    /// 99th percentile, likewise.
    pub p99: f64,
    /// Largest.
    pub max: f64,
}

/// Differences of luminance in units of their standard error, over the pixels that have one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ZScores {
    /// Number of pixels with a standard error over 0; the others are left out.
    pub pixels: usize,
    /// Mean: near 0 when the pictures agree.
    pub mean: f64,
    /// Root mean square: near 1 when they agree and the errors are right.
    pub rms: f64,
    /// Share of pixels beyond ±3: 0.0027 for normal errors.
    pub beyond_3: f64,
    /// Largest magnitude.
    pub max: f64,
}

impl ZScores {
    /// Of two pictures of radiance of the same size; `None` when no pixel has a standard error.
    pub(super) fn of(a: &Picture, b: &Picture) -> Option<Self> {
        let error = |p: &Picture, i: usize| p.standard_error.as_ref().map_or(0.0, |e| f64::from(e[i]));
        let mut z = ZScores::default();
        let (mut sum, mut squares, mut beyond) = (0.0, 0.0, 0);
        for i in 0..a.rgb.len() {
            let variance = error(a, i).powi(2) + error(b, i).powi(2);
            if variance > 0.0 {
                let y = |p: &Picture| luminance(p.rgb[i].map(f64::from));
                let score = (y(a) - y(b)) / variance.sqrt();
                z.pixels += 1;
                sum += score;
                squares += score * score;
                beyond += usize::from(score.abs() > 3.0);
                z.max = z.max.max(score.abs());
            }
        }
        let n = z.pixels as f64;
        (z.pixels > 0).then(|| ZScores {
            mean: sum / n,
            rms: (squares / n).sqrt(),
            beyond_3: beyond as f64 / n,
            ..z
        })
    }
}

impl DeltaE {
    /// Of a map with at least one pixel.
    pub(super) fn of(map: &[f32]) -> Self {
        let mut sorted = map.to_vec();
        sorted.sort_unstable_by(f32::total_cmp);
        let at = |share: f64| {
            let place = share * (sorted.len() - 1) as f64;
            let (low, part) = (place as usize, place.fract());
            let high = (low + 1).min(sorted.len() - 1);
            let (low, high) = (f64::from(sorted[low]), f64::from(sorted[high]));
            low + (high - low) * part
        };
        Self {
            mean: map.iter().copied().map(f64::from).sum::<f64>() / map.len() as f64,
            median: at(0.5),
            p95: at(0.95),
            p99: at(0.99),
            max: at(1.0),
        }
    }
}
