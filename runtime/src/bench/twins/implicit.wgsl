// The curve of the folium and the double circle: distance by central differences, with the second derivative along
// the gradient for the multiplicity.

fn f(p: vec2f) -> f32 {
    let c = dot(p, p) - 3.0;
    return (p.x * p.x * p.x + p.y * p.y * p.y - 3.0 * p.x * p.y) * c * c;
}

fn shade(pixel: vec2f) -> vec3f {
    let p = world(pixel);
    let h = view.pixel;
    let v = f(p);
    let g = 0.5 * vec2f(f(p + vec2f(h, 0.0)) - f(p - vec2f(h, 0.0)), f(p + vec2f(0.0, h)) - f(p - vec2f(0.0, h)));
    let slope = max(length(g), 1e-30);
    let n = g / slope * h;
    let bend = f(p + n) - 2.0 * v + f(p - n);
    // Newton's step N and h = f f''/f'²: near a root of multiplicity m, h = 1 - 1/m
    let newton = abs(v) / slope;
    let curved = v * bend / (slope * slope);
    var away = 2.0 * newton / (1.0 + sqrt(max(1.0 - 2.0 * curved, 0.0)));
    var ink = vec3f(0.010, 0.012, 0.02);
    var crosses = true;
    if curved > 0.44 {
        // a double root, or none
        away = sqrt(2.0 * abs(v) / max(abs(bend), 1e-30));
        crosses = false;
        ink = vec3f(0.36, 0.015, 0.1);
    }
    let above = vec3f(0.9, 0.6, 0.42);
    let below = vec3f(0.4, 0.61, 0.8);
    let share = select(1.0, clamp(0.5 + away, 0.0, 1.0), crosses);
    let fill = select(mix(above, below, share), mix(below, above, share), v >= 0.0);
    return mix(fill, ink, line(away, 2.4));
}
