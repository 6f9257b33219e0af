"""How a pytest inside a test is given Comity's plugin."""

from __future__ import annotations

from importlib.metadata import entry_points

INSTALLED = any(one.value == "comity.testing.pytest_plugin" for one in entry_points(group="pytest11"))
"""Then pytest finds the plugin by itself, as it does for users."""
REMEMBERING = () if INSTALLED else ("-p", "comity.testing.pytest_plugin")
"""With what failed the last time."""
PLUGIN = (*REMEMBERING, "-p", "no:cacheprovider")
