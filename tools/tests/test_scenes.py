"""The made scenes: valid for the Khronos validator, and seen by OpenCV where they say they are."""

import json
import os
import shutil
import struct
import subprocess
from pathlib import Path

import numpy as np
import pytest

FOGBANK = os.environ.get("FOGBANK", "fogbank")

VALIDATE = """
const validator = require('gltf-validator'), fs = require('fs');
const all = process.argv.slice(1).map(file =>
    validator.validateBytes(new Uint8Array(fs.readFileSync(file))).then(r => ({file, ...r.issues})));
Promise.all(all).then(reports => console.log(JSON.stringify(reports)));
"""

SCENES = {
    "street": [],
    "urban": ["--length-m", "80", "--traffic", "1"],
    "town": ["--length-m", "80", "--style", "mutcd"],
    "highway": ["--length-m", "300"],
    "runway": ["--flashers"],
    "targets": [],
}


def run(*args, cwd):
    subprocess.run(args, cwd=cwd, check=True, capture_output=True, text=True)


def test_khronos_validator_finds_nothing(tmp_path):
    if not (shutil.which("node") and shutil.which("npm")):
        pytest.skip("needs node and npm")
    installed = subprocess.run(
        ["npm", "install", "--silent", "--no-audit", "--no-fund", "gltf-validator@2.0.0-dev.3.10"],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )
    if installed.returncode != 0:
        pytest.skip(f"npm could not install gltf-validator: {installed.stderr[-200:]}")
    for name, options in SCENES.items():
        kind = "urban" if name == "town" else name
        run(FOGBANK, "scene", kind, *options, "--out", f"{name}.glb", cwd=tmp_path)
    files = [f"{name}.glb" for name in SCENES]
    out = subprocess.run(["node", "-e", VALIDATE, *files], cwd=tmp_path, check=True, capture_output=True, text=True)
    reports = json.loads(out.stdout)
    assert [r["file"] for r in reports] == files
    for report in reports:
        assert (report["numErrors"], report["numWarnings"]) == (0, 0), report["messages"][:5]


CONFIG = """
version: 1
name: targets
seed: 1
scene: {file: targets.glb}
fog: none
camera: {altitude_m: 2, position_m: [0, 0, 0], heading_deg: 0}
sensor: {width_px: 800, height_px: 200, horizontal_fov_deg: 40}
lighting: day
render: {samples: 48, max_depth: 2}
outputs: [image]
"""


def test_opencv_finds_markers_and_corners(tmp_path):
    cv2 = pytest.importorskip("cv2")
    run(FOGBANK, "scene", "targets", "--boards-m", "5,10", "--out", "targets.glb", cwd=tmp_path)
    (tmp_path / "c.yaml").write_text(CONFIG)
    run(FOGBANK, "sweep", "c.yaml", "--out", "out", "--quiet", cwd=tmp_path)
    (picture,) = Path(tmp_path, "out").rglob("*.rgb.png")
    grey = cv2.imread(str(picture), cv2.IMREAD_GRAYSCALE)

    focal = 400 / np.tan(np.radians(20))

    def pixel(point):
        x, y, z = point
        return np.array([400 + focal * x / -z, 100 - focal * (y - 2) / -z])

    glb = (tmp_path / "targets.glb").read_bytes()
    length = struct.unpack("<I", glb[12:16])[0]
    nodes = [n["extras"] for n in json.loads(glb[20:20 + length])["nodes"]]

    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    parameters = cv2.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    corners, ids, _ = cv2.aruco.ArucoDetector(dictionary, parameters).detectMarkers(grey)
    found = {int(i): c[0] for i, c in zip(ids.ravel(), corners)}
    markers = [n for n in nodes if n.get("target") == "aruco"]
    assert sorted(found) == [m["id"] for m in markers] == [0, 1, 2, 3]
    for marker in markers:
        want = np.array([pixel(c) for c in marker["corners_m"]])
        # OpenCV's pixels have their middles at whole numbers, ours at halves.
        assert np.abs(found[marker["id"]] + 0.5 - want).max() < 0.5

    boards = [n for n in nodes if n.get("target") == "checkerboard"]
    for board in boards:
        nx, ny = board["inner_corners"]
        first, along, down = (np.array(board[k]) for k in ("first_corner_m", "along_m", "down_m"))
        want = np.array([pixel(first + i * along + j * down) for j in range(ny) for i in range(nx)])
        (x0, y0), (x1, y1) = want.min(0) - 25, want.max(0) + 25
        part = grey[int(y0):int(y1), int(x0):int(x1)]
        ok, seen = cv2.findChessboardCornersSB(part, (nx, ny), cv2.CALIB_CB_ACCURACY)
        assert ok
        seen = seen.reshape(-1, 2) + [int(x0), int(y0)] + 0.5
        # The board may be read from either end.
        error = min(np.abs(order - want).max() for order in (seen, seen[::-1]))
        assert error < 0.15, error
