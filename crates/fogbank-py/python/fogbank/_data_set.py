"""Data sets as ``fogbank sweep`` makes them."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsIndex, overload

from . import _fogbank
from ._frame import Frame

if TYPE_CHECKING:
    from ._torch import FrameDataset


class DataSet(Sequence[Frame]):
    """The finished frames of a data set, in the order of its plan, as :func:`fogbank.open` makes it.

    A sequence of :class:`Frame`: ``data[0]``, ``data[-1]``, ``data["000_fog-100"]`` by id, ``data[2:5]`` and :meth:`where` as data
    sets of some of the frames. Files are read when a frame's pictures are asked for. Which frames are finished is looked up once:
    open it again to see what a running sweep has added. It can be pickled: the copy opens the folder again.
    """

    def __init__(self, dir: str | os.PathLike[str]) -> None:
        self._dir = Path(dir)
        self._native = _fogbank.DataSet(self._dir)
        self._ids = self._native.ids()
        self._places = {id: place for place, id in enumerate(self._ids)}
        self._chosen = list(range(len(self._ids)))

    @property
    def dir(self) -> Path:
        """Its folder."""
        return self._dir

    @property
    def name(self) -> str:
        """Name of its configuration."""
        return str(self.header["name"])

    @property
    def header(self) -> dict[str, Any]:
        """``dataset.json``: format, digests, axes, generator."""
        header: dict[str, Any] = json.loads(self._native.header_json())
        return header

    @property
    def classes(self) -> Any:
        """``classes.json``: numbers, names and colours of the classes; none if no frame has classes."""
        text = self._native.classes_json()
        return None if text is None else json.loads(text)

    @property
    def config(self) -> str:
        """The configuration with every default written out: YAML that :func:`fogbank.render` takes."""
        return (self._dir / "config.resolved.yaml").read_text(encoding="utf-8")

    @property
    def counts(self) -> dict[str, int]:
        """Numbers of the plan's frames that are ``done``, ``failed`` and ``missing``; of all of them, whatever was chosen."""
        return dict(zip(("done", "failed", "missing"), self._native.counts()))

    @property
    def ids(self) -> list[str]:
        """Ids of the frames."""
        return [self._ids[place] for place in self._chosen]

    def where(self, condition: str) -> DataSet:
        """The frames that meet conditions, as ``"fog.height_m >= 180, lighting = night"``: as ``--where`` of the command line.

        Conditions have the form PATH OP VALUE with OP one of ``=``, ``!=``, ``<``, ``<=``, ``>``, ``>=``; PATH is an axis or a key
        of a frame's ``spec``. A frame without the key does not meet a condition, unless it is ``!=``.

        :raises ConfigError: if it is no condition, or no frame of the data set has such a value.
        """
        matches = self._native.matches(condition)
        return self._some([place for place in self._chosen if matches[place]])

    def table(self, library: str | None = None) -> Any:
        """A row per frame: ``id``, ``pair_id``, the axes by their dotted paths, then every value of the record by its dotted path.

        Values in lists have numbers in their paths (``camera.position_m.1``); lists of maps, such as the lights of a runway, are
        left out. What a frame lacks is null. Columns that are alike in all frames are there too.

        :param library: ``"pandas"`` or ``"polars"``; by default the one of them that is installed, pandas before polars.
        :returns: a ``DataFrame`` of that library.
        :raises ImportError: if it is not installed.
        """
        from ._table import table

        return table(self, library)

    def torch(
        self,
        outputs: Sequence[str] = ("hdr",),
        transform: Callable[[dict[str, Any]], Any] | None = None,
        *,
        channels_first: bool = True,
    ) -> FrameDataset:
        """A map-style PyTorch ``Dataset``: item i is a dict of tensors by the names of ``outputs``, and ``id``.

        Tensors share the memory of the arrays, but for ``uint16``, which becomes ``int32``: PyTorch has little use for it. It can be
        pickled for the workers of a ``DataLoader`` if ``transform`` can.

        :param outputs: names of pictures that all frames must have.
        :param transform: what is done with each item.
        :param channels_first: whether pictures of several components have the shape (components, height, width).
        :raises ImportError: if PyTorch is not installed.
        :raises KeyError: if a frame lacks one of the outputs.
        """
        from ._torch import FrameDataset

        return FrameDataset(self, outputs, transform, channels_first)

    def __len__(self) -> int:
        return len(self._chosen)

    @overload
    def __getitem__(self, index: SupportsIndex | str) -> Frame: ...
    @overload
    def __getitem__(self, index: slice) -> DataSet: ...
    def __getitem__(self, index: SupportsIndex | str | slice) -> Frame | DataSet:
        if isinstance(index, slice):
            return self._some(self._chosen[index])
        if isinstance(index, str):
            place = self._places.get(index, -1)
            if place not in self._chosen:
                raise KeyError(f"{index!r} is none of the {len(self)} frames of {self._dir}")
        else:
            try:
                place = self._chosen[index]
            except IndexError:
                raise IndexError(f"there is no frame {index}; there are {len(self)}") from None
        return Frame(self._native.frame(place), (str(self._dir), self._ids[place]))

    def __contains__(self, frame: object) -> bool:
        return (frame.id if isinstance(frame, Frame) else frame) in self.ids

    def __iter__(self) -> Iterator[Frame]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<fogbank.DataSet {self._dir}: {len(self)} frames>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _chosen, (str(self._dir.absolute()), self.ids)

    def _some(self, places: list[int]) -> DataSet:
        some = object.__new__(DataSet)
        some.__dict__.update(self.__dict__)
        some._chosen = places
        return some


def open(dir: str | os.PathLike[str]) -> DataSet:
    """Opens the data set in a folder.

    :raises DataSetError: if it holds none, or a damaged one.
    """
    return DataSet(dir)


def _chosen(dir: str, ids: list[str]) -> DataSet:
    whole = DataSet(dir)
    return whole._some([whole._places[id] for id in ids])
