//! Random spectra, vertical profiles and advection models: never NaN, never negative, quantiles and optical depths that
//! never fall, and a reason for whatever is refused. The seed is fixed, so that every run tries the same cases.

use fog_core::optics_table::OpticsTable;
use fog_optics::advection::{AdvectionModel, HEIGHT_RANGE_M};
use fog_optics::distribution::{DiameterGrid, SpectrumShape};
use fog_optics::droplets::{self, DropletLayer, Spectra};
use fog_optics::error::OpticsError;
use fog_optics::layer;
use fog_optics::size::{LognormalMode, ModifiedGamma, SizeDistribution};
use fog_optics::state::FogState;
use fog_optics::table::{TableSettings, build};
use fog_optics::vertical::VerticalProfile;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

fn config(cases: u32) -> Config {
    Config { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(20_240_422), ..Config::default() }
}

type Made = Result<SizeDistribution, OpticsError>;

/// A number spread evenly over the decades of a range.
fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    let ln = fog_core::math::f64::ln;
    (ln(low)..=ln(high)).prop_map(fog_core::math::f64::exp)
}

fn gamma() -> impl Strategy<Value = Made> {
    (decades(0.01, 500.0), decades(0.001, 0.33)).prop_map(|(r, v)| SizeDistribution::gamma(r, v))
}

fn modified_gamma() -> impl Strategy<Value = Made> {
    (decades(0.01, 1000.0), decades(0.02, 100.0), decades(0.25, 8.0)).prop_map(|(alpha, mode, gamma)| {
        SizeDistribution::modified_gamma(ModifiedGamma::from_mode(alpha, gamma, mode)?)
    })
}

fn lognormals() -> impl Strategy<Value = Made> {
    let mode = (decades(1e-3, 1e3), decades(0.02, 500.0), 1.02..4.0f64)
        .prop_map(|(share, d, sd)| LognormalMode { share, median_diameter_um: d, geometric_sd: sd });
    prop::collection::vec(mode, 1..5).prop_map(|modes| SizeDistribution::lognormals(&modes))
}

fn lognormal_gaussian() -> impl Strategy<Value = Made> {
    (0.5..4.0, 0.05..1.5, 1.0..30.0, 0.2..6.0, 0.0..20.0).prop_map(|(mu_l, sigma_l, mu_g, sigma_g, r)| {
        let shape = SpectrumShape { mu_l, sigma_l, mu_g, sigma_g, gl_ratio: r };
        SizeDistribution::lognormal_gaussian(shape, DiameterGrid::fine([0.5, 60.0])?)
    })
}

/// Steps between diameters and numbers, some of them 0.
fn measured() -> impl Strategy<Value = Made> {
    let number = prop_oneof![Just(0.0), decades(1e-3, 1e9)];
    let steps = prop::collection::vec((decades(0.05, 5.0), number), 2..20);
    (decades(0.01, 5.0), steps, any::<bool>()).prop_map(|(first, steps, bins)| {
        let mut edges = vec![first];
        edges.extend(steps.iter().scan(first, |d, step| {
            *d += step.0;
            Some(*d)
        }));
        let numbers: Vec<f64> = steps.iter().map(|step| step.1).collect();
        if bins {
            return SizeDistribution::binned(&edges, &numbers);
        }
        SizeDistribution::tabulated(&edges.into_iter().skip(1).zip(numbers).collect::<Vec<_>>())
    })
}

fn distribution() -> impl Strategy<Value = Made> {
    prop_oneof![gamma(), modified_gamma(), lognormals(), lognormal_gaussian(), measured()]
}

fn profile() -> impl Strategy<Value = VerticalProfile> {
    let rows = prop::collection::vec((0.01..1.0f64, 0.0..1e9f64), 2..8).prop_filter_map("empty", |steps| {
        let total: f64 = steps.iter().map(|step| step.0).sum();
        let mut zeta = 0.0;
        let rows: Vec<(f64, f64)> = (steps.iter())
            .map(|step| {
                zeta += step.0 / total;
                (zeta.min(1.0), step.1)
            })
            .collect();
        VerticalProfile::rows(&rows).ok()
    });
    prop_oneof![
        Just(VerticalProfile::uniform()),
        (0.1..10.0f64).prop_filter_map("range", |p| VerticalProfile::thinning(p).ok()),
        rows
    ]
}

/// Text of a model with random polynomials, of which some make no sense.
fn model_text() -> impl Strategy<Value = String> {
    let polynomial = |low: f64, high: f64, slope: f64| {
        (low..high, prop::collection::vec(-slope..slope, 0..4)).prop_map(|(c0, rest)| {
            let mut text = format!("[{c0}");
            rest.iter().for_each(|c| text.push_str(&format!(", {c}")));
            text + "]"
        })
    };
    let numbers = prop::collection::vec((-1e9..1e9f64, -1e7..1e7f64), 1..6);
    (
        polynomial(0.5, 3.0, 0.5),
        polynomial(0.1, 1.2, 0.4),
        polynomial(2.0, 20.0, 10.0),
        polynomial(0.5, 5.0, 2.0),
        polynomial(-2.0, 2.0, 2.0),
        numbers,
    )
        .prop_map(|(mu_l, sigma_l, mu_g, sigma_g, ratio, numbers)| {
            let rows: String = numbers.iter().map(|(a, b)| format!("  - [{a}, {b}]\n")).collect();
            format!(
                "diameter_range_um: [0.5, 60.0]\nmeasured_fog_heights_m: [100, 260]\nmu_L: {mu_l}\nsigma_L: {sigma_l}\n\
                 mu_G: {mu_g}\nsigma_G: {sigma_g}\nln_gl_ratio: {ratio}\nnumber_density:\n{rows}\
                 number_density_scale: 1.0\n"
            )
        })
}

fn table(spectra: &Spectra) -> OpticsTable {
    let mut settings = TableSettings::visible_of(spectra);
    settings.wavelengths_nm = vec![550.0];
    if let Spectra::Advection(_) = spectra {
        settings.zeta = (0..=8).map(|i| f64::from(i) / 8.0).collect();
        settings.diameters = DiameterGrid::new(0.5, 60.0, 1.7).unwrap();
    }
    build(spectra, &settings, &|_| ()).unwrap()
}

fn check_fog(fog: &DropletLayer, table: &OpticsTable) -> Result<(), TestCaseError> {
    let layer = layer::droplets(table, fog);
    let profile = layer.profile(12.5).unwrap();
    let height = fog.height_m();
    let mut depth_below = 0.0;
    for i in 0..=50 {
        let altitude = height * (f64::from(i) / 50.0);
        let (sigma, n) = (layer.sigma_t_at(altitude), fog.number_density_1_m3(altitude / height));
        prop_assert!(sigma.is_finite() && sigma >= 0.0 && n.is_finite() && n >= 0.0, "{sigma} {n}");
        let depth = profile.optical_depth_at(12.5, 1.0, altitude, 550.0);
        prop_assert!(depth.is_finite() && depth >= depth_below, "{depth} over {depth_below} at {altitude} m");
        depth_below = depth;
        let state = FogState::droplets(table, fog, altitude);
        let known = [
            Some(state.sigma_t_550_1_m),
            state.albedo,
            state.g,
            state.mor_m,
            state.liquid_water_content_g_m3,
            state.number_density_1_m3,
            state.effective_radius_um,
            state.mean_diameter_um,
        ];
        prop_assert!(known.iter().flatten().all(|x| x.is_finite() && *x >= 0.0), "{state:?}");
        prop_assert!(state.albedo.is_none_or(|a| a <= 1.0) && state.g.is_none_or(|g| g <= 1.0), "{state:?}");
    }
    for outside in [-1e-3 * height, 1.001 * height, f64::NAN] {
        prop_assert_eq!(FogState::droplets(table, fog, outside), FogState::default());
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(400))]

    #[test]
    fn spectra_are_whole_or_refused_with_a_reason(made in distribution()) {
        let distribution = match made {
            Ok(distribution) => distribution,
            Err(error) => {
                prop_assert!(error.to_string().len() > 20, "{error}");
                return Ok(());
            }
        };
        let m = distribution.moments();
        prop_assert!(m.share_in_range > 1e-3 && m.share_in_range < 1.002, "{m:?}");
        prop_assert!(m.mass_g > 0.0 && m.mass_g.is_finite() && m.effective_variance.is_finite(), "{m:?}");
        let [low, high] = distribution.grid().range_um();
        prop_assert!(low <= m.mean_diameter_um && m.mean_diameter_um <= 2.0 * m.effective_radius_um * (1.0 + 1e-12), "{m:?}");
        prop_assert!(2.0 * m.effective_radius_um <= high, "{m:?}");
        for k in -2..=4 {
            prop_assert!(distribution.moment(k).is_finite() && distribution.moment(k) > 0.0);
        }
        let sampler = distribution.by_number();
        let mut below = low;
        for i in 0..=64 {
            let u = f64::from(i) / 64.0;
            let d = sampler.sample(u);
            prop_assert!(d >= below && d <= high, "{d} after {below}, range {low} to {high}");
            prop_assert!((sampler.cdf(d) - u).abs() < 1e-9, "{u}: {}", sampler.cdf(d));
            prop_assert!(distribution.density_1_um(d) >= 0.0 && sampler.pdf(d) >= 0.0);
            below = d;
        }
        prop_assert_eq!(distribution.density_1_um(0.999 * low) + distribution.density_1_um(1.001 * high), 0.0);
    }

    #[test]
    fn heights_outside_are_refused(height in prop_oneof![-1e6..0.999f64, 5001.0..1e9f64, Just(f64::NAN)]) {
        let spectra = Spectra::Same(SizeDistribution::gamma(5.0, 0.1).unwrap());
        let [low, high] = droplets::HEIGHT_RANGE_M;
        let message = DropletLayer::new(spectra, VerticalProfile::uniform(), 1e8, height).unwrap_err().to_string();
        prop_assert!(message.contains("fog height_m") && message.contains(&format!("{low} to {high}")), "{message}");
        let model = AdvectionModel::arcata().unwrap();
        let message = DropletLayer::advection(&model, height).unwrap_err().to_string();
        let [low, high] = HEIGHT_RANGE_M;
        prop_assert!(message.contains(&format!("{low} to {high}")), "{message}");
    }
}

proptest! {
    #![proptest_config(config(100))]

    #[test]
    fn any_spectrum_with_any_profile_makes_a_fog(
        made in prop_oneof![gamma(), lognormals(), lognormal_gaussian(), measured()],
        profile in profile(),
        number in decades(1.0, 1e12),
        height in decades(1.0, 5000.0),
    ) {
        // Drops beyond 60 µm take long and add nothing to what is tried here.
        let small = |d: &SizeDistribution| d.grid().range_um()[1] < 60.0;
        let Some(distribution) = made.ok().filter(small) else { return Ok(()) };
        let optics = distribution.optics(550.0).unwrap();
        prop_assert!(optics.c_sca_m2 > 0.0 && optics.c_sca_m2 <= optics.c_ext_m2 && optics.c_back_m2_sr >= 0.0, "{optics:?}");
        let fog = DropletLayer::new(Spectra::Same(distribution), profile, number, height).unwrap();
        let table = table(fog.spectra());
        // The mean number times the cross section is the mean extinction.
        let mean = layer::droplets(&table, &fog).mean_sigma_t();
        prop_assert!((mean / (number * optics.c_ext_m2) - 1.0).abs() < 1e-9, "{mean}");
        check_fog(&fog, &table)?;
    }

    #[test]
    fn advection_models_make_fogs_or_are_refused(text in model_text(), height in decades(1.0, 2000.0)) {
        let model = match AdvectionModel::from_yaml(&text) {
            Ok(model) => model,
            Err(error) => {
                prop_assert!(error.to_string().starts_with("fog model"), "{error}");
                return Ok(());
            }
        };
        for i in 0..=20 {
            let moments = model.moments(f64::from(i) / 20.0);
            prop_assert!(moments.share_in_range > 0.0 && moments.share_in_range < 1.001, "{moments:?}");
            prop_assert!(moments.mass_g > 0.0 && moments.effective_radius_um < 30.0, "{moments:?}");
        }
        match DropletLayer::advection(&model, height) {
            Ok(fog) => check_fog(&fog, &table(fog.spectra()))?,
            Err(error) => prop_assert!(error.to_string().contains("no droplets"), "{error}"),
        }
    }
}
