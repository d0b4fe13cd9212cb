// Gradients at the points of a lattice, one after the other. Points have few bits, so that they are the same on every device
// and in f64.

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

fn field(p: vec3f) -> f32 { return 0.0; }
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }

fn shade(pixel: vec2f) -> vec4f {
    var sum = 0.0;
    // the clock is 0, but the shader compiler does not know
    let first = u32(view.time);
    for (var k = first; k < ROUNDS; k++) {
        let layer = (5u * u32(pixel.x) + 3u * u32(pixel.y) + 64u * k) % 512u;
        let p = (vec3f(pixel, f32(layer) + 0.5) - 256.0) / 128.0;
        sum += dot(found(p), PARTS);
    }
    return vec4f(sum);
}
