//! Mistakes in the exposure and the model of the sensor.

use crate::errors;

fn sensor(keys: &str) -> Vec<String> {
    errors(&format!("fog: none\nsensor: {{{keys}}}\n"))
}

#[test]
fn exposures() {
    assert_eq!(
        sensor("exposure: manual"),
        [
            "configs/x.yaml:7:20: sensor.exposure: expected a number, `auto`, a map such as {percentile: 0.99, target: 0.8} or \
             {iso: 400, shutter_s: 0.01, f_number: 2.8}, found text \"manual\""
        ]
    );
    assert_eq!(
        sensor("exposure: {percentil: 0.9}"),
        [
            "configs/x.yaml:7:21: sensor.exposure.percentil: unknown key; expected one of percentile, target, iso, shutter_s, \
             f_number, lens_transmission; did you mean `percentile`?"
        ]
    );
    assert_eq!(
        sensor("exposure: {percentile: 99, target: 0}"),
        [
            "configs/x.yaml:7:33: sensor.exposure.percentile: 99 is out of range; valid: 0 to 1",
            "configs/x.yaml:7:45: sensor.exposure.target: 0 is out of range; valid: above 0 up to 1000000",
        ]
    );
    assert_eq!(
        sensor("exposure: {iso: 400, shutter_s: 0, target: 1}"),
        [
            "configs/x.yaml:7:20: sensor.exposure: percentile and target are of automatic exposure, iso, shutter_s, f_number \
             and lens_transmission of a photographer's: give one or the other"
        ]
    );
    assert_eq!(
        sensor("exposure: {iso: 0.5, shutter_s: 0, lens_transmission: 1.1}"),
        [
            "configs/x.yaml:7:26: sensor.exposure.iso: 0.5 is out of range; valid: 1 to 10000000",
            "configs/x.yaml:7:42: sensor.exposure.shutter_s: 0 s is out of range; valid: 1e-6 to 3600 s",
            "configs/x.yaml:7:20: sensor.exposure.f_number: missing; f-number, 0.5 to 128",
            "configs/x.yaml:7:64: sensor.exposure.lens_transmission: 1.1 is out of range; valid: above 0 up to 1",
        ]
    );
}

#[test]
fn models() {
    assert_eq!(
        sensor("model: imx999"),
        [
            "configs/x.yaml:7:17: sensor.model: unknown value \"imx999\"; expected one of none, generic, imx174, icx625"
        ]
    );
    assert_eq!(
        sensor("model: 12"),
        [
            "configs/x.yaml:7:17: sensor.model: expected `none`, a sensor (generic, imx174, icx625) or a map such as \
             {preset: generic, read_noise_e: 2}, found 12"
        ]
    );
    assert_eq!(
        sensor("model: {read_noise: 2}"),
        [
            "configs/x.yaml:7:18: sensor.model.read_noise: unknown key; expected one of preset, bayer, adc_bits, black_level, \
             full_well_e, read_noise_e, dark_current_e_s, shutter_s, gain, pixel_um, quantum_efficiency, prnu_1288, dsnu_1288_e, pattern_seed, photon_noise, \
             response, psf, vignetting, noise_seed; did you mean `read_noise_e`?"
        ]
    );
    assert_eq!(
        sensor("model: {bayer: rgbg, adc_bits: 10, black_level: 512}"),
        [
            "configs/x.yaml:7:25: sensor.model.bayer: unknown value \"rgbg\"; expected one of rggb, bggr, grbg, gbrg; \
             did you mean `rggb`?",
            "configs/x.yaml:7:58: sensor.model.black_level: 512 is half of the range of 10 bits or more; valid: 0 to 511",
        ]
    );
    assert_eq!(
        sensor("model: {adc_bits: 17, full_well_e: 0, dark_current_e_s: -1, psf: {gaussian_px: 40}}"),
        [
            "configs/x.yaml:7:28: sensor.model.adc_bits: 17 is out of range; valid: 6 to 16",
            "configs/x.yaml:7:45: sensor.model.full_well_e: 0 e is out of range; valid: 100 to 10000000 e",
            "configs/x.yaml:7:66: sensor.model.dark_current_e_s: -1 e/s is out of range; valid: 0 to 1000000 e/s",
            "configs/x.yaml:7:89: sensor.model.psf.gaussian_px: 40 px is out of range; valid: 0.05 to 16 px",
        ]
    );
    assert_eq!(
        sensor(
            "model: {adc_bits: 10, black_level: 512, vignetting: {polynomial: [0, 11, 0]}, response: {file: \"\"}}"
        ),
        [
            "configs/x.yaml:7:45: sensor.model.black_level: 512 is half of the range of 10 bits or more; valid: 0 to 511",
            "configs/x.yaml:7:79: sensor.model.vignetting.polynomial.1: 11 is out of range; valid: -10 to 10",
            "configs/x.yaml:7:105: sensor.model.response.file: empty; give the path of a CSV file",
        ]
    );
}

#[test]
fn what_goes_with_a_model() {
    assert_eq!(
        sensor("exposure: {iso: 400, shutter_s: 0.01, f_number: 2}, model: {gain: 2, shutter_s: 0.1}"),
        [
            "configs/x.yaml:7:90: sensor.model.shutter_s: not with a photographer's exposure: sensor.exposure.shutter_s is \
             the time",
            "configs/x.yaml:7:76: sensor.model.gain: not with a photographer's exposure: sensor.exposure.iso says the gain",
        ]
    );
    assert_eq!(
        errors("fog: none\noutputs: [image, raw]\n"),
        [
            "configs/x.yaml:7:18: outputs.1: raw is the picture of a sensor: give sensor.model, such as `generic`"
        ]
    );
    let mono = |sensor: &str| {
        let head = "version: 1\nname: t\nscene: none\nfog: none\n";
        let lighting =
            "lighting: {environment: {radiance: 1, wavelength_nm: 550}}\nrender: {wavelength_nm: 550}\n";
        crate::errors_with(&format!("{head}{lighting}sensor: {{{sensor}}}\n"), &[])
    };
    assert_eq!(
        mono("model: generic, exposure: {iso: 400, shutter_s: 0.01, f_number: 2}"),
        [
            "configs/x.yaml:7:17: sensor.model: a colour sensor sees the visible spectrum, but render.wavelength_nm renders one \
             wavelength",
            "configs/x.yaml:7:36: sensor.exposure: ISO speeds are of visible light, but render.wavelength_nm renders one \
             wavelength; give a factor or `auto`",
        ]
    );
}

#[test]
fn fixed_patterns() {
    assert_eq!(
        sensor("model: {prnu_1288: 1, dsnu_1288_e: -2}"),
        [
            "configs/x.yaml:7:29: sensor.model.prnu_1288: 1 is out of range; valid: 0 to 0.5",
            "configs/x.yaml:7:45: sensor.model.dsnu_1288_e: -2 e is out of range; valid: 0 to 10000 e",
        ]
    );
    assert_eq!(
        sensor("model: {pattern_seed: 3}"),
        [
            "configs/x.yaml:7:32: sensor.model.pattern_seed: there is no pattern: give prnu_1288 or dsnu_1288_e"
        ]
    );
}
