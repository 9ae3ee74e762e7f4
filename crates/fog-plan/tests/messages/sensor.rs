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
