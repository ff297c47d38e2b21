"""Rigid motions that lay one shape over another: of pairs of points, and of points on a surface by iterated closest points."""

from dataclasses import dataclass
from itertools import permutations, product

import numpy as np

SAMPLE = 2000  # points with which beginnings are tried
MOST_TURNS = 60
OUTLIER = 4.685  # of Tukey's weight, in scaled deviations (Holland and Welsch, Commun. Stat. A6, 1977, 813)
SHARE, SHARE_OF_NORMAL = 0.9, 1.645  # of the points that tell the spread, and the quantile of a normal distribution there
SETTLED = 1e-9  # of the extent: less moves no more


@dataclass
class Motion:
    """x -> rotation x + shift [m]."""

    rotation: np.ndarray
    shift: np.ndarray

    def __call__(self, points):
        return points @ self.rotation.T + self.shift

    def after(self, other):
        """This motion after another one."""
        return Motion(self.rotation @ other.rotation, self.rotation @ other.shift + self.shift)

    def angle(self):
        """[degrees]"""
        sine = 0.5 * np.linalg.norm([self.rotation[2, 1] - self.rotation[1, 2], self.rotation[0, 2] - self.rotation[2, 0],
                                     self.rotation[1, 0] - self.rotation[0, 1]])
        return float(np.degrees(np.arctan2(sine, 0.5 * (np.trace(self.rotation) - 1))))


def identity():
    return Motion(np.eye(3), np.zeros(3))


def of_pairs(points, targets):
    """The motion of points with the least squares of what is left to their targets (Kabsch, Acta Cryst. A32, 1976, 922)."""
    middle, goal = points.mean(axis=0), targets.mean(axis=0)
    u, _, vt = np.linalg.svd((points - middle).T @ (targets - goal))
    turn = np.diag([1, 1, np.sign(np.linalg.det(vt.T @ u.T))])
    rotation = vt.T @ turn @ u.T
    return Motion(rotation, goal - rotation @ middle)


def small(rotation, shift, centre):
    """The motion by a rotation vector about a centre, and a shift."""
    angle = np.linalg.norm(rotation)
    if angle < 1e-300:
        return Motion(np.eye(3), shift)
    x, y, z = rotation / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
    return Motion(turn, centre + shift - turn @ centre)


def weights_of(distances, robust):
    """Tukey's biweight: points that lie far beyond nine tenths of the others count for nothing. The spread is that of nine tenths and not
    of the half: a side of a part is less than the half, and would be given up where others fit by themselves."""
    if not robust:
        return np.ones(len(distances))
    scale = np.quantile(np.abs(distances), SHARE) / SHARE_OF_NORMAL
    u = distances / max(OUTLIER * scale, 1e-300)
    return np.where(np.abs(u) < 1, (1 - u * u) ** 2, 0.0)


def on_surface(points, surface, begin, robust=True, turns=MOST_TURNS):
    """Iterated closest points: distances along the normals are made least (Chen and Medioni, Image Vision Comput. 10, 1992, 145)."""
    motion, size = begin, surface.extent()
    for _ in range(turns):
        moved = motion(points)
        near = surface.nearest(moved)
        weight = weights_of(near.distance, robust)
        normal = np.where(np.abs(near.distance[:, None]) > 1e-6 * size,
                          (moved - near.place) / np.where(near.distance == 0, 1, near.distance)[:, None],
                          surface.normals[near.triangle])
        centre = moved.mean(axis=0)
        rows = np.hstack([np.cross(moved - centre, normal) / size, normal])
        # Motions that no distance notices (a ball that turns) are left alone: the smallest solution is taken.
        step = np.linalg.lstsq(np.sqrt(weight)[:, None] * rows, -np.sqrt(weight) * near.distance, rcond=1e-7)[0]
        motion = small(step[:3] / size, step[3:], centre).after(motion)
        if np.abs(step).max() < SETTLED * size:
            break
    return motion


def beginnings(points, surface):
    """Motions that lay the principal axes of the points on those of the surface, in every way, and the one that does nothing."""
    corners, areas = surface.points[surface.triangles].mean(axis=1), surface.areas
    goal = np.average(corners, axis=0, weights=areas)
    target = np.linalg.eigh(np.cov((corners - goal).T, aweights=areas))[1]
    middle = points.mean(axis=0)
    own = np.linalg.eigh(np.cov((points - middle).T))[1]
    found = [identity()]
    for order in permutations(range(3)):
        for signs in product((1, -1), repeat=3):
            rotation = target[:, order] * np.array(signs) @ own.T
            if np.linalg.det(rotation) > 0:
                found.append(Motion(rotation, goal - rotation @ middle))
    return found


def best_fit(points, surface):
    """Where the points lie on the surface as well as they can, wherever they are: the best beginning, then all points."""
    chosen = points if len(points) <= SAMPLE else points[np.random.default_rng(1).choice(len(points), SAMPLE, replace=False)]

    def rest(motion):
        return float(np.median(np.abs(surface.nearest(motion(chosen)).distance)))

    near = sorted(beginnings(chosen, surface), key=rest)[:6]
    tried = [on_surface(chosen, surface, begin, turns=25) for begin in near]
    return on_surface(points, surface, min(tried, key=rest))
