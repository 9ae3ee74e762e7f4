//! Wiscombe's test cases for MIEV0 (NCAR Technical Note TN-140+STR, 1979; driver MVTstNew), as printed to seven digits; the
//! four of perfect conductors are left out, for which the kernel has no limit. And Bohren & Huffman's own example.

use fog_core::math::{PI, f64::cos};
use fog_optics::mie::{Complex64, MieSeries, efficiencies};

/// n, k, x, Q_ext, Q_sca, g·Q_sca.
const MIEV0: [[f64; 6]; 15] = [
    [0.75, 0.0, 0.099, 7.417859e-06, 7.417859e-06, 1.074279e-08],
    [0.75, 0.0, 0.101, 8.033542e-06, 8.033542e-06, 1.211000e-08],
    [0.75, 0.0, 10.0, 2.232265, 2.232265, 2.001164],
    [0.75, 0.0, 1000.0, 1.997908, 1.997908, 1.688121],
    [1.33, 1e-5, 1.0, 9.395198e-02, 9.392330e-02, 1.733048e-02],
    [1.33, 1e-5, 100.0, 2.101321, 2.096594, 1.821854],
    [1.33, 1e-5, 10000.0, 2.004089, 1.723857, 1.564987],
    [1.5, 1.0, 0.055, 1.014910e-01, 1.131687e-05, 5.558541e-09],
    [1.5, 1.0, 0.056, 1.033467e-01, 1.216311e-05, 6.193255e-09],
    [1.5, 1.0, 1.0, 2.336321, 6.634538e-01, 1.274736e-01],
    [1.5, 1.0, 100.0, 2.097502, 1.283697, 1.091466],
    [1.5, 1.0, 10000.0, 2.004368, 1.236574, 1.046525],
    [10.0, 10.0, 1.0, 2.532993, 2.049405, -2.267961e-01],
    [10.0, 10.0, 100.0, 2.071124, 1.836785, 1.021648],
    [10.0, 10.0, 10000.0, 2.005914, 1.795393, 9.842238e-01],
];

#[test]
fn wiscombes_cases_agree() {
    let mut worst = 0.0f64;
    for [n, k, x, q_ext, q_sca, g_q_sca] in MIEV0 {
        let q = efficiencies(Complex64::new(n, k), x).unwrap();
        for (got, want) in [(q.q_ext, q_ext), (q.q_sca, q_sca), (q.g * q.q_sca, g_q_sca)] {
            let error = (got / want - 1.0).abs();
            worst = worst.max(error);
            assert!(error < 2e-6, "m = {n} + {k}i, x = {x}: {got:e} {want:e} ({error:e})");
        }
    }
    println!("worst relative difference from the printed values: {worst:e}");
}

#[test]
fn wiscombes_amplitudes_agree() {
    // m = 1.5 + i, x = 1, at 0°, 30°, … 180°; MIEV0's time factor is exp(+iωt), so that its amplitudes are conjugates.
    let printed = [
        [0.584080, 0.190515, 0.584080, 0.190515],
        [0.565702, 0.187200, 0.500161, 0.145611],
        [0.517525, 0.178443, 0.287964, 0.041054],
        [0.456340, 0.167167, 0.0362285, -0.0618265],
        [0.400212, 0.156643, -0.174875, -0.122959],
        [0.362157, 0.149391, -0.305682, -0.143846],
        [0.348844, 0.146829, -0.348844, -0.146829],
    ];
    let series = MieSeries::new(Complex64::new(1.5, 1.0), 1.0).unwrap();
    let cosines: Vec<f64> = (0..7).map(|i| cos(f64::from(i) * PI / 6.0)).collect();
    for (s, row) in series.amplitudes(&cosines).iter().zip(printed) {
        for (got, want) in [s.s1.re, -s.s1.im, s.s2.re, -s.s2.im].iter().zip(row) {
            assert!((got - want).abs() < 1e-6, "{got} {want}");
        }
    }
}

#[test]
fn bohren_and_huffmans_example_agrees() {
    // B&H Appendix A: a sphere of radius 0.525 µm, m = 1.55, at 0.6328 µm: Q_ext = Q_sca = 3.10543, Q_back = 2.92534.
    let q = efficiencies(Complex64::new(1.55, 0.0), 2.0 * PI * 0.525 / 0.6328).unwrap();
    assert!((q.q_ext - 3.10543).abs() < 5e-6 && (q.q_back - 2.92534).abs() < 5e-6, "{q:?}");
}
