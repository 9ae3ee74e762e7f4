"""Writes tests/data/fog_layers_{thin,thick}.csv: radiances and fluxes of the advection fog, by discrete ordinates.

    pip install PythonicDISORT==1.8 scatrs==0.3.0 pyyaml && python tools/tables/fog_layers_disort.py      (minutes)

Nothing of Fogbank's code is used: droplets from the formulae of tables/advection/arcata.yaml, water from
tables/water/hale_querry_1973.csv, the Mie series by scatrs, the transfer of light by PythonicDISORT (Ho & Pincus 2024), which
is the discrete-ordinate method of Stamnes, Tsay, Wiscombe & Jayaweera (1988) with delta-M scaling (Wiscombe 1977) and the
corrections of Nakajima & Tanaka (1988), added at the very directions that are asked for.

The 180 m of fog are cut into even slabs of one phase function each, the mean over its scatterers; the number of droplets is
scaled for the optical depth at 550 nm. The column `off` is how much a coarser solution (56 streams, 16 slabs) differs,
relative to `value`.

Thin: the sun's beam has unit irradiance across itself and travels towards azimuth 0; `mu` is the cosine of the direction of
travel to the upward vertical, > 0 in rows `top`, < 0 in rows `bottom`. Rows whose mu is empty are fluxes through the level:
up at the top, down at the bottom without the beam. Thick: fluxes only, under a sun that is a uniform disc of 16° with unit
irradiance across its centre's direction (a beam in deep fog of droplets takes a path tracer very many samples).
"""

import csv
import json
import re
import sys
import warnings
from pathlib import Path

import numpy as np
import scatrs.mie
import yaml
from PythonicDISORT.pydisort import pydisort
from PythonicDISORT.subroutines import interpolate
from scipy.interpolate import BarycentricInterpolator

ROOT = Path(__file__).resolve().parents[2]
HEIGHT_M = 180.0
WAVELENGTHS_NM = [450, 550, 650]
SUN_ZENITH_DEG = [0, 30, 60, 80]
COSINES = [0.9, 0.6, 0.25]
AZIMUTHS_DEG = [0, 90, 180]
SUN_DIAMETER_DEG = 16
CASES = {"thin": {"tau_550": 0.1, "ground_albedo": 0.0},
         "thick": {"tau_550": 20.0, "ground_albedo": 0.3, "sun_diameter_deg": SUN_DIAMETER_DEG}}
FINE = {"streams": 80, "slabs": 24}
COARSE = {"streams": 56, "slabs": 16}
# A droplet of 60 µm at 450 nm scatters into 2 x 420 orders; the quadrature is exact for products of that with as many.
MOMENTS, NODES = 900, 1000


class Fog:
    """Droplets of the model at one wavelength."""

    def __init__(self, wavelength_nm):
        text = (ROOT / "tables/advection/arcata.yaml").read_text()
        # PyYAML takes 1e7 for a number only with a sign in it.
        self.model = yaml.safe_load(re.sub(r"(\d)e(\d)", r"\1e+\2", text))
        with open(ROOT / "tables/water/hale_querry_1973.csv") as file:
            water = {float(r["wavelength_nm"]): complex(float(r["n"]), float(r["k"])) for r in csv.DictReader(file)}
        low, high = self.model["diameter_range_um"]
        self.diameters = np.linspace(low, high, round((high - low) / 0.1) + 1)
        self.weights = np.full(len(self.diameters), 0.1)
        self.weights[[0, -1]] = 0.05
        x = np.pi * self.diameters / (wavelength_nm * 1e-3)
        index = water[float(wavelength_nm)]
        self.mu, self.mu_weights = np.polynomial.legendre.leggauss(NODES)
        efficiencies = scatrs.mie.efficiencies(x, index)
        area = np.pi / 4 * (self.diameters * 1e-6) ** 2
        self.c_ext, self.c_sca = efficiencies.q_ext * area, efficiencies.q_sca * area
        amplitudes = scatrs.mie.amplitudes(x, index, self.mu)
        # Each droplet's phase function times its cross section, times a factor that all share.
        self.scattered = (np.abs(amplitudes.s1) ** 2 + np.abs(amplitudes.s2) ** 2) * (wavelength_nm * 1e-9) ** 2
        self.legendre = np.polynomial.legendre.legvander(self.mu, MOMENTS - 1)

    def polynomial(self, key, zeta):
        return np.polyval(self.model[key][::-1], zeta)

    def spectrum(self, zeta):
        """Droplets per m³ and µm, and their weights in a sum over diameters."""
        powers = np.array([[c * zeta**i * HEIGHT_M**j for j, c in enumerate(row)]
                           for i, row in enumerate(self.model["number_density"])])
        ratio = np.exp(self.polynomial("ln_gl_ratio", zeta))
        mu, sigma = self.polynomial("mu_L", zeta), self.polynomial("sigma_L", zeta)
        d = self.diameters
        small = np.exp(-(((np.log(d) - mu) / sigma) ** 2) / 2) / (d * sigma * np.sqrt(2 * np.pi))
        mu, sigma = self.polynomial("mu_G", zeta), self.polynomial("sigma_G", zeta)
        large = np.exp(-(((d - mu) / sigma) ** 2) / 2) / (sigma * np.sqrt(2 * np.pi))
        number = powers.sum() * self.model["number_density_scale"]
        return number * (small + ratio * large) / (1 + ratio) * self.weights

    def slabs(self, count, parts=8):
        """Optical depth, albedo and Legendre moments of each, from the top down."""
        tau, scattering, moments = [], [], []
        for slab in range(count):
            zetas = 1 - (slab + (np.arange(parts) + 0.5) / parts) / count
            droplets = np.mean([self.spectrum(z) for z in zetas], axis=0) * HEIGHT_M / count
            tau.append(droplets @ self.c_ext)
            scattering.append(droplets @ self.c_sca)
            phase = droplets @ self.scattered * self.mu_weights
            moment = self.legendre.T @ phase
            moments.append(moment / moment[0])
        return np.array(tau), np.array(scattering) / np.array(tau), np.array(moments)


def directions(zenith_deg):
    """(level, mu, azimuth) of the radiances: not within 8° of the beam's own direction."""
    sun = np.radians(zenith_deg)
    out = []
    for level, sign in (("top", 1), ("bottom", -1)):
        for mu in COSINES:
            for azimuth in AZIMUTHS_DEG if zenith_deg > 0 else [0]:
                cos = -sign * mu * np.cos(sun) + np.sqrt(1 - mu**2) * np.sin(sun) * np.cos(np.radians(azimuth))
                if cos < np.cos(np.radians(8)):
                    out.append((level, sign * mu, azimuth))
    return out


def first_order(edges, strength, series, cos_sun, mu, azimuth):
    """Light scattered once, at the top (mu > 0) or the bottom: closed form of slabs between optical depths `edges`.

    `strength` is each slab's albedo, `series` its phase function's Legendre coefficients times 2 l + 1.
    """
    cos = -mu * cos_sun + np.sqrt((1 - mu**2) * (1 - cos_sun**2)) * np.cos(azimuth)
    phase = np.polynomial.legendre.legval(cos, series.T) / (4 * np.pi)
    # What leaves from depth t is damped by t / cos_sun on its way in, and by its way out.
    rate = 1 / cos_sun + 1 / mu
    damping = np.exp(-edges * rate) if mu > 0 else np.exp(edges[-1] / mu - edges * rate)
    return float(strength * phase @ (damping[:-1] - damping[1:]) / (rate * abs(mu)))


def scattered_once(slabs, tau_scale, zenith_deg):
    """Single scattering alone, in the directions of the table's radiances."""
    tau, albedo, moments = slabs
    edges = np.concatenate([[0.0], np.cumsum(tau * tau_scale)])
    series = moments * (2 * np.arange(moments.shape[1]) + 1)
    cos_sun = np.cos(np.radians(zenith_deg))
    return [first_order(edges, albedo, series, cos_sun, mu, np.radians(azimuth))
            for _, mu, azimuth in directions(zenith_deg)]


def scattered_once_scaled(slabs, streams, cos_sun, mu, azimuth):
    """The same of slabs (with optical depths from the top) as delta-M scales them, with truncated phase functions."""
    depths, albedo, moments = slabs
    peak = moments[:, streams]
    kept = 1 - albedo * peak
    edges = np.concatenate([[0.0], np.cumsum(kept * np.diff(depths, prepend=0.0))])
    truncated = (moments[:, :streams] - peak[:, None]) / (1 - peak)[:, None] * (2 * np.arange(streams) + 1)
    return first_order(edges, albedo * (1 - peak) / kept, truncated, cos_sun, mu, azimuth)


def solve(slabs, tau_scale, zenith_deg, ground_albedo, streams):
    """Fluxes and radiances in the order of the table's rows, and the optical depth."""
    tau, albedo, moments = slabs
    depths, cos_sun = np.cumsum(tau * tau_scale), np.cos(np.radians(zenith_deg))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # many streams, albedos near 1: what they cost is in the column `off`
        nodes, up, down, _, radiance = pydisort(
            depths, albedo, streams, moments, cos_sun, 1.0, 0.0, NLeg=streams, NFourier=streams,
            f_arr=moments[:, streams], BDRF_Fourier_modes=[ground_albedo] if ground_albedo else [])
        plain, corrected = interpolate(radiance, NT_cor="off"), interpolate(radiance, NT_cor="eval")
        values = [float(up(0.0)), float(down(depths[-1])[0])]
        for level, mu, azimuth_deg in directions(zenith_deg):
            at, azimuth = (0.0 if level == "top" else depths[-1]), np.radians(azimuth_deg)

            def once(mu):
                return scattered_once_scaled((depths, albedo, moments), streams, cos_sun, mu, azimuth)

            # Single scattering is too uneven for interpolation between the streams' directions; what is left is smooth.
            side = nodes[nodes * mu > 0]
            often = BarycentricInterpolator(side, [float(plain(m, at, azimuth)) - once(m) for m in side])
            values.append(float(often(mu)) + once(mu) + float(corrected(mu, at, azimuth) - plain(mu, at, azimuth)))
    return values, depths[-1]


def solve_fluxes(slabs, tau_scale, zenith_deg, ground_albedo, streams):
    """Fluxes up at the top and down at the bottom under a disc of a sun, and the optical depth."""
    tau, albedo, moments = slabs
    depths = np.cumsum(tau * tau_scale)
    zenith, edge = np.radians(zenith_deg), np.cos(np.radians(SUN_DIAMETER_DEG / 2))
    fluxes = np.zeros(2)
    # Uniform over the disc: even in the cosine from its centre and in the turn about it.
    for node, weight in zip(*np.polynomial.legendre.leggauss(3), strict=True):
        cos = (1 + edge) / 2 + (1 - edge) / 2 * node
        for turn in (np.arange(4) + 0.5) * np.pi / 4:
            cos_sun = np.cos(zenith) * cos + np.sin(zenith) * np.sqrt(1 - cos**2) * np.cos(turn)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                _, up, down, _ = pydisort(
                    depths, albedo, streams, moments, cos_sun, 1.0, 0.0, NLeg=streams, f_arr=moments[:, streams],
                    only_flux=True, BDRF_Fourier_modes=[ground_albedo])
            fluxes += weight / 2 / 4 * np.array([float(up(0.0)), float(sum(down(depths[-1])))])
    # Radiance 1 / (π sin² α) times the solid angle of the disc, for unit irradiance.
    return list(fluxes * 2 / (1 + edge)), depths[-1]


def table(name, fogs):
    """Text of the table of a case; `fogs` are by wavelength."""
    case = CASES[name]
    thin = name == "thin"
    fine = {nm: fog.slabs(FINE["slabs"]) for nm, fog in fogs.items()}
    coarse = {nm: fog.slabs(COARSE["slabs"]) for nm, fog in fogs.items()}
    scale = case["tau_550"] / fine[550][0].sum()
    rows = []
    for nm in WAVELENGTHS_NM:
        for zenith in SUN_ZENITH_DEG:
            how = solve if thin else solve_fluxes
            values, depth = how(fine[nm], scale, zenith, case["ground_albedo"], FINE["streams"])
            others, _ = how(coarse[nm], scale, zenith, case["ground_albedo"], COARSE["streams"])
            keys = [("top", "", ""), ("bottom", "", "")] + (directions(zenith) if thin else [])
            for (level, mu, azimuth), value, other in zip(keys, values, others, strict=True):
                off = other / value - 1
                rows.append(f"{nm},{depth:.7g},{zenith},{level},{mu},{azimuth},{value:.7g},{off:.1e}")
            print(name, nm, zenith, "done", file=sys.stderr, flush=True)
    header = {"program": "PythonicDISORT 1.8, scatrs 0.3.0", "height_m": HEIGHT_M, "density_scale": scale, **case, **FINE,
              "moments": MOMENTS}
    return "\n".join([f"# {json.dumps(header)}", "wavelength_nm,tau,sun_zenith_deg,level,mu,phi_deg,value,off", *rows, ""])


def main():
    fogs = {nm: Fog(nm) for nm in WAVELENGTHS_NM}
    for name in sys.argv[1:] or CASES:
        (ROOT / f"tests/data/fog_layers_{name}.csv").write_text(table(name, fogs))


if __name__ == "__main__":
    main()
