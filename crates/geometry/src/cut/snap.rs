use super::crossing::nearest_of_surface;
use super::net::{Corner, Net, Node, Origin};
use super::split::shape;
use super::{MAX_AREA_CHANGE, MIN_SHAPE};
use crate::{Surface, Vec3};

/// A triangle turns by less than 30° when its corner is moved: the cosine of that [-].
const MAX_TURN: f64 = 0.866;

/// Moves a vertex to the point of the surface nearest to `place` [m], when its triangles stay sound.
/// Whether it was moved.
pub(super) fn snap(net: &mut Net, surface: &Surface, corner: Corner, place: &Vec3) -> bool {
    let parent = net.facet(corner.triangle).parent;
    let (triangle, on) = nearest_of_surface(surface, parent, place);
    if !stays_sound(net, corner, &on.position) {
        return false;
    }
    let id = net.node_at(corner);
    let node = Node {
        origin: Origin {
            triangle,
            barycentric: on.barycentric,
        },
        ..net.nodes[id.index()]
    };
    net.set_node(id, on.position, node);
    true
}

fn stays_sound(net: &Net, corner: Corner, place: &Vec3) -> bool {
    let (mut before, mut after) = (0.0, 0.0);
    for Corner { triangle, place: k } in net.around(corner) {
        let old = net.mesh.positions(triangle);
        let mut new = old;
        new[k] = *place;
        let [was, is] = [old, new].map(|[a, b, c]| (b - a).cross(&(c - a)));
        let turned = was.dot(&is) < MAX_TURN * was.norm() * is.norm();
        if turned || shape(&new) < MIN_SHAPE.min(shape(&old)) {
            return false;
        }
        before += was.norm();
        after += is.norm();
    }
    (after - before).abs() <= MAX_AREA_CHANGE * before
}
