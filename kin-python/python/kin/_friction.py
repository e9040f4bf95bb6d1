"""Dry friction in pins and slides."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Friction:
    """Dry friction in a joint, from the forces that the joint holds: μ times the sum of their magnitudes, against the slip v as
    tanh(v/v₀). Well above v₀ it is Coulomb's; at rest it holds nothing.   [-, m, rad/s or m/s]"""

    coefficient: float
    rate: float
    is_pin: bool
    _sizes: tuple[float, float]

    @staticmethod
    def pin(coefficient: float, radius: float, rate: float) -> "Friction":
        """In a pin of radius r: the torque μ r F tanh(ω/ω₀), F the force across its axis; ω₀ is the rate at which friction has
        three quarters of its full size.   [-, m, rad/s]"""
        return Friction(coefficient, rate, True, (radius, 0.0))

    @staticmethod
    def slide(coefficient: float, guide: tuple[float, float], rate: float) -> "Friction":
        """In a slide whose guide has a length L and a width b: μ (|N₁| + |N₂|) tanh(v/v₀), with N₁,₂ = F/2 ± M/L the forces at both
        ends of the guide, which move with body i of the joint, at the side that is pressed.   [-, m, m/s]"""
        length, width = guide
        return Friction(coefficient, rate, False, (length, width))

    def length(self, bearing: float) -> "Friction":
        """The same of a pin whose bearing is so long that it holds bending, by forces at its two ends.   [m]"""
        if not self.is_pin:
            raise ValueError("the length of a guide is given to `slide`; that of a bearing belongs to a pin")
        return Friction(self.coefficient, self.rate, True, (self._sizes[0], bearing))

    def _told(self) -> tuple[bool, float, tuple[float, float], float]:
        return self.is_pin, self.coefficient, self._sizes, self.rate


__all__ = ["Friction"]
