"""A sweep on a Ray cluster of two nodes, one of which dies on the way."""

import filecmp
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

ray = pytest.importorskip("ray", reason="ray is not installed")
cluster_utils = pytest.importorskip("ray.cluster_utils")

FOGBANK = os.environ["FOGBANK"]
STREET = Path(__file__).resolve().parents[2] / "scenes" / "street.glb"
CONFIG = f"""
version: 1
name: ray
scene: {{file: {STREET}}}
fog: {{model: homogeneous, height_m: 60, sigma_t_1_m: 0.02, phase: {{hg: 0.8}}}}
lighting: day
sensor: {{width_px: 48, height_px: 28}}
render: {{samples: 10}}
sweep: {{axes: {{camera.altitude_m: {{from: 2, to: 40, count: 24}}}}}}
"""


def names(folder):
    """Files of the data set but for timings, which may differ."""
    return sorted(p.name for p in folder.iterdir() if not p.name.endswith(".timing.json"))


def test_a_node_dies(tmp_path, monkeypatch):
    config = tmp_path / "c.yaml"
    config.write_text(CONFIG)
    subprocess.run([FOGBANK, "sweep", config, "--out", tmp_path / "alone", "--quiet"], check=True)
    # Ray's workers step back for other programs by default.
    monkeypatch.setenv("RAY_worker_niceness", "0")
    cluster = cluster_utils.Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "include_dashboard": False})
    try:
        nodes = [cluster.add_node(num_cpus=1) for _ in range(2)]
        command = [sys.executable, "-m", "fogbank_tools.on_ray", config, "--out", tmp_path / "out", "--cpus", "1",
                   "--program", FOGBANK, "--address", cluster.address]
        # Ray tells what it likes on the other output.
        errors = (tmp_path / "errors").open("w+")
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, text=True)
        said = []
        reader = threading.Thread(target=lambda: said.extend(process.stdout))
        reader.start()
        deadline = time.monotonic() + 120
        while len(list((tmp_path / "out").glob("*.done"))) < 3 and time.monotonic() < deadline:
            time.sleep(0.02)
        before = len(list((tmp_path / "out").glob("*.done")))
        cluster.remove_node(nodes[0], allow_graceful=False)
        assert process.wait(timeout=300) == 0, "".join(said) + Path(errors.name).read_text()
        reader.join()
    finally:
        cluster.shutdown()
    assert 3 <= before < 24, "the node died in the middle"
    assert any("24 done, 0 failed, 0 missing" in line for line in said), said
    assert names(tmp_path / "alone") == names(tmp_path / "out")
    _, differ, missing = filecmp.cmpfiles(tmp_path / "alone", tmp_path / "out", names(tmp_path / "out"), shallow=False)
    assert not differ and not missing


def test_a_wrong_configuration_is_said(tmp_path):
    config = tmp_path / "c.yaml"
    config.write_text("version: 1\nname: x\nfogg: none\n")
    command = [sys.executable, "-m", "fogbank_tools.on_ray", config, "--out", tmp_path / "out", "--program", FOGBANK]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 1 and "fogg: unknown key" in ended.stderr
