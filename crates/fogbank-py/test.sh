#!/usr/bin/env bash
# The Python package as its users get it: a wheel, built with maturin, installed into a fresh virtual environment and tested there.
set -euo pipefail
cd "$(dirname "$0")/../.."
target="$(realpath -m "${CARGO_TARGET_DIR:-target}")"
export CARGO_TARGET_DIR="$target"

# maturin lives with the other tools.
[ -d "$target/tools/venv" ] || python3 -m venv "$target/tools/venv"
"$target/tools/venv/bin/python" -m pip install --quiet --disable-pip-version-check 'maturin>=1.16,<2'
rm -rf "$target/wheels" "$target/tools/fresh"
"$target/tools/venv/bin/maturin" build --quiet --release --locked --manifest-path crates/fogbank-py/Cargo.toml \
  --interpreter python3 --out "$target/wheels"
ls -l "$target"/wheels/*.whl | awk '{print $5 " bytes: " $NF}'

python3 -m venv "$target/tools/fresh"
python="$target/tools/fresh/bin/python"
wheel="$(ls "$target"/wheels/*.whl)"
"$python" -m pip install --quiet --disable-pip-version-check "$wheel[test]"
export FOGBANK="$target/release/fogbank" MPLBACKEND=Agg
cd crates/fogbank-py
"$python" -m mypy --config-file pyproject.toml -p fogbank
"$python" -m mypy --config-file pyproject.toml tests/typed_sample.py
"$python" -m pytest -q -p no:cacheprovider tests
