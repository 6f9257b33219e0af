"""The tree as BehaviorTree.CPP v4 XML, read back by a parser that is not ours."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree

import pytest
from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Decorator, Inverter
from py_trees.parsers.behaviour_tree_xml import parse_behaviour_tree_xml
from py_trees.ports import PortInformation, PortsMixin

from comity_executor import btcpp_xml
from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.node import preorder
from tests.executor.btcpp_structure import faults

CONTROL = {
    "Sequence": Sequence,
    "ReactiveSequence": Sequence,
    "Fallback": Selector,
    "ReactiveFallback": Selector,
    "Parallel": Parallel,
    "RetryUntilSuccessful": Decorator,
    "Timeout": Decorator,
    "KeepRunningUntilFailure": Decorator,
    "ForceFailure": Decorator,
    "Sleep": Behaviour,
}
"""Tags of BehaviorTree.CPP that need no model, with their form."""
PORTS = {
    "Parallel": {"success_count", "failure_count"},
    "RetryUntilSuccessful": {"num_attempts"},
    "Timeout": {"msec"},
    "Sleep": {"msec"},
}


@pytest.fixture
def written(episode):
    return episode("johanna", "alice").execution.btcpp_xml()


def read_back(text: str, path) -> Behaviour:
    """By py_trees' own reader, told of the models that the file declares."""
    path.write_text(text)
    document = ElementTree.fromstring(text)
    declared = {model.get("ID"): {port.get("name") for port in model} for model in document[-1]}
    registry = {tag: _reader(tag, CONTROL[tag], PORTS.get(tag, set())) for tag in CONTROL}
    registry |= {tag: _reader(tag, Behaviour, ports) for tag, ports in declared.items()}
    return parse_behaviour_tree_xml(str(path), node_registry=registry)


def _reader(tag: str, form: type[Behaviour], ports: set[str]) -> type[Behaviour]:
    def build(self, name: str, behaviour_class_name: str, child=None, children=()) -> None:
        if form is Decorator:
            Decorator.__init__(self, name, child)
        elif form is Parallel:
            Parallel.__init__(
                self, name, ParallelPolicy.SuccessOnAll(synchronise=False), children=list(children)
            )
        elif form is Behaviour:
            Behaviour.__init__(self, name)
        else:
            form.__init__(self, name, memory="Reactive" not in tag, children=list(children))

    inputs = classmethod(lambda cls: {port: PortInformation(str) for port in ports})
    nothing = classmethod(lambda cls: {})
    content = {"__init__": build, "input_ports": inputs, "output_ports": nothing, "update": lambda self: None}
    return type(tag, (PortsMixin, form), content, register=False)


def with_retries(node: Behaviour) -> Iterator[tuple[str, int]]:
    """Name and number of children of every node, in pre-order; an act takes more of them there."""
    yield node.name, len(node.children)
    if isinstance(node, ActTimeout):
        act = node.decorated.name
        yield from [(f"Retry {node.attempts}({act})", 1), (f"Attempt({act})", 2), (act, 0)]
        yield from [(f"Failed({act})", 1), (f"Pause {node.pause_s:g} s({act})", 0)]
    else:
        for child in node.children:
            yield from with_retries(child)


def test_another_reader_builds_the_same_tree(episode, written, tmp_path) -> None:
    """Every node, in its place, with its name (behind its parents'); sequences with or without memory."""
    root = episode("johanna", "alice").execution.tree.root
    theirs = list(preorder(read_back(written, tmp_path / "tree.xml")))
    for (name, children), read in zip(with_retries(root), theirs, strict=True):
        assert read.name.endswith(name)
        assert len(read.children) == children
    memories = [node.memory for node in preorder(root) if isinstance(node, Sequence | Selector)]
    named = [node for node in theirs if isinstance(node, Sequence | Selector) and "Attempt(" not in node.name]
    assert [node.memory for node in named] == memories


def test_every_leaf_has_a_model_with_all_its_ports(written) -> None:
    """Groot2 refuses a tag without a model, BehaviorTree.CPP an attribute without a port."""
    document = ElementTree.fromstring(written)
    assert (document.get("BTCPP_format"), document.get("main_tree_to_execute")) == ("4", "Visits")
    tree, models = document
    assert (tree.tag, tree.get("ID"), len(tree), models.tag) == (
        "BehaviorTree",
        "Visits",
        1,
        "TreeNodesModel",
    )
    declared = {model.get("ID"): {port.get("name") for port in model} for model in models}
    for element in tree[0].iter():
        ports = PORTS.get(element.tag, set()) if element.tag in CONTROL else declared[element.tag]
        assert set(element.keys()) - {"name"} <= ports
        if element.tag in declared:
            assert len(element) == 0


def test_ports_carry_what_the_plan_decided(written) -> None:
    """A C++ robot needs nothing else: whom, how far, from where, how fast, which act."""
    docks = ElementTree.fromstring(written).findall(".//BehaviorTree//DockToUser")
    assert [dock.get("person") for dock in docks] == ["johanna", "alice"]
    assert {dock.get("conversational_distance") for dock in docks} == {"1.01"}
    acts = ElementTree.fromstring(written).findall(".//BehaviorTree//Act")
    assert [act.get("act") for act in acts] == ["say", "nod"] * 2
    assert [act.get("text") for act in acts] == ["Hello, Johanna.", "", "Hello, Alice.", ""]
    (everybody,) = ElementTree.fromstring(written).findall(".//BehaviorTree//AreAllGreeted")
    assert everybody.get("people") == "johanna;alice"


def test_an_act_is_tried_again_there_as_long_and_as_often_as_here(episode) -> None:
    """Attempts with a second between them, ten seconds in all."""
    tree = ElementTree.fromstring(episode().execution.btcpp_xml())[0]
    timeout = next(each for each in tree.iter("Timeout") if "say" in each.get("name"))
    (retry,) = timeout
    (attempt,) = retry
    act, failed = attempt
    (pause,) = failed
    assert (timeout.get("msec"), retry.get("num_attempts"), pause.get("msec")) == ("10000", "10", "1000")
    assert [each.tag for each in (retry, attempt, act, failed, pause)] == [
        "RetryUntilSuccessful",
        "Fallback",
        "Act",
        "ForceFailure",
        "Sleep",
    ]
    assert act.get("act") == "say"


def test_names_of_people_are_escaped(episode) -> None:
    name = '<a href="x">&\u00e9</a>'
    document = ElementTree.fromstring(episode(name).execution.btcpp_xml())
    assert document.find(".//BehaviorTree//DockToUser").get("person") == name


def test_what_cannot_be_said_there_is_refused(episode) -> None:
    with pytest.raises(ValueError, match=r"would be read as an entry of the blackboard"):
        episode("{johanna}").execution.btcpp_xml()
    with pytest.raises(ValueError, match=r"Inverter\) has no counterpart"):
        btcpp_xml(Inverter("not", Sequence("all", memory=False)))


ODD_NAMES = [
    "a b",
    "Ana María",
    "ümit",
    "o'neil",
    'the "chief"',
    "a<b>&c",
    "名前",
    "x/y",
    "p(1)",
    "a, b",
    "ID",
]


@pytest.mark.parametrize("name", ODD_NAMES)
def test_a_file_has_the_structure_that_btcpp_demands_whatever_people_are_called(
    episode, name, tmp_path
) -> None:
    text = episode(name, "alice").execution.btcpp_xml()
    assert faults(text) == []
    ours = with_retries(episode(name, "alice").execution.tree.root)
    theirs = list(preorder(read_back(text, tmp_path / "tree.xml")))
    assert [len(node.children) for node in theirs] == [children for _, children in ours]
    assert ElementTree.fromstring(text).find(".//BehaviorTree//DockToUser").get("person") == name


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('BTCPP_format="4"', 'BTCPP_format="3"'),
        ('main_tree_to_execute="Visits"', 'main_tree_to_execute="Another"'),
        ("<ReactiveSequence", "<ReactivSequence"),
        ('num_attempts="2"', 'num_attempts="twice"'),
        ('msec="40000"', 'seconds="40"'),
        ("<IsDocked ", '<IsDocked colour="red" '),
        (' volume="0.5"', ""),
        ('type="double"', 'type="float"'),
        ('<Sleep name="Pause 1 s(nod(alice))" msec="1000" />', '<Sleep name="Pause 1 s(nod(alice))" />'),
        ('<input_port name="person"', '<input_port name="name"'),
        ('<Action ID="Act">', '<Action ID="an act">'),
    ],
)
def test_the_structural_check_is_awake(written, old, new) -> None:
    assert old in written
    broken = written.replace(old, new)
    if old.startswith("<Reactive"):
        broken = broken.replace("</ReactiveSequence", "</ReactivSequence")
    assert faults(broken)
