"""What a problem of one's own has to say."""

import numpy as np

#: Where each moment is in s: integrals of 1 x y z xy yz xz xx yy zz.
S1, SX, SY, SZ, SXY, SYZ, SXZ, SXX, SYY, SZZ = range(10)


class Problem:
    """Minimise value(s) subject to lower <= coefficients . s <= upper. Derive from it, and add_problem() it.

    s are the ten moments of the whole solid, (10,), in the body frame and its units: z along the axis (or up), origin
    at the contact, lengths in V^(1/3), masses in those of the solid body.
    """

    #: Linear rows: (name, coefficients (10,), lower, upper).
    rows = ()
    #: (lower, upper) of each nonlinear row; such problems are for solver="ipopt".
    limits = ()

    def value(self, s):
        """What is minimised."""
        raise NotImplementedError("value(s)")

    def gradient(self, s):
        """Of value, (10,)."""
        raise NotImplementedError("gradient(s)")

    def hessian(self, s):
        """Of value, (10, 10); zero unless said otherwise."""
        return np.zeros((10, 10))

    def nonlinear(self, s):
        """The nonlinear rows, (k,)."""
        return np.zeros(0)

    def jacobian(self, s):
        """Of the nonlinear rows, (k, 10)."""
        return np.zeros((0, 10))

    def curvature(self, s, multipliers):
        """Hessian of multipliers . nonlinear(s), (10, 10)."""
        return np.zeros((10, 10))

    def pose_loss(self, s):
        """Of finished solids in two poses of one body, the one with less does it better; for `find`."""
        return self.value(s)

    def verify(self, s, length_mm):
        """Judges a finished solid: (does it do what was asked, a sentence). length_mm is V^(1/3)."""
        raise NotImplementedError("verify(s, length_mm)")
