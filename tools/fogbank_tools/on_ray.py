"""fogbank-ray CONFIG --out DIR: a sweep on a Ray cluster.

The plan is dealt into parts, and every part is a Ray task that runs `fogbank sweep --shard` on one node. The folder, the
configuration and its files must be at the same place on every node (a network file system, or one machine). A task whose
node or process dies is run again elsewhere and goes on with what is missing; a frame has the same bytes wherever it is made.
Ray's dashboard shows tasks, nodes and their output; `pip install 'ray[default]'` has it.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

MOST_PARTS = 1000


def count_frames(program: str, config: Path, sets: list[str]) -> int:
    """Number of frames of the plan; raises SystemExit with Fogbank's message if the configuration is wrong."""
    command = [program, "plan", str(config), "--json", *_sets(sets)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        count = sum(1 for _ in process.stdout)
        message = process.stderr.read()
    if process.returncode != 0:
        raise SystemExit(message.strip())
    return count


def _sets(sets: list[str]) -> list[str]:
    return [word for value in sets for word in ("--set", value)]


def run_part(command: list[str], part: int) -> dict:
    """One part, on the node where Ray has put it: counts of its frames, and the reasons of those that failed."""
    done, failures = 0, {}
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            event = json.loads(line)
            if event["event"] == "frame_done":
                done += 1
                print(f"{event['frame']}: {event['seconds']:.1f} s", flush=True)
            elif event["event"] == "frame_failed":
                failures[event["frame"]] = event["reason"]
        message = process.stderr.read().strip()
    # 0: all done; 1: frames failed, which another try would not mend. Anything else is the machine's or the user's fault.
    if process.returncode not in (0, 1):
        raise RuntimeError(f"part {part} ended with status {process.returncode}: {message}")
    return {"part": part, "done": done, "failures": failures}


def sweep(args: argparse.Namespace) -> int:
    """Runs all parts; returns the exit code."""
    import ray

    config, out = args.config.resolve(), args.out.resolve()
    frames = count_frames(args.program, config, args.set)
    parts = min(args.parts or MOST_PARTS, frames)
    ray.init(address=args.address, log_to_driver=args.verbose, ignore_reinit_error=True)
    # A node that dies or a program that cannot run there: again, elsewhere.
    task = ray.remote(
        num_cpus=args.cpus,
        memory=args.memory_gib * 2**30 if args.memory_gib else None,
        max_retries=args.retries,
        retry_exceptions=True,
    )(run_part)
    tables = str(args.cache_dir.resolve() if args.cache_dir else Path(f"{out}.tables"))
    common = [args.program, "sweep", str(config), "--out", str(out), "--cache-dir", tables, "--log", "json",
              "--threads", str(args.cpus), "--retry-failed", *_sets(args.set)]
    waiting = [task.remote([*common, "--shard", f"{part}/{parts}"], part) for part in range(parts)]
    begun, ended, failures, lost = time.monotonic(), 0, {}, 0
    while waiting:
        ready, waiting = ray.wait(waiting)
        for reference in ready:
            ended += 1
            try:
                failures |= ray.get(reference)["failures"]
            except ray.exceptions.RayError as error:
                lost += 1
                print(f"lost: {error}", file=sys.stderr)
        elapsed = time.monotonic() - begun
        left = elapsed / ended * (parts - ended)
        print(f"{ended} of {parts} parts, {elapsed:.0f} s, about {left:.0f} s left", flush=True)
    # Ray tells of nodes until then, on the same output.
    ray.shutdown()
    for frame, reason in failures.items():
        print(f"{frame} FAILED: {reason}", file=sys.stderr)
    # The proof is the data set's own.
    return max(subprocess.run([args.program, "verify", str(out)], check=False).returncode, int(lost > 0))


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("config", type=Path, help="configuration of the sweep")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder of the data set")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="override a value, as fogbank does")
    parser.add_argument("--address", help="Ray cluster, as `auto` or ray://HOST:10001 [default: one on this machine]")
    parser.add_argument("--parts", type=int, metavar="N", help=f"number of tasks [default: the frames, {MOST_PARTS} at most]")
    parser.add_argument("--cpus", type=int, default=2, metavar="N", help="cores of each task [2]")
    parser.add_argument("--memory-gib", type=float, metavar="GIB", help="memory that Ray reserves for each task")
    parser.add_argument("--retries", type=int, default=3, metavar="N", help="times that a lost task is run again [3]")
    parser.add_argument("--cache-dir", type=Path, metavar="DIR", help="folder of the optics tables [DIR.tables]")
    parser.add_argument("--program", default="fogbank", metavar="PATH", help="the program on the nodes [fogbank]")
    parser.add_argument("--verbose", action="store_true", help="show what the tasks print")
    return sweep(parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
