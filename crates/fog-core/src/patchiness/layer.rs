//! A patchy field applied to a layer that is even in the horizontal.

use super::{Area, PatchinessError, PatchyField};

/// Share of a layer's thickness that its lowest top must leave.
const LEAST_THICKNESS: f64 = 0.1;

/// A layer whose density and top vary horizontally about those of an even one.
///
/// Over the point (x, z) the layer reaches from its base to the mean top plus h = [`PatchyField::top_offset_m`]; its profile
/// is that of the even layer, stretched to that thickness and multiplied by f = [`PatchyField::density_factor`]:
/// σ_t(x, y, z) = f σ_even(base + (y − base) T / (T + h)), T being the even layer's thickness.
///
/// The optical depth of the column is then f (1 + h/T) times that of the even layer. As f and h are independent with means 1
/// and 0, its mean is exactly that of the even layer, whatever its profile; likewise the mean amount of water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchyLayer<'a> {
    field: &'a PatchyField,
    base_m: f64,
    thickness_m: f64,
}

impl<'a> PatchyLayer<'a> {
    pub(super) fn new(field: &'a PatchyField, base_m: f64, top_m: f64) -> Result<Self, PatchinessError> {
        let thickness_m = top_m - base_m;
        if !(thickness_m > 0.0 && thickness_m.is_finite()) {
            return Err(PatchinessError::Extent { base_m, top_m });
        }
        let sink_m = -field.top_bounds_m(&Area::EVERYWHERE)[0];
        if sink_m > (1.0 - LEAST_THICKNESS) * thickness_m {
            let top_sd_m = field.parameters().top_sd_m;
            return Err(PatchinessError::TopTooRough { top_sd_m, sink_m, thickness_m });
        }
        Ok(Self { field, base_m, thickness_m })
    }

    /// The field.
    #[must_use]
    pub fn field(&self) -> &'a PatchyField {
        self.field
    }

    /// Altitude of the top in m over the point (x, z) in m.
    #[must_use]
    pub fn top_m(&self, x_m: f64, z_m: f64) -> f64 {
        self.base_m + self.thickness_m + self.field.top_offset_m(x_m, z_m)
    }

    /// Altitude in m of the even layer whose droplets are found at a point (x, altitude, z) in m: within the even layer
    /// where the point is within the patchy one, and beyond its base or top where it is not.
    #[must_use]
    pub fn even_altitude_m(&self, point_m: [f64; 3]) -> f64 {
        let stretch = 1.0 + self.field.top_offset_m(point_m[0], point_m[2]) / self.thickness_m;
        self.base_m + (point_m[1] - self.base_m) / stretch
    }

    /// σ_t in 1/m at a point (x, altitude, z) in m, from the even layer's σ_t by altitude in m (which is 0 outside of it).
    #[must_use]
    pub fn sigma_t(&self, point_m: [f64; 3], even_sigma_t: impl Fn(f64) -> f64) -> f64 {
        self.field.density_factor(point_m[0], point_m[2]) * even_sigma_t(self.even_altitude_m(point_m))
    }

    /// Least and greatest altitude of the even layer that the points of a box can have: times the bounds of the density
    /// over the same area, the even profile's extremes between them bound σ_t in the box.
    #[must_use]
    pub fn even_altitude_bounds_m(&self, area: &Area, altitude_m: [f64; 2]) -> [f64; 2] {
        let stretch = self.field.top_bounds_m(area).map(|h| 1.0 + h / self.thickness_m);
        let above = altitude_m.map(|y| y - self.base_m);
        let (low, high) = (stretch.map(|s| above[0] / s), stretch.map(|s| above[1] / s));
        [self.base_m + low[0].min(low[1]), self.base_m + high[0].max(high[1])]
    }
}
