"""The checks against a data set that the real program makes, and against damaged copies of it."""

from pathlib import Path

import numpy as np
import pytest
from conftest import rendered
from fogbank_tools.check import check_frame
from fogbank_tools.dataset import plan, read_frame

ROOT = Path(__file__).resolve().parents[2]
CONFIG = f"""
version: 1
name: tools
scene: {{file: {ROOT}/scenes/street.glb}}
fog: none
camera: {{altitude_m: 2}}
sensor: {{width_px: 48, height_px: 27}}
render: {{samples: 4}}
sweep:
  axes:
    fog: [none, {{model: advection, height_m: 100}}, {{model: homogeneous, height_m: 50, sigma_t_1_m: 0.01}}]
    camera.heading_deg: [0, 40]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return rendered(tmp_path_factory, "tools", CONFIG)


def test_frames_are_as_documented(folder):
    lines = plan(folder)
    assert len(lines) == 6
    for line in lines:
        assert check_frame(read_frame(folder, line["id"])) == []


@pytest.mark.parametrize("channel", ["R", "airlight.G", "transmittance.G", "tau.Y", "depth.Z"])
def test_damage_is_found(folder, channel):
    frame = read_frame(folder, plan(folder)[2]["id"])
    where = np.isfinite(frame.channels[channel])
    frame.channels[channel] = np.where(where, frame.channels[channel] * 1.01 + 0.01, frame.channels[channel])
    assert check_frame(frame) != []


def test_missing_frame_is_named(folder):
    with pytest.raises(FileNotFoundError, match="no-such-frame"):
        read_frame(folder, "no-such-frame")
