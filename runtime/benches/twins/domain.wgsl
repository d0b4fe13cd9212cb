// The map of `domain` by hand: the usual complex arithmetic of a Common tab, the derivative by a central difference
// of one pixel. A formula's `f` is appended.

struct View {
    center: vec2f,
    size: vec2f,
    tile: vec2f,
    pixel: f32,
    time: f32,
    samples: u32,
    zero: u32,
    tile_size: vec2u,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;

struct Jet {
    value: vec2f,
    dz: vec2f,
    dzbar: vec2f,
}

fn cmul(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

fn cdiv(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(dot(a, b), a.y * b.x - a.x * b.y) / dot(b, b);
}

fn cexp(z: vec2f) -> vec2f {
    return exp(z.x) * vec2f(cos(z.y), sin(z.y));
}

fn clog(z: vec2f) -> vec2f {
    return vec2f(log(length(z)), atan2(z.y, z.x));
}

fn cpow(a: vec2f, b: vec2f) -> vec2f {
    return cexp(cmul(b, clog(a)));
}

// f and ∂f/∂z at the offset from the view's centre, for holomorphic f
fn map_jet(offset: vec2f) -> Jet {
    let z = view.center + offset;
    let e = vec2f(view.pixel, 0.0);
    return Jet(f(z), (f(z + e) - f(z - e)) / (2.0 * e.x), vec2f());
}

