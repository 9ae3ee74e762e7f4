use super::*;
use crate::water;
use fog_core::math::{
    PI,
    f64::{exp, pow},
};
use fog_core::random::PathRng;

fn shape() -> SpectrumShape {
    SpectrumShape { mu_l: 2.13, sigma_l: 0.79, mu_g: 8.82, sigma_g: 2.21, gl_ratio: 1.95 }
}

fn bimodal() -> SizeDistribution {
    SizeDistribution::lognormals(&[
        LognormalMode { share: 3.0, median_diameter_um: 4.0, geometric_sd: 1.5 },
        LognormalMode { share: 1.0, median_diameter_um: 14.0, geometric_sd: 1.3 },
    ])
    .unwrap()
}

fn samples() -> Vec<SizeDistribution> {
    vec![
        SizeDistribution::lognormal_gaussian(shape(), DiameterGrid::fine([0.5, 60.0]).unwrap()).unwrap(),
        SizeDistribution::gamma(5.0, 0.1).unwrap(),
        SizeDistribution::modified_gamma(ModifiedGamma { alpha: 1.0, b: 8.9443, gamma: 0.5 }).unwrap(),
        bimodal(),
        SizeDistribution::tabulated(&[(1.0, 0.0), (4.0, 3.0), (9.0, 0.0), (12.0, 0.0), (20.0, 1.0)]).unwrap(),
        SizeDistribution::binned(&[2.0, 5.0, 8.0, 11.0, 20.0], &[10.0, 40.0, 0.0, 3.0]).unwrap(),
    ]
}

#[test]
fn moments_of_a_gamma_are_its_parameters() {
    for (r, v) in [(2.0, 0.3), (1.0, 0.05), (5.0, 0.1), (10.0, 0.01), (20.0, 0.2), (5.0, 0.001)] {
        let d = SizeDistribution::gamma(r, v).unwrap();
        assert!((d.effective_radius_um() / r - 1.0).abs() < 1e-4, "{r} {v}: {}", d.effective_radius_um());
        assert!((d.effective_variance() / v - 1.0).abs() < 1e-3, "{r} {v}: {}", d.effective_variance());
        assert!((d.share_in_range() - 1.0).abs() < 1e-4, "{r} {v}: {}", d.share_in_range());
        // Hansen & Travis 1974: mean radius r (1 − 2 v).
        assert!((d.mean_diameter_um() / (2.0 * r * (1.0 - 2.0 * v)) - 1.0).abs() < 1e-4, "{r} {v}");
    }
}

#[test]
fn moments_of_a_modified_gamma_are_those_of_the_gamma_function() {
    let p = ModifiedGamma { alpha: 2.0, b: 0.8, gamma: 1.5 };
    let d = SizeDistribution::modified_gamma(p).unwrap();
    for k in [-1, 1, 2, 3, 4] {
        let order = |k: i32| (p.alpha + 1.0 + f64::from(k)) / p.gamma;
        let ln_ratio = fog_core::math::f64::ln_gamma(order(k)) - fog_core::math::f64::ln_gamma(order(0));
        let exact = pow(2.0, f64::from(k)) * exp(ln_ratio) * pow(p.b, -f64::from(k) / p.gamma);
        assert!((d.moment(k) / exact - 1.0).abs() < 1e-3, "{k}: {} {exact}", d.moment(k));
    }
    let mode = ModifiedGamma::from_mode(2.0, 1.5, p.mode_radius_um()).unwrap();
    assert!((mode.b / p.b - 1.0).abs() < 1e-12);
}

#[test]
fn water_and_lognormals_follow_their_formulas() {
    let (median, sigma) = (6.0, 0.4);
    let mode = LognormalMode { share: 7.0, median_diameter_um: median, geometric_sd: exp(sigma) };
    let d = SizeDistribution::lognormals(&[mode]).unwrap();
    let cube = pow(median, 3.0) * exp(4.5 * sigma * sigma);
    assert!((d.mass_g() / (PI / 6.0 * cube * 1e-12) - 1.0).abs() < 1e-5);
    assert!((d.effective_radius_um() / (0.5 * median * exp(2.5 * sigma * sigma)) - 1.0).abs() < 1e-5);
    assert!((d.quantile_um(0.5) / median - 1.0).abs() < 1e-4);
    assert!(bimodal().density_1_um(4.0) > bimodal().density_1_um(9.0));
}

#[test]
fn bins_hold_their_counts() {
    let d = SizeDistribution::binned(&[2.0, 5.0, 8.0, 11.0, 20.0], &[10.0, 40.0, 0.0, 50.0]).unwrap();
    let by_number = d.by_number();
    for (edge, share) in [(2.0, 0.0), (5.0, 0.1), (8.0, 0.5), (11.0, 0.5), (20.0, 1.0)] {
        // An edge is as sharp as the grid's step.
        assert!((by_number.cdf(edge) - share).abs() < 0.01, "{edge}: {}", by_number.cdf(edge));
    }
    assert!((d.share_in_range() - 1.0).abs() < 1e-12);
    assert_eq!((d.density_1_um(1.99), d.density_1_um(20.01), d.density_1_um(9.5)), (0.0, 0.0, 0.0));
}

#[test]
fn quantiles_never_fall_and_invert_the_share() {
    for d in samples() {
        let sampler = d.by_number();
        let mut last = 0.0;
        for i in 0..=2000 {
            let u = f64::from(i) / 2000.0;
            let q = sampler.sample(u);
            assert!(q >= last && d.density_1_um(q).is_finite(), "{u}: {q} after {last}");
            assert!((sampler.cdf(q) - u).abs() < 1e-9, "{u}: {}", sampler.cdf(q));
            last = q;
        }
        let [low, high] = d.grid().range_um();
        assert!(sampler.sample(0.0) >= low && sampler.sample(1.0) <= high);
        assert!(
            sampler.sample(f64::NAN) == sampler.sample(0.0) && sampler.sample(2.0) == sampler.sample(1.0)
        );
        assert_eq!((sampler.pdf(0.99 * low), sampler.pdf(1.01 * high)), (0.0, 0.0));
    }
}

/// Asserts that 60 000 draws fall into 60 cells of the range as the integrals of `pdf` say (Pearson's chi-square; the
/// bound is Wilson & Hilferty's approximation at a significance of 1e-5).
fn assert_follows(name: &str, sampler: &DiameterSampler, seed: u64) {
    let (cells, draws) = (60usize, 60_000u64);
    let [low, high] = sampler.grid().range_um();
    let mut expected = vec![0.0; cells];
    for (cell, sum) in expected.iter_mut().enumerate() {
        let width = (high - low) / cells as f64;
        for j in 0..400 {
            *sum += sampler.pdf(low + width * (cell as f64 + (f64::from(j) + 0.5) / 400.0)) * width / 400.0;
        }
    }
    assert!((expected.iter().sum::<f64>() - 1.0).abs() < 1e-3, "{name}: pdf integrates to {expected:?}");
    let mut observed = vec![0u64; cells];
    let mut random = PathRng::new(seed, 0, 0);
    for _ in 0..draws {
        let share = (sampler.sample(random.uniform_f64()) - low) / (high - low);
        observed[((share * cells as f64) as usize).min(cells - 1)] += 1;
    }
    let (mut chi, mut freedom) = (0.0f64, -1.0f64);
    let (mut rare, mut rare_expected) = (0.0, 0.0);
    for (o, e) in observed.iter().zip(&expected) {
        let (o, e) = (*o as f64, e * draws as f64);
        if e < 10.0 {
            rare += o;
            rare_expected += e;
        } else {
            chi += (o - e).powi(2) / e;
            freedom += 1.0;
        }
    }
    if rare_expected >= 5.0 {
        chi += (rare - rare_expected).powi(2) / rare_expected;
        freedom += 1.0;
    }
    assert!(freedom > 3.0, "{name}");
    let h = 2.0 / (9.0 * freedom);
    let bound = freedom * (1.0 - h + 4.265 * h.sqrt()).powi(3);
    assert!(chi < bound, "{name}: chi² {chi:.1} of at most {bound:.1}: {observed:?}");
}

#[test]
fn samplers_follow_their_densities() {
    for (i, d) in samples().iter().enumerate() {
        assert_follows(&format!("{i} by number"), &d.by_number(), 2 * i as u64);
        assert_follows(&format!("{i} by extinction"), &d.by_extinction(550.0).unwrap(), 2 * i as u64 + 1);
    }
}

#[test]
fn nodes_are_drawn_with_their_shares() {
    let d = &samples()[0];
    let sampler = d.by_number();
    let n = 200_000;
    let mean = (0..n)
        .map(|i| d.grid().diameter_um(sampler.sample_node((f64::from(i) + 0.5) / f64::from(n))))
        .sum::<f64>()
        / f64::from(n);
    assert!((mean / d.mean_diameter_um() - 1.0).abs() < 1e-5, "{mean}");
    let sum: f64 = (0..d.grid().count()).map(|i| sampler.node_share(i)).sum();
    assert!((sum - 1.0).abs() < 1e-12);
}

#[test]
fn optics_are_sums_over_the_mie_series() {
    let grid = DiameterGrid::new(9.0, 12.0, 1.0).unwrap();
    let narrow = SpectrumShape { mu_l: 2.3, sigma_l: 0.1, mu_g: 10.5, sigma_g: 0.8, gl_ratio: 1.0 };
    let d = SizeDistribution::lognormal_gaussian(narrow, grid).unwrap();
    let m = water::refractive_index(905.0).unwrap();
    let (mut ext, mut back) = (0.0, 0.0);
    for i in 0..4 {
        let diameter = 9.0 + f64::from(i);
        let x = PI * diameter / 0.905;
        let series = crate::mie::MieSeries::new(m, x).unwrap();
        let n = d.density_1_um(diameter) * if i == 0 || i == 3 { 0.5 } else { 1.0 };
        ext += n * series.efficiencies().q_ext * 0.25 * PI * diameter * diameter * 1e-12;
        let s = series.amplitudes(&[-1.0])[0];
        let k = 2.0 * PI / 0.905e-6;
        back += n * (s.s1.norm_sqr() + s.s2.norm_sqr()) / (2.0 * k * k);
    }
    let optics = d.optics(905.0).unwrap();
    assert!((optics.c_ext_m2 / ext - 1.0).abs() < 1e-12);
    assert!((optics.c_back_m2_sr / back - 1.0).abs() < 1e-9);
    assert!(optics.c_sca_m2 < optics.c_ext_m2 && optics.g > 0.8);
    assert!(d.optics(100.0).unwrap_err().to_string().contains("wavelength_nm is 100"));
}

#[test]
fn mistakes_are_refused_with_a_reason() {
    let grid = DiameterGrid::fine([0.5, 60.0]).unwrap();
    let bad = |f: fn(&mut SpectrumShape)| {
        let mut shape = shape();
        f(&mut shape);
        SizeDistribution::lognormal_gaussian(shape, grid).is_err()
    };
    assert!(bad(|s| s.sigma_l = 0.0) && bad(|s| s.sigma_g = -1.0) && bad(|s| s.mu_g = f64::NAN));
    assert!(bad(|s| s.gl_ratio = -0.1) && bad(|s| (s.mu_l, s.mu_g) = (20.0, 1e6)));
    for (r, v) in [(0.0, 0.1), (-5.0, 0.1), (5.0, 0.0), (5.0, 0.5), (f64::NAN, 0.1)] {
        assert!(SizeDistribution::gamma(r, v).is_err(), "{r} {v}");
    }
    for (alpha, b, gamma) in [(-1.0, 1.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 0.0), (2.0, f64::INFINITY, 1.0)] {
        assert!(SizeDistribution::modified_gamma(ModifiedGamma { alpha, b, gamma }).is_err());
    }
    let reaches = SizeDistribution::modified_gamma(ModifiedGamma { alpha: 1.0, b: 1e-4, gamma: 1.0 });
    assert!(reaches.unwrap_err().to_string().contains("5000 µm"));
    assert!(SizeDistribution::lognormals(&[]).is_err());
    for (rows, word) in [
        (vec![(1.0, 1.0)], "at least 2"),
        (vec![(5.0, 1.0), (1.0, 1.0)], "ascending"),
        (vec![(1.0, 1.0), (5.0, -1.0)], "density -1"),
        (vec![(1.0, 0.0), (5.0, 0.0)], "no droplets"),
        (vec![(0.0, 0.0), (5.0, 1.0)], "diameter 0"),
    ] {
        let message = SizeDistribution::tabulated(&rows).unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    }
    assert!(SizeDistribution::binned(&[1.0, 2.0], &[1.0, 2.0]).is_err());
}
