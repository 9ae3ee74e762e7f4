"""A small data set, made once."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import fogbank
import pytest

CONFIG: dict[str, Any] = {
    "version": 1,
    "name": "small",
    "seed": 3,
    "scene": "none",
    "fog": {"model": "advection", "height_m": 100},
    "lighting": "day",
    "sensor": {"width_px": 16, "height_px": 9, "horizontal_fov_deg": 60},
    "render": {"samples": 4},
    "outputs": ["image", "hdr", "depth", "distance", "transmittance", "tau", "direct", "airlight", "semantic", "instance"],
    "sweep": {"axes": {"fog.height_m": [100, 180, 260], "camera.altitude_m": [2, 30]}},
}


@pytest.fixture(scope="session")
def data(tmp_path_factory: pytest.TempPathFactory) -> fogbank.DataSet:
    out: Path = tmp_path_factory.mktemp("small")
    return fogbank.sweep(CONFIG, out)
