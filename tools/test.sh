#!/usr/bin/env bash
# Tests of the Python tools, in an environment of their own below target/.
set -euo pipefail
cd "$(dirname "$0")/.."
target="${CARGO_TARGET_DIR:-target}"
cargo build --quiet --release -p fog-cli
[ -d "$target/tools/venv" ] || python3 -m venv "$target/tools/venv"
"$target/tools/venv/bin/python" -m pip install --quiet --disable-pip-version-check -e "tools[test]"
# It asks for numpy below 2, which its loader does not need and others here cannot have.
"$target/tools/venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps nuscenes-devkit==1.2.0
FOGBANK="$(realpath "$target/release/fogbank")" "$target/tools/venv/bin/python" -m pytest -q tools/tests
