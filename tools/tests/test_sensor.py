"""Raw pictures of the sensor, as OpenCV reads them."""

import os
import subprocess
from pathlib import Path

import cv2
import numpy as np
from fogbank_tools.check import check_frame
from fogbank_tools.dataset import plan, read_frame
from PIL import Image

FOGBANK = os.environ.get("FOGBANK", "fogbank")
CONFIG = """
version: 1
name: raw
scene: none
fog: none
lighting: {environment: {image: sky.png}}
sensor: {width_px: 24, height_px: 16, exposure: 0.9, model: {photon_noise: false, read_noise_e: 0, adc_bits: 14}}
render: {samples: 64}
outputs: [image, hdr, raw]
sweep: {axes: {sensor.model.bayer: [rggb, bggr, grbg, gbrg]}}
"""
CODES = ["COLOR_BayerBG2BGR", "COLOR_BayerRG2BGR", "COLOR_BayerGB2BGR", "COLOR_BayerGR2BGR"]


def test_opencv_finds_the_colours_of_every_pattern(tmp_path: Path):
    Image.new("RGB", (16, 8), (230, 150, 60)).save(tmp_path / "sky.png")
    (tmp_path / "raw.yaml").write_text(CONFIG)
    subprocess.run([FOGBANK, "sweep", "raw.yaml", "--out", "out", "--quiet"], check=True, cwd=tmp_path)
    patterns = set()
    for line in plan(tmp_path / "out"):
        frame = read_frame(tmp_path / "out", line["id"])
        assert check_frame(frame) == []
        raw = cv2.imread(str(tmp_path / "out" / f"{line['id']}.raw.png"), cv2.IMREAD_UNCHANGED)
        assert raw.dtype == np.uint16 and raw.shape == (16, 24)
        record = frame.record["sensor"]["raw"]
        patterns.add(record["pattern"])
        scale = record["gain_dn_per_e"] * record["saturation_e"]
        means = [0.9 * float(np.mean(frame.channels[c])) for c in "BGR"]
        want = np.array([record["black_level"] + scale * mean for mean in means])

        def error(code: str) -> float:
            bgr = cv2.cvtColor(raw, getattr(cv2, code)).reshape(-1, 3).mean(axis=0)
            return float(np.max(np.abs(bgr / want - 1)))

        errors = {code: error(code) for code in CODES}
        assert errors[record["opencv_code"]] < 0.01, errors
        assert all(e > 0.1 for code, e in errors.items() if code != record["opencv_code"]), errors
        # The developed picture has the colour of the light.
        shown = frame.image.reshape(-1, 3).mean(axis=0)
        linear = np.array(means[::-1])
        srgb = 255 * (1.055 * linear ** (1 / 2.4) - 0.055)
        assert np.max(np.abs(shown - srgb)) < 1.5, (shown, srgb)
    assert patterns == {"RGGB", "BGGR", "GRBG", "GBRG"}
