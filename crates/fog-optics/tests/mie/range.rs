use fog_optics::mie::{Complex64, MieSeries};

#[test]
fn explore() {
    let text = std::fs::read_to_string("/tmp/mp/corners.csv").unwrap();
    for line in text.lines().skip(1) {
        let v: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
        let s = MieSeries::new(Complex64::new(v[0], v[1]), v[2]).unwrap();
        let q = s.efficiencies();
        let e: Vec<f64> = [q.q_ext, q.q_sca, q.q_abs, q.q_back, q.g]
            .iter()
            .zip(&v[3..])
            .map(|(a, b)| if *b == 0.0 { a.abs() } else { (a / b - 1.0).abs() })
            .collect();
        if e.iter().any(|e| *e > 1e-11) {
            println!("{:?} {}", &v[..3], e.iter().map(|e| format!("{e:.1e} ")).collect::<String>());
        }
    }
}
