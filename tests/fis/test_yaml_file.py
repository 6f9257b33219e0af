"""Files that are broken or hostile are refused at once, and say where."""

import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel, ConfigDict

from comity_fis import InputError, Where
from comity_fis.validation.yaml_file import MAX_BYTES, dump_yaml, read_yaml


class Model(BaseModel):
    model_config = ConfigDict(extra="forbid")
    a: int
    b: list[float] = []


def read(tmp_path, content):
    path = tmp_path / "file.yaml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_yaml(path, "file.yaml")


BOMB = "a: &a [x, x]\n" + "".join(f"k{i}: &k{i} [*a, *a]\n" for i in range(20))


@pytest.mark.parametrize(
    ("content", "line", "message"),
    [
        (BOMB, 2, "the alias *a"),
        ("a: " + "[" * 5000, 1, "deeper nesting"),
        ("a: 1\nb: 2\na: 3\n", 3, "'a' again"),
        ("a: 1\n? [x]\n: 2\n", 2, "a collection"),
        ("a: !!python/object/apply:os.system [ls]\n", 1, "the tag"),
        ("a: 1\nb: !!int foo\n", 2, "the tag"),
        ("a: 1\nb: !mine 3\n", 2, "the tag"),
        ("a: [1, 2\nb: 3\n", 2, "expected YAML"),
        ("a: 1\n b: 2\n", 2, "expected YAML"),
        ("a: '\n", 2, "expected YAML"),
        ("a: 1\n---\na: 2\n", 2, "document"),
        ("a: \x00\n", None, "expected YAML"),
        (b"\xff\xfe\x00\x01binary", 1, "no UTF-8"),
        (b"\x89PNG\r\n\x1a\n\x00", 1, "no UTF-8"),
        (b"name: x\nabout: caf\xe9\n", 2, "no UTF-8 (0xe9)"),
        (b"x" * (MAX_BYTES + 1), None, f"{MAX_BYTES + 1} bytes"),
    ],
)
def test_it_is_refused_with_its_line(tmp_path, content, line, message):
    with pytest.raises(InputError) as refusal:
        read(tmp_path, content)
    assert refusal.value.where.file == "file.yaml"
    assert refusal.value.where.line == line
    assert message in str(refusal.value)


def test_more_values_than_anyone_writes_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("comity_fis.validation.yaml_file.MAX_NODES", 100)
    with pytest.raises(InputError, match="at most 100 values"):
        read(tmp_path, "- 1\n" * 200)


@pytest.mark.parametrize("content", ["", "\n# nothing\n", "- 1\n- 2\n", "just text\n", "3\n"])
def test_a_file_that_is_no_mapping_is_refused(tmp_path, content):
    with pytest.raises(InputError, match="a mapping of keys to values"):
        read(tmp_path, content).check(Model)


@pytest.mark.parametrize(
    ("content", "line", "message"),
    [
        ("a: 1\nc: 2\n", 2, "known key, got 'c'"),
        ("b: [1]\n", 1, "the key 'a', got nothing"),
        ("a: 1\nb:\n  - 1\n  - x\n", 4, "got 'x'"),
        ("a: one\n", 1, "got 'one'"),
        ("a:\n", 1, "got nothing"),
    ],
)
def test_the_models_refusals_name_the_line(tmp_path, content, line, message):
    with pytest.raises(InputError) as refusal:
        read(tmp_path, content).check(Model)
    assert refusal.value.where == Where("file.yaml", line)
    assert message in str(refusal.value)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("NO", "NO"),
        ("yes", "yes"),
        ("on", "on"),
        ("true", True),
        ("~", None),
        ("null", None),
        ("", None),
        ("12:30", "12:30"),
        ("2020-01-01", "2020-01-01"),
        ("010", 10),
        ("0x10", "0x10"),
        ("1_000", "1_000"),
        ("1e3", 1000.0),
        ("-.5", -0.5),
        ("<<", "<<"),
        ("'1'", "1"),
        ("9" * 400, float("inf")),
    ],
)
def test_plain_words_mean_what_yaml_1_2_says(tmp_path, text, value):
    read_value = read(tmp_path, f"a: {text}\n").data["a"]
    assert read_value == value
    assert type(read_value) is type(value)


def test_a_folder_or_nothing_is_no_file(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read_yaml(tmp_path / "none.yaml")
    with pytest.raises(InputError, match="expected a YAML file"):
        read_yaml(tmp_path)
    with pytest.raises(InputError, match="expected a YAML file"):
        read_yaml(tmp_path / "nul\0byte")


def test_an_error_survives_the_way_to_another_process():
    error = InputError(expected="a", got="b", remedy="Do c.", where=Where("f", 1, 2))
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) == "f:1:2: expected a, got b. Do c."


plain = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(10**12), 10**12)
    | st.floats(allow_nan=False)
    | st.text(st.characters(codec="utf-8", exclude_categories=["Cs", "Cc", "Cn", "Co"]), max_size=20)
    | st.sampled_from(["NO", "yes", "12:30", "0x10", "1_000", "2020-01-01", "1e3", "~", "null", ".5", "010"]),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["a", "b c", "NO", "1"]), inner)
    ),
    max_leaves=10,
)


@given(plain)
def test_what_is_written_is_read_back(tmp_path_factory, value):
    path = tmp_path_factory.mktemp("written") / "file.yaml"
    path.write_text(dump_yaml({"value": value}), encoding="utf-8", newline="")
    assert read_yaml(path).data == {"value": value}


def test_shared_values_are_written_out(tmp_path):
    shared = [1, 2]
    assert read(tmp_path, dump_yaml({"a": shared, "b": shared})).data == {"a": [1, 2], "b": [1, 2]}


def test_a_part_of_a_file_still_knows_its_lines(tmp_path):
    part = read(tmp_path, "x: 1\ninner:\n  a: 1\n  c: 2\n").part("inner")
    assert part.data == {"a": 1, "c": 2}
    with pytest.raises(InputError) as refusal:
        part.check(Model)
    assert refusal.value.where == Where("file.yaml", 4)
