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
    if height < 4.0 {
        return Key(vec2f(), vec2f(1.0), false, 0.0);
    }
    let half_size = 0.5 * vec2f(min(height * aspect, 0.9 * view.size.x), height);
    let margin = clamp(0.02 * min(view.size.x, view.size.y), 4.0, 24.0);
    let from_center = pixel - (view.size - margin - half_size);
    let beyond = max(abs(from_center.x) - half_size.x, abs(from_center.y) - half_size.y);
    let border = line_coverage(beyond, 2.0, sample_window());
    return Key(from_center * vec2f(1.0, -1.0) / half_size, 1.0 / half_size, beyond < 0.0, border);
}

// The identity on the square key: value z of size `reach` at the edges, and its derivative per world unit.
fn key_jet(key: Key, reach: f32) -> Jet {
    return Jet(reach * key.place, vec2f(reach * key.step.x / view.pixel, 0.0), vec2f());
}

// A picture with the key's border on it.
fn with_key_border(colour: vec3f, key: Key) -> vec3f {
    return mix(colour, vec3f(0.01), key.border);
}
