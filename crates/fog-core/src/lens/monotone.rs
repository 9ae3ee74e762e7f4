//! Inverses of increasing functions of one variable.

/// x in [0, `most`] with f(x) = y, for f with f(0) = 0 that increases there; `None` if f does not reach y. `f` gives value
/// and derivative. Newton's steps, halved intervals where they leave the bracket; exact to rounding.
pub(super) fn invert(y: f64, most: f64, f: impl Fn(f64) -> [f64; 2]) -> Option<f64> {
    if y <= 0.0 {
        return (y == 0.0).then_some(0.0);
    }
    let (mut low, mut high) = (0.0, most);
    if f(high)[0] < y {
        return None;
    }
    let mut x = y.min(most);
    // Newton doubles its digits each time; halving alone would need 60 steps.
    for _ in 0..100 {
        let [value, slope] = f(x);
        let error = value - y;
        if error == 0.0 {
            break;
        }
        if error > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let newton = x - error / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= f64::EPSILON * x {
            x = next;
            break;
        }
        x = next;
    }
    Some(x)
}

/// Least x in (0, `end`] at which `f` is no longer positive, found between steps of a thousandth of 1 + x and then by
/// halving: `f` is still positive there. `None` if there is none.
pub(super) fn end_of_positive(end: f64, f: impl Fn(f64) -> f64) -> Option<f64> {
    let (mut low, mut high) = (0.0, 0.0);
    while f(high) > 0.0 {
        if high >= end {
            return None;
        }
        low = high;
        high = (high + 1e-3 * (1.0 + high)).min(end);
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low)
}
