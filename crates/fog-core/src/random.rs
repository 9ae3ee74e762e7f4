//! Counter-based random numbers: a sample of a pixel is a function of (seed, pixel, sample, dimension) and nothing else,
//! so threads, tiles, shards and restarts cannot change an image.

/// Finaliser of SplitMix64 (Steele, Lea & Flood 2014): a bijection of 64 bits that passes BigCrush on a counter.
#[inline]
#[must_use]
pub fn mix64(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// Random stream of one path: the first seven dimensions are scrambled low-discrepancy points (pixel x, pixel y, wavelength,
/// first free flight; first turn, second free flight), all later ones the SplitMix64 sequence of the path's key.
#[derive(Clone, Debug)]
pub struct PathRng {
    state: u64,
    turn: Option<[f32; 2]>,
    flight: Option<f32>,
    turns: Option<FirstTurns>,
}

/// Where a path's first turns are among those of its pixel: those of one path follow each other.
#[derive(Clone, Copy, Debug)]
pub struct FirstTurns {
    key: u64,
    first: u64,
}

impl FirstTurns {
    /// The n-th first turn of the path, and the second flight that follows it.
    #[inline]
    fn at(self, n: u64) -> ([f32; 2], f32) {
        let index = self.first + n;
        let key = mix64(self.key.wrapping_add(index >> 16)) as u32;
        let [u, v, flight, _] = sobol_burley::sample_4d((index & 0xffff) as u32, 1, key);
        ([u, v], flight)
    }
}

/// The first dimensions of a path, stratified over the samples of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Stratified {
    /// Position inside the pixel, in [0, 1)².
    pub pixel: [f32; 2],
    /// Selects the hero wavelength.
    pub wavelength: f32,
    /// Selects the optical depth of the first free flight.
    pub flight: f32,
    /// Select the first turn and the optical depth of the second free flight: see [`PathRng::turn`].
    pub turns: FirstTurns,
}

impl PathRng {
    /// The stream of sample `sample` of pixel `pixel` of the frame with seed `seed`.
    #[must_use]
    pub fn new(seed: u64, pixel: u64, sample: u64) -> Self {
        let pixel_key = mix64(seed ^ mix64(pixel.wrapping_mul(GOLDEN).wrapping_add(1)));
        Self {
            state: mix64(pixel_key.wrapping_add(sample.wrapping_mul(GOLDEN))),
            turn: None,
            flight: None,
            turns: None,
        }
    }

    /// The same stream, with stratified numbers for the first turn and the flight after it.
    #[inline]
    #[must_use]
    pub fn with_first(self, turns: FirstTurns) -> Self {
        let mut out = Self { turns: Some(turns), ..self };
        out.branch(0);
        out
    }

    /// Takes the stratified numbers of the n-th of several first turns of the path for the next turn and flight; a stream that
    /// was given none goes on.
    #[inline]
    pub fn branch(&mut self, n: u64) {
        if let Some(turns) = self.turns {
            let (turn, flight) = turns.at(n);
            (self.turn, self.flight) = (Some(turn), Some(flight));
        }
    }

    /// Two numbers, uniform in [0, 1), for a turn: of the polar angle, and of the azimuth or what stands for it.
    #[inline]
    pub fn turn(&mut self) -> (f64, f32) {
        match self.turn.take() {
            Some([u, v]) => (f64::from(u), v),
            None => (self.uniform_f64(), self.uniform()),
        }
    }

    /// A number, uniform in [0, 1), for the optical depth of a free flight after a turn.
    #[inline]
    pub fn flight(&mut self) -> f64 {
        self.flight.take().map_or_else(|| self.uniform_f64(), f64::from)
    }

    /// Next number, uniform in [0, 1) with 24 bits.
    #[inline]
    pub fn uniform(&mut self) -> f32 {
        (self.next_u64() >> 40) as f32 * (1.0 / 16_777_216.0)
    }

    /// Next number, uniform in [0, 1) with 53 bits: for inversions whose tails matter.
    #[inline]
    pub fn uniform_f64(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Two independent numbers, uniform in [0, 1).
    #[inline]
    pub fn uniform2(&mut self) -> [f32; 2] {
        let bits = self.next_u64();
        const SCALE: f32 = 1.0 / 16_777_216.0;
        [(bits >> 40) as f32 * SCALE, (bits & 0xff_ffff) as f32 * SCALE]
    }

    /// Next 64 random bits.
    #[inline]
    pub fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(GOLDEN);
        mix64(self.state)
    }
}

/// Owen-scrambled Sobol point of a pixel's sample (Burley 2020), a fresh scrambling every 65,536 samples (the sequence's
/// length) so that any sample count is valid. `branches` (1 or more) are the first turns that each path may take.
#[must_use]
pub fn stratified(seed: u64, pixel: u64, sample: u64, branches: u64) -> Stratified {
    let pixel_key = mix64(seed ^ mix64(pixel.wrapping_mul(GOLDEN).wrapping_add(2)));
    let key = mix64(pixel_key.wrapping_add(sample >> 16));
    let index = (sample & 0xffff) as u32;
    let [x, y, wavelength, flight] = sobol_burley::sample_4d(index, 0, key as u32);
    let turns = FirstTurns { key: pixel_key, first: sample * branches };
    Stratified { pixel: [x, y], wavelength, flight, turns }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_pinned() {
        let mut rng = PathRng::new(1, 2, 3);
        let first = rng.next_u64();
        let mut again = PathRng::new(1, 2, 3);
        assert_eq!(first, again.next_u64());
        assert_eq!(mix64(1), 0x5692_161d_100b_05e5);
    }

    #[test]
    fn streams_of_neighbours_are_unrelated() {
        // Mean of the product of neighbouring pixels' first numbers is 1/4 for independent uniforms.
        let n = 100_000;
        let mut sum = 0.0;
        for p in 0..n {
            let a = PathRng::new(7, p, 0).uniform_f64();
            let b = PathRng::new(7, p + 1, 0).uniform_f64();
            sum += (a - 0.5) * (b - 0.5);
        }
        let correlation = sum / n as f64 * 12.0;
        assert!(correlation.abs() < 5.0 / (n as f64).sqrt(), "correlation {correlation}");
    }

    #[test]
    fn stratified_dimensions_fill_evenly() {
        // Each of 64 strata of the wavelength gets exactly one of 64 samples.
        let mut seen = [[false; 64]; 3];
        for s in 0..64 {
            let first = stratified(3, 11, s, 1);
            let ([turn, _], flight) = first.turns.at(0);
            for (seen, x) in seen.iter_mut().zip([first.wavelength, turn, flight]) {
                seen[(x * 64.0) as usize] = true;
            }
        }
        assert!(seen.as_flattened().iter().all(|&s| s));
    }

    #[test]
    fn turns_of_branches_fill_evenly_together() {
        // 16 paths of 4 first turns each.
        let mut seen = [[false; 64]; 3];
        for s in 0..16 {
            let mut rng = PathRng::new(3, 11, s).with_first(stratified(3, 11, s, 4).turns);
            for n in 0..4 {
                rng.branch(n);
                let ((u, v), flight) = (rng.turn(), rng.flight());
                for (seen, x) in seen.iter_mut().zip([u as f32, v, flight as f32]) {
                    seen[(x * 64.0) as usize] = true;
                }
            }
        }
        assert!(seen.as_flattened().iter().all(|&s| s));
        // A stream without such numbers takes its own.
        let mut plain = PathRng::new(3, 11, 0);
        let mut branched = plain.clone();
        branched.branch(1);
        assert_eq!((branched.turn(), branched.flight()), (plain.turn(), plain.flight()));
    }

    #[test]
    fn stratified_numbers_come_first_and_once() {
        let turns = stratified(1, 2, 3, 1).turns;
        let mut plain = PathRng::new(1, 2, 3);
        let mut given = plain.clone().with_first(turns);
        let ([u, v], flight) = turns.at(0);
        assert_eq!((given.turn(), given.flight()), ((f64::from(u), v), f64::from(flight)));
        assert_eq!((given.turn(), given.flight()), (plain.turn(), plain.flight()));
    }
}
