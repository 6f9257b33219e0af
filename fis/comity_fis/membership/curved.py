"""MATLAB's curved membership functions, under MATLAB's names and with its parameters in its order.

The degrees come from scikit-fuzzy, which is imported at first use. MATLAB's piecewise linear functions
(trimf, trapmf, linsmf, linzmf) are trapezoids. Where GNU Octave's toolkit differs (it clips a negative
`dsigmf` at 0 and requires integer exponents for `gbellmf`), MATLAB's definition is used.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import lru_cache
from math import isfinite
from typing import TYPE_CHECKING, Any, ClassVar

from comity_fis.errors import WrongValueError
from comity_fis.membership.turns import largest, turning_places

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

WIDTHS = range(-6, 7)
"""Knots are one width apart, up to six widths from a centre; beyond that a curve is featureless."""


@dataclass(frozen=True, slots=True)
class Curved:
    """A smooth membership function; its fields are MATLAB's parameters."""

    matlab: ClassVar[str]
    """Name in MATLAB."""

    def __call__(self, x: float) -> float:
        """Degree of `x`, in [0, 1]."""
        import numpy as np

        return float(self.degrees(np.array([x]))[0])

    def degrees(self, xs: Floats) -> Floats:
        """Degrees of an array of numbers, in the same shape."""
        import numpy as np
        import skfuzzy

        with np.errstate(over="ignore"):  # intermediate values may overflow where the degree is 0 or 1
            found = np.abs(self._by(skfuzzy, xs.ravel()))  # MATLAB's dsigmf is the absolute difference
        return np.asarray(found.reshape(xs.shape))

    def _by(self, skfuzzy: Any, xs: Floats) -> Any:
        """The value of scikit-fuzzy's function; its parameters mostly have the same order."""
        return getattr(skfuzzy, self.matlab)(xs, *self.parameters)

    @property
    def knots(self) -> tuple[float, ...]:
        """Ascending points between which the function is smooth and has at most one extremum."""
        raise NotImplementedError

    @property
    def turns(self) -> tuple[float, ...]:
        """The knots and the local extrema between them."""
        return self.knots

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters in MATLAB's order."""
        return tuple([getattr(self, field.name) for field in fields(self)])

    def height(self, low: float, high: float) -> float:
        """The largest degree in [low, high]."""
        return largest(self, self.turns, low, high)

    def _refuse_unless(self, holds: bool, expected: str) -> None:
        if not (holds and all(map(isfinite, self.parameters))):
            raise WrongValueError(expected=f"{self.matlab} with {expected}", got=list(self.parameters))


@dataclass(frozen=True, slots=True)
class _WidthFirst(Curved):
    """MATLAB has the width or slope before the centre, scikit-fuzzy after it."""

    def _by(self, skfuzzy: Any, xs: Floats) -> Any:
        numbers = self.parameters
        pairs = zip(numbers[1::2], numbers[::2], strict=True)
        return getattr(skfuzzy, self.matlab)(xs, *(number for pair in pairs for number in pair))


@dataclass(frozen=True, slots=True)
class Gaussian(_WidthFirst):
    """`exp(-(x - centre)^2 / (2 sigma^2))`."""

    matlab = "gaussmf"
    sigma: float
    centre: float

    def __post_init__(self) -> None:
        self._refuse_unless(self.sigma != 0, "a sigma that is not 0")

    @property
    def knots(self) -> tuple[float, ...]:
        """Knots around the centre."""
        return _around((self.centre, abs(self.sigma)))


@dataclass(frozen=True, slots=True)
class TwoSidedGaussian(Curved):
    """Rises as one Gaussian, is 1 between the centres, falls as another."""

    matlab = "gauss2mf"
    left_sigma: float
    left_centre: float
    right_sigma: float
    right_centre: float

    def __post_init__(self) -> None:
        self._refuse_unless(self.left_sigma != 0 and self.right_sigma != 0, "sigmas that are not 0")

    def _by(self, skfuzzy: Any, xs: Floats) -> Any:
        """The product of both sides: scikit-fuzzy's own function rejects crossed centres."""
        import numpy as np

        rise = skfuzzy.gaussmf(np.minimum(xs, self.left_centre), self.left_centre, self.left_sigma)
        fall = skfuzzy.gaussmf(np.maximum(xs, self.right_centre), self.right_centre, self.right_sigma)
        return rise * fall

    @property
    def knots(self) -> tuple[float, ...]:
        """Knots around both centres."""
        return _around((self.left_centre, abs(self.left_sigma)), (self.right_centre, abs(self.right_sigma)))

    @property
    def turns(self) -> tuple[float, ...]:
        """The knots and the local extrema between them."""
        return _turns(self)


@dataclass(frozen=True, slots=True)
class Bell(Curved):
    """`1 / (1 + |(x - centre) / width|^(2 exponent))`."""

    matlab = "gbellmf"
    width: float
    exponent: float
    centre: float

    def __post_init__(self) -> None:
        self._refuse_unless(
            self.width != 0 and self.exponent > 0, "a width that is not 0 and an exponent above 0"
        )

    @property
    def knots(self) -> tuple[float, ...]:
        """Knots around the centre and both points of degree 1/2: a large exponent makes flanks steep."""
        width = abs(self.width)
        flank = width / max(1.0, 2 * self.exponent)
        sides = self.centre - width, self.centre + width
        return _around((self.centre, width), *((side, flank) for side in sides))


@dataclass(frozen=True, slots=True)
class Sigmoid(_WidthFirst):
    """`1 / (1 + exp(-slope (x - centre)))`."""

    matlab = "sigmf"
    slope: float
    centre: float

    def __post_init__(self) -> None:
        self._refuse_unless(self.slope != 0, "a slope that is not 0")

    @property
    def knots(self) -> tuple[float, ...]:
        """Knots around the centre."""
        return _around((self.centre, 2 / abs(self.slope)))


@dataclass(frozen=True, slots=True)
class _TwoSigmoids(_WidthFirst):
    first_slope: float
    first_centre: float
    second_slope: float
    second_centre: float

    def __post_init__(self) -> None:
        self._refuse_unless(self.first_slope != 0 and self.second_slope != 0, "slopes that are not 0")

    @property
    def knots(self) -> tuple[float, ...]:
        """Knots around both centres."""
        return self._around_both

    @property
    def _around_both(self) -> tuple[float, ...]:
        return _around(
            (self.first_centre, 2 / abs(self.first_slope)), (self.second_centre, 2 / abs(self.second_slope))
        )

    @property
    def turns(self) -> tuple[float, ...]:
        """The knots and the local extrema between them."""
        return _turns(self)


@dataclass(frozen=True, slots=True)
class SigmoidDifference(_TwoSigmoids):
    """The absolute difference of two sigmoids."""

    matlab = "dsigmf"

    @property
    def knots(self) -> tuple[float, ...]:
        """Knots around both centres, and at the kink where the two sigmoids are equal."""
        if self.first_slope == self.second_slope:
            return self._around_both
        shift = self.first_slope * self.first_centre - self.second_slope * self.second_centre
        return tuple(sorted({*self._around_both, shift / (self.first_slope - self.second_slope)}))


@dataclass(frozen=True, slots=True)
class SigmoidProduct(_TwoSigmoids):
    """The product of two sigmoids."""

    matlab = "psigmf"


@dataclass(frozen=True, slots=True)
class SShape(Curved):
    """0 up to `foot`, 1 from `shoulder` on, two parabolas between."""

    matlab = "smf"
    foot: float
    shoulder: float

    def __post_init__(self) -> None:
        self._refuse_unless(self.foot < self.shoulder, "a foot below its shoulder")

    @property
    def knots(self) -> tuple[float, ...]:
        """The points where the parabolas start, join and end."""
        return self.foot, (self.foot + self.shoulder) / 2, self.shoulder


@dataclass(frozen=True, slots=True)
class ZShape(Curved):
    """1 up to `shoulder`, 0 from `foot` on, two parabolas between."""

    matlab = "zmf"
    shoulder: float
    foot: float

    def __post_init__(self) -> None:
        self._refuse_unless(self.shoulder < self.foot, "a shoulder below its foot")

    @property
    def knots(self) -> tuple[float, ...]:
        """The points where the parabolas start, join and end."""
        return self.shoulder, (self.shoulder + self.foot) / 2, self.foot


@dataclass(frozen=True, slots=True)
class PiShape(Curved):
    """Rises as an S from `left_foot`, falls as a Z to `right_foot`."""

    matlab = "pimf"
    left_foot: float
    left_shoulder: float
    right_shoulder: float
    right_foot: float

    def __post_init__(self) -> None:
        self._refuse_unless(
            self.left_foot < self.left_shoulder and self.right_shoulder < self.right_foot,
            "feet outside its shoulders",
        )

    def _by(self, skfuzzy: Any, xs: Floats) -> Any:
        """The product of both sides: scikit-fuzzy's own function rejects crossed shoulders."""
        rise = skfuzzy.smf(xs, self.left_foot, self.left_shoulder)
        return rise * skfuzzy.zmf(xs, self.right_shoulder, self.right_foot)

    @property
    def knots(self) -> tuple[float, ...]:
        """The points where the parabolas start, join and end."""
        left = self.left_foot, (self.left_foot + self.left_shoulder) / 2, self.left_shoulder
        right = self.right_shoulder, (self.right_shoulder + self.right_foot) / 2, self.right_foot
        return tuple(sorted((*left, *right)))

    @property
    def turns(self) -> tuple[float, ...]:
        """The knots and the local extrema between them."""
        return _turns(self)


CURVED: dict[str, type[Curved]] = {
    shape.matlab: shape
    for shape in (
        Gaussian,
        TwoSidedGaussian,
        Bell,
        Sigmoid,
        SigmoidDifference,
        SigmoidProduct,
        SShape,
        ZShape,
        PiShape,
    )
}
"""Curved shapes by MATLAB's name."""


def _around(*centres: tuple[float, float]) -> tuple[float, ...]:
    """Knots around several centres, each given with the width of the curve there."""
    return tuple(sorted({centre + k * width for centre, width in centres for k in WIDTHS}))


@lru_cache(maxsize=1024)
def _turns(curve: Curved) -> tuple[float, ...]:
    """Local extrema, found by search once per curve."""
    return turning_places(curve, curve.knots)
