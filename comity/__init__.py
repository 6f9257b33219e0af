"""Comity makes social robots culture-aware."""
