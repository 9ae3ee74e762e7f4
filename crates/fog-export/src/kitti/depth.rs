//! KITTI's depth pictures: 16 bits, 256 to the metre, 0 where there is no value.

use fog_dataset::FileKind;

use crate::folder::Folder;
use crate::frame::Frame;
use crate::summary::Losses;
use crate::{Result, png};

/// Steps per metre.
const PER_METRE: f32 = 256.0;

/// Writes the depth of a frame.
pub(super) fn write(frame: &Frame<'_>, folder: &Folder, name: &str, losses: &Losses) -> Result<()> {
    let depth = frame.channel(FileKind::Truth, "depth.Z")?;
    let (mut far, mut near) = (0, 0);
    let pixels: Vec<u16> = depth.values.iter().map(|&m| code(m, &mut far, &mut near)).collect();
    losses.add("depth_beyond_256_m", far, "pixels with a surface beyond 255.998 m, stored as 0 (no value)");
    losses.add("depth_below_2_mm", near, "pixels with a depth below 0.002 m, stored as 0 (no value)");
    png::grey16(folder, name, [depth.width, depth.height], &pixels)
}

/// The number that stands for a depth in metres; counts finite ones that none stands for.
fn code(metres: f32, far: &mut u64, near: &mut u64) -> u16 {
    if !metres.is_finite() {
        return 0;
    }
    let steps = (metres * PER_METRE).round();
    if steps < 1.0 {
        *near += 1;
        0
    } else if steps > f32::from(u16::MAX) {
        *far += 1;
        0
    } else {
        steps as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_beyond_the_limits_are_counted_not_clipped() {
        let (mut far, mut near) = (0, 0);
        let mut of = |metres: f32| code(metres, &mut far, &mut near);
        assert_eq!([1.0, 255.996_1, 0.002, 12.345].map(&mut of), [256, 65535, 1, 3160]);
        assert_eq!([256.0, 4000.0, 0.001, -3.0, f32::INFINITY, f32::NAN].map(&mut of), [0; 6]);
        assert_eq!((far, near), (2, 2));
    }
}
