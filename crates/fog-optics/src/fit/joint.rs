//! All altitudes at once: the coefficients of the shape polynomials that make all counts likeliest.
//!
//! The number density of each altitude is left free (its best value given the shape has a closed form), so that a layer that is
//! denser or thinner than the polynomial of N does not bend the shapes.

use super::altitude::Bounds;
use super::basis::bernstein;
use super::bins::{SHAPES, Shape, Share, deviance_residual, shares};
use super::least_squares::{Effort, Residuals, minimise};
use super::linear::{dot, inverse};
use super::measurements::Bin;

/// Bins of an altitude that take part.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    pub(super) zeta: f64,
    pub(super) bins: Vec<Bin>,
}

impl Layer {
    pub(super) fn droplets(&self) -> f64 {
        self.bins.iter().map(|bin| bin.droplets).sum()
    }

    /// Number density in m⁻³ that gives as many droplets as were measured, for a shape.
    pub(super) fn number(&self, shape: &Shape) -> f64 {
        let mut share = Vec::new();
        shares(shape, &self.bins, &mut share);
        self.droplets() / self.expected(&share)
    }

    /// Sampled volume times share, summed over the bins.
    fn expected(&self, share: &[Share]) -> f64 {
        self.bins.iter().zip(share).map(|(bin, share)| bin.volume_m3 * share.value).sum()
    }

    /// Deviance residuals of the bins for a shape and a number density in m⁻³.
    pub(super) fn residuals(&self, shape: &Shape, number: f64) -> Vec<f64> {
        let mut share = Vec::new();
        shares(shape, &self.bins, &mut share);
        let residual = |(bin, share): (&Bin, &Share)| {
            deviance_residual(bin.droplets, number * bin.volume_m3 * share.value).0
        };
        self.bins.iter().zip(&share).map(residual).collect()
    }
}

/// Bernstein coefficients of the five shape polynomials.
pub(super) type Polynomials = [Vec<f64>; SHAPES];

/// Shape at ζ.
pub(super) fn shape_at(polynomials: &Polynomials, zeta: f64) -> Shape {
    std::array::from_fn(|p| dot(&polynomials[p], &bernstein(polynomials[p].len() - 1, zeta)))
}

/// Polynomials and the covariance of all their coefficients (for counting noise of dispersion 1), in one list.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Joint {
    pub(super) polynomials: Polynomials,
    pub(super) covariance: Vec<Vec<f64>>,
}

struct JointResiduals<'a> {
    layers: &'a [Layer],
    /// Bernstein polynomials at each layer's ζ, by shape parameter.
    bases: Vec<[Vec<f64>; SHAPES]>,
    /// First coefficient of each shape parameter, and the number of all.
    offsets: [usize; SHAPES + 1],
}

impl<'a> JointResiduals<'a> {
    fn new(layers: &'a [Layer], polynomials: &Polynomials) -> Self {
        let mut offsets = [0; SHAPES + 1];
        for p in 0..SHAPES {
            offsets[p + 1] = offsets[p] + polynomials[p].len();
        }
        let basis = |layer: &Layer| polynomials.each_ref().map(|c| bernstein(c.len() - 1, layer.zeta));
        Self { layers, bases: layers.iter().map(basis).collect(), offsets }
    }

    fn split(&self, parameters: &[f64]) -> Polynomials {
        std::array::from_fn(|p| parameters[self.offsets[p]..self.offsets[p + 1]].to_vec())
    }

    /// Calls `visit` with the index of each residual, its bin, the bin's expected droplets, and their derivatives by the
    /// shape parameters together with the layer's bases.
    fn visit(&self, parameters: &[f64], mut visit: impl FnMut(usize, &Bin, f64, Shape, &[Vec<f64>; SHAPES])) {
        let mut index = 0;
        let mut share = Vec::new();
        for (layer, basis) in self.layers.iter().zip(&self.bases) {
            let shape: Shape =
                std::array::from_fn(|p| dot(&parameters[self.offsets[p]..self.offsets[p + 1]], &basis[p]));
            shares(&shape, &layer.bins, &mut share);
            let expected = layer.expected(&share);
            let number = layer.droplets() / expected;
            let mut drift = [0.0; SHAPES];
            for (bin, share) in layer.bins.iter().zip(&share) {
                for (drift, slope) in drift.iter_mut().zip(share.by_shape) {
                    *drift += bin.volume_m3 * slope / expected;
                }
            }
            for (bin, share) in layer.bins.iter().zip(&share) {
                let sampled = number * bin.volume_m3;
                let slopes = std::array::from_fn(|p| sampled * (share.by_shape[p] - share.value * drift[p]));
                visit(index, bin, sampled * share.value, slopes, basis);
                index += 1;
            }
        }
    }

    /// Covariance from Fisher's information, Σ ∂m ∂m / m.
    fn covariance(&self, parameters: &[f64]) -> Option<Vec<Vec<f64>>> {
        let n = self.offsets[SHAPES];
        let mut information = vec![vec![0.0; n]; n];
        let mut gradient = vec![0.0; n];
        self.visit(parameters, |_, _, mean, slopes, basis| {
            for p in 0..SHAPES {
                for (k, b) in basis[p].iter().enumerate() {
                    gradient[self.offsets[p] + k] = slopes[p] * b;
                }
            }
            for i in 0..n {
                for j in 0..n {
                    information[i][j] += gradient[i] * gradient[j] / mean;
                }
            }
        });
        inverse(&information)
    }
}

impl Residuals for JointResiduals<'_> {
    fn count(&self) -> usize {
        self.layers.iter().map(|layer| layer.bins.len()).sum()
    }

    fn evaluate(&self, parameters: &[f64], residuals: &mut [f64], mut columns: Option<&mut [Vec<f64>]>) {
        self.visit(parameters, |i, bin, mean, slopes, basis| {
            let (residual, by_mean) = deviance_residual(bin.droplets, mean);
            residuals[i] = residual;
            if let Some(columns) = columns.as_deref_mut() {
                for p in 0..SHAPES {
                    for (k, b) in basis[p].iter().enumerate() {
                        columns[self.offsets[p] + k][i] = by_mean * slopes[p] * b;
                    }
                }
            }
        });
    }
}

/// Refines polynomials of the same degrees from `start`; `None` if the counts do not determine them.
pub(super) fn refine(
    layers: &[Layer],
    start: &Polynomials,
    bounds: &Bounds,
    effort: Effort,
) -> Option<Joint> {
    let residuals = JointResiduals::new(layers, start);
    // Coefficients between the bounds keep the polynomial between them.
    let limits: Vec<[f64; 2]> =
        (0..SHAPES).flat_map(|p| std::iter::repeat_n(bounds.0[p], start[p].len())).collect();
    let flat: Vec<f64> = start.iter().flatten().copied().collect();
    let end = minimise(&residuals, &flat, &limits, effort)?;
    let covariance = residuals.covariance(&end.parameters)?;
    Some(Joint { polynomials: residuals.split(&end.parameters), covariance })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_residuals() {
        let bins = |droplets: [f64; 4]| -> Vec<Bin> {
            (0..4)
                .map(|i| Bin {
                    low_um: 2.0 + 3.0 * i as f64,
                    high_um: 5.0 + 3.0 * i as f64,
                    droplets: droplets[i],
                    volume_m3: 1e-4,
                    line: 0,
                    rows: 1,
                })
                .collect()
        };
        let layers = [
            Layer { zeta: 0.2, bins: bins([90.0, 150.0, 70.0, 0.0]) },
            Layer { zeta: 0.9, bins: bins([10.0, 60.0, 200.0, 33.0]) },
        ];
        let start = [vec![2.0, 2.2], vec![0.8], vec![5.0, 8.0, 12.0], vec![1.5, 2.5], vec![0.1]];
        let residuals = JointResiduals::new(&layers, &start);
        let at: Vec<f64> = start.iter().flatten().copied().collect();
        let mut columns = vec![vec![0.0; 8]; at.len()];
        let mut r = [vec![0.0; 8], vec![0.0; 8]];
        residuals.evaluate(&at, &mut r[0], Some(&mut columns));
        let residuals_of = |l: &Layer| {
            let shape = shape_at(&start, l.zeta);
            l.residuals(&shape, l.number(&shape))
        };
        let by_layer: Vec<f64> = layers.iter().flat_map(residuals_of).collect();
        assert!(by_layer.iter().zip(&r[0]).all(|(a, b)| (a - b).abs() < 1e-12));
        for p in 0..at.len() {
            let mut moved = at.clone();
            moved[p] += 1e-6;
            residuals.evaluate(&moved, &mut r[0], None);
            moved[p] -= 2e-6;
            residuals.evaluate(&moved, &mut r[1], None);
            for i in 0..8 {
                let slope = (r[0][i] - r[1][i]) / 2e-6;
                assert!((slope - columns[p][i]).abs() < 1e-6, "coefficient {p}, residual {i}");
            }
        }
    }
}
