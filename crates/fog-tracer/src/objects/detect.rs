//! Whether a thing can be detected at all, and why not.

use super::ObjectTruth;

/// Why a thing cannot be detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hidden {
    /// Too few of its pixels are visible, for other things hide it.
    Occluded,
    /// Too few pixels even if nothing hid it.
    Small,
    /// Too little contrast in the picture, but enough without the fog in between.
    Fog,
    /// Too little contrast without the fog as well.
    LowContrast,
}

impl Hidden {
    /// A word for records.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Occluded => "occluded",
            Self::Small => "small",
            Self::Fog => "fog",
            Self::LowContrast => "low_contrast",
        }
    }
}

/// What can be said of a thing in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// Why it cannot be detected; none if it can.
    pub hidden: Option<Hidden>,
    /// False where the contrast is within two standard errors of the threshold: another rendering may say otherwise.
    pub is_certain: bool,
}

impl ObjectTruth {
    /// A thing is detectable if at least `min_pixels` of it are visible and its contrast is at least `threshold`, darker or
    /// brighter.
    ///
    /// What it would be without fog says the view in clear air, if it is known; else the light that came straight, over its
    /// transmittance. Where the fog is too deep even for that, the fog is what hides it.
    #[must_use]
    pub fn verdict(&self, threshold: f64, min_pixels: u64) -> Verdict {
        if self.visible_pixels < min_pixels {
            let small = self.silhouette_pixels < min_pixels;
            let hidden = Some(if small { Hidden::Small } else { Hidden::Occluded });
            return Verdict { hidden, is_certain: true };
        }
        let Some(contrast) = self.contrast else {
            // It fills the image: there is nothing to tell it from.
            return Verdict { hidden: Some(Hidden::LowContrast), is_certain: true };
        };
        let is_certain = (contrast.value.abs() - threshold).abs() > 2.0 * contrast.standard_error;
        if contrast.value.abs() >= threshold {
            return Verdict { hidden: None, is_certain };
        }
        let without_fog = self.clear_contrast.map(|clear| clear.value).or(self.unveiled_contrast);
        let stands_out = without_fog.is_none_or(|contrast| contrast.abs() >= threshold);
        let hidden = Some(if stands_out { Hidden::Fog } else { Hidden::LowContrast });
        Verdict { hidden, is_certain }
    }
}
