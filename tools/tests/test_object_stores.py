"""Sweeps into a bucket: the same bytes as in a folder, on a server that fails every fifth request, killed in the middle."""

import http.client
import os
import signal
import socket
import subprocess
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

boto3 = pytest.importorskip("boto3")
server = pytest.importorskip("moto.server")

FOGBANK = os.environ.get("FOGBANK", "target/release/fogbank")
REPOSITORY = Path(__file__).resolve().parents[2]
CONFIG = f"""\
version: 1
name: bucket
scene: {{file: {REPOSITORY}/scenes/street.glb}}
fog: {{model: homogeneous, height_m: 60, sigma_t_1_m: 0.02, phase: {{hg: 0.8}}}}
lighting: day
sensor: {{width_px: 24, height_px: 14}}
render: {{samples: 40}}
sweep: {{axes: {{camera.altitude_m: [2, 3, 4, 5, 6, 7, 8, 9]}}}}
"""


class Failing(ThreadingHTTPServer):
    """Passes requests on to a server; every fifth is refused with 500 or 503, or its connection is closed, before or after the
    server has done what was asked."""

    daemon_threads = True

    def __init__(self, port):
        super().__init__(("127.0.0.1", 0), Pass)
        self.port, self.lock, self.count, self.failures = port, threading.Lock(), 0, 0

    def turn(self):
        with self.lock:
            self.count += 1
            if self.count % 5:
                return None
            self.failures += 1
            return ["500", "503", "close", "close after"][self.failures % 4]


class Pass(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def handle_one_request(self):
        try:
            super().handle_one_request()
        except (ConnectionError, TimeoutError):
            self.close_connection = True

    def passed(self):
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        fault = self.server.turn()
        if fault in ("500", "503"):
            self.answer(int(fault), {}, b"<Error><Code>SlowDown</Code></Error>")
            return
        if fault == "close":
            self.drop()
            return
        connection = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=30)
        connection.request(self.command, self.path, body, dict(self.headers))
        answer = connection.getresponse()
        content = answer.read()
        if fault == "close after":
            self.drop()
            return
        self.answer(answer.status, dict(answer.getheaders()), content)

    def drop(self):
        self.close_connection = True
        self.connection.shutdown(socket.SHUT_RDWR)

    def answer(self, status, headers, content):
        self.send_response_only(status)
        kept = {k: v for k, v in headers.items() if k.lower() not in ("transfer-encoding", "connection", "content-length")}
        length = headers.get("Content-Length", len(content)) if self.command == "HEAD" else len(content)
        for key, value in {**kept, "Content-Length": str(length)}.items():
            self.send_header(key, value)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(content)

    do_GET = do_PUT = do_POST = do_HEAD = do_DELETE = passed

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def bucket():
    """An S3 server with a bucket, and one before it that fails."""
    moto = server.ThreadedMotoServer(ip_address="127.0.0.1", port=0, verbose=False)
    moto.start()
    _, port = moto.get_host_and_port()
    failing = Failing(port)
    threading.Thread(target=failing.serve_forever, daemon=True).start()
    keys = {"aws_access_key_id": "test", "aws_secret_access_key": "test", "region_name": "us-east-1"}
    s3 = boto3.client("s3", endpoint_url=f"http://127.0.0.1:{port}", **keys)
    s3.create_bucket(Bucket="fog")
    yield s3, failing, port
    failing.shutdown()
    moto.stop()


def environment(port):
    return {
        **{k: v for k, v in os.environ.items() if not k.startswith("AWS_")},
        "AWS_ACCESS_KEY_ID": "test", "AWS_SECRET_ACCESS_KEY": "test", "AWS_REGION": "us-east-1",
        "AWS_ENDPOINT_URL": f"http://127.0.0.1:{port}", "NO_PROXY": "127.0.0.1",
    }


def objects(s3, prefix):
    pages = s3.get_paginator("list_objects_v2").paginate(Bucket="fog", Prefix=prefix + "/")
    keys = [item["Key"] for page in pages for item in page.get("Contents", [])]
    content = {key[len(prefix) + 1:]: s3.get_object(Bucket="fog", Key=key)["Body"].read() for key in keys}
    return {name: b"" if name.endswith(".timing.json") else data for name, data in content.items()}


def files(folder):
    return {p.name: b"" if p.name.endswith(".timing.json") else p.read_bytes() for p in folder.iterdir()}


def test_the_bytes_of_a_folder_from_a_server_that_fails(bucket, tmp_path):
    s3, failing, _ = bucket
    env = environment(failing.server_address[1])
    (tmp_path / "c.yaml").write_text(CONFIG)

    def run(*words):
        return subprocess.run([FOGBANK, *words], cwd=tmp_path, env=env, capture_output=True, text=True)

    assert run("sweep", "c.yaml", "--out", "alone").returncode == 0
    sweep = ["sweep", "c.yaml", "--out", "s3://fog/deep/out", "--workers", "2", "--threads", "1"]
    # Killed when some frames are there.
    process = subprocess.Popen([FOGBANK, *sweep], cwd=tmp_path, env=env, stdout=subprocess.DEVNULL)
    deadline = time.monotonic() + 60
    while not any(name.endswith(".done") for name in objects(s3, "deep/out")):
        assert time.monotonic() < deadline and process.poll() is None
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert run("verify", "s3://fog/deep/out").returncode == 1
    # Two overlapping shards at once, then the rest: nothing but what is missing.
    shards = [
        subprocess.Popen([FOGBANK, *sweep[:4], "--shard", shard, "--quiet"], cwd=tmp_path, env=env)
        for shard in ("0/2", "0/3")
    ]
    assert [shard.wait() for shard in shards] == [0, 0]
    ended = run(*sweep)
    assert ended.returncode == 0, ended.stderr
    assert "frames are done already" in ended.stdout
    assert objects(s3, "deep/out") == files(tmp_path / "alone")
    assert failing.failures > 20
    verified = run("verify", "s3://fog/deep/out")
    assert verified.returncode == 0 and "8 done" in verified.stdout, verified.stdout + verified.stderr

    merged = run("merge", "s3://fog/deep/out", "--out", "fetched")
    assert merged.returncode == 0, merged.stderr
    assert files(tmp_path / "fetched") == files(tmp_path / "alone")
    put = run("merge", "alone", "--out", "s3://fog/put")
    assert put.returncode == 0 and objects(s3, "put") == files(tmp_path / "alone"), put.stderr

    # A damaged object is named, and rendered again where asked for.
    key = next(name for name in objects(s3, "put") if name.endswith(".hdr.exr"))
    s3.put_object(Bucket="fog", Key=f"put/{key}", Body=b"x")
    verified = run("verify", "s3://fog/put")
    assert verified.returncode == 1 and f"{key}: has 1 bytes" in verified.stdout
    assert run("sweep", "c.yaml", "--out", "s3://fog/put", "--recheck").returncode == 0
    assert objects(s3, "put") == files(tmp_path / "alone")


def test_tables_are_shared_by_a_bucket(bucket, tmp_path):
    """A table is put by the one who builds it, and fetched by others."""
    s3, failing, _ = bucket
    (tmp_path / "c.yaml").write_text(
        "version: 1\nname: t\nscene: none\nfog: {model: droplets, height_m: 60, number_density_1_m3: 1e8, "
        "droplets: {lognormals: [{share: 1, median_diameter_um: 8, geometric_sd: 1.3}]}}\nlighting: day\nsensor: {width_px: 2, height_px: 2}\nrender: {samples: 1}\n"
    )

    def run(home):
        env = environment(failing.server_address[1]) | {"HOME": str(tmp_path / home), "XDG_CACHE_HOME": ""}
        words = [FOGBANK, "sweep", "c.yaml", "--out", home + "-out", "--cache-dir", "s3://fog/tables"]
        ended = subprocess.run(words, cwd=tmp_path, env=env, capture_output=True, text=True)
        assert ended.returncode == 0, ended.stderr
        return ended.stdout

    assert "built in" in run("one")
    assert [name for name in objects(s3, "tables") if name.endswith(".fogtable")]
    assert "built in" not in run("two")


def test_refusals_say_what_to_do(bucket, tmp_path):
    _, _, port = bucket
    (tmp_path / "c.yaml").write_text(CONFIG)

    def refused(out, env):
        ended = subprocess.run([FOGBANK, "sweep", "c.yaml", "--out", out], cwd=tmp_path, env=env, capture_output=True, text=True)
        assert ended.returncode == 2, ended.stdout
        return ended.stderr

    env = environment(port)
    assert "the bucket `nothing` does not exist" in refused("s3://nothing/out", env)
    assert "`ftp://` is unknown; expected a folder, s3://" in refused("ftp://fog/out", env)
    assert "the bucket is missing" in refused("s3:///out", env)
