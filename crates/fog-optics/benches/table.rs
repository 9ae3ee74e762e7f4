//! Seconds of the start-up cost of every worker: the optics table of the renderer (33 altitudes, 18 wavelengths, 596
//! diameters, 1153 angles), with one thread and with all. `cargo bench -p fog-optics --bench table`.

use fog_optics::advection::AdvectionModel;
use fog_optics::error::OpticsError;
use fog_optics::table::{TableSettings, build_table};
use std::time::Instant;

fn main() -> Result<(), OpticsError> {
    let model = AdvectionModel::arcata()?;
    let settings = TableSettings::visible(&model);
    for threads in [1, 0] {
        let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else { continue };
        let best = (0..3).try_fold(f64::INFINITY, |best, _| {
            let start = Instant::now();
            pool.install(|| build_table(&model, &settings, &|_| ()))?;
            Ok::<f64, OpticsError>(best.min(start.elapsed().as_secs_f64()))
        })?;
        println!("{} threads: {best:.2} s (best of 3)", pool.current_num_threads());
    }
    Ok(())
}
