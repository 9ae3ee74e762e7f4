//! Numbers as they are typed. Whether a number makes sense is for the library to say, with its range.

/// Most angles that one command prints.
const MAX_ANGLES: f64 = 100_000.0;

/// A number; `nan` and `inf` are none.
pub(super) fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err("expected a finite number, as 0.5 or 1e-3".to_owned()),
    }
}

/// So many numbers with commas between them.
pub(super) fn numbers<const COUNT: usize>(text: &str) -> Result<[f64; COUNT], String> {
    let all = text.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
    <[f64; COUNT]>::try_from(all)
        .map_err(|all| format!("expected {COUNT} numbers with commas, not {}", all.len()))
}

/// A refractive index `N` or `N,K`.
pub(super) fn index(text: &str) -> Result<[f64; 2], String> {
    let parts: Vec<&str> = text.split(',').collect();
    match parts[..] {
        [n] => Ok([number(n)?, 0.0]),
        [n, k] => Ok([number(n)?, number(k)?]),
        _ => Err("expected N or N,K, as 1.333 or 1.329,2.93e-7".to_owned()),
    }
}

/// Angles in degrees: a list `0,1,180` or `FROM:TO:STEP`, each within 0 to 180.
pub(super) fn angles(text: &str) -> Result<Angles, String> {
    let parts: Vec<&str> = text.split(':').collect();
    let degrees = match parts[..] {
        [list] => list.split(',').map(number).collect::<Result<Vec<_>, _>>()?,
        [from, to, step] => steps(number(from)?, number(to)?, number(step)?)?,
        _ => return Err("expected a list as 0,90,180 or FROM:TO:STEP as 0:180:1".to_owned()),
    };
    match degrees.iter().find(|d| !(0.0..=180.0).contains(*d)) {
        Some(bad) => Err(format!("scattering angle {bad}°; valid: 0 to 180")),
        None => Ok(Angles(degrees)),
    }
}

/// Angles in degrees, in the order asked for.
#[derive(Clone, Debug)]
pub(crate) struct Angles(pub(crate) Vec<f64>);

fn steps(from: f64, to: f64, step: f64) -> Result<Vec<f64>, String> {
    let count = ((to - from) / step + 1e-9).floor();
    if step <= 0.0 || to < from || count >= MAX_ANGLES {
        return Err(format!(
            "{from}:{to}:{step} are no angles; valid: FROM ≤ TO, STEP > 0, at most {MAX_ANGLES}"
        ));
    }
    Ok((0..=count as usize).map(|i| (from + step * i as f64).min(to)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_steps_of_angles() {
        assert_eq!(angles("0,1,180").unwrap().0, [0.0, 1.0, 180.0]);
        assert_eq!(angles("0:1:0.25").unwrap().0, [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(angles("0:180:0.1").unwrap().0.len(), 1801);
        assert_eq!(angles("7:7:1").unwrap().0, [7.0]);
        for bad in [
            "",
            "a",
            "0,181",
            "-1",
            "0:180",
            "0:180:0",
            "0:180:-1",
            "180:0:1",
            "0:180:1e-9",
            "0:1:2:3",
            "nan",
        ] {
            assert!(angles(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn indices() {
        assert_eq!(index("1.5").unwrap(), [1.5, 0.0]);
        assert_eq!(index("1.329, 2.93e-7").unwrap(), [1.329, 2.93e-7]);
        for bad in ["", "water", "1.3,0,0", "1.3;0", "inf"] {
            assert!(index(bad).is_err(), "{bad}");
        }
    }
}
