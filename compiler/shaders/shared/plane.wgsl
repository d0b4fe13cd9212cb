// What the scenes of the plane have in common: where a pixel is, and how values that are no numbers look.

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

// World units from the centre of the view. The formula's function adds the centre, in all digits of its tier.
fn offset_from_pixel(pixel: vec2f) -> vec2f {
    return (pixel - 0.5 * view.size) * vec2f(view.pixel, -view.pixel);
}

// Side of one sample's share of a pixel, in pixels: the window of every filter.
fn sample_window() -> f32 {
    return 1.0 / f32(max(view.samples, 1u));
}

// Samples in a row of a pixel: one over the window.
fn samples_per_pixel() -> f32 {
    return f32(max(view.samples, 1u));
}

// An undefined value (NaN): a quiet grey hatch.
fn undefined_colour(pixel: vec2f) -> vec3f {
    return mix(vec3f(0.60), vec3f(0.47), hatch(pixel, 1.0, 7.0, 0.3, sample_window()));
}

// A complex value that is too large for f32: white with faint stripes.
fn overflow_colour(pixel: vec2f) -> vec3f {
    return mix(vec3f(1.0), vec3f(0.84), hatch(pixel, -1.0, 7.0, 0.25, sample_window()));
}

// A complex value that is no number: one infinite part makes it infinite, whatever the other part is (C99, Annex G).
fn undrawn_colour(value: vec2f, pixel: vec2f) -> vec3f {
    if is_inf(value.x) || is_inf(value.y) {
        return overflow_colour(pixel);
    }
    return undefined_colour(pixel);
}

// An infinite real value, by the colour that large values have: with stripes of the other slope than NaN.
fn infinite_colour(pixel: vec2f, colour: vec3f) -> vec3f {
    return mix(colour, mix(colour, vec3f(1.0), 0.13), hatch(pixel, -1.0, 7.0, 0.3, sample_window()));
}
