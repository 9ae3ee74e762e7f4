//! Section `runway`.

/// Messages about this runway, which is on line 5.
fn errors(runway: &str) -> Vec<String> {
    crate::errors_with(&format!("version: 1\nname: t\nscene: none\nfog: none\nrunway: {runway}\n"), &[])
}

#[test]
fn numbers_have_ranges() {
    assert_eq!(
        errors("{threshold_m: [0, 1e9, 0], heading_deg: 400, length_m: 5, width_m: 1, glide_slope_deg: 30}"),
        [
            "configs/x.yaml:5:27: runway.threshold_m.1: 1000000000 m is out of range; valid: -10000000 to 10000000 m",
            "configs/x.yaml:5:49: runway.heading_deg: 400 deg is out of range; valid: -360 to 360 deg",
            "configs/x.yaml:5:64: runway.length_m: 5 m is out of range; valid: 100 to 10000 m",
            "configs/x.yaml:5:76: runway.width_m: 1 m is out of range; valid: 5 to 200 m",
            "configs/x.yaml:5:96: runway.glide_slope_deg: 30 deg is out of range; valid: 1 to 10 deg",
        ]
    );
    assert_eq!(
        errors("{touchdown_m: -3, background_luminance_cd_m2: 1e7, heading: 3}"),
        [
            "configs/x.yaml:5:60: runway.heading: unknown key; expected one of threshold_m, heading_deg, length_m, width_m, \
             glide_slope_deg, touchdown_m, background_luminance_cd_m2",
            "configs/x.yaml:5:23: runway.touchdown_m: -3 m is out of range; valid: 0 to 2000 m",
            "configs/x.yaml:5:55: runway.background_luminance_cd_m2: 10000000 cd/m² is out of range; valid: 0 to 1000000 \
             cd/m²",
        ]
    );
}

#[test]
fn a_runway_is_part_of_a_frame() {
    let digest = |line: &str| {
        let text = format!("version: 1\nname: t\nscene: none\nfog: none\n{line}");
        fog_plan::parse(&text, "c.yaml", &[]).expect("a plan").frame(0).expect("a frame").digest
    };
    assert_ne!(digest("runway: {glide_slope_deg: 3.5}\n"), digest(""));
}
