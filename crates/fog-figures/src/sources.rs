//! What figures are drawn from: the model, fog heights, and optics that several figures share.

use crate::{Figure, FiguresError, figures};
use fog_core::optics_table::OpticsTable;
use fog_optics::advection::AdvectionModel;
use fog_optics::layer::{self, FogLayer, REFERENCE_NM};
use fog_optics::state::FogState;
use fog_optics::table::{TableSettings, build_table};
use std::sync::OnceLock;

/// The three fog heights of the paper in m (Sec. 4.1).
pub const PAPER_HEIGHTS_M: [f64; 3] = [100.0, 180.0, 260.0];

/// A fog model and the heights at which it is drawn.
///
/// Figures that show several fogs show every height. Of those that show one, `fig3` takes the lowest, `fig4`, `fig6`,
/// `fig7` and `wavelengths` the middle one, `fig9` and `fig11` the highest, which with [`PAPER_HEIGHTS_M`] are the paper's.
#[derive(Debug)]
pub struct Sources<'a> {
    model: &'a AdvectionModel,
    heights_m: Vec<f64>,
    /// At 550 nm by relative altitude.
    table: OnceLock<OpticsTable>,
}

impl<'a> Sources<'a> {
    /// Draws `model` at fog heights in m; they are sorted, and repeated ones dropped.
    ///
    /// # Errors
    /// If there are none, or one is outside [`fog_optics::advection::HEIGHT_RANGE_M`].
    pub fn new(model: &'a AdvectionModel, heights_m: &[f64]) -> Result<Self, FiguresError> {
        heights_m.iter().try_for_each(|&h| model.check_height(h))?;
        let mut heights_m = heights_m.to_vec();
        heights_m.sort_by(f64::total_cmp);
        heights_m.dedup();
        if heights_m.is_empty() {
            return Err(FiguresError::NoHeights);
        }
        Ok(Self { model, heights_m, table: OnceLock::new() })
    }

    /// Draws the figure of that name, one of [`crate::NAMES`].
    ///
    /// # Errors
    /// If there is no such figure, or the model's optics cannot be computed.
    pub fn draw(&self, name: &str) -> Result<Figure, FiguresError> {
        figures::draw(name, self)
    }

    pub(crate) fn model(&self) -> &AdvectionModel {
        self.model
    }

    pub(crate) fn heights_m(&self) -> &[f64] {
        &self.heights_m
    }

    pub(crate) fn lowest_m(&self) -> f64 {
        self.heights_m[0]
    }

    pub(crate) fn middle_m(&self) -> f64 {
        self.heights_m[self.heights_m.len() / 2]
    }

    pub(crate) fn highest_m(&self) -> f64 {
        self.heights_m[self.heights_m.len() - 1]
    }

    /// Cross sections and mean cosines at 550 nm.
    fn table(&self) -> Result<&OpticsTable, FiguresError> {
        if let Some(table) = self.table.get() {
            return Ok(table);
        }
        let settings =
            TableSettings { wavelengths_nm: vec![REFERENCE_NM], ..TableSettings::visible(self.model) };
        let table = build_table(self.model, &settings, &|_| ())?;
        Ok(self.table.get_or_init(|| table))
    }

    /// The layer of a height at 550 nm.
    pub(crate) fn layer(&self, height_m: f64) -> Result<FogLayer, FiguresError> {
        Ok(layer::advection(self.table()?, self.model, height_m, 1.0)?)
    }

    /// The fog of a height at an altitude.
    pub(crate) fn state(&self, height_m: f64, altitude_m: f64) -> Result<FogState, FiguresError> {
        Ok(FogState::advection(self.table()?, self.model, height_m, 1.0, altitude_m)?)
    }
}
