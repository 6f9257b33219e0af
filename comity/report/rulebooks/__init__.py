"""Rulebooks in words and pictures: audited, converted, held to measurements, fitted to data."""
