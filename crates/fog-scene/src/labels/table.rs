//! Classes by number: those of Cityscapes, those of Fogbank's own scenes, and a user's.

/// A class of surfaces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Class {
    /// Its number in semantic pictures.
    pub id: u8,
    /// Its name.
    pub name: String,
    /// Its number in training, as Cityscapes suggests: 255 is ignored.
    pub train_id: u8,
    /// 8-bit sRGB colour for pictures of classes.
    pub colour: [u8; 3],
}

/// Cityscapes' labels 0 to 33 in order: name, training id, colour (Cordts et al., "The Cityscapes dataset for semantic
/// urban scene understanding", CVPR 2016; cityscapesScripts, helpers/labels.py).
const CITYSCAPES: [(&str, u8, [u8; 3]); 34] = [
    ("unlabeled", 255, [0, 0, 0]),
    ("ego vehicle", 255, [0, 0, 0]),
    ("rectification border", 255, [0, 0, 0]),
    ("out of roi", 255, [0, 0, 0]),
    ("static", 255, [0, 0, 0]),
    ("dynamic", 255, [111, 74, 0]),
    ("ground", 255, [81, 0, 81]),
    ("road", 0, [128, 64, 128]),
    ("sidewalk", 1, [244, 35, 232]),
    ("parking", 255, [250, 170, 160]),
    ("rail track", 255, [230, 150, 140]),
    ("building", 2, [70, 70, 70]),
    ("wall", 3, [102, 102, 156]),
    ("fence", 4, [190, 153, 153]),
    ("guard rail", 255, [180, 165, 180]),
    ("bridge", 255, [150, 100, 100]),
    ("tunnel", 255, [150, 120, 90]),
    ("pole", 5, [153, 153, 153]),
    ("polegroup", 255, [153, 153, 153]),
    ("traffic light", 6, [250, 170, 30]),
    ("traffic sign", 7, [220, 220, 0]),
    ("vegetation", 8, [107, 142, 35]),
    ("terrain", 9, [152, 251, 152]),
    ("sky", 10, [70, 130, 180]),
    ("person", 11, [220, 20, 60]),
    ("rider", 12, [255, 0, 0]),
    ("car", 13, [0, 0, 142]),
    ("truck", 14, [0, 0, 70]),
    ("bus", 15, [0, 60, 100]),
    ("caravan", 255, [0, 0, 90]),
    ("trailer", 255, [0, 0, 110]),
    ("train", 16, [0, 80, 100]),
    ("motorcycle", 17, [0, 0, 230]),
    ("bicycle", 18, [119, 11, 32]),
];

/// Classes of the made scenes beyond Cityscapes' numbers. There a license plate is −1, which no picture of bytes can hold.
const OWN: [(&str, [u8; 3]); 10] = [
    ("license plate", [0, 60, 200]),
    ("street light", [255, 220, 120]),
    ("marking", [255, 255, 255]),
    ("runway", [90, 90, 110]),
    ("taxiway", [110, 90, 130]),
    ("runway marking", [235, 235, 255]),
    ("runway light", [255, 200, 0]),
    ("approach light", [255, 120, 0]),
    ("taxiway light", [0, 120, 255]),
    ("papi", [255, 60, 60]),
];

/// The classes of a data set, by number: `classes()[id].id == id`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassTable {
    classes: Vec<Class>,
}

impl ClassTable {
    /// Number of surfaces that nobody gave a class.
    pub const UNLABELED: u8 = 0;
    /// Number of the sky.
    pub const SKY: u8 = 23;
    /// Number of pixels that the lens does not show: `out of roi`.
    pub const UNSEEN: u8 = 3;
    /// Most classes beside the built-in ones: ids are bytes.
    pub const MOST_CUSTOM: usize = 256 - CITYSCAPES.len() - OWN.len();

    /// The built-in classes, and behind them those of `names` that are no built-in ones, in order and each once; names beyond
    /// [`ClassTable::MOST_CUSTOM`] are left out.
    #[must_use]
    pub fn new<'n>(names: impl IntoIterator<Item = &'n str>) -> Self {
        let cityscapes = CITYSCAPES.iter().map(|&(name, train_id, colour)| (name, train_id, colour));
        let own = OWN.iter().map(|&(name, colour)| (name, 255, colour));
        let mut table = Self { classes: Vec::new() };
        for (name, train_id, colour) in cityscapes.chain(own) {
            table.push(name, train_id, colour);
        }
        for name in names {
            if table.id(name).is_none() && table.classes.len() < 256 {
                table.push(name, 255, distinct_colour(table.classes.len()));
            }
        }
        table
    }

    fn push(&mut self, name: &str, train_id: u8, colour: [u8; 3]) {
        let id = self.classes.len() as u8;
        self.classes.push(Class { id, name: name.to_owned(), train_id, colour });
    }

    /// All classes, by number.
    #[must_use]
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// Number of the class with this name.
    #[must_use]
    pub fn id(&self, name: &str) -> Option<u8> {
        self.classes.iter().find(|class| class.name == name).map(|class| class.id)
    }

    /// Name of the class with this number.
    ///
    /// # Panics
    /// If there is none.
    #[must_use]
    pub fn name(&self, id: u8) -> &str {
        &self.classes[usize::from(id)].name
    }
}

/// Colours far apart for a user's classes: hues in steps of the golden section, fully saturated.
fn distinct_colour(index: usize) -> [u8; 3] {
    let hue = (index as f64 * 0.618_033_988_749_895).fract() * 6.0;
    let channel = |shift: f64| {
        let h = (hue + shift) % 6.0;
        ((h - 3.0).abs() - 1.0).clamp(0.0, 1.0) * 255.0
    };
    [channel(0.0), channel(4.0), channel(2.0)].map(|v| v.round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_cityscapes_and_then_on() {
        let table = ClassTable::new(["cone", "car", "cone", "deer"]);
        assert!(table.classes().iter().enumerate().all(|(i, class)| usize::from(class.id) == i));
        let ids = ["unlabeled", "road", "sky", "car", "bicycle", "license plate", "cone", "deer"];
        let want = [0, 7, 23, 26, 33, 34, 44, 45].map(Some);
        assert_eq!(ids.map(|name| table.id(name)), want);
        assert_eq!((table.name(ClassTable::SKY), table.id("Car")), ("sky", None));
        let cone = &table.classes()[44];
        assert!(cone.train_id == 255 && cone.colour != table.classes()[45].colour);
        let many: Vec<String> = (0..300).map(|i| format!("c{i}")).collect();
        let full = ClassTable::new(many.iter().map(String::as_str));
        assert_eq!(full.classes().len(), 256);
        assert_eq!(ClassTable::MOST_CUSTOM, 212);
    }
}
