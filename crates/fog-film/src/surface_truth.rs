//! What the first surface of each pixel-centre ray is.

use fog_core::colour::Rgb;

/// Layers of the first surface, row-major like the frame; those that nobody asked for are empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceTruth {
    /// Unit normal in the world; zero for sky.
    pub normal: Vec<[f32; 3]>,
    /// Position in the world in metres; NaN for sky.
    pub position: Vec<[f32; 3]>,
    /// Linear base colour in [0, 1]; zero for sky.
    pub albedo: Vec<Rgb>,
    /// Class.
    pub semantic: Vec<u8>,
    /// Instance; 0: none.
    pub instance: Vec<u16>,
    /// Image point in the next frame minus the pixel's centre, in pixels, to the right and down; NaN where there is none.
    pub flow: Vec<[f32; 2]>,
    /// 1 where the next frame shows the same point, else 0.
    pub flow_valid: Vec<f32>,
}

impl SurfaceTruth {
    /// Names and lengths of the layers.
    pub(crate) fn lengths(&self) -> [(&'static str, usize); 7] {
        [
            ("normal", self.normal.len()),
            ("position", self.position.len()),
            ("albedo", self.albedo.len()),
            ("semantic", self.semantic.len()),
            ("instance", self.instance.len()),
            ("flow", self.flow.len()),
            ("flow_valid", self.flow_valid.len()),
        ]
    }
}
