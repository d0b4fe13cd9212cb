// Two steps of the iteration of Doyle and McMullen on the Riemann sphere, by stereographic projection from the south
// pole; derivatives by forward differences on the screen.

fn newton(z: vec2f) -> vec2f {
    let z2 = mul(z, z);
    let z5 = mul(mul(z2, z2), z);
    return mul(z, div(2.0 * z5 + vec2f(3.0, 0.0), 3.0 * z5 + vec2f(2.0, 0.0)));
}

fn f(z: vec2f) -> vec2f {
    return newton(newton(z));
}

// yaw -20°, pitch -18°
const TO_VIEWER: vec3f = vec3f(0.89370079, -0.32528049, -0.30901699);
const TO_RIGHT: vec3f = vec3f(0.34202014, 0.93969262, 0.0);
const TO_TOP: vec3f = vec3f(0.29038099, -0.10569004, 0.95105652);
// in the axes of the view
const SUN: vec3f = vec3f(-0.45752564, 0.66913061, 0.58560611);

// The point of the sphere at a point of the picture.
fn seen(at: vec2f) -> vec3f {
    let inside = at * min(1.0, 0.9999995 / max(length(at), 1e-6));
    return inside.x * TO_RIGHT + inside.y * TO_TOP + sqrt(max(1.0 - dot(inside, inside), 1e-6)) * TO_VIEWER;
}

fn value(p: vec3f) -> vec2f {
    return f(p.xy / (1.0 + p.z));
}

fn graticule(p: vec3f, right: vec3f, up: vec3f) -> f32 {
    let around = max(length(p.xy), 1e-6);
    let count = 24.0 / TAU;
    let parallel = atan2(p.z, around) * count;
    let meridian = atan2(p.y, p.x) * count;
    let north = length(vec2f(right.z, up.z) - p.z) / around * count;
    let e = vec2f(p.x * right.y - p.y * right.x, p.x * up.y - p.y * up.x);
    let east = length(e) / (around * around) * count;
    let a = line(abs(parallel - round(parallel)) / north, 1.2) * (1.0 - smoothstep(0.5, 4.0, north));
    let b = line(abs(meridian - round(meridian)) / east, 1.2) * (1.0 - smoothstep(0.5, 4.0, east));
    return max(a, b);
}

fn shade(pixel: vec2f) -> vec3f {
    let at = world(pixel);
    let radius = length(at);
    let p = seen(at);
    let right = seen(at + vec2f(view.pixel, 0.0));
    let up = seen(at + vec2f(0.0, view.pixel));
    let w = value(p);
    let change = max(length(value(right) - w), length(value(up) - w));
    var colour = domain_colour(w, 0.75, change / max(length(w), 1e-30));
    colour = mix(colour, vec3f(0.010, 0.012, 0.02), 0.3 * graticule(p, right, up));
    let flat = at * min(1.0, 0.9999995 / max(radius, 1e-6));
    let n = vec3f(flat, sqrt(max(1.0 - dot(flat, flat), 0.0)));
    let diffuse = 0.22 + 0.92 * max(dot(n, SUN) + 0.35, 0.0) / 1.35;
    let shine = 0.35 * pow(max(dot(n, normalize(SUN + vec3f(0.0, 0.0, 1.0))), 1e-6), 48.0);
    let rim = 1.0 - 0.35 * pow(1.0 - n.z, 3.0);
    colour = colour * diffuse * rim + shine;
    let from_center = (pixel - 0.5 * view.size) / max(view.size.x, view.size.y);
    let backdrop = BACKGROUND * (1.0 - 0.55 * dot(from_center, from_center));
    return mix(backdrop, colour, clamp(0.5 + (1.0 - radius) / view.pixel, 0.0, 1.0));
}
