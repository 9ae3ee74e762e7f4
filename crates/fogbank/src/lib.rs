//! From one YAML file to a foggy data set: the main path and the Rust API
