//! Measured distributions of luminous intensity.
//!
//! Angles are those of photometry of type C (ANSI/IESNA LM-63-2002): the vertical angle γ is 0 along the lamp's axis, which
//! as for a spot of glTF is −Z of its node, and 180° against it; the horizontal angle C is 0 towards the node's +X, 90°
//! towards its +Y, counterclockwise for who looks along the axis.

use crate::light_tree::Reach;
use fog_core::{Vec3A, math};
use glam::DVec3;

/// Most angles of either kind.
pub const MAX_ANGLES: usize = 4096;
/// Most intensities.
pub const MAX_VALUES: usize = 1 << 20;

/// Luminous intensity by direction: linear in both angles between measurements, 0 beyond the vertical ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Photometry {
    vertical_deg: Vec<f64>,
    /// From 0 to 360, or 0 alone for a lamp that is alike all around its axis.
    horizontal_deg: Vec<f64>,
    /// Horizontal angle by horizontal angle.
    candela: Vec<f32>,
    greatest: f32,
    reach: Reach,
}

impl Photometry {
    /// Intensities in cd, all vertical angles of the first horizontal one, then of the next. Horizontal angles begin at 0 and
    /// end at 0 (alike around the axis), 90 (alike in all quadrants), 180 (alike on both sides of that plane) or in
    /// (180, 360]; or they go from 90 over 180 to 270 (alike on both sides of that plane). Planes that are not given follow by symmetry.
    ///
    /// # Errors
    /// What is wrong with the angles or intensities, to be read after what they belong to.
    pub fn new(vertical_deg: Vec<f64>, horizontal_deg: &[f64], candela: &[f32]) -> Result<Self, String> {
        check_counts(vertical_deg.len(), horizontal_deg.len())?;
        ascending("vertical", &vertical_deg, 180.0)?;
        ascending("horizontal", horizontal_deg, 360.0)?;
        let (n, planes) = (vertical_deg.len(), horizontal_deg.len());
        if candela.len() != n * planes {
            return Err(format!("{} intensities for {n} × {planes} angles", candela.len()));
        }
        if let Some(wrong) = candela.iter().find(|c| !(c.is_finite() && **c >= 0.0)) {
            return Err(format!("an intensity of {wrong} cd; valid: 0 or more, finite"));
        }
        let order = complete(horizontal_deg)?;
        let rows = order.iter().flat_map(|&(_, plane)| &candela[plane * n..(plane + 1) * n]).copied();
        let candela: Vec<f32> = rows.collect();
        let greatest = candela.iter().fold(0.0f32, |a, &b| a.max(b));
        let horizontal_deg = order.iter().map(|&(angle, _)| angle).collect();
        let lamp = Self { vertical_deg, horizontal_deg, candela, greatest, reach: Reach::ALL };
        Ok(Self { reach: lamp.find_reach(), ..lamp })
    }

    /// The same distribution with all intensities times a factor, 0 or more.
    #[must_use]
    pub fn scaled(mut self, factor: f32) -> Self {
        self.candela.iter_mut().for_each(|c| *c *= factor);
        self.greatest *= factor;
        self
    }

    /// Greatest intensity in cd.
    #[must_use]
    pub fn greatest_candela(&self) -> f32 {
        self.greatest
    }

    /// The middle of the light, a unit vector of the lamp's own axes, and a cone around it that holds all of it.
    #[must_use]
    pub fn reach(&self) -> Reach {
        self.reach
    }

    /// Intensity in cd towards a unit vector of the lamp's own axes.
    #[must_use]
    pub fn candela_along(&self, away: Vec3A) -> f32 {
        let [x, y, z] = away.as_dvec3().to_array();
        let aside = (x * x + y * y).sqrt();
        let vertical = math::f64::atan2(aside, -z).to_degrees();
        let horizontal = if aside == 0.0 { 0.0 } else { math::f64::atan2(y, x).to_degrees() };
        self.candela_at(vertical, if horizontal < 0.0 { horizontal + 360.0 } else { horizontal })
    }

    /// Intensity in cd at angles in degrees, the vertical one in [0, 180] and the horizontal one in [0, 360].
    #[must_use]
    pub fn candela_at(&self, vertical_deg: f64, horizontal_deg: f64) -> f32 {
        let (first, last) = (self.vertical_deg[0], self.vertical_deg[self.vertical_deg.len() - 1]);
        if vertical_deg < first || vertical_deg > last {
            return 0.0;
        }
        let (i, s) = place(&self.vertical_deg, vertical_deg);
        let (j, t) = place(&self.horizontal_deg, horizontal_deg);
        let n = self.vertical_deg.len();
        let plane = |j: usize| {
            let row = &self.candela[j * n..(j + 1) * n];
            let next = row[(i + 1).min(n - 1)];
            row[i] + (next - row[i]) * s
        };
        let next = plane((j + 1).min(self.horizontal_deg.len() - 1));
        plane(j) + (next - plane(j)) * t
    }

    /// Luminous flux in lm: the integral of the intensity over all directions, exact for its interpolation.
    #[must_use]
    pub fn flux_lm(&self) -> f64 {
        let n = self.vertical_deg.len();
        let around = |k: usize| -> f64 {
            let at = |j: usize| f64::from(self.candela[j * n + k]);
            match self.horizontal_deg.len() {
                1 => at(0) * core::f64::consts::TAU,
                planes => (1..planes)
                    .map(|j| {
                        let width = (self.horizontal_deg[j] - self.horizontal_deg[j - 1]).to_radians();
                        0.5 * width * (at(j - 1) + at(j))
                    })
                    .sum(),
            }
        };
        // ∫ (f₀ + (f₁ − f₀) (γ − a)/(b − a)) sin γ dγ = f₀ cos a − f₁ cos b + (f₁ − f₀) (sin b − sin a)/(b − a).
        (1..n)
            .map(|k| {
                let (a, b) = (self.vertical_deg[k - 1].to_radians(), self.vertical_deg[k].to_radians());
                let (f0, f1) = (around(k - 1), around(k));
                let slope = (f1 - f0) / (b - a);
                f0 * math::f64::cos(a) - f1 * math::f64::cos(b)
                    + slope * (math::f64::sin(b) - math::f64::sin(a))
            })
            .sum()
    }
}

impl Photometry {
    fn find_reach(&self) -> Reach {
        let Some(axis) = self.middle() else { return Reach::ALL };
        let mut angle = 0.0f64;
        for (vertical, horizontal) in self.lit_cells() {
            // Nine points of the cell, and a sixth of its diagonal for what lies between them.
            let size = [vertical, horizontal].map(|[a, b]| b - a);
            // Around its axis a lamp of one plane has nothing between them.
            let even = size[1] == 0.0;
            let across = if even { 0.0 } else { (size[0] * size[0] + size[1] * size[1]).sqrt() / 6.0 };
            for (s, t) in (0..9).map(|k| (0.5 * f64::from(k / 3), 0.5 * f64::from(k % 3))) {
                let place = direction(vertical[0] + s * size[0], horizontal[0] + t * size[1]);
                let from_axis = math::f64::acos(place.dot(axis).clamp(-1.0, 1.0)).to_degrees();
                angle = angle.max(from_axis + across);
            }
        }
        if angle >= 180.0 {
            return Reach::ALL;
        }
        Reach { axis: axis.as_vec3a(), angle: angle.to_radians() as f32 }
    }

    /// Mean direction of the light; `None` where there is none.
    fn middle(&self) -> Option<DVec3> {
        let n = self.vertical_deg.len();
        if self.horizontal_deg.len() == 1 {
            let forward = |k: usize| {
                let (sin, cos) = sin_cos(self.vertical_deg[k]);
                f64::from(self.candela[k]) * sin.max(1e-3) * cos
            };
            let sum: f64 = (0..n).map(forward).sum();
            return Some(if sum >= 0.0 { DVec3::NEG_Z } else { DVec3::Z });
        }
        let planes = self.horizontal_deg.len();
        let mut sum = DVec3::ZERO;
        for j in 0..planes {
            let width =
                self.horizontal_deg[(j + 1).min(planes - 1)] - self.horizontal_deg[j.saturating_sub(1)];
            for k in 0..n {
                let height = self.vertical_deg[(k + 1).min(n - 1)] - self.vertical_deg[k.saturating_sub(1)];
                let weight = f64::from(self.candela[j * n + k]) * width * height.max(1e-3);
                sum += direction(self.vertical_deg[k], self.horizontal_deg[j]) * weight;
            }
        }
        sum.try_normalize()
    }

    /// Vertical and horizontal ends in degrees of the cells between measurements that are not dark.
    fn lit_cells(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + '_ {
        let (n, planes) = (self.vertical_deg.len(), self.horizontal_deg.len());
        let ends = |angles: &[f64], k: usize| [angles[k], angles[(k + 1).min(angles.len() - 1)]];
        (0..planes.max(2) - 1).flat_map(move |j| {
            (0..n.max(2) - 1).filter_map(move |k| {
                let at = |j: usize, k: usize| self.candela[j.min(planes - 1) * n + k.min(n - 1)];
                let lit = at(j, k) + at(j, k + 1) + at(j + 1, k) + at(j + 1, k + 1) > 0.0;
                lit.then(|| (ends(&self.vertical_deg, k), ends(&self.horizontal_deg, j)))
            })
        })
    }
}

/// Unit vector of the lamp's own axes at angles in degrees.
fn direction(vertical_deg: f64, horizontal_deg: f64) -> DVec3 {
    let ((sv, cv), (sh, ch)) = (sin_cos(vertical_deg), sin_cos(horizontal_deg));
    DVec3::new(sv * ch, sv * sh, -cv)
}

fn sin_cos(deg: f64) -> (f64, f64) {
    let angle = deg.to_radians();
    (math::f64::sin(angle), math::f64::cos(angle))
}

/// Refuses tables that are empty or too large.
pub(crate) fn check_counts(vertical: usize, horizontal: usize) -> Result<(), String> {
    for (name, count) in [("vertical", vertical), ("horizontal", horizontal)] {
        if !(1..=MAX_ANGLES).contains(&count) {
            return Err(format!("{count} {name} angles; valid: 1 to {MAX_ANGLES}"));
        }
    }
    if vertical * horizontal > MAX_VALUES {
        return Err(format!("{vertical} × {horizontal} intensities; valid: {MAX_VALUES} at most"));
    }
    Ok(())
}

fn ascending(name: &str, angles: &[f64], most: f64) -> Result<(), String> {
    if let Some(wrong) = angles.iter().find(|a| !(0.0..=most).contains(*a)) {
        return Err(format!("a {name} angle of {wrong}°; valid: 0 to {most}"));
    }
    match angles.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => Err(format!("{name} angles do not ascend: {}° is followed by {}°", pair[0], pair[1])),
        None => Ok(()),
    }
}

/// Planes of the whole circle: their angles from 0 to 360, and which of the given ones each equals.
fn complete(given: &[f64]) -> Result<Vec<(f64, usize)>, String> {
    let (first, last) = (given[0], given[given.len() - 1]);
    let forth = || given.iter().copied().zip(0..);
    // Planes mirrored at an angle, which is itself not repeated.
    let mirrored = |planes: &[(f64, usize)], at: f64| -> Vec<(f64, usize)> {
        let back = planes.iter().rev().filter(|(a, _)| *a < at).map(|&(a, k)| (2.0 * at - a, k));
        planes.iter().copied().chain(back).collect()
    };
    let all: Vec<(f64, usize)> = forth().collect();
    if first == 0.0 && last == 0.0 {
        Ok(all)
    } else if first == 0.0 && last == 90.0 {
        Ok(mirrored(&mirrored(&all, 90.0), 180.0))
    } else if first == 0.0 && last == 180.0 {
        Ok(mirrored(&all, 180.0))
    } else if first == 0.0 && last > 180.0 {
        let close = (last < 360.0).then_some((360.0, 0));
        Ok(all.into_iter().chain(close).collect())
    } else if first == 90.0 && last == 270.0 && given.contains(&180.0) {
        let before = all.iter().rev().filter(|(a, _)| *a <= 180.0).map(|&(a, k)| (180.0 - a, k));
        let after = all.iter().rev().filter(|(a, _)| *a >= 180.0).map(|&(a, k)| (540.0 - a, k));
        let mut planes: Vec<(f64, usize)> = before.chain(all.iter().copied()).chain(after).collect();
        planes.dedup_by_key(|(angle, _)| *angle);
        Ok(planes)
    } else {
        Err(format!(
            "horizontal angles from {first}° to {last}°; valid: 0 alone, 0 to 90, 0 to 180, 0 to more than 180, or 90 to 270 with 180"
        ))
    }
}

/// Interval of ascending `angles` that holds `x`, and where in it: 0 to 1.
fn place(angles: &[f64], x: f64) -> (usize, f32) {
    if angles.len() < 2 {
        return (0, 0.0);
    }
    let i = angles.partition_point(|&a| a <= x).clamp(1, angles.len() - 1) - 1;
    (i, ((x - angles[i]) / (angles[i + 1] - angles[i])).clamp(0.0, 1.0) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    fn steps(last: u32, step: u32) -> Vec<f64> {
        (0..=last / step).map(|i| f64::from(i * step)).collect()
    }

    #[test]
    fn flux_is_that_of_closed_forms() {
        // I = cosⁿ θ: 2π/(n + 1) lm.
        for n in [0, 1, 4] {
            let vertical: Vec<f64> = (0..=900).map(|i| 0.1 * f64::from(i)).collect();
            let candela: Vec<f32> =
                vertical.iter().map(|a| math::f64::cos(a.to_radians()).max(0.0).powi(n) as f32).collect();
            let lamp = Photometry::new(vertical, &[0.0], &candela).unwrap();
            let want = 2.0 * PI / (f64::from(n) + 1.0);
            assert!((lamp.flux_lm() / want - 1.0).abs() < 1e-5, "{n}: {} for {want}", lamp.flux_lm());
        }
        let even = Photometry::new(vec![0.0, 180.0], &[0.0, 90.0, 270.0], &[2.0; 6]).unwrap();
        assert!((even.flux_lm() - 8.0 * PI).abs() < 1e-9);
        assert!((even.scaled(0.5).flux_lm() - 4.0 * PI).abs() < 1e-6);
    }

    #[test]
    fn planes_are_completed_by_symmetry() {
        let lamp =
            |horizontal: &[f64], candela: &[f32]| Photometry::new(vec![90.0], horizontal, candela).unwrap();
        let at = |lamp: &Photometry, angles: [f64; 4]| angles.map(|a| lamp.candela_at(90.0, a));
        let quadrant = lamp(&[0.0, 45.0, 90.0], &[1.0, 5.0, 3.0]);
        assert_eq!(at(&quadrant, [45.0, 135.0, 225.0, 315.0]), [5.0; 4]);
        assert_eq!(at(&quadrant, [0.0, 90.0, 180.0, 270.0]), [1.0, 3.0, 1.0, 3.0]);
        let sides = lamp(&[0.0, 90.0, 180.0], &[1.0, 5.0, 3.0]);
        assert_eq!(at(&sides, [0.0, 90.0, 180.0, 270.0]), [1.0, 5.0, 3.0, 5.0]);
        assert_eq!(at(&sides, [45.0, 315.0, 225.0, 360.0]), [3.0, 3.0, 4.0, 1.0]);
        let other = lamp(&[90.0, 180.0, 270.0], &[1.0, 5.0, 3.0]);
        assert_eq!(at(&other, [0.0, 90.0, 180.0, 270.0]), [5.0, 1.0, 5.0, 3.0]);
        let open = lamp(&[0.0, 100.0, 200.0, 300.0], &[1.0, 2.0, 3.0, 5.0]);
        assert_eq!(at(&open, [50.0, 250.0, 330.0, 360.0]), [1.5, 4.0, 3.0, 1.0]);
        for wrong in [&[10.0][..], &[0.0, 45.0], &[90.0, 270.0], &[0.0, 90.0, 90.0], &[0.0, 361.0]] {
            let n = wrong.len();
            assert!(Photometry::new(vec![0.0], wrong, &vec![1.0; n]).is_err(), "{wrong:?}");
        }
    }

    #[test]
    fn directions_have_the_angles_of_the_convention() {
        // A beam along +X of the lamp, to the right of its axis; and nothing behind 120°.
        let beam = Photometry::new(steps(120, 30), &[0.0, 90.0, 180.0, 270.0], &{
            let mut candela = vec![0.0; 20];
            candela[3] = 7.0;
            candela
        })
        .unwrap();
        assert_eq!(beam.greatest_candela(), 7.0);
        let reach = beam.reach();
        assert!(reach.axis.x > 0.9 && reach.angle > 90.0f32.to_radians(), "{reach:?}");
        assert!((beam.candela_along(Vec3A::X) - 7.0).abs() < 1e-4);
        for dark in [Vec3A::Y, Vec3A::NEG_X, Vec3A::NEG_Z, Vec3A::Z] {
            assert!(beam.candela_along(dark) < 1e-4, "{dark}");
        }
        // 15° on: half; 45° around: half.
        let sin_cos =
            |deg: f64| (math::f64::sin(deg.to_radians()) as f32, math::f64::cos(deg.to_radians()) as f32);
        let (s, c) = sin_cos(15.0);
        assert!((beam.candela_along(Vec3A::new(c, 0.0, s)) - 3.5).abs() < 1e-3);
        let (s, c) = sin_cos(45.0);
        assert!((beam.candela_along(Vec3A::new(c, s, 0.0)) - 3.5).abs() < 1e-3);
    }

    #[test]
    fn the_reach_holds_all_light() {
        let narrow = Photometry::new(
            steps(180, 2),
            &[0.0, 5.0, 10.0, 180.0],
            &(0..4 * 91)
                .map(|i| if (45..=48).contains(&(i % 91)) && i / 91 < 2 { 9.0 } else { 0.0 })
                .collect::<Vec<_>>(),
        )
        .unwrap();
        // 10° aside, from 88 to 98°: level and forward along +X.
        let reach = narrow.reach();
        assert!(reach.axis.x > 0.99 && reach.angle < 16.0f32.to_radians(), "{reach:?}");
        let mut rng = fog_core::random::PathRng::new(1, 2, 3);
        for _ in 0..20_000 {
            let away = fog_core::warp::uniform_sphere(rng.uniform2());
            let inside = away.dot(reach.axis) >= math::f32::cos(reach.angle);
            assert!(inside || narrow.candela_along(away) == 0.0, "{away}");
        }
        let down = Photometry::new(vec![0.0, 60.0, 61.0, 180.0], &[0.0], &[5.0, 5.0, 0.0, 0.0]).unwrap();
        assert_eq!(down.reach().axis, Vec3A::NEG_Z);
        assert!((60.9..62.0).contains(&down.reach().angle.to_degrees()));
    }

    #[test]
    fn tables_without_sense_are_refused() {
        assert!(Photometry::new(vec![], &[0.0], &[]).is_err());
        assert!(Photometry::new(vec![0.0, 90.0], &[0.0], &[1.0]).is_err());
        assert!(Photometry::new(vec![0.0, f64::NAN], &[0.0], &[1.0; 2]).is_err());
        assert!(Photometry::new(vec![0.0], &[0.0], &[f32::NAN]).is_err());
        assert!(Photometry::new(vec![0.0], &[0.0], &[-1.0]).is_err());
        assert!(check_counts(2000, 2000).is_err());
    }
}
