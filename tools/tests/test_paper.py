"""The page of the paper's rendered figures, made at a tiny size."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]


def test_page_with_pictures_and_numbers(tmp_path):
    page = tmp_path / "paper.md"
    shutil.copy(ROOT / "docs/paper.md", page)
    before = page.read_text(encoding="utf-8")
    sets = ["sensor.width_px=20", "sensor.height_px=15", "render.samples=2"]
    changes = [part for change in sets for part in ("--set", change)]
    command = [sys.executable, ROOT / "tools/paper.py", "--out", tmp_path / "out", "--page", page, *changes]
    subprocess.run(command, check=True, cwd=ROOT, env=os.environ)

    after = page.read_text(encoding="utf-8")
    head = before.index("| figure |")
    assert after[:head] == before[:head], "only the numbers change"
    # 4, 2 and 3 comparisons, with two coefficients, by day and by night.
    rows = [line for line in after.splitlines() if line.startswith("| ") and "| day |" in line or "| night |" in line]
    assert len(rows) == 9 * 2 * 2
    assert rows != [line for line in before.splitlines() if line in rows]
    pictures = sorted((tmp_path / "images/paper").iterdir())
    assert len(pictures) == 6
    columns = {"fig08": 4, "fig10": 3, "fig12": 4}
    for picture in pictures:
        assert Image.open(picture).size == (20 * columns[picture.name[:5]], 2 * (15 + 22))
        assert f"images/paper/{picture.name}" in before, "the page shows it"
