//! Pictures as NumPy arrays: the array takes over the buffer that the picture is in, nothing is copied.

use fogbank::dataset::{Raster, Values};
use numpy::{Element, PyArray1, PyArrayMethods};
use pyo3::prelude::*;

/// A picture as an array of shape (height, width), or (height, width, components) where a pixel has several.
pub(crate) fn to_array(py: Python<'_>, raster: Raster) -> PyResult<Bound<'_, PyAny>> {
    let shape = [raster.height as usize, raster.width as usize, raster.components];
    match raster.values {
        Values::F32(values) => shaped(py, values, shape),
        Values::U16(values) => shaped(py, values, shape),
        Values::U8(values) => shaped(py, values, shape),
    }
}

fn shaped<T: Element>(py: Python<'_>, values: Vec<T>, shape: [usize; 3]) -> PyResult<Bound<'_, PyAny>> {
    let array = PyArray1::from_vec(py, values);
    Ok(match shape {
        [height, width, 1] => array.reshape([height, width])?.into_any(),
        shape => array.reshape(shape)?.into_any(),
    })
}
