// Colour keys: a small frame in the lower right corner of the picture that shows what colours and lines mean, drawn by
// the scene's own code from values that are known: those of the identity on a square, or of a coordinate on a bar.

// A point of the frame.
struct Key {
    place: vec2f,   // in it, -1..1 in both directions, y up
    step: vec2f,    // change of `place` per pixel, to the right and up
    inside: bool,   // whether the key is what is drawn here
    border: f32,    // coverage by its border
}

// `side`: height of the frame as a part of the picture's shorter side, 0 for none; `aspect`: width over height.
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key {
    let height = side * min(view.size.x, view.size.y);
    // a side of 0 by itself, so that compilers see that there is no key
    if side <= 0.0 || height < 4.0 {
        return Key(vec2f(), vec2f(1.0), false, 0.0);
    }
    // whole pixels, so that text is sharp
    let half_size = max(floor(0.5 * vec2f(min(height * aspect, 0.9 * view.size.x), height)), vec2f(2.0));
    let margin = floor(clamp(0.02 * min(view.size.x, view.size.y), 4.0, 24.0));
    let from_center = pixel - (view.size - margin - half_size);
    let beyond = max(abs(from_center.x) - half_size.x, abs(from_center.y) - half_size.y);
    let border = line_coverage(beyond, 2.0, sample_window());
    return Key(from_center * vec2f(1.0, -1.0) / half_size, 1.0 / half_size, beyond < 0.0, border);
}

// The identity on the square key: value z of size `reach` at the edges, and its derivative per world unit.
fn key_jet(key: Key, reach: f32) -> Jet {
    return Jet(reach * key.place, vec2f(reach * key.step.x / view.pixel, 0.0), vec2f(), 0.0);
}

// A picture with the key's border on it.
fn with_key_border(colour: vec3f, key: Key) -> vec3f {
    if key.border <= 0.0 {
        return colour;
    }
    return mix(colour, vec3f(0.01), key.border);
}

// Whether a number at a place along a bar covers this point of it; `anchor` is 0 or 1 for text right of the
// place or left of it.
fn key_label(key: Key, place: f32, value: f32, anchor: f32) -> bool {
    let half_size = round(1.0 / key.step);
    let cell = max(floor(half_size.y / 6.0), 1.0);
    let gap = 2.0 * cell * (1.0 - 2.0 * anchor);
    let origin = vec2f(floor(place * half_size.x) + gap, 0.0);
    return number_covers(key.place * half_size * vec2f(1.0, -1.0) - origin, value, cell, anchor);
}

// Labels at both ends of a bar, and beside its middle, where a line may be.
fn scale_labels(key: Key, low: f32, middle: f32, high: f32) -> bool {
    return key_label(key, -1.0, low, 0.0) || key_label(key, 0.0, middle, 0.0) || key_label(key, 1.0, high, 1.0);
}

// Black on light colours, white on dark ones.
fn label_colour(colour: vec3f) -> vec3f {
    let luminance = dot(colour, vec3f(0.2126, 0.7152, 0.0722));
    return select(vec3f(1.0), vec3f(0.0), luminance > 0.18);
}
