//! A Henyey–Greenstein forward peak blended with Draine's function (Jendersie & d'Eon, SIGGRAPH Talks 2023).

use super::{Draine, HenyeyGreenstein, PhaseError, check};

/// (1 − w) · Henyey–Greenstein + w · Draine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HgDraine {
    hg: HenyeyGreenstein,
    draine: Draine,
    w_draine: f64,
}

impl HgDraine {
    /// The mixture in which Draine's function has the share `w_draine`.
    ///
    /// # Errors
    /// Unless 0 ≤ `w_draine` ≤ 1.
    pub fn new(hg: HenyeyGreenstein, draine: Draine, w_draine: f64) -> Result<Self, PhaseError> {
        check((0.0..=1.0).contains(&w_draine), "share of Draine's function", w_draine, "0 to 1")?;
        Ok(Self { hg, draine, w_draine })
    }

    /// Mean cosine of the scattering angle.
    #[must_use]
    pub fn mean_cosine(&self) -> f64 {
        (1.0 - self.w_draine) * self.hg.mean_cosine() + self.w_draine * self.draine.mean_cosine()
    }

    /// Value in 1/sr for m = 1 − cos θ.
    #[must_use]
    pub fn eval(&self, m: f64) -> f64 {
        (1.0 - self.w_draine) * self.hg.eval(m) + self.w_draine * self.draine.eval(m)
    }

    /// Density of [`HgDraine::sample`] in 1/sr: the value itself.
    #[must_use]
    pub fn pdf(&self, m: f64) -> f64 {
        self.eval(m)
    }

    /// Samples m for `u` and `pick`, uniform in [0, 1): `pick` chooses the part, whose distribution is inverted at `u`.
    #[must_use]
    pub fn sample(&self, u: f64, pick: f64) -> f64 {
        if pick < self.w_draine { self.draine.sample(u) } else { self.hg.sample(u) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_are_weighted() {
        let (hg, draine) = (HenyeyGreenstein::new(0.9).unwrap(), Draine::new(0.5, 20.0).unwrap());
        let p = HgDraine::new(hg, draine, 0.25).unwrap();
        let want = |a: f64, b: f64| 0.75 * a + 0.25 * b;
        assert_eq!(p.eval(0.3), want(hg.eval(0.3), draine.eval(0.3)));
        assert_eq!(p.mean_cosine(), want(0.9, draine.mean_cosine()));
        assert_eq!([p.sample(0.4, 0.2), p.sample(0.4, 0.3)], [draine.sample(0.4), hg.sample(0.4)]);
        assert!(HgDraine::new(hg, draine, 1.01).is_err() && HgDraine::new(hg, draine, f64::NAN).is_err());
    }
}
