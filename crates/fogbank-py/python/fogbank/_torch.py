"""Data sets for PyTorch; imported only when asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import torch
from torch.utils.data import Dataset

from ._data_set import DataSet


class FrameDataset(Dataset[Any]):
    """See :meth:`DataSet.torch`."""

    def __init__(
        self,
        data: DataSet,
        outputs: Sequence[str],
        transform: Callable[[dict[str, Any]], Any] | None,
        channels_first: bool,
    ) -> None:
        self.data = data
        self.outputs = (outputs,) if isinstance(outputs, str) else tuple(outputs)
        self.transform = transform
        self.channels_first = channels_first

    def __len__(self) -> int:
        return len(self.data)

    def __getitem__(self, index: int) -> Any:
        frame = self.data[index]
        item: dict[str, Any] = {name: self._tensor(frame[name]) for name in self.outputs}
        item["id"] = frame.id
        return item if self.transform is None else self.transform(item)

    def _tensor(self, array: np.ndarray[Any, Any]) -> torch.Tensor:
        tensor = torch.from_numpy(array.astype(np.int32) if array.dtype == np.uint16 else array)
        return tensor.permute(2, 0, 1) if self.channels_first and tensor.ndim == 3 else tensor
