//! The slow suites, one program: statistical tests of every sampler, and renderings against independent references.

mod analog;
mod cameras;
mod droplets;
mod emitters;
mod furnace;
mod golden;
mod lamps;
mod layer_light;
mod layers;
mod light_groups;
mod materials;
mod materials_rendered;
mod noise;
mod patchy;
mod phases;
mod phenomena;
mod radiances;
mod reciprocity;
mod replay;
mod samplers;
mod seen_lamps;
mod sensor;
mod shared;
mod sky;
mod street;
mod truth;
