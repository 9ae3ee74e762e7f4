//! Lines to the terminal, whose reader may go away at any time (`fogbank plan … | head`).

use anyhow::Error;
use std::fmt::Display;
use std::io::{ErrorKind, Write, stderr, stdout};

/// Prints a line of news; if nobody can read it the work goes on.
pub(crate) fn news(text: impl Display) {
    let _ = writeln!(stdout().lock(), "{text}");
}

/// Prints a line of complaint, likewise.
pub(crate) fn complaint(text: impl Display) {
    let _ = writeln!(stderr().lock(), "{text}");
}

/// Whether standard output's reader has gone, having read enough.
pub(crate) fn reader_has_gone(error: &Error) -> bool {
    error.downcast_ref::<std::io::Error>().is_some_and(|e| e.kind() == ErrorKind::BrokenPipe)
}
