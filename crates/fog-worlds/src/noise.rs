//! Smooth random fields, and chance.

use fog_core::random::{PathRng, mix64};

/// Random numbers of one object of a scene.
pub(crate) struct Chance(PathRng);

impl Chance {
    /// The stream of object `index` of a kind.
    pub(crate) fn new(seed: u64, kind: &str, index: u64) -> Self {
        let key = kind.bytes().fold(seed, |key, b| mix64(key ^ u64::from(b)));
        Self(PathRng::new(key, index, 0))
    }

    /// Uniform between two numbers.
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.0.uniform()
    }

    /// True with a probability.
    pub(crate) fn happens(&mut self, probability: f32) -> bool {
        self.0.uniform() < probability
    }

    /// One of some things.
    pub(crate) fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[(self.0.uniform() * from.len() as f32) as usize % from.len()]
    }

    /// A whole number below `n`.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.0.uniform() * n as f32) as usize % n.max(1)
    }
}

/// Value noise in [0, 1] on the square lattice, repeating every `period` cells.
pub(crate) fn value(seed: u64, x: f32, y: f32, period: i64) -> f32 {
    let (i, j) = (x.floor(), y.floor());
    let lattice = |a: f32, b: f32| {
        let (a, b) = ((a as i64).rem_euclid(period), (b as i64).rem_euclid(period));
        (mix64(seed ^ mix64((a << 32 | b) as u64)) >> 40) as f32 / 16_777_216.0
    };
    let smooth = |t: f32| t * t * (3.0 - 2.0 * t);
    let (s, t) = (smooth(x - i), smooth(y - j));
    let row = |b: f32| lattice(i, b) + (lattice(i + 1.0, b) - lattice(i, b)) * s;
    row(j) + (row(j + 1.0) - row(j)) * t
}

/// A repeating picture of noise between two colours: `size` pixels, `octaves` from `cells` cells on.
pub(crate) fn picture(
    seed: u64,
    size: usize,
    cells: i64,
    octaves: u32,
    low: [f32; 3],
    high: [f32; 3],
) -> crate::picture::Picture {
    let pixel = |i: usize| {
        let (x, y) = ((i % size) as f32 / size as f32, (i / size) as f32 / size as f32);
        let (mut sum, mut weight, mut n) = (0.0, 0.0, cells);
        for k in 0..octaves {
            let w = 1.0 / (1 << k) as f32;
            sum += w * value(seed ^ u64::from(k), x * n as f32, y * n as f32, n);
            weight += w;
            n *= 2;
        }
        let t = sum / weight;
        core::array::from_fn(|c| low[c] + (high[c] - low[c]) * t)
    };
    crate::picture::Picture::from_pixels(size, (0..size * size).map(pixel).collect())
}
