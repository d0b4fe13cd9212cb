// The field of `levels` by hand: the gradient by central differences of one pixel, as visualisation shaders have it.
// A formula's `f` is appended.

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

// (∂f/∂x, ∂f/∂y, f) at the offset from the view's centre
fn field_grad(offset: vec2f) -> vec3f {
    let p = view.center + offset;
    let e = vec2f(view.pixel, 0.0);
    let gradient = vec2f(f(p + e.xy) - f(p - e.xy), f(p + e.yx) - f(p - e.yx)) / (2.0 * e.x);
    return vec3f(gradient, f(p));
}

