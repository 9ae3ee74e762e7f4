//! A replayed path in words.

use super::Replayed;
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, math};
use fog_tracer::watch::{FlightEnd, Step, Visibility, Weights};
use std::fmt::{self, Display, Formatter};

impl Display for Replayed {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (path, [x, y]) = (&self.path, self.pixel);
        writeln!(f, "frame {}, pixel {x},{y}, sample {}", self.spec.id, self.number)?;
        let [px, py] = path.image_point;
        writeln!(f, "camera ray through image point ({px:.4}, {py:.4}) px")?;
        writeln!(f, "  from {} m along {}", at(path.ray.origin), along(path.ray.direction))?;
        let nm = path.wavelengths.nm;
        if path.response.is_some() {
            let others: Vec<String> = nm[1..].iter().map(|nm| format!("{nm:.1}")).collect();
            writeln!(f, "wavelengths: hero {:.1} nm, with it {} nm", nm[0], others.join(", "))?;
        } else {
            writeln!(f, "wavelength: {} nm", nm[0])?;
        }
        writeln!(f, "numbers with `hero` are at that wavelength, values are as the picture has them\n")?;
        for (i, step) in path.steps.iter().enumerate() {
            write!(f, "{:>3}. ", i + 1)?;
            self.step(f, step)?;
            // A connection to a light comes between an event and the turn that it ends with.
            let turned = matches!(path.steps.get(i + 1), Some(Step::Turn { .. } | Step::Absorbed));
            if turned && matches!(step, Step::Collision { .. } | Step::Surface { .. }) {
                writeln!(f, "     no connection to a light: none was picked, or none can shine here")?;
            }
        }
        let steps = path.steps.iter().filter(|s| s.added().is_some_and(|a| !a.is_zero())).count();
        let sample = &path.sample;
        let [all, direct, airlight] =
            [&sample.value(), &sample.direct, &sample.airlight].map(|v| list(self.channels(v)));
        writeln!(f, "\nsum of {steps} contribution{}", if steps == 1 { "" } else { "s" })?;
        writeln!(f, "to the film: {all}; of it came straight {direct}, from the fog {airlight}")?;
        if path.lamps != [0.0; 3] {
            let lamps = list(self.channels(&path.lamps));
            writeln!(
                f,
                "lamps that stand in the pixel add {lamps}, which no path finds, to the mean of its paths"
            )?;
        }
        Ok(())
    }
}

impl Replayed {
    fn step(&self, f: &mut Formatter<'_>, step: &Step) -> fmt::Result {
        match step {
            Step::Flight { origin, direction, length_m, drawn_tau, tau, end } => {
                let from = self.altitude_m(f64::from(origin.y));
                let end = match end {
                    FlightEnd::Fog => "meets a droplet",
                    FlightEnd::Surface => "meets a surface",
                    FlightEnd::Nowhere => "leaves the scene",
                };
                if length_m.is_finite() {
                    let to = from + length_m * f64::from(direction.y);
                    writeln!(f, "flies {length_m:.4} m, altitude {from:.3} to {to:.3} m, and {end}")?;
                } else {
                    writeln!(f, "flies from altitude {from:.3} m along {} and {end}", along(*direction))?;
                }
                writeln!(f, "     optical depth at the hero {:.5}, of {drawn_tau:.5} drawn", tau[0])
            }
            Step::Collision { position, sigma_t, albedo, row, weights, .. } => {
                let altitude = self.altitude_m(f64::from(position.y));
                writeln!(f, "collision at {} m, altitude {altitude:.3} m", at(*position))?;
                writeln!(
                    f,
                    "     hero: sigma_t {:.6} 1/m, albedo {:.6}; row {row} of the phase functions",
                    sigma_t[0], albedo[0]
                )?;
                throughput(f, weights)
            }
            Step::Surface {
                position, normal, material, object, triangle, scatters, emission, added, ..
            } => {
                writeln!(
                    f,
                    "surface of `{}`, material `{}`, triangle {triangle}",
                    self.object(*object),
                    self.material(*material)
                )?;
                writeln!(f, "     at {} m, normal {}", at(*position), along(*normal))?;
                if !scatters {
                    writeln!(f, "     its back, which is black: the path ends")?;
                }
                if emission.is_zero() { Ok(()) } else { self.adds(f, "emits", added) }
            }
            Step::Escape { added } => {
                if added.is_zero() {
                    return writeln!(f, "no light out there");
                }
                writeln!(f, "the sky")?;
                self.adds(f, "shines", added)
            }
            Step::NearLamp { position, distance_m } => {
                writeln!(
                    f,
                    "a point of the flight near a lamp, after {distance_m:.3} m, at {} m",
                    at(*position)
                )
            }
            Step::Connection { .. } => self.connection(f, step),
            Step::Turn { direction, cosine, depth, weights } => {
                let angle = math::f64::acos(f64::from(cosine.clamp(-1.0, 1.0))).to_degrees();
                writeln!(f, "scattering {depth} turns the path by {angle:.3}° to {}", along(*direction))?;
                throughput(f, weights)
            }
            Step::Branch { branch, of } => {
                writeln!(f, "back to the first droplet, from where {of} paths go on: number {}", branch + 1)
            }
            Step::Layer { added } => {
                writeln!(
                    f,
                    "expects from here what the layer of fog alone would show, no longer what it expected"
                )?;
                self.adds(f, "that changes the sum", added)
            }
            Step::Absorbed => writeln!(f, "absorbed by the surface: the path ends"),
            Step::TooLong => writeln!(f, "as many edges as render.max_depth allows: the path ends"),
            Step::Roulette { survival, survived } => {
                let outcome = if *survived { "goes on, and weighs that much more" } else { "ends" };
                writeln!(f, "Russian roulette, survival {survival:.4}: the path {outcome}")
            }
        }
    }

    fn connection(&self, f: &mut Formatter<'_>, step: &Step) -> fmt::Result {
        let Step::Connection {
            direction,
            distance_m,
            density,
            beam,
            value,
            transmittance,
            kept,
            visibility,
            added,
            ..
        } = step
        else {
            return Ok(());
        };
        if *beam && distance_m.is_finite() {
            writeln!(f, "looks for light of a lamp {distance_m:.3} m away, towards {}", along(*direction))?;
        } else if *beam {
            writeln!(f, "looks for light of a parallel beam, towards {}", along(*direction))?;
        } else if distance_m.is_infinite() {
            writeln!(
                f,
                "looks for light of sun or sky, towards {}, density {density:.4e} 1/sr",
                along(*direction)
            )?;
        } else {
            let direction = along(*direction);
            writeln!(
                f,
                "looks for light {distance_m:.3} m away, towards {direction}, density {density:.4e} 1/sr"
            )?;
        }
        writeln!(
            f,
            "     hero: scattering towards it {:.5e}, transmittance of the fog {:.5}",
            value[0], transmittance[0]
        )?;
        if *kept < 1.0 {
            writeln!(f, "     so little that it is looked at with probability {kept:.4} only")?;
        }
        match visibility {
            Visibility::Dark => writeln!(f, "     none would come from there"),
            Visibility::Dropped => writeln!(f, "     and that was lost: nothing added"),
            Visibility::Blocked => writeln!(f, "     a surface is in between: nothing added"),
            Visibility::Free => self.adds(f, "nothing is in between: it", added),
        }
    }

    fn adds(&self, f: &mut Formatter<'_>, what: &str, added: &Spectrum) -> fmt::Result {
        writeln!(f, "     {what} and adds {}", list(&self.value(added)))
    }
}

/// Throughput of a path for light met by chance: the least and the greatest over its wavelengths.
fn throughput(f: &mut Formatter<'_>, weights: &Weights) -> fmt::Result {
    let all = weights.beta * (1.0 / weights.r_u.mean());
    let (least, most) = all.0.iter().fold((f32::INFINITY, 0.0f32), |(a, b), &v| (a.min(v), b.max(v)));
    writeln!(f, "     throughput {:.5} at the hero, {least:.5} to {most:.5} over the wavelengths", all[0])
}

fn list(values: &[f32]) -> String {
    let values: Vec<String> = values.iter().map(|v| format!("{v:.6}")).collect();
    format!("({})", values.join(", "))
}

fn at(v: Vec3A) -> String {
    format!("({:.3}, {:.3}, {:.3})", v.x, v.y, v.z)
}

fn along(v: Vec3A) -> String {
    format!("({:.5}, {:.5}, {:.5})", v.x, v.y, v.z)
}
