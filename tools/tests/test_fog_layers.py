"""tests/data/fog_layers_*.csv come out again of tools/tables/fog_layers_disort.py, with fewer streams."""

import csv
import importlib.util
import json
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def disort():
    pytest.importorskip("scatrs.mie")  # needs Python 3.11
    spec = importlib.util.spec_from_file_location("fog_layers_disort", ROOT / "tools/tables/fog_layers_disort.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def stored(name, nm, zenith_deg):
    lines = (ROOT / f"tests/data/fog_layers_{name}.csv").read_text().splitlines()
    header = json.loads(lines[0].removeprefix("# "))
    rows = [r for r in csv.DictReader(lines[1:]) if (int(r["wavelength_nm"]), int(r["sun_zenith_deg"])) == (nm, zenith_deg)]
    return header, rows


def test_layers_are_reproduced(disort):
    slabs = disort.Fog(550).slabs(16)
    for name, solve, streams, allow in (("thin", disort.solve, 40, 0.04), ("thick", disort.solve_fluxes, 40, 1e-3)):
        header, rows = stored(name, 550, 60)
        values, depth = solve(slabs, header["density_scale"], 60, header["ground_albedo"], streams)
        assert depth == pytest.approx(float(rows[0]["tau"]), rel=1e-4)
        assert values == pytest.approx([float(r["value"]) for r in rows], rel=allow)
        # Few rows carry the error of so few streams.
        exact = sum(abs(v / float(r["value"]) - 1) < allow / 4 for v, r in zip(values, rows, strict=True))
        assert exact > 0.6 * len(rows)


def test_thin_layers_scatter_mostly_once(disort):
    """No direction has less than the closed form of single scattering, and only dark ones much more."""
    slabs = disort.Fog(550).slabs(16)
    header, rows = stored("thin", 550, 60)
    once = disort.scattered_once(slabs, header["density_scale"], 60)
    assert len(once) == len(rows) - 2
    for row, first in zip(rows[2:], once, strict=True):
        assert 0.995 * first < float(row["value"]) < 3 * first, row


def test_no_light_is_lost(disort):
    header, rows = stored("thin", 650, 0)
    top, bottom = (float(r["value"]) for r in rows[:2])
    beam = 2.718281828459045 ** -float(rows[0]["tau"])
    # Of light from the zenith what is not reflected or sent through is absorbed: less than a millionth.
    assert top + bottom + beam == pytest.approx(1, abs=1e-5)
