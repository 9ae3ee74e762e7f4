//! What a fit must do: find a known fog again, survive bad data, refuse what cannot be fitted, never depend on threads.

use super::synthetic::{FlightSettings, flights};
use super::{
    BINS_MIN, Fit, FitSettings, Measurements, Observation, Quantity, Standing, fit, parse, write_counts,
};
use crate::advection::AdvectionModel;
use crate::error::OpticsError;
use fog_core::math::f64::exp;
use fog_core::random::PathRng;

fn arcata() -> AdvectionModel {
    AdvectionModel::arcata().unwrap()
}

/// Flights with bins of a width in µm from 1.5 to 46.5, of a volume in cm³.
fn settings(width_um: u32, volume_cm3: f64, seed: u64) -> FlightSettings {
    FlightSettings {
        bin_edges_um: (0..=45 / width_um).map(|i| 1.5 + f64::from(width_um * i)).collect(),
        sample_volume_m3: 1e-6 * volume_cm3,
        seed,
        ..FlightSettings::arcata()
    }
}

fn run(quantity: Quantity, rows: &[Observation]) -> Result<Fit, OpticsError> {
    fit(&Measurements::new("f.csv", quantity, rows)?, &FitSettings::default(), &|_| ())
}

/// Largest relative errors of μ_L, σ_L, μ_G, σ_G and G : L for ζ from 0.02 to 0.98, where there are data, and of N for ζ from
/// 0.05 to 0.95 at the measured heights.
fn errors(found: &Fit) -> [f64; 6] {
    let (truth, model) = (arcata(), &found.model);
    let mut worst = [0.0f64; 6];
    let mut note = |i: usize, found: f64, truth: f64| worst[i] = worst[i].max((found / truth - 1.0).abs());
    for i in 0..=48 {
        let zeta = 0.02 + 0.02 * f64::from(i);
        let (a, b) = (model.shape(zeta), truth.shape(zeta));
        note(0, a.mu_l, b.mu_l);
        note(1, a.sigma_l, b.sigma_l);
        note(2, a.mu_g, b.mu_g);
        note(3, a.sigma_g, b.sigma_g);
        note(4, a.gl_ratio, b.gl_ratio);
        let zeta = zeta.clamp(0.05, 0.95);
        for height in [100.0, 180.0, 260.0] {
            note(5, model.number_density_1_m3(zeta, height), truth.number_density_1_m3(zeta, height));
        }
    }
    worst
}

#[track_caller]
fn assert_within(found: &Fit, limits: [f64; 6]) {
    let worst = errors(found);
    assert!(worst.iter().zip(limits).all(|(w, l)| *w <= l), "{worst:?}\n{}", found.report_markdown());
}

#[test]
fn shipped_model_is_found_again_from_realistic_flights() {
    // Two approaches of 57 cm³ per 10 m: 1e4 to 4e4 droplets at an altitude.
    for (width, seed) in [(3, 1), (3, 2), (1, 1)] {
        let settings = FlightSettings {
            sample_volume_m3: FlightSettings::arcata().sample_volume_m3,
            ..settings(width, 1.0, seed)
        };
        let found = run(Quantity::Count, &flights(&arcata(), &settings).unwrap()).unwrap();
        assert_within(&found, [0.02, 0.02, 0.01, 0.03, 0.05, 0.02]);
        assert!(found.refined && found.warnings.is_empty(), "{:?}", found.warnings);
        assert!((found.dispersion - 1.0).abs() < 0.2 && found.number.r_squared > 0.995);
        assert_eq!((found.number.degrees.zeta, found.number.degrees.height), (4, 1));
        assert!(found.altitudes.iter().all(|a| !matches!(a.standing, Standing::Rejected(_))));
    }
}

#[test]
fn stages_alone_find_it_from_fine_bins() {
    let rows = flights(&arcata(), &settings(1, 57.0, 1)).unwrap();
    let data = Measurements::new("f", Quantity::Count, &rows).unwrap();
    let staged = fit(&data, &FitSettings { refine: false, ..FitSettings::default() }, &|_| ()).unwrap();
    assert!(!staged.refined && staged.degree_steps.is_empty());
    for shape in &staged.shapes {
        assert_eq!(shape.coefficients, shape.staged);
    }
    assert_within(&staged, [0.03, 0.03, 0.02, 0.05, 0.08, 0.03]);
}

#[test]
fn standard_errors_are_honest() {
    // The truth lies within a few of the stated errors, and not always within a small part of one.
    let rows = flights(&arcata(), &settings(3, 57.0, 3)).unwrap();
    let found = run(Quantity::Count, &rows).unwrap();
    let mut deviations = Vec::new();
    for (p, shape) in found.shapes.iter().enumerate() {
        for [zeta, value, error] in shape.curve.iter().copied().step_by(5) {
            let truth = arcata().shape(zeta).parameters()[p];
            deviations.push((value - truth).abs() / error);
        }
    }
    for [height, zeta, value, error] in found.number.curves.iter().copied().step_by(5) {
        deviations.push((value - arcata().number_density_1_m3(zeta, height)).abs() / error);
    }
    let most = deviations.iter().copied().fold(0.0, f64::max);
    let middle = super::linear::median(&deviations);
    assert!(most < 4.5 && middle > 0.1 && middle < 1.6, "{deviations:?}");
}

/// Takes away a tenth of the rows and five altitudes, and spoils a twentieth: five times too many and 20 more, or a fifth.
fn spoil(rows: &mut Vec<Observation>, seed: u64) -> usize {
    let mut random = PathRng::new(seed, 0, 0);
    rows.retain(|row| {
        let hole = row.fog_height_m == 180.0 && (60.0..110.0).contains(&row.altitude_m);
        random.uniform_f64() > 0.1 && !hole
    });
    let mut spoilt = 0;
    for row in rows {
        let u = random.uniform_f64();
        if u < 0.05 {
            row.value = if u < 0.025 { 5.0 * row.value + 20.0 } else { (0.2 * row.value).round() };
            spoilt += 1;
        }
    }
    spoilt
}

#[test]
fn gaps_and_outliers_are_survived() {
    for width in [3, 1] {
        let one = FlightSettings { approaches: 1, ..settings(width, 114.0, 4) };
        let mut rows = flights(&arcata(), &one).unwrap();
        let spoilt = spoil(&mut rows, 9);
        let found = run(Quantity::Count, &rows).unwrap();
        assert_within(&found, [0.04, 0.04, 0.02, 0.05, 0.10, 0.04]);
        let bad: usize = found.altitudes.iter().map(|a| a.bad_bins.len()).sum();
        assert!(bad > spoilt / 2 && bad <= spoilt + 5, "{bad} of {spoilt}");
        let report = found.report_markdown();
        assert!(report.contains("µm set aside |"), "{report}");
    }
}

#[test]
fn few_droplets_are_survived() {
    // A twelfth of the realistic volume: 1e3 to 3e3 droplets at an altitude.
    let found = run(Quantity::Count, &flights(&arcata(), &settings(3, 5.0, 2)).unwrap()).unwrap();
    assert_within(&found, [0.05, 0.10, 0.05, 0.10, 0.20, 0.08]);
}

#[test]
fn altitude_that_is_another_fog_is_rejected() {
    let mut rows = flights(&arcata(), &settings(3, 57.0, 5)).unwrap();
    // The spectrum of one altitude upside down: many large droplets.
    let of = |row: &Observation| row.fog_height_m == 260.0 && row.altitude_m == 125.0;
    let values: Vec<f64> = rows.iter().filter(|row| of(row)).map(|row| row.value).collect();
    for (row, value) in rows.iter_mut().filter(|row| of(row)).zip(values.into_iter().rev()) {
        row.value = value;
    }
    // And one that is three times as dense, with the right shape.
    for row in rows.iter_mut().filter(|row| row.fog_height_m == 180.0 && row.altitude_m == 95.0) {
        row.sample_volume_m3 = row.sample_volume_m3.map(|volume| volume / 3.0);
    }
    let found = run(Quantity::Count, &rows).unwrap();
    let at = |height: f64, altitude: f64| {
        let here =
            |a: &&super::AltitudeFit| a.spectrum.fog_height_m == height && a.spectrum.altitude_m == altitude;
        found.altitudes.iter().find(here).unwrap()
    };
    assert!(matches!(at(260.0, 125.0).standing, Standing::Rejected(_)), "{:?}", at(260.0, 125.0).standing);
    assert!(at(180.0, 95.0).number_rejected);
    assert_eq!(found.altitudes.iter().filter(|a| a.number_rejected).count(), 1);
    assert_within(&found, [0.02, 0.03, 0.01, 0.03, 0.06, 0.025]);
    assert!(found.report_markdown().contains("| 260 | 125 | rejected |"));
    assert!(found.fits_csv().lines().any(|line| line.starts_with("260,125,0.4807692,rejected,")));
}

#[test]
fn densities_without_volumes_are_fitted_and_marked() {
    let mut rows = flights(&arcata(), &FlightSettings { approaches: 1, ..settings(3, 114.0, 1) }).unwrap();
    for row in &mut rows {
        row.value /= row.sample_volume_m3.unwrap() * (row.high_um - row.low_um);
        row.sample_volume_m3 = None;
    }
    let found = run(Quantity::Density, &rows).unwrap();
    assert_within(&found, [0.02, 0.02, 0.01, 0.03, 0.05, 0.02]);
    assert!(!found.counting_noise_known && found.warnings.iter().any(|w| w.contains("no sampled volumes")));
    // A droplet counted stands for 1/114 cm³: that is the variance it finds.
    assert!((found.dispersion * 114e-6 - 1.0).abs() < 0.25, "{}", found.dispersion);
}

#[test]
fn one_height_gives_a_density_without_height() {
    let rows =
        flights(&arcata(), &FlightSettings { heights_m: vec![180.0], ..settings(3, 57.0, 1) }).unwrap();
    let found = run(Quantity::Count, &rows).unwrap();
    assert!(found.warnings.iter().any(|w| w.contains("only one fog height (180 m)")), "{:?}", found.warnings);
    assert!(found.number.coefficients.iter().all(|row| row.len() == 1));
    let n = |height| found.model.number_density_1_m3(0.6, height);
    assert_eq!(n(100.0), n(180.0));
    assert!((n(180.0) / arcata().number_density_1_m3(0.6, 180.0) - 1.0).abs() < 0.02);
    assert!(found.model.extrapolates(170.0));
}

#[test]
fn part_of_a_layer_is_marked_as_extrapolated() {
    let mut rows = flights(&arcata(), &settings(3, 57.0, 1)).unwrap();
    rows.retain(|row| row.altitude_m > 0.3 * row.fog_height_m && row.low_um > 4.0);
    let found = run(Quantity::Count, &rows).unwrap();
    assert!(
        found.warnings.iter().any(|w| w.contains("the model extrapolates beyond")),
        "{:?}",
        found.warnings
    );
    assert!(
        found.warnings.iter().any(|w| w.contains("outside of the measured diameters")),
        "{:?}",
        found.warnings
    );
}

#[test]
fn result_does_not_depend_on_threads_or_order() {
    let mut rows = flights(&arcata(), &settings(3, 57.0, 1)).unwrap();
    spoil(&mut rows, 3);
    let with = |threads: usize, rows: &[Observation]| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(Quantity::Count, rows)).unwrap()
    };
    let found = with(1, &rows);
    assert_eq!(found, with(3, &rows));
    let read = parse(&write_counts(&rows, ""), "f.csv").unwrap();
    let again = fit(&read, &FitSettings::default(), &|_| ()).unwrap();
    assert_eq!(found.model_yaml, again.model_yaml);
    rows.reverse();
    assert_eq!(found.model_yaml, with(2, &rows).model_yaml);
}

#[test]
fn model_file_is_read_back() {
    let found = run(Quantity::Count, &flights(&arcata(), &settings(3, 57.0, 1)).unwrap()).unwrap();
    let read = AdvectionModel::from_yaml(&found.model_yaml).unwrap();
    assert_eq!(read, found.model);
    assert_eq!(read.measured_heights_m(), [100.0, 180.0, 260.0]);
    assert_eq!(read.diameters().bounds_um()[..1], [0.5]);
    for shape in &found.shapes {
        for [zeta, value, _] in &shape.curve {
            let p = super::SHAPE_KEYS.iter().position(|key| *key == shape.key).unwrap();
            assert!((read.shape(*zeta).parameters()[p] - value).abs() < 1e-12);
        }
    }
    for [height, zeta, value, _] in &found.number.curves {
        assert!((read.number_density_1_m3(*zeta, *height) / value - 1.0).abs() < 1e-6);
    }
    assert!(found.model_yaml.starts_with("# Fog model fitted by `fogbank fit` to f.csv.\n"));
    let wide = FitSettings { diameter_range_um: Some([1.0, 80.0]), ..FitSettings::default() };
    let data =
        Measurements::new("f", Quantity::Count, &flights(&arcata(), &settings(3, 57.0, 1)).unwrap()).unwrap();
    let wide = fit(&data, &wide, &|_| ()).unwrap().model;
    assert!((wide.diameters().bounds_um()[1] - 80.0).abs() < 1e-9);
}

#[test]
fn tables_have_a_row_for_everything() {
    let found = run(Quantity::Count, &flights(&arcata(), &settings(3, 57.0, 1)).unwrap()).unwrap();
    let lines = |text: &str| text.lines().map(|line| line.split(',').count()).collect::<Vec<_>>();
    let fits = lines(&found.fits_csv());
    assert!(fits.len() == 55 && fits.iter().all(|cells| *cells == fits[0]), "{fits:?}");
    assert_eq!(lines(&found.parameters_csv()).len(), 1 + 21 * 5 + 21 * 3);
    let spectra = found.spectra_csv();
    assert!(lines(&spectra).len() == 811 && lines(&spectra).iter().all(|cells| *cells == 10));
    // Own fit = lognormal + Gaussian, near what was measured where many droplets were.
    for line in spectra.lines().skip(1) {
        let x: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap_or(0.0)).collect();
        assert!((x[6] - x[7] - x[8]).abs() <= 1e-5 * x[6], "{line}");
        let near = |fitted: f64, share: f64| x[4] < 1e7 || (fitted / x[4] - 1.0).abs() < share;
        // Altitudes whose counts do not determine all parameters have no fit of their own.
        assert!((line.contains(",,") || near(x[6], 0.1)) && near(x[9], 0.15), "{line}");
    }
    let own = found.altitudes[4].own.unwrap();
    assert!(own.rrse < 0.02 && own.agreeing_starts >= 3 && own.converged);
    let [lognormal, gaussian] = own.parts_1_m3_um(8.0);
    let whole = own.number_density_1_m3 * own.shape.density_1_um(8.0);
    assert!(((lognormal + gaussian) / whole - 1.0).abs() < 1e-12);
    let summary = found.summary();
    assert!(summary.contains("54 altitudes") && summary.contains("degree 4 and 1"), "{summary}");
}

#[test]
fn what_cannot_be_fitted_is_refused_with_a_reason() {
    let rows = flights(&arcata(), &settings(3, 57.0, 1)).unwrap();
    let refuse = |rows: Vec<Observation>, what: &str| {
        let message = run(Quantity::Count, &rows).unwrap_err().to_string();
        assert!(message.starts_with("f.csv: ") && message.contains(what), "{message}");
    };
    let part = |keep: &dyn Fn(&Observation) -> bool| rows.iter().filter(|row| keep(row)).copied().collect();
    refuse(
        part(&|row| row.low_um < 19.0),
        &format!("too few bins: at most 6 at an altitude; six parameters need at least {BINS_MIN}"),
    );
    refuse(part(&|row| row.fog_height_m == 260.0 && row.altitude_m > 230.0), "too few altitudes: 3 of 3");
    refuse(rows.iter().map(|row| Observation { value: 0.0, ..*row }).collect(), "no droplets");
    let one_bin =
        |row: &Observation| Observation { value: if row.low_um == 7.5 { row.value } else { 0.0 }, ..*row };
    refuse(rows.iter().map(one_bin).collect(), "too few altitudes: 0 of 54");

    let data = Measurements::new("f", Quantity::Count, &rows).unwrap();
    for (bad, what) in [
        (FitSettings { max_shape_degree: 7, ..FitSettings::default() }, "degree of shapes is 7"),
        (FitSettings { max_number_degree: 9, ..FitSettings::default() }, "number density is 9"),
        (FitSettings { max_height_degree: 4, ..FitSettings::default() }, "over height is 4"),
        (FitSettings { folds: 1, ..FitSettings::default() }, "folds is 1"),
        (FitSettings { outlier_mads: 2.0, ..FitSettings::default() }, "deviations is 2"),
        (FitSettings { diameter_range_um: Some([60.0, 0.5]), ..FitSettings::default() }, "diameter_range_um"),
    ] {
        let message = fit(&data, &bad, &|_| ()).unwrap_err().to_string();
        assert!(message.contains(what), "{message}");
    }
}

/// Counts that are no fog at all: refused or fitted, but never a panic or a model that is no number.
#[test]
fn nonsense_does_no_harm() {
    let mut random = PathRng::new(77, 0, 0);
    let places: Vec<Observation> =
        flights(&arcata(), &FlightSettings { approaches: 1, altitude_step_m: 20.0, ..settings(3, 57.0, 1) })
            .unwrap();
    let mut make = |value: &mut dyn FnMut(&Observation, f64) -> f64| -> Vec<Observation> {
        places
            .iter()
            .map(|row| Observation { value: value(row, random.uniform_f64()).floor(), ..*row })
            .collect()
    };
    let sets = [
        make(&mut |_, _| 7.0),
        make(&mut |_, u| 1000.0 * u),
        make(&mut |_, u| exp(30.0 * u)),
        make(&mut |_, _| 1e15),
        make(&mut |_, u| if u < 0.3 { 1.0 } else { 0.0 }),
        make(&mut |row, u| if row.low_um < 3.0 { 1e6 * u } else { 1.0 }),
        make(&mut |row, u| if (row.low_um - 25.5).abs() < 5.0 { 1e5 } else { u }),
        make(&mut |row, _| 1e4 * row.altitude_m / (1.0 + row.low_um)),
        make(&mut |row, u| if row.altitude_m < 60.0 { 1e3 * u } else { 0.0 }),
    ];
    for (i, rows) in sets.iter().enumerate() {
        match run(Quantity::Count, rows) {
            Err(error) => assert!(error.to_string().len() > 10, "{i}"),
            Ok(found) => {
                for zeta in [0.0, 0.3, 1.0] {
                    let n = found.model.number_density_1_m3(zeta, 150.0);
                    assert!(
                        n.is_finite() && found.model.moments(zeta).mass_g.is_finite(),
                        "{i}: {}",
                        found.model_yaml
                    );
                }
                assert!(!found.report_markdown().contains("NaN"), "{i}: {}", found.report_markdown());
            }
        }
    }
}
