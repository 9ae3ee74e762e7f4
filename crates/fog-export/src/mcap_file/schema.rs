//! Foxglove's messages (github.com/foxglove/schemas): the fields of each, with their numbers and types.

/// Names and fields: `name=number type`, `*` before the type of a list; `Type: A|B` are the values of a message's own `Type`.
pub(super) const MESSAGES: &[(&str, &str)] = &[
    ("Vector3", "x=1 double, y=2 double, z=3 double"),
    ("Point3", "x=1 double, y=2 double, z=3 double"),
    ("Quaternion", "x=1 double, y=2 double, z=3 double, w=4 double"),
    ("Pose", "position=1 Vector3, orientation=2 Quaternion"),
    ("Color", "r=1 double, g=2 double, b=3 double, a=4 double"),
    ("KeyValuePair", "key=1 string, value=2 string"),
    ("CompressedImage", "timestamp=1 Timestamp, frame_id=4 string, data=2 bytes, format=3 string"),
    (
        "RawImage",
        "timestamp=1 Timestamp, frame_id=7 string, width=2 fixed32, height=3 fixed32, encoding=4 string, \
         step=5 fixed32, data=6 bytes",
    ),
    (
        "CameraCalibration",
        "timestamp=1 Timestamp, frame_id=9 string, width=2 fixed32, height=3 fixed32, distortion_model=4 string, \
         D=5 *double, K=6 *double, R=7 *double, P=8 *double",
    ),
    (
        "FrameTransform",
        "timestamp=1 Timestamp, parent_frame_id=2 string, child_frame_id=3 string, translation=4 Vector3, \
         rotation=5 Quaternion",
    ),
    (
        "ArrowPrimitive",
        "pose=1 Pose, shaft_length=2 double, shaft_diameter=3 double, head_length=4 double, head_diameter=5 double, \
         color=6 Color",
    ),
    ("CubePrimitive", "pose=1 Pose, size=2 Vector3, color=3 Color"),
    ("SpherePrimitive", "pose=1 Pose, size=2 Vector3, color=3 Color"),
    (
        "CylinderPrimitive",
        "pose=1 Pose, size=2 Vector3, bottom_scale=3 double, top_scale=4 double, color=5 Color",
    ),
    (
        "LinePrimitive",
        "Type: LINE_STRIP|LINE_LOOP|LINE_LIST, type=1 Type, pose=2 Pose, thickness=3 double, scale_invariant=4 bool, \
         points=5 *Point3, color=6 Color, colors=7 *Color, indices=8 *fixed32",
    ),
    (
        "TriangleListPrimitive",
        "pose=1 Pose, points=2 *Point3, color=3 Color, colors=4 *Color, indices=5 *fixed32",
    ),
    (
        "TextPrimitive",
        "pose=1 Pose, billboard=2 bool, font_size=3 double, scale_invariant=4 bool, color=5 Color, text=6 string",
    ),
    (
        "ModelPrimitive",
        "pose=1 Pose, scale=2 Vector3, color=3 Color, override_color=4 bool, url=5 string, media_type=6 string, \
         data=7 bytes",
    ),
    ("SceneEntityDeletion", "Type: MATCHING_ID|ALL, timestamp=1 Timestamp, type=2 Type, id=3 string"),
    (
        "SceneEntity",
        "timestamp=1 Timestamp, frame_id=2 string, id=3 string, lifetime=4 Duration, frame_locked=5 bool, \
         metadata=6 *KeyValuePair, arrows=7 *ArrowPrimitive, cubes=8 *CubePrimitive, spheres=9 *SpherePrimitive, \
         cylinders=10 *CylinderPrimitive, lines=11 *LinePrimitive, triangles=12 *TriangleListPrimitive, \
         texts=13 *TextPrimitive, models=14 *ModelPrimitive",
    ),
    ("SceneUpdate", "deletions=1 *SceneEntityDeletion, entities=2 *SceneEntity"),
];

/// A part of a message's line.
pub(super) enum Step<'a> {
    /// A field.
    Field { name: &'a str, number: u64, kind: &'a str, repeated: bool },
    /// Names of the values of `Type`, from 0 on, with `|` between them.
    Choice(&'a str),
}

impl<'a> Step<'a> {
    /// The parts of a line.
    pub(super) fn all(line: &'a str) -> impl Iterator<Item = Self> {
        line.split(", ").filter_map(|part| {
            if let Some(names) = part.strip_prefix("Type: ") {
                return Some(Self::Choice(names));
            }
            let (name, rest) = part.trim_start().split_once('=')?;
            let (number, kind) = rest.split_once(' ')?;
            let repeated = kind.starts_with('*');
            Some(Self::Field {
                name,
                number: number.parse().ok()?,
                kind: kind.trim_start_matches('*'),
                repeated,
            })
        })
    }
}
