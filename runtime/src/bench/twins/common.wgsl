// What all twins share, as the "Common" tab of a collection of shaders: the frame, colours, lines, and a camera with
// a box. A twin follows this text and has `fn shade(pixel: vec2f) -> vec3f`, linear rgb.

struct View {
    center: vec2f,
    size: vec2f,
    tile: vec2f,
    pixel: f32,
    time: f32,
    samples: u32,
    zero: u32,
    tile_size: vec2u,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(5) var<storage, read_write> image: array<u32>;

const PI: f32 = 3.141592653589793;
const TAU: f32 = 6.283185307179586;

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.tile_size) {
        return;
    }
    let linear = clamp(shade(vec2f(id.xy) + 0.5), vec3f(0.0), vec3f(1.0));
    let curved = 1.055 * pow(max(linear, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
    let encoded = select(curved, 12.92 * linear, linear <= vec3f(0.0031308));
    // dither by half a step of 8 bits
    let lattice = id.x * 3242174889u + id.y * 2447445414u;
    let noise = ((f32(lattice >> 16u) + 0.5) / 65536.0 - 0.5) / 255.0;
    image[id.y * view.tile_size.x + id.x] = pack4x8unorm(vec4f(encoded + noise, 1.0));
}

fn world(pixel: vec2f) -> vec2f {
    return view.center + (pixel - 0.5 * view.size) * vec2f(view.pixel, -view.pixel);
}

// ---- Colour ----

fn oklab(l: f32, a: f32, b: f32) -> vec3f {
    let cone = vec3f(
        l + 0.3963377774 * a + 0.2158037573 * b,
        l - 0.1055613458 * a - 0.0638541728 * b,
        l - 0.0894841775 * a - 1.2914855480 * b,
    );
    let c = cone * cone * cone;
    return vec3f(
        dot(c, vec3f(4.0767416621, -3.3077115913, 0.2309699292)),
        dot(c, vec3f(-1.2684380046, 2.6097574011, -0.3413193965)),
        dot(c, vec3f(-0.0041960863, -0.7034186147, 1.7076147010)),
    );
}

// Blue, white, red for t in -1..1.
fn diverging(t: f32) -> vec3f {
    let s = min(abs(t), 1.0);
    let hue = select(vec2f(0.89100652, 0.45399050), vec2f(-0.24259923, -0.97012660), t < 0.0);
    let chroma = s * (0.46 - 0.31 * s) * hue;
    return oklab(0.972 - 0.522 * s, chroma.x, chroma.y);
}

// x/√(1 + x²)
fn saturate_real(x: f32) -> f32 {
    return x * inverseSqrt(1.0 + x * x);
}

// The cyclic cubehelix of d3; t in turns, 0 is red.
fn rainbow(t: f32) -> vec3f {
    let u = fract(t + 0.25);
    let off = abs(u - 0.5);
    let lightness = 0.8 - 0.9 * off;
    let radius = (1.5 - 1.5 * off) * lightness * (1.0 - lightness);
    let angle = (u + 0.0555555556) * TAU;
    let c = cos(angle);
    let s = sin(angle);
    let encoded = clamp(
        lightness + radius * vec3f(-0.14861 * c + 1.78277 * s, -0.29227 * c - 0.90649 * s, 1.97294 * c),
        vec3f(0.0),
        vec3f(1.0),
    );
    return select(pow((encoded + 0.055) / 1.055, vec3f(2.4)), encoded / 12.92, encoded <= vec3f(0.04045));
}

// ---- Lines ----

// Share of a pixel at distance d that a line of width w covers, in pixels.
fn line(d: f32, w: f32) -> f32 {
    return clamp(min(d + 0.5, 0.5 * w) - max(d - 0.5, -0.5 * w), 0.0, 1.0);
}

// Lines at the multiples of `spacing` of v, which changes by `rate` a pixel; no more than 34 % dark where they crowd.
fn lines(v: f32, rate: f32, spacing: f32, w: f32) -> f32 {
    let u = v / spacing;
    let apart = spacing / max(rate, 1e-20);
    if apart <= w {
        return 0.34;
    }
    return line(abs(u - round(u)) * apart, w) * min(1.0, 0.34 * apart / w);
}

// ---- Space: a camera at yaw 32°, pitch 24°, fov 28° around a box in the origin, z up ----

const BACK: vec3f = vec3f(0.77473049, 0.48410534, 0.40673664);
const RIGHT: vec3f = vec3f(-0.52991926, 0.84804810, 0.0);
const UP: vec3f = vec3f(-0.34493224, -0.21553758, 0.91354546);
// 50° to the left of the camera, 52° up
const LIGHT: vec3f = vec3f(0.58552886, -0.19024986, 0.78801075);
const BACKGROUND: vec3f = vec3f(0.80, 0.82, 0.85);

struct Camera {
    o: vec3f,
    d: vec3f,
    slope: f32,
}

fn camera(pixel: vec2f, away: f32) -> Camera {
    let slope = 2.0 * 0.24932800 / min(view.size.x, view.size.y);
    let at = (pixel - 0.5 * view.size) * slope;
    return Camera(away * BACK, normalize(at.x * RIGHT - at.y * UP - BACK), slope);
}

// Where a ray enters and leaves the cube of half side r.
fn cube(o: vec3f, d: vec3f, r: f32) -> vec2f {
    let m = 1.0 / d;
    let n = -m * o;
    let k = abs(m) * r;
    let a = n - k;
    let b = n + k;
    return vec2f(max(max(a.x, a.y), a.z), min(min(b.x, b.y), b.z));
}

// Normal of the face of a cube that p lies on.
fn face(p: vec3f) -> vec3f {
    let a = abs(p);
    return sign(p) * select(select(vec3f(0.0, 0.0, 1.0), vec3f(0.0, 1.0, 0.0), a.y >= a.z), vec3f(1.0, 0.0, 0.0), a.x >= a.y && a.x >= a.z);
}

// How much a function with gradient g changes per pixel, on the plane with normal n at distance t: the gradient
// within the plane, foreshortened, and projected to the image.
fn screen_rate(c: Camera, t: f32, n: vec3f, g: vec3f) -> f32 {
    let h = g - n * (dot(g, c.d) / dot(n, c.d));
    let flat = h - BACK * dot(h, BACK);
    return length(flat) * t * -dot(c.d, BACK) * c.slope;
}

// Edges of the cube of half side r on a plane.
fn edges(c: Camera, t: f32, n: vec3f, r: f32, w: f32) -> f32 {
    let gap = max(r - abs(c.o + t * c.d), vec3f(0.0));
    var covered = 0.0;
    if abs(n.x) < 0.99 {
        covered = line(gap.x / screen_rate(c, t, n, vec3f(1.0, 0.0, 0.0)), w);
    }
    if abs(n.y) < 0.99 {
        covered = max(covered, line(gap.y / screen_rate(c, t, n, vec3f(0.0, 1.0, 0.0)), w));
    }
    if abs(n.z) < 0.99 {
        covered = max(covered, line(gap.z / screen_rate(c, t, n, vec3f(0.0, 0.0, 1.0)), w));
    }
    return covered;
}

fn sky(d: vec3f) -> vec3f {
    return BACKGROUND * mix(vec3f(1.0), vec3f(0.60, 0.68, 0.80), 1.0 - exp2(-2.5 * clamp(d.z, 0.0, 1.0)));
}

// The ground under the cube of half side r, and the sky.
fn stage(c: Camera, r: f32) -> vec3f {
    let high = c.o.z + r;
    if c.d.z > -1e-6 {
        return sky(c.d);
    }
    let p = c.o - c.d * (high / c.d.z);
    let aside = length(max(abs(p.xy) - r, vec2f(0.0)));
    let away = length(p.xy) / (1.7320508 * r);
    let light = 1.0 - 0.22 * exp2(-2.5 * aside / (0.42426407 * r));
    return mix(BACKGROUND * vec3f(0.90, 0.89, 0.87) * light, sky(c.d), 1.0 - exp2(-0.012 * away * away));
}

// Light of sky and ground, a wrapped sun, its highlight and a rim.
fn lit(colour: vec3f, n: vec3f, v: vec3f, open: f32) -> vec3f {
    let ambient = mix(vec3f(0.24, 0.21, 0.19), vec3f(0.36, 0.40, 0.46), 0.5 + 0.5 * n.z);
    let sun = vec3f(1.06, 1.00, 0.91) * max(dot(n, LIGHT) + 0.35, 0.0) / 1.35 * mix(1.0, open, 0.6);
    let gloss = pow(max(dot(n, normalize(LIGHT + v)), 1e-6), 110.0) * 0.30 * open;
    let rim = 0.97 * pow(1.0 - clamp(abs(dot(n, v)), 0.0, 1.0), 5.0) * 0.30 * open;
    return colour * (ambient * open + sun) + gloss + rim * BACKGROUND;
}

// A number in 0..1 for each pixel.
fn phase(pixel: vec2f) -> f32 {
    let at = vec2u(pixel);
    return f32((at.x * 2447445414u + at.y * 3242174889u) >> 8u) / 16777216.0;
}
