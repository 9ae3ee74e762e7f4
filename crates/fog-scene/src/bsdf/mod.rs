//! Scattering at one surface point: glTF's metallic-roughness material, about a mapped normal, as a transmitting sheet,
//! under a clear coat.
//!
//! Directions are in the shading frame (z = normal) and point away from the surface; light that goes through has wi.z < 0.

mod clearcoat;
mod ggx;
mod mapped_normal;
mod metallic_roughness;
mod sheet;

pub(crate) use clearcoat::COAT_F0;
pub(crate) use ggx::MIN_ALPHA;

use crate::material::SurfaceParameters;
use clearcoat::Coat;
use fog_core::Vec3A;
use fog_core::spectrum::Spectrum;
use mapped_normal::MappedNormal;
use metallic_roughness::MetallicRoughness;
use sheet::Sheet;

/// Scattering of one surface point at the wavelengths of a path.
#[derive(Clone, Copy, Debug)]
pub struct Bsdf {
    base: MetallicRoughness,
    layers: Option<Layers>,
}

/// What most materials do not have.
#[derive(Clone, Copy, Debug)]
struct Layers {
    normal: Option<MappedNormal>,
    coat: Option<Coat>,
    sheet: Option<Sheet>,
    /// Share of light that passes before the surface is met.
    clear: f32,
}

/// A direction drawn from a [`Bsdf`].
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample {
    /// Direction of the light, in the shading frame.
    pub wi: Vec3A,
    /// Density in 1/sr; infinite where the direction is the only one.
    pub pdf: f32,
    /// Value × |cos| / pdf.
    pub weight: Spectrum,
}

/// Probabilities of choosing the coat and the sheet; the base takes what they leave.
struct Shares {
    coat: f32,
    sheet: f32,
}

impl Bsdf {
    /// Evaluates the parameters at the wavelengths whose colour basis is `basis`.
    #[inline]
    #[must_use]
    pub fn new(p: &SurfaceParameters, basis: &[Spectrum; 3]) -> Self {
        let base = MetallicRoughness::new(p, basis);
        let layered = p.clearcoat > 0.0 || p.transmission > 0.0;
        let layers = layered.then(|| {
            let sheet = Sheet::new(p, basis);
            let below = base.reflectance() + sheet.as_ref().map_or(0.0, |s| s.mean_transmittance(1.0));
            Layers { normal: None, coat: Coat::new(p, below), sheet, clear: 0.0 }
        });
        Self { base, layers }
    }

    /// True if light is scattered by the cosine alone, alike in all directions: see [`Bsdf::eval`].
    #[inline]
    #[must_use]
    pub fn is_lambertian(&self) -> bool {
        self.layers.is_none() && self.base.is_lambertian()
    }

    /// The same material with a mapped normal (of unit length, in the shading frame). What goes through the surface and
    /// what its clear coat reflects does not follow the map.
    #[must_use]
    pub fn with_normal(self, normal: Vec3A) -> Self {
        let none = Layers { normal: None, coat: None, sheet: None, clear: 0.0 };
        let layers = self.layers.unwrap_or(none);
        Self { layers: Some(Layers { normal: Some(MappedNormal::new(normal)), ..layers }), ..self }
    }

    /// The same material for rays of which a share `clear` (below 1) has been let pass straight: what is left out here is
    /// divided among those that meet the surface.
    #[must_use]
    pub fn beside_clear(mut self, clear: f32) -> Self {
        if let Some(layers) = &mut self.layers {
            layers.clear = clear;
        }
        self
    }

    /// Value × |cos θi| (1/sr) and density (1/sr) for a pair of directions; zero unless `wo` is above the surface.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3A, wi: Vec3A) -> (Spectrum, f32) {
        match &self.layers {
            None => self.base.eval(wo, wi),
            Some(layers) if wo.z > 0.0 => layers.eval(&self.base, wo, wi, &layers.shares(&self.base, wo.z)),
            Some(_) => (Spectrum::ZERO, 0.0),
        }
    }

    /// Draws a direction of the light; `None` where none is scattered.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3A, pick: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        if let Some(layers) = &self.layers {
            return layers.sample(&self.base, wo, pick, u);
        }
        let wi = self.base.sample(wo, pick, u);
        if wi.z <= 0.0 {
            return None;
        }
        let (value, pdf) = self.base.eval(wo, wi);
        (pdf > 0.0).then(|| BsdfSample { wi, pdf, weight: value * (1.0 / pdf) })
    }
}

impl Layers {
    /// Share of light that passes the coat once.
    #[inline]
    fn under_coat(&self, cos: f32) -> f32 {
        self.coat.as_ref().map_or(1.0, |coat| coat.transmittance(cos))
    }

    fn shares(&self, base: &MetallicRoughness, cos: f32) -> Shares {
        let coat = self.coat.as_ref().map_or(0.0, Coat::probability);
        let through = self.sheet.as_ref().map_or(0.0, |sheet| {
            let all = sheet.mean_transmittance(cos) * self.under_coat(cos) * self.under_coat(cos);
            let rest = all - self.clear;
            if rest > 1e-6 { (rest / (rest + base.reflectance())).min(0.95) } else { 0.0 }
        });
        Shares { coat, sheet: (1.0 - coat) * through }
    }

    fn eval(&self, base: &MetallicRoughness, wo: Vec3A, wi: Vec3A, shares: &Shares) -> (Spectrum, f32) {
        let scale = self.under_coat(wo.z) * self.under_coat(wi.z.abs()) / (1.0 - self.clear);
        if wi.z < 0.0 {
            let through = self.sheet.as_ref().map(|sheet| sheet.eval(wo, wi));
            return through.map_or((Spectrum::ZERO, 0.0), |(value, pdf)| (value * scale, shares.sheet * pdf));
        }
        if wi.z == 0.0 {
            return (Spectrum::ZERO, 0.0);
        }
        let (value, pdf) = match &self.normal {
            Some(normal) => normal.eval(base, wo, wi),
            None => base.eval(wo, wi),
        };
        let below = (value * scale, (1.0 - shares.coat - shares.sheet) * pdf);
        let Some(coat) = &self.coat else { return below };
        let (value, pdf) = coat.eval(wo, wi);
        (below.0 + Spectrum::splat(value / (1.0 - self.clear)), below.1 + shares.coat * pdf)
    }

    fn sample(&self, base: &MetallicRoughness, wo: Vec3A, pick: f32, u: [f32; 2]) -> Option<BsdfSample> {
        let shares = self.shares(base, wo.z);
        let layers = shares.coat + shares.sheet;
        let (wi, side) = match (&self.coat, &self.sheet) {
            (Some(coat), _) if pick < shares.coat => (coat.sample(wo, u), 1.0),
            (_, Some(sheet)) if pick < layers && sheet.is_straight() => {
                let coat = self.under_coat(wo.z);
                let through = sheet.transmittance(wo.z) * (coat * coat);
                let rest = through.map(|t| (t - self.clear).max(0.0));
                let weight = rest * (1.0 / ((1.0 - self.clear) * shares.sheet));
                return Some(BsdfSample { wi: -wo, pdf: f32::INFINITY, weight });
            }
            (_, Some(sheet)) if pick < layers => (sheet.sample(wo, u), -1.0),
            _ => {
                // What the choice of the base leaves of the number chooses within it.
                let pick = ((pick - layers) / (1.0 - layers)).clamp(0.0, 1.0);
                let wi = match &self.normal {
                    Some(normal) => normal.sample(base, wo, pick, u),
                    None => base.sample(wo, pick, u),
                };
                (wi, 1.0)
            }
        };
        if wi.z * side <= 0.0 {
            return None;
        }
        let (value, pdf) = self.eval(base, wo, wi, &shares);
        (pdf > 0.0).then(|| BsdfSample { wi, pdf, weight: value * (1.0 / pdf) })
    }
}

/// Schlick's Fresnel reflectance between `f0` at normal and `f90` at grazing incidence.
#[inline]
pub(crate) fn schlick(f0: f32, f90: f32, cos: f32) -> f32 {
    let x = 1.0 - cos;
    let x2 = x * x;
    let w = x2 * x2 * x;
    f0 * (1.0 - w) + f90 * w
}
