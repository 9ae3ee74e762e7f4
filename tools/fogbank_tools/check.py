"""fogbank-check FOLDER: do the frames of a data set keep what the documentation promises?"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

from .dataset import Frame, plan, read_frame


def _close(name: str, got: np.ndarray, want: np.ndarray, tolerance: float) -> list[str]:
    # Truth is NaN where the lens shows nothing.
    off = np.where(np.isnan(got) & np.isnan(want), 0.0, np.abs(got - want))
    worst = float(np.max(off, initial=0.0))
    return [] if worst <= tolerance else [f"{name}: off by {worst:.3g}, allowed {tolerance:.3g}"]


def check_frame(frame: Frame) -> list[str]:
    """Everything that is wrong with a frame; empty if nothing is."""
    c, problems = frame.channels, []
    for x in "RGB":
        if {x, f"direct.{x}", f"airlight.{x}"} <= c.keys():
            scale = float(np.max(np.abs(c[x]), initial=1e-6))
            total = c[f"direct.{x}"] + c[f"airlight.{x}"]
            problems += _close(f"direct + airlight = image, {x}", total, c[x], 1e-6 * scale)
    if {"transmittance.G", "tau.Y"} <= c.keys():
        want = np.exp(-c["tau.Y"].astype(np.float64))
        problems += _close("transmittance.G = exp(-tau)", c["transmittance.G"], want, 1e-6)
    if {"depth.Z", "distance.Z"} <= c.keys():
        depth, distance = c["depth.Z"], c["distance.Z"]
        seen = np.isfinite(distance)
        if not np.array_equal(seen, np.isfinite(depth)):
            problems.append("depth and distance see different skies")
        k = frame.record["sensor"]["intrinsics"]
        if k.get("distortion") == "none":
            rows, columns = np.indices(depth.shape)
            x, y = (columns - k["cx_px"]) / k["fx_px"], (rows - k["cy_px"]) / k["fy_px"]
            want = distance / np.sqrt(1 + x * x + y * y)
            problems += _close("depth = distance * cos, relative", depth[seen] / want[seen], 1.0, 1e-4)
    # The picture of a sensor has its noise.
    if frame.image is not None and "R" in c and "raw" not in frame.record["sensor"]:
        linear = np.stack([c[x] for x in "RGB"], -1) * frame.record["sensor"]["exposure"]
        linear = np.clip(linear, 0, 1)
        srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
        problems += _close("image = sRGB of exposure * hdr, in steps", frame.image, np.round(srgb * 255), 1.0)
    pose = np.array(frame.record["camera"]["world_from_camera"])
    problems += _close("pose is a rotation", pose[:3, :3] @ pose[:3, :3].T, np.eye(3), 1e-5)
    if np.linalg.det(pose[:3, :3]) < 0:
        problems.append("pose mirrors")
    if frame.record["fog"]["model"] == "none" and "tau.Y" in c:
        unseen = np.isnan(c["tau.Y"])
        problems += _close("no fog, no optical depth", c["tau.Y"][~unseen], 0.0, 0.0)
    return problems


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="data set made by fogbank sweep or fogbank render")
    folder = parser.parse_args().folder
    bad = 0
    lines = plan(folder)
    for line in lines:
        try:
            problems = check_frame(read_frame(folder, line["id"]))
        except FileNotFoundError as e:
            problems = [str(e)]
        for problem in problems:
            print(f"{line['id']}: {problem}")
        bad += bool(problems)
    print(f"{folder}: {len(lines) - bad} of {len(lines)} frames are as documented")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
