// Numbers from the host in all their digits: two words each, as real_from_words takes them.

struct Wide {
    center: vec4u,              // x and y of the view's centre, world coordinates
    clock: vec4u,               // seconds, and world units per pixel
    params: array<vec4u, 32>,   // the program's parameters, two in each
}

@group(0) @binding(4) var<uniform> wide: Wide;
