//! Phase functions by angle, wavelength and altitude.

use super::figure;
use crate::chart::style::{INK, PALETTE};
use crate::chart::{Axis, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_core::math::{PI, f64::acos};
use fog_core::phase::HenyeyGreenstein;
use fog_core::phase_grid;
use fog_optics::table::{TableSettings, build_table};

const ZETAS: [f64; 3] = [0.0, 0.5, 1.0];
const WAVELENGTHS_NM: [f64; 4] = [450.0, 650.0, 905.0, 1550.0];
/// Where the other one varies.
const MIDDLE_ZETA: usize = 1;
const GREEN_NM: f64 = 550.0;
/// The paper's asymmetry factor (Sec. 5.4).
const HG_G: f64 = 0.83;
/// End of the forward zoom in degrees.
const FORWARD_DEG: f64 = 5.0;

/// One curve: label, colour, and its values in 1/sr at the nodes.
struct Curve {
    label: String,
    colour: &'static str,
    values: Vec<f64>,
}

/// All curves and the angles of the nodes in degrees.
struct Curves {
    angles_deg: Vec<f64>,
    by_altitude: Vec<Curve>,
    by_wavelength: Vec<Curve>,
    hg: Curve,
}

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let curves = compute(sources)?;
    let row = |name: &str, of: &[Curve]| {
        let forward = curves.panel(&format!("{name}: forward peak"), of, FORWARD_DEG);
        Row::panels(330.0, [curves.panel(name, of, 180.0), forward]).with_own_legend()
    };
    let rows = vec![row("By altitude", &curves.by_altitude), row("By wavelength", &curves.by_wavelength)];
    let caption = "Phase functions of the model's droplet spectra by Mie series of water, normalised to ∫p dΩ = 1, at relative \
                   altitudes ζ = z/H. Dashed: Henyey & Greenstein's function with the paper's g (Kolářová, Lachiver & Wilkie \
                   2024, Sec. 5.4), which lacks the forward peak, the fogbow near 140° and the glory at 180°.";
    Ok(figure("phase", "Phase functions of advection fog", caption, rows, curves.sheet()))
}

fn compute(sources: &Sources<'_>) -> Result<Curves, FiguresError> {
    let model = sources.model();
    let mut wavelengths_nm = WAVELENGTHS_NM.to_vec();
    wavelengths_nm.push(GREEN_NM);
    wavelengths_nm.sort_by(f64::total_cmp);
    let settings = TableSettings {
        zeta: ZETAS.to_vec(),
        wavelengths_nm: wavelengths_nm.clone(),
        diameters: *model.diameters(),
    };
    let table = build_table(model, &settings, &|_| ())?;
    let view = table.view();
    let column = |zeta: usize, nm: f64| -> Vec<f64> {
        let l = wavelengths_nm.iter().position(|&w| w == nm).unwrap_or(0);
        (0..phase_grid::NODES).map(|i| f64::from(view.phase_node(zeta, l, i))).collect()
    };
    let by_altitude = ZETAS.iter().enumerate().map(|(i, zeta)| Curve {
        label: format!("ζ = {zeta}, {GREEN_NM} nm"),
        colour: PALETTE[[0, 2, 1][i]],
        values: column(i, GREEN_NM),
    });
    let by_wavelength = WAVELENGTHS_NM.iter().enumerate().map(|(i, &nm)| Curve {
        label: format!("{nm} nm, ζ = {}", ZETAS[MIDDLE_ZETA]),
        colour: PALETTE[[0, 1, 4, 3][i]],
        values: column(MIDDLE_ZETA, nm),
    });
    let henyey_greenstein = HenyeyGreenstein::new(HG_G)?;
    let hg = Curve {
        label: format!("Henyey–Greenstein, g = {HG_G}"),
        colour: INK,
        values: phase_grid::nodes().iter().map(|&m| henyey_greenstein.eval(m)).collect(),
    };
    let angles = phase_grid::cosines().into_iter().map(|c| acos(c.clamp(-1.0, 1.0)) * 180.0 / PI);
    Ok(Curves {
        angles_deg: angles.collect(),
        by_altitude: by_altitude.collect(),
        by_wavelength: by_wavelength.collect(),
        hg,
    })
}

impl Curves {
    fn sheet(&self) -> Sheet {
        let mut columns = vec!["angle_deg".to_owned()];
        columns.extend(ZETAS.iter().map(|zeta| format!("p_zeta_{zeta}_{GREEN_NM}_nm_1_sr")));
        columns.extend(WAVELENGTHS_NM.iter().map(|nm| format!("p_zeta_{}_{nm}_nm_1_sr", ZETAS[MIDDLE_ZETA])));
        columns.push("p_henyey_greenstein_1_sr".to_owned());
        let mut sheet = Sheet::new(&columns.iter().map(String::as_str).collect::<Vec<_>>());
        for (i, angle) in self.angles_deg.iter().enumerate() {
            let mut row = vec![*angle];
            let curves = self.by_altitude.iter().chain(&self.by_wavelength).chain([&self.hg]);
            row.extend(curves.map(|c| c.values[i]));
            sheet.row(&row);
        }
        sheet
    }

    /// Some curves and Henyey & Greenstein's from 0° to `last_deg`.
    fn panel(&self, heading: &str, curves: &[Curve], last_deg: f64) -> Panel {
        let mut all: Vec<Series> = curves.iter().map(|c| series(c, &self.angles_deg, last_deg)).collect();
        all.push(series(&self.hg, &self.angles_deg, last_deg).dashed("7 4").width(1.5));
        let shown = self.angles_deg.iter().take_while(|&&a| a <= last_deg).count();
        let values = curves.iter().flat_map(|c| c.values[..shown].iter().copied());
        let low_end = if last_deg < 90.0 { 0.1 } else { 1e-3 };
        let y = Axis::log_over("Phase function (1/sr)", values.chain([low_end]));
        let x = Axis::linear("Scattering angle (°)", 0.0, last_deg);
        let x = if last_deg > 90.0 { x.ticked(&[0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0]) } else { x };
        Panel::new(heading, x, y, all)
    }
}

fn series(curve: &Curve, angles: &[f64], last_deg: f64) -> Series {
    let points = angles.iter().zip(&curve.values).map(|(&a, &p)| [a, p]);
    // One point beyond the end, so that the line reaches it.
    let shown = angles.iter().take_while(|&&a| a <= last_deg).count() + 1;
    Series::line(&curve.label, curve.colour, points.take(shown).collect()).width(1.7)
}
