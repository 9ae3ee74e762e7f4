//! Damaged and hostile configurations and tables: each is read or refused, quickly and in few words.

use fog_core::random::PathRng;
use std::fmt::Write as _;
use std::time::Instant;

const CONFIGS: [&str; 4] = [
    include_str!("../../../../configs/approach.yaml"),
    include_str!("../../../../configs/robustness.yaml"),
    include_str!("../../../../configs/quickstart.yaml"),
    "version: 1\nname: t\nscene: none\nfog: {model: layered, layers: [[0, 0.01], [9, 0]]}\ncameras: {a: {}, b: {heading_deg: 3}}\n\
     path: {waypoints: [[0, 1, 0], [9, 1, 9]], line: straight, speed_m_s: 3, rate_hz: 2}\n\
     sensor: {width_px: 8, height_px: 8, lens: {fisheye: {k1: 0.1}}, model: {prnu_1288: 0.01}}\n\
     classes: {car: ['a*', {material: b}]}\nlighting: {clear: {sun_elevation_deg: 3}}\n\
     sweep: {mode: random, samples: 3, axes: {seed: {from: 1, to: 9, step: 1}}}\n",
];

const TOKENS: [&str; 30] = [
    ".nan",
    ".inf",
    "-.inf",
    "1e999",
    "-1e308",
    "1e-320",
    "99999999999999999999999",
    "-1",
    "0",
    "~",
    "[]",
    "{}",
    "''",
    "\"\\0\"",
    "&a [*a]",
    "&a",
    "*a",
    "<<: *a",
    "!!binary x",
    "!x y",
    "---\n",
    "...\n",
    "\t",
    "\r\n",
    "\u{feff}",
    "é",
    "%YAML 9",
    "- - -",
    "{from: 0, to: 1e18, step: 1e-9}",
    "{from: 1, to: 2, count: 9000000000000000000}",
];

/// Parses, iterates over some frames, and says how long the message was.
fn outcome(text: &str) -> usize {
    let started = Instant::now();
    let length = match fog_plan::parse(text, "c.yaml", &[]) {
        Ok(plan) => plan
            .frames()
            .take(60)
            .filter_map(Result::err)
            .map(|error| error.to_string().len())
            .max()
            .unwrap_or(0),
        Err(error) => error.to_string().len(),
    };
    let seconds = started.elapsed().as_secs_f64();
    assert!(seconds < 10.0, "{seconds} s for\n{}", text.chars().take(4000).collect::<String>());
    length
}

#[test]
fn mutated_configurations() {
    let mut rng = PathRng::new(23, 0, 0);
    let mut below = |n: usize| (rng.uniform_f64() * n as f64) as usize;
    for round in 0..600 {
        let mut text: Vec<char> = CONFIGS[round % CONFIGS.len()].chars().collect();
        for _ in 0..=below(3) {
            // A word, a stretch or a line gives way to something else.
            let at = below(text.len());
            let is_part = |c: &char| c.is_alphanumeric() || "._-".contains(*c);
            let (start, end) = match below(3) {
                0 => {
                    let start = text[..at].iter().rposition(|c| !is_part(c)).map_or(0, |i| i + 1);
                    (start, text[at..].iter().position(|c| !is_part(c)).map_or(text.len(), |i| at + i))
                }
                1 => (at, (at + below(40)).min(text.len())),
                _ => (at, at),
            };
            let token = TOKENS[below(TOKENS.len())];
            text.splice(start..end.max(start), token.chars());
        }
        if below(8) == 0 {
            text.truncate(below(text.len()));
        }
        let length = outcome(&text.iter().collect::<String>());
        assert!(length < 50_000, "a message of {length} bytes");
    }
}

#[test]
fn bombs_and_depths() {
    let mut bomb = String::from("a: &a [x, x]\n");
    for (a, b) in "abcdefghijklmnopqrstuvw".chars().zip("bcdefghijklmnopqrstuvwx".chars()) {
        writeln!(bomb, "{b}: &{b} [*{a}, *{a}, *{a}, *{a}]").expect("to a string");
    }
    let deep = |open: &str| format!("version: 1\nname: {}", open.repeat(100_000));
    let wide = format!(
        "version: 1\nname: t\nclasses: {{{}}}",
        (0..60_000).map(|i| format!("c{i}: x,")).collect::<String>()
    );
    let long = format!("version: 1\nname: {}\n", "x".repeat(4 << 20));
    for text in [bomb, deep("["), deep("{a: "), deep("- "), deep("? "), deep("!a "), wide, long] {
        let length = outcome(&text);
        assert!(length > 0 && length < 50_000, "a message of {length} bytes");
    }
}

#[test]
fn encodings() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let good = "version: 1\nname: t\nscene: none\nfog: none\n";
    let utf16 = |little: bool| -> Vec<u8> {
        let units = "\u{feff}".encode_utf16().chain(good.encode_utf16());
        units.flat_map(|u| if little { u.to_le_bytes() } else { u.to_be_bytes() }).collect()
    };
    let file = dir.path().join("c.yaml");
    let load = |bytes: &[u8]| {
        std::fs::write(&file, bytes).expect("written");
        fog_plan::load(&file, &[]).map(|plan| plan.len()).map_err(|error| error.to_string())
    };
    assert_eq!(load(format!("\u{feff}{good}").as_bytes()), Ok(1));
    assert_eq!(load(good.replace('\n', "\r\n").as_bytes()), Ok(1));
    for wrong in [
        utf16(true),
        utf16(false),
        b"version: 1\nname: \xe9\n".to_vec(),
        vec![0; 999],
        b"\xff\xfe\xff".to_vec(),
    ] {
        let message = load(&wrong).expect_err("no UTF-8");
        assert!(message.contains("c.yaml") && message.len() < 2000, "{message}");
    }
}

#[test]
fn mutated_tables_of_poses() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let good = "\u{feff}# flown on Monday\r\ntime_s,x_m,y_m,z_m,heading_deg,pitch_deg,roll_deg\r\n0,0,2,0,0,0,0\r\n1,0,2,-3,5,0,0\r\n";
    let run = |index: usize, text: &str| {
        let file = dir.path().join(format!("{index}.csv"));
        std::fs::write(&file, text).expect("written");
        let config =
            format!("version: 1\nname: t\nscene: none\nfog: none\npath: {{csv: {}}}\n", file.display());
        fog_plan::parse(&config, "c.yaml", &[]).map(|plan| plan.len()).map_err(|error| error.to_string())
    };
    assert_eq!(run(0, good), Ok(2));
    let late = run(1, &good.replace("\n1,", "\n1e300,")).expect_err("a late time");
    assert!(late.contains("1.csv:4: time_s: 1e300") || late.contains("is out of range"), "{late}");
    let parts = [
        "NaN", "inf", "-1e999", "1e308", ",", ",,,", "\n", "\u{0}", "\u{feff}", "९", "", "time_s", "\"", "é",
        "qw", "#",
    ];
    let mut rng = PathRng::new(29, 0, 0);
    let mut below = |n: usize| (rng.uniform_f64() * n as f64) as usize;
    for round in 2..400 {
        let mut text: Vec<char> = good.chars().collect();
        for _ in 0..=below(3) {
            let at = below(text.len());
            let end = (at + below(9)).min(text.len());
            text.splice(at..end, parts[below(parts.len())].chars());
        }
        if let Err(message) = run(round, &text.iter().collect::<String>()) {
            assert!(message.contains(".csv") && message.len() < 1000, "{message}");
        }
    }
    let long =
        run(400, &good.replace("\n1,", &format!("\n{},", "9".repeat(1 << 20)))).expect_err("a long number");
    assert!(long.len() < 1000, "{} bytes", long.len());
}
