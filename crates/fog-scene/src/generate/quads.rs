//! Meshes of rectangles.

/// Vertices and indices of rectangles; four vertices each.
#[derive(Default)]
pub(super) struct Quads {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    /// Empty for meshes without texture.
    pub(super) uv: Vec<[f32; 2]>,
    pub(super) indices: Vec<u16>,
}

fn add(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    core::array::from_fn(|i| a[i] + b[i])
}

impl Quads {
    /// Adds the rectangle of corner `o` and edges `u` and `v` along two axes; its front is where u × v points.
    pub(super) fn plain(&mut self, o: [f32; 3], u: [f32; 3], v: [f32; 3]) {
        let first = self.positions.len() as u16;
        self.positions.extend([o, add(o, u), add(add(o, u), v), add(o, v)]);
        let cross: [f32; 3] = core::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            u[j] * v[k] - u[k] * v[j]
        });
        // One component of an axis-parallel normal is not zero; the others may be −0.
        let normal = cross.map(|c| if c == 0.0 { 0.0 } else { c.signum() });
        self.normals.extend([normal; 4]);
        self.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
    }

    /// The same, with a texture of 2 × 2 squares of `square` metres each.
    pub(super) fn checkered(&mut self, o: [f32; 3], u: [f32; 3], v: [f32; 3], square: f32) {
        self.plain(o, u, v);
        let repeats = |edge: [f32; 3]| edge.iter().map(|c| c.abs()).sum::<f32>() / (2.0 * square);
        let (s, t) = (repeats(u), repeats(v));
        self.uv.extend([[0.0, 0.0], [s, 0.0], [s, t], [0.0, t]]);
    }

    /// The five visible faces of the box from `min` to `max`, as `face(o, u, v)`: south, east, north, west, top.
    pub(super) fn each_face(
        min: [f32; 3],
        max: [f32; 3],
        mut face: impl FnMut([f32; 3], [f32; 3], [f32; 3]),
    ) {
        let [x0, y0, z0] = min;
        let [x1, y1, z1] = max;
        let (dx, up, dz) = (x1 - x0, [0.0, y1 - y0, 0.0], z1 - z0);
        face([x0, y0, z1], [dx, 0.0, 0.0], up);
        face([x1, y0, z1], [0.0, 0.0, -dz], up);
        face([x1, y0, z0], [-dx, 0.0, 0.0], up);
        face([x0, y0, z0], [0.0, 0.0, dz], up);
        face([x0, y1, z1], [dx, 0.0, 0.0], [0.0, 0.0, -dz]);
    }
}
