//! Integrators and the tile scheduler: (scene, settings, seed) to film
