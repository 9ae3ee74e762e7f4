"""Rendering, one frame or all."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from . import _fogbank
from ._config import Plan, plan
from ._data_set import DataSet
from ._frame import Frame

Progress = Callable[[float, str], object]


def render(
    config: str | os.PathLike[str] | Mapping[str, Any] | Plan,
    frame: str | int | None = None,
    *,
    overrides: Mapping[str, Any] | None = None,
    threads: int | None = None,
    progress: bool | Progress = False,
    cache_dir: str | os.PathLike[str] | None = None,
    oidn: str | os.PathLike[str] | None = None,
) -> Frame:
    """Renders a frame; nothing is stored.

    Python's lock is released meanwhile, and Ctrl-C stops it. The pictures are those that a sweep would store, bit by bit, but for
    frames that share their paths with others (``render.share``): alone they get the same light with other noise. To render several
    frames of a scene, make a :func:`fogbank.plan` first and pass it: scene and tables are then loaded once.

    :param config: as of :func:`fogbank.plan`.
    :param frame: id, beginning of an id, or index from 0; needed if there are several.
    :param overrides: as of :func:`fogbank.plan`.
    :param threads: number of threads; by default one for each processor. It does not change a bit of the frame.
    :param progress: true for a line on standard error, or a function of the share that is done (0 to 1) and a text, mostly empty.
    :param cache_dir: as of :func:`fogbank.plan`.
    :param oidn: as of :func:`fogbank.plan`.
    :raises ConfigError: if the configuration is wrong, or has no such frame.
    :raises RenderError: if the frame fails.
    """
    frames = plan(config, overrides=overrides, cache_dir=cache_dir, oidn=oidn)
    wanted = None if frame is None else str(frames[frame]["id"] if isinstance(frame, int) else frame)
    with _Line(progress) as line:
        return Frame(_fogbank.render(frames._native, wanted, threads or 0, line.progress))


def sweep(
    config: str | os.PathLike[str] | Mapping[str, Any] | Plan,
    out: str | os.PathLike[str],
    *,
    only: Sequence[str] = (),
    where: str | None = None,
    mode: str = "resume",
    retry_failed: bool = False,
    overrides: Mapping[str, Any] | None = None,
    threads: int | None = None,
    progress: bool | Progress = False,
    cache_dir: str | os.PathLike[str] | None = None,
    oidn: str | os.PathLike[str] | None = None,
) -> DataSet:
    """Renders the frames of a configuration that a data set lacks, and opens it.

    What is done stays done: call it again after Ctrl-C. A frame that fails is warned of, recorded, and the others go on:
    see ``counts``. For worker processes and shards there is the command line, whose data sets are the same.

    :param config: as of :func:`fogbank.plan`.
    :param out: folder of the data set.
    :param only: ids of frames, or beginnings of ids.
    :param where: condition that frames must meet, as of :meth:`DataSet.where`.
    :param mode: ``resume`` goes on with the same data set, ``overwrite`` begins anew, ``extend`` adds the frames of a longer plan.
    :param retry_failed: whether frames that have failed before are tried again.
    :param overrides: as of :func:`fogbank.plan`.
    :param threads: as of :func:`render`.
    :param progress: as of :func:`render`.
    :param cache_dir: as of :func:`fogbank.plan`.
    :param oidn: as of :func:`fogbank.plan`.
    :raises ConfigError: if the configuration is wrong, or nothing is selected.
    :raises DataSetError: if the folder holds something else, or cannot be written.
    """
    frames = plan(config, overrides=overrides, cache_dir=cache_dir, oidn=oidn)
    with _Line(progress) as line:
        selected = [only] if isinstance(only, str) else list(only)
        _fogbank.sweep(frames._native, out, selected, where, mode, retry_failed, threads or 0, line.progress)
    return DataSet(out)


class _Line:
    """A line on standard error that says how far the work is, and when it will be done."""

    def __init__(self, progress: bool | Progress) -> None:
        self._started = time.monotonic()
        self._width = 0
        self.progress: Progress | None = self._show if progress is True else progress or None

    def _show(self, share: float, text: str) -> None:
        elapsed = time.monotonic() - self._started
        left = f", {elapsed / share - elapsed:.0f} s left" if share > 0.05 and elapsed > 1.0 else ""
        line = f"{100 * share:3.0f} %{left}" + (f"; {text}" if text else "")
        sys.stderr.write("\r" + line.ljust(self._width))
        sys.stderr.flush()
        self._width = len(line)

    def __enter__(self) -> _Line:
        return self

    def __exit__(self, *_: object) -> None:
        if self._width:
            sys.stderr.write("\n")
