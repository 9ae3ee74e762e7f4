"""Fogbank's Mie kernel against miepython's compiled one: the same droplets, wavelengths and angles, one core, one run.

    pip install miepython==3.3.0 numba numpy
    python tools/bench/mie.py [--wavelengths COUNT]

Both compute the efficiencies of 600 water droplets (0.1 to 60 µm) and their unpolarised intensity at 1000 angles from 0° to
180°, at 16 wavelengths from 400 to 775 nm, droplet by droplet. Rust is built by cargo; numba compiles before the clock
starts. Prints both times, their ratio and the largest differences of the numbers, and the same as a line of JSON.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

os.environ["MIEPYTHON_USE_JIT"] = "1"  # read when miepython is imported
import miepython  # noqa: E402
import numpy as np  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
DIAMETERS, ANGLES = 600, 1000


def one_core():
    """Keeps this process and its children on one core, where the system can."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def fogbank(file):
    """Runs the Rust benchmark on one core; its JSON line, with the numbers left in `file`."""
    command = ["cargo", "bench", "--quiet", "-p", "fog-optics", "--bench", "mie"]
    subprocess.run([*command, "--no-run"], cwd=ROOT, check=True)
    one_core()
    done = subprocess.run([*command, "--", "--write", file], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout.strip().splitlines()[-1])


def droplets(m, sizes, cosines):
    """miepython's efficiencies and intensities of one wavelength."""
    efficiencies = miepython.efficiencies_mx(m, sizes)
    # `wiscombe` leaves the amplitudes as the series has them, so that they compare with Fogbank's.
    intensities = [miepython.i_unpolarized(m, x, cosines, norm="wiscombe") for x in sizes]
    return np.array(efficiencies).T, np.array(intensities)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--wavelengths", type=int, default=16, help="how many of the 16 miepython computes")
    count = arguments.parse_args().wavelengths
    if not 1 <= count <= 16:
        sys.exit("--wavelengths: 1 to 16")

    with tempfile.TemporaryDirectory() as folder:
        file = str(Path(folder) / "mie.f64")
        ours = fogbank(file)
        table = np.fromfile(file, dtype="<f8").reshape(16, DIAMETERS * (4 + ANGLES))

    cosines = np.cos(np.linspace(0.0, np.pi, ANGLES))
    diameters_nm = 100.0 * np.arange(1, DIAMETERS + 1)
    droplets(1.3 - 1e-6j, np.array([0.2, 5.0]), cosines)  # compiles

    seconds, worst_efficiency, worst_intensity = 0.0, 0.0, 0.0
    for row, (nm, n, k) in zip(table[:count], ours["wavelength_n_k"]):
        sizes = np.pi * diameters_nm / nm
        start = time.perf_counter()
        efficiencies, intensities = droplets(complex(n, -k), sizes, cosines)
        seconds += time.perf_counter() - start

        mine = row[: 4 * DIAMETERS].reshape(DIAMETERS, 4)
        worst_efficiency = max(worst_efficiency, np.max(np.abs(efficiencies[:, [0, 1, 3]] / mine[:, [0, 1, 3]] - 1)))
        # Relative to the mean over all directions: next to a zero of the intensity nothing has relative accuracy.
        mine = row[4 * DIAMETERS :].reshape(DIAMETERS, ANGLES)
        mean = 0.25 * sizes**2 * efficiencies[:, 1]
        error = np.abs(intensities - mine) / np.maximum(mine, mean[:, None])
        worst_intensity = max(worst_intensity, np.max(error))

    rust = ours["seconds_1_thread"] * count / 16
    ratio = seconds / rust
    print(f"{count} wavelengths x {DIAMETERS} diameters x {ANGLES} angles, efficiencies and intensities, one core")
    print(f"miepython {miepython.__version__} (numba): {seconds:.2f} s")
    print(f"fogbank: {rust:.3f} s (best of 3; all 16 wavelengths: {ours['seconds_1_thread']:.3f} s)")
    print(f"ratio: {ratio:.1f}")
    print(f"largest relative differences: q_ext, q_sca, g {worst_efficiency:.1e}, intensities {worst_intensity:.1e}")
    result = {"wavelengths": count, "diameters": DIAMETERS, "angles": ANGLES, "miepython_s": seconds, "fogbank_s": rust,
              "ratio": ratio, "worst_efficiency": worst_efficiency, "worst_intensity": worst_intensity}
    print(json.dumps(result))


if __name__ == "__main__":
    main()
