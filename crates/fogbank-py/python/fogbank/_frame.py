"""Frames: pictures by name, and what is known about them."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator, Mapping
from typing import Any, Generic, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from . import _fogbank

_Array = TypeVar("_Array", bound=np.generic)


class _Picture(Generic[_Array]):
    """An attribute that is the picture of its name."""

    def __init__(self, doc: str) -> None:
        self.__doc__ = doc

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, frame: None, owner: type) -> _Picture[_Array]: ...
    @overload
    def __get__(self, frame: Frame, owner: type) -> NDArray[_Array]: ...
    def __get__(self, frame: Frame | None, owner: type) -> _Picture[_Array] | NDArray[_Array]:
        if frame is None:
            return self
        if self._name not in frame:
            raise AttributeError(f"frame {frame.id} has no output {self._name!r}; it has {', '.join(frame)}")
        return frame[self._name]


class Frame(Mapping[str, NDArray[Any]]):
    """A frame: a mapping from the names of its outputs to arrays, which are also attributes.

    Arrays have the shape (height, width), or (height, width, components) where a pixel has several; row 0 is at the top. A picture
    is read when it is asked for, without a copy after it is decoded (colours are woven together while they are), and kept:
    ``frame.depth is frame["depth"]``. Pictures of groups of lights are under ``group.NAME``. Of frames of one wavelength
    (``render.wavelength_nm``) radiance and transmittance have the shape (height, width).

    Threads may share a frame. A frame of a data set can be pickled; a rendered one takes its pictures along.
    """

    image = _Picture[np.uint8]("sRGB picture, 8 bits; developed from ``raw`` where there is a sensor (output ``image``).")
    hdr = _Picture[np.float32]("Linear radiance relative to D65, Rec. 709 primaries.")
    direct = _Picture[np.float32]("Part of ``hdr`` that came straight from surfaces and sky.")
    airlight = _Picture[np.float32]("Part of ``hdr`` that was scattered in the fog; ``direct + airlight = hdr``.")
    standard_error = _Picture[np.float32]("Standard error of the luminance of ``hdr``.")
    samples = _Picture[np.float32]("Number of samples of each pixel.")
    depth = _Picture[np.float32]("Planar depth along the camera's axis in m; +inf for sky, NaN where the lens shows nothing.")
    distance = _Picture[np.float32]("Range to the first surface in m; +inf for sky.")
    transmittance = _Picture[np.float32]("Transmittance to the first surface, or out of the fog, at 611, 550 and 464 nm.")
    tau = _Picture[np.float32]("Optical depth of that path at 550 nm.")
    normals = _Picture[np.float32]("Unit normals in the world; zero for sky.")
    position = _Picture[np.float32]("Positions in the world in m; NaN for sky.")
    albedo = _Picture[np.float32]("Linear base colour of the first surface.")
    flow = _Picture[np.float32]("Motion in the image to the next frame of a path, in pixels to the right and down.")
    flow_valid = _Picture[np.float32]("1 where the next frame shows the same point, else 0 (output ``flow``).")
    semantic = _Picture[np.uint8]("Class of the first surface (Cityscapes' ids; ``DataSet.classes`` names them).")
    instance = _Picture[np.uint16]("Instance of the first surface; 0: none.")
    raw = _Picture[np.uint16]("Numbers of the sensor's pixels, a Bayer mosaic.")
    clear = _Picture[np.float32]("``hdr`` of the same view in clear air (output ``pair``).")
    clear_image = _Picture[np.uint8]("``image`` of the same view in clear air at the same exposure (output ``pair``).")
    denoised = _Picture[np.float32]("A guess at ``hdr`` without its noise.")
    denoised_image = _Picture[np.uint8]("Its sRGB picture (output ``denoised``).")

    def __init__(
        self, native: _fogbank.StoredFrame | _fogbank.RenderedFrame, origin: tuple[str, str] | None = None
    ) -> None:
        self._native = native
        self._origin = origin
        self._names = native.names()
        self._arrays: dict[str, NDArray[Any]] = {}
        self._json: dict[str, Any] = {}
        self._lock = threading.Lock()

    @property
    def id(self) -> str:
        """Its id, which names its files."""
        return str(self.spec["id"])

    @property
    def spec(self) -> dict[str, Any]:
        """What the frame was made from: its place in the plan with every value resolved."""
        return self._cached("spec", self._native.spec_json)  # type: ignore[no-any-return]

    @property
    def axes(self) -> dict[str, Any]:
        """Values of the sweep's axes by dotted path."""
        return dict(self.spec["axes"])

    @property
    def pair_id(self) -> str:
        """What frames that differ in fog alone have in common."""
        return str(self.spec["pair_id"])

    @property
    def record(self) -> dict[str, Any]:
        """Everything that is known about the frame (``<id>.json``): parameters with units, pose, intrinsics, the fog's state at the
        camera, visibility, seed, noise, digests."""
        return self._cached("record", self._native.record_json)  # type: ignore[no-any-return]

    @property
    def objects(self) -> list[dict[str, Any]] | None:
        """Records of the things in the picture (output ``objects``); none if the frame has no such output."""
        found = self._cached("objects", self._native.objects_json)
        return None if found is None else list(found["objects"])

    def __getitem__(self, name: str) -> NDArray[Any]:
        with self._lock:
            array = self._arrays.get(name)
            if array is None:
                if name not in self._names:
                    raise KeyError(f"{name!r}; frame {self.id} has {', '.join(self._names)}")
                array = self._arrays[name] = self._native.read(name)
            return array

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"<fogbank.Frame {self.id}: {', '.join(self)}>"

    def _cached(self, what: str, read: Any) -> Any:
        if what not in self._json:
            text = read()
            self._json[what] = None if text is None else json.loads(text)
        return self._json[what]

    def __reduce__(self) -> tuple[Any, ...]:
        if self._origin is not None:
            return _reopened, self._origin
        arrays = {name: self[name] for name in self}
        return _unpickled, (self.spec, self.record, self._cached("objects", self._native.objects_json), arrays)


class _Kept:
    """A frame that came out of a pickle."""

    def __init__(self, spec: Any, record: Any, objects: Any, arrays: dict[str, NDArray[Any]]) -> None:
        self.spec_json = lambda: json.dumps(spec)
        self.record_json = lambda: json.dumps(record)
        self.objects_json = lambda: None if objects is None else json.dumps(objects)
        self.names = lambda: list(arrays)
        self.read = arrays.__getitem__


def _unpickled(spec: Any, record: Any, objects: Any, arrays: dict[str, NDArray[Any]]) -> Frame:
    return Frame(_Kept(spec, record, objects, arrays))  # type: ignore[arg-type]


def _reopened(dir: str, id: str) -> Frame:
    from ._data_set import DataSet

    return DataSet(dir)[id]
