"""MATLAB's .fis files: reading and writing them, and checking that the inferred values agree."""
