//! Truth of pixels and things against rays of their own.

mod flow;
mod pixels;
mod yard;
