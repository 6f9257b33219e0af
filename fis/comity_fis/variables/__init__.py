"""Linguistic variables and parameters: levels of measurement, scales, and terms partitioned from data."""
