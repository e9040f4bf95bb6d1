"""Mechanisms around one constraint, and states at random."""

import numpy as np

import kin


def random_state(kinds, random):
    """Coordinates of bodies one after the other."""
    q = []
    for kind in kinds:
        if kind == "Spatial":
            p = random.normal(size=4)
            q += [*random.normal(size=3), *(p / np.linalg.norm(p))]
        elif kind == "Planar":
            q += list(random.normal(size=3))
        else:
            q += [random.normal()]
    return np.array(q)


SIZES = {"Planar": 3, "Spatial": 7, "Coord": 1}


def kinds_of(traced):
    """Kinds of the bodies of a traced function."""
    return [one.kind for one in traced._arguments if one.is_body for _ in range(one.count or 1)]


def bodies(mechanism, kinds):
    """A body or coordinate of the mechanism for each."""
    made = []
    for k, kind in enumerate(kinds):
        if kind == "Planar":
            made.append(mechanism.planar(f"b{k}"))
        elif kind == "Spatial":
            made.append(mechanism.spatial(f"b{k}"))
        else:
            made.append(mechanism.angle(f"b{k}", 0.0))
    return made


def called(function, traced, handles, parameters):
    """The function called with bodies, lists of them where it wants lists, and parameters."""
    handles, parameters, args = list(handles), list(parameters), []
    for one in traced._arguments:
        if one.is_body:
            args.append(handles.pop(0) if one.count is None else [handles.pop(0) for _ in range(one.count)])
        elif one.kind != "Time":
            if parameters:
                args.append(parameters.pop(0))
    return function(*args)


def plain(traced, q, t, parameters):
    """The rows of the function as it is written, at plain numbers."""
    q, parameters, args = list(q), list(parameters), []

    def body(kind):
        size = SIZES[kind]
        own, q[:size] = q[:size], []
        return float(own[0]) if kind == "Coord" else getattr(kin, kind)(*own)

    for one in traced._arguments:
        if one.is_body:
            args.append(body(one.kind) if one.count is None else [body(one.kind) for _ in range(one.count)])
        elif one.kind == "Time":
            args.append(t)
        else:
            value = parameters.pop(0)
            made = {"Vec2": kin.Vec2, "Vec3": kin.Vec3, "EulerParameters": kin.EulerParameters, "Mat3": kin.Mat3}
            args.append(made[one.kind](*value) if one.kind in made else value)
    return np.array(traced.plain(*args))


def columns(system, handles):
    """Where the coordinates of bodies stand."""
    names = system.names
    found = []
    for handle in handles:
        own = [k for k, name in enumerate(names) if name == handle.name or name.startswith(handle.name + ".")]
        found += own
    return found
