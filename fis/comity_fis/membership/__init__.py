"""Membership functions over numbers: trapezoids, Gaussians, MATLAB's curves, their slopes and peaks."""

from comity_fis.membership.function import Bump, Categories, Membership, Singleton, Trapezoid, TwoTermGaussian

__all__ = ["Bump", "Categories", "Membership", "Singleton", "Trapezoid", "TwoTermGaussian"]
