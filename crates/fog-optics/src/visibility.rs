//! Visibility from extinction: how far dark objects and lights are seen in fog, and what aviation makes of it.
//!
//! Two contrast thresholds are in use for objects ([`koschmieder`]) and several thresholds of illuminance for lights
//! ([`threshold`]), so that every function and every result names its own.

pub mod allard;
pub mod category;
pub mod koschmieder;
pub mod parametrised;
pub mod rvr;
pub mod slant;
pub mod threshold;

pub use allard::{PAPER_INTENSITIES_CD, allard_m, sigma_t_from_allard};
pub use koschmieder::{
    KOSCHMIEDER_OPTICAL_DEPTH, MOR_OPTICAL_DEPTH, koschmieder_m, mor_m, sigma_t_from_koschmieder,
    sigma_t_from_mor,
};
pub use slant::{Law, Sight, transmittance};
pub use threshold::Threshold;
