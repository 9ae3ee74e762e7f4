use super::*;
use crate::mie::batch;
use crate::water;
use fog_core::math::PI;
use fog_core::math::f64::{cos, exp};

/// Blue, green and red: dominant wavelengths of the sRGB primaries in nm.
const COLOURS_NM: [f64; 3] = [464.0, 550.0, 611.0];

fn grid(from: f64, to: f64, step: f64) -> Vec<f64> {
    (0..=((to - from) / step).round() as usize).map(|i| from + step * i as f64).collect()
}

fn size(d_um: f64, nm: f64) -> f64 {
    PI * d_um * 1e3 / nm
}

/// Phase function (not normalised) of water drops whose diameters are spread by a Gaussian of that relative width.
fn narrow(d_um: f64, spread: f64, nm: f64, angles_deg: &[f64]) -> Vec<f64> {
    let cosines: Vec<f64> = angles_deg.iter().map(|a| cos(a * PI / 180.0)).collect();
    // Steps of the size parameter below the period of interference within a drop, and enough to average over resonances.
    let steps = (5.0 * spread * size(d_um, nm) / 0.7).ceil().max(400.0) as u32;
    let offsets: Vec<f64> = (0..=steps).map(|i| 5.0 * f64::from(i) / f64::from(steps) - 2.5).collect();
    let sizes: Vec<f64> = offsets.iter().map(|t| size(d_um, nm) * (1.0 + spread * t)).collect();
    let all = batch(water::refractive_index(nm).unwrap(), &sizes, &cosines).unwrap();
    let mut out = vec![0.0; angles_deg.len()];
    for (t, row) in offsets.iter().zip(all.intensities.chunks(angles_deg.len())) {
        for (sum, i) in out.iter_mut().zip(row) {
            *sum += exp(-0.5 * t * t) * i;
        }
    }
    out
}

fn water_n(nm: f64) -> f64 {
    water::refractive_index(nm).unwrap().re
}

/// The bow of drops, with the given spread of their sizes.
fn bow_of(d_um: f64, spread: f64, nm: f64, angles_deg: &[f64]) -> Bow {
    bow(&Curve::new(angles_deg, &narrow(d_um, spread, nm, angles_deg)).unwrap()).unwrap()
}

#[test]
fn rain_has_a_rainbow_at_138_degrees() {
    let angles = grid(136.5, 140.0, 0.025);
    for (d, nm) in [(500.0, 450.0), (500.0, 650.0), (1000.0, 450.0), (1000.0, 550.0), (1000.0, 650.0)] {
        let seen = bow_of(d, 0.01, nm, &angles);
        assert!(seen.peak_deg > 137.0 && seen.peak_deg < 139.5, "{d} µm, {nm} nm: {seen:?}");
        let airy = theory::airy_bow_deg(water_n(nm), size(d, nm));
        assert!((seen.peak_deg - airy).abs() < 0.02, "{d} µm, {nm} nm: {seen:?}, Airy {airy}");
        assert!(seen.contrast > 50.0);
    }
    // Red is outside (farther from the antisolar point), and farther from blue than the bow is wide.
    let [blue, red] = [450.0, 650.0].map(|nm| bow_of(1000.0, 0.01, nm, &angles));
    assert!(blue.peak_deg - red.peak_deg > red.width_deg && blue.peak_deg - red.peak_deg < 1.0);
}

#[test]
fn fogbows_shift_inwards_widen_and_whiten_as_drops_shrink() {
    let angles = grid(110.0, 180.0, 0.1);
    let (mut previous, mut first) = (None::<[Bow; 3]>, None::<[Bow; 3]>);
    for d in [100.0, 60.0, 40.0, 20.0, 10.0] {
        let bows = COLOURS_NM.map(|nm| bow_of(d, 0.15, nm, &angles));
        for (bow, nm) in bows.iter().zip(COLOURS_NM) {
            let (n, x) = (water_n(nm), size(d, nm));
            // In units of Airy's argument: the peak is at 1.02 (a little less where the spectrum's larger drops outshine the
            // smaller), and Ai² falls to half at 0.07 and 1.81; Airy's theory is the limit of large drops.
            let scale = theory::airy_scale_deg(n, x);
            let off = (bow.peak_deg - theory::airy_bow_deg(n, x)) / scale;
            assert!(off > -0.25 && off < 0.05, "{d} µm, {nm} nm: {bow:?}, off by {off}");
            let width = bow.width_deg / scale;
            assert!(width > 1.6 && width < 1.9, "{d} µm, {nm} nm: {bow:?}, width {width}");
        }
        let colour = (bows[2].peak_deg - bows[0].peak_deg).abs() / bows[1].width_deg;
        assert!(colour < if d >= 100.0 { 0.3 } else { 0.12 }, "{d} µm: colours {colour} of the width apart");
        if let Some(larger) = previous {
            for (bow, larger) in bows.iter().zip(larger) {
                assert!(bow.width_deg > 1.2 * larger.width_deg, "{d} µm: {bow:?} {larger:?}");
                assert!(bow.peak_deg > larger.peak_deg + 0.2, "{d} µm: {bow:?} {larger:?}");
            }
        }
        previous = Some(bows);
        first = first.or(previous);
    }
    assert!(
        first
            .unwrap()
            .iter()
            .zip(previous.unwrap())
            .all(|(large, small)| large.contrast > 3.0 * small.contrast)
    );
    // Width goes with (λ/d)^(2/3): from 100 to 10 µm by 4.64.
    let (large, small) = (first.unwrap()[1].width_deg, previous.unwrap()[1].width_deg);
    assert!((small / large / 4.64 - 1.0).abs() < 0.15, "{large} {small}");
}

#[test]
fn glories_have_rings_in_inverse_proportion_to_the_drops() {
    let angles = grid(150.0, 180.0, 0.05);
    for d in [10.0, 12.5, 15.0, 20.0] {
        for nm in COLOURS_NM {
            let values = narrow(d, 0.08, nm, &angles);
            let seen = glory(&Curve::new(&angles, &values).unwrap()).unwrap();
            assert!(seen.rise > 3.0, "{d} µm, {nm} nm: {seen:?}");
            // The rings are those of J₀ and J₂ of x γ: bright at 3.0, dark at about 1.5.
            let [bright, dark] =
                [seen.bright_ring_deg, seen.dark_ring_deg].map(|a| a * PI / 180.0 * size(d, nm));
            assert!((bright - 3.03).abs() < 0.1, "{d} µm, {nm} nm: bright ring at {bright}");
            assert!((dark - 1.5).abs() < 0.2, "{d} µm, {nm} nm: dark ring at {dark}");
        }
    }
}

#[test]
fn coronas_have_rings_in_inverse_proportion_to_the_drops() {
    let angles = grid(0.0, 20.0, 0.02);
    for d in [10.0, 15.0, 20.0, 30.0, 60.0] {
        for nm in COLOURS_NM {
            let x = size(d, nm);
            let values = narrow(d, 0.05, nm, &angles);
            let seen = corona(&Curve::new(&angles, &values).unwrap()).unwrap();
            // Light that went through the drop shifts the rings of a disc inwards, by less the larger the drop is.
            for ring in 0..2 {
                let ratio = seen.dark_rings_deg[ring] / theory::dark_ring_deg(x, ring);
                assert!(
                    ratio > 1.0 - 6.0 / x && ratio < 1.0,
                    "{d} µm, {nm} nm: ring {ring} at {ratio} of a disc's"
                );
            }
            assert!(seen.bright_rings_deg[0] > seen.dark_rings_deg[0]);
            assert!(seen.bright_rings_deg[0] < seen.dark_rings_deg[1]);
        }
    }
}

#[test]
fn theories_have_their_textbook_values() {
    // Descartes: 42.08° from the antisolar point for n = 1.333. Airy's disc: sin θ = 1.22 λ/d.
    assert!((theory::descartes_bow_deg(1.333) - 137.92).abs() < 0.01);
    assert!((theory::dark_ring_deg(100.0 * PI, 0) - 180.0 / PI * 0.012_196_7).abs() < 1e-4);
    assert_eq!(theory::dark_ring_deg(1.0, 0), 90.0);
    assert!((theory::airy_scale_deg(1.333, 1000.0) - 0.0170 * 180.0 / PI).abs() < 0.01);
}

#[test]
fn finders_say_when_there_is_nothing() {
    let angles = grid(0.0, 180.0, 1.0);
    // Henyey–Greenstein has none of it.
    let smooth: Vec<f64> = angles.iter().map(|a| 1.0 / (1.74 - 1.72 * cos(a * PI / 180.0))).collect();
    let curve = Curve::new(&angles, &smooth).unwrap();
    assert!(bow(&curve).is_none() && glory(&curve).is_none() && corona(&curve).is_none());
    // A parabola's extremum is found exactly, between the points.
    let hill: Vec<f64> = angles.iter().map(|a| 1e4 - (a - 139.3) * (a - 139.3)).map(|v| v.max(1.0)).collect();
    let found = Curve::new(&angles, &hill).unwrap().extrema(100.0, 180.0);
    assert!((found[0].angle_deg - 139.3).abs() < 1e-9 && (found[0].value - 1e4).abs() < 1e-6, "{found:?}");
    let short = Curve::new(&angles[..100], &smooth[..100]).unwrap();
    assert!(glory(&short).is_none() && bow(&short).is_none());
}

#[test]
fn bad_curves_are_refused() {
    let refuse = |a: &[f64], v: &[f64]| Curve::new(a, v).unwrap_err().to_string();
    assert!(refuse(&[0.0, 1.0], &[1.0, 1.0]).contains("three or more"));
    assert!(refuse(&[0.0, 1.0, 2.0], &[1.0, 1.0]).contains("3 angles with 2 values"));
    assert!(refuse(&[0.0, 2.0, 1.0], &[1.0; 3]).contains("ascend"));
    assert!(refuse(&[0.0, 1.0, 190.0], &[1.0; 3]).contains("180"));
    assert!(refuse(&[0.0, 1.0, f64::NAN], &[1.0; 3]).contains("ascend"));
    assert!(refuse(&[0.0, 1.0, 2.0], &[1.0, 0.0, 1.0]).contains("value 0 at 1 degrees"));
    assert!(refuse(&[0.0, 1.0, 2.0], &[1.0, 1.0, f64::INFINITY]).contains("value inf"));
}
