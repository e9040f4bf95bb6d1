"""Kin: write a constraint C(q, t) = 0 once, get every derivative, and drive whole mechanisms with them.

    m = kin.Mechanism("crank and rocker")
    crank = m.link("crank", 1.0)
    m.add("O", kin.revolute(m.ground, crank, (0, 0), crank.start))
    m.add("motor", kin.drive_angle(crank, kin.Law.ramp(1.0)))
    motion = m.build().run(np.linspace(0, 6, 601))

Metre, radian, second; any consistent set of units works.
"""

from . import loads, spatial
from ._constraint import Constraint, Equation, branch, constraint, equation, law, measure, require
from ._diagnosis import Diagnosis
from ._dimension import Dimension, NumberLike
from ._errors import *  # noqa: F403
from ._errors import ALL as _ERRORS
from ._design import (
    Contribution,
    Extreme,
    Extremes,
    ExtremeSensitivity,
    Proved,
    Samples,
    Searched,
    SecondOrder,
    Sensitivities,
    Sensitivity,
    Tolerance,
)
from ._follower import Circuit, CircuitPoint, Configuration, Configurations, Follower
from ._map import Map, Mapped
from ._forces import Balance, BodyWrench, Drive, Energy, Forces, Growth, Reaction
from ._friction import Friction
from ._functions import (
    acos,
    acosh,
    asin,
    asinh,
    atan,
    atan2,
    atanh,
    cbrt,
    ceil,
    clip,
    cos,
    cosh,
    degrees,
    exp,
    exp2,
    expm1,
    fabs,
    floor,
    hypot,
    log,
    log1p,
    log2,
    log10,
    maximum,
    minimum,
    pi,
    power,
    radians,
    sign,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
    tau,
    trunc,
    where,
)
from ._handles import Coordinate, Ground, Link, PlanarBody, SpatialBody, SpatialLink, ground
from ._joint import Joint
from ._law import Law, LawRange
from ._load import Force, Load, Potential, force, potential
from ._mechanism import Mechanism, Terms
from ._motion import Break, Displacement, Event, Motion, MotionWarning, Peak, Point, Quantity, Rotation
from ._scalars import Scalar
from ._solid import Solid
from ._states import Coord, Planar, Rate, Spatial, Time
from ._sweeps import Batch, Rows, sweep
from ._pictures import Page, Picture
from ._released import Granted, Reached, Released, Wish
from ._results import Assemblies, Assembly, Compiled, Proof, Solution, StepProof
from ._system import System
from ._vectors import Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3, vec2, vec3
from .library import *  # noqa: F403
from .library import __all__ as _LIBRARY

deg = radians

__all__ = [
    *_ERRORS,
    *_LIBRARY,
    "Assemblies",
    "Assembly",
    "Axis",
    "Balance",
    "Batch",
    "BodyWrench",
    "Break",
    "Compiled",
    "Configuration",
    "Configurations",
    "Constraint",
    "Contribution",
    "Coord",
    "Coordinate",
    "Diagnosis",
    "Dimension",
    "Displacement",
    "Drive",
    "Energy",
    "Equation",
    "EulerParameters",
    "Event",
    "Extreme",
    "Extremes",
    "ExtremeSensitivity",
    "Force",
    "Forces",
    "Friction",
    "Granted",
    "Ground",
    "Growth",
    "Joint",
    "Law",
    "LawRange",
    "Link",
    "Load",
    "Mat2",
    "Mat3",
    "Mechanism",
    "Motion",
    "MotionWarning",
    "NumberLike",
    "Page",
    "Peak",
    "Picture",
    "Planar",
    "PlanarBody",
    "Point",
    "Potential",
    "Proof",
    "Proved",
    "Quantity",
    "Rate",
    "Reached",
    "Reaction",
    "Released",
    "Rotation",
    "Rows",
    "Samples",
    "Scalar",
    "Searched",
    "SecondOrder",
    "Sensitivities",
    "Sensitivity",
    "Solid",
    "Solution",
    "Spatial",
    "SpatialBody",
    "SpatialLink",
    "StepProof",
    "System",
    "Terms",
    "Time",
    "Tolerance",
    "Vec2",
    "Vec3",
    "Wish",
    "acos",
    "acosh",
    "asin",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "branch",
    "cbrt",
    "ceil",
    "Circuit",
    "CircuitPoint",
    "clip",
    "constraint",
    "cos",
    "cosh",
    "deg",
    "degrees",
    "equation",
    "exp",
    "exp2",
    "expm1",
    "fabs",
    "floor",
    "Follower",
    "Map",
    "Mapped",
    "force",
    "ground",
    "hypot",
    "law",
    "loads",
    "log",
    "log10",
    "log1p",
    "log2",
    "maximum",
    "measure",
    "minimum",
    "pi",
    "potential",
    "power",
    "radians",
    "require",
    "sign",
    "sin",
    "sinh",
    "spatial",
    "sqrt",
    "sweep",
    "tan",
    "tanh",
    "tau",
    "trunc",
    "vec2",
    "vec3",
    "where",
]
