//! Seconds for efficiencies and unpolarised intensities of 600 water droplets (0.1 to 60 µm) at 1000 angles (0° to 180°)
//! and 16 wavelengths (400 to 775 nm), one droplet after the other, nothing averaged.
//!
//!     cargo bench -p fog-optics --bench mie                        # one core and all cores
//!     cargo bench -p fog-optics --bench mie -- --write FILE        # also the numbers, for tools/bench/mie.py
//!
//! The last line is JSON. FILE holds, for each wavelength, q_ext q_sca q_back g of each droplet, then the intensities
//! (|S1|² + |S2|²) / 2, \[droplet\]\[angle\], all as little-endian f64.

use fog_core::math::{PI, f64::cos};
use fog_optics::mie::{Batch, batch};
use fog_optics::water;
use rayon::prelude::*;
use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

const DIAMETERS: usize = 600;
const ANGLES: usize = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let file = arguments.iter().position(|a| a == "--write").and_then(|i| arguments.get(i + 1));
    let wavelengths_nm: Vec<f64> = (0..16).map(|i| 400.0 + 25.0 * f64::from(i)).collect();
    let cosines: Vec<f64> = (0..ANGLES).map(|i| cos(i as f64 * PI / (ANGLES - 1) as f64)).collect();
    let droplets = |nm: f64| -> Result<Batch, _> {
        let sizes: Vec<f64> = (1..=DIAMETERS).map(|i| PI * 100.0 * i as f64 / nm).collect();
        batch(water::refractive_index(nm)?, &sizes, &cosines)
    };

    let mut one_core = f64::INFINITY;
    for _ in 0..3 {
        let start = Instant::now();
        for &nm in &wavelengths_nm {
            black_box(droplets(nm)?);
        }
        one_core = one_core.min(start.elapsed().as_secs_f64());
    }
    println!("1 thread: {one_core:.3} s (best of 3)");
    let start = Instant::now();
    wavelengths_nm.par_iter().try_for_each(|&nm| droplets(nm).map(|b| drop(black_box(b))))?;
    let all_cores = start.elapsed().as_secs_f64();
    let threads = rayon::current_num_threads();
    println!("{threads} threads: {all_cores:.3} s");

    if let Some(file) = file {
        let mut out = std::io::BufWriter::new(std::fs::File::create(file)?);
        for &nm in &wavelengths_nm {
            let batch = droplets(nm)?;
            let efficiencies = batch.efficiencies.iter().flat_map(|q| [q.q_ext, q.q_sca, q.q_back, q.g]);
            for value in efficiencies.chain(batch.intensities) {
                out.write_all(&value.to_le_bytes())?;
            }
        }
        out.flush()?;
    }
    let indices = (wavelengths_nm.iter())
        .map(|&nm| Ok(water::refractive_index(nm).map(|m| format!("[{nm},{:e},{:e}]", m.re, m.im))?))
        .collect::<Result<Vec<String>, Box<dyn Error>>>()?;
    println!(
        r#"{{"seconds_1_thread":{one_core},"seconds":{all_cores},"threads":{threads},"wavelength_n_k":[{}]}}"#,
        indices.join(",")
    );
    Ok(())
}
