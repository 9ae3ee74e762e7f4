"""Fog optics: values of the command line's tables and of the references, broadcasting, errors."""

from __future__ import annotations

import csv
import math
import pickle
from pathlib import Path

import fogbank
import numpy as np
import pytest

REFERENCE = Path(__file__).parents[3] / "tests" / "data" / "fog_profile.csv"


@pytest.fixture(scope="module")
def fog() -> fogbank.Fog:
    return fogbank.Fog(height_m=180)


def test_against_the_reference_profile():
    """σ_t and g of the layer by altitude, from an independent computation (`tests/data/fog_profile.csv`)."""
    with REFERENCE.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    seen = 0
    for height in {row["fog_height_m"] for row in rows}:
        some = [row for row in rows if row["fog_height_m"] == height and 380 <= float(row["wavelength_nm"]) <= 780]
        z, nm, sigma = (np.array([float(row[key]) for row in some]) for key in ("altitude_m", "wavelength_nm", "sigma_t_1_m"))
        inside = (z > 0) & (z < float(height))
        got = fogbank.Fog(height_m=float(height)).sigma_t(z, nm)
        np.testing.assert_allclose(got[inside], sigma[inside], rtol=2e-3)
        seen += int(inside.sum())
    assert seen > 20


def test_broadcasting(fog):
    assert isinstance(fog.sigma_t(2), float) and isinstance(fog.visibility(np.float32(2)), float)
    z, nm = np.linspace(1, 179, 7)[:, None], [450, 550, 650]
    sigma = fog.sigma_t(z, nm)
    assert sigma.shape == (7, 3) and sigma[3, 1] == fog.sigma_t(z[3, 0], 550)
    assert fog.phase(z, 550, np.linspace(-1, 1, 5)).shape == (7, 5)
    assert fog.phase(z[:, :, None], np.array(nm)[:, None], [1.0, 0.5]).shape == (7, 3, 2)
    assert fog.sigma_t([], 550).shape == (0,) and fog.sigma_t(z.T[:, ::-2]).shape == (1, 4)
    assert fog.visibility([2, 90], "allard", intensity_cd=[[100], [1000]], threshold_lx="day").shape == (2, 2)
    state = fog.state([[2.0, 300.0]])
    assert state["g"].shape == (1, 2) and np.isnan(state["g"][0, 1]) and state["mor_m"][0, 1] == math.inf
    with pytest.raises(ValueError, match="broadcast"):
        fog.sigma_t([1, 2, 3], [1, 2])


def test_the_phase_function_is_normalised(fog):
    m = np.concatenate([[0], np.geomspace(1e-7, 2, 20001)])
    for nm in (450, 905):
        p = fog.phase(90, nm, np.clip(1 - m, -1, 1))
        integral = 2 * np.pi * np.sum((p[1:] + p[:-1]) / 2 * np.diff(m))
        assert integral == pytest.approx(1, abs=2e-3)
        g = 2 * np.pi * np.sum(((p * (1 - m))[1:] + (p * (1 - m))[:-1]) / 2 * np.diff(m))
        assert 0.8 < g < 0.9
    hg = fogbank.Fog(model="homogeneous", height_m=50, sigma_t_1_m=0.02, phase={"hg": 0.5})
    mu = np.array([-1, 0.25, 1])
    np.testing.assert_allclose(hg.phase(10, 550, mu), 0.75 / (4 * np.pi * (1.25 - mu) ** 1.5), rtol=1e-6)


def test_visibility_by_its_laws(fog):
    z = np.array([2.0, 90.0, 150.0])
    sigma = fog.sigma_t(z)
    np.testing.assert_allclose(fog.visibility(z), -np.log(0.05) / sigma, rtol=1e-9)
    np.testing.assert_allclose(fog.visibility(z, "koschmieder"), 3.912 / sigma, rtol=1e-9)
    r = fog.visibility(z, "allard", intensity_cd=10_000, threshold_lx=1e-4)
    np.testing.assert_allclose(10_000 * np.exp(-sigma * r) / r**2, 1e-4, rtol=1e-9)
    # Level slants are horizontal; steep ones end where the depth is met.
    np.testing.assert_allclose(fog.visibility(z, elevation_deg=0), fog.visibility(z), rtol=1e-6)
    assert fog.visibility(179.9, elevation_deg=90) == math.inf
    target = fogbank.Fog(height_m=180, visibility={"mor_m": 300, "altitude_m": 2})
    assert target.visibility(2) == pytest.approx(300, rel=1e-4)


def test_wavelengths_beyond_the_rendered(fog):
    near = fog.sigma_t(90, [799.999, 800.001])
    assert near[0] == pytest.approx(near[1], rel=1e-4)
    assert fog.sigma_t(90, 1550) == fog.sigma_t([90, 90], [905, 1550])[1]
    grey = fogbank.Fog(model="homogeneous", height_m=50, sigma_t_1_m=0.02)
    assert grey.sigma_t(10, 1550) == pytest.approx(0.02)


def test_clear_air_and_outside():
    clear = fogbank.Fog(model="none")
    assert clear.extent_m is None and clear.sigma_t(2) == 0 and clear.visibility(2) == math.inf
    assert math.isnan(clear.phase(2, 550, 1)) and math.isnan(clear.state(2)["g"])
    fog = fogbank.Fog(model="homogeneous", height_m=50, sigma_t_1_m=0.02, datum_m=10)
    assert fog.extent_m == (0, 50) and fog.sigma_t([-1, 0, 50, 51]).tolist() == [0, 0.02, 0.02, 0]


def test_keys_are_those_of_the_configuration():
    fog = fogbank.Fog(model="droplets", height_m=np.int64(60), droplets="shettle_fenn_radiation_heavy")
    assert fog.spec["model"] == "droplets" and fog.spec["height_m"] == 60
    assert pickle.loads(pickle.dumps(fog)).sigma_t(5) == fog.sigma_t(5)
    assert repr(fogbank.Fog(height_m=180)) == "fogbank.Fog(height_m=180, model='advection')"


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"heigth_m": 180}, "fog.heigth_m: unknown key.*did you mean `height_m`"),
        ({"height_m": -3}, r"^fog.height_m: -3 m is out of range; valid: 1 to 5000 m$"),
        ({"height_m": "tall"}, "fog.height_m"),
        ({"model": "smoke"}, "fog.model"),
        ({"model": "none", "height_m": 3}, "model none has no height_m"),
        ({"height_m": 180, "coefficients": "nowhere.yaml"}, "nowhere.yaml"),
        ({"height_m": float("nan")}, "fog.height_m"),
        ({"height_m": {1, 2}}, "set"),
    ],
)
def test_wrong_keys_are_named(keys, message):
    with pytest.raises(fogbank.ConfigError, match=message) as caught:
        fogbank.Fog(**keys)
    assert isinstance(caught.value, ValueError)


def test_wrong_arguments_are_named(fog):
    for call, message in (
        (lambda: fog.sigma_t(2, 3000), "wavelength_nm is 3000; valid: 200 to 2600"),
        (lambda: fog.sigma_t(math.nan), "altitude_m is NaN"),
        (lambda: fog.phase(2, 550, 1.5), "cos_theta is 1.5; valid: -1 to 1"),
        (lambda: fog.visibility(2, "allard", intensity_cd=-1), "light intensity"),
        (lambda: fog.visibility(2, "allard", threshold_lx="noon"), "bright_day"),
        (lambda: fog.visibility(2, "law"), "valid: mor, koschmieder, allard"),
        (lambda: fog.visibility(2, elevation_deg=91), "91"),
    ):
        with pytest.raises(fogbank.ConfigError, match=message):
            call()
