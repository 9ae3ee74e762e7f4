"""What one core of this machine can do: the ceilings of docs/performance.md's roofline.

    target/tools/mitsuba/bin/python tools/bench/machine.py

Processor time, the best of several runs, one thread: bytes copied per second in memory and in the second-level cache, and f32
operations per second of a matrix product (NumPy's BLAS: all SIMD units).
"""

import json
import os
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402


def best(work, runs=7):
    """Least processor seconds of a call."""
    seconds = []
    for _ in range(runs):
        start = time.process_time()
        work()
        seconds.append(time.process_time() - start)
    return min(seconds)


def copy_rate(size, repeats):
    source, target = np.ones(size // 8), np.empty(size // 8)

    def work():
        for _ in range(repeats):
            np.copyto(target, source)

    return 2 * size * repeats / best(work)


def product_rate(n):
    a = np.random.default_rng(1).random((n, n), dtype=np.float32)
    return 2 * n**3 / best(lambda: a @ a)


def main():
    print(json.dumps({
        "memory_gb_s": round(copy_rate(1 << 27, 1) / 1e9, 1),
        "l2_gb_s": round(copy_rate(1 << 18, 2000) / 1e9, 1),
        "f32_gflop_s": round(product_rate(1024) / 1e9, 1),
    }))


if __name__ == "__main__":
    main()
