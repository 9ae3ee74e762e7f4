"""Fogbank's tracer against Mitsuba 3: the street of tests/data in fog, 480 x 270 pixels, paths of any length, in one run.

    python3 -m venv target/tools/mitsuba
    target/tools/mitsuba/bin/pip install mitsuba==3.9.1 numpy pillow
    apt-get install libllvm19          # for Mitsuba's llvm variants (15 fails on AVX-512)
    target/tools/mitsuba/bin/python tools/bench/mitsuba.py [--scenes day,night,mie] [--rounds 3]

The measure is the efficiency 1 / (relative mean squared error x seconds). Both programs are unbiased, so that the error is
variance, which half of the squared difference of two independent renderings measures without noise of a reference. It is
relative to the square of a common image (--reference samples a pixel of ours) plus 1 % of that square's mean. In a second
figure the fifth of a percent of pixels that differ most is cut off, for fireflies. `apart` is the relative squared
difference of the two programs' expectations, from products of independent differences; it may come out below 0, and its
root is what a wrong picture would show.

Time is that of tracing alone: Mitsuba's `render` call after a first one that compiles its kernels, and ours without loading
and without the building of tables. Both use the same number of threads. Renderings of the two alternate, because other work
on the machine disturbs both alike, and the medians of the ratios of neighbours are quoted.

Of Mitsuba's variants the fastest on the scene is the opponent: --variants all measures each once before.
"""

import argparse
import io
import json
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# This file's own name must not hide the package that it measures.
sys.path = [p for p in sys.path if Path(p or ".").resolve() != Path(__file__).resolve().parent]
DATA = ROOT / "tests" / "data"
WIDTH, HEIGHT, FIELD_OF_VIEW = 480, 270, 60.0
HALF_BOX_M, TOP_M = 20_000.0, 260.0  # as good as endless: at 1 km the grey day is 0.4 % brighter
VARIANTS = ["llvm_ad_rgb", "scalar_rgb", "scalar_spectral", "llvm_ad_spectral"]
SCENES = {"day": "street_day.glb", "night": "street_night.glb", "mie": "street_day.glb",
          "grey_day": "street_grey.glb", "grey_night": "street_grey_night.glb"}


class Glb:
    """The parts of a binary glTF file that the street uses: one quad a mesh, one material each, PNG textures."""

    def __init__(self, path):
        data = path.read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[20 + length + 8 :]

    def view(self, index):
        view = self.json["bufferViews"][index]
        start = view.get("byteOffset", 0)
        return self.binary[start : start + view["byteLength"]]

    def floats(self, accessor, columns):
        import numpy as np

        return np.frombuffer(self.view(self.json["accessors"][accessor]["bufferView"]), "<f4").reshape(-1, columns)

    def texture(self, reference):
        """Linear reflectance or radiance of a texture, row 0 at v = 0."""
        import numpy as np
        from PIL import Image

        image = self.json["images"][self.json["textures"][reference["index"]]["source"]]
        encoded = np.asarray(Image.open(io.BytesIO(self.view(image["bufferView"]))).convert("RGB"), np.float64) / 255
        linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
        return linear.astype(np.float32)

    def quads(self):
        """(origin, edge along u, edge along v, base colour texels, emission texels or None) of each mesh.

        The edges' cross product points out of the wall; row 0 of the texels is at v = 0.
        """
        import numpy as np

        for mesh in self.json["meshes"]:
            primitive = mesh["primitives"][0]
            corners = self.floats(primitive["attributes"]["POSITION"], 3).astype(float)
            uv = self.floats(primitive["attributes"]["TEXCOORD_0"], 2).astype(float)
            # Affine map of the texture's unit square to the wall.
            flat = np.column_stack([np.ones(4), uv])
            origin, along_u, along_v = np.linalg.lstsq(flat, corners, rcond=None)[0]
            outward = self.floats(primitive["attributes"]["NORMAL"], 3)[0]
            upside_down = np.dot(np.cross(along_u, along_v), outward) < 0
            if upside_down:
                origin, along_v = origin + along_v, -along_v
            material = self.json["materials"][primitive["material"]]
            base = self.texture(material["pbrMetallicRoughness"]["baseColorTexture"])
            base = base * np.float32(material["pbrMetallicRoughness"].get("baseColorFactor", [1] * 4)[:3])
            emission = None
            if max(material.get("emissiveFactor", [0])) > 0:
                emission = self.texture(material["emissiveTexture"]) * np.float32(material["emissiveFactor"])
            if upside_down:
                base, emission = base[::-1], None if emission is None else emission[::-1]
            yield origin, along_u, along_v, base, emission


def mitsuba_scene(mi, name, fog):
    """The scene as a Mitsuba dictionary."""
    import numpy as np

    transform = mi.ScalarTransform4f

    def texels(values):
        return {"type": "bitmap", "bitmap": mi.Bitmap(np.ascontiguousarray(values)), "filter_type": "nearest",
                "wrap_mode": "clamp", "raw": False}

    out = {"type": "scene"}
    for i, (origin, u, v, base, emission) in enumerate(Glb(DATA / SCENES[name]).quads()):
        normal = np.cross(u, v)
        place = np.eye(4)
        place[:3, 0], place[:3, 1], place[:3, 3] = u / 2, v / 2, origin + (u + v) / 2
        place[:3, 2] = normal / np.linalg.norm(normal)
        out[f"wall_{i}"] = {"type": "rectangle", "to_world": transform(place),
                            "bsdf": {"type": "diffuse", "reflectance": texels(base)}}
        if emission is not None and "night" in name:
            out[f"wall_{i}"]["emitter"] = {"type": "area", "radiance": texels(emission)}
    if "night" not in name:
        out["sky"] = {"type": "constant", "radiance": {"type": "rgb", "value": 1.0}}
    density = np.asarray(fog["sigma_t_1_m"], np.float32).reshape(1, -1, 1, 1)  # z, y, x, channel: y is up
    out["fog"] = {
        "type": "heterogeneous", "albedo": 1.0, "phase": fog["phase"], "has_spectral_extinction": False,
        "sigma_t": {"type": "gridvolume", "grid": mi.VolumeGrid(density), "filter_type": "trilinear",
                    "to_world": transform().translate([-HALF_BOX_M, 0, -HALF_BOX_M])
                    .scale([2 * HALF_BOX_M, TOP_M, 2 * HALF_BOX_M])},
    }
    # The box reaches below the ground, so that no two faces share a plane.
    out["box"] = {"type": "cube", "bsdf": {"type": "null"}, "interior": {"type": "ref", "id": "fog"},
                  "to_world": transform().translate([0, TOP_M / 2 - 1, 0])
                  .scale([HALF_BOX_M, TOP_M / 2 + 1, HALF_BOX_M])}
    out["camera"] = {
        "type": "perspective", "fov": FIELD_OF_VIEW, "fov_axis": "x", "near_clip": 0.1, "far_clip": 1e4,
        "to_world": transform().look_at(origin=[0, 1.7, 0], target=[0, 1.7, -100], up=[0, 1, 0]),
        "medium": {"type": "ref", "id": "fog"}, "sampler": {"type": "independent"},
        "film": {"type": "hdrfilm", "width": WIDTH, "height": HEIGHT, "pixel_format": "rgb",
                 "component_format": "float32", "rfilter": {"type": "box"}},
    }
    return out


class Mitsuba:
    """A scene in one of Mitsuba's variants."""

    def __init__(self, variant, name, fog, roulette, threads):
        import mitsuba as mi

        mi.set_variant(variant)
        mi.set_log_level(mi.LogLevel.Error)
        import drjit

        drjit.set_thread_count(threads)
        self.mi, self.variant = mi, variant
        self.scene = mi.load_dict(mitsuba_scene(mi, name, fog))
        self.integrator = mi.load_dict({"type": "volpath", "max_depth": 1000, "rr_depth": roulette})

    def render(self, samples, seed):
        import numpy as np

        start = time.perf_counter()
        image = np.array(self.mi.render(self.scene, integrator=self.integrator, spp=samples, seed=seed), np.float64)
        return image[..., :3], time.perf_counter() - start


def build():
    """Builds our side; the path of its binary."""
    command = ["cargo", "bench", "--quiet", "-p", "fog-tests", "--bench", "street", "--no-run", "--message-format=json"]
    lines = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    artifacts = [json.loads(line) for line in lines if line.startswith("{")]
    return [a["executable"] for a in artifacts if a.get("executable")][-1]


def fogbank(binary, name, samples, seed, threads, folder, *more):
    """One rendering of ours: image and seconds."""
    import numpy as np

    image = Path(folder) / "image.f32"
    command = [binary, "--scene", name, "--samples", samples, "--seed", seed, "--threads", threads, "--write", image]
    done = subprocess.run([*map(str, command), *more], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    pixels = np.fromfile(image, "<f4").reshape(HEIGHT, WIDTH, 3).astype(np.float64)
    return pixels, json.loads(done.stdout.strip().splitlines()[-1])["seconds"]


def relative(square, reference):
    """Squares of each pixel relative to the common image."""
    own = (reference**2).sum(-1)
    return square.sum(-1) / (own + 0.01 * own.mean())


def errors(images, reference):
    """Relative mean squared error of one of the renderings, and without the pixels that differ most."""
    import numpy as np

    pairs = [relative((a - b) ** 2 / 2, reference) for a, b in zip(images[::2], images[1::2])]
    cut = [np.minimum(p, np.quantile(p, 0.998)) for p in pairs]
    return float(np.mean(pairs)), float(np.mean(cut))


def apart(ours, theirs, reference):
    """Relative squared difference of the expectations: its noise has mean 0, for the factors are independent."""
    first, second = (sum(ours[k::2]) / len(ours[k::2]) - sum(theirs[k::2]) / len(theirs[k::2]) for k in (0, 1))
    return float(relative(first * second, reference).mean())


def fog_of(name, binary, folder):
    """σ_t by even layers and the phase function, as Mitsuba takes them."""
    import csv

    if name == "mie":
        file = Path(folder) / "fog.json"
        fogbank(binary, name, 1, 1, 2, folder, "--describe", str(file))
        fog = json.loads(file.read_text())
        values = ",".join(f"{p:.6e}" for p in fog["phase"])
        return {"sigma_t_1_m": fog["sigma_t_1_m"], "phase": {"type": "tabphase", "values": values}}
    with open(DATA / "fog_layers.csv") as file:
        rows = [(float(r["altitude_m"]), float(r["sigma_t_1_m"])) for r in csv.DictReader(file)]
    return {"sigma_t_1_m": [s for z, s in rows if 0 < z < TOP_M], "phase": {"type": "hg", "g": 0.83}}


def best_variant(names, name, fog, reference, options, roulette):
    """The variant with the largest efficiency in one pair of renderings each, and all of them."""
    import gc

    found = {}
    for variant in names:
        theirs = Mitsuba(variant, name, fog, roulette, options.threads)
        theirs.render(options.mitsuba_samples, 90)
        (a, s), (b, t) = (theirs.render(options.mitsuba_samples, seed) for seed in (91, 92))
        found[variant] = 1 / (errors([a, b], reference)[0] * (s + t) / 2)
        print(f"  {name}: Mitsuba {variant}: efficiency {found[variant]:.3f}", flush=True)
        del theirs
        gc.collect()
    return max(found, key=found.get), found


def compare(name, binary, options, folder):
    fog = fog_of(name, binary, folder)
    roulette = 5 if "night" in name else 1000  # what serves Mitsuba best on each (measured)
    variants = VARIANTS if options.variants == "all" else options.variants.split(",")
    reference, _ = fogbank(binary, name, options.reference, 7, options.threads, folder)
    variant, tried = variants[0], {}
    if len(variants) > 1:
        variant, tried = best_variant(variants, name, fog, reference, options, roulette)
    theirs = Mitsuba(variant, name, fog, roulette, options.threads)
    theirs.render(options.mitsuba_samples, 1)  # compiles
    rows = []
    for i in range(2 * options.rounds):
        rows.append((fogbank(binary, name, options.samples, 100 + i, options.threads, folder, "--allocate", options.allocate),
                     theirs.render(options.mitsuba_samples, 200 + i)))
    (ours, mine), (others, their) = ([[r[k][j] for r in rows] for j in (0, 1)] for k in (0, 1))
    ours_error, mitsuba_error = errors(ours, reference), errors(others, reference)
    speed = statistics.median(t / s for s, t in zip(mine, their))
    return {
        "scene": name, "variant": variant, "variants": tried,
        "allocate": options.allocate,
        "fogbank": {"samples": options.samples, "seconds": statistics.median(mine), "relative_mse": ours_error[0],
                    "efficiency": 1 / (ours_error[0] * statistics.median(mine))},
        "mitsuba": {"samples": options.mitsuba_samples, "seconds": statistics.median(their),
                    "relative_mse": mitsuba_error[0],
                    "efficiency": 1 / (mitsuba_error[0] * statistics.median(their))},
        "ratio": speed * mitsuba_error[0] / ours_error[0],
        "ratio_without_outliers": speed * mitsuba_error[1] / ours_error[1],
        "mean_ratio": [float(a / b) if b > 0 else None
                       for a, b in zip(sum(ours).mean((0, 1)), sum(others).mean((0, 1)))],
        "apart": apart(ours, others, reference),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", default="day,night,mie")
    parser.add_argument("--variants", default="llvm_ad_rgb", help="names, or `all`: the best of them is the opponent")
    parser.add_argument("--rounds", type=int, default=2, help="pairs of renderings of each program")
    parser.add_argument("--samples", type=int, default=32, help="ours, a pixel")
    parser.add_argument("--mitsuba-samples", type=int, default=8)
    parser.add_argument("--reference", type=int, default=64, help="samples a pixel of the image that errors are relative to")
    parser.add_argument("--allocate", choices=["even", "relative_error"], default="even",
                        help="how ours shares out its samples over the pixels: render.allocate")
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    unknown = [s for s in options.scenes.split(",") if s not in SCENES]
    if unknown or min(options.rounds, options.samples, options.mitsuba_samples, options.reference, options.threads) < 1:
        sys.exit(f"--scenes: of {', '.join(SCENES)}; numbers from 1 on")
    libraries = [p for v in range(30, 15, -1) for p in sorted(Path("/usr/lib").glob(f"*/libLLVM*{v}*.so*")) +
                 sorted(Path("/usr/lib").glob(f"*/libLLVM.so.{v}*"))]
    if libraries:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", str(libraries[0]))

    binary, results = build(), []
    with tempfile.TemporaryDirectory() as folder:
        for name in options.scenes.split(","):
            results.append(compare(name, binary, options, folder))
            print(json.dumps(results[-1]), flush=True)
    print(f"{'scene':<12}{'program':<28}{'samples':>8}{'seconds':>10}{'rel. MSE':>12}{'efficiency':>12}")
    for r in results:
        for who in ("fogbank", "mitsuba"):
            p = r[who]
            label = who if who == "fogbank" else f"mitsuba {r['variant']}"
            print(f"{r['scene']:<12}{label:<28}{p['samples']:>8}{p['seconds']:>10.3f}{p['relative_mse']:>12.5f}"
                  f"{p['efficiency']:>12.3f}")
        print(f"{'':<12}ratio {r['ratio']:.1f} (without outliers {r['ratio_without_outliers']:.1f}), "
              f"apart {r['apart']:.1e}")
    print(json.dumps({"benchmark": "mitsuba", "threads": options.threads, "results": results}))


if __name__ == "__main__":
    main()
