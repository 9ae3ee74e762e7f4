//! Mistakes in the section `lighting`.

use crate::{HEAD, errors_with};

#[test]
fn luminance_of_one() {
    let head = HEAD.replace("lighting: day", "lighting: {luminance_of_one_cd_m2: 0}");
    assert_eq!(
        errors_with(&format!("{head}fog: none\n"), &[]),
        [
            "configs/x.yaml:4:36: lighting.luminance_of_one_cd_m2: 0 cd/m² is out of range; valid: 1e-6 to 1000000000 cd/m²"
        ]
    );
}

#[test]
fn images_of_the_surroundings() {
    let with = |environment: &str| {
        let lighting = format!("lighting: {{environment: {environment}}}");
        errors_with(&format!("{}fog: none\n", HEAD.replace("lighting: day", &lighting)), &[])
    };
    assert_eq!(
        with("{}"),
        [
            "configs/x.yaml:4:25: lighting.environment.radiance: missing; radiance of the surroundings, 0 or more; or image, \
          the path of an equirectangular image"
        ]
    );
    assert_eq!(
        with("{image: a.exr, radiance: 1, scale: 0}"),
        [
            "configs/x.yaml:4:50: lighting.environment.radiance: not with lighting.environment.image, which says the radiance",
            "configs/x.yaml:4:60: lighting.environment.scale: 0 is out of range; valid: above 0 up to 1000000000000"
        ]
    );
    assert_eq!(
        with("{radiance: 1, rotation_deg: 90}"),
        ["configs/x.yaml:4:53: lighting.environment.rotation_deg: only with lighting.environment.image"]
    );
    assert_eq!(
        with("{image: a.exr, rotation_deg: 400}"),
        [
            "configs/x.yaml:4:54: lighting.environment.rotation_deg: 400 deg is out of range; valid: -360 to 360 deg"
        ]
    );
    assert_eq!(
        with("{image: ''}"),
        ["configs/x.yaml:4:33: lighting.environment.image: empty; the path of an equirectangular image"]
    );
}

#[test]
fn skies_and_moons() {
    let with = |lighting: &str| {
        errors_with(
            &format!("{}fog: none\n", HEAD.replace("lighting: day", &format!("lighting: {{{lighting}}}"))),
            &[],
        )
    };
    for (lighting, message) in [
        ("sky: {}", "lighting.sky.model: missing; one of clear, cie, overcast"),
        (
            "sky: {model: overcast}",
            "lighting.sky.zenith_luminance_cd_m2: missing; luminance of the zenith above 0 up to 1000000 cd/m²; or \
             horizontal_illuminance_lx",
        ),
        (
            "sky: {model: overcast, zenith_luminance_cd_m2: 0}",
            "lighting.sky.zenith_luminance_cd_m2: 0 cd/m² is out of range; valid: above 0 up to 1000000 cd/m²",
        ),
        (
            "sky: {model: overcast, zenith_luminance_cd_m2: 1, horizontal_illuminance_lx: 1}",
            "lighting.sky.horizontal_illuminance_lx: not with lighting.sky.zenith_luminance_cd_m2: one follows from the other",
        ),
        (
            "sky: {model: overcast, horizontal_illuminance_lx: 9, color_temperature_k: 3000}",
            "lighting.sky.color_temperature_k: 3000 K is out of range; valid: 4000 to 25000 K",
        ),
        (
            "sky: {model: cie, cie_type: 16, zenith_luminance_cd_m2: 9}",
            "lighting.sky.cie_type: 16 is out of range; valid: 1 to 15",
        ),
        (
            "sky: {model: cie, cie_type: 12, zenith_luminance_cd_m2: 9}",
            "lighting.sky.cie_type: type 12 is shaped by the sun: give lighting.sun (irradiance: 0 if it is hidden), or type \
             1, 3 or 5",
        ),
        (
            "sky: {model: clear, cie_type: 3}",
            "lighting.sky.cie_type: `cie_type` belongs to model cie, not clear",
        ),
        (
            "sky: {model: clear, ozone_du: 700}",
            "lighting.sky.ozone_du: 700 DU is out of range; valid: 0 to 600 DU",
        ),
        (
            "sky: {model: clear}, sun: {elevation_deg: 9, azimuth_deg: 9, irradiance: 1}",
            "lighting.sun.irradiance: not with a clear sky (lighting.sky), whose air says what is left of the sun's light",
        ),
        (
            "sky: {model: clear}, environment: {radiance: 1}",
            "lighting.environment: not with lighting.sky, which surrounds the scene too",
        ),
        (
            "moon: {elevation_deg: 9, azimuth_deg: 9}",
            "lighting.moon: needs lighting.sky: {model: clear}, which its light is scattered by",
        ),
        (
            "sky: {model: clear}, moon: {elevation_deg: 9, azimuth_deg: 9, phase_deg: 181}",
            "lighting.moon.phase_deg: 181 deg is out of range; valid: 0 to 180 deg",
        ),
        (
            "sun: {elevation_deg: 9, azimuth_deg: 9, irradiance: 1, color_temperature_k: 26000}",
            "lighting.sun.color_temperature_k: 26000 K is out of range; valid: 4000 to 25000 K",
        ),
    ] {
        let errors = with(lighting);
        assert!(errors.len() == 1 && errors[0].starts_with("configs/x.yaml:4:"), "{lighting}: {errors:?}");
        assert!(errors[0].ends_with(&format!(": {message}")), "{lighting}: {errors:?}");
    }
}

#[test]
fn lights_at_a_wavelength() {
    let head = HEAD.replace("lighting: day", "lighting: {environment: {radiance: 1, wavelength_nm: 550}}");
    assert_eq!(
        errors_with(&format!("{head}fog: none\n"), &[]),
        [
            "configs/x.yaml:4:54: lighting.environment.wavelength_nm: 550 nm, but render.wavelength_nm is absent (the whole \
             visible spectrum is rendered); a light given at one wavelength needs render.wavelength_nm to be the same"
        ]
    );
    let set = ["render.wavelength_nm=550".to_owned()];
    assert!(fog_plan::parse(&format!("{head}fog: none\n"), "x", &set).is_ok());
}

#[test]
fn light_groups() {
    let groups = |groups: &str| {
        let lighting = format!("lighting: {{groups: {groups}}}");
        errors_with(&format!("{}fog: none\n", HEAD.replace("lighting: day", &lighting)), &[])
    };
    assert_eq!(
        groups("[{name: sky, lights: [sun, enviroment]}, {name: rest, lights: [sun]}]"),
        [
            "configs/x.yaml:4:47: lighting.groups.0.lights.1: \"enviroment\" is no light; expected one of environment, sun, \
             lamps, directional, emitters, node:NAME, material:NAME; did you mean `environment`?",
            "configs/x.yaml:4:68: lighting.groups.1.name: `rest` is taken: it is the group of all lights that belong to no \
             other",
        ]
    );
    assert_eq!(
        groups("[{name: a b, lights: []}, {lights: [\"node:\"], intensity: -1}]"),
        [
            "configs/x.yaml:4:28: lighting.groups.0.name: \"a b\" is not a name of a group: use 1 to 32 letters, digits, `_` \
             and `-`",
            "configs/x.yaml:4:41: lighting.groups.0.lights: empty; name at least one light",
            "configs/x.yaml:4:46: lighting.groups.1.name: missing; a name for the layer, such as sun",
            "configs/x.yaml:4:56: lighting.groups.1.lights.0: \"node:\" is no light; expected one of environment, sun, lamps, \
             directional, emitters, node:NAME, material:NAME",
            "configs/x.yaml:4:77: lighting.groups.1.intensity: -1 is out of range; valid: 0 to 1000000",
        ]
    );
    assert_eq!(
        groups("[{name: a, lights: [sun]}, {name: a, lights: [lamps]}]"),
        ["configs/x.yaml:4:54: lighting.groups.1.name: \"a\" is named twice"]
    );
    let many = vec!["{name: a, lights: [sun]}"; 33].join(", ");
    assert_eq!(
        groups(&format!("[{many}]")),
        ["configs/x.yaml:4:20: lighting.groups: 33 groups are too many; at most 32"]
    );
}

#[test]
fn clear_skies() {
    let with = |lighting: &str| {
        let line = format!("lighting: {lighting}");
        errors_with(&format!("{}fog: none\n", HEAD.replace("lighting: day", &line)), &[])
    };
    assert_eq!(
        with("{clear: {sun_elevation: 10}}"),
        [
            "configs/x.yaml:4:20: lighting.clear.sun_elevation: unknown key; expected one of sun_elevation_deg, \
             sun_azimuth_deg"
        ]
    );
    assert_eq!(
        with("{clear: {sun_elevation_deg: 100}}"),
        ["configs/x.yaml:4:39: lighting.sun.elevation_deg: 100 deg is out of range; valid: -90 to 90 deg"]
    );
    assert_eq!(
        with("{preset: dusk, clear: {sun_elevation_deg: 10}}"),
        [
            "configs/x.yaml:4:33: lighting.clear: not beside lighting.preset, which is a whole lighting of its own"
        ]
    );
}
