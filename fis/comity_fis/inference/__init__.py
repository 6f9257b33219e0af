"""Inference of parameters for one person or many: facts in; fired rules, values and their origins out."""
