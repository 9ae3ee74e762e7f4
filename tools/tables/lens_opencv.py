"""Writes tests/data/lens_opencv.csv: image points of OpenCV's lens models, for the tests of fog_core::lens.

    pip install opencv-python-headless numpy
    python tools/tables/lens_opencv.py > tests/data/lens_opencv.csv

Points lie on a grid of directions; image points are in OpenCV's convention (pixel centres at integers).
"""

import sys

import cv2
import numpy as np

FX, FY, CX, CY = 700.0, 710.0, 630.25, 355.5
MATRIX = np.array([[FX, 0, CX], [0, FY, CY], [0, 0, 1]])

# name: (k1, k2, p1, p2, k3, k4, k5, k6) as OpenCV orders them, or (k1, k2, k3, k4) of a fisheye
PLANE = {
    "none": [0.0] * 8,
    "barrel": [-0.28, 0.07, 0, 0, -0.006, 0, 0, 0],
    "pincushion": [0.12, 0.03, 0.0004, -0.0007, 0.002, 0, 0, 0],
    "tangential": [-0.15, 0.02, 0.004, -0.006, 0, 0, 0, 0],
    "rational": [3.2, 1.4, 0.0006, -0.0003, 0.05, 3.55, 2.4, 0.3],
}
FISHEYE = {
    "equidistant": [0.0] * 4,
    "kannala": [-0.02, 0.004, -0.0008, 0.0001],
    "strong": [0.08, -0.03, 0.012, -0.002],
}


def main():
    out = sys.stdout
    out.write(f"# OpenCV {cv2.__version__}; fx {FX}, fy {FY}, cx {CX}, cy {CY}; tools/tables/lens_opencv.py\n")
    out.write("# model,name,eight coefficients k1 k2 p1 p2 k3 k4 k5 k6 (fisheye: k1 k2 k3 k4),x,y,z,u_px,v_px\n")
    zero = np.zeros(3)
    grid = [(x, y) for x in np.linspace(-0.9, 0.9, 7) for y in np.linspace(-0.5, 0.5, 5)]
    plane = np.array([(x, y, 1.0) for x, y in grid]) * 2.5
    wide = np.array([(2.2 * x, 2.2 * y, 1.0) for x, y in grid])
    for name, k in PLANE.items():
        image, _ = cv2.projectPoints(plane, zero, zero, MATRIX, np.array(k))
        rows(out, "plane", name, k, plane, image)
    for name, k in FISHEYE.items():
        image, _ = cv2.fisheye.projectPoints(wide.reshape(-1, 1, 3), zero, zero, MATRIX, np.array(k))
        rows(out, "fisheye", name, k + [0.0] * 4, wide, image)


def rows(out, model, name, k, points, image):
    for point, uv in zip(points, image.reshape(-1, 2)):
        numbers = [*k, *point, *uv]
        out.write(f"{model},{name}," + ",".join(repr(float(v)) for v in numbers) + "\n")


main()
