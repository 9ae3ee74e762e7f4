//! The Mie series against references, other codes and its own laws.

mod range;
mod reference;
