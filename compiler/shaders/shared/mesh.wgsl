// A closed mesh of triangles: where a ray crosses its surface.
//
// `mesh` holds, in words: (nodes, triangles, first vertex, 0); two words of four for each node of a bounding volume hierarchy
// in depth-first order, (least corner, the node after all beneath) and (greatest corner, first triangle · 16 + their count);
// for each triangle (its three vertices, 0), counter-clockwise from outside; and the vertices.

@group(0) @binding(4) var<storage, read> mesh: array<vec4u>;

// How far a ray has been followed.
struct MeshCursor {
    node: u32,
    triangle: u32,  // of the node, if it is a leaf
}

struct MeshHit {
    t: f32,
    side: f32,           // 1 where the ray leaves, -1 where it enters, 0 if there are no more
    cursor: MeshCursor,
}

// Axes of a ray for `triangle_hit` (S. Woop, C. Benthin and I. Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013): the
// one along which it runs most is the last, and the plane of the other two is sheared along it.
struct Shear {
    origin: vec3f,
    axes: vec3u,
    rate: vec3f,
}

fn shear_of(origin: vec3f, direction: vec3f) -> Shear {
    let a = abs(direction);
    var z = select(2u, 1u, a.y > a.z);
    z = select(z, 0u, a.x > max(a.y, a.z));
    var x = (z + 1u) % 3u;
    var y = (z + 2u) % 3u;
    if direction[z] < 0.0 { // so that triangles keep their sense
        let other = x;
        x = y;
        y = other;
    }
    let along = 1.0 / direction[z];
    return Shear(origin, vec3u(x, y, z), vec3f(direction[x] * along, direction[y] * along, along));
}

fn sheared(vertex: u32, shear: Shear) -> vec3f {
    let p = bitcast<vec3f>(mesh[mesh[0].z + vertex].xyz) - shear.origin;
    let z = p[shear.axes.z];
    return vec3f(p[shear.axes.x] - shear.rate.x * z, p[shear.axes.y] - shear.rate.y * z, shear.rate.z * z);
}

// Twice the area that the origin spans with the edge from a to b. It is computed from the vertex of the smaller number, so that both
// triangles at an edge get the same number however it is rounded.
fn edge_area(a: vec3f, b: vec3f, forward: bool) -> f32 {
    let p = select(b.xy, a.xy, forward);
    let q = select(a.xy, b.xy, forward);
    return p.x * q.y - p.y * q.x;
}

// Whether the origin is to the left of the edge from a to b. One that is on the edge counts as if it were a little to the right,
// and a still smaller bit further up, for every triangle alike, so that it belongs to just one of those at an edge or a vertex
// (H. Edelsbrunner and E. Mücke, "Simulation of simplicity", ACM Transactions on Graphics 9, 1990).
fn is_left(area: f32, a: vec3f, b: vec3f) -> bool {
    return area > 0.0 || area == 0.0 && (a.y > b.y || a.y == b.y && b.x > a.x);
}

// One crossing of a triangle; side 0 if there is none.
fn triangle_hit(triangle: u32, shear: Shear) -> MeshHit {
    let at = mesh[1u + 2u * mesh[0].x + triangle].xyz;
    let a = sheared(at.x, shear);
    let b = sheared(at.y, shear);
    let c = sheared(at.z, shear);
    let forward = vec3<bool>(at.y < at.z, at.z < at.x, at.x < at.y);
    let raw = vec3f(edge_area(b, c, forward.x), edge_area(c, a, forward.y), edge_area(a, b, forward.z));
    let area = select(-raw, raw, forward);
    let left = vec3<bool>(is_left(area.x, b, c), is_left(area.y, c, a), is_left(area.z, a, b));
    if any(left != left.yzx) {
        return MeshHit(0.0, 0.0, MeshCursor());
    }
    let whole = area.x + area.y + area.z;
    let depth = dot(area, vec3f(a.z, b.z, c.z)) / select(whole, 1.0, whole == 0.0);
    return MeshHit(select(depth, a.z, whole == 0.0), select(-1.0, 1.0, left.x), MeshCursor());
}

// The next crossing beyond `start`, in no order.
fn mesh_next(origin: vec3f, direction: vec3f, shear: Shear, start: f32, from_: MeshCursor) -> MeshHit {
    var cursor = from_;
    let nodes = mesh[0].x;
    // ends: a node comes after those before it, and the last one's follower is their number
    while cursor.node < nodes {
        let least = mesh[1u + 2u * cursor.node];
        let most = mesh[2u + 2u * cursor.node];
        let low = bitcast<vec3f>(least.xyz);
        let high = bitcast<vec3f>(most.xyz);
        let span = box_span(origin, direction, 0.5 * (low + high), 0.5 * (high - low));
        if span.y < max(span.x, start) {
            cursor = MeshCursor(least.w, 0u);
            continue;
        }
        let count = most.w & 15u;
        // ends: each turn takes one triangle of 15
        while cursor.triangle < count {
            let hit = triangle_hit((most.w >> 4u) + cursor.triangle, shear);
            cursor.triangle++;
            if hit.side != 0.0 && hit.t > start {
                return MeshHit(hit.t, hit.side, cursor);
            }
        }
        cursor = MeshCursor(cursor.node + 1u, 0u);
    }
    return MeshHit(0.0, 0.0, cursor);
}
