"""Fog by itself: optics by altitude, wavelength and angle."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _fogbank
from ._config import to_json
from ._errors import ConfigError

_Numbers = NDArray[np.float64]

REFERENCE_NM = 550.0


class Fog:
    """A fog layer, from the keys of ``fog:`` in a configuration.

    >>> fog = fogbank.Fog(height_m=180)                     # the model is advection unless told otherwise
    >>> fog = fogbank.Fog(model="droplets", height_m=60, droplets="shettle_fenn_radiation_heavy")
    >>> fog = fogbank.Fog(model="homogeneous", height_m=100, sigma_t_1_m=0.02, phase={"hg": 0.85})
    >>> fog = fogbank.Fog(height_m=180, visibility={"mor_m": 300, "altitude_m": 2})

    Altitudes ``z`` are in metres over the fog's datum, wavelengths in nm, 200 to 2600, coefficients in 1/m, phase functions in 1/sr,
    ranges in m, angles in degrees. Arguments are numbers or arrays of any shapes that NumPy broadcasts; the answer is a ``float`` if
    all are numbers, else an array of the broadcast shape.

    From 375 to 800 nm these are the numbers that frames are rendered with: linear between 18 wavelengths, and in altitude between
    1025 levels. Beyond, Mie sums are done for each new wavelength (some hundredths of a second). Of patchy fog they are those of
    the mean layer.

    :param cache_dir: folder of optics tables, as of :func:`fogbank.plan`.
    :raises ConfigError: naming the key that is wrong, and what would be right.
    """

    def __init__(self, *, cache_dir: str | os.PathLike[str] | None = None, **keys: Any) -> None:
        keys.setdefault("model", "advection")
        if keys["model"] in ("none", None):
            fog: Any = "none"
            if len(keys) > 1:
                raise ConfigError(f"fog: model none has no {', '.join(sorted(set(keys) - {'model'}))}")
        else:
            fog = keys
        config = {"version": 1, "name": "fog", "scene": "none", "lighting": "day", "fog": fog}
        self._made_from = (keys, cache_dir)
        self._native = _fogbank.Fog(to_json(config), cache_dir)

    @property
    def spec(self) -> dict[str, Any]:
        """The fog with every value resolved, as in the record of a frame."""
        spec: dict[str, Any] = json.loads(self._native.spec_json())
        return spec

    @property
    def extent_m(self) -> tuple[float, float] | None:
        """Altitudes of the layer's base and top in m; none in clear air."""
        extent = self._native.extent_m()
        return None if extent is None else (extent[0], extent[1])

    def sigma_t(self, z: ArrayLike, wavelength: ArrayLike = REFERENCE_NM) -> Any:
        """Extinction coefficient in 1/m; 0 outside of the layer.

        :param z: altitude in m.
        :param wavelength: in nm.
        """
        return _broadcast(self._native.sigma_t, z, wavelength)

    def albedo(self, z: ArrayLike, wavelength: ArrayLike = REFERENCE_NM) -> Any:
        """Single-scattering albedo, 0 to 1, in single precision; NaN outside of the layer.

        :param z: altitude in m.
        :param wavelength: in nm.
        """
        return _broadcast(self._native.albedo, z, wavelength)

    def phase(self, z: ArrayLike, wavelength: ArrayLike, cos_theta: ArrayLike) -> Any:
        """Phase function in 1/sr, in single precision; over the sphere it integrates to 1. NaN outside of the layer.

        :param z: altitude in m.
        :param wavelength: in nm.
        :param cos_theta: cosine of the angle between the directions of travel before and after: 1 is straight on.
        """
        return _broadcast(self._native.phase, z, wavelength, cos_theta)

    def visibility(
        self,
        z: ArrayLike,
        law: Literal["mor", "koschmieder", "allard"] = "mor",
        *,
        wavelength: ArrayLike = REFERENCE_NM,
        intensity_cd: ArrayLike = 1000.0,
        threshold_lx: ArrayLike | str = "night",
        elevation_deg: ArrayLike | None = None,
    ) -> Any:
        """Visual range in m; +inf where nothing limits it. The ground does not end it.

        :param z: altitude in m of the eye.
        :param law: ``mor``: the meteorological optical range, a contrast of 5 %; ``koschmieder``: a dark object at 2 %, optical depth
            3.912; ``allard``: a light, E = I exp(−τ)/R².
        :param wavelength: in nm.
        :param intensity_cd: luminous intensity of the light in cd, for ``allard``.
        :param threshold_lx: least illuminance that is seen in lx, for ``allard``; or a name: ``night``, ``twilight``, ``day``,
            ``bright_day`` (ICAO), ``wmo_twilight``, ``wmo_moonlight``, ``wmo_dark``.
        :param elevation_deg: along a slant of this elevation, −90 straight down to 90 straight up, through the exact depth of the
            layer; by default horizontally.
        """
        if isinstance(threshold_lx, str):
            named = _fogbank.Fog.threshold_lx(threshold_lx)
            if named is None:
                names = ", ".join(_fogbank.Fog.threshold_names())
                raise ConfigError(f"threshold_lx is {threshold_lx!r}; valid: a number, {names}")
            threshold_lx = named

        def ranges(z: _Numbers, nm: _Numbers, i: _Numbers, e: _Numbers, *angle: _Numbers) -> _Numbers:
            return self._native.visibility(z, nm, law, i, e, angle[0] if angle else None)

        angles = () if elevation_deg is None else (elevation_deg,)
        return _broadcast(ranges, z, wavelength, intensity_cd, threshold_lx, *angles)

    def state(self, z: ArrayLike) -> dict[str, Any]:
        """What the fog is at an altitude, at 550 nm, by the names of a frame's record: ``sigma_t_1_m``, ``albedo``, ``g``, ``mor_m``,
        ``liquid_water_content_g_m3``, ``number_density_1_m3``, ``effective_radius_um``, ``mean_diameter_um``. NaN where there is no
        such value: in clear air, and of droplets where the model has none.

        :param z: altitude in m.
        """
        z = np.asarray(z, dtype=np.float64)
        columns = self._native.state(np.ascontiguousarray(z.ravel()))
        return {name: _shaped(column, z.shape) for name, column in zip(_fogbank.Fog.state_names(), columns)}

    def __repr__(self) -> str:
        keys = self._made_from[0]
        return f"fogbank.Fog({', '.join(f'{name}={value!r}' for name, value in keys.items())})"

    def __reduce__(self) -> tuple[Any, ...]:
        return _made, self._made_from


def _made(keys: dict[str, Any], cache_dir: str | os.PathLike[str] | None) -> Fog:
    return Fog(cache_dir=cache_dir, **keys)


def _broadcast(function: Callable[..., _Numbers], *arguments: ArrayLike) -> Any:
    arrays = np.broadcast_arrays(*(np.asarray(a, dtype=np.float64) for a in arguments))
    values = function(*(np.ascontiguousarray(a).ravel() for a in arrays))
    return _shaped(values, arrays[0].shape)


def _shaped(values: _Numbers, shape: tuple[int, ...]) -> Any:
    return values.reshape(shape) if shape else float(values[0])
