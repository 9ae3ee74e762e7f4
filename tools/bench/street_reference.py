"""Block means of the street in fog by Mitsuba 3: the references tests/data/street_*_reference.csv that tests/suites/street.rs reads.

    target/tools/mitsuba/bin/python tools/bench/street_reference.py day --variant llvm_ad_spectral --samples 160
    target/tools/mitsuba/bin/python tools/bench/street_reference.py night --variant llvm_ad_rgb --samples 240

The environment is that of tools/bench/mitsuba.py, and so is the scene. Many renderings of few samples are averaged; how much a
pixel differs between them gives the standard error of a block's mean; the table is written after each, so that the run may
be ended early. Colours by day are Mitsuba's spectral variant's, by night its RGB variant's: its spectral variant overshoots
saturated emission such as the street's red and blue.
"""

import argparse
import importlib.util
import json
import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
spec = importlib.util.spec_from_file_location("fogbank_bench_mitsuba", HERE / "mitsuba.py")
bench = importlib.util.module_from_spec(spec)
sys.path = [p for p in sys.path if Path(p or ".").resolve() != HERE]  # its name must not hide the package
spec.loader.exec_module(bench)

BLOCK = 30


def blocks(image):
    """Means over blocks, row 0 at the top."""
    rows, columns = bench.HEIGHT // BLOCK, bench.WIDTH // BLOCK
    return image.reshape(rows, BLOCK, columns, BLOCK, 3).mean((1, 3))


def text(options, count, total, squares, version):
    """The table after `count` renderings with these sums of values and squares."""
    import numpy as np

    mean = total / count
    variance = (squares / count - mean**2) / (count - 1)  # of each pixel's mean
    block_mean, block_se = blocks(mean), np.sqrt(blocks(variance)) / BLOCK
    whole, whole_se = mean.mean((0, 1)), np.sqrt(variance.mean((0, 1)) / (bench.WIDTH * bench.HEIGHT))
    show = lambda values: "[" + ", ".join(f"{v:.6g}" for v in values) + "]"
    lines = [
        f"# Mitsuba {version} {options.variant} volpath, depth 1000, roulette from {options.roulette}, "
        f"{count * options.chunk} samples a pixel, {bench.WIDTH}x{bench.HEIGHT}, seeds from {options.first_seed}; "
        f"{bench.SCENES[options.scene]} in fog_layers.csv; blocks of {BLOCK}x{BLOCK} pixels, row 0 at the top; "
        f"image mean {show(whole)}, its standard error {show(whole_se)}",
        "row,column,mean_r,mean_g,mean_b,se_r,se_g,se_b",
    ]
    for r, c in np.ndindex(block_mean.shape[:2]):
        lines.append(f"{r},{c}," + ",".join(f"{v:.6g}" for v in [*block_mean[r, c], *block_se[r, c]]))
    return "\n".join([*lines, ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", choices=list(bench.SCENES))
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--samples", type=int, default=240, help="a pixel, in all")
    parser.add_argument("--chunk", type=int, default=8, help="samples of one rendering")
    parser.add_argument("--first-seed", type=int, default=1000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--out", help="instead of tests/data/street_SCENE_reference.csv")
    options = parser.parse_args()
    libraries = sorted(Path("/usr/lib").glob("*/libLLVM*19*.so*")) + sorted(Path("/usr/lib").glob("*/libLLVM.so.19*"))
    if libraries:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", str(libraries[0]))
    import mitsuba
    import numpy as np

    options.roulette = 5 if "night" in options.scene else 1000
    fog = bench.fog_of(options.scene, None, None)
    scene = bench.Mitsuba(options.variant, options.scene, fog, options.roulette, options.threads)
    out = Path(options.out) if options.out else bench.DATA / f"street_{options.scene}_reference.csv"
    total, squares = 0.0, 0.0
    for i in range(options.samples // options.chunk):
        image, seconds = scene.render(options.chunk, options.first_seed + i)
        assert np.isfinite(image).all()
        total, squares = total + image, squares + image**2
        print(json.dumps({"samples": (i + 1) * options.chunk, "seconds": seconds}), flush=True)
        if i > 0:
            out.write_text(text(options, i + 1, total, squares, mitsuba.__version__))


if __name__ == "__main__":
    main()
