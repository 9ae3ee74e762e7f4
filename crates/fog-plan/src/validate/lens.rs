//! Checks of the geometry of `sensor`: size, field of view, intrinsics and lens.

use fog_core::lens::{Distortion, Equirectangular, Fisheye, Intrinsics, Lens, Pinhole, RadialTangential};
use fog_core::math;

use super::Check;
use crate::{
    lens::{IntrinsicsSpec, LensSpec},
    ranges::{self, Range},
    schema::{IntrinsicsFile, LensFile, SensorFile},
};

/// Horizontal field of view in degrees where nothing says how long the focal length is.
pub(crate) const DEFAULT_FOV_DEG: f64 = 60.0;
const DEFAULT_FISHEYE_FOV_DEG: f64 = 180.0;
const WHOLE_CIRCLE_DEG: f64 = 360.0;

/// The geometry of a sensor: what is recorded, and the lens that it makes.
pub(super) struct Geometry {
    pub(super) horizontal_fov_deg: Option<f64>,
    pub(super) intrinsics: Option<IntrinsicsSpec>,
    pub(super) lens: LensSpec,
    pub(super) projection: Lens,
}

impl Check<'_> {
    /// Checks field of view, intrinsics and lens of an image of this size.
    pub(super) fn geometry(
        &mut self,
        sensor: &SensorFile,
        [width, height]: [Option<u32>; 2],
    ) -> Option<Geometry> {
        let lens = self.lens(sensor.lens.unwrap_or(LensFile::Pinhole));
        let intrinsics = match &sensor.intrinsics {
            Some(intrinsics) => Some(self.intrinsics(intrinsics)?),
            None => None,
        };
        let lens = lens?;
        if intrinsics.is_some() {
            let message = match lens {
                LensSpec::Equirectangular { .. } => "an equirectangular image has none; remove them",
                _ if sensor.horizontal_fov_deg.is_some() => {
                    "sensor.horizontal_fov_deg and these both give the focal length: keep one of them"
                }
                _ => "",
            };
            if !message.is_empty() {
                self.problem("sensor.intrinsics", message);
                return None;
            }
        }
        let (default, range) = match lens {
            LensSpec::Pinhole | LensSpec::Opencv { .. } => (DEFAULT_FOV_DEG, ranges::FOV_DEG),
            LensSpec::Fisheye { .. } => (DEFAULT_FISHEYE_FOV_DEG, ranges::WIDE_FOV_DEG),
            LensSpec::Equirectangular { .. } => (WHOLE_CIRCLE_DEG, ranges::WIDE_FOV_DEG),
        };
        let fov = sensor.horizontal_fov_deg.unwrap_or(default);
        let fov = self.range("sensor.horizontal_fov_deg", fov, range)?;
        let projection = self.projection(lens, intrinsics, fov, [width?, height?])?;
        let horizontal_fov_deg = intrinsics.is_none().then_some(fov);
        Some(Geometry { horizontal_fov_deg, intrinsics, lens, projection })
    }

    fn projection(
        &mut self,
        lens: LensSpec,
        intrinsics: Option<IntrinsicsSpec>,
        fov_deg: f64,
        [width, height]: [u32; 2],
    ) -> Option<Lens> {
        let half_width = 0.5 * f64::from(width);
        let half_fov = (0.5 * fov_deg).to_radians();
        // Of the lens without its distortion.
        let focal = |focal: f64| {
            intrinsics.map_or(Intrinsics::centred(focal, width, height), |i| Intrinsics {
                fx_px: i.fx_px,
                fy_px: i.fy_px,
                cx_px: i.cx_px,
                cy_px: i.cy_px,
            })
        };
        let made = match lens {
            LensSpec::Pinhole if intrinsics.is_none() => {
                Ok(Lens::Pinhole(Pinhole::from_fov(width, height, fov_deg)))
            }
            LensSpec::Pinhole => Ok(Lens::Pinhole(Pinhole::new(focal(0.0)))),
            LensSpec::Opencv { k1, k2, p1, p2, k3, k4, k5, k6 } => {
                let distortion = Distortion { k: [k1, k2, k3, k4, k5, k6], p: [p1, p2] };
                let intrinsics = focal(half_width / math::f64::tan(half_fov));
                RadialTangential::new(intrinsics, distortion, width, height).map(Lens::RadialTangential)
            }
            LensSpec::Fisheye { k1, k2, k3, k4, field_of_view_deg } => {
                let intrinsics = focal(half_width / half_fov);
                Fisheye::new(intrinsics, [k1, k2, k3, k4], field_of_view_deg, width, height)
                    .map(Lens::Fisheye)
            }
            LensSpec::Equirectangular { latitude_deg } => {
                Ok(Lens::Equirectangular(Equirectangular::new(width, height, fov_deg, latitude_deg)))
            }
        };
        match made {
            Ok(lens) => Some(lens),
            Err(error) => {
                let hint = match lens {
                    LensSpec::Fisheye { .. } => {
                        "; field_of_view_deg below twice that angle makes it black there"
                    }
                    _ => "",
                };
                self.problem("sensor.lens", format!("{error}{hint}"));
                None
            }
        }
    }

    fn intrinsics(&mut self, file: &IntrinsicsFile) -> Option<IntrinsicsSpec> {
        let mut number = |key: &str, value: Option<f64>, range: Range| {
            let path = format!("sensor.intrinsics.{key}");
            let value = self.required(&path, value, "intrinsics are fx_px, fy_px, cx_px and cy_px")?;
            self.range(&path, value, range)
        };
        let fx = number("fx_px", file.fx_px, ranges::FOCAL_PX);
        let fy = number("fy_px", file.fy_px, ranges::FOCAL_PX);
        let cx = number("cx_px", file.cx_px, ranges::CENTRE_PX);
        let cy = number("cy_px", file.cy_px, ranges::CENTRE_PX);
        Some(IntrinsicsSpec { fx_px: fx?, fy_px: fy?, cx_px: cx?, cy_px: cy? })
    }

    fn lens(&mut self, lens: LensFile) -> Option<LensSpec> {
        match lens {
            LensFile::Pinhole => Some(LensSpec::Pinhole),
            LensFile::Opencv(l) => {
                let k = [l.k1, l.k2, l.p1, l.p2, l.k3, l.k4, l.k5, l.k6];
                let names = ["k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"];
                let [k1, k2, p1, p2, k3, k4, k5, k6] = self.coefficients("opencv", names, k)?;
                Some(LensSpec::Opencv { k1, k2, p1, p2, k3, k4, k5, k6 })
            }
            LensFile::Fisheye(l) => {
                let l = l.unwrap_or_default();
                let names = ["k1", "k2", "k3", "k4"];
                let [k1, k2, k3, k4] = self.coefficients("fisheye", names, [l.k1, l.k2, l.k3, l.k4])?;
                let fov = l.field_of_view_deg.unwrap_or(WHOLE_CIRCLE_DEG);
                let path = "sensor.lens.fisheye.field_of_view_deg";
                let field_of_view_deg = self.range(path, fov, ranges::WIDE_FOV_DEG)?;
                Some(LensSpec::Fisheye { k1, k2, k3, k4, field_of_view_deg })
            }
            LensFile::Equirectangular(l) => {
                let [low, high] = l.unwrap_or_default().latitude_deg.unwrap_or([-90.0, 90.0]);
                let path = "sensor.lens.equirectangular.latitude_deg";
                let low = self.range(&format!("{path}.0"), low, ranges::LATITUDE_DEG);
                let high = self.range(&format!("{path}.1"), high, ranges::LATITUDE_DEG);
                let (low, high) = (low?, high?);
                if low >= high {
                    self.problem(
                        path,
                        format!("[{low}, {high}]: the lower edge comes first, and below the upper"),
                    );
                    return None;
                }
                Some(LensSpec::Equirectangular { latitude_deg: [low, high] })
            }
        }
    }

    fn coefficients<const N: usize>(
        &mut self,
        lens: &str,
        names: [&str; N],
        values: [f64; N],
    ) -> Option<[f64; N]> {
        let mut fine = true;
        for (name, value) in names.iter().zip(values) {
            let path = format!("sensor.lens.{lens}.{name}");
            fine &= self.range(&path, value, ranges::LENS_COEFFICIENT).is_some();
        }
        fine.then_some(values)
    }
}
