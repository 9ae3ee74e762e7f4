//! Classes of objects.

/// Classes that nodes carry in `extras.class`: those of Cityscapes (Cordts et al. 2016) under their own names as far as they
/// reach, then those of airfields.
pub const CLASSES: [&str; 27] = [
    "road",
    "sidewalk",
    "building",
    "wall",
    "fence",
    "guard rail",
    "pole",
    "traffic light",
    "traffic sign",
    "vegetation",
    "terrain",
    "person",
    "rider",
    "car",
    "truck",
    "bus",
    "bicycle",
    "license plate",
    "street light",
    "marking",
    "runway",
    "taxiway",
    "runway marking",
    "runway light",
    "approach light",
    "taxiway light",
    "papi",
];
