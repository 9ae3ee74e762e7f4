//! The layer of the model against `tests/data/fog_profile.csv`, made independently, and the table behind it.

use fog_core::math::PI;
use fog_core::optics_table::OpticsTable;
use fog_core::phase_grid;
use fog_optics::advection::AdvectionModel;
use fog_optics::distribution::DiameterGrid;
use fog_optics::layer;
use fog_optics::mie::efficiencies;
use fog_optics::polydisperse::{DropletSpectra, average};
use fog_optics::state::FogState;
use fog_optics::table::{TableSettings, build_table};
use fog_optics::water;
use std::sync::Mutex;

const REFERENCE: &str = include_str!("../../../tests/data/fog_profile.csv");

fn at_550(model: &AdvectionModel) -> OpticsTable {
    let settings = TableSettings { wavelengths_nm: vec![550.0], ..TableSettings::visible(model) };
    build_table(model, &settings, &|_| ()).unwrap()
}

#[test]
fn every_row_of_the_reference_profile_agrees() {
    let model = AdvectionModel::arcata().unwrap();
    let table = at_550(&model);
    let mut worst = [0.0f64; 5];
    for line in REFERENCE.lines().skip(1) {
        let v: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let (height, altitude) = (v[0], v[1]);
        let state = FogState::advection(&table, &model, height, 1.0, altitude).unwrap();
        let layer = layer::advection(&table, &model, height, 1.0).unwrap();
        let pairs = [
            (state.number_density_1_m3.unwrap(), v[5]),
            (state.liquid_water_content_g_m3.unwrap(), v[6]),
            (state.sigma_t_550_1_m, v[7]),
            (state.sigma_t_550_1_m * state.albedo.unwrap(), v[8]),
            (state.g.unwrap(), v[9]),
        ];
        for (worst, (got, want)) in worst.iter_mut().zip(pairs) {
            *worst = worst.max((got / want - 1.0).abs());
        }
        // The rendered profile says the same as the recorded state.
        let profile = layer.profile(7.0).unwrap();
        let sigma = profile.sigma_t_at(7.0 + altitude, 550.0);
        assert!((sigma / state.sigma_t_550_1_m - 1.0).abs() < 2e-5, "{height} {altitude}: {sigma}");
    }
    println!(
        "worst relative error: N {:e}, LWC {:e}, σ_t {:e}, σ_s {:e}, g {:e}",
        worst[0], worst[1], worst[2], worst[3], worst[4]
    );
    let [n, lwc, sigma_t, sigma_s, g] = worst;
    assert!(n < 1e-6 && lwc < 1e-6 && g < 2e-4, "{worst:?}");
    assert!(sigma_t < 1e-3 && sigma_s < 1e-3, "{worst:?}"); // Mie ripple: the reference expects 0.1 %
}

#[test]
fn between_rows_sigma_equals_direct_integration() {
    let model = AdvectionModel::arcata().unwrap();
    let table = at_550(&model);
    let m = water::refractive_index(550.0).unwrap();
    let layer = layer::advection(&table, &model, 180.0, 1.0).unwrap();
    let mut worst = 0.0f64;
    for zeta in [0.004, 0.0157, 0.11, 0.333, 0.48, 0.77, 0.95, 0.9911] {
        let direct = model.diameters().integrate(|d| {
            let q = efficiencies(m, PI * d / 0.55).unwrap();
            model.density_1_m3_um(d, zeta, 180.0) * q.q_ext * 0.25 * PI * d * d * 1e-12
        });
        worst = worst.max((layer.sigma_t_at(180.0 * zeta) / direct - 1.0).abs());
    }
    println!("worst relative error of σ_t between nodes: {worst:e}");
    assert!(worst < 1e-4, "{worst:e}");
}

#[test]
fn energy_closes_in_the_table() {
    let model = AdvectionModel::arcata().unwrap();
    let zeta = [0.0, 0.5, 1.0];
    let spectra =
        DropletSpectra::new(&zeta, model.diameters(), |z, d| model.shape(z).density_1_um(d)).unwrap();
    let parts = average(&spectra, &[400.0, 550.0, 780.0], &|_| ()).unwrap();
    let nodes = phase_grid::nodes();
    let (mut worst_norm, mut worst_g) = (0.0f64, 0.0f64);
    for cell in 0..9 {
        let p = &parts.phase[cell * phase_grid::NODES..(cell + 1) * phase_grid::NODES];
        let norm = phase_grid::integral(&nodes, |i| p[i]);
        let g = phase_grid::mean_cosine(&nodes, |i| p[i]) / norm;
        worst_norm = worst_norm.max((norm - 1.0).abs());
        worst_g = worst_g.max((g - parts.g[cell]).abs());
        assert!(parts.c_sca_m2[cell] <= parts.c_ext_m2[cell]);
    }
    println!("|∫p − 1| {worst_norm:e}, |∫p cosθ − g| {worst_g:e}");
    assert!(worst_norm < 2e-4 && worst_g < 2e-4, "{worst_norm} {worst_g}");
}

#[test]
fn mixture_of_one_droplet_is_that_droplet() {
    // The vectorised kernel (S1 ± S2, shared recursion) against the direct sums of `amplitudes`.
    let grid = DiameterGrid::new(9.0, 12.0, 1.0).unwrap();
    let spectra = DropletSpectra::new(&[0.0], &grid, |_, d| if d == 11.0 { 1.0 } else { 0.0 }).unwrap();
    let parts = average(&spectra, &[550.0], &|_| ()).unwrap();
    let m = water::refractive_index(550.0).unwrap();
    let x = PI * 11.0 / 0.55;
    let series = fog_optics::mie::MieSeries::new(m, x).unwrap();
    let q = series.efficiencies();
    for (s, p) in series.amplitudes(&phase_grid::cosines()).iter().zip(&parts.phase) {
        let want = (s.s1.norm_sqr() + s.s2.norm_sqr()) / (2.0 * PI * x * x * q.q_sca);
        assert!((p / want - 1.0).abs() < 1e-9, "{p} {want}");
    }
    assert!((parts.c_ext_m2[0] / (q.q_ext * 0.25 * PI * 121e-12) - 1.0).abs() < 1e-14);
}

#[test]
fn bytes_do_not_depend_on_the_number_of_threads() {
    let model = AdvectionModel::arcata().unwrap();
    let settings = TableSettings {
        zeta: vec![0.0, 0.5, 1.0],
        wavelengths_nm: vec![450.0, 600.0],
        diameters: DiameterGrid::new(0.5, 60.0, 0.7).unwrap(),
    };
    let shares = Mutex::new(Vec::new());
    let build = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| build_table(&model, &settings, &|done| shares.lock().unwrap().push(done)).unwrap())
    };
    let one = build(1);
    for threads in [2, 3, 7] {
        assert!(one.as_bytes() == build(threads).as_bytes(), "{threads} threads");
    }
    assert_eq!(shares.lock().unwrap()[..2], [0.5, 1.0]);
}
