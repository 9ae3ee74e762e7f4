//! Checks of `sensor.exposure`.

use super::Check;
use crate::{
    ranges,
    schema::{ExposureFile, ExposureMap, LENS_TRANSMISSION, PERCENTILE, TARGET},
    sensor::ExposureSpec,
};

impl Check<'_> {
    pub(super) fn exposure(&mut self, exposure: &ExposureFile) -> Option<ExposureSpec> {
        match exposure {
            ExposureFile::Factor(factor) => {
                self.range("sensor.exposure", *factor, ranges::EXPOSURE).map(ExposureSpec::Factor)
            }
            ExposureFile::Word(_) => Some(ExposureSpec::Automatic { percentile: PERCENTILE, target: TARGET }),
            ExposureFile::Map(map) => {
                let ExposureMap { iso, shutter_s, f_number, lens_transmission, .. } = map;
                let photographic = [iso, shutter_s, f_number, lens_transmission].iter().any(|v| v.is_some());
                let automatic = map.percentile.is_some() || map.target.is_some();
                if photographic && automatic {
                    let message = "percentile and target are of automatic exposure, iso, shutter_s, f_number and \
                                   lens_transmission of a photographer's: give one or the other";
                    self.problem("sensor.exposure", message);
                    return None;
                }
                if photographic { self.photographic(map) } else { self.automatic(map) }
            }
        }
    }

    fn automatic(&mut self, map: &ExposureMap) -> Option<ExposureSpec> {
        let percentile = map.percentile.unwrap_or(PERCENTILE);
        let percentile = self.range("sensor.exposure.percentile", percentile, ranges::PERCENTILE);
        let target = self.range("sensor.exposure.target", map.target.unwrap_or(TARGET), ranges::TARGET);
        Some(ExposureSpec::Automatic { percentile: percentile?, target: target? })
    }

    fn photographic(&mut self, map: &ExposureMap) -> Option<ExposureSpec> {
        let mut number = |key: &str, value: Option<f64>, range: ranges::Range, why: &str| {
            let path = format!("sensor.exposure.{key}");
            self.required(&path, value, why).and_then(|value| self.range(&path, value, range))
        };
        let iso = number("iso", map.iso, ranges::ISO, "ISO speed, 1 to 10000000");
        let shutter_s = number("shutter_s", map.shutter_s, ranges::SHUTTER_S, "seconds, 1e-6 to 3600");
        let f_number = number("f_number", map.f_number, ranges::F_NUMBER, "f-number, 0.5 to 128");
        let transmission = Some(map.lens_transmission.unwrap_or(LENS_TRANSMISSION));
        let transmission = number("lens_transmission", transmission, ranges::LENS_TRANSMISSION, "");
        Some(ExposureSpec::Photographic {
            iso: iso?,
            shutter_s: shutter_s?,
            f_number: f_number?,
            lens_transmission: transmission?,
        })
    }
}
