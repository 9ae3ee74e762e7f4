//! The slow suites, one program: statistical tests of every sampler, and renderings against independent references.

mod analog;
mod droplets;
mod furnace;
mod lamps;
mod layer_light;
mod light_groups;
mod materials;
mod materials_rendered;
mod noise;
mod phases;
mod radiances;
mod replay;
mod samplers;
mod shared;
mod sky;
mod street;
mod truth;
