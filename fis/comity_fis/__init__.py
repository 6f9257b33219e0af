"""Fuzzy inference for culture-aware robots: from what a person disclosed to the parameters of actions."""

from comity_fis.curve import Choice, Curve
from comity_fis.disclosure import facts_first, kept_back, rests_on_facts
from comity_fis.engine import Mode
from comity_fis.errors import ComityError, InputError, Where, closest
from comity_fis.explanation import CategoryAccount, Explanation, RuleAccount, explain
from comity_fis.hedge import HEDGES
from comity_fis.interval import Interval
from comity_fis.iso3166 import Country, countries, country
from comity_fis.learnt import Learnt
from comity_fis.linguistic import all_known, from_data, terms_known
from comity_fis.loading import load_rulebook, read_rulebook, rulebook_schema, shipped_rulebooks, to_fis
from comity_fis.measurement import Coercion, Level
from comity_fis.methods import Methods
from comity_fis.mixed_fact import MixedFact
from comity_fis.mixture import Part, mixed
from comity_fis.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.partitioning import FittedPartition, OneClusterError, cluster_counts, partition
from comity_fis.possibility import Known
from comity_fis.rule import Rule, Source
from comity_fis.rulebook import Rulebook
from comity_fis.scale import IntervalScale, NominalScale, OrdinalScale, RatioScale
from comity_fis.scores import Score, find_score, individualism_scores, regions, score
from comity_fis.sensitivity import Sensitivity
from comity_fis.value import Contribution, FiredRule, Inference, Origin, ParameterValue, PartValue
from comity_fis.variable import NominalVariable, NumericVariable, OrdinalVariable, Variable
from comity_fis.variable_data import variable_data
from comity_fis.what_if import Alternative, Flip

__all__ = [
    "HEDGES",
    "Alternative",
    "CategoryAccount",
    "Choice",
    "Coercion",
    "ComityError",
    "Contribution",
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
    "Parameter",
    "ParameterValue",
    "Part",
    "PartValue",
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
    "individualism_scores",
    "kept_back",
    "load_rulebook",
    "mixed",
    "partition",
    "read_rulebook",
    "regions",
    "rests_on_facts",
    "rulebook_schema",
    "score",
    "shipped_rulebooks",
    "terms_known",
    "to_fis",
    "variable_data",
]
