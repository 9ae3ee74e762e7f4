//! What holds for every figure, and what single figures must show.

use crate::fit::{FitNumber, FitParameter, FitProfile, fit_figures};
use crate::{Figure, FiguresError, NAMES, PAPER_HEIGHTS_M, Sources, fit_report};
use fog_core::math::PI;
use fog_optics::advection::AdvectionModel;
use resvg::tiny_skia::{Pixmap, Rect};
use resvg::usvg::{Group, Node, Options, Tree, roxmltree};

fn model() -> AdvectionModel {
    AdvectionModel::arcata().unwrap()
}

fn draw(name: &str) -> Figure {
    let model = model();
    Sources::new(&model, &PAPER_HEIGHTS_M).unwrap().draw(name).unwrap()
}

/// Boxes of all texts below a group.
fn texts(group: &Group, out: &mut Vec<(String, Rect)>) {
    for node in group.children() {
        match node {
            Node::Text(text) => {
                let words: String = text.chunks().iter().map(|c| c.text()).collect();
                out.push((words, text.abs_bounding_box()));
            }
            Node::Group(group) => texts(group, out),
            Node::Path(_) | Node::Image(_) => {}
        }
    }
}

/// Well-formed, nothing outside the page, no text over another, every character in the font.
fn check_picture(figure: &Figure) {
    let document = roxmltree::Document::parse(&figure.svg).unwrap();
    assert_eq!(document.root_element().tag_name().name(), "svg");
    let mut options = Options::default();
    options.fontdb_mut().load_font_data(crate::raster::FONT.to_vec());
    let tree = Tree::from_str(&figure.svg, &options).unwrap();
    let mut words = Vec::new();
    texts(tree.root(), &mut words);
    assert!(words.len() > 8, "{}", figure.name);
    for (i, (word, a)) in words.iter().enumerate() {
        let inside =
            a.left() >= 0.0 && a.top() >= 0.0 && a.right() <= 1000.0 && a.bottom() <= tree.size().height();
        assert!(inside, "{}: `{word}` leaves the page: {a:?}", figure.name);
        for (other, b) in &words[..i] {
            assert!(a.intersect(b).is_none(), "{}: `{word}` covers `{other}`", figure.name);
        }
    }
    // The characters that the subset was made of (fonts/LICENSE.txt).
    let known = |c: char| {
        matches!(c, '\n' | ' '..='~' | '\u{a0}'..='\u{17f}' | 'Α'..='Ω' | 'α'..='ω')
            || "–—‘’“”•…′″→∂∆∇∑−√∝∞∫≈≠≤≥".contains(c)
            || ('\u{2070}'..='\u{208e}').contains(&c)
    };
    assert_eq!(figure.svg.chars().find(|&c| !known(c)), None, "{}", figure.name);
}

/// Rows of a CSV: as many cells as the header has names, all of them finite numbers from the first numeric column on.
fn check_sheet(figure: &Figure, words: usize) {
    let mut lines = figure.csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let mut rows = 0;
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), names.len(), "{}: {line}", figure.name);
        assert!(
            cells[words..].iter().all(|c| c.parse::<f64>().unwrap().is_finite()),
            "{}: {line}",
            figure.name
        );
        rows += 1;
    }
    assert!(rows > 20, "{}", figure.name);
}

fn check_png(figure: &Figure) {
    let pixmap = Pixmap::decode_png(&figure.png().unwrap()).unwrap();
    assert!(pixmap.width() == crate::WIDTH_PX && pixmap.height() > 800, "{}", figure.name);
    let inked = pixmap.pixels().iter().filter(|p| (p.red(), p.green(), p.blue()) != (255, 255, 255)).count();
    assert!(inked * 50 > pixmap.pixels().len(), "{}: {inked} pixels are not white", figure.name);
}

/// Columns of a CSV of numbers by name.
fn columns<const N: usize>(figure: &Figure, wanted: [&str; N]) -> Vec<[f64; N]> {
    let mut lines = figure.csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let at = wanted.map(|w| names.iter().position(|n| *n == w).unwrap());
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            at.map(|i| cells[i].parse().unwrap())
        })
        .collect()
}

#[test]
fn every_figure_is_clean() {
    for name in NAMES.into_iter().filter(|n| *n != "phenomena") {
        let figure = draw(name);
        assert_eq!(figure.name, name);
        check_picture(&figure);
        check_sheet(&figure, usize::from(["fig4", "fig7"].contains(&name)));
        check_png(&figure);
    }
}

#[test]
fn the_same_model_gives_the_same_bytes() {
    for name in ["fig4", "profiles"] {
        let (a, b) = (draw(name), draw(name));
        assert!(a == b && a.png() == b.png(), "{name}");
    }
}

#[test]
fn every_height_can_be_drawn() {
    let model = model();
    for heights in [&[1.0][..], &[2000.0], &[33.3, 7.0, 120.0, 500.0, 33.3]] {
        let sources = Sources::new(&model, heights).unwrap();
        for name in ["fig3", "fig4", "fig5", "fig6", "fig7", "fig9", "fig11", "profiles"] {
            let figure = sources.draw(name).unwrap();
            check_picture(&figure);
            check_sheet(&figure, usize::from(["fig4", "fig7"].contains(&name)));
        }
    }
}

#[test]
fn mistakes_are_named() {
    let model = model();
    assert_eq!(Sources::new(&model, &[]).unwrap_err(), FiguresError::NoHeights);
    for bad in [0.0, -5.0, 5000.0, f64::NAN] {
        let error = Sources::new(&model, &[100.0, bad]).unwrap_err().to_string();
        assert!(error.contains("fog height_m"), "{error}");
    }
    let error = Sources::new(&model, &[100.0]).unwrap().draw("fig8").unwrap_err().to_string();
    assert!(
        error.contains("`fig8`") && error.contains("fig3, fig4") && error.contains("phenomena"),
        "{error}"
    );
}

#[test]
fn fig3_prints_the_papers_ratio_and_parts_add_up() {
    let figure = draw("fig3");
    for [l, g, sum] in columns(&figure, ["lognormal_1_m3_um", "gaussian_1_m3_um", "sum_1_m3_um"]) {
        assert!((l + g - sum).abs() <= 1e-12 * sum);
    }
    // L and G as the caption has them, to the rounding of the paper's 1.99 and 3.89.
    let number = |before: &str| {
        let rest = &figure.caption[figure.caption.find(before).unwrap() + before.len()..];
        rest.split('·').next().unwrap().parse::<f64>().unwrap()
    };
    assert!((number("G = ") / number("L = ") / (3.89 / 1.99) - 1.0).abs() < 5e-3);
}

#[test]
fn fig9_and_fig11_differ_from_the_gradient_as_the_paper_says() {
    // "Roughly 100 meters at 25 meters of observer altitude" (Sec. 6.2).
    for [altitude, model, gradient] in
        columns(&draw("fig9"), ["altitude_m", "visibility_model_m", "visibility_linear_gradient_m"])
    {
        if (altitude - 25.0).abs() < 0.1 {
            assert!((80.0..120.0).contains(&(gradient - model)), "{model} {gradient}");
        }
    }
    let at_base = columns(&draw("fig11"), ["altitude_m", "intensity_cd", "visibility_model_m"]);
    let ranges: Vec<f64> = at_base.iter().filter(|r| r[0] == 0.0).map(|r| r[2]).collect();
    assert!(ranges.len() == 3 && ranges.windows(2).all(|w| w[0] < w[1]), "{ranges:?}");
}

#[test]
fn phase_functions_are_normalised() {
    let rows = columns(&draw("phase"), ["angle_deg", "p_zeta_0.5_550_nm_1_sr", "p_zeta_0.5_1550_nm_1_sr"]);
    for column in [1, 2] {
        let cos = |row: &[f64; 3]| fog_core::math::f64::cos(row[0] * PI / 180.0);
        let sum: f64 =
            rows.windows(2).map(|w| PI * (w[0][column] + w[1][column]) * (cos(&w[0]) - cos(&w[1]))).sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum}");
    }
}

#[test]
fn drops_make_a_rainbow_and_shrinking_whitens_it() {
    let figure = draw("phenomena");
    check_picture(&figure);
    check_sheet(&figure, 0);
    check_png(&figure);
    let rows = columns(
        &figure,
        ["diameter_um", "angle_deg", "luminance_1_sr", "red_1_sr", "green_1_sr", "blue_1_sr"],
    );
    let of =
        |d: f64, from: f64, to: f64| rows.iter().filter(move |r| r[0] == d && (from..=to).contains(&r[1]));
    let brightest = |d, from, to| of(d, from, to).max_by(|a, b| a[2].total_cmp(&b[2])).unwrap()[1];
    // Descartes' angle of minimum deviation for n = 1.333 is 137.9°.
    assert!((brightest(1000.0, 132.0, 146.0) - 138.4).abs() < 0.6, "{}", brightest(1000.0, 132.0, 146.0));
    // The strongest colour of the bow: greatest spread of channels relative to the luminance.
    let colour =
        |d| of(d, 135.0, 147.0).map(|r| (r[3].max(r[5]) - r[3].min(r[5])) / r[2]).fold(0.0, f64::max);
    let (rain, drizzle, fog) = (colour(1000.0), colour(60.0), colour(10.0));
    assert!(rain > 1.5 * drizzle && drizzle > 1.5 * fog && fog < 0.5, "{rain} {drizzle} {fog}");
    // Half of the forward light's brightness: the aureole shrinks as drops grow.
    let half = |d| {
        let peak = of(d, 0.0, 0.0).next().unwrap()[2];
        of(d, 0.0, 15.0).find(|r| r[2] < 0.5 * peak).unwrap()[1]
    };
    assert!(
        half(5.0) > 1.8 * half(10.0) && half(10.0) > 1.8 * half(20.0),
        "{} {} {}",
        half(5.0),
        half(10.0),
        half(20.0)
    );
}

#[test]
fn a_fit_is_drawn_with_its_data() {
    let curve: Vec<[f64; 2]> = (1..60).map(|i| [0.5 * f64::from(i), 2e7 / (1.0 + f64::from(i))]).collect();
    let measured: Vec<[f64; 2]> = curve.iter().step_by(6).map(|&[d, n]| [d, 1.1 * n]).collect();
    let profile = |height_m, altitude_m| FitProfile {
        height_m,
        altitude_m,
        measured: &measured,
        fitted: &curve,
        model: if altitude_m > 50.0 { &curve } else { &[] },
    };
    let profiles: Vec<_> = [100.0, 180.0]
        .iter()
        .flat_map(|&h| (0..10).map(move |i| (h, f64::from(10 * i))))
        .map(|(h, z)| profile(h, z))
        .collect();
    let fits: Vec<[f64; 3]> =
        (0..=10).map(|i| [100.0, 0.1 * f64::from(i), 2.0 + 0.05 * f64::from(i % 3)]).collect();
    let parameter = FitParameter { name: "mu_l", label: "μ_L", fits: &fits, polynomial: &[2.0, 0.1] };
    let number: Vec<[f64; 2]> = (0..30).map(|i| [f64::from(i), 1e8]).collect();
    let numbers = [FitNumber { height_m: 100.0, measured: &number, model: &number }];
    let figures = fit_figures(&profiles, &[parameter; 5], &numbers).unwrap();
    let names: Vec<&str> = figures.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["spectra_100", "spectra_180", "parameters", "number_density"]);
    for (figure, words) in figures.iter().zip([1, 1, 2, 1]) {
        check_picture(figure);
        check_sheet(figure, words);
    }
    check_png(&figures[0]);
    assert!(figures[0].csv.contains("measured,100,0,0.5,11000000"), "{}", &figures[0].csv[..200]);
    // 11 dots in each of 5 panels and one in the legend.
    assert_eq!(figures[2].svg.matches("<circle").count(), 56);

    assert!(matches!(fit_figures(&[], &[], &[]), Err(FiguresError::FitData(_))));
    let broken = [[1.0, f64::NAN]];
    let error =
        fit_figures(&[FitProfile { fitted: &broken, ..profiles[0] }], &[], &[]).unwrap_err().to_string();
    assert!(error.contains("0 m of 100 m"), "{error}");
    let error =
        fit_figures(&[], &[FitParameter { polynomial: &[f64::INFINITY], ..parameter }], &[]).unwrap_err();
    assert!(error.to_string().contains("mu_l"), "{error}");
}

#[test]
fn a_real_fit_has_its_report_s_figures() {
    let settings = fog_optics::fit::synthetic::FlightSettings {
        heights_m: vec![100.0, 180.0],
        altitude_step_m: 20.0,
        ..fog_optics::fit::synthetic::FlightSettings::arcata()
    };
    let flights = fog_optics::fit::synthetic::measurements(&model(), &settings).unwrap();
    let fit = fog_optics::fit::fit(&flights, &fog_optics::fit::FitSettings::default(), &|_| ()).unwrap();
    let figures = fit_report(&fit).unwrap();
    let names: Vec<&str> = figures.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["spectra_100", "spectra_180", "parameters", "number_density"]);
    for (figure, words) in figures.iter().zip([1, 1, 2, 1]) {
        check_picture(figure);
        check_sheet(figure, words);
    }
}
