// Entry points: the same picture `shade` through a full-screen fragment pass or through a compute pass, and in linear
// light. All average `view.samples`² regular samples in linear light; the first two encode to sRGB and dither by half a
// step of 8 bits, as a function of the absolute pixel: tiles join without a seam and both passes agree.

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
@group(0) @binding(4) var<storage, read_write> image: array<u32>;

// The scene's picture: linear rgb, premultiplied by alpha, and alpha at a point of the whole image.
fn shade(pixel: vec2f) -> vec4f { return vec4f(); }
// Shared: linear light to sRGB.
fn srgb_encode(linear: vec3f) -> vec3f { return vec3f(); }

// Mean of a regular grid of samples over the pixel whose top-left corner is `corner`.
fn pixel_mean(corner: vec2f) -> vec4f {
    let count = max(view.samples, 1u);
    let step = 1.0 / f32(count);
    var sum = vec4f();
    for (var j = 0u; j < count; j++) {
        for (var i = 0u; i < count; i++) {
            sum += shade(corner + (vec2f(f32(i), f32(j)) + 0.5) * step);
        }
    }
    return sum * (step * step);
}

// A threshold in (0, 1), evenly spread over neighbouring pixels: the rank-1 lattice of the plastic number ρ,
// fract(x/ρ + y/ρ²), in 32-bit fixed point so that it is exact for every pixel (M. Roberts, "The unreasonable
// effectiveness of quasirandom sequences", 2018).
fn dither_threshold(pixel: vec2u) -> f32 {
    let lattice = pixel.x * 3242174889u + pixel.y * 2447445414u;
    return (f32(lattice >> 16u) + 0.5) / 65536.0;
}

// The displayable colour of a pixel of this tile, not premultiplied, to be rounded to 8 bits by the caller. A value that
// 8 bits hold exactly stays as it is.
fn encoded_pixel(local: vec2u) -> vec4f {
    let corner = vec2f(local) + view.tile;
    let mean = pixel_mean(corner);
    let alpha = clamp(mean.a, 0.0, 1.0);
    let encoded = srgb_encode(clamp(mean.rgb / max(alpha, 1e-6), vec3f(0.0), vec3f(1.0)));
    let noise = (dither_threshold(vec2u(corner)) - 0.5) / 255.0;
    return vec4f(clamp(encoded + noise, vec3f(0.0), vec3f(1.0)), alpha);
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

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    image[id.y * view.tile_size.x + id.x] = pack4x8unorm(encoded_pixel(id.xy));
}

// Four words a pixel: linear rgb, premultiplied, and alpha as they are, beyond 1 too.
@compute @workgroup_size(8, 8)
fn linear_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    let mean = pixel_mean(vec2f(id.xy) + view.tile);
    let at = 4u * (id.y * view.tile_size.x + id.x);
    image[at] = bitcast<u32>(mean.r);
    image[at + 1u] = bitcast<u32>(mean.g);
    image[at + 2u] = bitcast<u32>(mean.b);
    image[at + 3u] = bitcast<u32>(mean.a);
}
