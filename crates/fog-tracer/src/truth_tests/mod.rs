//! Truth of pixels and things against rays of their own.

mod flow;
mod objects;
mod pixels;
mod yard;
