"""Scenario tests: expectations compared with the episode of each profile, seed and world.

`claims_in` reads the cases of a file with all that they have to hold, `judged` carries one out; `comity test`
and the pytest plugin do nothing else. Nothing is imported here, so that pytest starts as quickly as before.
"""
