//! The figures of a comparison as text and as JSON.

use fogbank::film::{Comparison, DeltaE, Scale};
use fogbank::{Compared, Means};
use serde_json::{Value, json};
use std::io::{Result, Write};
use std::path::PathBuf;

/// One comparison: its files, its figures and where its map is, with the map's upper end.
pub(super) struct Row {
    pub(super) files: [PathBuf; 2],
    pub(super) compared: Compared,
    pub(super) map: Option<(PathBuf, f64)>,
}

impl Row {
    /// A picture's figures in words.
    pub(super) fn print(&self, out: &mut dyn Write) -> Result<()> {
        let c = &self.compared.comparison;
        for (name, (file, scale)) in ["A", "B"].iter().zip(self.files.iter().zip(&self.compared.scales)) {
            let values = match scale {
                Scale::Radiance { exposure } => format!("linear radiance, exposure {exposure}"),
                Scale::Display => "sRGB".to_owned(),
            };
            writeln!(out, "{name}: {} ({values})", file.display())?;
        }
        let of = if c.of_radiance { "linear radiance" } else { "linear display values" };
        let DeltaE { mean, median, p95, max, .. } = c.delta_e;
        writeln!(out, "{} x {} pixels", c.width, c.height)?;
        writeln!(
            out,
            "  ΔE2000               mean {mean:.4}, median {median:.4}, 95th percentile {p95:.4}, maximum {max:.4}"
        )?;
        writeln!(out, "  relative MSE         {:.4e} of {of}", c.relative_mse)?;
        writeln!(out, "  PSNR                 {:.2} dB of 8-bit sRGB values, peak 255", c.psnr_db())?;
        writeln!(
            out,
            "  relative difference  {:.3} % of {of} (mean over pixels, of luminance)",
            100.0 * c.mean_relative_difference
        )?;
        let [a, b] = c.mean_luminance;
        writeln!(
            out,
            "  mean luminance       A {a:.5e}, B {b:.5e}: {:+.3} %",
            100.0 * c.relative_difference_of_means
        )?;
        if let Some(z) = c.z_scores {
            writeln!(
                out,
                "  z-scores             mean {:.3}, rms {:.3}, beyond 3: {:.3} % (0.27 % if normal), largest {:.1}; \
                 {} pixels",
                z.mean,
                z.rms,
                100.0 * z.beyond_3,
                z.max,
                z.pixels
            )?;
        }
        match &self.map {
            Some((file, scale)) => {
                writeln!(
                    out,
                    "  map                  {}: black 0, pale yellow ΔE2000 {scale}",
                    file.display()
                )
            }
            None => writeln!(out, "  map                  --out MAP.png writes it"),
        }
    }

    /// A frame's line of the table.
    pub(super) fn print_line(&self, id: &str, width: usize, out: &mut dyn Write) -> Result<()> {
        let c = &self.compared.comparison;
        let relative = [c.relative_mse, c.mean_relative_difference, c.relative_difference_of_means];
        line(id, width, c.delta_e, relative, c.psnr_db(), out)
    }

    /// A picture's figures.
    pub(super) fn json(&self) -> Value {
        let mut value = json!({ "a": self.side(0), "b": self.side(1) });
        self.add_figures(&mut value);
        value
    }

    /// The same for frames of data sets.
    pub(super) fn json_of_frames(&self, ids: &[String; 2]) -> Value {
        let mut value = json!({ "id": ids[0], "id_b": ids[1], "a": self.side(0), "b": self.side(1) });
        self.add_figures(&mut value);
        value
    }

    fn side(&self, i: usize) -> Value {
        let (values, exposure) = match self.compared.scales[i] {
            // Through its text: the f32's own digits, not those of its nearest f64.
            Scale::Radiance { exposure } => ("radiance", exposure.to_string().parse::<f64>().ok()),
            Scale::Display => ("srgb", None),
        };
        json!({ "file": self.files[i].display().to_string(), "values": values, "exposure": exposure })
    }

    fn add_figures(&self, value: &mut Value) {
        let c = &self.compared.comparison;
        value["width"] = json!(c.width);
        value["height"] = json!(c.height);
        value["delta_e_2000"] = delta_e_json(c.delta_e);
        value["linear_values"] = json!(if c.of_radiance { "radiance" } else { "display" });
        value["relative_mse"] = json!(c.relative_mse);
        value["psnr_srgb8_db"] = json!(c.psnr_db());
        value["mean_relative_difference"] = json!(c.mean_relative_difference);
        value["relative_difference_of_means"] = json!(c.relative_difference_of_means);
        value["mean_luminance"] = json!({ "a": c.mean_luminance[0], "b": c.mean_luminance[1] });
        value["z_scores"] = json!(c.z_scores.map(|z| json!({
            "pixels": z.pixels, "mean": z.mean, "rms": z.rms, "beyond_3": z.beyond_3, "max": z.max,
        })));
        value["map"] = json!(self.map.as_ref().map(|(file, scale)| json!({
            "file": file.display().to_string(), "scale": scale,
        })));
    }
}

fn delta_e_json(d: DeltaE) -> Value {
    json!({ "mean": d.mean, "median": d.median, "p95": d.p95, "max": d.max })
}

fn means(rows: &[Row]) -> Means {
    Means::of(&rows.iter().map(|row| &row.compared.comparison).collect::<Vec<&Comparison>>())
}

/// Means over the frames.
pub(super) fn means_json(rows: &[Row]) -> Value {
    let m = means(rows);
    json!({
        "delta_e_2000": delta_e_json(m.delta_e),
        "relative_mse": m.relative_mse,
        "psnr_srgb8_db": m.psnr_db(),
        "mean_relative_difference": m.mean_relative_difference,
        "relative_difference_of_means": m.relative_difference_of_means,
    })
}

/// The heads of the table.
pub(super) fn print_heads(width: usize, out: &mut dyn Write) -> Result<()> {
    writeln!(
        out,
        "{:<width$} {:>8} {:>8} {:>8} {:>8} {:>10} {:>8} {:>9} {:>9}",
        "frame", "ΔE mean", "median", "95 %", "maximum", "rel. MSE", "PSNR dB", "|a-b| %", "means %"
    )
}

/// The means under the table.
pub(super) fn print_means(rows: &[Row], width: usize, out: &mut dyn Write) -> Result<()> {
    let m = means(rows);
    let relative = [m.relative_mse, m.mean_relative_difference, m.relative_difference_of_means];
    line("mean", width, m.delta_e, relative, m.psnr_db(), out)
}

fn line(
    name: &str,
    width: usize,
    d: DeltaE,
    [mse, difference, of_means]: [f64; 3],
    psnr_db: f64,
    out: &mut dyn Write,
) -> Result<()> {
    writeln!(
        out,
        "{name:<width$} {:>8.3} {:>8.3} {:>8.3} {:>8.3} {mse:>10.3e} {psnr_db:>8.2} {:>9.3} {:>+9.3}",
        d.mean,
        d.median,
        d.p95,
        d.max,
        100.0 * difference,
        100.0 * of_means
    )
}
