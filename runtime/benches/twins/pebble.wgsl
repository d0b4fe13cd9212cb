// Gradient noise as shader artists write it: pcg3d for the lattice, the quintic fade, any slopes. The picture is not
// the same, its cost is comparable.

fn pcg3d(p: vec3u) -> vec3u {
    var v = p * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v = v ^ (v >> vec3u(16u));
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

fn corner(cell: vec3f, t: vec3f, c: vec3f) -> f32 {
    let h = vec3f(pcg3d(vec3u(vec3i(cell + c)))) / 2147483648.0 - 1.0;
    return dot(h, t - c);
}

fn gradient_noise(p: vec3f) -> f32 {
    let cell = floor(p);
    let t = p - cell;
    let s = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let o = vec2f(0.0, 1.0);
    return mix(
        mix(mix(corner(cell, t, o.xxx), corner(cell, t, o.yxx), s.x),
            mix(corner(cell, t, o.xyx), corner(cell, t, o.yyx), s.x), s.y),
        mix(mix(corner(cell, t, o.xxy), corner(cell, t, o.yxy), s.x),
            mix(corner(cell, t, o.xyy), corner(cell, t, o.yyy), s.x), s.y),
        s.z);
}

fn f(p: vec3f) -> f32 {
    return length(p) - 1.0 + 0.3 * gradient_noise(3.0 * p);
}
