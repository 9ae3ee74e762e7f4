"""What a type checker must accept and know; mypy reads it, nothing runs it."""

from __future__ import annotations

from typing import Any

import fogbank
import numpy as np
from numpy.typing import NDArray


def sky_is_far(folder: str) -> list[str]:
    data: fogbank.DataSet = fogbank.open(folder)
    far: list[str] = []
    for frame in data.where("fog.height_m >= 180")[:3]:
        depth: NDArray[np.float32] = frame.depth
        instance: NDArray[np.uint16] = frame.instance
        values: NDArray[Any] = frame["hdr"]
        if bool(np.isinf(depth).any()) and instance.shape == values.shape[:2]:
            far.append(frame.id)
    return far


def one(config: dict[str, object]) -> fogbank.Frame:
    plan: fogbank.Plan = fogbank.plan(config, overrides={"fog.height_m": 260})
    seed: int = plan[0]["seed"]
    return fogbank.render(plan, plan.ids[0], threads=seed % 2 + 1, progress=lambda share, text: None)


def extinction(height_m: float) -> float:
    fog = fogbank.Fog(height_m=height_m)
    return float(fog.sigma_t(2.0, wavelength=905)) + float(fog.visibility(2.0, "allard", threshold_lx="day"))
