#!/usr/bin/env bash
# Every check and every test of Fogbank, on a machine with Rust and Python 3. Installs what it needs. Stops at the first
# failure. CI runs this file.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TERM_COLOR=never
DENY=0.20.2

step() { printf '\n== %s (%ss)\n' "$1" "$SECONDS"; }

tools="${CARGO_TARGET_DIR:-target}/tools"
mkdir -p "$tools"

step "Python packages, which arrive while Rust compiles"
[ -d "$tools/venv" ] || python3 -m venv "$tools/venv"
"$tools/venv/bin/python" -m pip install --quiet --disable-pip-version-check -e "tools[test]" >"$tools/pip.log" 2>&1 &
packages=$!

step "rustfmt"
cargo fmt --all --check

step "clippy"
cargo clippy --quiet --release --workspace --all-targets -- -D warnings

step "documentation"
RUSTDOCFLAGS="-D warnings" cargo doc --quiet --release --workspace --no-deps

step "layers"
bash tests/layers.sh

step "licences, sources, duplicates"
deny="$(command -v cargo-deny || true)"
[ -n "$deny" ] || deny="$tools/bin/cargo-deny"
# Without optimisation it is built in a third of the time, and reads two small files all the same.
[ -x "$deny" ] || CARGO_PROFILE_DEV_DEBUG=0 cargo install --quiet --debug --locked --version "$DENY" --root "$tools" cargo-deny
"$deny" --log-level error check licenses bans sources

step "Open Image Denoise, for the tests of the output \`denoised\`"
[ -d "$tools/oidn/pyoidn" ] || "$tools/venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps \
  --target "$tools/oidn" pyoidn==2.5.1.0
FOGBANK_OIDN="$(realpath "$tools/oidn/pyoidn/oidn/lib")"
export FOGBANK_OIDN

step "tests in release mode"
# The Python package has its tests in Python, and minutes of compiling of its own: crates/fogbank-py/test.sh.
cargo test --release --workspace --exclude fogbank-py

step "a job array on Slurm"
bash tests/slurm.sh "${CARGO_TARGET_DIR:-target}/release/fogbank"

step "tools in Python"
wait "$packages" || { cat "$tools/pip.log"; exit 1; }
bash tools/test.sh

step "all passed"
