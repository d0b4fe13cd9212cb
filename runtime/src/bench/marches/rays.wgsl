// Rays through a box, and the integral of a density along each. Origin and directions are numbers with few bits, so that
// they are the same to the last bit on every device and in f64; where a ray enters and leaves the box is rounded to
// 1/1024.

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
// nodes of Gauss and Legendre: place and weight, two of them in each
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;

fn field(p: vec3f) -> f32 { return 0.0; }
fn field_integral(o: vec3f, d: vec3f, a: f32, b: f32) -> f32 { return 0.0; }

fn shade(pixel: vec2f) -> vec4f {
    // every STRIDE-th pixel of a frame of 640x360
    let place = (pixel * STRIDE - vec2f(320.0, 180.0)) / 1024.0;
    // the clock is 0, but the shader compiler does not know
    let origin = vec3f(-3.0, -4.5, 1.5) + view.time;
    let direction = vec3f(0.5, 0.75, -0.25)
        + place.x * vec3f(0.75, -0.5, 0.0)
        + place.y * vec3f(0.125, 0.1875, 0.8125);
    let far = 2.0 * sign(direction);
    let enter = (-far - origin) / direction;
    let leave = (far - origin) / direction;
    let first = max(enter.x, max(enter.y, enter.z));
    let last = min(leave.x, min(leave.y, leave.z));
    let span = floor(vec2f(first, last) * 1024.0 + 0.5) / 1024.0;
    return vec4f(along_ray(origin, direction, span.x, span.y));
}

