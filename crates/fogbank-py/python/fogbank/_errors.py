"""What can go wrong; the messages are those of the command line."""

from __future__ import annotations


class FogbankError(Exception):
    """Any error of Fogbank's."""


class ConfigError(FogbankError, ValueError):
    """A configuration, a fog, a condition or an argument is wrong: the message names the key, and what would be right."""


class DataSetError(FogbankError, OSError):
    """A data set cannot be read or written, or is damaged."""


class RenderError(FogbankError, RuntimeError):
    """A frame cannot be rendered though its configuration is right."""
