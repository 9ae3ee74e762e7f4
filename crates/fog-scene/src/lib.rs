//! glTF, geometry, BVH, materials, media, phase functions, lights and cameras: an immutable scene

mod aim;
mod attributes;
mod bvh;
mod error;
mod features;
mod geometry;
mod gltf_load;
mod material;
mod texture;
mod triangle;
mod uv_transform;

pub use attributes::CornerValues;
pub use bvh::Hit;
pub use error::{SceneError, SceneErrorKind};
pub use features::Features;
pub use geometry::Geometry;
pub use gltf_load::{Limits, LoadedScene, SceneObject, load, load_bytes};
pub use material::{AlphaMode, Material, NormalMap, Opacity, SurfaceParameters, TextureRef};
pub use texture::{Encoding, Filter, Image, Texture, Wrap};
pub use triangle::{SurfacePoint, Triangle, offset_origin};
pub use uv_transform::UvTransform;
pub mod atmosphere;
pub mod bsdf;
pub mod camera;
pub mod cie_sky;
pub mod dome;
pub mod emitters;
pub mod lamp;
pub mod light;
pub mod light_groups;
pub mod light_tree;
pub mod medium;
pub mod moon;
pub mod phase;
pub mod scene;
pub mod sky_map;
