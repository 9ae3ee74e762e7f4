//! Accumulators of many pixels, with the sums of light groups.

use crate::PixelFilm;
use fog_core::colour::Rgb;

/// Films of some pixels, and for each of them sums of the light of each group.
#[derive(Clone, Debug, PartialEq)]
pub struct Films {
    /// One film per pixel.
    pub pixels: Vec<PixelFilm>,
    /// Pixel by pixel, group by group.
    groups: Vec<[f64; 3]>,
    group_count: usize,
}

impl Films {
    /// Empty films of `count` pixels and `group_count` light groups (and one sum more for the channels of a sensor), which may
    /// be 0.
    #[must_use]
    pub fn new(count: usize, group_count: usize) -> Self {
        let groups = vec![[0.0; 3]; count * group_count];
        Self { pixels: vec![PixelFilm::default(); count], groups, group_count }
    }

    /// Film and group sums of pixel `i`.
    ///
    /// # Panics
    /// When there is no such pixel.
    #[inline]
    pub fn pixel(&mut self, i: usize) -> (&mut PixelFilm, &mut [[f64; 3]]) {
        let n = self.group_count;
        (&mut self.pixels[i], &mut self.groups[i * n..(i + 1) * n])
    }

    /// Copies of some pixels.
    ///
    /// # Panics
    /// When there is no such pixel.
    #[must_use]
    pub fn select(&self, pixels: impl Iterator<Item = usize> + Clone) -> Self {
        let n = self.group_count;
        let groups = pixels.clone().flat_map(|i| &self.groups[i * n..(i + 1) * n]).copied().collect();
        Self { pixels: pixels.map(|i| self.pixels[i]).collect(), groups, group_count: n }
    }

    /// Puts copies back that [`Films::select`] made of the same pixels.
    ///
    /// # Panics
    /// When there is no such pixel.
    pub fn replace(&mut self, pixels: impl Iterator<Item = usize>, by: &Self) {
        let n = self.group_count;
        for (k, i) in pixels.enumerate() {
            self.pixels[i] = by.pixels[k];
            self.groups[i * n..(i + 1) * n].copy_from_slice(&by.groups[k * n..(k + 1) * n]);
        }
    }

    /// Number of sums of each pixel beside its film.
    pub(crate) fn group_count(&self) -> usize {
        self.group_count
    }

    /// Mean light of a group, pixel by pixel; 0 without samples.
    pub(crate) fn group(&self, group: usize) -> Vec<Rgb> {
        let mean = |(i, film): (usize, &PixelFilm)| {
            let n = film.samples().max(1) as f64;
            self.groups[i * self.group_count + group].map(|sum| (sum / n) as f32)
        };
        self.pixels.iter().enumerate().map(mean).collect()
    }
}
