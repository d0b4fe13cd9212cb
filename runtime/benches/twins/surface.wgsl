// The field of `surface` by hand: all derivatives by forward differences. A formula's `f` is appended.

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

const E: f32 = 1e-3;

// f and df/dt at o + t d
fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f {
    let value = f(o + t * d);
    return vec2f(value, (f(o + (t + E) * d) - value) / E);
}

// (∂f/∂x, ∂f/∂y, ∂f/∂z, f)
fn field_grad(p: vec3f) -> vec4f {
    let value = f(p);
    let e = vec2f(E, 0.0);
    return vec4f((vec3f(f(p + e.xyy), f(p + e.yxy), f(p + e.yyx)) - value) / E, value);
}

