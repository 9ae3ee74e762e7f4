//! A fit as text for people.

use super::outcome::{AltitudeFit, Fit, SHAPE_KEYS, Standing};
use super::trend::CrossValidation;
use std::fmt::Write;

/// The number with `digits` significant digits, with an exponent where it is large or small.
fn significant(x: f64, digits: usize) -> String {
    let text = format!("{x:.*e}", digits - 1);
    let Some((_, exponent)) = text.split_once('e') else { return text };
    match exponent.parse::<i32>() {
        Ok(e) if (-3..(digits as i32).max(4)).contains(&e) => {
            format!("{x:.*}", (digits as i32 - 1 - e).max(0) as usize)
        }
        _ => text,
    }
}

fn polynomial(coefficients: &[f64], variable: &str) -> String {
    let mut text = String::new();
    for (i, c) in coefficients.iter().enumerate() {
        let sign = match (i, *c < 0.0) {
            (0, true) => "−",
            (0, false) => "",
            (_, true) => " − ",
            (_, false) => " + ",
        };
        let power = match i {
            0 => String::new(),
            1 => format!(" {variable}"),
            _ => format!(" {variable}^{i}"),
        };
        let _ = write!(text, "{sign}{}{power}", significant(c.abs(), 5));
    }
    text
}

impl Fit {
    /// `report.md`: what was found, how well it fits, what was set aside and why, and the rules.
    #[must_use]
    pub fn report_markdown(&self) -> String {
        let mut text = String::new();
        self.overview(&mut text);
        self.shape_table(&mut text);
        self.number_table(&mut text);
        self.degrees(&mut text);
        self.altitude_tables(&mut text);
        self.set_aside(&mut text);
        text.push_str(RULES);
        text
    }

    /// The fit in a few lines, for a terminal.
    #[must_use]
    pub fn summary(&self) -> String {
        let mut text = String::new();
        let heights: Vec<String> = self.heights_m.iter().map(f64::to_string).collect();
        let bad: usize = self.altitudes.iter().map(|a| a.bad_bins.len()).sum();
        let set_aside = self.altitudes.iter().filter(|a| a.number_rejected).count();
        let _ = writeln!(
            text,
            "{}: fog of {} m, {} altitudes ({} weak, {} rejected), {bad} bins and {set_aside} number densities set aside",
            self.source,
            heights.join(", "),
            self.altitudes.len(),
            self.count("weak"),
            self.count("rejected")
        );
        let _ = writeln!(
            text,
            "RRSE: own fits {}, model {} (medians)",
            percent(median(self.altitudes.iter().filter_map(|a| a.own.map(|own| own.rrse)))),
            percent(median(self.altitudes.iter().map(|a| a.model_rrse)))
        );
        for shape in &self.shapes {
            let at = |i: usize| {
                format!("{} ± {}", significant(shape.curve[i][1], 4), significant(shape.curve[i][2], 2))
            };
            let degree = shape.coefficients.len() - 1;
            let _ = writeln!(
                text,
                "  {:<12} degree {degree}       {:>17} at zeta 0   {:>17} at 0.5   {:>17} at 1",
                shape.key,
                at(0),
                at(10),
                at(20)
            );
        }
        let number = &self.number;
        let _ = writeln!(
            text,
            "  N(zeta, H)   degree {} and {} R² {:.5}, relative residuals {} rms",
            number.degrees.zeta,
            number.degrees.height,
            number.r_squared,
            percent(number.rms_relative)
        );
        text
    }

    fn count(&self, standing: &str) -> usize {
        self.altitudes.iter().filter(|a| a.standing.word() == standing).count()
    }

    fn overview(&self, text: &mut String) {
        let heights: Vec<String> = self.heights_m.iter().map(|h| format!("{h} m")).collect();
        let bins: usize = self.altitudes.iter().map(|a| a.spectrum.bins.len()).sum();
        let bad: usize = self.altitudes.iter().map(|a| a.bad_bins.len()).sum();
        let droplets: f64 = self.altitudes.iter().map(|a| a.spectrum.droplets()).sum();
        let _ = writeln!(text, "# Fog model fitted to {}\n", self.source);
        let _ = writeln!(text, "- fog heights: {}", heights.join(", "));
        let _ = writeln!(
            text,
            "- altitudes: {} ({} used, {} weak, {} rejected); bins: {bins} ({bad} set aside)",
            self.altitudes.len(),
            self.count("used"),
            self.count("weak"),
            self.count("rejected")
        );
        if self.counting_noise_known {
            let _ = writeln!(text, "- droplets counted: {}", significant(droplets, 4));
        }
        let _ = writeln!(
            text,
            "- dispersion (variance over that of counting noise): {} around the altitudes' own fits, {} around the common shape{}",
            significant(self.dispersion, 3),
            significant(self.common_dispersion, 3),
            if self.counting_noise_known {
                ""
            } else {
                " relative to counts in 1 m³; no volumes were given"
            }
        );
        let _ = writeln!(
            text,
            "- RRSE of the altitudes' own fits: median {}; of the final model: median {}",
            percent(median(self.altitudes.iter().filter_map(|a| a.own.map(|own| own.rrse)))),
            percent(median(self.altitudes.iter().map(|a| a.model_rrse)))
        );
        let how = if self.refined { "refined over all counts at once" } else { "of the stages, not refined" };
        let _ = writeln!(text, "- shape polynomials: {how}");
        if !self.warnings.is_empty() {
            text.push_str("\n## Warnings\n\n");
            for warning in &self.warnings {
                let _ = writeln!(text, "- {warning}");
            }
        }
    }

    fn shape_table(&self, text: &mut String) {
        text.push_str("\n## Shape over ζ = altitude / fog height\n\n");
        text.push_str("| parameter | polynomial | ζ = 0 | ζ = 0.5 | ζ = 1 | scatter | staged fit |\n|---|---|---|---|---|---|---|\n");
        for shape in &self.shapes {
            let at = |i: usize| {
                format!("{} ± {}", significant(shape.curve[i][1], 4), significant(shape.curve[i][2], 2))
            };
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | {} | {} |",
                shape.key,
                polynomial(&shape.coefficients, "ζ"),
                at(0),
                at(10),
                at(20),
                significant(shape.scatter, 2),
                polynomial(&shape.staged, "ζ")
            );
        }
        text.push_str("\nmu_G and sigma_G in µm; mu_L and sigma_L of ln(d / 1 µm). Scatter: of the altitudes' own values beyond their errors.\n");
    }

    fn number_table(&self, text: &mut String) {
        let number = &self.number;
        text.push_str("\n## Number density N(ζ, H) = Σ c_ij ζ^i H^j in m⁻³\n\n");
        let _ = writeln!(
            text,
            "Degree {} over ζ, {} over H. R² {:.5}, root mean square of the relative residuals {}, scatter beyond counting noise {}.\n",
            number.degrees.zeta,
            number.degrees.height,
            number.r_squared,
            percent(number.rms_relative),
            percent(number.scatter)
        );
        let columns = number.degrees.height + 1;
        let head: Vec<String> =
            (0..columns).map(|j| if j == 0 { "1".into() } else { format!("H^{j}") }).collect();
        let _ = writeln!(text, "| | {} |\n|---|{}", head.join(" | "), "---|".repeat(columns));
        for (i, row) in number.coefficients.iter().enumerate() {
            let cells: Vec<String> = row.iter().map(|c| significant(*c, 6)).collect();
            let _ = writeln!(text, "| ζ^{i} | {} |", cells.join(" | "));
        }
        let head: Vec<String> = self.heights_m.iter().map(|h| format!("H = {h} m")).collect();
        let _ = writeln!(text, "\n| ζ | {} |\n|---|{}", head.join(" | "), "---|".repeat(head.len()));
        for i in (0..=20).step_by(4) {
            let zeta = f64::from(i) / 20.0;
            let at = |h: &f64| number.curves.iter().find(|c| c[0] == *h && c[1] == zeta);
            let show = |c: Option<&[f64; 4]>| {
                c.map_or_else(String::new, |c| format!("{} ± {}", significant(c[2], 4), significant(c[3], 2)))
            };
            let cells: Vec<String> = self.heights_m.iter().map(|h| show(at(h))).collect();
            let _ = writeln!(text, "| {zeta:.1} | {} |", cells.join(" | "));
        }
    }

    fn degrees(&self, text: &mut String) {
        text.push_str("\n## Degrees\n\nCross-validation of the stages: mean squared error of held-out altitudes in units of their variances; excess over the best ± its standard error. **Chosen** in bold.\n\n");
        for shape in &self.shapes {
            let cells: Vec<String> = shape.cross_validation.iter().map(|e| entry(e, false)).collect();
            let _ = writeln!(text, "- {}: {}", shape.key, cells.join(", "));
        }
        let cells: Vec<String> = self.number.cross_validation.iter().map(|e| entry(e, true)).collect();
        let _ = writeln!(text, "- number density (degrees over ζ × H): {}", cells.join(", "));
        if self.degree_steps.is_empty() {
            return;
        }
        text.push_str("\nSteps from the refined polynomials' degrees, by the deviance of held-out altitudes:\n\n| parameter | step | gain | standard error | taken |\n|---|---|---|---|---|\n");
        for step in &self.degree_steps {
            let _ = writeln!(
                text,
                "| {} | {} → {} | {:.1} | {:.1} | {} |",
                SHAPE_KEYS[step.parameter],
                step.from,
                step.to,
                step.gain,
                step.error,
                if step.taken { "yes" } else { "no" }
            );
        }
    }

    fn altitude_tables(&self, text: &mut String) {
        for height in &self.heights_m {
            let _ = writeln!(text, "\n## Altitudes in fog of {height} m\n");
            text.push_str("| altitude, m | N, m⁻³ | mu_L | sigma_L | mu_G, µm | sigma_G, µm | ln G:L | RRSE | RRSE of model | deviance / freedom | standing |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
            for a in self.altitudes.iter().filter(|a| a.spectrum.fog_height_m == *height) {
                altitude_row(a, text);
            }
        }
    }

    fn set_aside(&self, text: &mut String) {
        let noted: Vec<&AltitudeFit> = (self.altitudes.iter())
            .filter(|a| a.standing != Standing::Used || a.number_rejected || !a.bad_bins.is_empty())
            .collect();
        if noted.is_empty() {
            return;
        }
        text.push_str("\n## Weak, rejected, set aside\n\n| fog height, m | altitude, m | what | why |\n|---|---|---|---|\n");
        for a in noted {
            let place = format!("| {} | {} |", a.spectrum.fog_height_m, a.spectrum.altitude_m);
            if a.standing != Standing::Used {
                let _ = writeln!(text, "{place} {} | {} |", a.standing.word(), a.standing.reason());
            }
            if a.number_rejected {
                let _ =
                    writeln!(text, "{place} number density set aside | it stands out from the polynomial |");
            }
            for bin in a.bad_bins.iter().map(|&i| &a.spectrum.bins[i]) {
                let _ = writeln!(
                    text,
                    "{place} bin {} to {} µm set aside | {} droplets stand out from the fit |",
                    bin.low_um,
                    bin.high_um,
                    if self.counting_noise_known {
                        bin.droplets.round().to_string()
                    } else {
                        significant(bin.droplets, 4)
                    }
                );
            }
        }
    }
}

fn entry(entry: &CrossValidation, two: bool) -> String {
    let degrees = match two {
        true => format!("{} × {}", entry.degrees.zeta, entry.degrees.height),
        false => entry.degrees.zeta.to_string(),
    };
    let mark = if entry.chosen { "**" } else { "" };
    let note = if entry.valid { "" } else { " (not positive)" };
    let (score, excess) = (significant(entry.score, 3), significant(entry.excess, 2));
    format!("{mark}{degrees}{mark}: {score} ({excess} ± {}){note}", significant(entry.error, 2))
}

fn altitude_row(a: &AltitudeFit, text: &mut String) {
    let number = a
        .number_density
        .map_or_else(String::new, |[n, e]| format!("{} ± {}", significant(n, 4), significant(e, 2)));
    let mut cells = vec![format!("{}", a.spectrum.altitude_m), number];
    match &a.own {
        Some(own) => {
            let pairs = own.shape.parameters().into_iter().zip(own.shape_errors);
            cells.extend(pairs.map(|(v, e)| format!("{} ± {}", significant(v, 4), significant(e, 2))));
            cells.push(percent(own.rrse));
        }
        None => cells.extend(std::iter::repeat_n(String::new(), 6)),
    }
    cells.push(percent(a.model_rrse));
    cells.push(a.own.map_or_else(String::new, |own| significant(own.deviance_per_freedom, 3)));
    cells.push(a.standing.word().into());
    let _ = writeln!(text, "| {} |", cells.join(" | "));
}

fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 3))
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    super::linear::median(&values.collect::<Vec<_>>())
}

const RULES: &str = "
## Rules

- Model (Kolářová, Lachiver & Wilkie 2024, Eq. 1–3): n(d) = L · lognormal + G · Gaussian, integrated over each bin.
- Weights: Poisson likelihood of the counts (deviance residuals). RRSE = √(Σ(y − f)² / Σ(y − ȳ)²) over the densities of the
  bins that were kept.
- Ten starts for each altitude. Of fits as good as the best (within 4 units of deviance) the one whose Gaussian is the narrow
  part (σ_G/μ_G < σ_L) and no parameter is at a bound; then the neighbours' shape in ζ is tried, and kept if it is as good.
- Set aside: bins and altitudes more than the given number of robust standard deviations (1.4826 · MAD, at least counting
  noise) away; bins from the fit, altitudes from the polynomials. *Weak* altitudes enter where all counts are fitted at once.
- Polynomials over ζ: weighted by standard errors and the scatter beyond them (Paule & Mandel 1982); the simplest degree whose
  cross-validation error is within one standard error of the best.
- Standard errors are of counting noise times the root of the dispersion; they do not hold what turbulence adds.
";
