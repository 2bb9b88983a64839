"""Where must material go inside a shape so that it spins, stands or floats, and how large a copy nests inside?

    import kreisel as kr
    session = kr.Session(kr.Body.read("bunny.off"))
    answer = session.solve("spin", size=60, wall=1.2)

Lengths in mm, masses in g, densities in g/cm^3, model coordinates; what ends in _body is in the body frame and
its units. Everything that goes wrong is an Error whose text is one line. records() needs h5py alone.
"""

from ._records import BadRecord, records

__all__ = ["BadRecord", "Body", "Device", "Error", "InputError", "Iteration", "Map", "Nesting", "Part", "Place",
           "Question", "Session", "Solution", "Verdict", "nest", "records", "verify"]

_compiled = set(__all__) - {"BadRecord", "records"}


def __getattr__(name):
    """The compiled part is loaded when it is first asked for: records are read without it."""
    if name in _compiled:
        from . import _session
        value = getattr(_session, name)
        globals()[name] = value
        return value
    raise AttributeError(f"module 'kreisel' has no attribute '{name}'")


def __dir__():
    return sorted(__all__)
