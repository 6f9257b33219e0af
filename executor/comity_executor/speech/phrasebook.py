"""The languages with wordings for the robot: the shipped ones, overridden by a site's own files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property, lru_cache
from importlib.resources import as_file, files
from typing import TYPE_CHECKING

from comity_executor.speech.script import LATIN, require_script
from comity_executor.speech.utterance import AND, PLAIN_NAME, Spelling
from comity_executor.speech.wording import NAME, Occasion, Register, Use, Wording
from comity_fis.errors import InputError, WrongValueError, closest
from comity_fis.validation.yaml_file import read_yaml

if TYPE_CHECKING:
    from comity_fis.validation.yaml_file import YamlFile

DEFAULT_LANGUAGE = "eng"
"""Language of a site that states none."""
SUFFIX = ".wordings.yaml"


@dataclass(frozen=True, slots=True)
class Language:
    """All wordings of one language."""

    code: str
    """ISO 639-3 code."""
    tag: str
    """BCP 47 tag."""
    wordings: tuple[Wording, ...]
    names: Mapping[Register, Spelling] = field(default_factory=dict)
    """Form of a name, by register, for people who have not stated a form of address."""
    joined: Spelling = AND

    def find(self, use: Use, register: Register, *, first_meeting: bool) -> Wording | None:
        """The wording for a use; None if the language has none.

        Args:
            use: Purpose of the wording.
            register: The preferred register; if it has no wording, the neutral one or any but the plain one
                is used.
            first_meeting: Whether it is the first encounter; only then are wordings for that occasion used.
        """
        fits = [
            one
            for one in self.wordings
            if one.use == use and one.register != "plain" and (first_meeting or one.occasion is None)
        ]
        order = (register, "neutral")
        rank = {wording: order.index(wording) for wording in order[::-1]}
        fits.sort(key=lambda one: (rank.get(one.register, len(order)), one.occasion is None))
        return fits[0] if fits else None

    def plain(self, use: Use) -> Wording:
        """The plain wording for a use, or else the plain greeting.

        Raises:
            InputError: The language has no plain greeting.
        """
        plain = {one.use: one for one in self.wordings if one.register == "plain"}
        if found := plain.get(use, plain.get("greet")):
            return found
        raise InputError(
            expected=f"a plain greeting in {self.tag}, which is the language of the site",
            got="none",
            remedy="Add `{use: greet, register: plain, text: ...}` to its wordings.",
        )

    def name_form(self, register: Register) -> Spelling:
        """Form of a name in a register; the plain register uses the neutral form."""
        return self.names.get(register, self.names.get("neutral", PLAIN_NAME))


@dataclass(frozen=True)
class Phrasebook:
    """The languages, by ISO 639-3 code."""

    own: tuple[Language, ...] = ()
    """Languages of the site; later ones override earlier ones."""

    @cached_property
    def codes(self) -> tuple[str, ...]:
        """Codes of all languages."""
        return tuple(dict.fromkeys((*_shipped_codes(), *(one.code for one in self.own))))

    def __contains__(self, code: str) -> bool:
        return code in self.codes

    def __iter__(self) -> Iterator[str]:
        return iter(self.codes)

    def __getitem__(self, code: str) -> Language:
        shipped = [_shipped(code)] if code in _shipped_codes() else []
        known = [*shipped, *(one for one in self.own if one.code == code)]
        return _merged(known) if len(known) > 1 else known[0]

    def code_of(self, words: str) -> str:
        """Code of a language given by code or tag, with or without region.

        Raises:
            InputError: There are no wordings in it.
        """
        said = words.casefold()
        tags = {one: self[one].tag.casefold() for one in self.codes}
        for code, tag in tags.items():
            if said in (code, tag) or said.partition("-")[0] in (code, tag.partition("-")[0]):
                return code
        raise InputError(
            expected=f"a language that the robot has words in: {', '.join(self.codes)}",
            got=repr(words),
            remedy=f"{closest(words, self.codes)} Or give a file of wordings in it.".strip(),
        )


def read_wordings(file: YamlFile) -> Language:
    """Read a language from a file; errors name the line of the wording.

    Raises:
        InputError: It is not a file of wordings, or the fields of a wording are inconsistent.
    """
    from comity_executor.speech.wordings_file import WordingsFile

    content = file.check(WordingsFile)
    wordings: dict[tuple[Use, Register, Occasion | None], Wording] = {}
    for i, one in enumerate(content.wordings):
        with file.placing("wordings", i):
            wording = one.wording(content.language, content.script)
            if wording.key in wordings:
                raise WrongValueError(
                    expected="one wording for each use, register and occasion",
                    got=f"another to {' '.join(filter(None, wording.key))}",
                    remedy="Keep one of them.",
                )
            wordings[wording.key] = wording
    names: dict[Register, Spelling] = {form.register_: form.spelling() for form in content.names}
    joined = content.joined.spelling() if content.joined else AND
    with file.placing("joined" if content.joined else "script"):
        for spelling in (joined, *names.values()):
            require_script(spelling.text.replace(NAME, ""), content.script, "what joins or follows names")
            require_script(spelling.latin.replace(NAME, ""), LATIN, "what joins or follows names in `latin`")
    return Language(content.code, content.language, tuple(wordings.values()), names, joined)


def _merged(known: list[Language]) -> Language:
    """Merge a language from several files: a later wording of the same use, register and occasion wins."""
    wordings = {one.key: one for language in known for one in language.wordings}
    names: dict[Register, Spelling] = {}
    for language in known:
        names |= language.names
    joined = next((one.joined for one in reversed(known) if one.joined != AND), AND)
    last = known[-1]
    return Language(last.code, last.tag, tuple(wordings.values()), names, joined)


@lru_cache(maxsize=1)
def _shipped_codes() -> tuple[str, ...]:
    names = (entry.name for entry in files("comity_executor").joinpath("speech", "wordings").iterdir())
    codes = sorted(name.removesuffix(SUFFIX) for name in names if name.endswith(SUFFIX))
    return (DEFAULT_LANGUAGE, *(code for code in codes if code != DEFAULT_LANGUAGE))


@cache
def _shipped(code: str) -> Language:
    with as_file(files("comity_executor").joinpath("speech", "wordings", f"{code}{SUFFIX}")) as path:
        return read_wordings(read_yaml(path, path.name))


SHIPPED = Phrasebook()
