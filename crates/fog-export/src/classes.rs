//! The classes of a data set.

use std::ops::RangeInclusive;

use serde_json::Value;

use crate::job::Job;
use crate::{Error, Result};

/// Cityscapes' people and vehicles: the classes whose things it tells apart.
pub(crate) const MOVERS: RangeInclusive<u64> = 24..=33;

/// A class of `classes.json`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Class {
    /// Its number in the semantic mask: Cityscapes' up to 33.
    pub(crate) id: u16,
    pub(crate) name: String,
    /// 8-bit sRGB.
    pub(crate) colour: [u8; 3],
    chosen: bool,
}

impl Class {
    /// Cityscapes' category; our own and the configuration's classes are `fogbank`.
    pub(crate) fn group(&self) -> &'static str {
        match self.id {
            0..=6 => "void",
            7..=10 => "flat",
            11..=16 => "construction",
            17..=20 => "object",
            21..=22 => "nature",
            23 => "sky",
            24..=25 => "human",
            26..=34 => "vehicle",
            _ => "fogbank",
        }
    }
}

/// All classes, and which of them were asked for.
#[derive(Clone, Debug)]
pub(crate) struct Classes(Vec<Class>);

impl Classes {
    /// The classes of the data set, with those of `--classes` chosen.
    ///
    /// # Errors
    /// [`Error::Option`] for a name that is none of them; [`Error::DataSet`] when `classes.json` cannot be read.
    pub(crate) fn of(job: &Job<'_>) -> Result<Self> {
        let file = job.reader.classes()?.unwrap_or_default();
        let asked = &job.options.classes;
        let class = |value: &Value| {
            let channel = |c: usize| value["colour"][c].as_u64().and_then(|v| u8::try_from(v).ok());
            let name = value["name"].as_str()?.to_owned();
            Some(Class {
                id: value["id"].as_u64().and_then(|id| u16::try_from(id).ok())?,
                colour: [channel(0)?, channel(1)?, channel(2)?],
                chosen: asked.is_empty() || asked.contains(&name),
                name,
            })
        };
        let all: Vec<Class> =
            file["classes"].as_array().map_or(&[][..], Vec::as_slice).iter().filter_map(class).collect();
        for name in asked {
            if !all.iter().any(|class| class.name == *name) {
                let known: Vec<&str> = all.iter().map(|class| class.name.as_str()).collect();
                let known = known.join(", ");
                return Err(Error::Option(format!("the data set has no class `{name}`; it has {known}")));
            }
        }
        Ok(Self(all))
    }

    /// The class of a number.
    pub(crate) fn get(&self, id: u64) -> Option<&Class> {
        self.0.iter().find(|class| u64::from(class.id) == id)
    }

    /// The chosen classes, but for `unlabeled`.
    pub(crate) fn kept(&self) -> impl Iterator<Item = &Class> {
        self.0.iter().filter(|class| class.chosen && class.id != 0)
    }

    /// Whether a thing is of a chosen class.
    pub(crate) fn keeps(&self, object: &Value) -> bool {
        object["class_id"].as_u64().and_then(|id| self.get(id)).is_some_and(|class| class.chosen)
    }
}
