//! Scenes made by formula, as glTF files (GLB): the same options and seed give the same bytes.
//!
//! Dimensions are in metres, +Y is up, ways begin near the origin and run along −Z. Every node that has a mesh or a lamp says
//! in its `extras` of which class and instance it is; [`CLASSES`] lists the classes. Lamps are `KHR_lights_punctual` in cd.

mod aruco;
mod classes;
mod error;
mod font;
mod glb;
mod highway;
mod lamp;
mod mesh;
mod noise;
mod objects;
mod paint;
mod picture;
mod place;
mod runway;
mod shapes;
mod signs;
mod street;
mod targets;
mod urban;

pub use classes::CLASSES;
pub use error::WorldError;
pub use highway::Highway;
pub use runway::{ApproachLights, Runway};
pub use signs::Style;
pub use targets::Targets;
pub use urban::Urban;

/// A scene and its options.
#[derive(Clone, Debug, PartialEq)]
pub enum World {
    /// The street of Kolářová et al. 2024, Sec. 6.1. The same for every seed.
    Street,
    /// Targets at known places. The same for every seed.
    Targets(Targets),
    /// A runway and its lights.
    Runway(Runway),
    /// A street in a town.
    Urban(Urban),
    /// A motorway.
    Highway(Highway),
}

impl World {
    /// The file's bytes. `seed` decides what the options leave open.
    ///
    /// # Errors
    /// [`WorldError::Option`] for an option out of its range.
    pub fn glb(&self, seed: u64) -> Result<Vec<u8>, WorldError> {
        match self {
            Self::Street => street::street(),
            Self::Targets(options) => targets::targets(options),
            Self::Runway(options) => runway::runway(options, seed),
            Self::Urban(options) => urban::urban(options, seed),
            Self::Highway(options) => highway::highway(options, seed),
        }
    }
}
