"""Meshes of linear tetrahedra for the engines that need one, by gmsh: fine under the tool, with a node below its
middle and one where the settling of the surface is read."""

import gmsh
import numpy as np

from scene import organ_surface

# Length of the edges under the tool, in its radii, and far from it, in extents of the body.
SIZES = {"coarse": (0.3, 0.25), "fine": (0.15, 0.25)}


class Tetrahedra:
    """Nodes [m], tetrahedra, triangles of the surface (outward), fixed and gripped nodes.

    `order` 2: ten nodes a tetrahedron in the order of VTK, and six a triangle.
    """

    def __init__(self, scene, fineness, order=1):
        self.nodes, self.elements = _filled(scene, _size(scene, fineness), order)
        self.faces = _surface(self.elements)
        top = np.unique(self.faces)
        held = scene.fixed(self.nodes[top])
        self.fixed = top[held]
        self.gripped = top[np.linalg.norm(self.nodes[top], axis=1) <= scene.radius] if scene.gripped else top[:0]
        self.slit = _sides(self.nodes, self.faces, scene.slit) if scene.slit else None
        probe = _probe(scene)
        self.probe = None if probe is None else int(np.argmin(np.linalg.norm(self.nodes - probe, axis=1)))

    def settling(self, places):
        """How far the probe has gone down [m], of the nodes at `places` [m]; NaN on a body without one."""
        return float("nan") if self.probe is None else self.nodes[self.probe, 2] - float(places[self.probe][2])

    def inside(self, scene):
        """Elements whose centroid lies in the inclusion or the layer."""
        middle = self.nodes[self.elements[:, :4]].mean(axis=1)
        return scene.in_second(np.linalg.norm(middle[:, :2], axis=1), middle[:, 2])


def _size(scene, fineness):
    """Lengths of the edges under the tool and far from it [m], or the number of triangles of a surface that is filled."""
    if fineness in SIZES and scene.body.get("filled"):
        return scene.body["triangles"]
    if isinstance(fineness, int):
        return fineness
    near, far = SIZES.get(fineness, fineness)
    return near * scene.radius, far * _extent(scene)


def _extent(scene):
    """A length of the body far from the tool [m], of which edges are a part."""
    body = scene.body
    if body["shape"] in ("tube", "organ"):
        return body.get("extent_m", 2 * body.get("radius_m", 0.0))
    return np.sqrt(scene.height * body.get("side_m", scene.height))


def _probe(scene):
    """The point of the surface at the scene's distance from the axis."""
    if scene.probe is None:
        return None
    if scene.body["shape"] == "hemisphere":
        radius = scene.body["radius_m"]
        return np.array([scene.probe, 0.0, np.sqrt(radius**2 - scene.probe**2) - radius])
    return np.array([scene.probe, 0.0, 0.0])


def _add_body(scene, model, size):
    """The shape, in gmsh's kernel, and the faces of its slit; the organ's is a smooth parametrization of its triangles."""
    body = scene.body
    if body["shape"] == "organ":
        return _add_organ(scene, model, size)
    points = [model.occ.addPoint(0, 0, 0), model.occ.addPoint(*_probe(scene))]
    faces = []
    if body["shape"] == "hemisphere":
        model.occ.addSphere(0, 0, -body["radius_m"], body["radius_m"], angle1=0.0)
    elif body["shape"] == "tube":
        length, radius = body["length_m"], body["radius_m"]
        axis = (-length / 2, 0, -radius, length, 0, 0)
        tubes = [(3, model.occ.addCylinder(*axis, r)) for r in (radius, radius - body["wall_m"])]
        model.occ.cut(tubes[:1], tubes[1:])
    else:
        side, height = body["side_m"], body["height_m"]
        model.occ.addBox(-side / 2, -side / 2, -height, side, side, height)
        if scene.slit:
            x, half, depth = scene.slit["aside_m"], scene.slit["length_m"] / 2, scene.slit["depth_m"]
            corners = [(x, -half, 0), (x, half, 0), (x, half, -depth), (x, -half, -depth)]
            tags = [model.occ.addPoint(*corner) for corner in corners]
            lines = [model.occ.addLine(a, b) for a, b in zip(tags, tags[1:] + tags[:1])]
            faces = [(2, model.occ.addPlaneSurface([model.occ.addCurveLoop(lines)]))]
    solid = model.occ.getEntities(3)
    _, children = model.occ.fragment(solid, [(0, point) for point in points] + faces)
    model.occ.synchronize()
    return [tag for dimension, tag in children[-1] if dimension == 2] if faces else []


def _add_organ(scene, model, size):
    """A number of triangles as `size` fills that surface as it is, for thin walls, which a parametrization with coarse
    edges would change."""
    as_it_is = isinstance(size, int)
    vertices, triangles = organ_surface(scene, size if as_it_is else None)
    tag = model.addDiscreteEntity(2)
    model.mesh.addNodes(2, tag, range(1, len(vertices) + 1), vertices.ravel())
    model.mesh.addElementsByType(tag, 2, [], (triangles + 1).ravel())
    if not as_it_is:
        # No edge of an organ is sharp.
        model.mesh.classifySurfaces(np.pi, True, True, np.pi)
        model.mesh.createGeometry()
    surfaces = [tag for _, tag in model.getEntities(2)]
    model.geo.addVolume([model.geo.addSurfaceLoop(surfaces)])
    model.geo.synchronize()
    return []


def _filled(scene, size, order):
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        model = gmsh.model
        slit = _add_body(scene, model, size)
        for option in ["FromPoints", "FromCurvature", "ExtendFromBoundary"]:
            gmsh.option.setNumber(f"Mesh.MeshSize{option}", 0)
        if not isinstance(size, int):
            _refine(scene, model.mesh.field, size)
        model.mesh.generate(3)
        # Netgen's optimizer crashes on a face inside the body.
        model.mesh.optimize("" if slit else "Netgen")
        model.mesh.setOrder(order)
        if slit:
            _open(model, slit)
        kind, count = (4, 4) if order == 1 else (11, 10)
        tags, places, _ = model.mesh.getNodes()
        kinds, _, corners = model.mesh.getElements(3)
        elements = np.concatenate([c for k, c in zip(kinds, corners) if k == kind]).reshape(-1, count)
    finally:
        gmsh.finalize()
    number = np.full(int(tags.max()) + 1, -1)
    number[tags] = np.arange(len(tags))
    elements = number[elements]
    if order == 2:
        # gmsh has the last two nodes the other way round.
        elements = elements[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]
    used, elements = np.unique(elements, return_inverse=True)
    return places.reshape(-1, 3)[used], elements.reshape(-1, count)


def _refine(scene, field, size):
    near, far = size
    reach = scene.slit["aside_m"] if scene.slit else 0.3 * scene.radius
    ball = field.add("Ball")
    thickness = scene.height or _extent(scene)
    numbers = {"VIn": near, "VOut": far, "Radius": scene.radius + reach, "Thickness": thickness}
    for key, value in numbers.items():
        field.setNumber(ball, key, value)
    field.setAsBackgroundMesh(ball)


def _open(model, slit):
    """Doubles the nodes of the slit but for its edges inside the body."""
    face = model.addPhysicalGroup(2, slit)
    edges = [tag for _, tag in model.getBoundary([(2, tag) for tag in slit])]
    upper = [tag for tag in edges if model.getBoundingBox(1, abs(tag))[2] > -1e-6]
    mouth = model.addPhysicalGroup(1, [abs(tag) for tag in upper])
    gmsh.plugin.setNumber("Crack", "Dimension", 2)
    gmsh.plugin.setNumber("Crack", "PhysicalGroup", face)
    gmsh.plugin.setNumber("Crack", "OpenBoundaryPhysicalGroup", mouth)
    gmsh.plugin.run("Crack")


def _surface(elements):
    """Triangles that one tetrahedron has alone, seen counterclockwise from outside."""
    sides = [[0, 2, 1, 6, 5, 4], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [0, 3, 2, 7, 9, 6]]
    nodes = 3 if elements.shape[1] == 4 else 6
    faces = np.concatenate([elements[:, side[:nodes]] for side in sides])
    _, first, count = np.unique(np.sort(faces[:, :3], axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def _sides(nodes, faces, slit):
    """Triangles of the near and of the far side of a slit, which coincide at rest node by node."""
    inside = (np.abs(nodes[faces, 0] - slit["aside_m"]) < 1e-9).all(axis=1)
    normal = np.cross(nodes[faces[:, 1]] - nodes[faces[:, 0]], nodes[faces[:, 2]] - nodes[faces[:, 0]])
    near, far = [faces[inside & (side * normal[:, 0] > 0)] for side in (1, -1)]
    place = lambda triangle: list(map(tuple, np.round(nodes[triangle] / 1e-9).astype(int)))
    opposite = {frozenset(place(triangle)): dict(zip(place(triangle), triangle)) for triangle in far}
    paired = [[opposite[frozenset(place(triangle))][at] for at in place(triangle)] for triangle in near]
    return near, np.array(paired)


def legacy_vtk(nodes, elements):
    """A mesh as a VTK file of version 3, as several engines read it."""
    lines = ["# vtk DataFile Version 3.0", "body", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(nodes)} double"]
    lines += [" ".join(map(repr, map(float, place))) for place in nodes]
    lines += [f"CELLS {len(elements)} {5 * len(elements)}"]
    lines += ["4 " + " ".join(map(str, corners)) for corners in elements]
    return "\n".join([*lines, f"CELL_TYPES {len(elements)}", *["10"] * len(elements), ""])
