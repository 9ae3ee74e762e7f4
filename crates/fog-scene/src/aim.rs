//! How often paths are to aim at broad emitters, by place.
//!
//! Among lit façades every other path runs into one, and connections only cost; far away from them, or over the roofs, hardly
//! any does. What tells is the solid angle that they fill.

use fog_core::Vec3A;

/// Solid angle in sr up to which connections are always made ...
const ALWAYS_SR: f32 = 0.02;
/// ... and from which on never: then a diffuse surface's or a droplet's own directions find them. In the night street of
/// `docs/performance.md` five times as much of both costs 38 % more time for 1 % less noise.
const NEVER_SR: f32 = 0.2;
/// Cells along the longest side of the grid.
const CELLS: f32 = 24.0;
/// Emitters that are looked at for each cell; of more, as many evenly picked ones stand for all.
const MOST: usize = 1000;

/// Probabilities on a grid around the emitters.
#[derive(Clone, Debug, Default)]
pub(crate) struct Aim {
    lower: Vec3A,
    upper: Vec3A,
    /// Area of all emitters, in m².
    area: f32,
    cells_per_m: f32,
    size: [usize; 3],
    probability: Vec<f32>,
}

/// A part of an emitter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    pub(crate) centre: Vec3A,
    pub(crate) two_sided: bool,
    pub(crate) area: f32,
}

impl Patch {
    /// Solid angle from about a point, whose place in front of the emitter or beside it is not known.
    fn solid_angle(&self, from: Vec3A) -> f32 {
        let cosine = if self.two_sided { 0.5 } else { 0.25 };
        self.area * cosine / ((from - self.centre).length_squared() + self.area)
    }
}

impl Aim {
    pub(crate) fn new(patches: &[Patch]) -> Self {
        let centres = || patches.iter().map(|p| p.centre);
        let Some((lower, upper)) = centres().reduce(Vec3A::min).zip(centres().reduce(Vec3A::max)) else {
            return Self::default();
        };
        let area: f32 = patches.iter().map(|p| p.area).sum();
        let margin = Vec3A::splat(0.5 * (upper - lower).length().max(area.sqrt()));
        let (lower, upper) = (lower - margin, upper + margin);
        let extent = upper - lower;
        let cells_per_m = CELLS / extent.max_element();
        let size = extent.to_array().map(|e| ((e * cells_per_m) as usize).max(1));
        let stride = patches.len().div_ceil(MOST);
        let scale = patches.len() as f32 / patches.iter().step_by(stride).count() as f32;
        let probability = (0..size[0] * size[1] * size[2]).map(|i| {
            let cell = [i % size[0], i / size[0] % size[1], i / (size[0] * size[1])];
            let centre = lower + Vec3A::from(cell.map(|k| k as f32 + 0.5)) / cells_per_m;
            let sum: f32 = patches.iter().step_by(stride).map(|p| p.solid_angle(centre)).sum();
            for_solid_angle(sum * scale)
        });
        Self { lower, upper, area, cells_per_m, size, probability: probability.collect() }
    }

    /// Probability at a point; beyond the grid by what all emitters together would fill from there.
    #[inline]
    pub(crate) fn at(&self, point: Vec3A) -> f32 {
        if point.cmplt(self.lower).any() || point.cmpgt(self.upper).any() {
            return for_solid_angle(
                0.25 * self.area / (point - 0.5 * (self.lower + self.upper)).length_squared(),
            );
        }
        let place = (point - self.lower) * self.cells_per_m;
        let cell = |axis: usize| (place[axis].max(0.0) as usize).min(self.size[axis].saturating_sub(1));
        let index = cell(0) + self.size[0] * (cell(1) + self.size[1] * cell(2));
        self.probability.get(index).copied().unwrap_or(0.0)
    }
}

fn for_solid_angle(sr: f32) -> f32 {
    ((NEVER_SR - sr) / (NEVER_SR - ALWAYS_SR)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn connections_are_made_where_emitters_are_small() {
        // Two walls of 60 m × 20 m that face each other over a street of 12 m, in patches of 1 m.
        let patches: Vec<Patch> = (0..2400)
            .map(|i| {
                let (side, z, y) = (i / 1200, i % 60, i / 60 % 20);
                let x = if side == 0 { -6.0 } else { 6.0 };
                let centre = Vec3A::new(x, y as f32 + 0.5, z as f32);
                Patch { centre, two_sided: false, area: 1.0 }
            })
            .collect();
        let aim = Aim::new(&patches);
        // In the street, over the roofs, and beyond the grid.
        assert_eq!(aim.at(Vec3A::new(0.0, 5.0, 30.0)), 0.0);
        let above = aim.at(Vec3A::new(0.0, 90.0, 30.0));
        assert!(above > 0.5 && above < 1.0, "{above}");
        assert_eq!(aim.at(Vec3A::new(400.0, 5.0, 30.0)), 1.0);
        assert_eq!(Aim::new(&patches[..1]).at(Vec3A::new(100.0, 0.0, 0.0)), 1.0);
    }
}
