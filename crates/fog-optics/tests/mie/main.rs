//! The Mie series against sums in many digits, published tables, another code, and its own laws.

mod corners;
mod laws;
mod peer;
mod published;
mod range;
mod reference;
