"""Solids as pictures: triangles, cut open where wanted, seen along a direction; and sections of them."""

import numpy as np

import style

LIGHT = np.array([-0.45, 0.55, 0.75])  # from the solid, in the picture: right, up, towards the eye


class Canvas:
    """An orthographic view in which the sample nearest to the eye wins. Colours are RGB, 0 to 1."""

    def __init__(self, right, up, corners, pixels):
        """corners: [n, 3] points that have to be seen; pixels along the longer side."""
        self.axes = np.stack([right, up, np.cross(right, up)])
        seen = corners @ self.axes.T
        low, high = seen[:, :2].min(0), seen[:, :2].max(0)
        self.pixel = max(high - low) / (0.96 * pixels)
        self.low = (low + high) / 2 - (high - low) / 0.96 / 2
        self.shape = np.ceil((high - low) / 0.96 / self.pixel).astype(int) + 1
        self.depth = np.full(self.shape.prod(), -np.inf)
        self.image = np.ones((self.shape.prod(), 3))

    def points(self, points, colours):
        seen = points @ self.axes.T
        cell = ((seen[:, :2] - self.low) / self.pixel).astype(int)
        good = ((cell >= 0) & (cell < self.shape)).all(1)
        cell, depth, colours = cell[good] @ [1, self.shape[0]], seen[good, 2], colours[good]
        order = np.argsort(depth, kind="stable")
        near, best = np.full_like(self.depth, -np.inf), self.image.copy()
        near[cell[order]], best[cell[order]] = depth[order], colours[order]  # the last one written is the nearest
        nearer = near > self.depth
        self.depth[nearer], self.image[nearer] = near[nearer], best[nearer]

    def triangles(self, corners, colour, keep=None, back=None):
        """corners: [n, 3, 3]; keep: of points [m, 3], which are drawn; back: colour of what is seen from inside."""
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-300
        facing = normal @ self.axes.T
        front = facing[:, 2] > 0
        lit = np.where(front[:, None], facing, -facing) @ (LIGHT / np.linalg.norm(LIGHT))
        shade = 0.42 + 0.58 * np.clip(lit, 0, 1)
        colours = np.where(front[:, None], rgb(colour), rgb(back or colour)) * shade[:, None]
        wanted = np.ones(len(corners), bool) if back else front
        steps = np.ceil(1.5 * np.ptp(corners @ self.axes[:2].T, axis=1).max(1) / self.pixel).astype(int) + 1
        for count in np.unique(steps[wanted]):
            u, v = (grid.ravel() for grid in np.meshgrid(*2 * [np.linspace(0, 1, count + 1)]))
            weights = np.stack([1 - u - v, u, v])[:, u + v < 1 + 1e-9]
            some = np.flatnonzero(wanted & (steps == count))
            for part in np.array_split(some, max(1, len(some) * weights.shape[1] // 2_000_000)):
                points = np.einsum("kp,nkc->npc", weights, corners[part]).reshape(-1, 3)
                colour_of = np.repeat(colours[part], weights.shape[1], axis=0)
                if keep is not None:
                    kept = keep(points)
                    points, colour_of = points[kept], colour_of[kept]
                self.points(points, colour_of)

    def show(self, axes):
        axes.imshow(self.image.reshape(self.shape[1], self.shape[0], 3), origin="lower", interpolation="antialiased")
        axes.axis("off")


def rgb(colour):
    return np.array(style.plt.matplotlib.colors.to_rgb(colour))


class Raster:
    """Cells of a plane: `origin` + x `across` + y `along`, that cover the given points, [n, 3]."""

    def __init__(self, origin, across, along, points, cells):
        self.origin, self.across, self.along = origin, across, along
        flat = self.flat(points)
        low, high = flat.min(0), flat.max(0)
        self.cell = max(high - low) / cells
        self.low = low - 2 * self.cell
        self.shape = np.ceil((high - low) / self.cell).astype(int) + 5  # nx, ny

    def flat(self, points):
        return (points - self.origin) @ np.stack([self.across, self.along]).T

    def extent(self):
        high = self.low + self.shape * self.cell
        return self.low[0], high[0], self.low[1], high[1]

    def inside(self, corners):
        """Which cells' centres lie inside a closed mesh: [ny, nx], even-odd along every row."""
        normal = np.cross(self.across, self.along)
        side = (corners - self.origin) @ normal > 0
        corners, side = (a[side.any(1) & ~side.all(1)] for a in (corners, side))
        # The corner that is alone on its side comes first; both its edges cross.
        alone = np.where(side.sum(1) == 1, side.argmax(1), (~side).argmax(1))
        rows = np.arange(len(corners))
        apex = corners[rows, alone]
        ends = []
        for step in (1, 2):
            other = corners[rows, (alone + step) % 3]
            from_plane, to_plane = (apex - self.origin) @ normal, (other - self.origin) @ normal
            ends.append(self.flat(apex + (from_plane / (from_plane - to_plane))[:, None] * (other - apex)))
        a, b = ((e - self.low) / self.cell - 0.5 for e in ends)
        a, b = np.where((a[:, 1] <= b[:, 1])[:, None], a, b), np.where((a[:, 1] <= b[:, 1])[:, None], b, a)
        first, last = np.ceil(a[:, 1]).astype(int), np.ceil(b[:, 1]).astype(int)
        which = np.repeat(np.arange(len(a)), last - first)
        row = np.arange(len(which)) - np.repeat(np.cumsum(last - first) - (last - first), last - first) + first[which]
        x = a[which, 0] + (b - a)[which, 0] * (row - a[which, 1]) / (b - a)[which, 1]
        toggles = np.zeros(self.shape[::-1], int)
        np.add.at(toggles, (row, np.clip(np.ceil(x).astype(int), 0, self.shape[0] - 1)), 1)
        return np.cumsum(toggles, axis=1) % 2 == 1

    def shadow(self, corners, keep, direction):
        """Which cells the kept points of a mesh meet when they move along a direction."""
        normal = np.cross(self.across, self.along)
        longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(1)
        steps = np.ceil(1.5 * longest / self.cell).astype(int) + 1
        met = np.zeros(self.shape[::-1], bool)
        for count in np.unique(steps):
            u, v = (grid.ravel() for grid in np.meshgrid(*2 * [np.linspace(0, 1, count + 1)]))
            weights = np.stack([1 - u - v, u, v])[:, u + v < 1 + 1e-9]
            points = np.einsum("kp,nkc->npc", weights, corners[steps == count]).reshape(-1, 3)
            points = points[keep(points)]
            moved = points - ((points - self.origin) @ normal / (direction @ normal))[:, None] * direction
            cell = np.clip(((self.flat(moved) - self.low) / self.cell).astype(int), 0, self.shape - 1)
            met[cell[:, 1], cell[:, 0]] = True
        return met

    def centres(self, mask):
        """Points in space of the cells where mask [ny, nx] holds."""
        y, x = np.nonzero(mask)
        flat = self.low + (np.stack([x, y], 1) + 0.5) * self.cell
        return self.origin + flat @ np.stack([self.across, self.along])
