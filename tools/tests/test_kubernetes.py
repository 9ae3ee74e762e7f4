"""The Job of `fogbank emit kubernetes` against Kubernetes' own schema."""

import json
import os
import subprocess

import pytest

kubernetes_validate = pytest.importorskip("kubernetes_validate")

FOGBANK = os.environ.get("FOGBANK", "target/release/fogbank")
CONFIG = "version: 1\nname: My_Fog.1\nscene: none\nfog: none\nlighting: day\nsweep: {axes: {camera.altitude_m: [2, 3, 4]}}\n"


@pytest.mark.parametrize("out", ["/data/out", "s3://bucket/out"])
def test_the_job_is_of_the_schema(out, tmp_path):
    (tmp_path / "c.yaml").write_text(CONFIG)
    words = ["emit", "kubernetes", "c.yaml", "--out", out, "--parts", "3", "--image", "registry/fogbank:0.1", "--claim", "data"]
    printed = subprocess.run([FOGBANK, *words], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    job = json.loads(printed)
    kubernetes_validate.validate(job, "1.31", strict=True)
    command = job["spec"]["template"]["spec"]["containers"][0]["command"]
    assert command[command.index("--out") + 1] == out and command[command.index("--cache-dir") + 1] == out + ".tables"
    job["spec"]["completions"] = "three"
    with pytest.raises(kubernetes_validate.ValidationError):
        kubernetes_validate.validate(job, "1.31", strict=True)
