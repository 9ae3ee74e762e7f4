//! Classes and instances as Cityscapes numbers them.

use std::collections::{BTreeMap, HashMap};

use fog_dataset::FileKind;
use serde_json::{Value, json};

use super::outline::outlines;
use crate::Result;
use crate::classes::{Classes, MOVERS};
use crate::frame::Frame;
use crate::summary::Losses;

/// Labels of Cityscapes are up to this one.
const LAST: u16 = 33;
/// −1 in Cityscapes: what is under the plate has its place.
const LICENSE_PLATE: u16 = 34;

/// The labels of a picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Labels {
    pub(super) size: [u32; 2],
    /// Cityscapes' label of each pixel.
    pub(super) ids: Vec<u8>,
    /// Our number of the thing of each pixel.
    things: Vec<u16>,
    /// Number among the things of its label, from 0.
    numbers: HashMap<u16, u16>,
}

/// The label that stands for a class that Cityscapes lacks.
fn stand_in(class: &str) -> u8 {
    match class {
        "street light" => 17,
        "marking" => 7,
        "runway" | "taxiway" | "runway marking" => 6,
        "runway light" | "approach light" | "taxiway light" | "papi" => 4,
        _ => 0,
    }
}

impl Labels {
    /// The labels of a frame.
    pub(super) fn of(frame: &Frame<'_>, classes: &Classes, losses: &Losses) -> Result<Self> {
        let semantic = frame.mask(FileKind::Semantic)?;
        let mut things = frame.mask(FileKind::Instance)?.values;
        if semantic.values.len() != things.len() {
            return Err(frame.damaged("instance.png", "it has not as many pixels as semantic.png"));
        }
        let size = [semantic.width, semantic.height];
        let mut values = semantic.values;
        cover_plates(&mut values, &mut things, size[0] as usize);
        let mut others = 0;
        let id = |&class: &u16| match u8::try_from(class) {
            Ok(id) if class <= LAST => id,
            _ => {
                others += 1;
                classes.get(u64::from(class)).map_or(0, |class| stand_in(&class.name))
            }
        };
        let ids: Vec<u8> = values.iter().map(id).collect();
        losses.add(
            "classes_of_our_own",
            others,
            "pixels of classes that Cityscapes lacks, as pole, road, ground, static or unlabeled",
        );
        Ok(Self { numbers: numbers(&ids, &things), size, ids, things })
    }

    /// 1000 · label + number for things that are told apart, else the label.
    pub(super) fn instance_ids(&self) -> Vec<u16> {
        let id = |(&id, thing): (&u8, &u16)| match self.numbers.get(thing) {
            Some(number) if MOVERS.contains(&u64::from(id)) => 1000 * u16::from(id) + number,
            _ => u16::from(id),
        };
        self.ids.iter().zip(&self.things).map(id).collect()
    }

    /// Red, green, blue and opacity of each pixel.
    pub(super) fn colours(&self, classes: &Classes) -> Vec<u8> {
        let colour = |id: u8| {
            let [r, g, b] = classes.get(u64::from(id)).map_or([0; 3], |class| class.colour);
            [r, g, b, 255]
        };
        let table: Vec<[u8; 4]> = (0..=u8::MAX).map(colour).collect();
        self.ids.iter().flat_map(|&id| table[usize::from(id)]).collect()
    }

    /// The outlines, larger ones first, so that one that is painted later lies over those around it.
    pub(super) fn polygons(&self, classes: &Classes, losses: &Losses) -> Value {
        let ids = self.instance_ids();
        let mut all = outlines(&ids, self.size);
        all.sort_by_key(|outline| std::cmp::Reverse(outline.twice_area));
        let mut pieces: BTreeMap<u16, u64> = BTreeMap::new();
        let objects: Vec<Value> = all
            .iter()
            .map(|outline| {
                if outline.value >= 1000 {
                    *pieces.entry(outline.value).or_default() += 1;
                }
                let id = if outline.value >= 1000 { outline.value / 1000 } else { outline.value };
                let name = classes.get(u64::from(id)).map_or("unlabeled", |class| &class.name);
                json!({ "label": name, "polygon": outline.points })
            })
            .collect();
        let split = pieces.values().map(|n| n - 1).sum();
        losses.add(
            "split_things",
            split,
            "polygons more than there are things, for things in several pieces (instanceIds.png has them whole)",
        );
        json!({ "imgWidth": self.size[0], "imgHeight": self.size[1], "objects": objects })
    }
}

/// Numbers the things of each label from 0, at most 1000.
fn numbers(ids: &[u8], things: &[u16]) -> HashMap<u16, u16> {
    let mut seen: BTreeMap<u16, u8> = BTreeMap::new();
    for (&id, &thing) in ids.iter().zip(things) {
        if thing != 0 && MOVERS.contains(&u64::from(id)) {
            seen.entry(thing).or_insert(id);
        }
    }
    let mut next = [0u16; 256];
    let mut all = HashMap::new();
    for (thing, id) in seen {
        let number = &mut next[usize::from(id)];
        // Beyond it the next label's numbers begin: such a thing keeps its label alone, as Cityscapes' groups do.
        if *number < 1000 {
            all.insert(thing, *number);
            *number += 1;
        }
    }
    all
}

/// Gives the pixels of license plates to the vehicle around them: the nearest pixel along the row, then along the column, that
/// is of one; without one they are unlabeled.
fn cover_plates(classes: &mut [u16], things: &mut [u16], width: usize) {
    let is_vehicle = |class: u16| (26..=33).contains(&class);
    let plates: Vec<usize> = (0..classes.len()).filter(|&i| classes[i] == LICENSE_PLATE).collect();
    let rows = classes.len().checked_div(width).unwrap_or_default();
    let find = |i: usize, classes: &[u16]| -> Option<usize> {
        let (x, y) = (i % width, i / width);
        let along = |n: usize, limit: usize, at: &dyn Fn(usize) -> usize| -> Option<usize> {
            (1..limit).find_map(|d| {
                let sides = [n.checked_sub(d), Some(n + d).filter(|m| *m < limit)];
                sides.into_iter().flatten().map(at).find(|&j| is_vehicle(classes[j]))
            })
        };
        along(x, width, &|x| y * width + x).or_else(|| along(y, rows, &|y| y * width + x))
    };
    let under: Vec<Option<usize>> = plates.iter().map(|&i| find(i, classes)).collect();
    for (i, under) in plates.into_iter().zip(under) {
        (classes[i], things[i]) = under.map_or((0, 0), |j| (classes[j], things[j]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plates_become_the_car_around_them_and_things_are_numbered_by_label() {
        let mut classes = vec![7, 26, 34, 26, 7, 7, 26, 26, 26, 24];
        let mut things = vec![1, 5, 9, 5, 1, 1, 5, 5, 3, 8];
        cover_plates(&mut classes, &mut things, 5);
        assert_eq!((classes[2], things[2]), (26, 5));
        let ids: Vec<u8> = classes.iter().map(|&c| c as u8).collect();
        let labels = Labels { numbers: numbers(&ids, &things), size: [5, 2], ids, things };
        let want = [7, 26001, 26001, 26001, 7, 7, 26001, 26001, 26000, 24000];
        assert_eq!(labels.instance_ids(), want);
    }

    #[test]
    fn a_plate_without_a_car_is_unlabeled() {
        let (mut classes, mut things) = (vec![7, 34], vec![1, 2]);
        cover_plates(&mut classes, &mut things, 2);
        assert_eq!((classes, things), (vec![7, 0], vec![1, 0]));
    }
}
