//! How axes combine into frames: a frame's axis values are a function of its index and the seed.

use fog_core::random::mix64;
use serde::Deserialize;

use crate::{
    axis::{Axis, Values},
    de::NodeReader,
    draws,
    error::{Problem, Problems},
    node::{Node, Value},
    ranges,
    schema::{SweepFile, SweepMode},
};

/// More frames than this are refused: a typing error rather than a plan.
pub(crate) const MAX_FRAMES: usize = 100_000_000;

/// Points of the Sobol sequence that sobol_burley offers per seed.
const SOBOL_POINTS: usize = 1 << 16;

/// The axes and their combination.
#[derive(Clone, Debug)]
pub(crate) struct Sweep {
    pub(crate) mode: SweepMode,
    pub(crate) axes: Vec<Axis>,
    /// Number of frames, at least 1.
    pub(crate) len: usize,
}

impl Sweep {
    /// Reads section `sweep`. Problems inside an axis do not hide those of the next.
    pub(crate) fn read(node: &Node, problems: &mut Problems) -> Option<Self> {
        // Structural problems of the section are reported with the rest of the document.
        let file = SweepFile::deserialize(NodeReader::new(node)).ok()?;
        let Some(axes_node) = node.child("axes") else {
            let message = "missing; name at least one axis, such as camera.altitude_m: [2, 30]";
            problems.add(Problem::new(&node.origin, "sweep.axes", message));
            return None;
        };
        let Value::Map(entries) = &axes_node.value else {
            let message = format!("expected a map of axes, found {}", axes_node.describe());
            problems.add(Problem::new(&axes_node.origin, "sweep.axes", message));
            return None;
        };
        if entries.is_empty() {
            problems.add(Problem::new(&axes_node.origin, "sweep.axes", "empty; name at least one axis"));
            return None;
        }
        let axes: Vec<Option<Axis>> = entries.iter().map(|entry| Axis::read(entry, problems)).collect();
        let axes: Vec<Axis> = axes.into_iter().collect::<Option<_>>()?;
        let len = match frames(file.mode, file.count, &axes) {
            Ok(len) => len,
            Err((path, message)) => {
                let origin = node.origin_of(path.trim_start_matches("sweep.")).clone();
                // An axis is a key with dots: its place is that of its values.
                let origin = axes
                    .iter()
                    .find(|a| path == format!("sweep.axes.{}", a.name))
                    .map(|a| &a.key_origin)
                    .unwrap_or(&origin);
                problems.add(Problem::new(origin, path, message));
                return None;
            }
        };
        Some(Self { mode: file.mode, axes, len })
    }

    /// The value of each axis in frame `index`, which is below `len`.
    pub(crate) fn values(&self, index: usize, seed: u64) -> Vec<Node> {
        match self.mode {
            SweepMode::Grid => {
                let mut rest = index;
                let mut values: Vec<Node> = self
                    .axes
                    .iter()
                    .rev()
                    .map(|axis| {
                        let len = axis.values.len().unwrap_or(1);
                        let value = axis.values.at(rest % len);
                        rest /= len;
                        value
                    })
                    .collect();
                values.reverse();
                values
            }
            SweepMode::Zip => self.axes.iter().map(|axis| axis.values.at(index)).collect(),
            SweepMode::Random => self.draw(|dimension| random(seed, index, dimension)),
            SweepMode::Sobol => self.draw(|dimension| sobol(seed, index, dimension)),
        }
    }

    fn draw(&self, number: impl Fn(usize) -> f64) -> Vec<Node> {
        self.axes.iter().enumerate().map(|(dimension, axis)| axis.values.draw(number(dimension))).collect()
    }
}

/// Number of frames, or the path and message of what makes it impossible.
fn frames(mode: SweepMode, count: Option<i64>, axes: &[Axis]) -> Result<usize, (String, String)> {
    if mode.draws() {
        let Some(count) = count else {
            return Err(("sweep.count".into(), "missing; random and sobol need the number of frames".into()));
        };
        if !ranges::COUNT.contains(count as f64) {
            return Err(("sweep.count".into(), ranges::COUNT.message("count", count as f64)));
        }
        return Ok(count as usize);
    }
    if count.is_some() {
        return Err(("sweep.count".into(), "belongs to modes random and sobol".into()));
    }
    let mut lens = Vec::with_capacity(axes.len());
    for axis in axes {
        let Some(len) = axis.values.len() else {
            let message = "needs count or step: only modes random and sobol draw from an interval";
            return Err((format!("sweep.axes.{}", axis.name), message.into()));
        };
        lens.push(len);
    }
    if mode == SweepMode::Zip {
        if lens.iter().any(|len| *len != lens[0]) {
            let list: Vec<String> =
                axes.iter().zip(&lens).map(|(axis, len)| format!("{} has {len}", axis.name)).collect();
            let message = format!("mode zip needs equally many values on every axis: {}", list.join(", "));
            return Err(("sweep.axes".into(), message));
        }
        return Ok(lens[0]);
    }
    let product = lens.iter().try_fold(1_usize, |product, len| product.checked_mul(*len));
    product.filter(|product| *product <= MAX_FRAMES).ok_or_else(|| {
        let lens: Vec<String> = lens.iter().map(ToString::to_string).collect();
        let message = format!("{} frames are too many; at most {MAX_FRAMES}", lens.join(" × "));
        ("sweep.axes".into(), message)
    })
}

/// Independent uniform number in [0, 1) of frame and dimension.
fn random(seed: u64, index: usize, dimension: usize) -> f64 {
    draws::uniform(seed ^ 0x7261_6e64_6f6d, index, dimension)
}

/// Owen-scrambled Sobol number in [0, 1): a new scramble after each 65 536 frames and each 256 dimensions.
fn sobol(seed: u64, index: usize, dimension: usize) -> f64 {
    let dimensions = sobol_burley::NUM_DIMENSIONS as usize;
    let block = (index / SOBOL_POINTS) as u64 ^ (((dimension / dimensions) as u64) << 32);
    let scramble = mix64(mix64(seed ^ 0x0073_6f62_6f6c) ^ block) as u32;
    let (point, dimension) = ((index % SOBOL_POINTS) as u32, (dimension % dimensions) as u32);
    f64::from(sobol_burley::sample(point, dimension, scramble))
}

impl Axis {
    /// Value indices worth checking when a plan is too long to check every frame: all, or evenly spread ones.
    pub(crate) fn probes(&self, limit: usize) -> Vec<usize> {
        match &self.values {
            Values::Continuous { .. } => vec![0],
            values => spread(values.len().unwrap_or(1), limit),
        }
    }
}

/// All of `0..len`, or `limit` of them, evenly spread from first to last.
pub(crate) fn spread(len: usize, limit: usize) -> Vec<usize> {
    if len <= limit {
        return (0..len).collect();
    }
    (0..limit).map(|i| (i as u128 * (len - 1) as u128 / (limit - 1) as u128) as usize).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_pinned() {
        assert_eq!((random(1, 0, 0), random(1, 5, 2)), (0.120_202_463_685_165_07, 0.201_752_917_496_862_75));
        assert_eq!(
            (sobol(1, 0, 0), sobol(1, 70_000, 1)),
            (0.401_128_292_083_740_23, 0.254_238_367_080_688_5)
        );
    }

    #[test]
    fn sobol_is_even() {
        // Any 64 successive points from a multiple of 64 have one number in each 64th.
        for (start, dimension) in [(0, 0), (64, 1), (65_536 * 3, 2), (128, 300)] {
            let mut seen = [0; 64];
            for index in start..start + 64 {
                seen[(sobol(9, index, dimension) * 64.0) as usize] += 1;
            }
            assert_eq!(seen, [1; 64], "dimension {dimension} from {start}");
        }
    }

    #[test]
    fn spread_has_both_ends() {
        assert_eq!(spread(3, 10), [0, 1, 2]);
        assert_eq!(spread(1_000_000, 3), [0, 499_999, 999_999]);
    }
}
