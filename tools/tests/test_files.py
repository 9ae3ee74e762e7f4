"""The EXR files as `docs/files.md` has them, seen by OpenEXR and OpenCV and by an own reader of Cryptomatte."""

import json
import re
import struct
from pathlib import Path

import cv2
import mmh3
import numpy as np
import OpenEXR
import pytest
from conftest import rendered
from fogbank_tools.dataset import plan, read_frame

ROOT = Path(__file__).resolve().parents[2]
CONFIG = """
version: 1
name: files
scene: {generate: urban, length_m: 80}
fog: {model: homogeneous, height_m: 60, sigma_t_1_m: 0.03, phase: {hg: 0.8}}
path: {poses: [{position_m: [1.6, 1.5, 0], heading_deg: 3, pitch_deg: -2, roll_deg: 4}, {position_m: [1.6, 1.5, -0.4]}]}
sensor: {width_px: 64, height_px: 36}
lighting: {environment: {radiance: 1}, luminance_of_one_cd_m2: 250}
render: {samples: 2}
outputs: [image, hdr, depth, distance, transmittance, tau, direct, airlight, standard_error, samples, normals, position,
          albedo, semantic, instance, flow, objects, pair]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return rendered(tmp_path_factory, "files", CONFIG)


@pytest.fixture(scope="module")
def first(folder):
    return read_frame(folder, plan(folder)[0]["id"])


def header(folder, frame, kind):
    with OpenEXR.File(str(folder / f"{frame.id}.{kind}.exr"), separate_channels=True) as file:
        return dict(file.header())


def test_channels_and_attributes_are_documented(folder, first):
    text = (ROOT / "docs/files.md").read_text()
    layers = {name.rpartition(".")[0] for name in first.channels}
    assert len(layers) == 15 and "" in layers
    for layer in layers - {""}:
        assert f"| `{layer}." in text or f", `{layer}." in text, layer
    own = {}
    for kind in ("hdr", "gt", "clear"):
        own[kind] = {name for name in header(folder, first, kind) if "/" in name or "." in name or "orld" in name}
        for name in own[kind]:
            word = re.sub(r"^cryptomatte/[0-9a-f]{7}/", "", name.removeprefix("fogbank."))
            assert f"`{word}`" in text or f"`fogbank.{word}`" in text, name
    hdr = header(folder, first, "hdr")
    assert hdr["whiteLuminance"] == 250 and "whiteLuminance" not in header(folder, first, "gt")
    assert np.allclose(hdr["chromaticities"], (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290))


def test_camera_matrices_take_positions_to_depths_and_pixels(folder, first):
    attributes = header(folder, first, "gt")
    points = np.stack([first.channels[f"P.{c}"] for c in "XYZ"], axis=-1).astype(float)
    solid = np.isfinite(points[..., 0])
    rows = np.concatenate([points[solid], np.ones((solid.sum(), 1))], axis=1)
    camera = rows @ attributes["worldToCamera"].astype(float)
    assert np.abs(camera[:, 2] / first.channels["depth.Z"][solid] - 1).max() < 1e-5
    assert np.abs(np.linalg.norm(camera[:, :3], axis=1) / first.channels["distance.Z"][solid] - 1).max() < 1e-5
    ndc = rows @ attributes["worldToNDC"].astype(float)
    ndc /= ndc[:, 3:]
    x, y = np.meshgrid((np.arange(64) + 0.5) / 64, (np.arange(36) + 0.5) / 36)
    assert np.abs(ndc[:, 0] - x[solid]).max() < 1e-4 and np.abs(ndc[:, 1] - y[solid]).max() < 1e-4
    # Left-handed, with y up.
    turn = attributes["worldToCamera"][:3, :3]
    assert np.linalg.det(turn) == pytest.approx(-1, abs=1e-5)
    assert camera[np.argmin(y[solid]), 1] > camera[np.argmax(y[solid]), 1]


def test_cryptomatte_gives_the_instance_masks(folder, first):
    attributes = header(folder, first, "gt")
    key = next(name for name in attributes if name.endswith("/name")).rpartition("/")[0]
    name = attributes[f"{key}/name"]
    assert key == "cryptomatte/" + f"{mmh3.hash(name, signed=False):08x}"[:7]
    assert attributes[f"{key}/hash"] == "MurmurHash3_32" and attributes[f"{key}/conversion"] == "uint32_to_float32"
    manifest = json.loads(attributes[f"{key}/manifest"])
    ids, coverage = (first.channels[f"{name}00.{c}"] for c in "RG")
    visible = [o for o in first.objects if o["visible_pixels"]]
    assert set(manifest) == {o["name"] for o in visible} and len(visible) > 20
    for thing in visible:
        bits = mmh3.hash(thing["name"], signed=False)
        exponent = min(max(bits >> 23 & 255, 1), 254)
        bits = bits & 0x807FFFFF | exponent << 23
        assert manifest[thing["name"]] == f"{bits:08x}"
        (value,) = struct.unpack("<f", struct.pack("<I", bits))
        assert ((ids == np.float32(value)) == (first.instance == thing["instance"])).all()
    assert (coverage == (first.instance > 0)).all() and (ids[first.instance == 0] == 0).all()
    assert not first.channels[f"{name}00.B"].any() and not first.channels[f"{name}00.A"].any()


def test_opencv_reads_the_pictures(folder, first):
    picture = cv2.imread(str(folder / f"{first.id}.hdr.exr"), cv2.IMREAD_UNCHANGED)
    assert picture.dtype == np.float32
    for i, c in enumerate("BGR"):
        assert (picture[..., i] == first.channels[c]).all()
    assert cv2.imread(str(folder / f"{first.id}.clear.exr"), cv2.IMREAD_UNCHANGED).shape == (36, 64, 3)
