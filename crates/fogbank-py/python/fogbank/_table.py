"""Records as tables."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ._errors import ConfigError

if TYPE_CHECKING:
    from ._data_set import DataSet

_LIBRARIES = ("pandas", "polars")


def table(data: DataSet, library: str | None) -> Any:
    """See :meth:`DataSet.table`."""
    if library is not None and library not in _LIBRARIES:
        raise ConfigError(f"library is {library!r}; valid: {', '.join(_LIBRARIES)}")
    module = _first_installed(_LIBRARIES if library is None else (library,))
    rows = []
    for frame in data:
        row: dict[str, Any] = {"id": frame.id, "pair_id": frame.pair_id}
        for path, value in frame.axes.items():
            _flatten(value, path, row)
        _flatten(frame.record, "", row)
        rows.append(row)
    # In the order in which the frames name them.
    names = list(dict.fromkeys(name for row in rows for name in row))
    columns = {name: [row.get(name) for row in rows] for name in names}
    if module.__name__ == "polars":
        return module.DataFrame([module.Series(name, values, strict=False) for name, values in columns.items()])
    return module.DataFrame(columns)


def _first_installed(names: tuple[str, ...]) -> Any:
    for name in names:
        try:
            return importlib.import_module(name)
        except ModuleNotFoundError as error:
            if error.name != name:
                raise
    raise ImportError(f"a table needs {' or '.join(names)}: pip install {names[0]}")


def _flatten(value: Any, path: str, row: dict[str, Any]) -> None:
    """Puts what is no map and no list into ``row``, by dotted path; what is there already stays."""
    if isinstance(value, dict):
        items = list(value.items())
    elif isinstance(value, list) and not any(isinstance(item, dict) for item in value):
        items = list(enumerate(value))
    elif isinstance(value, list):
        return
    else:
        row.setdefault(path, value)
        return
    for key, item in items:
        _flatten(item, f"{path}.{key}" if path else str(key), row)
