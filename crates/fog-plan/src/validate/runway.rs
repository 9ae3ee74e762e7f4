//! Checks of `runway`.

use super::Check;
use crate::{ranges, runway::RunwaySpec, schema::RunwayFile};

impl Check<'_> {
    /// The runway of the record; the outer option is the check's success.
    pub(super) fn runway(&mut self, file: Option<&RunwayFile>) -> Option<Option<RunwaySpec>> {
        let Some(file) = file else { return Some(None) };
        let threshold = match file.threshold_m {
            None => Some(None),
            Some(point) => {
                let fine = [0, 1, 2].map(|i| {
                    self.range(&format!("runway.threshold_m.{i}"), point[i], ranges::POSITION_M).is_some()
                });
                fine.iter().all(|fine| *fine).then_some(Some(point))
            }
        };
        let heading = self.optional("runway.heading_deg", file.heading_deg, ranges::HEADING_DEG);
        let length = self.optional("runway.length_m", file.length_m, ranges::SITE_LENGTH_M);
        let width = self.optional("runway.width_m", file.width_m, ranges::SITE_WIDTH_M);
        let glide = self.optional("runway.glide_slope_deg", file.glide_slope_deg, ranges::GLIDE_SLOPE_DEG);
        let touchdown = self.optional("runway.touchdown_m", file.touchdown_m, ranges::TOUCHDOWN_M);
        let path = "runway.background_luminance_cd_m2";
        let background = self.optional(path, file.background_luminance_cd_m2, ranges::BACKGROUND_CD_M2);
        Some(Some(RunwaySpec {
            threshold_m: threshold?,
            heading_deg: heading?,
            length_m: length?,
            width_m: width?,
            glide_slope_deg: glide?,
            touchdown_m: touchdown?,
            background_luminance_cd_m2: background?,
        }))
    }
}
