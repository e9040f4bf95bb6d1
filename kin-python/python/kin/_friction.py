"""Defines dry friction in pins and slides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable

from ._dimension import NumberLike


@dataclass(frozen=True)
class Friction:
    """Dry friction in a joint: μ times the sum of the contact forces, times tanh(v/v₀) against the slip v. [-, m, rad/s
    or m/s]

    If v is much larger than v₀, the formula gives Coulomb friction. At rest the friction is zero.
    """

    coefficient: NumberLike
    rate: NumberLike
    is_pin: bool
    _sizes: tuple[NumberLike, NumberLike]

    @staticmethod
    def pin(coefficient: NumberLike, radius: NumberLike, rate: NumberLike) -> "Friction":
        """Creates the friction of a pin of radius r: the torque is μ r F tanh(ω/ω₀), where F is the force across the
        axis. [-, m, rad/s]

        At ω₀ the friction has three quarters of its full size. Each argument is a number or a dimension.
        """
        return Friction(coefficient, rate, True, (radius, 0.0))

    @staticmethod
    def slide(coefficient: NumberLike, guide: tuple[NumberLike, NumberLike], rate: NumberLike) -> "Friction":
        """Creates the friction of a slide with a guide of length L and width b. [-, m, m, m/s]

        The friction is μ (|N₁| + |N₂|) tanh(v/v₀), where N₁,₂ = F/2 ± M/L are the contact forces at both ends of the
        guide. The contacts move with body i of the joint, and friction acts on the loaded side of the guide.
        """
        length, width = guide
        return Friction(coefficient, rate, False, (length, width))

    def length(self, bearing: NumberLike) -> "Friction":
        """Sets the length of the pin's bearing, which carries a bending moment by forces at its two ends. [m]"""
        if not self.is_pin:
            raise ValueError("`slide` takes the length of a guide; the length of a bearing belongs to a pin")
        return Friction(self.coefficient, self.rate, True, (self._sizes[0], bearing))

    def _told(self, number: Callable[[Any], Any]) -> tuple[bool, Any, tuple[Any, Any], Any]:
        first, second = self._sizes
        return self.is_pin, number(self.coefficient), (number(first), number(second)), number(self.rate)


__all__ = ["Friction"]
