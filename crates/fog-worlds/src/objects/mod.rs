//! Things that stand, drive and walk in the scenes. Each is made around the origin on the ground, its front towards −Z.

pub(crate) mod body;
pub(crate) mod car;
pub(crate) mod cyclist;
pub(crate) mod facade;
pub(crate) mod fleet;
pub(crate) mod low_beam;
pub(crate) mod person;
pub(crate) mod plate;
pub(crate) mod street_lamp;
pub(crate) mod traffic_light;
pub(crate) mod tree;
pub(crate) mod truck;
pub(crate) mod vehicle;
pub(crate) mod wheel;
