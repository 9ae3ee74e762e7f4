//! Wavelength samples of one path and the values that it carries at them.

use crate::math;
use crate::optics_table::MAX_COLUMNS;
use core::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, MulAssign, Sub};

/// Wavelengths that one path carries: lane 0 is the hero, the others its companions (Wilkie et al. 2014).
pub const LANES: usize = 8;

/// Values at the wavelengths of one path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Spectrum(pub [f32; LANES]);

impl Spectrum {
    /// All lanes 0.
    pub const ZERO: Self = Self([0.0; LANES]);
    /// All lanes 1.
    pub const ONE: Self = Self([1.0; LANES]);

    /// All lanes `x`.
    #[inline(always)]
    #[must_use]
    pub const fn splat(x: f32) -> Self {
        Self([x; LANES])
    }

    /// Applies `f` to each lane.
    #[inline(always)]
    #[must_use]
    pub fn map(self, f: impl Fn(f32) -> f32) -> Self {
        let mut out = self;
        for x in &mut out.0 {
            *x = f(*x);
        }
        out
    }

    /// Applies `f` to each pair of lanes.
    #[inline(always)]
    #[must_use]
    pub fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let mut out = self;
        for (x, y) in out.0.iter_mut().zip(&other.0) {
            *x = f(*x, *y);
        }
        out
    }

    /// exp(−x) of each lane ([`math::fast_exp`]).
    #[inline(always)]
    #[must_use]
    pub fn exp_neg(self) -> Self {
        self.map(|x| math::fast_exp(-x))
    }

    /// Mean over the lanes.
    #[inline(always)]
    #[must_use]
    pub fn mean(self) -> f32 {
        let a = self.0;
        (((a[0] + a[4]) + (a[1] + a[5])) + ((a[2] + a[6]) + (a[3] + a[7]))) * (1.0 / LANES as f32)
    }

    /// Largest lane.
    #[inline(always)]
    #[must_use]
    pub fn max_lane(self) -> f32 {
        self.0.iter().fold(f32::NEG_INFINITY, |a, &b| if b > a { b } else { a })
    }

    /// True if every lane is exactly 0.
    #[inline(always)]
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.0.iter().all(|&x| x == 0.0)
    }
}

macro_rules! lanewise {
    ($trait:ident, $method:ident, $op:tt) => {
        impl $trait for Spectrum {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, |a, b| a $op b)
            }
        }
    };
}
lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

impl Mul<f32> for Spectrum {
    type Output = Self;
    #[inline(always)]
    fn mul(self, k: f32) -> Self {
        self.map(|x| x * k)
    }
}

impl AddAssign for Spectrum {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl MulAssign for Spectrum {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl MulAssign<f32> for Spectrum {
    #[inline(always)]
    fn mul_assign(&mut self, k: f32) {
        *self = *self * k;
    }
}

impl Index<usize> for Spectrum {
    type Output = f32;
    #[inline(always)]
    fn index(&self, i: usize) -> &f32 {
        &self.0[i]
    }
}

impl IndexMut<usize> for Spectrum {
    #[inline(always)]
    fn index_mut(&mut self, i: usize) -> &mut f32 {
        &mut self.0[i]
    }
}

/// The wavelengths of one path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wavelengths {
    /// Wavelength of each lane in nm; lane 0 is the hero.
    pub nm: [f32; LANES],
}

impl Wavelengths {
    /// All lanes at one wavelength: a monochromatic rendering.
    #[must_use]
    pub const fn monochromatic(nm: f32) -> Self {
        Self { nm: [nm; LANES] }
    }
}

/// Where each lane falls between the rows of a table over wavelength: row `index` with weight 1 − `weight`, the next one
/// with `weight`.
#[derive(Clone, Copy, Debug)]
pub struct LaneWeights {
    /// Lower row of each lane.
    pub index: [u32; LANES],
    /// Weight of the row above it.
    pub weight: [f32; LANES],
}

impl LaneWeights {
    /// Finds `wavelengths` in ascending `rows_nm`, clamped at both ends. One row serves every wavelength.
    #[must_use]
    pub fn new(rows_nm: &[f64], wavelengths: &Wavelengths) -> Self {
        let mut index = [0; LANES];
        let mut weight = [0.0; LANES];
        if rows_nm.len() > 1 {
            for lane in 0..LANES {
                let nm = f64::from(wavelengths.nm[lane]);
                let upper = rows_nm.partition_point(|&r| r <= nm).clamp(1, rows_nm.len() - 1);
                index[lane] = (upper - 1) as u32;
                let t = (nm - rows_nm[upper - 1]) / (rows_nm[upper] - rows_nm[upper - 1]);
                weight[lane] = t.clamp(0.0, 1.0) as f32;
            }
        }
        Self { index, weight }
    }

    /// Values of all lanes from a row over wavelength.
    #[inline(always)]
    #[must_use]
    pub fn gather(&self, row: &[f32; MAX_COLUMNS]) -> Spectrum {
        let mut out = Spectrum::ZERO;
        for lane in 0..LANES {
            // The mask is no change to an index of a valid table, and saves the check.
            let i = self.index[lane] as usize & (MAX_COLUMNS - 1);
            let (a, b) = (row[i], row[(i + 1) & (MAX_COLUMNS - 1)]);
            out[lane] = a + (b - a) * self.weight[lane];
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_interpolate_and_clamp() {
        let w = Wavelengths { nm: [400.0, 410.0, 425.0, 450.0, 500.0, 300.0, 900.0, 475.0] };
        let lanes = LaneWeights::new(&[400.0, 450.0, 500.0], &w);
        let mut row = [0.0; MAX_COLUMNS];
        row[..3].copy_from_slice(&[1.0, 2.0, 4.0]);
        assert_eq!(lanes.gather(&row).0, [1.0, 1.2, 1.5, 2.0, 4.0, 1.0, 4.0, 3.0]);
        assert_eq!(LaneWeights::new(&[550.0], &w).gather(&row), Spectrum::splat(1.0));
    }

    #[test]
    fn mean_counts_every_lane_once() {
        assert_eq!(Spectrum([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]).mean(), 4.5);
    }
}
