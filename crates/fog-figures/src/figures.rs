//! The figures, one file each.

mod fig11;
mod fig3;
mod fig4;
mod fig5;
mod fig6;
mod fig7;
mod fig9;
mod phase;
mod phenomena;
mod profiles;
mod surface;
mod wavelengths;

use crate::chart::{Page, Row};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};

type Draw = fn(&Sources<'_>) -> Result<Figure, FiguresError>;

const FIGURES: [(&str, Draw); 11] = [
    ("fig3", fig3::draw),
    ("fig4", fig4::draw),
    ("fig5", fig5::draw),
    ("fig6", fig6::draw),
    ("fig7", fig7::draw),
    ("fig9", fig9::draw),
    ("fig11", fig11::draw),
    ("profiles", profiles::draw),
    ("wavelengths", wavelengths::draw),
    ("phase", phase::draw),
    ("phenomena", phenomena::draw),
];

pub(crate) const NAMES: [&str; FIGURES.len()] = {
    let mut names = [""; FIGURES.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = FIGURES[i].0;
        i += 1;
    }
    names
};

pub(crate) fn draw(name: &str, sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (_, draw) = (FIGURES.iter().find(|f| f.0 == name))
        .ok_or_else(|| FiguresError::UnknownName { name: name.to_owned() })?;
    draw(sources)
}

/// Puts a figure together.
pub(crate) fn figure(name: &str, title: &str, caption: &str, rows: Vec<Row>, sheet: Sheet) -> Figure {
    let svg = Page { title, caption, rows }.svg();
    Figure {
        name: name.to_owned(),
        title: title.to_owned(),
        caption: caption.to_owned(),
        svg,
        csv: sheet.finish(),
    }
}

/// `count` numbers at equal steps from `first` to `last`.
pub(crate) fn steps(first: f64, last: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| first + (last - first) * i as f64 / (count - 1) as f64).collect()
}

/// Droplets per m³ in one per cm³, the unit of the axes.
pub(crate) const CM3: f64 = 1e-6;
