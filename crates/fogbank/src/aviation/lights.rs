//! Which lights of a runway are seen from a pose, by Allard's law along the exact path.

use super::air::Air;
use super::site::RunwaySite;
use fog_core::colour::luminance;
use fog_core::math::f64::exp;
use fog_optics::visibility::threshold::Threshold;
use fog_scene::camera::Camera;
use fog_scene::lamp::Lamp;
use fog_scene::scene::Scene;
use serde::Serialize;

/// Groups by the beginning of their nodes' names, as `fogbank scene runway` gives them.
const GROUPS: [(&str, &str, Part); 9] = [
    ("approach_light", "approach", Part::Approach),
    ("flasher", "flashers", Part::Approach),
    ("side_row_light", "side_rows", Part::Approach),
    ("threshold_light", "threshold", Part::Runway),
    ("edge_light", "edge", Part::Runway),
    ("centre_line_light", "centre_line", Part::Runway),
    ("touchdown_zone_light", "touchdown_zone", Part::Runway),
    ("end_light", "end", Part::Runway),
    ("papi", "papi", Part::Runway),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Approach,
    Runway,
}

/// A group of lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kind {
    pub(super) name: &'static str,
    part: Part,
}

impl Kind {
    /// The kind of light of a node, if it is one of a runway.
    fn of(node: &str) -> Option<Self> {
        let (_, name, part) = GROUPS.into_iter().find(|(begin, ..)| node.starts_with(begin))?;
        Some(Self { name, part })
    }

    pub(super) fn is_approach(&self) -> bool {
        self.part == Part::Approach
    }

    pub(super) fn is_runway(&self) -> bool {
        self.part == Part::Runway
    }
}

/// A lamp of a runway with its node's name.
#[derive(Clone, Debug, PartialEq)]
pub struct RunwayLamp {
    /// Name of the node; its beginning says the group.
    pub node: String,
    /// Its place and intensity in cd.
    pub lamp: Lamp,
}

/// A lamp as it is seen.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Seen {
    pub(super) kind: Kind,
    /// The unit that it belongs to: name up to the last `_`.
    unit: String,
    /// Distance before the threshold in m.
    pub(super) before_m: f64,
    distance_m: f64,
    peak_cd: f64,
    illuminance_lx: f64,
    red: bool,
    pub(super) visible: bool,
    in_picture: bool,
}

/// A group of lights as it is seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GroupSeen {
    /// `approach`, `flashers`, `side_rows`, `threshold`, `edge`, `centre_line`, `touchdown_zone`, `end` or `papi`.
    pub name: &'static str,
    /// Number of lamps that shine towards this approach.
    pub lamps: usize,
    /// Number of those that are seen: their illuminance at the eye reaches the threshold, they are ahead, and nothing hides them.
    pub visible: usize,
    /// `visible` over `lamps`.
    pub share_visible: f64,
    /// Number of those seen that are inside of the picture.
    pub in_picture: usize,
    /// Distance of the nearest one seen in m.
    pub nearest_visible_m: Option<f64>,
    /// Distance of the farthest one seen in m.
    pub farthest_visible_m: Option<f64>,
    /// Greatest luminous intensity of a lamp in any direction in cd.
    pub peak_cd: f64,
    /// Greatest illuminance of a lamp at the eye in lx.
    pub greatest_illuminance_lx: f64,
}

/// The lamps of a scene's runway with intensities in cd as they shine: none when they are switched off.
pub(super) fn of_scene(scene: &Scene, lit: bool) -> Vec<RunwayLamp> {
    let loaded = scene.loaded();
    let names = loaded.light_names.lamps.iter();
    let lamps =
        loaded.lights.lamps.iter().zip(names).enumerate().filter(|(_, (_, name))| Kind::of(name).is_some());
    let lamps = lamps.map(|(i, (lamp, name))| {
        let mut lamp = lamp.clone();
        lamp.intensity = lamp.intensity.map(|cd| if lit { cd * scene.lamp_factor(i) } else { 0.0 });
        RunwayLamp { node: name.clone(), lamp }
    });
    lamps.collect()
}

/// Every lamp that serves the approach. One whose beam goes away from it (for landings from the other side) is none.
pub(super) fn look(
    site: &RunwaySite,
    camera: &Camera,
    lamps: &[RunwayLamp],
    air: &Air<'_>,
    threshold: &Threshold,
) -> Vec<Seen> {
    let eye = camera.pose.position.as_dvec3();
    let serves = |lamp: &Lamp| lamp.axis().is_none_or(|axis| axis.as_dvec3().dot(site.forward()) < 0.0);
    let kinds = lamps.iter().filter_map(|lamp| Some((Kind::of(&lamp.node)?, lamp)));
    let seen = kinds.filter(|(_, lamp)| serves(&lamp.lamp)).map(|(kind, RunwayLamp { node, lamp })| {
        let place = lamp.position.as_dvec3();
        let way = eye - place;
        let distance = way.length();
        let peak = luminance(lamp.intensity.map(f64::from));
        let towards = peak * f64::from(lamp.falloff(way.normalize_or_zero().as_vec3a()));
        let illuminance = if towards > 0.0 && distance > 0.0 {
            towards * exp(-(air.tau)(eye, place)) / (distance * distance)
        } else {
            0.0
        };
        let [_, _, depth] = camera.pose.to_camera(lamp.position);
        let visible = illuminance >= threshold.illuminance_lx && depth > 0.0 && !(air.hidden)(eye, place);
        let [red, green, _] = lamp.intensity;
        Seen {
            kind,
            unit: node.rsplit_once('_').map_or(node.as_str(), |(unit, _)| unit).to_owned(),
            before_m: site.before(place),
            distance_m: distance,
            peak_cd: peak,
            illuminance_lx: illuminance,
            red: green < 0.2 * red,
            visible,
            in_picture: visible && camera.project(lamp.position).is_some_and(|point| camera.contains(point)),
        }
    });
    seen.collect()
}

/// What is seen of each group, in the order of `GROUPS`; groups without lamps are left out.
pub(super) fn groups(seen: &[Seen]) -> Vec<GroupSeen> {
    let group = |(_, name, _): (&str, &'static str, Part)| {
        let lamps: Vec<&Seen> = seen.iter().filter(|lamp| lamp.kind.name == name).collect();
        let visible: Vec<&&Seen> = lamps.iter().filter(|lamp| lamp.visible).collect();
        let greatest = |of: fn(&Seen) -> f64| lamps.iter().map(|lamp| of(lamp)).fold(0.0, f64::max);
        let distances = || visible.iter().map(|lamp| lamp.distance_m);
        (!lamps.is_empty()).then(|| GroupSeen {
            name,
            lamps: lamps.len(),
            visible: visible.len(),
            share_visible: visible.len() as f64 / lamps.len() as f64,
            in_picture: visible.iter().filter(|lamp| lamp.in_picture).count(),
            nearest_visible_m: distances().reduce(f64::min),
            farthest_visible_m: distances().reduce(f64::max),
            peak_cd: greatest(|lamp| lamp.peak_cd),
            greatest_illuminance_lx: greatest(|lamp| lamp.illuminance_lx),
        })
    };
    GROUPS.into_iter().filter_map(group).collect()
}

/// Units of the PAPI that look white and red: each by the brighter of its lamps. `None` if none is seen.
pub(super) fn papi(seen: &[Seen]) -> Option<[usize; 2]> {
    let mut brightest: Vec<&Seen> = Vec::new();
    for lamp in seen.iter().filter(|lamp| lamp.kind.name == "papi" && lamp.visible) {
        match brightest.iter_mut().find(|best| best.unit == lamp.unit) {
            Some(best) if best.illuminance_lx < lamp.illuminance_lx => *best = lamp,
            Some(_) => {}
            None => brightest.push(lamp),
        }
    }
    let red = brightest.iter().filter(|lamp| lamp.red).count();
    (!brightest.is_empty()).then_some([brightest.len() - red, red])
}
