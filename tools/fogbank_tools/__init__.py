"""Reads and checks Fogbank's data sets, independently of its Rust code."""
