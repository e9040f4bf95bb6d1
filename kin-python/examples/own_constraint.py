"""Pin in a parabolic slot, the equation and nothing else; a cam whose lift is a function: m, rad, s."""

import numpy as np

import kin
from kin import Planar, Vec2


@kin.constraint
def parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: float) -> kin.Scalar:
    """Pin in a parabolic slot: P of body i stays on y = k x², the slot being fixed in body j.  [m]"""
    s = j.local(i.point(u_i))
    return s.y - k * s.x**2


@kin.law
def lift(phi: kin.Coord) -> kin.Scalar:
    """A lift of 60 mm over one turn.   [m]"""
    return 0.03 * (1 - kin.cos(phi))


m = kin.Mechanism("slider in a slot")
slider = m.planar("slider", x=0.2, y=0.1)
m.add("slot", parabolic_slot(slider, m.ground, u_i=(0, 0), k=2.0))
m.add("upright", kin.drive_angle(slider, lift))
m.add("motor", kin.drive(slider.x, kin.Law.sine(0.3, 1.0)))
motion = m.build().run(np.linspace(0, 6, 601))
print(motion["slider.y"].acceleration[:3])
