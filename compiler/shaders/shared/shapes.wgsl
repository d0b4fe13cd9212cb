// Convex solids around the origin, of half size `size`: the interval of a ray in each (x and y); x > y where it misses.

const MISSED: vec2f = vec2f(1e30, -1e30);

fn span_in_both(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(max(a.x, b.x), min(a.y, b.y));
}

// Roots of a t² + 2 b t + c, in order, by the form that does not cancel (W. Press et al., Numerical Recipes, 3rd ed., 5.6);
// MISSED where there are none. a is not 0.
fn roots_of(a: f32, b: f32, c: f32, discriminant: f32) -> vec2f {
    if discriminant < 0.0 {
        return MISSED;
    }
    let q = -(b + select(sqrt(discriminant), -sqrt(discriminant), b < 0.0));
    let first = q / a;
    let second = select(c / q, first, q == 0.0);
    return vec2f(min(first, second), max(first, second));
}

// The ellipsoid, as a unit ball of a scaled space. The discriminant is that of the distance of the ray from the middle.
fn ball_span(origin: vec3f, direction: vec3f, size: vec3f) -> vec2f {
    let o = origin / size;
    let d = direction / size;
    let a = dot(d, d);
    let away = cross(o, d);
    return roots_of(a, dot(o, d), dot(o, o) - 1.0, a - dot(away, away));
}

// The part of a ray between z = -height and z = height.
fn slab_span(origin: f32, direction: f32, height: f32) -> vec2f {
    if abs(direction) < 1e-12 {
        return select(MISSED, vec2f(-1e30, 1e30), abs(origin) <= height);
    }
    let t = (vec2f(-height, height) - origin) / direction;
    return vec2f(min(t.x, t.y), max(t.x, t.y));
}

// The elliptic cylinder along z.
fn cylinder_span(origin: vec3f, direction: vec3f, size: vec3f) -> vec2f {
    let o = origin.xy / size.xy;
    let d = direction.xy / size.xy;
    let a = dot(d, d);
    let away = o.x * d.y - o.y * d.x;
    let slab = slab_span(origin.z, direction.z, size.z);
    if a < 1e-20 {
        return select(MISSED, slab, dot(o, o) <= 1.0);
    }
    return span_in_both(slab, roots_of(a, dot(o, d), dot(o, o) - 1.0, a - away * away));
}

// The elliptic cone with its apex at z = size.z and its base at z = -size.z. In units of the radius at each height it is
// x² + y² ≤ w² with w = (1 - z/size.z)/2 ≥ 0.
fn cone_span(origin: vec3f, direction: vec3f, size: vec3f) -> vec2f {
    let o = vec3f(origin.xy / size.xy, 0.5 - 0.5 * origin.z / size.z);
    let d = vec3f(direction.xy / size.xy, -0.5 * direction.z / size.z);
    let a = dot(d.xy, d.xy) - d.z * d.z;
    let b = dot(o.xy, d.xy) - o.z * d.z;
    let c = dot(o.xy, o.xy) - o.z * o.z;
    let slab = slab_span(origin.z, direction.z, size.z);
    if abs(a) < 1e-7 * (dot(d.xy, d.xy) + d.z * d.z) { // along the cone: one root, inside on the side of growing w
        let t = -0.5 * c / select(b, 1e-30, b == 0.0);
        return span_in_both(slab, select(vec2f(t, 1e30), vec2f(-1e30, t), b > 0.0));
    }
    let roots = roots_of(a, b, c, b * b - a * c);
    if a > 0.0 {
        return span_in_both(slab, roots);
    }
    if roots.x > roots.y { // inside on both sides of the apex
        return slab;
    }
    return span_in_both(slab, select(vec2f(-1e30, roots.x), vec2f(roots.y, 1e30), d.z > 0.0));
}

// 0 box, 1 ball, 2 cylinder, 3 cone.
fn shape_span(shape: u32, origin: vec3f, direction: vec3f, size: vec3f) -> vec2f {
    switch shape {
        case 0u: { return box_span(origin, direction, vec3f(), size); }
        case 1u: { return ball_span(origin, direction, size); }
        case 2u: { return cylinder_span(origin, direction, size); }
        default: { return cone_span(origin, direction, size); }
    }
}
