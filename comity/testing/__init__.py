"""Scenario tests: expectations compared with the episode of each profile, seed and world.

`claims_in` reads the cases of a file with their expectations, and `judged` runs and judges one; `comity test`
and the pytest plugin only call these two. This module imports nothing, so that pytest starts quickly.
"""
