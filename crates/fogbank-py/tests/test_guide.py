"""The snippets of the guide and the cells of the notebook run."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

HERE = Path(__file__).parents[1]


def test_the_guide(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = (HERE / "../../docs/python.md").read_text(encoding="utf-8")
    names: dict[str, object] = {}
    snippets = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(snippets) >= 6
    for snippet in snippets:
        exec(compile(snippet, "python.md", "exec"), names)
    assert names["sigma"].shape == (91, 5) and len(names["data"]) == 3 and len(names["table"]) == 3


def test_the_notebook(tmp_path, monkeypatch):
    """Its cells run, and it was stored with what they gave."""
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    cells = json.loads((HERE / "notebooks/tour.ipynb").read_text(encoding="utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    names: dict[str, object] = {}
    for cell in code:
        exec(compile("".join(cell["source"]), "tour.ipynb", "exec"), names)
    outputs = [output for cell in code for output in cell["outputs"]]
    assert sum("image/png" in output.get("data", {}) for output in outputs) >= 3
    assert not any(output["output_type"] == "error" for output in outputs)
