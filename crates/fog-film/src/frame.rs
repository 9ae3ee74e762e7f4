//! The finished picture and its truth.

use fog_core::colour::{Rgb, luminance};

use crate::{Films, FrameError, PixelFilm, SurfaceTruth, srgb8};

/// What the three values of a pixel mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Channels {
    /// Linear sRGB (Rec. 709 primaries, D65).
    Rgb,
    /// One wavelength: index 0 of every triple is its spectral radiance, the others mean nothing.
    Mono {
        /// The wavelength in nm.
        wavelength_nm: f32,
    },
}

/// What is known without noise about each pixel-centre ray; row-major like the frame. NaN where the lens sees nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Truth {
    /// Planar depth along the camera axis in metres; +inf for sky.
    pub depth_m: Vec<f32>,
    /// Range to the first surface in metres; +inf for sky.
    pub distance_m: Vec<f32>,
    /// exp(−∫σ_t) to the first surface, or out of the fog for sky; for mono frames index 0 only.
    pub transmittance: Vec<Rgb>,
    /// Optical depth of the same path at 550 nm.
    pub tau: Vec<f32>,
    /// What the first surface is, as far as it was asked for.
    pub surface: SurfaceTruth,
}

/// The light of a group of lights.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupLayer {
    /// The group's name.
    pub name: String,
    /// Mean radiance, direct light and airlight together.
    pub radiance: Vec<Rgb>,
}

/// Light of a source without extent, or a part of it, in one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// The pixel, row-major.
    pub pixel: usize,
    /// Position of its group among [`Frame::groups`].
    pub group: usize,
    /// Mean radiance that it adds to the pixel; of a frame of one wavelength, channel 0 holds it.
    pub radiance: Rgb,
    /// What it adds to [`Frame::sensor`].
    pub sensor: Rgb,
}

/// A rendered frame: row-major, row 0 at the top, every channel width × height long.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Meaning of the triples.
    pub channels: Channels,
    /// Number of samples of each pixel, at least 1; all alike unless the frame was sampled until its noise was low.
    pub samples: Vec<u64>,
    /// Mean radiance that came straight from a surface or the sky.
    pub direct: Vec<Rgb>,
    /// Mean radiance scattered in the fog at least once.
    pub airlight: Vec<Rgb>,
    /// Standard error of the luminance of the image, per pixel.
    pub standard_error: Vec<f32>,
    /// The image once more, by groups of lights; they add up to it but for rounding. Empty where none were told apart.
    pub groups: Vec<GroupLayer>,
    /// The image once more, as the red, green and blue pixels of a sensor see it, in units of what green ones get from D65
    /// white of radiance 1. Empty where none was asked for.
    pub sensor: Vec<Rgb>,
    /// Truth channels.
    pub truth: Truth,
}

impl Frame {
    /// Means and errors of accumulated pixels.
    ///
    /// # Errors
    /// As [`Frame::check`].
    pub fn from_pixels(
        width: u32,
        height: u32,
        channels: Channels,
        pixels: &[PixelFilm],
        truth: Truth,
    ) -> Result<Self, FrameError> {
        let frame = Self {
            width,
            height,
            channels,
            samples: pixels.iter().map(PixelFilm::samples).collect(),
            direct: pixels.iter().map(PixelFilm::direct).collect(),
            airlight: pixels.iter().map(PixelFilm::airlight).collect(),
            standard_error: pixels.iter().map(|p| p.luminance().standard_error() as f32).collect(),
            groups: Vec::new(),
            sensor: Vec::new(),
            truth,
        };
        frame.check()?;
        Ok(frame)
    }

    /// The frame with the light of groups of lights, as many as `films` has sums of.
    ///
    /// # Errors
    /// As [`Frame::check`].
    pub fn with_groups(mut self, names: Vec<String>, films: &Films) -> Result<Self, FrameError> {
        let layer = |(i, name)| GroupLayer { name, radiance: films.group(i) };
        self.groups = names.into_iter().enumerate().map(layer).collect();
        self.check()?;
        Ok(self)
    }

    /// The frame with the channels of a sensor, if `films` has one sum more than there are groups.
    ///
    /// # Errors
    /// As [`Frame::check`].
    pub fn with_sensor(mut self, films: &Films) -> Result<Self, FrameError> {
        if films.group_count() > self.groups.len() {
            self.sensor = films.group(self.groups.len());
        }
        self.check()?;
        Ok(self)
    }

    /// The frame with light added to its direct light that is known without noise, and to the layers of its groups if it has
    /// any.
    ///
    /// # Errors
    /// As [`Frame::check`].
    ///
    /// # Panics
    /// When there is no such pixel.
    pub fn with_points(mut self, points: &[PointLight]) -> Result<Self, FrameError> {
        let add = |sum: &mut Rgb, light: Rgb| (0..3).for_each(|c| sum[c] += light[c]);
        for &PointLight { pixel, group, radiance, sensor } in points {
            add(&mut self.direct[pixel], radiance);
            if let Some(channels) = self.sensor.get_mut(pixel) {
                add(channels, sensor);
            }
            if let Some(layer) = self.groups.get_mut(group) {
                add(&mut layer.radiance[pixel], radiance);
            }
        }
        self.check()?;
        Ok(self)
    }

    /// Number of pixels, width × height.
    #[must_use]
    pub fn pixel_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Checks that there are pixels, that all channels have one value per pixel, that every pixel was sampled, and that
    /// every radiance is finite.
    ///
    /// # Errors
    /// The first thing found wrong.
    pub fn check(&self) -> Result<(), FrameError> {
        let (width, height, expected) = (self.width, self.height, self.pixel_count());
        if expected == 0 {
            return Err(FrameError::Empty { width, height });
        }
        for (channel, found) in [
            ("samples", self.samples.len()),
            ("direct", self.direct.len()),
            ("airlight", self.airlight.len()),
            ("standard_error", self.standard_error.len()),
            ("depth_m", self.truth.depth_m.len()),
            ("distance_m", self.truth.distance_m.len()),
            ("transmittance", self.truth.transmittance.len()),
            ("tau", self.truth.tau.len()),
        ]
        .into_iter()
        .chain(self.groups.iter().map(|g| ("groups", g.radiance.len())))
        .chain(self.truth.surface.lengths().into_iter().filter(|(_, length)| *length > 0))
        .chain((!self.sensor.is_empty()).then_some(("sensor", self.sensor.len())))
        {
            if found != expected {
                return Err(FrameError::Shape { channel, width, height, expected, found });
            }
        }
        let place = |i: usize| (i as u32 % width, (i / width as usize) as u32);
        if let Some((x, y)) = self.samples.iter().position(|&n| n == 0).map(place) {
            return Err(FrameError::Unsampled { x, y });
        }
        let used = if matches!(self.channels, Channels::Rgb) { 3 } else { 1 };
        let finite = |i: &usize| {
            let sensor = self.sensor.get(*i).into_iter().flatten();
            self.image(*i)[..used].iter().chain(sensor).all(|v| v.is_finite())
        };
        match (0..expected).find(|i| !finite(i)) {
            Some(i) => {
                let (x, y) = place(i);
                Err(FrameError::NotFinite { x, y })
            }
            None => Ok(()),
        }
    }

    /// Radiance of pixel `i` (row-major): direct + airlight, added in f32 so that the identity holds to the bit.
    ///
    /// # Panics
    /// When `i` is not a pixel of the frame.
    #[inline]
    #[must_use]
    pub fn image(&self, i: usize) -> Rgb {
        let (d, a) = (self.direct[i], self.airlight[i]);
        [d[0] + a[0], d[1] + a[1], d[2] + a[2]]
    }

    /// Luminance of pixel `i`; of a mono frame its radiance.
    ///
    /// # Panics
    /// When `i` is not a pixel of the frame.
    #[must_use]
    pub fn luminance(&self, i: usize) -> f64 {
        match self.channels {
            Channels::Rgb => luminance(self.image(i).map(f64::from)),
            Channels::Mono { .. } => f64::from(self.image(i)[0]),
        }
    }

    /// Number of samples of a pixel in the mean over the frame.
    #[must_use]
    pub fn mean_samples(&self) -> f64 {
        self.samples.iter().sum::<u64>() as f64 / self.pixel_count().max(1) as f64
    }

    /// Relative noise of the frame: the root of the mean squared standard error of a pixel's luminance, divided by the
    /// mean luminance. 0 for a black frame.
    #[must_use]
    pub fn noise_estimate(&self) -> f64 {
        let n = self.pixel_count().max(1) as f64;
        let squared = self.standard_error.iter().map(|&e| f64::from(e) * f64::from(e)).sum::<f64>() / n;
        let mean = (0..self.pixel_count()).map(|i| self.luminance(i)).sum::<f64>() / n;
        if mean > 0.0 { squared.sqrt() / mean } else { 0.0 }
    }

    /// The picture in 8-bit sRGB, three bytes per pixel, of exposure × radiance clamped to [0, 1]; mono frames are grey.
    #[must_use]
    pub fn to_srgb8(&self, exposure: f32) -> Vec<u8> {
        let byte = |v: f32| srgb8(v * exposure);
        (0..self.pixel_count())
            .flat_map(|i| {
                let v = self.image(i);
                match self.channels {
                    Channels::Rgb => v.map(byte),
                    Channels::Mono { .. } => [byte(v[0]); 3],
                }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn truth(n: usize) -> Truth {
        Truth {
            depth_m: vec![f32::INFINITY; n],
            distance_m: vec![f32::INFINITY; n],
            transmittance: vec![[0.5; 3]; n],
            tau: vec![0.7; n],
            surface: SurfaceTruth::default(),
        }
    }

    fn pixels(values: &[f32]) -> Vec<PixelFilm> {
        let pixel = |&v: &f32| {
            let mut p = PixelFilm::default();
            p.add([v; 3], [0.0; 3]);
            p.add([0.0; 3], [v; 3]);
            p
        };
        values.iter().map(pixel).collect()
    }

    #[test]
    fn image_is_direct_plus_airlight() {
        let f = Frame::from_pixels(3, 1, Channels::Rgb, &pixels(&[0.0, 0.1, 7.3]), truth(3))
            .expect("valid frame");
        assert_eq!(f.samples, [2; 3]);
        for i in 0..3 {
            for c in 0..3 {
                assert_eq!(f.image(i)[c].to_bits(), (f.direct[i][c] + f.airlight[i][c]).to_bits());
            }
        }
        assert_eq!(f.noise_estimate(), 0.0);
    }

    #[test]
    fn noise_is_relative() {
        let mut p = PixelFilm::default();
        for v in [1.0, 2.0, 3.0, 4.0] {
            p.add_mono(v, 0.0);
        }
        let mono = Channels::Mono { wavelength_nm: 550.0 };
        let f = Frame::from_pixels(2, 1, mono, &[p, p], truth(2)).expect("valid frame");
        let want = (5.0f64 / 12.0).sqrt() / 2.5;
        assert!((f.noise_estimate() / want - 1.0).abs() < 1e-6);
    }

    #[test]
    fn srgb_bytes_clamp_and_mono_is_grey() {
        let f = Frame::from_pixels(3, 1, Channels::Rgb, &pixels(&[0.0, 0.5, 9.0]), truth(3))
            .expect("valid frame");
        assert_eq!(f.to_srgb8(1.0), [0, 0, 0, 188, 188, 188, 255, 255, 255]);
        let mut g = f;
        g.channels = Channels::Mono { wavelength_nm: 550.0 };
        g.direct[1] = [0.0, 9.0, 9.0];
        g.airlight[1] = [0.25, 9.0, 9.0];
        assert_eq!(g.to_srgb8(2.0)[3..6], [188, 188, 188]);
    }

    #[test]
    fn bad_frames_are_refused() {
        let rgb = Channels::Rgb;
        let shape = Frame::from_pixels(2, 1, rgb, &pixels(&[1.0]), truth(2));
        assert!(matches!(shape, Err(FrameError::Shape { channel: "samples", .. })));
        let nan = Frame::from_pixels(1, 2, rgb, &pixels(&[1.0, f32::NAN]), truth(2));
        assert_eq!(nan, Err(FrameError::NotFinite { x: 0, y: 1 }));
        assert!(matches!(Frame::from_pixels(0, 2, rgb, &[], truth(0)), Err(FrameError::Empty { .. })));
        let mut empty = pixels(&[1.0, 1.0]);
        empty[1] = PixelFilm::default();
        let unsampled = Frame::from_pixels(1, 2, rgb, &empty, truth(2));
        assert_eq!(unsampled, Err(FrameError::Unsampled { x: 0, y: 1 }));
    }
}
