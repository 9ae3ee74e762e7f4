//! From a frame to the named channels of its EXR files.

use fog_core::colour::Rgb;
use fog_film::{Channels, Frame};

use crate::OutputSet;

/// Channel of the standard error of each pixel's luminance (mono frames: of their radiance).
pub(crate) const STANDARD_ERROR: &str = "standard_error.Y";

/// Channel of the number of samples of each pixel.
pub(crate) const SAMPLES: &str = "samples.Y";

/// Channels of `<id>.hdr.exr` that the outputs ask for.
pub(crate) fn radiance(frame: &Frame, outputs: OutputSet) -> Vec<(String, Vec<f32>)> {
    let mut out = Vec::new();
    if outputs.hdr {
        out.extend(colour(frame, "", |i| frame.image(i)));
    }
    if outputs.direct {
        out.extend(colour(frame, "direct.", |i| frame.direct[i]));
    }
    if outputs.airlight {
        out.extend(colour(frame, "airlight.", |i| frame.airlight[i]));
    }
    if outputs.standard_error {
        out.push((STANDARD_ERROR.to_owned(), frame.standard_error.clone()));
    }
    if outputs.samples {
        // Whole numbers up to 1 000 000: exact in f32.
        out.push((SAMPLES.to_owned(), frame.samples.iter().map(|&n| n as f32).collect()));
    }
    if outputs.groups {
        for group in &frame.groups {
            out.extend(colour(frame, &format!("group.{}.", group.name), |i| group.radiance[i]));
        }
    }
    out
}

/// Channels of `<id>.clear.exr`.
pub(crate) fn clear(frame: &Frame, outputs: OutputSet) -> Vec<(String, Vec<f32>)> {
    let mut out = colour(frame, "", |i| frame.image(i));
    if outputs.standard_error {
        out.push((STANDARD_ERROR.to_owned(), frame.standard_error.clone()));
    }
    out
}

/// Channels of `<id>.denoised.exr`.
pub(crate) fn denoised(frame: &Frame, rgb: &[Rgb]) -> Vec<(String, Vec<f32>)> {
    colour(frame, "", |i| rgb[i])
}

/// Channels of `<id>.gt.exr` that the outputs ask for.
pub(crate) fn truth(frame: &Frame, outputs: OutputSet) -> Vec<(String, Vec<f32>)> {
    let truth = &frame.truth;
    let mut out = Vec::new();
    if outputs.depth {
        out.push(("depth.Z".to_owned(), truth.depth_m.clone()));
    }
    if outputs.distance {
        out.push(("distance.Z".to_owned(), truth.distance_m.clone()));
    }
    if outputs.transmittance {
        out.extend(colour(frame, "transmittance.", |i| truth.transmittance[i]));
    }
    if outputs.tau {
        out.push(("tau.Y".to_owned(), truth.tau.clone()));
    }
    let surface = &truth.surface;
    if outputs.normals {
        out.extend(vectors("N", ["X", "Y", "Z"], &surface.normal));
    }
    if outputs.position {
        out.extend(vectors("P", ["X", "Y", "Z"], &surface.position));
    }
    if outputs.albedo {
        out.extend(vectors("albedo", ["R", "G", "B"], &surface.albedo));
    }
    if outputs.flow {
        out.extend(vectors("flow", ["X", "Y"], &surface.flow));
        out.push(("flow_valid.Y".to_owned(), surface.flow_valid.clone()));
    }
    out
}

/// A channel for each component.
fn vectors<const N: usize>(
    layer: &str,
    names: [&str; N],
    values: &[[f32; N]],
) -> impl Iterator<Item = (String, Vec<f32>)> {
    let plane = |(c, name): (usize, &str)| (format!("{layer}.{name}"), values.iter().map(|v| v[c]).collect());
    let planes: Vec<_> = names.into_iter().enumerate().map(plane).collect();
    planes.into_iter()
}

/// Channels R, G, B of a quantity, or Y of a mono frame, behind a layer's prefix.
fn colour(frame: &Frame, prefix: &str, at: impl Fn(usize) -> [f32; 3]) -> Vec<(String, Vec<f32>)> {
    let names: &[&str] = match frame.channels {
        Channels::Rgb => &["R", "G", "B"],
        Channels::Mono { .. } => &["Y"],
    };
    let plane = |c: usize| (0..frame.pixel_count()).map(|i| at(i)[c]).collect();
    names.iter().enumerate().map(|(c, name)| (format!("{prefix}{name}"), plane(c))).collect()
}
