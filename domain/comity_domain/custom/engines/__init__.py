"""Engines run as processes: Fast Downward, limits of time and memory, a folder that is gone afterwards."""
