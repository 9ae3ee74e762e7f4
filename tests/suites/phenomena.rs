//! Corona, glory and fogbow come out of rendered images where the Mie table has them.
//!
//! A thin layer of nearly equal droplets under the sun is rendered around the sun and around the point opposite to it. The
//! image's radiance in rings about that point, over what isotropic scattering would give there, is the phase function.

use fog_core::math;
use fog_optics::droplets::Spectra;
use fog_optics::phase_function::PhaseFunction;
use fog_optics::phenomena::{self, Curve};
use fog_optics::size::SizeDistribution;
use fog_optics::table::{self, TableSettings};
use fog_scene::camera::Camera;
use fog_scene::light::Sun;
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;
use fog_tests::scenes;

const NM: f64 = 550.0;
const TAU: f64 = 0.02;
const HEIGHT_M: f64 = 100.0;
const SUN_DEG: f64 = 60.0;

/// Droplets of 10 µm effective diameter, most of them within 7 % of it.
fn optics() -> fog_core::optics_table::OpticsTable {
    let spectra = Spectra::Same(SizeDistribution::gamma(5.0, 0.005).unwrap());
    let settings = TableSettings { wavelengths_nm: vec![NM], ..TableSettings::visible_of(&spectra) };
    table::build(&spectra, &settings, &|_| ()).unwrap()
}

/// Single scattering towards a camera outside of the layer over p · E: ∫ T_sun T_view dτ along the ray.
fn geometry(below: bool, mu: f64) -> f64 {
    let mu_sun = math::f64::sin(SUN_DEG.to_radians());
    let n = 64;
    let depth = |i: u32| TAU * (f64::from(i) + 0.5) / f64::from(n);
    let towards = |t: f64| if below { TAU - t } else { t };
    (0..n)
        .map(|i| math::f64::exp(-depth(i) / mu_sun - towards(depth(i)) / mu) * TAU / f64::from(n) / mu)
        .sum()
}

struct Ring {
    /// Scattering angle in degrees.
    angle_deg: f64,
    /// Phase function in 1/sr that the image shows, and its standard error.
    seen: f64,
    error: f64,
}

/// Rings of even width about the sun (seen from below the fog) or about the point opposite to it (from above).
fn rings(
    fog: &Medium,
    towards_sun: bool,
    fov_deg: f64,
    pixels: u32,
    samples: u64,
    width_deg: f64,
) -> Vec<Ring> {
    let sun = Sun::new(SUN_DEG, 0.0, 1.0, 0.2);
    let scene = Scene::new(scenes::empty(), Some(fog.clone()), None, Some(sun), false);
    let (y, heading, pitch) =
        if towards_sun { (-1.0, 0.0, SUN_DEG) } else { (HEIGHT_M as f32 + 1.0, 180.0, -SUN_DEG) };
    let camera: Camera = scenes::camera(y, heading, pitch, pixels, pixels, fov_deg);
    let frame = scenes::render(&scene, &camera, samples, Some(NM as f32), 3);
    let mut sums = vec![[0.0; 4]; (0.5 * fov_deg / width_deg) as usize];
    for i in 0..frame.pixel_count() {
        let (x, y) = (i as u32 % pixels, i as u32 / pixels);
        let direction = camera.ray(f64::from(x) + 0.5, f64::from(y) + 0.5).expect("seen").direction;
        let m = f64::from(0.5 * (direction - sun.direction).length_squared());
        let angle = 2.0 * math::f64::asin((0.5 * m).sqrt().min(1.0)).to_degrees();
        let from_centre = if towards_sun { angle } else { 180.0 - angle };
        if let Some([value, weight, angles, variance]) = sums.get_mut((from_centre / width_deg) as usize) {
            let g = geometry(towards_sun, f64::from(direction.y).abs());
            *value += f64::from(frame.image(i)[0]);
            *weight += g;
            *angles += g * angle;
            *variance += f64::from(frame.standard_error[i]).powi(2);
        }
    }
    let ring = |[value, weight, angles, variance]: [f64; 4]| Ring {
        angle_deg: angles / weight,
        seen: value / weight,
        error: variance.sqrt() / weight,
    };
    let mut rings: Vec<Ring> = sums.into_iter().map(ring).collect();
    if !towards_sun {
        rings.reverse();
    }
    rings
}

/// Vertex of the parabola fitted to the rings within `half_deg` of an angle, and whether it is a maximum.
fn vertex(rings: &[Ring], value: &dyn Fn(&Ring) -> f64, about_deg: f64, half_deg: f64) -> (f64, bool) {
    let near = rings.iter().filter(|r| (r.angle_deg - about_deg).abs() < half_deg);
    let points: Vec<(f64, f64)> = near.map(|r| ((r.angle_deg - about_deg) / half_deg, value(r))).collect();
    assert!(points.len() >= 5, "{} rings near {about_deg}°", points.len());
    // Normal equations of a + b x + c x².
    let power = |k: i32| points.iter().map(|p| p.0.powi(k)).sum::<f64>();
    let moment = |k: i32| points.iter().map(|p| p.0.powi(k) * p.1).sum::<f64>();
    let row = |k: i32| [power(k), power(k + 1), power(k + 2)];
    let matrix = glam::DMat3::from_cols_array_2d(&[row(0), row(1), row(2)]);
    let fit = matrix.inverse() * glam::DVec3::new(moment(0), moment(1), moment(2));
    (about_deg - half_deg * 0.5 * fit.y / fit.z, fit.z < 0.0)
}

/// An extremum of the table near an angle, and how the image must show it.
struct Extremum {
    name: &'static str,
    about_deg: f64,
    maximum: bool,
    half_deg: f64,
    tolerance_deg: f64,
}

impl Extremum {
    /// The image's rings and the table at the same angles have it at the same place: parabolas through uneven slopes are
    /// biased, but both alike.
    fn check(&self, rings: &[Ring], table: &dyn Fn(f64) -> f64) {
        let Self { name, about_deg, half_deg, .. } = *self;
        let (want, bright) = vertex(rings, &|r| table(r.angle_deg), about_deg, half_deg);
        let (got, is_maximum) = vertex(rings, &|r| r.seen, about_deg, half_deg);
        println!("{name}: {got:.3}° for {want:.3}°, in the table at {about_deg:.3}°");
        assert_eq!((bright, is_maximum), (self.maximum, self.maximum), "{name} at {got}° for {about_deg}°");
        assert!((want - about_deg).abs() < half_deg, "{name}: {want}° for {about_deg}°");
        assert!((got - want).abs() < self.tolerance_deg, "{name}: {got}° for {want}°");
    }
}

#[test]
fn corona_glory_and_fogbow_are_where_the_table_has_them() {
    let optics = optics();
    let p = PhaseFunction::mie(&optics, 0, NM).unwrap();
    let at = |deg: f64| {
        let s = math::f64::sin(0.5 * deg.to_radians());
        p.eval(2.0 * s * s)
    };
    let angles: Vec<f64> = (0..=18_000).map(|i| 0.01 * f64::from(i)).collect();
    let values: Vec<f64> = angles.iter().map(|&a| at(a)).collect();
    let curve = Curve::new(&angles, &values).unwrap();
    let corona = phenomena::corona(&curve).expect("a corona");
    let glory = phenomena::glory(&curve).expect("a glory");
    let bow = phenomena::bow(&curve).expect("a bow");
    println!("{corona:?} {glory:?} {bow:?}");
    let profile = scenes::grey_profile(HEIGHT_M, &[TAU / HEIGHT_M; 2], 1.0);
    let fog = Medium::new(profile, Phase::Table(optics));

    let around_sun = rings(&fog, true, 26.0, 96, 256, 0.25);
    let opposite = rings(&fog, false, 14.0, 96, 256, 0.15);
    let wide = rings(&fog, false, 96.0, 96, 256, 1.0);
    for (name, rings, from_deg, to_deg) in [
        ("corona", &around_sun, 1.5, 12.0),
        ("glory", &opposite, 173.5, 179.9),
        ("fogbow", &wide, 135.0, 170.0),
    ] {
        // Light that was scattered more than once is on top of it.
        let mut compared = 0;
        for r in rings.iter().filter(|r| (from_deg..to_deg).contains(&r.angle_deg)) {
            let (ratio, error) = (r.seen / at(r.angle_deg), r.error / at(r.angle_deg));
            println!("{name} {:.2}°: {ratio:.3} ± {error:.3}", r.angle_deg);
            assert!(
                ratio > 0.95 - 3.0 * error && ratio < 1.1 + 3.0 * error,
                "{name} at {}°: {ratio} ± {error}",
                r.angle_deg
            );
            compared += 1;
        }
        assert!(compared > 20, "{name}: {compared} rings");
    }
    let extremum = |name, about_deg, maximum, half_deg, tolerance_deg| Extremum {
        name,
        about_deg,
        maximum,
        half_deg,
        tolerance_deg,
    };
    let (dark, bright) = (&corona.dark_rings_deg, &corona.bright_rings_deg);
    extremum("first dark ring of the corona", dark[0], false, 0.8, 0.1).check(&around_sun, &at);
    extremum("first bright ring of the corona", bright[0], true, 0.8, 0.1).check(&around_sun, &at);
    extremum("second dark ring of the corona", dark[1], false, 0.8, 0.15).check(&around_sun, &at);
    let (dark, bright) = (180.0 - glory.dark_ring_deg, 180.0 - glory.bright_ring_deg);
    extremum("dark ring of the glory", dark, false, 0.6, 0.1).check(&opposite, &at);
    extremum("bright ring of the glory", bright, true, 0.6, 0.1).check(&opposite, &at);
    extremum("fogbow", bow.peak_deg, true, 4.0, 0.3).check(&wide, &at);
}
