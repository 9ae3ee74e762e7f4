//! Phase functions of the library: normalised, sampled as they say, with the mean that they say.

use fog_core::phase::{Draine, HenyeyGreenstein};
use fog_core::random::PathRng;
use fog_core::spectrum::{LaneWeights, Wavelengths};
use fog_core::{math, phase_grid};
use fog_optics::advection::AdvectionModel;
use fog_optics::distribution::DiameterGrid;
use fog_optics::droplet_table;
use fog_optics::droplets::Spectra;
use fog_optics::phase_function::PhaseFunction;
use fog_optics::table::{TableSettings, build_table};
use fog_tests::chi_square::assert_follows;

const SAMPLES: u32 = 200_000;

/// Masses of the intervals of the angular grid by Simpson's rule on four pieces of each, and the mean cosine.
fn masses(p: &PhaseFunction) -> (Vec<f64>, f64) {
    let nodes = phase_grid::nodes();
    let mut cosine = 0.0;
    let masses = nodes.windows(2).map(|w| {
        let h = 0.25 * (w[1] - w[0]);
        let piece = |k: i32| {
            let x = w[0] + h * f64::from(k);
            let p = [p.eval(x), p.eval(x + 0.5 * h), p.eval(x + h)];
            let m = [x, x + 0.5 * h, x + h];
            let weights = [1.0, 4.0, 1.0].map(|weight| math::TAU * h / 6.0 * weight);
            let sum = |f: &dyn Fn(usize) -> f64| (0..3).map(|i| weights[i] * f(i)).sum::<f64>();
            (sum(&|i| p[i]), sum(&|i| p[i] * (1.0 - m[i])))
        };
        let pieces: Vec<(f64, f64)> = (0..4).map(piece).collect();
        cosine += pieces.iter().map(|p| p.1).sum::<f64>();
        pieces.iter().map(|p| p.0).sum::<f64>()
    });
    (masses.collect(), cosine)
}

fn check(name: &str, p: &PhaseFunction, family: usize) {
    let (masses, cosine) = masses(p);
    let total: f64 = masses.iter().sum();
    assert!((total - 1.0).abs() < 1e-4, "{name} integrates to {total}");
    assert!((cosine - p.mean_cosine()).abs() < 1e-4, "{name}: {cosine} for {}", p.mean_cosine());
    // Cells of about equal probability, cut at nodes of the grid.
    let nodes = phase_grid::nodes();
    let (mut edges, mut expected, mut mass) = (vec![], vec![], 0.0);
    for (i, m) in masses.iter().enumerate() {
        mass += m;
        if mass > 0.02 || i + 1 == masses.len() {
            edges.push(nodes[i + 1]);
            expected.push(mass * f64::from(SAMPLES));
            mass = 0.0;
        }
    }
    let mut observed = vec![0u64; expected.len()];
    let mut rng = PathRng::new(51, 0, 0);
    for _ in 0..SAMPLES {
        let m = p.sample(rng.uniform_f64(), rng.uniform_f64());
        assert_eq!(p.pdf(m), p.eval(m));
        observed[edges.partition_point(|&e| e <= m).min(edges.len() - 1)] += 1;
    }
    assert_follows(name, &observed, &expected, family);
}

#[test]
fn closed_forms() {
    let gs = [0.0, 1e-7, 0.83, -0.4];
    let diameters = [0.05, 0.7, 3.0, 12.0, 50.0];
    for g in gs {
        check(&format!("Henyey-Greenstein {g}"), &PhaseFunction::henyey_greenstein(g).unwrap(), 10);
    }
    for d in diameters {
        check(&format!("jendersie_deon {d} µm"), &PhaseFunction::jendersie_deon(d).unwrap(), 10);
    }
    let (hg, draine) = (HenyeyGreenstein::new(0.0).unwrap(), Draine::new(-0.6, 30.0).unwrap());
    let mixture = fog_core::phase::HgDraine::new(hg, draine, 0.9).unwrap();
    check("backward Draine", &PhaseFunction::HgDraine(mixture), 10);
}

#[test]
fn mie_tables() {
    let model = AdvectionModel::arcata().unwrap();
    let settings = TableSettings {
        zeta: vec![0.0, 0.5, 1.0],
        wavelengths_nm: vec![400.0, 550.0, 700.0],
        ..TableSettings::visible(&model)
    };
    let table = build_table(&model, &settings, &|_| ()).unwrap();
    for row in 0..3 {
        for (column, nm) in [(Some(0), 400.0), (None, 475.0), (Some(1), 550.0), (Some(2), 700.0)] {
            let p = PhaseFunction::mie(&table, row, nm).unwrap();
            check(&format!("polydisperse row {row} at {nm} nm"), &p, 13);
            if let Some(column) = column {
                // The grid of angles gives the mean cosine of the Mie series.
                let g = table.view().g[row * 3 + column];
                assert!((p.mean_cosine() - g).abs() < 1e-4, "row {row}, {nm} nm: {} {g}", p.mean_cosine());
            }
        }
    }
    check("mean diameter", &PhaseFunction::mean_diameter(&model, 550.0).unwrap(), 13);
}

#[test]
fn diameters_are_drawn_by_their_odds() {
    let spectra = Spectra::Advection(AdvectionModel::arcata().unwrap());
    let (grid, nm) = (DiameterGrid::new(1.0, 30.0, 0.5).unwrap(), [380.0, 550.0, 780.0]);
    let single = droplet_table::build(&grid, &nm, &|_| ()).unwrap();
    let choice = droplet_table::choice(&single, &grid, &[0.0, 1.0], &spectra).unwrap();
    for (k, hero) in [380.0f32, 465.0, 700.0].into_iter().enumerate() {
        let lanes = LaneWeights::new(&nm, &Wavelengths::monochromatic(hero));
        let (lower, t) = (lanes.index[0] as usize, f64::from(lanes.weight[0]));
        for row in 0..2 {
            let (a, b) = (choice.probabilities(row, lower), choice.probabilities(row, lower + 1));
            let mixed = a.iter().zip(&b).map(|(a, b)| a + (b - a) * t);
            let expected: Vec<f64> = mixed.map(|p| p * f64::from(SAMPLES)).collect();
            let mut observed = vec![0u64; expected.len()];
            let mut rng = PathRng::new(61, k as u64, row as u64);
            for _ in 0..SAMPLES {
                observed[choice.sample(row, &lanes, rng.uniform_f64(), rng.uniform()).row] += 1;
            }
            assert_follows(&format!("diameters at {hero} nm, row {row}"), &observed, &expected, 6);
        }
    }
}
