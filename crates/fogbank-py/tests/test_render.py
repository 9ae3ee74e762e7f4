"""Rendering without a folder: the same pictures, the lock released, Ctrl-C, errors."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import fogbank
import numpy as np
import pytest
from conftest import CONFIG

FOGBANK = os.environ.get("FOGBANK")


def test_the_pictures_of_a_sweep_bit_by_bit(data):
    plan = fogbank.plan(CONFIG)
    assert len(plan) == 6 and plan.ids == data.ids and plan.axes == ["fog.height_m", "camera.altitude_m"]
    for wanted, threads in ((3, 1), (data.ids[3], 2), (-3, None)):
        frame = fogbank.render(plan, wanted, threads=threads)
        stored = data[frame.id]
        assert frame.id == data.ids[3] and set(frame) == set(stored) and frame.record == stored.record
        for name in frame:
            assert np.array_equal(frame[name], stored[name], equal_nan=True), name
    assert not frame.hdr.flags.owndata
    copy = pickle.loads(pickle.dumps(frame))
    assert copy.id == frame.id and np.array_equal(copy.hdr, frame.hdr)


@pytest.mark.skipif(FOGBANK is None, reason="FOGBANK names no program")
def test_the_program_makes_the_same_data_set(data, tmp_path):
    config = tmp_path / "config.yaml"
    config.write_text(data.config)
    command = [str(FOGBANK), "render", str(config), "--frame", "0", "--out", str(tmp_path / "out"), "--quiet"]
    subprocess.run(command, check=True)
    theirs = fogbank.open(tmp_path / "out")
    assert theirs.header["code_digest"] == data.header["code_digest"] == fogbank.CODE_DIGEST
    assert np.array_equal(theirs[0].hdr, data[0].hdr) and theirs[0].record == data[0].record


def test_configurations_in_every_form(tmp_path):
    yaml = "version: 1\nname: one\nscene: none\nfog: none\nlighting: day\n"
    file = tmp_path / "one.yaml"
    file.write_text(yaml)
    plans = [fogbank.plan(c) for c in (file, str(file), yaml, {"version": 1, "name": "one", "scene": "none", "fog": "none", "lighting": "day"})]
    assert len({plan[0]["digest"] for plan in plans}) == 1
    assert fogbank.plan(file, overrides={"camera.altitude_m": np.float64(7)})[0]["camera"]["altitude_m"] == 7
    assert [frame["fog"]["height_m"] for frame in fogbank.plan(CONFIG).where("fog.height_m > 180")] == [260, 260]


def test_mistakes(tmp_path):
    file = tmp_path / "bad.yaml"
    file.write_text("version: 1\nname: bad\nscene: none\nfog: {model: advection, heigth_m: 180}\n")
    with pytest.raises(fogbank.ConfigError, match=r"bad.yaml:4:\d+: fog.heigth_m: unknown key"):
        fogbank.plan(file)
    with pytest.raises(ValueError, match="nowhere.yaml: cannot read"):
        fogbank.plan("nowhere.yaml")
    with pytest.raises(fogbank.ConfigError, match="small is a sweep of 6 frames: name one"):
        fogbank.render(CONFIG)
    with pytest.raises(fogbank.ConfigError, match="no frame `elsewhere`"):
        fogbank.render(CONFIG, "elsewhere")
    with pytest.raises(IndexError):
        fogbank.render(CONFIG, 6)
    with pytest.raises(fogbank.ConfigError, match=r"^fog.height_m: "):
        fogbank.plan(CONFIG, overrides={"fog.height_m": "tall"})
    with pytest.raises(fogbank.ConfigError, match=r"^fog.heigth_m: unknown key"):
        fogbank.plan(CONFIG | {"fog": {"model": "advection", "heigth_m": 180}})
    with pytest.raises(fogbank.ConfigError, match="nowhere.glb"):
        fogbank.render(CONFIG | {"scene": {"file": "nowhere.glb"}}, 0)
    with pytest.raises(fogbank.DataSetError, match="is a file"):
        fogbank.sweep(CONFIG, file)
    with pytest.raises(fogbank.ConfigError, match="valid: resume, overwrite, extend"):
        fogbank.sweep(CONFIG, tmp_path / "out", mode="again")


def test_sweeps_go_on(tmp_path):
    first = fogbank.sweep(CONFIG, tmp_path, where="fog.height_m = 180")
    assert first.counts == {"done": 2, "failed": 0, "missing": 4}
    heard: list[tuple[float, str]] = []
    whole = fogbank.sweep(CONFIG, tmp_path, progress=lambda share, text: heard.append((share, text)))
    assert len(whole) == 6 and sum("done in" in text for _, text in heard) == 4 and heard[-1][0] > 0.9
    with pytest.raises(fogbank.DataSetError, match="fog.height_m|seed"):
        fogbank.sweep(CONFIG | {"seed": 4}, tmp_path)


LONG = CONFIG | {"render": {"samples": 300}, "sensor": {"width_px": 320, "height_px": 180, "horizontal_fov_deg": 60}}


def test_the_lock_is_released_and_an_exception_of_the_listener_stops_it():
    seen: list[float] = []
    other = threading.Event()

    def stop_soon(share: float, text: str) -> None:
        seen.append(share)
        if other.is_set():
            raise RuntimeError("enough")

    timer = threading.Timer(0.2, other.set)
    timer.start()
    started = time.monotonic()
    with pytest.raises(RuntimeError, match="enough"):
        fogbank.render(LONG, 0, progress=stop_soon)
    assert seen and time.monotonic() - started < 30


def test_ctrl_c():
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        fogbank.render(LONG, 0)
    assert 0.3 < time.monotonic() - started < 15


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_fork_reads_and_renders(data):
    """As the workers of a DataLoader do, after the parent has used threads."""
    script = (
        "import os, sys, fogbank\n"
        "data = fogbank.open(sys.argv[1])\n"
        "data[0].hdr, fogbank.render(data.config, 0), fogbank.Fog(height_m=90).sigma_t(2, 1550)\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        "    ok = (data[1].hdr == fogbank.render(data.config, 1).hdr).all() and fogbank.Fog(height_m=90).sigma_t(2, 1064) > 0\n"
        "    os._exit(0 if ok else 1)\n"
        "sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    subprocess.run([sys.executable, "-c", script, str(data.dir)], check=True, timeout=60)


def test_warnings_of_the_library_are_pythons(tmp_path):
    thick = {key: value for key, value in CONFIG.items() if key != "sweep"} | {"fog": {"model": "advection", "height_m": 400}}
    with pytest.warns(UserWarning, match="extrapolation"):
        fogbank.sweep(thick, tmp_path)


def test_it_is_typed():
    assert (Path(fogbank.__file__).parent / "py.typed").is_file()
