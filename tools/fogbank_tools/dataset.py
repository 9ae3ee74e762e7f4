"""A data set's frames as numpy arrays: nothing but the files' documented layout is known here."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenEXR
from PIL import Image


@dataclass
class Frame:
    """One frame: `channels` by name (float32, height x width, row 0 at the top), 8-bit `image` if there is one, `record`;
    `semantic` (uint8) and `instance` (uint16) by pixel and the records of `objects`, if they are there."""

    id: str
    channels: dict[str, np.ndarray]
    image: np.ndarray | None
    record: dict
    semantic: np.ndarray | None = None
    instance: np.ndarray | None = None
    objects: list[dict] | None = None


def read_exr(path: Path) -> dict[str, np.ndarray]:
    """All channels of an EXR file, by name."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: np.asarray(channel.pixels) for name, channel in file.channels().items()}


def plan(folder: Path) -> list[dict]:
    """The lines of plan.jsonl."""
    return [json.loads(line) for line in (folder / "plan.jsonl").read_text().splitlines()]


def classes(folder: Path) -> dict[int, dict]:
    """The classes of the data set by their ids; empty if it has none."""
    path = folder / "classes.json"
    return {c["id"]: c for c in json.loads(path.read_text())["classes"]} if path.is_file() else {}


def read_png(path: Path) -> np.ndarray | None:
    """A PNG as it is stored, or None if there is none."""
    return np.asarray(Image.open(path)) if path.is_file() else None


def read_frame(folder: Path, frame_id: str) -> Frame:
    """The frame with this id; raises FileNotFoundError if it is not done."""
    if not (folder / f"{frame_id}.done").is_file():
        raise FileNotFoundError(f"frame {frame_id} in {folder} is not done")
    channels: dict[str, np.ndarray] = {}
    for kind in ("hdr", "gt"):
        path = folder / f"{frame_id}.{kind}.exr"
        if path.is_file():
            channels |= read_exr(path)
    image, semantic, instance = (
        read_png(folder / f"{frame_id}.{kind}.png") for kind in ("rgb", "semantic", "instance")
    )
    record = json.loads((folder / f"{frame_id}.json").read_text())
    objects = folder / f"{frame_id}.objects.json"
    records = json.loads(objects.read_text())["objects"] if objects.is_file() else None
    return Frame(frame_id, channels, image, record, semantic, instance, records)
