"""Dry friction in pins and slides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable

from ._dimension import NumberLike


@dataclass(frozen=True)
class Friction:
    """Dry friction in a joint, from the forces that the joint holds: μ times the sum of their magnitudes, against the slip v as
    tanh(v/v₀). Well above v₀ it is Coulomb's; at rest it holds nothing.   [-, m, rad/s or m/s]"""

    coefficient: NumberLike
    rate: NumberLike
    is_pin: bool
    _sizes: tuple[NumberLike, NumberLike]

    @staticmethod
    def pin(coefficient: NumberLike, radius: NumberLike, rate: NumberLike) -> "Friction":
        """In a pin of radius r: the torque μ r F tanh(ω/ω₀), F the force across its axis; ω₀ is the rate at which friction has
        three quarters of its full size. Each of them is a number or a dimension.   [-, m, rad/s]"""
        return Friction(coefficient, rate, True, (radius, 0.0))

    @staticmethod
    def slide(coefficient: NumberLike, guide: tuple[NumberLike, NumberLike], rate: NumberLike) -> "Friction":
        """In a slide whose guide has a length L and a width b: μ (|N₁| + |N₂|) tanh(v/v₀), with N₁,₂ = F/2 ± M/L the forces at both
        ends of the guide, which move with body i of the joint, at the side that is pressed.   [-, m, m/s]"""
        length, width = guide
        return Friction(coefficient, rate, False, (length, width))

    def length(self, bearing: NumberLike) -> "Friction":
        """The same of a pin whose bearing is so long that it holds bending, by forces at its two ends.   [m]"""
        if not self.is_pin:
            raise ValueError("`slide` takes the length of a guide; the length of a bearing belongs to a pin")
        return Friction(self.coefficient, self.rate, True, (self._sizes[0], bearing))

    def _told(self, number: Callable[[Any], Any]) -> tuple[bool, Any, tuple[Any, Any], Any]:
        first, second = self._sizes
        return self.is_pin, number(self.coefficient), (number(first), number(second)), number(self.rate)


__all__ = ["Friction"]
