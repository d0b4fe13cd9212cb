// Writes the first component of `shade` of each pixel as the number that it is.

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
@group(0) @binding(5) var<storage, read_write> image: array<u32>;

fn shade(pixel: vec2f) -> vec4f { return vec4f(); }

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    image[id.y * view.tile_size.x + id.x] = bitcast<u32>(shade(vec2f(id.xy) + 0.5).x);
}
