// Domain colouring of a Blaschke product: the derivative, for the width of the rings' edges, by one forward difference.

fn blaschke(z: vec2f, a: vec2f) -> vec2f {
    return div(z - a, vec2f(1.0, 0.0) - mul(vec2f(a.x, -a.y), z));
}

fn f(z: vec2f) -> vec2f {
    return mul(mul(z, blaschke(z, vec2f(0.5, 0.0))), mul(blaschke(z, vec2f(-0.25, 0.5)), blaschke(z, vec2f(-0.25, -0.5))));
}

fn shade(pixel: vec2f) -> vec3f {
    let z = world(pixel);
    let w = f(z);
    let rate = length(f(z + vec2f(view.pixel, 0.0)) - w) / max(length(w), 1e-30);
    return domain_colour(w, 1.0, rate);
}
