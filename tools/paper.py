"""The rendered figures of Kolářová, Lachiver & Wilkie 2024 again: renders, compares, and puts pictures and numbers on a page.

    cargo build --release
    pip install pillow
    python tools/paper.py

Renders `configs/paper/*.yaml` with both coefficients into `--out` (what is there already stays), writes `images/paper/*.jpg`
beside `--page` and puts the table of numbers between the page's two marks. `--set` goes to every rendering.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

ROOT = Path(__file__).resolve().parents[1]
COEFFICIENTS, LIGHTS = ("integral", "paper"), ("day", "night")
BLOCKS = 5  # divides the width and the height of the pictures
MARKS = ("<!-- numbers: written by tools/paper.py -->", "<!-- end of numbers -->")
BAND = 22  # height of a line of text in a picture

# Figure: the columns of its pictures (axis value, title), then what is compared: title, figure and axis value of A, and of B.
MODEL = ("fig12", "advection")
FIGURES = {
    "fig08": (
        [("0.83", "Henyey-Greenstein 0.83"), ("mie_mean_diameter", "Mie, mean droplet"), ("mie", "Mie, all droplets")],
        [
            ("HG against Mie, mean droplet", ("fig08", "0.83"), ("fig08", "mie_mean_diameter")),
            ("HG against Mie, all droplets", ("fig08", "0.83"), ("fig08", "mie")),
            ("Mie, mean against all droplets", ("fig08", "mie_mean_diameter"), ("fig08", "mie")),
            ("noise: Mie, all droplets, twice", ("fig08", "mie"), MODEL),
        ],
    ),
    "fig10": (
        [("diameter", "sampled diameters"), ("table", "layered table")],
        [
            ("diameters against table", ("fig10", "diameter"), ("fig10", "table")),
            ("noise: table twice", ("fig10", "table"), MODEL),
        ],
    ),
    "fig12": (
        [("homogeneous", "homogeneous"), ("linear_gradient", "linear gradient"), ("advection", "260 m model")],
        [
            ("linear gradient against model", ("fig12", "linear_gradient"), MODEL),
            ("homogeneous against model", ("fig12", "homogeneous"), MODEL),
            ("noise: model twice", ("fig10", "table"), MODEL),
        ],
    ),
}


class Paper:
    """The rendered data sets and what is made of them."""

    def __init__(self, program, out):
        self.program, self.out = program, out

    def fogbank(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], cwd=ROOT, stdout=subprocess.PIPE, text=True)
        if done.returncode:
            sys.exit(f"fogbank {arguments[0]} ended with code {done.returncode}")
        return done.stdout

    def render(self, sets):
        for coefficient in COEFFICIENTS:
            for figure in FIGURES:
                changes = [part for change in [f"fog.coefficient={coefficient}", *sets] for part in ("--set", change)]
                folder = self.out / f"{figure}-{coefficient}"
                self.fogbank("sweep", ROOT / f"configs/paper/{figure}.yaml", "--out", folder, "--quiet", *changes)

    def picture(self, frame, coefficient, light, kind):
        figure, value = frame
        folder = self.out / f"{figure}-{coefficient}"
        found = list(folder.glob(f"{value}_{light}-*.{kind}"))
        if len(found) != 1:
            sys.exit(f"{folder}: {len(found)} pictures of {value} by {light}")
        return found[0]

    def compare(self, a, b, coefficient, light, blocks, *more):
        files = [self.picture(frame, coefficient, light, "hdr.exr") for frame in (a, b)]
        return json.loads(self.fogbank("compare", *files, "--json", "--blocks", blocks, *more))

    def sheet(self, figure, coefficient, scale):
        """Rows day and night; columns the renderings and ΔE2000 of the first comparison, over blocks."""
        columns, comparisons = FIGURES[figure]
        _, a, b = comparisons[0]
        rows = []
        for light in LIGHTS:
            row = [self.picture((figure, value), coefficient, light, "rgb.png") for value, _ in columns]
            target = self.out / f"{figure}-{coefficient}-{light}.png"
            self.compare(a, b, coefficient, light, BLOCKS, "--out", target, "--scale", scale)
            rows.append([Image.open(path).convert("RGB") for path in [*row, target]])
        width, height = rows[0][0].size
        sheet = Image.new("RGB", (width * len(rows[0]), (height + BAND) * len(rows)), "white")
        pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(size=13)
        titles = [title for _, title in columns] + [f"dE2000 of blocks (yellow: {scale})"]
        for y, (light, row) in enumerate(zip(LIGHTS, rows, strict=True)):
            for x, (picture, title) in enumerate(zip(row, titles, strict=True)):
                corner = (x * width, y * (height + BAND))
                pen.text((corner[0] + 4, corner[1] + 3), f"{light}: {title}" if x == 0 else title, "black", font)
                # A map has one pixel per block, and may have a scale below.
                if x == len(columns):
                    picture = picture.crop((0, 0, -(-width // BLOCKS), -(-height // BLOCKS)))
                picture = picture.resize((width, height), Image.Resampling.NEAREST)
                sheet.paste(picture, (corner[0], corner[1] + BAND))
        return sheet

    def table(self):
        lines = [
            "| figure | coefficient | light | what | ΔE2000 | ΔE2000 of blocks | relative MSE of blocks | brighter by | z |",
            "|---|---|---|---|---|---|---|---|---|",
        ]
        for figure, (_, comparisons) in FIGURES.items():
            for coefficient in COEFFICIENTS:
                for light in LIGHTS:
                    for title, a, b in comparisons:
                        fine = self.compare(a, b, coefficient, light, 1)
                        coarse = self.compare(a, b, coefficient, light, BLOCKS)
                        lines.append(
                            f"| {figure[3:].lstrip('0')} | {coefficient} | {light} | {title} "
                            f"| {fine['delta_e_2000']['mean']:.2f} | {coarse['delta_e_2000']['mean']:.2f} "
                            f"| {coarse['relative_mse']:.1e} | {100 * coarse['relative_difference_of_means']:+.2f} % "
                            f"| {coarse['z_scores']['rms']:.2f} |"
                        )
        return "\n".join(lines)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--out", type=Path, default=ROOT / "out/paper", help="folder of the data sets")
    arguments.add_argument("--page", type=Path, default=ROOT / "docs/paper.md", help="page that gets the numbers")
    arguments.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="as of `fogbank sweep`")
    arguments = arguments.parse_args()

    paper = Paper(os.environ.get("FOGBANK", str(ROOT / "target/release/fogbank")), arguments.out.absolute())
    before, rest = arguments.page.read_text(encoding="utf-8").split(MARKS[0])
    after = rest.split(MARKS[1])[1]
    paper.render(arguments.set)
    images = arguments.page.parent / "images/paper"
    images.mkdir(parents=True, exist_ok=True)
    for figure in FIGURES:
        for coefficient in COEFFICIENTS:
            sheet = paper.sheet(figure, coefficient, 5)
            sheet.save(images / f"{figure}-{coefficient}.jpg", quality=88, optimize=True)
    page = f"{before}{MARKS[0]}\n\n{paper.table()}\n\n{MARKS[1]}{after}"
    arguments.page.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
