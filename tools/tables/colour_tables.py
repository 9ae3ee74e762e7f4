"""Makes tables/cie/observer_d65_5nm.csv and tables/cie/srgb_basis_5nm.csv (run once; the results are committed).

    pip install colour-science cvxpy && python tools/tables/colour_tables.py tables/cie

observer: CIE 1931 2 degree colour-matching functions and standard illuminant D65 (CIE 15:2018), as shipped by the
colour-science package, every 5 nm from 380 to 780 nm.

srgb_basis: three smooth spectra r, g, b in [0, 1] with r + g + b = 1 whose linear mixtures under D65 give back the mixing
weights as linear sRGB exactly, after Mallett & Yuksel, "Spectral Primary Decomposition for Rendering with sRGB
Reflectance" (EGSR 2019). Found as the quadratic programme: least squared second difference under those constraints. All
functions are piecewise linear between the rows, and products of two are integrated exactly.
"""
import sys

import colour
import cvxpy as cp
import numpy as np

STEP = 5
nm = np.arange(380, 781, STEP)
cmfs = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
d65 = colour.SDS_ILLUMINANTS["D65"]
xyz_bar = np.array([cmfs[float(w)] for w in nm])
illuminant = np.array([d65[float(w)] for w in nm])

n = len(nm)
trapezoid = np.full(n, float(STEP))
trapezoid[[0, -1]] = STEP / 2
mass = np.zeros((n, n))  # integral of the product of two piecewise-linear functions
for i in range(n - 1):
    mass[i : i + 2, i : i + 2] += STEP / 6 * np.array([[2, 1], [1, 2]])

# The sRGB primaries (IEC 61966-2-1), scaled so that D65 as tabulated is (1, 1, 1).
xy = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
primaries = np.stack([xy[:, 0] / xy[:, 1], np.ones(3), (1 - xy.sum(1)) / xy[:, 1]])
weighted = xyz_bar * illuminant[:, None]
white = trapezoid @ weighted
white /= white[1]
rgb_from_xyz = np.linalg.inv(primaries * np.linalg.solve(primaries, white))
response = weighted @ rgb_from_xyz.T
response /= trapezoid @ response

basis = cp.Variable((n, 3))
second = np.diff(np.eye(n), 2, axis=0)
problem = cp.Problem(
    cp.Minimize(cp.sum_squares(second @ basis)),
    [basis >= 0, basis <= 1, cp.sum(basis, axis=1) == 1, response.T @ mass @ basis == np.eye(3)],
)
problem.solve(solver=cp.CLARABEL, tol_gap_abs=1e-12, tol_feas=1e-12)
print(problem.status, problem.value)
found = np.clip(basis.value, 0, 1)
found /= found.sum(1, keepdims=True)
print("round trip error", np.abs(response.T @ mass @ found - np.eye(3)).max())

out = sys.argv[1]
with open(f"{out}/observer_d65_5nm.csv", "w") as f:
    f.write("wavelength_nm,x_bar,y_bar,z_bar,d65\n")
    for w, c, e in zip(nm, xyz_bar, illuminant):
        f.write(f"{w},{c[0]:.12g},{c[1]:.12g},{c[2]:.12g},{e:.8g}\n")
with open(f"{out}/srgb_basis_5nm.csv", "w") as f:
    f.write("wavelength_nm,r,g,b\n")
    for w, c in zip(nm, found):
        f.write(f"{w},{c[0]:.10f},{c[1]:.10f},{1 - round(c[0], 10) - round(c[1], 10):.10f}\n")
