//! Bodies of cars: a skin over cross-sections from the nose to the tail.
//!
//! `s` is the distance from the nose. A section is half of a closed line from the sill over belt and glass to the middle of
//! the roof; its shape follows from four lines along the car: bottom, belt, top and half-width.

use crate::mesh::{Mat, Mesh, Model};
use crate::shapes::{Grid, block};
use fog_core::{Vec2, Vec3};

/// Shape of a car's body; lengths in metres, places as distances from the nose.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) length: f32,
    pub(crate) width: f32,
    /// Top of the middle: distance and height.
    pub(crate) top: &'static [[f32; 2]],
    /// Upper edge of the doors.
    pub(crate) belt: &'static [[f32; 2]],
    /// Height of the floor's edge.
    pub(crate) sill: f32,
    pub(crate) axles: [f32; 2],
    pub(crate) wheel_radius: f32,
    pub(crate) windscreen: [f32; 2],
    pub(crate) rear_window: [f32; 2],
    /// Side windows, front to rear.
    pub(crate) windows: &'static [[f32; 2]],
    /// Gaps of the doors.
    pub(crate) gaps: &'static [f32],
    /// Half-width of the roof's edge by the half-width of the body.
    pub(crate) roof: f32,
    /// Fullness of nose and tail in plan, half-width there by the full one.
    pub(crate) nose: f32,
    pub(crate) tail: f32,
}

/// Materials of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Skin {
    pub(crate) paint: Mat,
    pub(crate) glass: Mat,
    pub(crate) trim: Mat,
}

/// Points of a half section.
const POINTS: usize = 12;
/// Arch around a wheel, wider than the tyre by this.
const ARCH: f32 = 0.065;

/// Value at `s` of a smooth line through points of rising `s` (Hermite with mean slopes).
pub(crate) fn along(line: &[[f32; 2]], s: f32) -> f32 {
    let n = line.len();
    let i = line.iter().take_while(|p| p[0] <= s).count().clamp(1, n - 1);
    let slope = |k: usize| {
        let (a, b) = (line[k.saturating_sub(1)], line[(k + 1).min(n - 1)]);
        (b[1] - a[1]) / (b[0] - a[0])
    };
    let (a, b) = (line[i - 1], line[i]);
    let d = b[0] - a[0];
    let t = ((s - a[0]) / d).clamp(0.0, 1.0);
    let (t2, t3) = (t * t, t * t * t);
    let ends = a[1] * (2.0 * t3 - 3.0 * t2 + 1.0) + b[1] * (3.0 * t2 - 2.0 * t3);
    ends + d * (slope(i - 1) * (t3 - 2.0 * t2 + t) + slope(i) * (t3 - t2))
}

impl Body {
    /// Half-width at `s`.
    fn half_width(&self, s: f32) -> f32 {
        let rounded = |from: f32, reach: f32, end: f32| {
            let t = (1.0 - from / reach).clamp(0.0, 1.0);
            end + (1.0 - end) * (1.0 - t * t).sqrt()
        };
        0.5 * self.width * rounded(s, 0.8, self.nose) * rounded(self.length - s, 0.6, self.tail)
    }

    /// Height of the lower edge: the sill, or the arch of a wheel.
    fn bottom(&self, s: f32) -> f32 {
        let r = self.wheel_radius + ARCH;
        let arch = |axle: f32| {
            let d = s - axle;
            if d.abs() < r { self.wheel_radius + (r * r - d * d).sqrt() } else { 0.0 }
        };
        self.sill.max(arch(self.axles[0])).max(arch(self.axles[1]))
    }

    /// Half section at `s`, from the sill to the middle of the top; x is positive.
    fn section(&self, s: f32) -> [Vec3; POINTS] {
        let (w, bottom) = (self.half_width(s), self.bottom(s));
        let (belt, top) = (along(self.belt, s), along(self.top, s));
        let h = belt - bottom;
        let g = (top - belt).max(0.01);
        let t = (g / 0.42).clamp(0.0, 1.0);
        let (shoulder, rail) = (0.95 * w, w * (0.87 + (self.roof - 0.87) * t));
        let side = |u: f32| [shoulder + (rail - shoulder) * u, belt + 0.86 * g * u];
        let points = [
            [0.92 * w, bottom],
            [0.975 * w, bottom + 0.10 * h],
            [w, bottom + 0.45 * h],
            [0.995 * w, bottom + 0.72 * h],
            [0.975 * w, bottom + 0.93 * h],
            [shoulder, belt],
            side(0.07),
            side(0.90),
            side(1.0),
            [rail - 0.09 * w, belt + 0.95 * g],
            [0.5 * rail, belt + 0.988 * g],
            [0.0, top],
        ];
        // Nose and tail are rounded: their outermost sections are lower.
        let end = s.min(self.length - s);
        let u = (1.0 - end / 0.16).clamp(0.0, 1.0);
        let squeeze = 0.62 + 0.38 * (1.0 - u * u).sqrt();
        let middle = 0.5 * (self.sill + belt);
        points.map(|[x, y]| Vec3::new(x, middle + (y - middle) * squeeze, s - 0.5 * self.length))
    }

    /// Places of the sections: close where something begins or bends.
    fn stations(&self) -> Vec<f32> {
        let mut all: Vec<f32> = (0..=(self.length / 0.14) as usize).map(|i| 0.14 * i as f32).collect();
        for end in [0.0, 0.006, 0.02, 0.045, 0.08, 0.12, 0.16] {
            all.extend([end, self.length - end]);
        }
        let r = self.wheel_radius + ARCH;
        for axle in self.axles {
            for k in 0..=12 {
                all.push(axle - r * crate::place::sin_cos(90.0 - 15.0 * k as f32).0);
            }
            all.extend([axle - r - 0.002, axle + r + 0.002]);
        }
        all.extend(self.windows.iter().flatten().chain(&self.windscreen).chain(&self.rear_window));
        all.retain(|s| (0.0..=self.length).contains(s));
        all.sort_by(f32::total_cmp);
        all.dedup_by(|a, b| (*a - *b).abs() < 0.0015);
        all
    }

    /// Adds the body to an object.
    pub(crate) fn build(&self, model: &mut Model, skin: Skin) {
        let stations = self.stations();
        let sections: Vec<[Vec3; POINTS]> = stations.iter().map(|&s| self.section(s)).collect();
        // From the middle of the roof to the left sill: seen from the left the nose is on the left, rows run to the tail.
        let rows = sections.iter().map(|half| {
            let left = half.iter().map(|p| Vec3::new(-p.x, p.y, p.z));
            left.chain(half.iter().rev().skip(1).copied()).collect()
        });
        let grid = Grid::new(rows.collect());
        let column = |j: usize| if j < POINTS - 1 { j } else { 2 * POINTS - 3 - j };
        let middle = |i: usize| 0.5 * (stations[i] + stations[i + 1]);
        let within = |s: f32, range: &[f32; 2]| (range[0]..=range[1]).contains(&s);
        let is_glass = |i: usize, j: usize| match column(j) {
            6 => self.windows.iter().any(|w| within(middle(i), w)),
            9.. => within(middle(i), &self.windscreen) || within(middle(i), &self.rear_window),
            _ => false,
        };
        let is_trim = |_: usize, j: usize| column(j) == 0;
        model.add(skin.glass, &grid.quads(is_glass));
        model.add(skin.trim, &grid.quads(is_trim));
        model.add(skin.paint, &grid.quads(|i, j| !is_glass(i, j) && !is_trim(i, j)));
        for (half, front) in [(&sections[0], true), (&sections[sections.len() - 1], false)] {
            model.add(skin.paint, &cap(half, front));
        }
        for &s in self.gaps {
            model.add(skin.trim, &self.gap(s).mirrored());
        }
        // Floor and wheel housings.
        let (w, l) = (0.40 * self.width, 0.5 * self.length - 0.25);
        model.add(skin.trim, &block(Vec3::new(-w, self.sill, -l), Vec3::new(w, self.sill + 0.4, l)));
    }

    /// The gap of a door: a dark line on the right side.
    fn gap(&self, s: f32) -> Mesh {
        let (a, b) = (self.section(s - 0.005), self.section(s + 0.005));
        let out = Vec3::X * 0.003;
        let mut mesh = Mesh::default();
        for k in 1..5 {
            mesh.polygon(&[a[k], a[k + 1], b[k + 1], b[k]].map(|p| (p + out, Vec2::ZERO)));
        }
        mesh
    }

    /// A point of the right side's skin between two points of a section.
    pub(crate) fn on_side(&self, s: f32, point: f32) -> Vec3 {
        let section = self.section(s);
        let k = (point as usize).min(POINTS - 2);
        section[k].lerp(section[k + 1], point - k as f32)
    }
}

/// The flat end of nose or tail.
fn cap(half: &[Vec3; POINTS], front: bool) -> Mesh {
    let mut mesh = Mesh::default();
    for k in 0..POINTS - 1 {
        let (a, b) = (half[k], half[k + 1]);
        let mirror = |p: Vec3| Vec3::new(-p.x, p.y, p.z);
        let mut corners = vec![mirror(a), mirror(b), b, a];
        if !front {
            corners.reverse();
        }
        let corners: Vec<_> = corners.into_iter().map(|p| (p, Vec2::ZERO)).collect();
        mesh.polygon(&corners);
    }
    mesh
}
