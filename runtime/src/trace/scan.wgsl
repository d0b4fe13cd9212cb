// Looks for numbers that are none among the values of a formula, over a picture. The entry point stands in for that of
// the picture, and the recorders for those of a trace: what they are told they only look at.

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

// 1: a NaN, 2: an infinity.
var<private> seen: u32;

fn shade(pixel: vec2f) -> vec4f { return vec4f(); }

// Of the bits of a number: an exponent of ones is an infinity, or, with a mantissa, a NaN.
fn look(bits: u32) {
    let size = bits & 0x7fffffffu;
    if size > 0x7f800000u {
        seen |= 1u;
    } else if size == 0x7f800000u {
        seen |= 2u;
    }
}

fn record_real(site: u32, value: f32) {
    look(bitcast<u32>(value));
}

fn record_vec2(site: u32, value: vec2f) {
    look(bitcast<u32>(value.x));
    look(bitcast<u32>(value.y));
}

fn record_vec3(site: u32, value: vec3f) {
    look(bitcast<u32>(value.x));
    look(bitcast<u32>(value.y));
    look(bitcast<u32>(value.z));
}

fn record_vec4(site: u32, value: vec4f) {
    look(bitcast<u32>(value.x));
    look(bitcast<u32>(value.y));
    look(bitcast<u32>(value.z));
    look(bitcast<u32>(value.w));
}

@compute @workgroup_size(8, 16)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    seen = 0u;
    let colour = shade(vec2f(id.xy) + view.tile + 0.5);
    // a use of the colour that drivers cannot leave out
    image[id.y * view.tile_size.x + id.x] = select(seen, 4u, colour.a > 1e30);
}
