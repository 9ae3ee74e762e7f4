//! The corners of the kernel's range against sums in 60 to 100 digits (`tools/tables/mie_corners.py`).

use fog_optics::mie::{Complex64, efficiencies};

const CORNERS: &str = include_str!("../../../../tests/data/mie_corners.csv");

#[test]
fn every_corner_agrees() {
    let (mut worst, mut worst_back, mut rows) = (0.0f64, 0.0f64, 0);
    for line in CORNERS.lines().skip(1) {
        let v: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let m = Complex64::new(v[0], v[1]);
        let q = efficiencies(m, v[2]).unwrap();
        // The phase shift inside the sphere is proportional to m − 1, of which doubles hold 1e-16 / |m − 1|.
        let soft = 6e-16 / (m - 1.0).norm_sqr().sqrt();
        let back_limit = if v[2] > 1e4 { 2e-9 } else { 1e-10 };
        for (got, want) in [(q.q_ext, v[3]), (q.q_sca, v[4]), (q.q_abs, v[5]), (q.g, v[7])] {
            let error = if want == 0.0 { got.abs() } else { (got / want - 1.0).abs() };
            assert!(error < 1e-12 + soft, "m {m}, x {}: {got:e} {want:e} ({error:e})", v[2]);
            worst = worst.max(if soft < 1e-12 { error } else { 0.0 });
        }
        let error = (q.q_back / v[6] - 1.0).abs();
        assert!(error < back_limit + 10.0 * soft, "m {m}, x {}: q_back {error:e}", v[2]);
        worst_back = worst_back.max(if soft < 1e-12 { error } else { 0.0 });
        rows += 1;
    }
    assert_eq!(rows, 84);
    println!("worst relative error: efficiencies and g {worst:e}, q_back {worst_back:e}");
}
