//! Axes: from values to the unit interval, with ticks and their labels.

use super::text::superscript;
use fog_core::math::f64::ln;

/// How values are spread over an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scale {
    Linear,
    Log,
}

/// One axis: its label with unit, its range and its ticks.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub(crate) label: String,
    pub(crate) range: [f64; 2],
    scale: Scale,
    /// (value, label).
    pub(crate) ticks: Vec<(f64, String)>,
    /// Values of unlabelled ticks.
    pub(crate) minor: Vec<f64>,
}

impl Axis {
    /// A linear axis over exactly this range.
    pub(crate) fn linear(label: &str, low: f64, high: f64) -> Self {
        let (step, decimals) = nice_step((high - low) / 6.0);
        let first = (low / step - 1e-9).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        let ticks = (first..=last)
            .map(|i| {
                let value = i as f64 * step;
                (value, format!("{value:.decimals$}").replace('-', "−"))
            })
            .collect();
        Self { label: label.to_owned(), range: [low, high], scale: Scale::Linear, ticks, minor: Vec::new() }
    }

    /// A linear axis from 0 to a little above the greatest of `values`.
    pub(crate) fn from_zero(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let top = values.into_iter().filter(|v| v.is_finite()).fold(0.0, f64::max);
        Self::linear(label, 0.0, if top > 0.0 { 1.06 * top } else { 1.0 })
    }

    /// A linear axis over the range of `values` and a margin.
    pub(crate) fn over(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let [low, high] = extent(values);
        let margin = if high > low { 0.06 * (high - low) } else { 0.1 * low.abs().max(1.0) };
        Self::linear(label, low - margin, high + margin)
    }

    /// A logarithmic axis over exactly this range, 0 < low < high.
    pub(crate) fn log(label: &str, low: f64, high: f64) -> Self {
        let (first, last) = (log10(low).floor() as i32, log10(high).ceil() as i32);
        let decades = log10(high) - log10(low);
        let inside = |v: f64| v >= low * (1.0 - 1e-9) && v <= high * (1.0 + 1e-9);
        let every = if decades > 14.0 {
            4
        } else if decades > 7.0 {
            2
        } else {
            1
        };
        let plain = first >= -2 && last <= 4;
        let (mut ticks, mut minor) = (Vec::new(), Vec::new());
        for exponent in first..=last {
            let decade = ten_to(exponent);
            for digit in 1..10 {
                let value = f64::from(digit) * decade;
                let labelled = match digit {
                    1 => exponent.rem_euclid(every) == 0,
                    2 | 5 => decades < 1.6,
                    3 => (1.6..2.2).contains(&decades),
                    _ => false,
                };
                if !inside(value) {
                } else if labelled {
                    let label = if plain {
                        format!("{value:.*}", usize::try_from(-exponent).unwrap_or(0))
                    } else if digit == 1 {
                        format!("10{}", superscript(exponent))
                    } else {
                        format!("{digit}·10{}", superscript(exponent))
                    };
                    ticks.push((value, label));
                } else {
                    minor.push(value);
                }
            }
        }
        Self { label: label.to_owned(), range: [low, high], scale: Scale::Log, ticks, minor }
    }

    /// A logarithmic axis that holds the positive ones of `values`, its ends at 1, 2 or 5 times a power of ten.
    pub(crate) fn log_over(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let [low, high] = extent(values.into_iter().filter(|v| *v > 0.0));
        let (first, last) = (ten_to(log10(low).floor() as i32), ten_to(log10(high).floor() as i32));
        let below = [5.0, 2.0].map(|d| d * first).into_iter().find(|&v| v <= low).unwrap_or(first);
        let above = [1.0, 2.0, 5.0].map(|d| d * last).into_iter().find(|&v| v >= high && v > below);
        Self::log(label, below, above.unwrap_or(10.0 * last))
    }

    /// The axis with these ticks in the place of its own.
    pub(crate) fn ticked(mut self, ticks: &[f64]) -> Self {
        self.ticks = ticks.iter().map(|&v| (v, format!("{v}").replace('-', "−"))).collect();
        self.minor.clear();
        self
    }

    /// Place of a value, 0 at the low end and 1 at the high one; none for values that the axis has no place for.
    pub(crate) fn place(&self, value: f64) -> Option<f64> {
        let [low, high] = self.range;
        let t = match self.scale {
            Scale::Linear => (value - low) / (high - low),
            Scale::Log if value > 0.0 => ln(value / low) / ln(high / low),
            Scale::Log => return None,
        };
        t.is_finite().then_some(t)
    }
}

fn extent(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let finite = values.into_iter().filter(|v| v.is_finite());
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
    if low <= high { [low, high] } else { [1.0, 10.0] }
}

fn log10(x: f64) -> f64 {
    ln(x) / core::f64::consts::LN_10
}

/// 10 to a power, the nearest number to it.
fn ten_to(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// The least of 1, 2, 2.5, 5 times a power of ten that is not below `least`, and the decimals that its multiples need.
fn nice_step(least: f64) -> (f64, usize) {
    let exponent = (log10(least) - 1e-9).floor() as i32;
    for (digit, extra) in [(1.0, 0), (2.0, 0), (2.5, 1), (5.0, 0), (10.0, -1)] {
        let step = digit * ten_to(exponent);
        if step >= least * (1.0 - 1e-9) {
            return (step, usize::try_from(extra - exponent).unwrap_or(0));
        }
    }
    (10.0 * ten_to(exponent), 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|t| t.1.as_str()).collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        assert_eq!(labels(&Axis::linear("", 0.0, 60.0)), ["0", "10", "20", "30", "40", "50", "60"]);
        assert_eq!(labels(&Axis::linear("", -0.1, 0.2))[0], "−0.10");
        let axis = Axis::from_zero("", [0.3, f64::INFINITY, 0.241]);
        assert!(axis.range[1] > 0.3 && axis.range[1] < 0.4, "{axis:?}");
        assert_eq!(Axis::from_zero("", []).range[0], 0.0);
    }

    #[test]
    fn log_ticks_are_decades() {
        let axis = Axis::log_over("", [3e-5, 0.0, 15.0]);
        assert_eq!(labels(&axis), ["10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"]);
        assert!((axis.range[0] - 2e-5).abs() < 1e-18 && axis.range[1] == 20.0, "{axis:?}");
        assert_eq!(Axis::log_over("", [1.0, 1.0]).range, [1.0, 2.0]);
        assert_eq!(labels(&Axis::log("", 0.1, 1000.0)), ["0.1", "1", "10", "100", "1000"]);
        assert_eq!(labels(&Axis::log("", 300.0, 2500.0)), ["500", "1000", "2000"]);
    }

    #[test]
    fn places_run_from_0_to_1() {
        let axis = Axis::log("", 1.0, 100.0);
        assert!((axis.place(10.0).unwrap() - 0.5).abs() < 1e-12);
        assert_eq!((axis.place(1.0), axis.place(0.0), axis.place(f64::NAN)), (Some(0.0), None, None));
        assert_eq!(Axis::linear("", 2.0, 4.0).place(3.0), Some(0.5));
        assert_eq!(Axis::linear("", 2.0, 4.0).place(f64::INFINITY), None);
    }
}
