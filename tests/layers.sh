#!/usr/bin/env bash
# The dependency layers of ARCHITECTURE.md: fails if a crate depends on one beside or above it, or on a library that is
# not its own to know.
set -euo pipefail
cd "$(dirname "$0")/.."

layer() {
  case $1 in
    fog-core) echo 0 ;;
    fog-optics | fog-scene | fog-film | fog-sensor | fog-plan | fog-denoise | fog-worlds) echo 1 ;;
    fog-tracer | fog-dataset | fog-figures) echo 2 ;;
    fogbank | fog-export) echo 3 ;;
    fog-cli | fogbank-py) echo 4 ;;
    *) echo "layers: $1 has no layer; add it to tests/layers.sh and ARCHITECTURE.md" >&2; exit 1 ;;
  esac
}

dependencies() { cargo tree --quiet -p "$1" -e normal --depth "$2" --prefix none --format '{p}' | awk '{print $1}' | sort -u; }

bad=0
complain() { echo "layers: $*" >&2; bad=1; }

for dir in crates/*/; do
  crate=$(basename "$dir")
  own=$(layer "$crate")
  for dependency in $(dependencies "$crate" 1 | grep -E '^(fog-|fogbank$)' | grep -vx "$crate" || true); do
    [ "$(layer "$dependency")" -lt "$own" ] || complain "$crate must not depend on $dependency"
  done
done

# Only these know ...
only() {
  local library=$1 allowed=$2
  for dir in crates/*/; do
    crate=$(basename "$dir")
    if dependencies "$crate" 1 | grep -qx "$library" && ! grep -qw -- "$crate" <<<"$allowed"; then
      complain "$crate must not know $library (only $allowed)"
    fi
  done
}
only serde-saphyr "fog-plan fog-optics"  # configurations; the fog model's coefficients
only exr "fog-dataset"
only clap "fog-cli"
only anyhow "fog-cli"
only memmap2 "fogbank"
only libloading "fog-denoise"
only gltf "fog-scene"
only pyo3 "fogbank-py"
only numpy "fogbank-py"

[ "$bad" = 0 ] && echo "layers: ok"
exit "$bad"
