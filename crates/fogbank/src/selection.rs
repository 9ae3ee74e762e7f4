//! Which frames of a plan are rendered.

use crate::error::Error;
use crate::shared::share_sets;
use fog_plan::{Filter, FrameSpec, Plan};

/// Which of a plan's frames are to be rendered: those that meet every condition.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Frames by id, index, or unambiguous beginning of an id; empty: all.
    pub only: Vec<String>,
    /// A condition on their values.
    pub filter: Option<Filter>,
    /// A part of them, so that several runs share the work.
    pub shard: Shard,
}

/// Part `index` of `count` parts of the selected frames, which differ by one set of frames at most.
///
/// The parts are a function of the frames, not of what is done: any number of runs with the same `count` do every frame once, and
/// runs with another `count` go on where they stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which part, from 0.
    pub index: u64,
    /// Of how many, at least 1.
    pub count: u64,
}

impl Default for Shard {
    fn default() -> Self {
        Self { index: 0, count: 1 }
    }
}

impl Selection {
    /// One frame.
    #[must_use]
    pub fn one(frame: String) -> Self {
        Self { only: vec![frame], ..Self::default() }
    }

    /// By frame, whether it is selected.
    ///
    /// # Errors
    /// A frame that is not there, a condition on a value that no frame has, or a selection of nothing.
    pub(crate) fn of(&self, frames: &[FrameSpec]) -> Result<Vec<bool>, Error> {
        let mut selected = vec![self.only.is_empty(); frames.len()];
        for wanted in &self.only {
            selected[find(wanted, frames)?] = true;
        }
        if let Some(filter) = &self.filter {
            let matching = filter.matches(frames)?;
            selected.iter_mut().zip(matching).for_each(|(s, m)| *s &= m);
        }
        if !selected.contains(&true) {
            let filter = self.filter.as_ref().map_or_else(String::new, ToString::to_string);
            return Err(Error::NothingSelected { filter, count: frames.len() });
        }
        Ok(selected)
    }

    /// Sets of frames that share paths, in which a selected frame is, of this shard.
    pub(crate) fn sets(&self, frames: &[FrameSpec], selected: &[bool]) -> Vec<Vec<usize>> {
        let mut sets: Vec<Vec<usize>> =
            share_sets(frames).into_iter().filter(|set| set.iter().any(|&i| selected[i])).collect();
        let Shard { index, count } = self.shard;
        if count > 1 {
            // By digest, or the costly frames of an axis could all fall to one.
            let mut order: Vec<usize> = (0..sets.len()).collect();
            order.sort_by(|&a, &b| frames[sets[a][0]].digest.cmp(&frames[sets[b][0]].digest));
            let mut own: Vec<usize> =
                order.into_iter().zip(0..).filter(|(_, i)| i % count == index).map(|(set, _)| set).collect();
            own.sort_unstable();
            sets = own.into_iter().map(|set| std::mem::take(&mut sets[set])).collect();
        }
        sets
    }
}

/// The frames of a plan, and which of them is meant by an id, an index or the beginning of an id, or without one as the only frame.
///
/// # Errors
/// A frame that is not there, or several where none is named.
pub fn one_frame(plan: &Plan, wanted: Option<&str>) -> Result<(Vec<FrameSpec>, usize), Error> {
    let frames = plan.frames().collect::<Result<Vec<_>, _>>()?;
    let index = match wanted {
        Some(wanted) => find(wanted, &frames)?,
        None if frames.len() == 1 => 0,
        None => return Err(Error::NotOneFrame { name: plan.name().to_owned(), count: frames.len() }),
    };
    Ok((frames, index))
}

/// The frame with this id, index or beginning of an id.
///
/// # Errors
/// If there is none, or several.
fn find(wanted: &str, frames: &[FrameSpec]) -> Result<usize, Error> {
    let exact = frames.iter().position(|f| f.id == wanted);
    let by_index = || wanted.parse::<usize>().ok().filter(|&i| i < frames.len());
    // A number is an index and nothing else: a job array that counts too far must not render some frame twice.
    let by_prefix = || {
        if wanted.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let mut matches = (0..frames.len()).filter(|&i| frames[i].id.starts_with(wanted));
        matches.next().filter(|_| matches.next().is_none())
    };
    exact.or_else(by_index).or_else(by_prefix).ok_or_else(|| Error::UnknownFrame {
        wanted: wanted.to_owned(),
        count: frames.len(),
        example: frames[0].id.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames() -> Vec<FrameSpec> {
        let yaml = "version: 1\nname: t\nscene: none\nfog: {model: advection, height_m: 100}\nlighting: day\n\
                    sweep: {axes: {fog.height_m: [100, 120, 180], camera.altitude_m: [2, 5], lighting: [day, night]}}\n";
        let plan = fog_plan::parse(yaml, "t.yaml", &[]).expect("valid plan");
        plan.frames().map(|frame| frame.expect("frame")).collect()
    }

    #[test]
    fn shards_deal_every_set_once_and_evenly() {
        let frames = frames();
        let all = vec![true; frames.len()];
        for count in [1, 2, 5, 12, 40] {
            let mut seen = Vec::new();
            for index in 0..count {
                let selection = Selection { shard: Shard { index, count }, ..Selection::default() };
                let sets = selection.sets(&frames, &all);
                assert!((12 / count..=12_u64.div_ceil(count)).contains(&(sets.len() as u64)));
                seen.extend(sets.into_iter().flatten());
            }
            seen.sort_unstable();
            assert_eq!(seen, (0..12).collect::<Vec<_>>(), "{count} shards");
        }
    }

    #[test]
    fn conditions_are_met_together() {
        let frames = frames();
        let filter = Filter::parse("fog.height_m>=120, lighting=night").expect("filter");
        let selection = Selection { only: vec![], filter: Some(filter), shard: Shard::default() };
        let selected = selection.of(&frames).expect("some");
        let picked: Vec<usize> = (0..12).filter(|&i| selected[i]).collect();
        assert_eq!(picked, [5, 7, 9, 11]);
        let one = Selection { only: vec!["5".into(), "0".into()], ..selection };
        assert_eq!(one.of(&frames).expect("some").iter().filter(|s| **s).count(), 1);
        let none = Selection { only: vec!["0".into()], ..one };
        assert!(matches!(none.of(&frames), Err(Error::NothingSelected { .. })));
    }
}
