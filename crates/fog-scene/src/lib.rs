//! glTF, geometry, BVH, materials, media, phase functions, lights and cameras: an immutable scene
