// Compositing (T. Porter and T. Duff, "Compositing digital images", SIGGRAPH 1984). Colours with alpha are linear and
// premultiplied: 0 is nothing at all, alpha 1 hides what is behind.

struct Layer {
    colour: vec3f,
    opacity: f32,
}

// What has been seen so far of a ray: light, and the part of what lies behind that comes through.
struct Seen {
    light: vec3f,
    through: f32,
}

fn seen_nothing() -> Seen {
    return Seen(vec3f(), 1.0);
}

// A layer behind all that has been seen.
fn seen_behind(seen: Seen, layer: Layer) -> Seen {
    let opacity = clamp(layer.opacity, 0.0, 1.0);
    return Seen(seen.light + seen.through * opacity * layer.colour, seen.through * (1.0 - opacity));
}

// One layer in front of another, as one.
fn layer_over(front: Layer, back: Layer) -> Layer {
    let opacity = front.opacity + back.opacity * (1.0 - front.opacity);
    return Layer(mix(back.colour, front.colour, front.opacity / max(opacity, 1e-6)), opacity);
}

// A layer on a picture. On an opaque one the result has an alpha of exactly 1.
fn layer_on(under: vec4f, layer: Layer) -> vec4f {
    return vec4f(mix(under.rgb, layer.colour, layer.opacity), 1.0 - (1.0 - under.a) * (1.0 - layer.opacity));
}

// What has been seen, in front of a picture.
fn seen_over(seen: Seen, behind: vec4f) -> vec4f {
    let colour = seen.light + seen.through * behind.rgb;
    return vec4f(clamp(colour, vec3f(0.0), vec3f(1.0)), 1.0 - seen.through * (1.0 - behind.a));
}
