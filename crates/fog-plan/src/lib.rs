//! YAML to a checked schema to a plan of frames
