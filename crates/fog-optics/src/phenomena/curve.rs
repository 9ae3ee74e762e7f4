//! A phase function by angle, and where it is high and low.

use crate::error::OpticsError;

/// Positive values by scattering angle.
#[derive(Clone, Copy, Debug)]
pub struct Curve<'a> {
    angles_deg: &'a [f64],
    values: &'a [f64],
}

/// A local extremum, refined by a parabola through three points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremum {
    /// Where, in degrees.
    pub angle_deg: f64,
    /// The curve's value there.
    pub value: f64,
    /// A maximum, or a minimum.
    pub is_maximum: bool,
}

impl<'a> Curve<'a> {
    /// A curve from angles in degrees, ascending within [0, 180], and its values there (in any unit).
    ///
    /// # Errors
    /// If there are fewer than three points, angles do not ascend within [0, 180], or a value is not positive and finite.
    pub fn new(angles_deg: &'a [f64], values: &'a [f64]) -> Result<Self, OpticsError> {
        let refuse =
            |problem: String| Err(OpticsError::Settings(format!("phase function by angle: {problem}")));
        if angles_deg.len() != values.len() || values.len() < 3 {
            let (angles, values) = (angles_deg.len(), values.len());
            return refuse(format!("{angles} angles with {values} values; valid: as many, three or more"));
        }
        let ascends = angles_deg.windows(2).all(|w| w[0] < w[1]);
        if !(ascends && angles_deg[0] >= 0.0 && angles_deg[angles_deg.len() - 1] <= 180.0) {
            return refuse("angles must ascend from 0 or more to 180 degrees or less".into());
        }
        if let Some(i) = values.iter().position(|v| !(*v > 0.0 && v.is_finite())) {
            return refuse(format!("value {} at {} degrees; valid: above 0", values[i], angles_deg[i]));
        }
        Ok(Self { angles_deg, values })
    }

    /// Last angle in degrees.
    #[must_use]
    pub fn last_deg(&self) -> f64 {
        self.angles_deg[self.angles_deg.len() - 1]
    }

    /// Value at an angle in degrees, linear between the points, constant beyond the ends.
    #[must_use]
    pub fn at(&self, angle_deg: f64) -> f64 {
        let (a, v) = (self.angles_deg, self.values);
        let i = a.partition_point(|x| *x <= angle_deg).clamp(1, a.len() - 1);
        let t = ((angle_deg - a[i - 1]) / (a[i] - a[i - 1])).clamp(0.0, 1.0);
        v[i - 1] + (v[i] - v[i - 1]) * t
    }

    /// Local extrema at angles strictly between two angles in degrees, ascending.
    #[must_use]
    pub fn extrema(&self, from_deg: f64, to_deg: f64) -> Vec<Extremum> {
        let (a, v) = (self.angles_deg, self.values);
        (1..a.len() - 1)
            .filter(|&i| a[i] > from_deg && a[i] < to_deg)
            .filter(|&i| (v[i] > v[i - 1]) == (v[i] >= v[i + 1]) && v[i] != v[i - 1])
            .map(|i| {
                // Newton's form of the parabola through the three points.
                let (h0, h1) = (a[i] - a[i - 1], a[i + 1] - a[i]);
                let (s0, s1) = ((v[i] - v[i - 1]) / h0, (v[i + 1] - v[i]) / h1);
                let curvature = (s1 - s0) / (h0 + h1);
                let slope = s0 + curvature * h0;
                let shift = (-0.5 * slope / curvature).clamp(-h0, h1);
                let value = v[i] + shift * (slope + curvature * shift);
                Extremum { angle_deg: a[i] + shift, value, is_maximum: v[i] > v[i - 1] }
            })
            .collect()
    }

    /// The least value at the points between two angles in degrees; none if there is no point between them.
    #[must_use]
    pub fn least(&self, from_deg: f64, to_deg: f64) -> Option<Extremum> {
        (self.angles_deg.iter().zip(self.values))
            .filter(|(a, _)| (from_deg..=to_deg).contains(*a))
            .min_by(|p, q| p.1.total_cmp(q.1))
            .map(|(&angle_deg, &value)| Extremum { angle_deg, value, is_maximum: false })
    }

    /// First angle on the way from one angle to another (in either direction) at which the curve falls below a level.
    pub(super) fn crossing(&self, from_deg: f64, to_deg: f64, level: f64) -> Option<f64> {
        let (low, high) = (from_deg.min(to_deg), from_deg.max(to_deg));
        let mut way: Vec<(f64, f64)> = (self.angles_deg.iter().copied().zip(self.values.iter().copied()))
            .filter(|(a, _)| (low..=high).contains(a))
            .collect();
        if to_deg < from_deg {
            way.reverse();
        }
        let i = way.iter().position(|(_, v)| *v < level)?;
        if i == 0 {
            return Some(way[0].0);
        }
        let ((a0, v0), (a1, v1)) = (way[i - 1], way[i]);
        Some(a0 + (a1 - a0) * (v0 - level) / (v0 - v1))
    }
}
