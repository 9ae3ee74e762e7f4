//! A replayed path as JSON.

use super::Replayed;
use fog_core::Vec3A;
use fog_core::spectrum::Spectrum;
use fog_tracer::watch::{FlightEnd, Step, Visibility, Weights};
use serde_json::{Value, json};

impl Replayed {
    /// Every number of the path. Spectra are arrays over `wavelengths_nm`; infinite lengths are null.
    #[must_use]
    pub fn json(&self) -> Value {
        let path = &self.path;
        json!({
            "frame": self.spec.id,
            "seed": self.spec.seed,
            "pixel": self.pixel,
            "sample": self.number,
            "image_point_px": path.image_point,
            "camera_ray": { "origin_m": vector(path.ray.origin), "direction": vector(path.ray.direction) },
            "wavelengths_nm": path.wavelengths.nm,
            "steps": path.steps.iter().map(|step| self.step_json(step)).collect::<Vec<_>>(),
            "radiance": path.radiance.0,
            "response": path.response,
            "value": self.channels(&path.sample.value()),
            "direct": self.channels(&path.sample.direct),
            "airlight": self.channels(&path.sample.airlight),
            "lamps_in_pixel": self.channels(&path.lamps),
        })
    }

    fn step_json(&self, step: &Step) -> Value {
        match step {
            Step::Flight { origin, direction, length_m, drawn_tau, tau, end } => json!({
                "step": "flight",
                "origin_m": vector(*origin),
                "direction": vector(*direction),
                "length_m": length_m,
                "drawn_optical_depth": drawn_tau,
                "optical_depth": tau.0,
                "end": match end {
                    FlightEnd::Fog => "fog",
                    FlightEnd::Surface => "surface",
                    FlightEnd::Nowhere => "nowhere",
                },
            }),
            Step::Collision { position, sigma_t, albedo, row, probability_ratio, weights } => json!({
                "step": "collision",
                "position_m": vector(*position),
                "altitude_m": self.altitude_m(f64::from(position.y)),
                "sigma_t_1_m": sigma_t.0,
                "albedo": albedo.0,
                "phase_row": row,
                "probability_ratio": probability_ratio.0,
                "weights": weights_json(weights),
            }),
            Step::Surface {
                position,
                normal,
                shading_normal,
                triangle,
                material,
                object,
                emission,
                added,
                ..
            } => {
                json!({
                    "step": "surface",
                    "position_m": vector(*position),
                    "normal": vector(*normal),
                    "shading_normal": vector(*shading_normal),
                    "triangle": triangle,
                    "material": self.material(*material),
                    "node": self.object(*object),
                    "emission": emission.0,
                    "added": added.0,
                })
            }
            Step::NearLamp { position, distance_m } => json!({
                "step": "near_lamp",
                "position_m": vector(*position),
                "distance_m": distance_m,
            }),
            Step::Connection { .. } => self.connection_json(step),
            Step::Turn { direction, cosine, depth, weights } => json!({
                "step": "turn",
                "direction": vector(*direction),
                "cosine": cosine,
                "depth": depth,
                "weights": weights_json(weights),
            }),
            Step::Branch { branch, of } => json!({ "step": "branch", "branch": branch, "of": of }),
            Step::Escape { added } => json!({ "step": "escape", "added": added.0 }),
            Step::Layer { added } => json!({ "step": "layer_light", "added": added.0 }),
            Step::Absorbed => json!({ "step": "absorbed" }),
            Step::TooLong => json!({ "step": "max_depth" }),
            Step::Roulette { survival, survived } => {
                json!({ "step": "roulette", "survival": survival, "survived": survived })
            }
        }
    }

    fn connection_json(&self, step: &Step) -> Value {
        let &Step::Connection {
            direction,
            distance_m,
            radiance,
            density,
            beam,
            value,
            transmittance,
            worth,
            kept,
            visibility,
            added,
        } = step
        else {
            return Value::Null;
        };
        let numbers = |spectrum: Spectrum| json!(spectrum.0);
        json!({
            "step": "connection",
            "direction": vector(direction),
            "distance_m": distance_m,
            "light": numbers(radiance),
            "density": density,
            "without_extent": beam,
            "scattering": numbers(value),
            "transmittance": numbers(transmittance),
            "worth": numbers(worth),
            "kept_with_probability": kept,
            "outcome": match visibility {
                Visibility::Dark => "dark",
                Visibility::Dropped => "dropped",
                Visibility::Blocked => "blocked",
                Visibility::Free => "free",
            },
            "added": numbers(added),
        })
    }
}

fn weights_json(weights: &Weights) -> Value {
    json!({ "beta": weights.beta.0, "r_u": weights.r_u.0, "r_l": weights.r_l.0 })
}

fn vector(v: Vec3A) -> [f32; 3] {
    v.to_array()
}
