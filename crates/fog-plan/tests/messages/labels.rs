//! Mistakes in `classes` and `labels`.

use super::errors;

#[test]
fn classes_and_labels() {
    assert_eq!(
        errors("fog: none\nclasses: {car: \"car_*\", \"\": a, road: [], tree: {material: \"\"}}\n"),
        [
            "configs/x.yaml:7:10: classes: \"\" is not a name of a class: use 1 to 64 letters",
            "configs/x.yaml:7:38: classes.road: empty; name nodes, meshes or materials, such as \"car_*\" or \
             {material: \"paint*\"}",
            "configs/x.yaml:7:48: classes.tree: empty; name nodes, meshes or materials, such as \"car_*\" or \
             {material: \"paint*\"}",
        ]
    );
    assert_eq!(
        errors("fog: none\nlabels: {contrast_threshold: 0, min_pixels: 0, min_pixel: 3}\n"),
        [
            "configs/x.yaml:7:48: labels.min_pixel: unknown key; expected one of contrast_threshold, min_pixels; did you \
             mean `min_pixels`?",
            "configs/x.yaml:7:30: labels.contrast_threshold: 0 is out of range; valid: 0.001 to 1",
            "configs/x.yaml:7:45: labels.min_pixels: 0 is out of range; valid: 1 to 1000000",
        ]
    );
    assert_eq!(
        errors("fog: none\nclasses: {car: 7}\n"),
        ["configs/x.yaml:7:16: classes.car: a name, {material: NAME}, or a list of them"]
    );
    assert_eq!(
        errors("fog: none\nclasses: [car]\n"),
        ["configs/x.yaml:7:10: classes: expected a map, found a list of 1 item"]
    );
    assert_eq!(
        errors("fog: none\noutputs: [image, flow]\n"),
        ["configs/x.yaml:7:18: outputs.1: flow is the motion to the next pose of a path: give `path`"]
    );
    let many: String = (0..201).map(|i| format!("c{i}: a, ")).collect();
    assert_eq!(
        errors(&format!("fog: none\nclasses: {{{many}}}\n")),
        ["configs/x.yaml:7:10: classes: 201 classes are too many; at most 200"]
    );
}
