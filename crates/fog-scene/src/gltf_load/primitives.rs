//! The triangles of a mesh in its own space.

use super::accessor::Buffers;
use super::{Warnings, tangents};
use crate::error::{Failure, SceneErrorKind};
use crate::material::Material;
use crate::texture::Texture;
use gltf::Accessor;
use gltf::accessor::Dimensions;
use gltf::mesh::{Mode, Semantic};

/// Vertices and triangles of one primitive.
pub(super) struct Primitive {
    pub(super) positions: Vec<[f32; 3]>,
    /// As many as positions, or none at all.
    pub(super) normals: Vec<[f32; 3]>,
    /// Each as many as positions, or none at all.
    pub(super) uv: [Vec<[f32; 2]>; 2],
    /// `COLOR_0`, in [0, 1], white alpha if it has none; as many as positions, or none at all.
    pub(super) colors: Vec<[f32; 4]>,
    /// Tangents at the corners of each triangle, as many as triangles, or none at all: only for normal maps.
    pub(super) tangents: Vec<[[f32; 4]; 3]>,
    /// Vertices of each triangle, all in range.
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) material: Option<usize>,
}

/// Name of a mesh for messages.
pub(super) fn mesh_name(mesh: &gltf::Mesh<'_>) -> String {
    mesh.name().map_or_else(|| mesh.index().to_string(), str::to_owned)
}

/// Reads all primitives of a mesh that have triangles.
pub(super) fn read(
    mesh: &gltf::Mesh<'_>,
    buffers: &Buffers,
    (materials, textures): (&[Material], &[Texture]),
    max_triangles: usize,
    warnings: &mut Warnings,
) -> Result<Vec<Primitive>, Failure> {
    let name = mesh_name(mesh);
    let mut out = Vec::new();
    for primitive in mesh.primitives() {
        let mode = primitive.mode();
        if matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
            warnings.add(format!("points or lines of mesh `{name}` were left out"));
            continue;
        }
        if primitive.get(&Semantic::Colors(1)).is_some() {
            warnings.add(format!("vertex colours after the first of mesh `{name}` were ignored"));
        }
        let material = primitive.material().index().and_then(|index| materials.get(index));
        let normal_map = material
            .and_then(|material| material.normal_map)
            .and_then(|map| Some((map.texture.set, textures.get(map.texture.texture as usize)?)));
        let read = read_one(&primitive, buffers, normal_map, max_triangles);
        let (primitive, leftover) = read.map_err(|text| {
            let place = || format!("mesh `{name}`, primitive {}", primitive.index());
            SceneErrorKind::Accessor(text).at(place)
        })?;
        if leftover {
            warnings.add(format!("vertices of mesh `{name}` that are too few for a triangle were left out"));
        }
        if !primitive.triangles.is_empty() {
            out.push(primitive);
        }
    }
    Ok(out)
}

/// Reads a primitive; also whether vertices are left over.
fn read_one(
    primitive: &gltf::Primitive<'_>,
    buffers: &Buffers,
    normal_map: Option<(u8, &Texture)>,
    max_triangles: usize,
) -> Result<(Primitive, bool), String> {
    // A triangle has three corners: more vertices or indices than that are over the limit, or of no use.
    let most = max_triangles.saturating_mul(3).saturating_add(2);
    let named = |semantic: &str| {
        let semantic = semantic.to_owned();
        move |e: String| format!("{semantic} {e}")
    };
    let position = primitive.get(&Semantic::Positions).ok_or("has no POSITION")?;
    let positions = buffers.floats::<3>(&position, most).map_err(named("POSITION"))?;
    let same_length = |length: usize, semantic: &str| {
        if length == positions.len() {
            return Ok(());
        }
        Err(format!("{semantic} has {length} elements, POSITION {}", positions.len()))
    };
    let mut normals = Vec::new();
    if let Some(accessor) = primitive.get(&Semantic::Normals) {
        normals = buffers.floats::<3>(&accessor, most).map_err(named("NORMAL"))?;
        same_length(normals.len(), "NORMAL")?;
    }
    let mut uv = [Vec::new(), Vec::new()];
    for (set, uv) in uv.iter_mut().enumerate() {
        if let Some(accessor) = primitive.get(&Semantic::TexCoords(set as u32)) {
            let semantic = format!("TEXCOORD_{set}");
            *uv = buffers.floats::<2>(&accessor, most).map_err(named(&semantic))?;
            same_length(uv.len(), &semantic)?;
        }
    }
    let mut colors = Vec::new();
    if let Some(accessor) = primitive.get(&Semantic::Colors(0)) {
        colors = read_colors(&accessor, buffers, most).map_err(named("COLOR_0"))?;
        same_length(colors.len(), "COLOR_0")?;
    }
    let mut of_vertices = Vec::new();
    if let Some(accessor) = primitive.get(&Semantic::Tangents).filter(|_| normal_map.is_some()) {
        of_vertices = buffers.floats::<4>(&accessor, most).map_err(named("TANGENT"))?;
        same_length(of_vertices.len(), "TANGENT")?;
    }
    let indices = match primitive.indices() {
        Some(accessor) => buffers.indices(&accessor, most).map_err(named("indices"))?,
        None => (0..positions.len() as u32).collect(),
    };
    if let Some(index) = indices.iter().find(|&&i| i as usize >= positions.len()) {
        return Err(format!("an index names vertex {index} of {}", positions.len()));
    }
    let triangles = assemble(primitive.mode(), &indices);
    let leftover = match primitive.mode() {
        Mode::Triangles => indices.len() % 3 != 0,
        _ => matches!(indices.len(), 1 | 2),
    };
    let material = primitive.material().index();
    let tangents = Vec::new();
    let mut out = Primitive { positions, normals, uv, colors, tangents, triangles, material };
    // Tangents belong to normals: a file without these has no use for those.
    if !of_vertices.is_empty() && !out.normals.is_empty() {
        out.tangents = out.triangles.iter().map(|t| t.map(|vertex| of_vertices[vertex as usize])).collect();
    } else if let Some((set, texture)) = normal_map {
        out.tangents = tangents::generate(&out, set, texture);
    }
    Ok((out, leftover))
}

/// Vertex colours of three or four components; what is outside of [0, 1] is cut off, for no surface reflects it.
fn read_colors(accessor: &Accessor<'_>, buffers: &Buffers, most: usize) -> Result<Vec<[f32; 4]>, String> {
    let mut colors = if accessor.dimensions() == Dimensions::Vec3 {
        let colors = buffers.floats::<3>(accessor, most)?;
        colors.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect()
    } else {
        buffers.floats::<4>(accessor, most)?
    };
    for (vertex, color) in colors.iter_mut().enumerate() {
        if !color.iter().all(|c| c.is_finite()) {
            return Err(format!("of vertex {vertex} is {color:?}: not finite"));
        }
        *color = color.map(|c| c.clamp(0.0, 1.0));
    }
    Ok(colors)
}

/// Triangles of a list, strip or fan, all of one winding (glTF 2.0, section 3.7.2.1).
fn assemble(mode: Mode, indices: &[u32]) -> Vec<[u32; 3]> {
    let windows = indices.windows(3);
    match mode {
        Mode::TriangleStrip => {
            let turned =
                |(i, v): (usize, &[u32])| if i % 2 == 0 { [v[0], v[1], v[2]] } else { [v[0], v[2], v[1]] };
            windows.enumerate().map(turned).collect()
        }
        Mode::TriangleFan => windows.map(|v| [v[1], v[2], indices[0]]).collect(),
        _ => indices.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_the_winding() {
        assert_eq!(assemble(Mode::TriangleStrip, &[0, 1, 2, 3]), [[0, 1, 2], [1, 3, 2]]);
        assert_eq!(assemble(Mode::TriangleFan, &[0, 1, 2, 3]), [[1, 2, 0], [2, 3, 0]]);
        assert_eq!(assemble(Mode::Triangles, &[0, 1, 2, 3]), [[0, 1, 2]]);
        assert!(assemble(Mode::TriangleStrip, &[0, 1]).is_empty());
    }
}
