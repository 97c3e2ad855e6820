"""Meshes of linear tetrahedra for the engines that need one, by gmsh: fine under the tool, with a node below its
middle and one where the settling of the surface is read."""

import gmsh
import numpy as np

# Length of the edges under the tool, in its radii, and far from it, in extents of the body.
SIZES = {"coarse": (0.3, 0.25), "fine": (0.15, 0.25)}


class Tetrahedra:
    """Nodes [m], tetrahedra, triangles of the surface (outward), fixed nodes."""

    def __init__(self, scene, fineness):
        near, far = SIZES[fineness]
        self.nodes, self.elements = _filled(scene, near * scene.radius, far * _extent(scene))
        self.faces = _surface(self.nodes, self.elements)
        self.fixed = np.flatnonzero(self.nodes[:, 2] < -scene.height * (1 - 1e-6))
        self.probe = int(np.argmin(np.linalg.norm(self.nodes - _probe(scene), axis=1)))

    def inside(self, scene):
        """Elements whose centroid lies in the inclusion or the layer."""
        middle = self.nodes[self.elements].mean(axis=1)
        return scene.in_second(np.linalg.norm(middle[:, :2], axis=1), middle[:, 2])


def _extent(scene):
    """Mean of the body's height and width [m], geometric."""
    return np.sqrt(scene.height * scene.body.get("side_m", scene.height))


def _probe(scene):
    """The point of the surface at the scene's distance from the axis."""
    if scene.body["shape"] == "hemisphere":
        radius = scene.body["radius_m"]
        return np.array([scene.probe, 0.0, np.sqrt(radius**2 - scene.probe**2) - radius])
    return np.array([scene.probe, 0.0, 0.0])


def _filled(scene, near, far):
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        model = gmsh.model
        if scene.body["shape"] == "hemisphere":
            radius = scene.body["radius_m"]
            model.occ.addSphere(0, 0, -radius, radius, angle1=0.0)
        else:
            side, height = scene.body["side_m"], scene.body["height_m"]
            model.occ.addBox(-side / 2, -side / 2, -height, side, side, height)
        points = [model.occ.addPoint(0, 0, 0), model.occ.addPoint(*_probe(scene))]
        model.occ.fragment([(3, 1)], [(0, point) for point in points])
        model.occ.synchronize()
        field = model.mesh.field
        ball = field.add("Ball")
        numbers = {"VIn": near, "VOut": far, "Radius": 1.3 * scene.radius, "Thickness": scene.height}
        for key, value in numbers.items():
            field.setNumber(ball, key, value)
        field.setAsBackgroundMesh(ball)
        for option in ["FromPoints", "FromCurvature", "ExtendFromBoundary"]:
            gmsh.option.setNumber(f"Mesh.MeshSize{option}", 0)
        model.mesh.generate(3)
        model.mesh.optimize("Netgen")
        tags, places, _ = model.mesh.getNodes()
        kinds, _, corners = model.mesh.getElements(3)
        elements = np.concatenate([c for kind, c in zip(kinds, corners) if kind == 4]).reshape(-1, 4)
    finally:
        gmsh.finalize()
    number = np.full(int(tags.max()) + 1, -1)
    number[tags] = np.arange(len(tags))
    elements = number[elements]
    used, elements = np.unique(elements, return_inverse=True)
    return places.reshape(-1, 3)[used], elements.reshape(-1, 4)


def _surface(nodes, elements):
    """Triangles that one tetrahedron has alone, seen counterclockwise from outside."""
    faces = np.concatenate([elements[:, [0, 2, 1]], elements[:, [0, 1, 3]], elements[:, [1, 2, 3]], elements[:, [0, 3, 2]]])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def legacy_vtk(nodes, elements):
    """A mesh as a VTK file of version 3, as several engines read it."""
    lines = ["# vtk DataFile Version 3.0", "body", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(nodes)} double"]
    lines += [" ".join(map(repr, map(float, place))) for place in nodes]
    lines += [f"CELLS {len(elements)} {5 * len(elements)}"]
    lines += ["4 " + " ".join(map(str, corners)) for corners in elements]
    return "\n".join([*lines, f"CELL_TYPES {len(elements)}", *["10"] * len(elements), ""])
