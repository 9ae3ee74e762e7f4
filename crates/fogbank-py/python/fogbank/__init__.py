"""Fogbank: camera data in fog whose numbers can be traced to physics.

    data = fogbank.open("out/quickstart")                   # a data set of `fogbank sweep`
    foggy = data.where("fog.height_m >= 100")
    foggy[0].hdr, foggy[0]["depth"], foggy.table()          # NumPy arrays; pandas or polars

    fog = fogbank.Fog(height_m=180)                         # optics by itself
    fog.sigma_t([2, 90, 150], 550), fog.visibility(2)

    frame = fogbank.render("configs/quickstart.yaml", 4)    # without a folder

The guide is docs/python.md.
"""

from ._config import Plan, plan
from ._data_set import DataSet, open
from ._errors import ConfigError, DataSetError, FogbankError, RenderError
from ._fog import Fog
from ._fogbank import CODE_DIGEST, __version__
from ._frame import Frame
from ._render import render, sweep

__all__ = [
    "CODE_DIGEST",
    "ConfigError",
    "DataSet",
    "DataSetError",
    "Fog",
    "FogbankError",
    "Frame",
    "Plan",
    "RenderError",
    "__version__",
    "open",
    "plan",
    "render",
    "sweep",
]
