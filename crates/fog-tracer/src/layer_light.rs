//! The light that an even layer of fog would have by itself: a solution of its transport in closed form.
//!
//! In fog that does not absorb, radiance V = A + B (q + μ) solves the equation of transfer exactly, whatever the phase
//! function: q is the optical depth over the layer's base times 1 − g, g the mean cosine of a scattering, and μ the upward
//! component of the direction that one looks along (the asymptotic solution of Milne's problem; Chandrasekhar, Radiative
//! Transfer, 1950, §§ 10 and 48). A and B say how bright the sky is and how much of it comes back from below.
//!
//! A path need then only find how the scene's light differs from V. The difference has no sources in the fog: it begins at
//! surfaces, by what they send back minus what V has there, and at the sky. Whatever A and B are, the mean is the same, for
//! V at a vertex is the mean of V at the next one. It is a control variate whose integral is known, as in Rousselle,
//! Jarosz & Novák, "Image-space control variates for rendering", ACM TOG 35(6), 2016, but for every vertex of the path.

use crate::path::{Path, scatter_at_surface};
use fog_core::colour::Observer;
use fog_core::random::PathRng;
use fog_core::spectrum::{LANES, LaneWeights, Spectrum, Wavelengths};
use fog_core::{Vec3A, math};
use fog_scene::medium::MediumView;
use fog_scene::scene::Scene;

/// Cells of even height.
const CELLS: usize = 1024;
/// Distance over which radiance would extrapolate to its value beyond a boundary, in transport mean free paths (the Milne
/// problem's 0.7104, Chandrasekhar 1950, table for isotropic scattering).
const EXTRAPOLATION: f64 = 0.7104;
/// Least worth of a place, so that no path's weight grows without bound.
const LEAST_WORTH: f32 = 0.02;
/// Least single-scattering albedo of fog whose light the solution is near enough to.
const LEAST_ALBEDO: f64 = 0.9;
/// Paths that measure how much of the light the scene returns.
const PROBES: u64 = 64;
/// Turns of such a path at most.
const PROBE_TURNS: u32 = 16;

/// The solution's tables for one scene.
#[derive(Debug)]
pub(crate) struct LayerLight {
    base_y: f64,
    cells_per_m: f64,
    /// Wavelengths between which extinction and mean cosine are linear in the wavelength, in nm.
    nm: Vec<f64>,
    /// q at the edges of the cells, \[edge\]\[wavelength, and the middle between it and the next\].
    q: Vec<f32>,
    /// Mean radiance of the sky.
    sky: f64,
    /// Share of the light that the scene returns to the fog.
    returned: f64,
    /// True if all that V leaves to find begins at surfaces or at lamps among them.
    lit_from_below: bool,
}

/// A path's wavelengths in the tables, and its constants.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LayerLanes {
    /// First of the three columns that q is quadratic over.
    column: [u32; LANES],
    weight: [Spectrum; 3],
    a: Spectrum,
    b: Spectrum,
}

impl LayerLight {
    /// The solution of a scene under its sky, or in the dark; `None` where the fog is not one that it solves.
    pub(crate) fn new(scene: &Scene, medium: &MediumView<'_>, observer: &Observer) -> Option<Self> {
        let sky =
            scene.environment.map_or(0.0, |e| e.radiance) + scene.sky.as_ref().map_or(0.0, |s| s.mean());
        let profile = medium.profile;
        if medium.patchy.is_some() || profile.least_albedo() < LEAST_ALBEDO {
            return None;
        }
        let cosines = medium.phase.mean_cosines()?;
        let mut nm = [profile.wavelengths_nm(), cosines.wavelengths_nm()].concat();
        nm.sort_by(f64::total_cmp);
        nm.dedup();
        // A product of two linear functions of the wavelength is known by its values at both ends and in the middle.
        let mut columns = vec![nm[0]];
        columns.extend(nm.windows(2).flat_map(|pair| [0.5 * (pair[0] + pair[1]), pair[1]]));
        let (base_y, height) = (profile.base_y(), profile.top_y() - profile.base_y());
        let edge = |i: usize| base_y + height * i as f64 / CELLS as f64;
        let mut q = vec![0.0f32; (CELLS + 1) * columns.len()];
        for (column, &nm) in columns.iter().enumerate() {
            let mut sum = 0.0;
            for i in 0..CELLS {
                let depth = profile.optical_depth_at(edge(i), 1.0, edge(i + 1) - edge(i), nm);
                let zeta = profile.zeta(0.5 * (edge(i) + edge(i + 1)));
                sum += depth * (1.0 - cosines.at(f64::from(zeta), nm));
                q[(i + 1) * columns.len() + column] = sum as f32;
            }
        }
        let returned = returned_share(scene, observer);
        let lit_from_below = scene.sun.is_none() && scene.sky.is_none() && scene.beams().is_empty();
        let (sky, cells_per_m) = (f64::from(sky), CELLS as f64 / height);
        Some(Self { base_y, cells_per_m, nm, q, sky, returned, lit_from_below })
    }

    /// Finds a path's wavelengths.
    pub(crate) fn lanes(&self, wavelengths: &Wavelengths) -> LayerLanes {
        let at = LaneWeights::new(&self.nm, wavelengths);
        let t = Spectrum(at.weight);
        let mut lanes = LayerLanes {
            column: at.index.map(|i| 2 * i),
            weight: [
                t.map(|t| (1.0 - t) * (1.0 - 2.0 * t)),
                t.map(|t| 4.0 * t * (1.0 - t)),
                t.map(|t| t * (2.0 * t - 1.0)),
            ],
            a: Spectrum::ZERO,
            b: Spectrum::ZERO,
        };
        // The sky's radiance at the top, the returned share of what goes down at the base: in the mean over directions.
        let (e, back) = (EXTRAPOLATION, self.returned);
        let ratio = (1.0 - back) / (e + back * 2.0 / 3.0);
        lanes.a =
            self.q(f64::INFINITY, &lanes).map(|q| (self.sky / (1.0 + ratio * (f64::from(q) + e))) as f32);
        lanes.b = lanes.a * ratio as f32;
        lanes
    }

    /// q of all lanes at world y; constant beyond the layer.
    #[inline]
    fn q(&self, y: f64, lanes: &LayerLanes) -> Spectrum {
        let columns = 2 * self.nm.len() - 1;
        let x = ((y - self.base_y) * self.cells_per_m).clamp(0.0, CELLS as f64);
        let cell = (x as usize).min(CELLS - 1);
        let t = (x - cell as f64) as f32;
        let (low, high) = self.q[cell * columns..(cell + 2) * columns].split_at(columns);
        let mut out = Spectrum::ZERO;
        for lane in 0..LANES {
            for (k, weight) in lanes.weight.iter().enumerate() {
                let i = (lanes.column[lane] as usize + k).min(columns - 1);
                out[lane] += weight[lane] * (low[i] + (high[i] - low[i]) * t);
            }
        }
        out
    }

    /// True if the sky shines: otherwise V is 0.
    #[inline]
    pub(crate) fn shines(&self) -> bool {
        self.sky > 0.0
    }

    /// Light that a path there may still find of what begins at the base, over that at the base: falls linearly in q to
    /// what is left at the top. `None` where light also comes from above. For choices that must not depend on the path's
    /// wavelengths.
    #[inline]
    pub(crate) fn worth(&self, y: f64, up: f32) -> Option<f32> {
        if !self.lit_from_below {
            return None;
        }
        let columns = 2 * self.nm.len() - 1;
        let x = ((y - self.base_y) * self.cells_per_m).clamp(0.0, CELLS as f64 - 1.0);
        let middle = columns / 2;
        let (q, total) = (self.q[x as usize * columns + middle], self.q[CELLS * columns + middle]);
        let e = EXTRAPOLATION as f32;
        Some(((total - q + e - up) / (total + e)).max(LEAST_WORTH))
    }

    /// V seen from world y (infinite: from beyond the layer) along a direction whose upward component is `up`.
    #[inline]
    pub(crate) fn radiance(&self, y: f64, up: f32, lanes: &LayerLanes) -> Spectrum {
        lanes.a + lanes.b * (self.q(y, lanes) + Spectrum::splat(up))
    }
}

/// Share of the light from above that comes back from the scene's surfaces, without fog: all of it where there are none, for
/// below is the sky as well.
fn returned_share(scene: &Scene, observer: &Observer) -> f64 {
    let Some([low, high]) = scene.loaded().geometry.bounds() else { return 1.0 };
    let basis = observer.lane_basis(&Wavelengths::monochromatic(550.0));
    let mut sum = 0.0;
    for probe in 0..PROBES {
        let mut rng = PathRng::new(0, probe, 0);
        let [u, v] = rng.uniform2();
        let start = Vec3A::new(low.x + u * (high.x - low.x), high.y + 1.0, low.z + v * (high.z - low.z));
        let [u, turn] = rng.uniform2();
        let (sin, cos) = (u.sqrt(), (1.0 - u).sqrt());
        let (sin_phi, cos_phi) = math::sin_cos_turns(turn);
        let mut path = Path::new(start, Vec3A::new(sin * cos_phi, -cos.max(1e-3), sin * sin_phi));
        for _ in 0..PROBE_TURNS {
            let Some(hit) = scene.scatterer(path.origin, path.direction, f32::INFINITY, rng.next_u64())
            else {
                sum += f64::from(path.beta[0]);
                break;
            };
            let surface = scene.surface(&hit, path.direction, &basis);
            if !scatter_at_surface(&mut path, &surface, &mut rng) {
                break;
            }
        }
    }
    (sum / PROBES as f64).clamp(0.0, 1.0)
}
