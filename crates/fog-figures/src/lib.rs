//! Figures of a fog model as SVG text, PNG bytes and CSV text: those of Kolářová, Lachiver & Wilkie 2024 drawn from the
//! model, its optics by altitude and wavelength, and what droplets of one size do to sunlight.
//!
//! No file access, clock, environment, printing or global state; text is set in an embedded font and every number comes
//! from [`fog_core::math`], so that the same model gives the same bytes.
//!
//! ```
//! use fog_figures::{NAMES, Sources};
//! let model = fog_optics::advection::AdvectionModel::arcata()?;
//! let sources = Sources::new(&model, &[100.0, 180.0, 260.0])?;
//! let figure = sources.draw("fig5")?;
//! assert!(NAMES.contains(&figure.name.as_str()) && figure.csv.starts_with("height_m,altitude_m,"));
//! # Ok::<(), fog_figures::FiguresError>(())
//! ```

mod chart;
mod figures;
mod fit;
mod fit_report;
mod raster;
mod sheet;
mod sources;
mod sunlight;
#[cfg(test)]
mod tests;

pub use fit_report::fit_report;
pub use raster::WIDTH_PX;
pub use sources::{PAPER_HEIGHTS_M, Sources};

/// Names of the figures that [`Sources::draw`] knows, in the order in which a reader would look at them.
pub const NAMES: [&str; 11] = figures::NAMES;

/// One figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Name for files, lower case.
    pub name: String,
    /// Heading.
    pub title: String,
    /// What is drawn and where it comes from; it stands under the figure too.
    pub caption: String,
    /// The picture, 1000 px wide.
    pub svg: String,
    /// The numbers that are drawn: a header of names with units, then rows of numbers.
    pub csv: String,
}

impl Figure {
    /// The picture as the bytes of a PNG, [`WIDTH_PX`] wide on white.
    ///
    /// # Errors
    /// If the rasteriser refuses the picture, which would be a fault of this crate.
    pub fn png(&self) -> Result<Vec<u8>, FiguresError> {
        raster::png(&self.svg)
    }
}

/// Why a figure could not be drawn.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum FiguresError {
    /// No figure has this name.
    #[error("there is no figure `{name}`; there are {}", NAMES.join(", "))]
    UnknownName {
        /// What was asked for.
        name: String,
    },
    /// No fog heights were given.
    #[error("figures need at least one fog height_m")]
    NoHeights,
    /// The data of a fit do not belong together.
    #[error("figures of a fit: {0}")]
    FitData(String),
    /// The fog model refused a value.
    #[error(transparent)]
    Optics(#[from] fog_optics::error::OpticsError),
    /// A phase function refused its parameters.
    #[error(transparent)]
    Phase(#[from] fog_core::phase::PhaseError),
    /// The rasteriser refused the picture.
    #[error("cannot rasterise a figure: {0}")]
    Raster(String),
}
