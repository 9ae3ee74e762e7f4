//! Point-spread functions: how a lens spreads the light of a point over pixels.

use fog_core::colour::Rgb;
use fog_core::math::{PI, f64 as m};

/// Farthest that light is spread, in pixels.
pub const MOST_RADIUS: usize = 64;
/// Pixels of a kernel are averaged over so many points across.
const POINTS: usize = 9;

/// Weights of the pixels around one, which add up to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    radius: usize,
    weights: Weights,
}

#[derive(Clone, Debug, PartialEq)]
enum Weights {
    /// The same in x and in y: 2 radius + 1 of them.
    Separable(Vec<f64>),
    /// (2 radius + 1)², row by row.
    Square(Vec<f64>),
}

impl Kernel {
    /// A Gaussian of standard deviation `sigma_px`, averaged over pixels, cut off at 4 standard deviations; what is beyond
    /// (1e-4) is put back in proportion. The pixel's own area adds to the width: the variance is σ² + 1/12 px².
    #[must_use]
    pub fn gaussian(sigma_px: f64) -> Self {
        let radius = ((4.0 * sigma_px).ceil() as usize).clamp(1, MOST_RADIUS);
        let below = |x: f64| 0.5 * (1.0 + m::erf(x / (sigma_px * core::f64::consts::SQRT_2)));
        let weight = |i: usize| {
            let x = i as f64 - radius as f64;
            below(x + 0.5) - below(x - 0.5)
        };
        let mut weights: Vec<f64> = (0..=2 * radius).map(weight).collect();
        normalise(&mut weights);
        Self { radius, weights: Weights::Separable(weights) }
    }

    /// Airy's disc of a lens without errors: (2 J₁(x)/x)² with x = π r / (λ N) (Born & Wolf, "Principles of Optics", sec. 8.5.2),
    /// averaged over pixels, out to ten dark rings (2 % of the light is beyond: J₀² + J₁²) or
    /// [`MOST_RADIUS`] pixels; what is beyond is put back in proportion.
    #[must_use]
    pub fn airy(wavelength_um: f64, f_number: f64, pixel_um: f64) -> Self {
        let scale = PI * pixel_um / (wavelength_um * f_number);
        let radius = ((10.25 * PI / scale).ceil() as usize).clamp(1, MOST_RADIUS);
        let intensity = |x: f64, y: f64| {
            let r = scale * (x * x + y * y).sqrt();
            if r < 1e-6 { 1.0 } else { (2.0 * m::bessel_j1(r) / r).powi(2) }
        };
        // More points where rings are narrower than a pixel.
        let points = POINTS * (1 + (scale / PI) as usize).min(6);
        let side = 2 * radius + 1;
        let offset = |k: usize| (k as f64 + 0.5) / points as f64 - 0.5;
        let mean = |x: usize, y: usize| {
            let all = (0..points * points).map(|k| {
                let (dx, dy) = (offset(k % points), offset(k / points));
                intensity(x as f64 + dx, y as f64 + dy)
            });
            all.sum::<f64>()
        };
        // One eighth of it is all of it.
        let mut eighth = vec![0.0; (radius + 1) * (radius + 1)];
        for y in 0..=radius {
            for x in y..=radius {
                let value = mean(x, y);
                eighth[y * (radius + 1) + x] = value;
                eighth[x * (radius + 1) + y] = value;
            }
        }
        let at = |i: usize| {
            let (x, y) = ((i % side).abs_diff(radius), (i / side).abs_diff(radius));
            eighth[y * (radius + 1) + x]
        };
        let mut weights: Vec<f64> = (0..side * side).map(at).collect();
        normalise(&mut weights);
        Self { radius, weights: Weights::Square(weights) }
    }

    /// Weight of the pixel at (dx, dy).
    #[must_use]
    pub fn weight(&self, dx: isize, dy: isize) -> f64 {
        let r = self.radius as isize;
        if dx.abs() > r || dy.abs() > r {
            return 0.0;
        }
        let (x, y) = ((dx + r) as usize, (dy + r) as usize);
        match &self.weights {
            Weights::Separable(w) => w[x] * w[y],
            Weights::Square(w) => w[y * (2 * self.radius + 1) + x],
        }
    }

    /// Farthest pixel with a weight.
    #[must_use]
    pub fn radius(&self) -> usize {
        self.radius
    }

    /// The picture of one channel as the lens shows it; `width` × `height` values, row-major. The picture is mirrored at its edges,
    /// so that even fields stay even and no light is lost.
    fn spread(&self, channel: &[f32], width: usize, height: usize) -> Vec<f32> {
        match &self.weights {
            Weights::Separable(w) => {
                let across = convolved(channel, (width, height), w, 1);
                convolved(&across, (width, height), w, width)
            }
            Weights::Square(w) => {
                let side = 2 * self.radius + 1;
                let columns: Vec<usize> = places(width, self.radius);
                let rows: Vec<usize> = places(height, self.radius);
                let value = |i: usize| {
                    let (x, y) = (i % width, i / width);
                    let mut sum = 0.0;
                    for (weights, &row) in w.chunks(side).zip(&rows[y..]) {
                        for (weight, &column) in weights.iter().zip(&columns[x..x + side]) {
                            sum += weight * f64::from(channel[row * width + column]);
                        }
                    }
                    sum as f32
                };
                (0..width * height).map(value).collect()
            }
        }
    }
}

/// The picture of three channels, each spread by its kernel.
///
/// # Panics
/// When there are not width × height pixels.
#[must_use]
pub fn spread(rgb: &[Rgb], width: usize, height: usize, kernels: &[Kernel; 3]) -> Vec<Rgb> {
    assert_eq!(rgb.len(), width * height, "one triple per pixel");
    let planes = [0, 1, 2].map(|c: usize| {
        let plane: Vec<f32> = rgb.iter().map(|v| v[c]).collect();
        kernels[c].spread(&plane, width, height)
    });
    (0..rgb.len()).map(|i| [planes[0][i], planes[1][i], planes[2][i]]).collect()
}

fn normalise(weights: &mut [f64]) {
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|w| *w /= sum);
}

/// Pixels of a row of `n` and of `radius` more on either side, mirrored at the edges (which the outermost pixels belong to).
fn places(n: usize, radius: usize) -> Vec<usize> {
    let place = |i: usize| {
        let i = (i as isize - radius as isize).rem_euclid(2 * n as isize) as usize;
        i.min(2 * n - 1 - i)
    };
    (0..n + 2 * radius).map(place).collect()
}

/// One direction of a separable kernel: neighbours are `step` apart (1 in x, the width in y).
fn convolved(values: &[f32], (width, height): (usize, usize), weights: &[f64], step: usize) -> Vec<f32> {
    let horizontal = step == 1;
    let places = places(if horizontal { width } else { height }, weights.len() / 2);
    let value = |i: usize| {
        let (x, y) = (i % width, i / width);
        let (along, start) = if horizontal { (x, y * width) } else { (y, x) };
        let around = weights.iter().zip(&places[along..]);
        around.map(|(w, &p)| w * f64::from(values[start + p * step])).sum::<f64>() as f32
    };
    (0..values.len()).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kernels() -> Vec<Kernel> {
        vec![
            Kernel::gaussian(0.3),
            Kernel::gaussian(0.7),
            Kernel::gaussian(2.5),
            Kernel::airy(0.55, 2.8, 3.45),
            Kernel::airy(0.55, 11.0, 3.45),
        ]
    }

    #[test]
    fn light_is_neither_lost_nor_made() {
        let (width, height) = (11, 7);
        let picture: Vec<Rgb> =
            (0..width * height).map(|i| [(i * i % 17) as f32, (i % 5) as f32, 1.0]).collect();
        for kernel in kernels() {
            let r = kernel.radius() as isize;
            let sum: f64 =
                (-r..=r).flat_map(|y| (-r..=r).map(move |x| (x, y))).map(|(x, y)| kernel.weight(x, y)).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{sum}");
            let out = spread(&picture, width, height, &[kernel.clone(), kernel.clone(), kernel]);
            for c in 0..3 {
                let total = |p: &[Rgb]| p.iter().map(|v| f64::from(v[c])).sum::<f64>();
                assert!((total(&out) / total(&picture) - 1.0).abs() < 1e-6);
            }
            assert!(out.iter().all(|v| (v[2] - 1.0).abs() < 1e-6));
        }
    }

    #[test]
    fn a_point_becomes_the_kernel() {
        let mut point = vec![[0.0; 3]; 41 * 41];
        point[20 * 41 + 20] = [1.0, 2.0, 0.0];
        for kernel in kernels() {
            let out = spread(&point, 41, 41, &[kernel.clone(), kernel.clone(), kernel.clone()]);
            for (dx, dy) in [(0, 0), (1, 0), (0, -1), (2, 1), (-3, 3)] {
                let at = out[((20 + dy) * 41 + 20 + dx) as usize];
                let want = kernel.weight(dx, dy) as f32;
                // A kernel that is wider than the picture comes back from its edges.
                let more = if kernel.radius() > 20 { 2e-5 } else { 1e-7 };
                assert!((at[0] - want).abs() < more && (at[1] - 2.0 * want).abs() < 2.0 * more);
            }
        }
    }

    #[test]
    fn widths_are_as_asked_for() {
        for sigma in [0.7, 1.5, 3.0] {
            let kernel = Kernel::gaussian(sigma);
            let r = kernel.radius() as isize;
            let variance: f64 = (-r..=r)
                .flat_map(|y| (-r..=r).map(move |x| (x, y)))
                .map(|(x, y)| kernel.weight(x, y) * (x * x) as f64)
                .sum();
            // The cut at 4 σ takes 0.2 % of the variance.
            assert!((variance / (sigma * sigma + 1.0 / 12.0) - 1.0).abs() < 3e-3, "{variance}");
        }
    }

    #[test]
    fn airy_s_disc_holds_its_share() {
        // First dark ring at 1.22 λ N = 20 px: 83.8 % of the light is inside (Born & Wolf, table 8.2).
        let (wavelength, f_number) = (0.55, 8.0);
        let pixel = 1.219_67 * wavelength * f_number / 20.0;
        let kernel = Kernel::airy(wavelength, f_number, pixel);
        let r = kernel.radius() as isize;
        assert_eq!(r as usize, MOST_RADIUS);
        let share = |radius: f64| -> f64 {
            (-r..=r)
                .flat_map(|y| (-r..=r).map(move |x| (x, y)))
                .filter(|&(x, y)| ((x * x + y * y) as f64) < radius * radius)
                .map(|(x, y)| kernel.weight(x, y))
                .sum()
        };
        // Second and third dark rings at 2.233 and 3.238: ratios do not depend on where the kernel ends.
        assert!(
            (share(20.0) / share(36.62) - 0.8378 / 0.9099).abs() < 2e-3,
            "{}",
            share(20.0) / share(36.62)
        );
        assert!((share(36.62) / share(53.1) - 0.9099 / 0.9376).abs() < 2e-3);
    }
}
