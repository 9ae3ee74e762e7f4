"""What several test files need: data sets, each rendered once, and OpenCV's OpenEXR reader."""

import os
import subprocess
from pathlib import Path

import pytest

# OpenCV 4 reads OpenEXR files only if it is told so before it is imported.
os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"

ROOT = Path(__file__).resolve().parents[2]
STREET = """
version: 1
name: street
scene: {generate: urban, length_m: 80}
fog: {model: homogeneous, height_m: 60, sigma_t_1_m: 0.03, phase: {hg: 0.8}}
path: {poses: [{time_s: 0, position_m: [1.6, 1.5, 0]}, {time_s: 0.1, position_m: [1.6, 1.5, -0.4], heading_deg: 1}]}
cameras: {left: {position_m: [-0.25, 0, 0]}, right: {position_m: [0.25, 0, 0]}}
sensor: {width_px: 160, height_px: 90}
render: {samples: 2}
outputs: [image, hdr, depth, semantic, instance, objects]
"""
RUNWAY = """
version: 1
name: approach
scene: {generate: runway, length_m: 1200}
fog: {model: homogeneous, height_m: 200, sigma_t_1_m: 0.002, phase: {hg: 0.8}}
path: {glide_slope: {angle_deg: 3, from_m: 1500, to_m: 300, step_m: 400, lateral_deviation_deg: 1}}
sensor: {width_px: 160, height_px: 120}
render: {samples: 2}
lighting: day
outputs: [image, semantic, instance, objects]
"""


def run(*args, **more):
    """Runs the program."""
    return subprocess.run([os.environ["FOGBANK"], *map(str, args)], cwd=ROOT, capture_output=True, text=True, **more)


def rendered(factory, name, config):
    """The folder of a data set."""
    base = factory.mktemp(name)
    (base / "c.yaml").write_text(config)
    run("sweep", base / "c.yaml", "--out", base / "out", "--quiet", check=True)
    return base / "out"


@pytest.fixture(scope="session")
def street(tmp_path_factory):
    """A town by day in fog, two poses of a stereo rig: frames left, right, left, right."""
    return rendered(tmp_path_factory, "street", STREET)


@pytest.fixture(scope="session")
def approach(tmp_path_factory):
    """Four frames of an approach; the last one is over the threshold."""
    return rendered(tmp_path_factory, "approach", RUNWAY)
