//! Layers: the paper's rules, scaling to a visibility, and states.

use fog_core::phase_grid;
use fog_optics::advection::AdvectionModel;
use fog_optics::catalogue;
use fog_optics::distribution::DiameterGrid;
use fog_optics::droplets::{DropletLayer, Spectra};
use fog_optics::error::OpticsError;
use fog_optics::layer::{self, FogLayer};
use fog_optics::layer_csv::parse_layers;
use fog_optics::state::FogState;
use fog_optics::table::{TableSettings, build, build_table};
use fog_optics::vertical::VerticalProfile;
use fog_optics::visibility::mor_m;
use std::sync::LazyLock;

static MODEL: LazyLock<AdvectionModel> = LazyLock::new(|| AdvectionModel::arcata().unwrap());
static TABLE: LazyLock<fog_core::optics_table::OpticsTable> = LazyLock::new(|| {
    let settings = TableSettings {
        zeta: (0..=8).map(|i| f64::from(i) / 8.0).collect(),
        wavelengths_nm: vec![500.0, 600.0],
        diameters: DiameterGrid::new(0.5, 60.0, 0.7).unwrap(),
    };
    build_table(&MODEL, &settings, &|_| ()).unwrap()
});

fn fog(height_m: f64) -> FogLayer {
    layer::advection(&TABLE, &MODEL, height_m, 1.0).unwrap()
}

#[test]
fn scaling_meets_the_range_asked_for_and_keeps_the_shape() {
    let fog = fog(180.0);
    for (mor, altitude) in [(300.0, 2.0), (50.0, 0.0), (1000.0, 180.0), (75.0, 91.3)] {
        let scaled = fog.scaled_to_mor(mor, altitude).unwrap();
        assert!((mor_m(scaled.sigma_t_at(altitude)) / mor - 1.0).abs() < 1e-12);
        let factor = fog.scale_for_mor(mor, altitude).unwrap();
        assert!((scaled.mean_sigma_t() / fog.mean_sigma_t() / factor - 1.0).abs() < 1e-12);
        let again = layer::advection(&TABLE, &MODEL, 180.0, factor).unwrap();
        assert!((again.sigma_t_at(60.0) / scaled.sigma_t_at(60.0) - 1.0).abs() < 1e-12);
    }
    assert!(matches!(fog.scaled_to_mor(0.0, 2.0), Err(OpticsError::Range { .. })));
    let above = fog.scaled_to_mor(300.0, 181.0).unwrap_err().to_string();
    assert!(above.contains("181") && above.contains("between 0 and 180"), "{above}");
}

#[test]
fn the_papers_simple_fogs_follow_from_the_layer() {
    let fog = fog(260.0);
    let profile = fog.profile(0.0).unwrap();
    let depth = profile.optical_depth_at(0.0, 1.0, 260.0, 550.0);
    assert!((fog.mean_sigma_t() / (depth / 260.0) - 1.0).abs() < 1e-12);
    let [low, high] = fog.min_max_sigma_t();
    assert!(low < fog.mean_sigma_t() && fog.mean_sigma_t() < high);

    let even = layer::homogeneous(260.0, fog.mean_sigma_t(), 1.0).unwrap().profile(0.0).unwrap();
    assert!((even.optical_depth_at(0.0, 1.0, 1e9, 700.0) / depth - 1.0).abs() < 1e-12);
    let gradient = layer::linear_gradient(260.0, low, high, 1.0).unwrap();
    assert!((gradient.sigma_t_at(130.0) / (0.5 * (low + high)) - 1.0).abs() < 1e-12);
    assert_eq!(gradient.min_max_sigma_t(), [low, high]);

    // Sec. 6.2: at 25 m in 260 m the horizontal visibilities are about 100 m apart (2 % threshold).
    let apart = 3.912 / gradient.sigma_t_at(25.0) - 3.912 / fog.sigma_t_at(25.0);
    assert!((60.0..140.0).contains(&apart), "{apart}");
}

#[test]
fn rows_become_a_layer() {
    let rows = parse_layers("altitude_m,sigma_t_1_m\n5,0.01\n15,0.03\n", "layers.csv").unwrap();
    let fog = layer::layered(&rows, 0.9).unwrap();
    assert_eq!(fog.extent_m(), [5.0, 15.0]);
    assert!((fog.sigma_t_at(10.0) - 0.02).abs() < 1e-15);
    assert_eq!((fog.sigma_t_at(4.9), fog.sigma_t_at(15.1)), (0.0, 0.0));
    assert_eq!((fog.albedo_at(15.0), fog.albedo_at(16.0)), (Some(0.9), None));
    assert!(layer::layered(&rows[..1], 1.0).is_err());
    assert!(layer::layered(&rows, 1.1).is_err());
    assert!(layer::layered(&[(0.0, 0.1), (0.0, 0.1)], 1.0).is_err());
    assert!(layer::homogeneous(-1.0, 0.1, 1.0).is_err());
    assert!(layer::homogeneous(10.0, f64::NAN, 1.0).is_err());
    assert!(layer::advection(&TABLE, &MODEL, 0.0, 1.0).is_err());
    assert!(layer::advection(&TABLE, &MODEL, 100.0, f64::NAN).is_err());
    assert!(fog.scaled(-1.0).is_err());
}

#[test]
fn a_named_fog_has_its_extinction_water_and_phase_function() {
    let named = catalogue::named("shettle_fenn_radiation_moderate").unwrap();
    let spectra = Spectra::Same(named.distribution.clone());
    let settings =
        TableSettings { wavelengths_nm: vec![450.0, 550.0, 650.0], ..TableSettings::visible_of(&spectra) };
    let table = build(&spectra, &settings, &|_| ()).unwrap();
    let thinning = VerticalProfile::thinning(1.0).unwrap();
    let fog = DropletLayer::new(spectra, thinning, named.number_density_1_m3, 40.0).unwrap();
    let layer = layer::droplets(&table, &fog);

    // Half way up, where a linear profile has its mean: the catalogue's fog itself.
    let optics = named.distribution.optics(550.0).unwrap();
    let sigma_t = named.number_density_1_m3 * optics.c_ext_m2;
    assert!((layer.sigma_t_at(20.0) / sigma_t - 1.0).abs() < 1e-9);
    assert!((layer.mean_sigma_t() / sigma_t - 1.0).abs() < 1e-9);
    assert!((layer.sigma_t_at(0.0) / sigma_t - 2.0).abs() < 1e-5 && layer.sigma_t_at(40.0) == 0.0);
    let state = FogState::droplets(&table, &fog, 20.0);
    assert!((state.sigma_t_550_1_m / sigma_t - 1.0).abs() < 1e-9);
    assert!((state.g.unwrap() - optics.g).abs() < 1e-12);
    assert!((state.liquid_water_content_g_m3.unwrap() / 0.0156 - 1.0).abs() < 5e-3);
    assert!((state.effective_radius_um.unwrap() - 3.0).abs() < 1e-3);
    assert!((state.number_density_1_m3.unwrap() / 2e8 - 1.0).abs() < 1e-5);

    // The table's phase function is normalised and has the g of the series.
    let (view, nodes) = (table.view(), phase_grid::nodes());
    let p = |i: usize| f64::from(view.phase_node(0, 1, i));
    assert!((phase_grid::integral(&nodes, p) - 1.0).abs() < 1e-5);
    assert!((phase_grid::mean_cosine(&nodes, p) - optics.g).abs() < 1e-4);
}

#[test]
fn states_say_what_is_known() {
    let inside = FogState::advection(&TABLE, &MODEL, 100.0, 1.0, 50.0).unwrap();
    assert!(inside.albedo.unwrap() > 0.9999 && inside.g.unwrap() > 0.8);
    assert!((inside.mor_m.unwrap() / mor_m(inside.sigma_t_550_1_m) - 1.0).abs() < 1e-15);
    assert!(inside.effective_radius_um.unwrap() > 0.5 * inside.mean_diameter_um.unwrap());
    let double = FogState::advection(&TABLE, &MODEL, 100.0, 2.0, 50.0).unwrap();
    assert_eq!(double.number_density_1_m3.unwrap(), 2.0 * inside.number_density_1_m3.unwrap());
    assert_eq!(double.effective_radius_um, inside.effective_radius_um);
    for outside in [-0.1, 100.1, f64::NAN] {
        let state = FogState::advection(&TABLE, &MODEL, 100.0, 1.0, outside).unwrap();
        assert_eq!(state, FogState::default());
    }
    assert!(FogState::advection(&TABLE, &MODEL, -5.0, 1.0, 2.0).is_err());

    let grey = layer::homogeneous(50.0, 0.05, 0.8).unwrap();
    let state = FogState::grey(&grey, Some(0.83), 10.0);
    assert_eq!((state.albedo, state.g, state.number_density_1_m3), (Some(0.8), Some(0.83), None));
    assert_eq!(FogState::grey(&grey, None, 51.0), FogState::default());
}
