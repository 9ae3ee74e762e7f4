//! Helpers shared by the slow suites.
