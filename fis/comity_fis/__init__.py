"""Fuzzy inference for culture-aware robots: from what a person disclosed to the parameters of actions."""

from comity_fis.culture.mixture import Part, mixed
from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.defuzzification.engine import Mode
from comity_fis.errors import ComityError, InputError, Where, closest, unknown_word
from comity_fis.explanation.disclosure import Outvoting, facts_first, kept_back, outvoting, rests_on_facts
from comity_fis.explanation.explanation import CategoryAccount, Explanation, RuleAccount, explain
from comity_fis.explanation.sensitivity import Sensitivity
from comity_fis.explanation.what_if import Counterfactual, Flip
from comity_fis.inference.known import Known, MixedFact
from comity_fis.inference.value import Contribution, FiredRule, Inference, Origin, ParameterValue, PartValue
from comity_fis.learning.learnt import Learnt
from comity_fis.loading import load_rulebook, read_rulebook, rulebook_schema, shipped_rulebooks, to_fis
from comity_fis.membership.interval import Interval
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rulebook.variable_data import variable_data
from comity_fis.rules.hedge import HEDGES
from comity_fis.rules.methods import Methods
from comity_fis.rules.rule import Rule, Source
from comity_fis.scores.iso3166 import Country, countries, country
from comity_fis.scores.population_table import Population, PopulationTable, Score
from comity_fis.scores.score_file import read_scores
from comity_fis.scores.shipped import find_score, individualism, individualism_scores, score
from comity_fis.variables.linguistic import all_known, from_data, terms_known
from comity_fis.variables.measurement import Coercion, Level
from comity_fis.variables.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.variables.partitioning import FittedPartition, OneClusterError, cluster_counts, partition
from comity_fis.variables.scale import IntervalScale, NominalScale, OrdinalScale, RatioScale
from comity_fis.variables.variable import NominalVariable, NumericVariable, OrdinalVariable, Variable

__all__ = [
    "HEDGES",
    "CategoryAccount",
    "Choice",
    "Coercion",
    "ComityError",
    "Contribution",
    "Counterfactual",
    "Country",
    "Curve",
    "Explanation",
    "FiredRule",
    "FittedPartition",
    "Flip",
    "Inference",
    "InputError",
    "Interval",
    "IntervalScale",
    "Known",
    "Learnt",
    "Level",
    "Methods",
    "MixedFact",
    "Mode",
    "NominalParameter",
    "NominalScale",
    "NominalVariable",
    "NumericParameter",
    "NumericVariable",
    "OneClusterError",
    "OrdinalScale",
    "OrdinalVariable",
    "Origin",
    "Outvoting",
    "Parameter",
    "ParameterValue",
    "Part",
    "PartValue",
    "Population",
    "PopulationTable",
    "RatioScale",
    "Rule",
    "RuleAccount",
    "Rulebook",
    "Score",
    "Sensitivity",
    "Source",
    "Variable",
    "Where",
    "all_known",
    "closest",
    "cluster_counts",
    "countries",
    "country",
    "explain",
    "facts_first",
    "find_score",
    "from_data",
    "individualism",
    "individualism_scores",
    "kept_back",
    "load_rulebook",
    "mixed",
    "outvoting",
    "partition",
    "read_rulebook",
    "read_scores",
    "rests_on_facts",
    "rulebook_schema",
    "score",
    "shipped_rulebooks",
    "terms_known",
    "to_fis",
    "unknown_word",
    "variable_data",
]
