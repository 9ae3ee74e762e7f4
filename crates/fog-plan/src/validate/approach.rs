//! Checks of `path.glide_slope`.

use super::Check;
use crate::{
    path::{Approach, Dispersion, MAX_POSES, Path, draw_lard, glide},
    ranges::{self, Range},
    schema::{DispersionFile, EachFile, GlideSlopeFile, LardFile},
};

/// The usual glide path angle.
const ANGLE_DEG: f64 = 3.0;
/// Distance of the aiming point from the threshold of the runway scene: 1020 ft (FAA AC 150/5340-1M).
const AIMING_POINT_M: f64 = 311.0;
/// 136 knots: an airliner of approach category C.
const SPEED_M_S: f64 = 70.0;
const SEED: u64 = 1;
/// A step of this share of a step still counts as the end.
const SLACK: f64 = 1e-9;

impl Check<'_> {
    pub(super) fn glide_slope(&mut self, file: &GlideSlopeFile) -> Option<Path> {
        let approach = self.approach(file);
        match &file.lard {
            Some(lard) => self.lard(file, lard, approach),
            None => {
                let speed = file.speed_m_s.unwrap_or(SPEED_M_S);
                let speed = self.range("path.glide_slope.speed_m_s", speed, ranges::SPEED_M_S);
                let angle_deg = approach.map_or(ANGLE_DEG, |a| a.angle_deg);
                let distances = self.approach_distances(file, speed, angle_deg);
                Some(glide(&approach?, &distances?, speed?))
            }
        }
    }

    fn approach(&mut self, file: &GlideSlopeFile) -> Option<Approach> {
        let mut or = |key: &str, value: Option<f64>, default: f64, range: Range| {
            self.range(&format!("path.glide_slope.{key}"), value.unwrap_or(default), range)
        };
        let angle = or("angle_deg", file.angle_deg, ANGLE_DEG, ranges::GLIDE_ANGLE_DEG);
        let heading = or("heading_deg", file.heading_deg, 0.0, ranges::HEADING_DEG);
        let aiming = or("aiming_point_m", file.aiming_point_m, AIMING_POINT_M, ranges::AIMING_POINT_M);
        let lateral = or("lateral_deviation_deg", file.lateral_deviation_deg, 0.0, ranges::DEVIATION_DEG);
        let vertical = or("vertical_deviation_deg", file.vertical_deviation_deg, 0.0, ranges::DEVIATION_DEG);
        let crab = or("crab_deg", file.crab_deg, 0.0, ranges::CRAB_DEG);
        let roll = or("roll_deg", file.roll_deg, 0.0, ranges::ROLL_DEG);
        let pitch = or("pitch_deg", file.pitch_deg, -angle?, ranges::PITCH_DEG);
        let threshold_m = file.threshold_m.unwrap_or([0.0; 3]);
        self.point("path.glide_slope.threshold_m", &threshold_m)?;
        let dispersion = match &file.dispersion {
            Some(dispersion) => Some(self.dispersion(dispersion)?),
            None => None,
        };
        Some(Approach {
            threshold_m,
            heading_deg: heading?,
            aiming_point_m: aiming?,
            angle_deg: angle?,
            lateral_deviation_deg: lateral?,
            vertical_deviation_deg: vertical?,
            crab_deg: crab?,
            pitch_deg: pitch?,
            roll_deg: roll?,
            dispersion,
        })
    }

    fn dispersion(&mut self, file: &DispersionFile) -> Option<Dispersion> {
        let mut sd = |key: &str, value: f64| {
            self.range(&format!("path.glide_slope.dispersion.{key}"), value, ranges::SPREAD_DEG)
        };
        let lateral = sd("lateral_deg", file.lateral_deg);
        let vertical = sd("vertical_deg", file.vertical_deg);
        let heading = sd("heading_deg", file.heading_deg);
        let pitch = sd("pitch_deg", file.pitch_deg);
        let roll = sd("roll_deg", file.roll_deg);
        Some(Dispersion {
            lateral_deg: lateral?,
            vertical_deg: vertical?,
            heading_deg: heading?,
            pitch_deg: pitch?,
            roll_deg: roll?,
            seed: file.seed.unwrap_or(SEED),
            each_pose: file.each != Some(EachFile::Path),
        })
    }

    /// Distances from the aiming point, falling.
    fn approach_distances(
        &mut self,
        file: &GlideSlopeFile,
        speed: Option<f64>,
        angle_deg: f64,
    ) -> Option<Vec<f64>> {
        let why = "horizontal distance from the aiming point";
        let from = self.needed("path.glide_slope.from_m", file.from_m, ranges::ALONG_TRACK_M, why);
        let to = self.needed("path.glide_slope.to_m", file.to_m, ranges::ALONG_TRACK_M, why);
        let (from, to) = (from?, to?);
        if to >= from {
            self.problem("path.glide_slope.to_m", format!("{to} m is not less than from_m, {from} m"));
            return None;
        }
        let given = [file.step_m.is_some(), file.count.is_some(), file.rate_hz.is_some()];
        if given.iter().filter(|is| **is).count() != 1 {
            self.problem(
                "path.glide_slope",
                "expected one of step_m, count and rate_hz: how many poses there are",
            );
            return None;
        }
        let step = if let Some(count) = file.count {
            let count = self.whole("path.glide_slope.count", count, ranges::POSES)?;
            if count < 2 {
                self.problem("path.glide_slope.count", "1 is no path; valid: 2 to 1000000");
                return None;
            }
            let share = |i: u32| f64::from(i) / f64::from(count - 1);
            return Some((0..count).map(|i| from + (to - from) * share(i)).collect());
        } else if let Some(step) = file.step_m {
            self.range("path.glide_slope.step_m", step, ranges::ALONG_TRACK_M)?
        } else {
            let rate = self.range("path.glide_slope.rate_hz", file.rate_hz?, ranges::RATE_HZ)?;
            speed? * fog_core::math::f64::cos(angle_deg.to_radians()) / rate
        };
        let steps = (from - to) / step * (1.0 + SLACK);
        if steps >= MAX_POSES as f64 {
            self.problem("path.glide_slope", format!("more than {MAX_POSES} poses"));
            return None;
        }
        Some((0..=steps as usize).map(|i| from - i as f64 * step).collect())
    }

    fn lard(&mut self, file: &GlideSlopeFile, lard: &LardFile, approach: Option<Approach>) -> Option<Path> {
        let own = [
            ("angle_deg", file.angle_deg.is_some()),
            ("from_m", file.from_m.is_some()),
            ("to_m", file.to_m.is_some()),
            ("step_m", file.step_m.is_some()),
            ("count", file.count.is_some()),
            ("rate_hz", file.rate_hz.is_some()),
            ("speed_m_s", file.speed_m_s.is_some()),
            ("lateral_deviation_deg", file.lateral_deviation_deg.is_some()),
            ("vertical_deviation_deg", file.vertical_deviation_deg.is_some()),
            ("pitch_deg", file.pitch_deg.is_some()),
            ("crab_deg", file.crab_deg.is_some()),
            ("roll_deg", file.roll_deg.is_some()),
            ("dispersion", file.dispersion.is_some()),
        ];
        if let Some((key, _)) = own.iter().find(|(_, is)| *is) {
            let message =
                "lard draws it; beside lard only threshold_m, heading_deg and aiming_point_m are of use";
            self.problem(&format!("path.glide_slope.{key}"), message);
            return None;
        }
        let count = self.required("path.glide_slope.lard.count", lard.count, "number of poses")?;
        let count = self.whole("path.glide_slope.lard.count", count, ranges::POSES)?;
        Some(draw_lard(&approach?, count as usize, lard.seed.unwrap_or(SEED)))
    }
}
