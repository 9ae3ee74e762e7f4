//! Smooth surfaces over a grid of points.

use crate::mesh::{Mesh, has_area};
use crate::place::sin_cos;
use fog_core::{Vec2, Vec3};

/// Points of a surface in rows; the front is where (next row − this) × (next in row − this) points.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    pub(crate) rows: Vec<Vec<Vec3>>,
    normals: Vec<Vec<Vec3>>,
}

impl Grid {
    /// A grid whose normals are the means of the faces around each point. Rows are of one length; a row whose ends are one
    /// point is closed, and so is a grid whose first row is its last.
    pub(crate) fn new(rows: Vec<Vec<Vec3>>) -> Self {
        let (n, m) = (rows.len(), rows[0].len());
        let mut normals = vec![vec![Vec3::ZERO; m]; n];
        for i in 1..n {
            for j in 1..m {
                let face = (rows[i][j] - rows[i - 1][j - 1]).cross(rows[i - 1][j] - rows[i][j - 1]);
                for (a, b) in [(i - 1, j - 1), (i - 1, j), (i, j - 1), (i, j)] {
                    normals[a][b] += face;
                }
            }
        }
        let same = |a: Vec3, b: Vec3| (a - b).length_squared() < 1e-12;
        for i in 0..n {
            if same(rows[i][0], rows[i][m - 1]) {
                let sum = normals[i][0] + normals[i][m - 1];
                (normals[i][0], normals[i][m - 1]) = (sum, sum);
            }
        }
        if (0..m).all(|j| same(rows[0][j], rows[n - 1][j])) {
            for j in 0..m {
                let sum = normals[0][j] + normals[n - 1][j];
                (normals[0][j], normals[n - 1][j]) = (sum, sum);
            }
        }
        // A row shrunk to a point has one normal.
        for i in [0, n - 1] {
            if rows[i].iter().all(|&p| same(p, rows[i][0])) {
                let sum = normals[i].iter().copied().sum();
                normals[i].fill(sum);
            }
        }
        let normals = normals.into_iter().map(|r| r.into_iter().map(|v| v.normalize_or(Vec3::Y)).collect());
        Self { normals: normals.collect(), rows }
    }

    /// The quads between rows and columns for which `take(row, column)` holds.
    pub(crate) fn quads(&self, take: impl Fn(usize, usize) -> bool) -> Mesh {
        let mut mesh = Mesh::default();
        let (n, m) = (self.rows.len(), self.rows[0].len());
        let mut index = vec![None; n * m];
        for i in 1..n {
            for j in (1..m).filter(|&j| take(i - 1, j - 1)) {
                let mut at = |a: usize, b: usize| {
                    *index[a * m + b].get_or_insert_with(|| {
                        let uv = Vec2::new(b as f32 / (m - 1) as f32, a as f32 / (n - 1) as f32);
                        mesh.vertex(self.rows[a][b], self.normals[a][b], uv)
                    })
                };
                let [a, b, c, d] = [at(i - 1, j - 1), at(i, j - 1), at(i, j), at(i - 1, j)];
                for t in [[a, b, c], [a, c, d]] {
                    let [p, q, r] = t.map(|k| mesh.positions[k as usize]);
                    if has_area(p, q, r) {
                        mesh.indices.extend(t);
                    }
                }
            }
        }
        mesh
    }

    /// The whole surface.
    pub(crate) fn mesh(&self) -> Mesh {
        self.quads(|_, _| true)
    }
}

/// A body of revolution about the y axis from its profile of (radius, height), going up for a front outside; `n` sides.
pub(crate) fn lathe(profile: &[[f32; 2]], n: usize) -> Mesh {
    let row = |&[r, y]: &[f32; 2]| {
        let point = |k: usize| {
            let (s, c) = sin_cos(360.0 * (k % n) as f32 / n as f32);
            Vec3::new(r * s, y, r * c)
        };
        // Down the column, so that the front is outside.
        (0..=n).rev().map(point).collect()
    };
    Grid::new(profile.iter().map(row).collect()).mesh()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lathe_faces_outward_and_is_smooth() {
        let ball = lathe(&[[0.0, -1.0], [0.7, -0.7], [1.0, 0.0], [0.7, 0.7], [0.0, 1.0]], 16);
        for (p, n) in ball.positions.iter().zip(&ball.normals) {
            assert!(p.normalize().dot(*n) > 0.95, "{p} {n}");
        }
        for t in ball.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| ball.positions[t[k] as usize]);
            assert!((b - a).cross(c - a).dot(a + b + c) > 0.0);
        }
    }
}
