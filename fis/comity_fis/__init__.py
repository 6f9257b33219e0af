"""Fuzzy inference for culture-aware robots: from what a person disclosed to the parameters of actions."""

from comity_fis.curve import Choice, Curve
from comity_fis.engine import Mode
from comity_fis.errors import ComityError, InputError, Where, closest
from comity_fis.interval import Interval
from comity_fis.loading import load_rulebook, read_rulebook, rulebook_schema, shipped_rulebooks, to_fis
from comity_fis.methods import Methods
from comity_fis.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.partitioning import FittedPartition, partition
from comity_fis.rule import Rule, Source
from comity_fis.rulebook import Rulebook
from comity_fis.scores import Score, individualism_scores, score
from comity_fis.value import Contribution, FiredRule, Inference, Origin, ParameterValue
from comity_fis.variable import NominalVariable, NumericVariable, Variable

__all__ = [
    "Choice",
    "ComityError",
    "Contribution",
    "Curve",
    "FiredRule",
    "FittedPartition",
    "Inference",
    "InputError",
    "Interval",
    "Methods",
    "Mode",
    "NominalParameter",
    "NominalVariable",
    "NumericParameter",
    "NumericVariable",
    "Origin",
    "Parameter",
    "ParameterValue",
    "Rule",
    "Rulebook",
    "Score",
    "Source",
    "Variable",
    "Where",
    "closest",
    "individualism_scores",
    "load_rulebook",
    "partition",
    "read_rulebook",
    "rulebook_schema",
    "score",
    "shipped_rulebooks",
    "to_fis",
]
