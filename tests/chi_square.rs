//! Pearson's chi-square test of samplers against their densities, as Mitsuba, nori and pbrt do it.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Cells that expect fewer samples than this are pooled.
const MIN_EXPECTED: f64 = 5.0;

/// Asserts that `observed` counts follow `expected` ones (same total up to samples that fall outside every cell, which must
/// have a cell of their own). `tests` is the number of tests in the family: the significance is Šidák-corrected, so that
/// the whole family fails by chance once in a hundred.
///
/// # Panics
/// If the hypothesis is rejected; the table of the worst cells is printed first.
pub fn assert_follows(name: &str, observed: &[u64], expected: &[f64], tests: usize) {
    assert_eq!(observed.len(), expected.len());
    let mut order: Vec<usize> = (0..expected.len()).collect();
    order.sort_by(|&a, &b| expected[a].total_cmp(&expected[b]));
    let (mut statistic, mut cells) = (0.0, 0usize);
    let (mut pooled_observed, mut pooled_expected) = (0.0, 0.0);
    let mut worst = Vec::new();
    for i in order {
        let (o, e) = (observed[i] as f64, expected[i]);
        if e == 0.0 {
            assert!(o == 0.0, "{name}: cell {i} expects nothing but has {o} samples");
        } else if e < MIN_EXPECTED || (pooled_expected > 0.0 && pooled_expected < MIN_EXPECTED) {
            pooled_observed += o;
            pooled_expected += e;
        } else {
            statistic += (o - e).powi(2) / e;
            cells += 1;
            worst.push(((o - e).powi(2) / e, i, o, e));
        }
    }
    if pooled_expected > 0.0 {
        statistic += (pooled_observed - pooled_expected).powi(2) / pooled_expected;
        cells += 1;
    }
    assert!(cells > 2, "{name}: only {cells} cells");
    let p_value = 1.0 - ChiSquared::new((cells - 1) as f64).expect("degrees of freedom").cdf(statistic);
    let significance = 1.0 - fog_core::math::f64::pow(1.0 - 0.01, 1.0 / tests as f64);
    if p_value < significance {
        worst.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (chi, i, o, e) in worst.iter().take(20) {
            eprintln!("cell {i}: {o} samples for {e:.1} expected, chi² {chi:.1}");
        }
        panic!("{name}: chi² = {statistic:.1} with {cells} cells, p = {p_value:.2e} < {significance:.2e}");
    }
}
