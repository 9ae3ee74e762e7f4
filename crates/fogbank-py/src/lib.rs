//! The extension module `fogbank._fogbank`: what the Python package in `python/fogbank` is made from.
//!
//! It is thin on purpose: Python's side knows mappings, tables and tensors, Rust's side reads, computes and renders. JSON crosses
//! the border as text, arrays as buffers that NumPy takes over. No panic crosses it: work is done on threads whose panics become
//! `RenderError`, and what is done on Python's own thread is a function of checked arguments.

mod arrays;
mod data_set;
mod errors;
mod fog;
mod plan;
mod render;
mod run;

use pyo3::prelude::*;

/// The native part of Fogbank; use the package `fogbank`.
#[pymodule(name = "_fogbank")]
mod native {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::data_set::{DataSet, StoredFrame};
    #[pymodule_export]
    use crate::fog::Fog;
    #[pymodule_export]
    use crate::plan::Plan;
    #[pymodule_export]
    use crate::render::{RenderedFrame, render, sweep};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("CODE_DIGEST", fogbank::CODE_DIGEST)
    }
}
