//! Radiance at a point by real spherical harmonics: the part that is even in the azimuth from the sun.

/// Harmonics up to order 3.
pub(super) const HARMONICS: usize = 10;
/// Order of each.
pub(super) const ORDER: [usize; HARMONICS] = [0, 1, 1, 2, 2, 2, 3, 3, 3, 3];

/// Schmidt's semi-normalised harmonics, so that P_l(a·b) is the sum over those of order l of Q(a) Q(b), for directions and
/// functions that are even in the azimuth. `z` is the cosine of the zenith angle, `x` the component towards the sun's azimuth.
#[inline]
pub(super) fn harmonics(x: f32, z: f32) -> [f32; HARMONICS] {
    const ROOT_3: f32 = 1.732_050_8;
    const ROOT_3_8: f32 = 0.612_372_4;
    const ROOT_15_4: f32 = 1.936_491_7;
    const ROOT_5_8: f32 = 0.790_569_4;
    let (x2, z2) = (x * x, z * z);
    let y2 = (1.0 - x2 - z2).max(0.0);
    [
        1.0,
        z,
        x,
        0.5 * (3.0 * z2 - 1.0),
        ROOT_3 * x * z,
        0.5 * ROOT_3 * (x2 - y2),
        0.5 * z * (5.0 * z2 - 3.0),
        ROOT_3_8 * x * (5.0 * z2 - 1.0),
        ROOT_15_4 * z * (x2 - y2),
        ROOT_5_8 * x * (x2 - 3.0 * y2),
    ]
}

/// Nodes and weights of Gauss and Legendre on [−1, 1] with 6 points.
pub(super) const GAUSS_6: [(f64, f64); 6] = [
    (-0.932_469_514_203_152, 0.171_324_492_379_170),
    (-0.661_209_386_466_265, 0.360_761_573_048_139),
    (-0.238_619_186_083_197, 0.467_913_934_572_691),
    (0.238_619_186_083_197, 0.467_913_934_572_691),
    (0.661_209_386_466_265, 0.360_761_573_048_139),
    (0.932_469_514_203_152, 0.171_324_492_379_170),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addition_theorem() {
        // Even part of P_l(a·b): the mean over b and its mirror image.
        let unit = |x: f32, y: f32, z: f32| {
            let n = (x * x + y * y + z * z).sqrt();
            [x / n, y / n, z / n]
        };
        for (a, b) in [
            (unit(0.3, 0.5, -0.7), unit(-0.9, 0.2, 0.4)),
            (unit(1.0, 0.0, 0.1), unit(0.2, -0.8, 0.5)),
            (unit(0.0, 1.0, 0.0), unit(0.6, 0.6, -0.2)),
        ] {
            let cosines = [1.0, -1.0].map(|s: f32| a[0] * b[0] + s * a[1] * b[1] + a[2] * b[2]);
            let mean = |p: fn(f32) -> f32| 0.5 * (p(cosines[0]) + p(cosines[1]));
            let want = [
                1.0,
                mean(|c| c),
                mean(|c| 0.5 * (3.0 * c * c - 1.0)),
                mean(|c| 0.5 * c * (5.0 * c * c - 3.0)),
            ];
            let (qa, qb) = (harmonics(a[0], a[2]), harmonics(b[0], b[2]));
            for (order, want) in want.iter().enumerate() {
                let sum: f32 = (0..HARMONICS).filter(|&i| ORDER[i] == order).map(|i| qa[i] * qb[i]).sum();
                assert!((sum - want).abs() < 1e-5, "order {order}: {sum} for {want}");
            }
        }
    }
}
