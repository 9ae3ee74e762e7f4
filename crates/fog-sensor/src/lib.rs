//! Image sensors: from radiance to the raw picture of a camera, and from that to one to look at.
//!
//! Pure functions of their arguments: no file access, clock, environment, printing or global state. The same inputs give the
//! same bits on every machine and for any number of threads.

pub mod exposure;
