#!/usr/bin/python3
"""Does the certificate in a record prove what it says? Knows nothing of the program that made it.

    check_certificate.py RECORD.h5

h(q), the least q . s of any interior of the domain, is computed again: every interval is clipped by the quadric with
arithmetic of this file, in double, and its rounding error is subtracted. Exit status 1 when anything fails to hold.
Method and proofs: docs/quadric.md, section 4.
"""

import math
import sys

import h5py
import numpy as np

EPS = 2.0**-53
X, Y, Z, XY, YZ, XZ, XX, YY, ZZ = range(1, 10)  # behind the constant, in the order of moments


class Domain:
    """All fillings of a domain's intervals, by the least value of a linear form of their total moments."""

    def __init__(self, file):
        domain, certificate = file["domain"], file["certificate"]
        origin, h = domain["grid_origin"][:], domain.attrs["spacing"]
        ix, iy, low, high = domain["intervals"][:].astype(float).T
        x, y = origin[0] + h * (ix + 0.5), origin[1] + h * (iy + 0.5)
        exact = domain.attrs["kind"] == "exact"  # heights as they are; else faces of cells
        self.lower, self.upper = (low, high) if exact else (origin[2] + h * low, origin[2] + h * high)
        one, mean = np.ones_like(x), h * h / 12
        self.across = {0: np.stack([one, x, y, x * y, x * x + mean, y * y + mean]),  # with z^0
                       1: np.stack([one, y, x]),                                     # with z^1
                       2: one[None]}
        self.area = h * h
        self.fixed, self.contrast = file["body/fixed"][:], certificate.attrs["contrast"]
        self.interior = self.integrals(self.lower, self.upper)
        longest = np.maximum(abs(self.lower), abs(self.upper))
        sizes = self.integrals(np.zeros_like(x), self.upper - self.lower, longest, absolute=True)
        self.sizes = abs(self.fixed) + self.contrast * sizes
        # numpy adds in pairs, blocks of 128 in eight lanes.
        self.chain = 128 / 8 + 8 + math.ceil(math.log2(len(x) + 1)) + 2 * 3

    COLUMNS = {0: [0, X, Y, XY, XX, YY], 1: [Z, YZ, XZ], 2: [ZZ]}

    def integrals(self, z0, z1, longest=None, absolute=False):
        """Moments of the pieces from z0 to z1 of every interval; with `absolute`, what they may be at most."""
        out = np.zeros(10)
        length = z1 - z0
        heights = {0: length,
                   1: length * longest if absolute else length * (z0 + z1) / 2,
                   2: length * longest**2 if absolute else length * (z0 * z0 + z0 * z1 + z1 * z1) / 3}
        for power, columns in self.COLUMNS.items():
            factors = abs(self.across[power]) if absolute else self.across[power]
            out[columns] = self.area * np.sum(factors * heights[power], axis=1)
        return out

    def least(self, q):
        """h(q) as computed, and what it may be too high by."""
        c = q[self.COLUMNS[0]] @ self.across[0]
        b = q[self.COLUMNS[1]] @ self.across[1]
        a = np.full_like(c, q[ZZ])
        with np.errstate(divide="ignore", invalid="ignore"):
            d = -0.5 * (b + np.copysign(np.sqrt(np.maximum(b * b - 4 * a * c, 0)), b))
            roots = np.stack([d / a, c / d])
        roots = np.where(np.isfinite(roots) & (b * b > 4 * a * c), roots, self.lower)
        cuts = np.sort(np.clip(roots, self.lower, self.upper), axis=0)
        ends = [self.lower, cuts[0], cuts[1], self.upper]
        s = self.fixed.copy()
        for z0, z1 in zip(ends, ends[1:]):
            middle = (z0 + z1) / 2
            inside = c + middle * (b + a * middle) < 0
            s = s + self.contrast * self.integrals(z0, np.where(inside, z1, z0))
        return q @ s, (self.chain + 32) * EPS * (abs(q) @ self.sizes)

    def positive(self, q):
        h, margin = self.least(q)
        return h - margin >= 0


def unit(k):
    return np.eye(10)[k]


def box_quadric(box, c, t):
    q = box["u1"] * (unit(YY) + unit(ZZ)) + box["u2"] * (unit(XX) + unit(ZZ)) - t * (unit(XX) + unit(YY))
    q += math.sqrt(2) * box["u3"] * unit(XY) - (box["nu"] + box["kappa"]) * unit(Z)
    q += box["mu_x"] * unit(X) + box["mu_y"] * unit(Y) + box["mu_xz"] * unit(XZ) + box["mu_yz"] * unit(YZ)
    q[0] = box["nu"] * c - (box["u1"] + box["u2"]) * c * c
    return q


def least_between(rate, bend, gamma, ends, t):
    """The least rate w + bend w^2 + gamma max(t(w), 0)^2 between two ends, t straight between them: convex in w."""
    (w0, w1), (t0, t1) = ends, t
    shares = [0.0, 1.0]
    if w1 > w0:
        slope = (t1 - t0) / (w1 - w0)
        curved = bend + gamma * slope * slope
        places = [-(rate / 2 + gamma * slope * (t0 - slope * w0)) / curved] if curved > 0 else []
        places += [-rate / (2 * bend)] if bend > 0 else []
        places += [w0 - t0 / slope] if slope != 0 else []
        shares += [min(max((w - w0) / (w1 - w0), 0.0), 1.0) for w in places]
    # A minimum is flat: the arithmetic of its place does not count.
    values = []
    for share in shares:
        w, height = w0 + share * (w1 - w0), max(t0 + share * (t1 - t0), 0)
        values.append(rate * w + bend * w * w + gamma * height**2)
    return min(values)


def weights_of(file, expect):
    """Weights of c_z, c_z^2, sz^2 and the inertia ratio, which must be those of the run."""
    config, stored = file["config"].attrs, file["certificate"].attrs
    problem, gamma_c = config["problem"], float(config.get("problem.gamma_c", 1))
    lower = config.get("problem.lower", "mass") if problem == "top" else "none"
    want = {"lambda": float(config.get("problem.lambda", 0)) if problem == "spin" else 0,
            "height": gamma_c if lower == "height" else 0,
            "moment": gamma_c if lower == "mass" else 0,
            "gamma_i": float(config.get("problem.gamma_i", 1))}
    for name, value in want.items():
        expect(stored.get(name, 0) == value, f"{name} is not the run's")
    return want.values()


def inertia_ratio(s):
    c = s[Z] / s[0]
    j = np.array([s[YY] + s[ZZ] - c * s[Z], s[XX] + s[ZZ] - c * s[Z], math.sqrt(2) * s[XY]])
    return (j @ j) / (s[XX] + s[YY]) ** 2


def boxes_of(certificate, expect):
    """Every box by the names of its columns, and its quadrics; what an older record lacks is not confined."""
    table = certificate["boxes"]
    any_moment = {"sz_low": -math.inf, "sz_high": math.inf, "t_low_above": 0.0, "t_high_above": 0.0, "kappa": 0.0}
    boxes = [any_moment | dict(zip(table.attrs["columns"], row)) for row in table[:]]
    quadrics = certificate["box_quadrics"][:]
    expect(len(boxes) > 0 and len(quadrics) % len(boxes) == 0, "no boxes, or not as many quadrics for each")
    return boxes, quadrics.reshape(len(boxes), -1, 10) if boxes else []


def check_cover(certificate, boxes, problem, expect):
    """Does every height, and every first moment that counts, lie in a box?"""
    if certificate.attrs["kind"] == "yoyo":
        expect(problem == "yoyo", "nothing holds the centre of mass at the origin")
        expect(len(boxes) == 1 and boxes[0]["c_low"] == boxes[0]["c_high"] == 0, "not the one box of the height 0")
        return
    most = certificate.attrs.get("sz_most", 0) if certificate.attrs["kind"] == "top" else math.inf
    low, high, below, above = (np.array([box[k] for box in boxes]) for k in ("c_low", "c_high", "sz_low", "sz_high"))
    expect(low.min() == -math.inf and high.max() == math.inf, "the boxes do not reach to infinity")
    heights = np.unique(np.concatenate([low, high]))
    for c0, c1 in zip(heights, heights[1:]):
        reached = -most
        over = (low <= c0) & (high >= c1)
        for i in np.flatnonzero(over)[np.argsort(below[over])]:
            if below[i] <= reached:
                reached = max(reached, above[i])
        if reached < most:
            expect(False, f"nothing covers the heights from {c0:g} to {c1:g}")
            return


def check_box(i, box, stored, domain, expect):
    u = np.array([box["u1"], box["u2"], box["u3"]])
    expect(u @ u <= 1 and u[0] >= 0 and u[1] >= 0, f"box {i}: u is not in its set")
    confined = math.isfinite(box["sz_low"]) and math.isfinite(box["sz_high"])
    expect(confined or box["kappa"] == 0, f"box {i}: kappa without first moments")
    corners = [(box["c_low"], box["sz_low"], box["t_low"]), (box["c_high"], box["sz_low"], box["t_high"])]
    if confined:
        corners += [(box["c_low"], box["sz_high"], box["t_low_above"]),
                    (box["c_high"], box["sz_high"], box["t_high_above"])]
    for (c, sz, t), q in zip(corners, stored):
        if math.isinf(c):
            # No end: what is affine in c must not fall towards it.
            expect(box["empty"] == 1 and not u.any() and box["nu"] * math.copysign(1, c) >= 0,
                   f"box {i}: nothing holds towards infinity")
            continue
        expect(np.allclose(box_quadric(box, c, t), q, rtol=1e-13, atol=1e-13), f"box {i}: another quadric is stored")
        h, margin = domain.least(box_quadric(box, c, t))
        offset = box["kappa"] * sz if confined else 0.0
        h, margin = h + offset, margin + 2 * EPS * abs(offset)
        if box["empty"]:
            expect(not u.any() and t == 0 and h - margin > 0, f"box {i}: not proved to be empty")
        else:
            expect(h - margin >= 0, f"box {i}: h = {h:.3e} < {margin:.3e} at its end {c:g}")


def check_boxes(file, domain, expect):
    certificate = file["certificate"]
    rate, bend, moment, gamma = weights_of(file, expect)
    s = file["solve/moments"][:]
    c = s[Z] / s[0]
    f = rate * c + bend * c * c + moment * s[Z] ** 2 + gamma * inertia_ratio(s)
    kind = certificate.attrs["kind"]
    expect(moment == 0 or kind == "top", "the weight of sz^2 is that of a top")
    boxes, quadrics = boxes_of(certificate, expect)
    if not boxes:
        return f, -math.inf
    check_cover(certificate, boxes, file["config"].attrs["problem"], expect)
    for i, (box, stored) in enumerate(zip(boxes, quadrics)):
        check_box(i, box, stored, domain, expect)
        if box["empty"]:
            expect(box["value"] == math.inf, f"box {i} is empty, with a value")
            continue
        heights, first = (box["c_low"], box["c_high"]), (box["sz_low"], box["sz_high"])
        if moment:
            # Over first moments, along both ends of the height: between those t is no less.
            least = least_between(rate, bend, 0, heights, (0, 0)) + min(
                least_between(0, moment, gamma, first, (box[low], box[high]))
                for low, high in (("t_low", "t_low_above"), ("t_high", "t_high_above")))
        else:
            least = least_between(rate, bend, gamma, heights, (box["t_low"], box["t_high"]))
        expect(box["value"] <= least + 4 * EPS * abs(least), f"box {i}: {box['value']} > {least}")
    # What no box of a top covers has a larger sz^2.
    beyond = moment * certificate.attrs["sz_most"] ** 2 if kind == "top" else math.inf
    return f, min(beyond, *(box["value"] for box in boxes), math.inf)


def check_multipliers(file, expect):
    certificate = file["certificate"]
    equality, mu = certificate["equality"][:], certificate["multipliers"][:]
    expect(len(mu) == len(equality) == len(certificate["rows"]), "not a multiplier for each row")
    expect(np.all(mu[equality == 0] >= 0), "a negative multiplier of an inequality")
    return mu @ certificate["rows"][:].reshape(-1, 10), float(mu @ certificate["bounds"][:])


def check_linear(file, domain, expect):
    form, offset = check_multipliers(file, expect)
    objective = file["certificate/objective"][:].ravel()
    h, margin = domain.least(objective + form)
    return objective @ file["solve/moments"][:], h - margin - offset


def check_ratio(file, domain, expect):
    certificate = file["certificate"]
    form, offset = check_multipliers(file, expect)
    numerators, w = certificate["numerators"][:].reshape(-1, 10), certificate["weights"][:]
    denominator, s = certificate["denominator"][:].ravel(), file["solve/moments"][:]
    expect(len(w) == len(numerators) and np.all(w >= 0) and abs(w.sum() - 1) < 1e-12, "weights are none")
    expect(not np.any(certificate["bounds"][:]), "a ratio's rows have other bounds than 0")
    h, margin = domain.least(denominator)
    expect(h - margin > 0, "the denominator is not positive")
    bound = certificate.attrs["bound"]
    fine = math.isfinite(bound) and domain.positive(w @ numerators + form - bound * denominator)
    return np.max(numerators @ s) / (denominator @ s), bound if fine else -math.inf


def check_masses(file, domain, expect):
    """Shell, interior and solid belong together."""
    def same(one, other):
        return np.allclose(one, other, rtol=1e-9, atol=1e-12)

    config, shell = file["config"].attrs, file["body"].attrs["density"]
    light, heavy = sorted((float(config.get("interior-density", shell)), float(config.get("void-density", 0))))
    expect(same(domain.contrast, (heavy - light) / shell), "the contrast is not that of the densities")
    expect(same(domain.interior, file["body/interior"][:]), "the interior is not that of the intervals")
    expect(same(domain.fixed + (1 - light / shell) * domain.interior, file["body/solid"][:]),
           "shell and interior do not add up to the solid")


def check_infeasible(file, domain, expect):
    form, offset = check_multipliers(file, expect)
    h, margin = domain.least(form)
    expect(h - margin - offset > 0, "nothing separates the rows from the interiors")
    expect(file.attrs["termination"] == "infeasible", "the run says that there is a result")
    return None, math.inf


KINDS = {"linear": check_linear, "ratio": check_ratio, "spin": check_boxes, "yoyo": check_boxes, "top": check_boxes,
         "infeasible": check_infeasible}


def check(file):
    """What fails to hold, a line each, and a sentence of what does."""
    wrong = []

    def expect(fine, what):
        if not fine:
            wrong.append(what)

    certificate = file["certificate"]
    kind, bound, objective = certificate.attrs["kind"], certificate.attrs["bound"], file.attrs["objective"]
    if kind not in KINDS:
        return [f"kind is {kind}, expected one of {', '.join(KINDS)}"], ""
    domain = Domain(file)
    check_masses(file, domain, expect)
    f, proved = KINDS[kind](file, domain, expect)
    expect(bound <= proved, f"the bound is {bound}, but {proved} is proved")
    expect(file.attrs["bound"] == bound, "two bounds are stored")
    if f is not None:
        expect(abs(f - objective) <= 1e-9 * max(abs(f), 1), f"f is {f} of the stored moments, not {objective}")
        met = file.attrs["constraint_violation"] <= 1e-6
        gap = (objective - bound) / abs(objective) if math.isfinite(bound) and met else math.inf
        expect(file.attrs["gap"] == gap or abs(file.attrs["gap"] - gap) <= 1e-12, "the gap is another")
    number = f", {len(certificate['boxes'])} boxes" if kind in ("spin", "top") else ""
    what = "no interior meets the constraints" if kind == "infeasible" else f"f >= {bound:.9g}"
    return wrong, f"{what}, {kind}{number}: proved"


def main():
    if len(sys.argv) != 2:
        print("usage: check_certificate.py RECORD.h5", file=sys.stderr)
        return 2
    with h5py.File(sys.argv[1], "r") as file:
        wrong, sentence = check(file) if "certificate" in file else (["no certificate"], "")
    print(f"{sys.argv[1]}: {sentence if not wrong else f'{len(wrong)} fault(s): ' + wrong[0]}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
