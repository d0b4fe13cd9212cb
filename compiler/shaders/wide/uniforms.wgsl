// Numbers from the host in all their digits: two words each, as real_from_words takes them. Storage, for Mesa 22.3's software
// adapter writes past an array where a branch hangs on a fourth uniform buffer.

struct Wide {
    center: vec4u,              // x and y of the view's centre, world coordinates
    clock: vec4u,               // seconds, and world units per pixel
    params: array<vec4u, 32>,   // the program's parameters, two in each
}

@group(0) @binding(3) var<storage, read> wide: Wide;
