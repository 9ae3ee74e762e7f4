"""Labels as Python's readers see them: OpenCV, OpenEXR and Pillow agree on the files, and geometry on the labels."""


import cv2
import numpy as np
import pytest
from conftest import rendered
from fogbank_tools.dataset import classes, plan, read_frame

CONFIG = """
version: 1
name: labels
scene: {generate: urban, length_m: 80}
fog: {model: homogeneous, height_m: 60, sigma_t_1_m: 0.03, phase: {hg: 0.8}}
path: {poses: [{position_m: [1.6, 1.5, 0]}, {position_m: [1.6, 1.5, -0.4], heading_deg: 1}]}
sensor: {width_px: 64, height_px: 36}
render: {samples: 2}
outputs: [image, hdr, depth, normals, position, albedo, semantic, instance, flow, objects]
"""


@pytest.fixture(scope="module")
def frames(tmp_path_factory):
    folder = rendered(tmp_path_factory, "labels", CONFIG)
    return folder, [read_frame(folder, line["id"]) for line in plan(folder)]


def test_masks_are_what_opencv_reads(frames):
    folder, (first, _) = frames
    for kind, dtype in (("semantic", np.uint8), ("instance", np.uint16)):
        mask = cv2.imread(str(folder / f"{first.id}.{kind}.png"), cv2.IMREAD_UNCHANGED)
        assert mask.dtype == dtype and mask.shape == (36, 64)
        assert (mask == getattr(first, kind)).all()
    names = {i: c["name"] for i, c in classes(folder).items()}
    assert names[23] == "sky" and set(np.unique(first.semantic)) <= set(names)
    visible = {o["instance"]: o["visible_pixels"] for o in first.objects if o["visible_pixels"]}
    ids, counts = np.unique(first.instance[first.instance > 0], return_counts=True)
    assert dict(zip(ids.tolist(), counts.tolist())) == visible


def test_positions_project_to_their_pixels_and_flow_to_the_next_frame(frames):
    _, (first, second) = frames
    points = np.stack([first.channels[f"P.{c}"] for c in "XYZ"], axis=-1).astype(float)
    normals = np.stack([first.channels[f"N.{c}"] for c in "XYZ"], axis=-1)
    solid = np.isfinite(points[..., 0])
    assert (np.isfinite(first.channels["depth.Z"]) == solid).all()
    assert np.abs(np.linalg.norm(normals[solid], axis=-1) - 1).max() < 1e-5
    centres = np.stack(np.meshgrid(np.arange(64.0), np.arange(36.0)), axis=-1)
    flow = np.stack([first.channels["flow.X"], first.channels["flow.Y"]], axis=-1)
    for frame, want in ((first, centres), (second, centres + flow)):
        world = np.array(frame.record["camera"]["world_from_camera"])
        inner = frame.record["sensor"]["intrinsics"]
        matrix = np.array([[inner["fx_px"], 0, inner["cx_px"]], [0, inner["fy_px"], inner["cy_px"]], [0, 0, 1]])
        # OpenCV's own projection, in its coordinates.
        rotation, shift = world[:3, :3].T, -world[:3, :3].T @ world[:3, 3]
        ahead = solid & np.isfinite(want[..., 0])
        found, _ = cv2.projectPoints(points[ahead], cv2.Rodrigues(rotation)[0], shift, matrix, None)
        assert np.abs(found[:, 0] - want[ahead]).max() < 0.01
    assert np.isnan(second.channels["flow.X"]).all() and not second.channels["flow_valid.Y"].any()
