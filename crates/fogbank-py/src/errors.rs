//! Library errors as Python's exceptions, with the library's own messages.

use fogbank::Error;
use fogbank::plan::{Origin, PlanError, Problem};
use pyo3::PyErr;
use pyo3::exceptions::PyKeyboardInterrupt;

pyo3::import_exception!(fogbank._errors, ConfigError);
pyo3::import_exception!(fogbank._errors, DataSetError);
pyo3::import_exception!(fogbank._errors, RenderError);

/// The exception for an error of the main path.
pub(crate) fn exception(error: Error) -> PyErr {
    match error {
        Error::Plan(error) => plan_exception(&error),
        Error::DataSet(error) => DataSetError::new_err(error.to_string()),
        Error::FileChanged { .. } | Error::Incomparable { .. } => DataSetError::new_err(error.to_string()),
        Error::NotOneFrame { name, count } => ConfigError::new_err(format!(
            "{name} is a sweep of {count} frames: name one by its id or index, as in render(config, frame=0)"
        )),
        Error::Cancelled => PyKeyboardInterrupt::new_err("stopped on request"),
        error @ (Error::Frame(_) | Error::Panic(_) | Error::Workers(_)) => {
            RenderError::new_err(error.to_string())
        }
        error => ConfigError::new_err(error.to_string()),
    }
}

/// The exception for mistakes in a configuration. A place is only named where there is a file.
pub(crate) fn plan_exception(error: &PlanError) -> PyErr {
    match error.problems() {
        [] => ConfigError::new_err(error.to_string()),
        problems => ConfigError::new_err(problems.iter().map(message).collect::<Vec<_>>().join("\n")),
    }
}

fn message(problem: &Problem) -> String {
    match &problem.origin {
        Origin::File { file, .. } if !file.is_empty() => problem.to_string(),
        _ if problem.path.is_empty() => problem.message.clone(),
        _ => format!("{}: {}", problem.path, problem.message),
    }
}
