//! How much disk a frame takes.

use crate::OutputSet;

/// Rough size of a frame's files in bytes, for a plan's estimate; `groups` is the number of layers of light groups.
///
/// Bytes per pixel are what RGB test frames of walls and ground at 16 samples took (tests in `tests/suite/sizes.rs`),
/// rounded up: noisy radiance in f32 hardly compresses, truth channels do where surfaces are even, equal counts of samples
/// to nearly nothing, as do normals and colours of even surfaces; textured and curved ones take more. Mono frames take less.
#[must_use]
pub fn estimate_bytes(width: u32, height: u32, outputs: OutputSet, groups: usize) -> u64 {
    let per_pixel = [
        (outputs.image, 2.0),
        (outputs.hdr, 12.0),
        (outputs.direct, 12.0),
        (outputs.airlight, 11.0),
        (outputs.standard_error, 4.0),
        (outputs.samples, 0.1),
        (outputs.groups, 12.0 * groups as f64),
        (outputs.denoised, 14.0),
        (outputs.raw, 2.0),
        (outputs.pair, 14.0),
        (outputs.depth, 2.5),
        (outputs.distance, 3.4),
        (outputs.transmittance, 10.0),
        (outputs.tau, 3.4),
        (outputs.normals, 0.3),
        (outputs.position, 6.0),
        (outputs.albedo, 0.3),
        (outputs.semantic, 0.03),
        (outputs.instance, 0.3),
        (outputs.flow, 5.0),
    ];
    let wanted: f64 = per_pixel.iter().filter(|(wanted, _)| *wanted).map(|(_, bytes)| bytes).sum();
    // Record, timings, marker and file headers.
    let fixed = 8192;
    (wanted * f64::from(width) * f64::from(height)) as u64 + fixed
}
