// Entry points: the same picture `shade` through a full-screen fragment pass or through a compute pass, and in linear
// light. All average `view.samples`² regular samples in linear light; the first two encode to sRGB and dither by half a
// step of 8 bits, as a function of the absolute pixel: tiles join without a seam and both passes agree.
//
// Where the samples of a pixel take too long for one pass, `sum_main` adds some of them at a time to what is in
// `image`, and `encode_main` makes the same picture of the sum.

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

// The scene's picture: linear rgb, premultiplied by alpha, and alpha at a point of the whole image.
fn shade(pixel: vec2f) -> vec4f { return vec4f(); }
// Shared: linear light to sRGB.
fn srgb_encode(linear: vec3f) -> vec3f { return vec3f(); }

// Adds `many` samples of a regular grid over the pixel whose top-left corner is `corner`, one after the other, from
// the one in column and row `place` on; one at least.
fn with_samples(before: vec4f, corner: vec2f, place: vec2f, many: u32) -> vec4f {
    let count = f32(max(view.samples, 1u));
    let step = 1.0 / count;
    var at = place + 0.5;
    var sum = before;
    // a pixel of one sample has one left: a shader that is made for one has no loop
    var left = select(many, 1u, view.samples <= 1u);
    // ends: each turn takes one sample of those left
    loop {
        sum += shade(corner + at * step);
        left--;
        if left == 0u {
            break;
        }
        at.x += 1.0;
        if at.x > count {
            at = vec2f(0.5, at.y + 1.0);
        }
    }
    return sum;
}

// Samples of a pixel.
fn sample_count() -> u32 {
    let count = max(view.samples, 1u);
    return count * count;
}

fn pixel_sum(corner: vec2f) -> vec4f {
    return with_samples(vec4f(), corner, vec2f(), sample_count());
}

// A threshold in (0, 1), evenly spread over neighbouring pixels: the rank-1 lattice of the plastic number ρ,
// fract(x/ρ + y/ρ²), in 32-bit fixed point so that it is exact for every pixel (M. Roberts, "The unreasonable
// effectiveness of quasirandom sequences", 2018).
fn dither_threshold(pixel: vec2u) -> f32 {
    let lattice = pixel.x * 3242174889u + pixel.y * 2447445414u;
    return (f32(lattice >> 16u) + 0.5) / 65536.0;
}

// The mean of samples as a displayable colour, not premultiplied, to be held within 0..1 and rounded to 8 bits by what
// takes it. A value that 8 bits hold exactly stays as it is.
fn encoded(sum: vec4f, pixel: vec2u) -> vec4f {
    let many = f32(sample_count());
    let opaque = clamp(sum.a, 1e-6 * many, many);
    let alpha = sum.a / many;
    let encoded = srgb_encode(clamp(sum.rgb * (1.0 / opaque), vec3f(0.0), vec3f(1.0)));
    let noise = (dither_threshold(pixel) - 0.5) / 255.0;
    return vec4f(encoded + noise, alpha);
}

// The displayable colour of a pixel of this tile.
fn encoded_pixel(local: vec2u) -> vec4f {
    let pixel = local + vec2u(view.tile);
    return encoded(pixel_sum(vec2f(pixel)), pixel);
}

// One triangle that covers the target.
@vertex
fn vertex_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fragment_main(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return encoded_pixel(vec2u(position.xy));
}

@compute @workgroup_size(8, 16)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    image[id.y * view.tile_size.x + id.x] = pack4x8unorm(encoded_pixel(id.xy));
}

// Four words a pixel: linear rgb, premultiplied, and alpha as they are, beyond 1 too.
@compute @workgroup_size(8, 16)
fn linear_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    store(pixel_at(id.xy), pixel_sum(vec2f(id.xy) + view.tile) / f32(sample_count()));
}

// Pixels are four words apart. Behind the last one are three words: whether a sum has gone wrong, the first sample
// that is to be added to each pixel, and the one after the last. Samples of a pixel are numbered row by row.
@compute @workgroup_size(8, 16)
fn sum_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    let at = pixel_at(id.xy);
    let behind = 4u * view.tile_size.x * view.tile_size.y;
    let first = image[behind + 1u];
    let count = max(view.samples, 1u);
    let place = vec2f(vec2u(first % count, first / count));
    let end = image[behind + 2u];
    if end > first {
        store(at, with_samples(stored(at), vec2f(id.xy) + view.tile, place, end - first));
    }
    if loops_end_early(id.x) {
        image[behind] = 1u;
    }
}

@compute @workgroup_size(8, 16)
fn encode_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    let at = pixel_at(id.xy);
    image[at] = pack4x8unorm(encoded(stored(at), id.xy + vec2u(view.tile)));
}

// Place in `image` of a pixel of this tile, of four words.
fn pixel_at(local: vec2u) -> u32 {
    return 4u * (local.y * view.tile_size.x + local.x);
}

fn stored(at: u32) -> vec4f {
    return bitcast<vec4f>(vec4u(image[at], image[at + 1u], image[at + 2u], image[at + 3u]));
}

fn store(at: u32, value: vec4f) {
    let words = bitcast<vec4u>(value);
    image[at] = words.x;
    image[at + 1u] = words.y;
    image[at + 2u] = words.z;
    image[at + 3u] = words.w;
}

// Whether this invocation has used up the turns that the adapter allows all its loops together: then every further
// loop ends after its first turn, without an error. The count starts at 0, but no compiler knows: a driver that makes a
// shader for the values of uniforms that loops hang on would make one for each tile.
fn loops_end_early(any: u32) -> bool {
    var turns = 0u;
    for (var k = view.zero & any; k < 2u; k++) {
        turns++;
    }
    return turns < 2u;
}
