"""Where must material go inside a shape so that it spins, stands or floats, and how large a copy nests inside?

    import kreisel as kr
    session = kr.Session(kr.Body.read("bunny.off"))
    answer = session.solve("spin", size=60, wall=1.2)

Lengths in mm, masses in g, densities in g/cm^3, model coordinates; what ends in _body is in the body frame and
its units. Everything that goes wrong is an Error whose text is one line. records() needs h5py alone.
"""

import importlib

from ._records import BadRecord, records

_compiled = {"Body", "Device", "Error", "InputError", "Inspection", "Iteration", "Map", "Mending", "Nesting", "Part",
             "Place", "Question", "Session", "Shell", "Solid", "Solution", "Verdict", "add_problem", "inspect", "nest",
             "question_fields", "verify"}
_plain = {"Problem", "S1", "SX", "SY", "SZ", "SXY", "SYZ", "SXZ", "SXX", "SYY", "SZZ"}

__all__ = sorted({"BadRecord", "records"} | _compiled | _plain)


def __getattr__(name):
    """The rest is loaded when it is first asked for: records are read without numpy and the compiled part."""
    if name in _compiled or name in _plain:
        module = importlib.import_module("._session" if name in _compiled else "._problem", __name__)
        globals()[name] = getattr(module, name)
        return globals()[name]
    raise AttributeError(f"module 'kreisel' has no attribute '{name}'")


def __dir__():
    return sorted(__all__)
