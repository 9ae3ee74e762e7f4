//! Rainbow, fogbow, glory and corona: what the sizes of droplets do to sunlight.

use super::{figure, steps};
use crate::chart::style::PALETTE;
use crate::chart::{Axis, Block, Panel, Row, Series, Strips};
use crate::sheet::Sheet;
use crate::sunlight::{EFFECTIVE_VARIANCE, Scattered, SunView, strip};
use crate::{Figure, FiguresError, Sources};
use fog_core::colour::Observer;

/// Effective diameters in µm, and what they are.
const SIZES: [(f64, &str); 5] = [
    (5.0, "5 µm: young fog"),
    (10.0, "10 µm: fog"),
    (20.0, "20 µm: old fog, cloud"),
    (60.0, "60 µm: drizzle begins"),
    (1000.0, "1 mm: rain"),
];

/// Angles are this far apart, in degrees.
const STEP_DEG: f64 = 0.1;
const CORONA_DEG: [f64; 2] = [0.0, 15.0];
const BOWS_DEG: [f64; 2] = [130.0, 180.0];

pub(crate) fn draw(_: &Sources<'_>) -> Result<Figure, FiguresError> {
    let observer = Observer::new();
    let angles = steps(0.0, 180.0, 1801);
    let view = SunView::new(&angles);
    let mut sizes = Vec::new();
    for (diameter_um, name) in SIZES {
        sizes.push((diameter_um, name, Scattered::new(diameter_um, &view, &observer)?));
    }

    let columns = ["diameter_um", "angle_deg", "luminance_1_sr", "red_1_sr", "green_1_sr", "blue_1_sr"];
    let mut sheet = Sheet::new(&columns);
    for (diameter_um, _, scattered) in &sizes {
        for ((angle, y), [r, g, b]) in angles.iter().zip(scattered.luminance()).zip(&scattered.rgb) {
            sheet.row(&[*diameter_um, *angle, y, *r, *g, *b]);
        }
    }

    let panel = |heading: &str, [first, last]: [f64; 2], every: usize| {
        let (from, to) = ((first / STEP_DEG).round() as usize, (last / STEP_DEG).round() as usize);
        let mut all = Vec::new();
        let series = sizes.iter().enumerate().map(|(i, (_, name, scattered))| {
            let luminance = scattered.luminance();
            let points: Vec<[f64; 2]> =
                (from..=to).step_by(every).map(|k| [angles[k], luminance[k]]).collect();
            all.extend(points.iter().map(|p| p[1]));
            Series::line(name, PALETTE[[5, 0, 2, 4, 1][i]], points).width(1.7)
        });
        let series = series.collect();
        Panel::new(
            heading,
            Axis::linear("Scattering angle (°)", first, last),
            Axis::log_over("Scattered light (1/sr)", all),
            series,
        )
    };
    let strips = |heading: &str, [first, last]: [f64; 2], contrast: f64| {
        let (from, to) = ((first / STEP_DEG).round() as usize, (last / STEP_DEG).round() as usize);
        let strips = (sizes.iter())
            .map(|(d, _, s)| {
                let label = if *d < 1000.0 { format!("{d} µm") } else { format!("{} mm", d / 1000.0) };
                (label, strip(&s.rgb[from..to], contrast))
            })
            .collect();
        let x = Axis::linear("Scattering angle (°)", first, last);
        Block::Strips(Strips { heading: heading.to_owned(), x, strips })
    };
    let mut whole = panel("", [0.0, 180.0], 5);
    whole.x = whole.x.ticked(&[0.0, 30.0, 60.0, 90.0, 120.0, 138.0, 150.0, 180.0]);
    let rows = vec![
        Row::panels(310.0, [whole]),
        Row::panels(
            270.0,
            [
                panel("Corona", CORONA_DEG, 1),
                panel("Rainbow and fogbow near 138°, glory at 180°", BOWS_DEG, 2),
            ],
        ),
        Row::blocks(
            230.0,
            vec![
                strips("Colours of the corona", CORONA_DEG, 0.3),
                strips("Colours of bow and glory", BOWS_DEG, 0.8),
            ],
        ),
    ];
    let caption = format!(
        "Sunlight scattered once by narrow gamma spectra of droplets (effective diameter as named, effective variance \
         {EFFECTIVE_VARIANCE}), by Mie series of water at 16 wavelengths, averaged over the sun's disc; the sun is D65, the eye \
         CIE 1931. Curves: luminance, by which 1/sr is a phase function seen in white light. Colours: sRGB with the hue and \
         saturation of the light; the brightest of each strip is set to white and brightness is compressed (power 0.3 for the \
         corona, 0.8 for bows). As \
         drops shrink the rainbow becomes a broad, white fogbow, and the rings of corona and glory grow; rain has no corona, \
         its curve shows the sun's own disc."
    );
    Ok(figure("phenomena", "Rainbow, fogbow, glory and corona by droplet size", &caption, rows, sheet))
}
