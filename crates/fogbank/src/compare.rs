//! Comparing what was rendered: two pictures, or the frames of two data sets.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use fog_dataset::{PlanFrame, picture_path, read_header, read_picture, read_plan};
use fog_film::{Comparison, DeltaE, Picture, Scale, psnr_db};

use crate::Error;
use crate::reference::Reference;

/// Two pictures from files, compared.
#[derive(Clone, Debug)]
pub struct Compared {
    /// What the values of A and B are, with the exposures that they were shown with.
    pub scales: [Scale; 2],
    /// What was found.
    pub comparison: Comparison,
}

/// Compares picture A with the reference B (see [`fog_dataset::read_picture`] and [`fog_film::compare`]). `exposure` takes
/// the place of what the files say. With `blocks` above 1 the means over blocks of so many pixels squared are compared
/// ([`fog_film::Picture::blocks`]).
///
/// # Errors
/// If a file is no picture, the sizes differ, or an exposure is given and no picture holds radiance.
pub fn compare_pictures(a: &Path, b: &Path, exposure: Option<f32>, blocks: u32) -> Result<Compared, Error> {
    let mut pictures = [read_picture(a)?, read_picture(b)?];
    let mut exposed = false;
    for picture in &mut pictures {
        if let (Scale::Radiance { exposure: own }, Some(given)) = (&mut picture.scale, exposure) {
            *own = given;
            exposed = true;
        }
    }
    let incomparable = |reason| Error::Incomparable { a: a.to_path_buf(), b: b.to_path_buf(), reason };
    if exposure.is_some() && !exposed {
        let reason = "an exposure was given, but both are sRGB pictures, whose exposure is done";
        return Err(incomparable(reason.to_owned()));
    }
    // Pictures that cannot be compared stay as they are, so that messages are about the files.
    let size = |picture: &Picture| picture.check().ok().map(|()| [picture.width, picture.height]);
    if blocks > 1 && size(&pictures[0]).is_some_and(|a| size(&pictures[1]) == Some(a)) {
        pictures = pictures.map(|picture| picture.blocks(blocks));
    }
    let comparison =
        fog_film::compare(&pictures[0], &pictures[1]).map_err(|e| incomparable(e.to_string()))?;
    Ok(Compared { scales: pictures.map(|p| p.scale), comparison })
}

/// Which frames of two data sets belong together.
#[derive(Clone, Debug, PartialEq)]
pub enum Matching {
    /// Those of the same id: the same frame of two versions of the program, say.
    Id,
    /// Those of the same pair id, which differ in fog alone. Where B has several of them, its clear one (`fog: none`).
    PairId,
    /// Those of the same pair id; in B only frames that this is true of.
    Reference(Reference),
}

/// A frame of A and its partner in B.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FramePair {
    /// Ids in A and B.
    pub ids: [String; 2],
    /// Their pictures: linear radiance if the data set has it, else sRGB.
    pub paths: [PathBuf; 2],
}

/// A frame that is not compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Its data set: `A` or `B`.
    pub side: char,
    /// Its id.
    pub id: String,
    /// Why.
    pub reason: String,
}

/// The frames of two data sets side by side.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MatchedFrames {
    /// In the order of A.
    pub pairs: Vec<FramePair>,
    /// Frames without a partner or without a picture.
    pub left_out: Vec<LeftOut>,
}

/// Finds which frames of the data sets `a` and `b` are to be compared. Both may be the same folder: a frame is then not
/// compared with itself.
///
/// # Errors
/// If a folder is no data set, or not one frame can be compared; the message says why.
pub fn match_frames(a: &Path, b: &Path, matching: &Matching) -> Result<MatchedFrames, Error> {
    let plans = [plan_of(a)?, plan_of(b)?];
    let same_folder = a.canonicalize().ok() == b.canonicalize().ok();
    let mut matched = MatchedFrames::default();
    let mut used = vec![false; plans[1].len()];
    let partners = Partners::of(&plans[1], matching);
    for frame in &plans[0] {
        let found = partners.find(frame);
        if let Ok(i) = found {
            used[i] = true;
            if same_folder && *matching != Matching::Id && plans[1][i].id == frame.id {
                continue;
            }
        }
        let pair = found.and_then(|i| {
            let other = &plans[1][i];
            let missing = |side| format!("{side} has no picture of it");
            Ok(FramePair {
                ids: [frame.id.clone(), other.id.clone()],
                paths: [
                    picture_path(a, frame).ok_or_else(|| missing("A"))?,
                    picture_path(b, other).ok_or_else(|| missing("B"))?,
                ],
            })
        });
        match pair {
            Ok(pair) => matched.pairs.push(pair),
            Err(reason) => matched.left_out.push(LeftOut { side: 'A', id: frame.id.clone(), reason }),
        }
    }
    if *matching == Matching::Id {
        let alone = plans[1].iter().zip(used).filter(|(_, used)| !used);
        let reason = "A has no frame of this id".to_owned();
        matched.left_out.extend(alone.map(|(f, _)| LeftOut {
            side: 'B',
            id: f.id.clone(),
            reason: reason.clone(),
        }));
    }
    if matched.pairs.is_empty() {
        let why = matched.left_out.first().map_or(String::new(), |l| format!(" ({}: {})", l.id, l.reason));
        let hint =
            if *matching == Matching::Id { "; frames that differ in fog match by pair id" } else { "" };
        let reason = format!("not one frame of A has a partner in B{why}{hint}");
        return Err(Error::Incomparable { a: a.to_path_buf(), b: b.to_path_buf(), reason });
    }
    Ok(matched)
}

fn plan_of(dir: &Path) -> Result<Vec<PlanFrame>, Error> {
    read_header(dir)?;
    Ok(read_plan(dir)?)
}

/// The frames of B by what they are matched by.
struct Partners<'a> {
    matching: &'a Matching,
    plan: &'a [PlanFrame],
    places: HashMap<&'a str, Vec<usize>>,
}

impl<'a> Partners<'a> {
    fn of(plan: &'a [PlanFrame], matching: &'a Matching) -> Self {
        let mut places: HashMap<&str, Vec<usize>> = HashMap::new();
        for (i, frame) in plan.iter().enumerate() {
            let wanted = match matching {
                Matching::Reference(reference) => reference.is_true_of(&frame.spec),
                Matching::Id | Matching::PairId => true,
            };
            if wanted && let Some(key) = key(frame, matching) {
                places.entry(key).or_default().push(i);
            }
        }
        Self { matching, plan, places }
    }

    /// Place of a frame's partner, or why it has none.
    fn find(&self, frame: &PlanFrame) -> Result<usize, String> {
        let key = key(frame, self.matching).ok_or("it has no pair id")?;
        let places = self.places.get(key).map_or(&[][..], Vec::as_slice);
        match (self.matching, places) {
            (_, &[one]) => Ok(one),
            (Matching::Id, _) => Err("B has no frame of this id".to_owned()),
            (Matching::PairId, []) => Err(format!("B has no frame of its pair {key}")),
            (Matching::Reference(reference), []) => {
                Err(format!("B has no frame of its pair {key} with {reference}"))
            }
            (Matching::Reference(reference), several) => {
                let n = several.len();
                Err(format!("B has {n} frames of its pair {key} with {reference}; one is needed"))
            }
            (Matching::PairId, several) => {
                let clear = |&&i: &&usize| self.plan[i].spec["fog"]["model"] == "none";
                let n = several.len();
                let message = || format!("B has {n} frames of its pair {key}, but none without fog");
                several.iter().find(clear).copied().ok_or_else(message)
            }
        }
    }
}

fn key<'f>(frame: &'f PlanFrame, matching: &Matching) -> Option<&'f str> {
    match matching {
        Matching::Id => Some(&frame.id),
        Matching::PairId | Matching::Reference(_) => frame.pair_id.as_deref(),
    }
}

/// Means of the figures of several comparisons.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Means {
    /// Of each statistic of ΔE.
    pub delta_e: DeltaE,
    /// Of the relative MSE.
    pub relative_mse: f64,
    /// Of the mean square difference of 8-bit values.
    pub mse_srgb8: f64,
    /// Of the mean relative difference.
    pub mean_relative_difference: f64,
    /// Of the relative difference of the means.
    pub relative_difference_of_means: f64,
}

impl Means {
    /// Of at least one comparison.
    #[must_use]
    pub fn of(all: &[&Comparison]) -> Self {
        let mean = |figure: fn(&Comparison) -> f64| {
            all.iter().map(|c| figure(c)).sum::<f64>() / all.len().max(1) as f64
        };
        Self {
            delta_e: DeltaE {
                mean: mean(|c| c.delta_e.mean),
                median: mean(|c| c.delta_e.median),
                p95: mean(|c| c.delta_e.p95),
                p99: mean(|c| c.delta_e.p99),
                max: mean(|c| c.delta_e.max),
            },
            relative_mse: mean(|c| c.relative_mse),
            mse_srgb8: mean(|c| c.mse_srgb8),
            mean_relative_difference: mean(|c| c.mean_relative_difference),
            relative_difference_of_means: mean(|c| c.relative_difference_of_means),
        }
    }

    /// PSNR in dB of the mean square difference (not the mean of the PSNRs, which equal frames would make infinite).
    #[must_use]
    pub fn psnr_db(&self) -> f64 {
        psnr_db(self.mse_srgb8)
    }
}
