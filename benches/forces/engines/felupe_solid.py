"""FElupe on bodies that are not axisymmetric: tetrahedra of ten nodes, with a contact of its own."""

import felupe
import numpy as np
import scipy.sparse

from laws import LAWS, SPACE, Material
from meshes import Tetrahedra

# Edges under the tool [radii] and far from it [extents], or triangles: a mesh, and a finer one.
MESHES = {
    "grip_esophagus": [2000, 3696],
    "sphere_liver": [(0.35, 0.25), (0.25, 0.2)],
    "sphere_slit": [(0.3, 0.25), (0.2, 0.2)],
    "sphere_tube": [(0.25, 0.15), (0.18, 0.11)],
}
PENALTY = 100.0  # [Young's moduli a radius of the tool]
AUGMENTED = 1  # times in each increment
TOLERANCE = 1e-6  # of the residual [force on the held nodes]


def solver():
    """A direct one: PARDISO where it is installed, which is ten times as fast."""
    try:
        import pypardiso

        return pypardiso.spsolve
    except ImportError:
        import scipy.sparse.linalg

        return scipy.sparse.linalg.spsolve


# Points and weights of degree five in a triangle [Dunavant 1985].
_A, _B = (6 - np.sqrt(15)) / 21, (6 + np.sqrt(15)) / 21
_POINTS = np.array([[1 / 3, 1 / 3]] + [[x, y] for c in (_A, _B) for x, y in [(c, c), (1 - 2 * c, c), (c, 1 - 2 * c)]])
_WEIGHTS = np.array([0.225] + [(155 - np.sqrt(15)) / 1200] * 3 + [(155 + np.sqrt(15)) / 1200] * 3)


def _shapes(point):
    """Functions of six nodes and their derivatives."""
    l = np.array([1 - point.sum(), *point])
    d = np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
    pairs = [(0, 1), (1, 2), (2, 0)]
    values = np.concatenate([l * (2 * l - 1), [4 * l[i] * l[j] for i, j in pairs]])
    slopes = np.concatenate([(4 * l - 1)[:, None] * d, [4 * (l[i] * d[j] + l[j] * d[i]) for i, j in pairs]])
    return values, slopes


class Sphere:
    """A rigid sphere without friction on the triangles within reach, by an augmented Lagrangian."""

    def __init__(self, scene, mesh):
        self.radius = scene.radius
        self.stiffness = PENALTY * scene.tissue["youngs_modulus_pa"] / scene.radius
        near = np.linalg.norm(mesh.nodes[mesh.faces].mean(axis=1), axis=1) < 1.6 * scene.radius
        self.faces = mesh.faces[near]
        corners = mesh.nodes[self.faces]
        functions = [_shapes(point) for point in _POINTS]
        self.values = np.array([values for values, _ in functions])
        slopes = np.array([slopes for _, slopes in functions])
        tangents = np.einsum("fni,qnk->fqki", corners, slopes)
        normals = np.cross(tangents[:, :, 0], tangents[:, :, 1])
        self.areas = 0.5 * _WEIGHTS * np.linalg.norm(normals, axis=2)
        self.multiplier = np.zeros_like(self.areas)  # pressure [Pa]
        self.rest = mesh.nodes

    def _contact(self, places, depth):
        """Distance from the middle [m], normal and pressure [Pa] at each point."""
        away = np.einsum("qn,fni->fqi", self.values, places[self.faces]) - [0.0, 0.0, self.radius - depth]
        distance = np.linalg.norm(away, axis=2)
        pressure = np.maximum(self.multiplier + self.stiffness * (self.radius - distance), 0.0)
        return distance, away / distance[..., None], pressure

    def augment(self, moved, depth):
        """The pressure becomes the multiplier."""
        self.multiplier = self._contact(self.rest + moved, depth)[2]

    def pressed(self, moved, depth):
        """Forces on the nodes at these displacements [m], and the stiffness."""
        places = self.rest + moved
        distance, normal, pressure = self._contact(places, depth)
        pressure = pressure * self.areas
        forces = np.zeros_like(places)
        np.add.at(forces, self.faces, np.einsum("fq,fqi,qn->fni", pressure, normal, self.values))
        turned = np.eye(3) - normal[..., :, None] * normal[..., None, :]
        local = (self.stiffness * self.areas * (pressure > 0))[..., None, None] * (np.eye(3) - turned)
        local -= (pressure / distance)[..., None, None] * turned
        blocks = np.einsum("fqij,qn,qm->fnimj", local, self.values, self.values)
        rows = (3 * self.faces[:, :, None] + np.arange(3))[:, :, :, None, None] + np.zeros((1, 1, 1, 6, 3), dtype=int)
        columns = (3 * self.faces[:, :, None] + np.arange(3))[:, None, None, :, :] + np.zeros((1, 6, 3, 1, 1), dtype=int)
        size = places.size
        stiffness = scipy.sparse.coo_matrix((blocks.ravel(), (rows.ravel(), columns.ravel())), shape=(size, size))
        return forces, stiffness.tocsr()


class Slit:
    """Contact of the two sides of a slit without friction, by an augmented Lagrangian. Points that coincide at rest remain a
    pair, which is right while the sides slide by less than the length of an edge."""

    def __init__(self, scene, mesh):
        self.stiffness = PENALTY * scene.tissue["youngs_modulus_pa"] / scene.radius
        near, far = mesh.slit
        corners = mesh.nodes[near[:, :3]]
        areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        self.weights = np.outer(areas, _WEIGHTS).ravel()
        # Rows are points, columns the displacements of nodes along x: those of the near side less those of the far side.
        values = np.array([_shapes(point)[0] for point in _POINTS])
        values = np.concatenate([values, -values], axis=1) + np.zeros((len(near), 1, 1))
        columns = np.concatenate([near, far], axis=1)[:, None] * 3 + np.zeros(values.shape, dtype=int)
        rows = np.arange(self.weights.size).reshape(len(near), -1, 1) + np.zeros(values.shape, dtype=int)
        entries = (values.ravel(), (rows.ravel(), columns.ravel()))
        self.overlap = scipy.sparse.csr_matrix(entries, shape=(self.weights.size, mesh.nodes.size))
        self.multiplier = np.zeros_like(self.weights)  # pressure [Pa]

    def _pressure(self, moved):
        return np.maximum(self.multiplier + self.stiffness * (self.overlap @ moved.ravel()), 0.0)

    def augment(self, moved, _depth):
        """The pressure becomes the multiplier."""
        self.multiplier = self._pressure(moved)

    def pressed(self, moved, _depth):
        """Forces on the nodes at these displacements [m], and the stiffness."""
        pressure = self._pressure(moved)
        closed = scipy.sparse.diags(self.stiffness * self.weights * (pressure > 0))
        forces = -(self.overlap.T @ (self.weights * pressure)).reshape(moved.shape)
        return forces, (self.overlap.T @ closed @ self.overlap).tocsr()


def solid_of(scene, law, mesh):
    body = felupe.Mesh(mesh.nodes, mesh.elements, "tetra10")
    region = felupe.RegionQuadraticTetra(body)
    field = felupe.FieldContainer([felupe.Field(region, dim=3)])
    return field, felupe.SolidBody(umat=Material(LAWS[law], *scene.lame, SPACE), field=field)


def pressed(scene, law, fineness, depths):
    """Force [N] and settlement of the probe [m] at each of rising depths [m], NaN from where it is not solved, and the
    number of nodes."""
    mesh = Tetrahedra(scene, fineness, order=2)
    field, solid = solid_of(scene, law, mesh)
    moved = field[0].values
    contacts = [] if scene.gripped else [Sphere(scene, mesh)]
    contacts += [Slit(scene, mesh)] if scene.slit else []
    free = np.ones(moved.shape, dtype=bool)
    free[mesh.fixed] = free[mesh.gripped] = False
    solve = solver()
    forces, settled, last = [], [], 0.0
    increment, length = np.zeros_like(moved), 1.0
    for depth in depths:
        before = moved.copy()
        # The last increment once more is a better start than none.
        moved += increment * ((depth - last) / length)
        wanted = np.zeros_like(moved)
        wanted[mesh.gripped, 2] = scene.along * depth - moved[mesh.gripped, 2]
        contact = (contacts, depth)
        solved = equilibrium(solid, field, contact, (free, wanted), solve)
        for _ in range(AUGMENTED if contacts else 0):
            for one in contacts:
                one.augment(moved, depth)
            solved = solved and equilibrium(solid, field, contact, (free, np.zeros_like(wanted)), solve)
        if not solved:
            moved[:] = before
            print(f"{scene.name}, {law}: no equilibrium at {1e3 * depth:.2f} mm")
            break
        increment, length, last = moved - before, depth - last, depth
        inner = solid.results.force.toarray().reshape(-1, 3)
        forces.append(float(scene.along * -inner[mesh.fixed, 2].sum()))
        settled.append(float("nan") if mesh.probe is None else float(scene.along * moved[mesh.probe, 2]))
    missing = [np.nan] * (len(depths) - len(forces))
    return np.array(forces + missing), np.array(settled + missing), len(mesh.nodes)


def equilibrium(solid, field, contact, conditions, solve):
    """Newton's method; whether it converged. The step that is wanted of held nodes is taken in its first iteration."""
    contacts, depth = contact
    free, wanted = conditions
    open_ = free.ravel()
    moved = field[0].values
    with np.errstate(invalid="ignore", divide="ignore"):
        for _ in range(25):
            force = np.asarray(solid.assemble.vector(field).todense()).ravel()
            stiffness = solid.assemble.matrix(field).tocsr()
            for one in contacts:
                pushed, stiff = one.pressed(moved, depth)
                force = force - pushed.ravel()
                stiffness = stiffness + stiff
            step = wanted.ravel().copy()
            residual = (force + stiffness @ step)[open_]
            size = np.linalg.norm(residual)
            if not np.isfinite(size):
                return False
            if size <= TOLERANCE * np.linalg.norm(force[~open_]) and not step.any():
                return True
            step[open_] = solve(stiffness[open_][:, open_].tocsr(), -residual)
            moved += step.reshape(moved.shape)
            wanted = np.zeros_like(wanted)
    return False
