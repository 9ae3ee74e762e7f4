"""Configurations: files, YAML and mappings."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, SupportsIndex, overload

from . import _fogbank
from ._errors import ConfigError


class Plan(Sequence[dict[str, Any]]):
    """The frames of a configuration, as :func:`plan` makes it.

    A sequence of frames: each is a dict with every value resolved (``id``, ``seed``, ``digest``, ``fog``, ``camera``, …), as
    ``fogbank plan --json`` prints it. Frames are made when they are asked for, so that a plan of a million is light. Scenes and
    tables that :func:`fogbank.render` has loaded for it stay with it.
    """

    def __init__(self, native: _fogbank.Plan) -> None:
        self._native = native

    @property
    def name(self) -> str:
        """Name of the configuration."""
        return self._native.name()

    @property
    def axes(self) -> list[str]:
        """Dotted paths of the axes of the sweep."""
        return self._native.axes()

    @property
    def ids(self) -> list[str]:
        """Ids of all frames, which name their files."""
        return [frame["id"] for frame in self]

    @property
    def yaml(self) -> str:
        """The configuration with every default written out."""
        return self._native.resolved_yaml()

    def where(self, condition: str) -> list[dict[str, Any]]:
        """The frames that meet a condition, as ``"fog.height_m >= 180, lighting = night"``.

        :raises ConfigError: if it is no condition, or no frame has such a value.
        """
        return [self[i] for i, matches in enumerate(self._native.matches(condition)) if matches]

    def __len__(self) -> int:
        return len(self._native)

    @overload
    def __getitem__(self, index: SupportsIndex) -> dict[str, Any]: ...
    @overload
    def __getitem__(self, index: slice) -> list[dict[str, Any]]: ...
    def __getitem__(self, index: SupportsIndex | slice) -> dict[str, Any] | list[dict[str, Any]]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        i = index.__index__()
        i += len(self) if i < 0 else 0
        if not 0 <= i < len(self):
            raise IndexError(f"there is no frame {index}; the plan has {len(self)}")
        frame: dict[str, Any] = json.loads(self._native.frame_json(i))
        return frame

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<fogbank.Plan {self.name}: {len(self)} frames>"


def plan(
    config: str | os.PathLike[str] | Mapping[str, Any] | Plan,
    *,
    overrides: Mapping[str, Any] | None = None,
    cache_dir: str | os.PathLike[str] | None = None,
    oidn: str | os.PathLike[str] | None = None,
) -> Plan:
    """Reads and checks a configuration; nothing is rendered.

    :param config: a file's name; or YAML text, which is a string with a line break or one that begins with ``{``; or a mapping
        with the keys of such a file, whose values may be NumPy's numbers and paths. A :class:`Plan` is returned as it is.
    :param overrides: values by dotted path, as ``{"fog.height_m": 260}``.
    :param cache_dir: folder of optics tables; by default that of the command line (``tables/cache`` in a checkout of Fogbank, else
        ``fogbank`` in the user's cache folder).
    :param oidn: library of Open Image Denoise, for the output ``denoised``; by default the one that ``FOGBANK_OIDN`` names.
    :raises ConfigError: with all mistakes that could be found: file, line, key, and what would be right.
    """
    if isinstance(config, Plan):
        if overrides or cache_dir or oidn:
            raise ConfigError("overrides, cache_dir and oidn belong to the making of a plan: give them to fogbank.plan")
        return config
    sets = [f"{path}={to_json(value)}" for path, value in (overrides or {}).items()]
    denoiser = oidn or os.environ.get("FOGBANK_OIDN") or None
    name: str | os.PathLike[str]
    text: str | None = None
    if isinstance(config, Mapping):
        name, text = "", to_json(config)
    elif isinstance(config, str) and ("\n" in config or config.lstrip().startswith("{")):
        name, text = "config", config
    else:
        name = config
    return Plan(_fogbank.Plan(name, text, sets, cache_dir, denoiser))


def to_json(value: Any) -> str:
    """JSON, which is YAML too; NumPy's numbers and arrays, tuples and paths are taken as they are meant."""
    return json.dumps(value, default=_plain)


def _plain(value: Any) -> Any:
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    raise ConfigError(f"{value!r} ({type(value).__name__}) cannot stand in a configuration")
