// A picture of numbers that a scene computes on the way, four a pixel. The entry point stands in for that of the picture in
// linear light; what the recorders keep is written for each scene.

struct View {
    center: vec2f,     // world coordinates of the centre of the whole image
    size: vec2f,       // whole image, pixels
    tile: vec2f,       // pixel of the whole image at this tile's top-left corner
    pixel: f32,        // world units per pixel
    time: f32,         // seconds
    samples: u32,      // supersamples per axis, >= 1
    zero: u32,         // always 0, but the shader compiler does not know
    tile_size: vec2u,  // this tile, pixels
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(5) var<storage, read_write> image: array<u32>;

var<private> numbers: vec4f;
// Whether what was wanted is known: later values are others.
var<private> closed: bool;

fn shade(pixel: vec2f) -> vec4f { return vec4f(); }

@compute @workgroup_size(8, 16)
fn linear_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    numbers = vec4f();
    closed = false;
    let colour = shade(vec2f(id.xy) + view.tile + 0.5);
    // a use of the colour that drivers cannot leave out
    let words = bitcast<vec4u>(select(numbers, vec4f(), colour.a > 1e30));
    let at = 4u * (id.y * view.tile_size.x + id.x);
    image[at] = words.x;
    image[at + 1u] = words.y;
    image[at + 2u] = words.z;
    image[at + 3u] = words.w;
}
