// Scenes of space: what a camera sees of a box, planes in it, and lines on them that are as wide on the screen as they
// are said to be.

// Change per pixel, in the direction in which it changes most on the screen, of a function with this gradient on the
// plane with normal n that the sight meets at distance t. It is exact: with pixels q and p(q) the point of the plane,
// ∂p/∂q = footprint (R - d (n·R)/(n·d)) for the image's axes R, so that the function changes by R·h with
// h = ∇f - n (∇f·d)/(n·d). Kept within 1e37; negative where the gradient is undefined.
fn screen_rate(sight: Sight, t: f32, n: vec3f, gradient: vec3f) -> f32 {
    let h = gradient - n * (dot(gradient, sight.ray.direction) / tilt_of(sight, n));
    let flat = h - sight.forward * dot(h, sight.forward);
    let square = dot(flat, flat);
    if is_moderate(square) {
        return min(sqrt(square) * sight_footprint(sight, t), 1e37);
    }
    return scaled_screen_rate(sight, t, n, gradient);
}

// `screen_rate` of a gradient of any size, by way of one of about 1.
fn scaled_screen_rate(sight: Sight, t: f32, n: vec3f, gradient: vec3f) -> f32 {
    if is_nan(gradient.x) || is_nan(gradient.y) || is_nan(gradient.z) {
        return -1.0;
    }
    let size = max(abs(gradient.x), max(abs(gradient.y), abs(gradient.z)));
    if size == 0.0 {
        return 0.0;
    }
    if is_inf(size) {
        return 1e37;
    }
    let g = gradient / size;
    let h = g - n * (dot(g, sight.ray.direction) / tilt_of(sight, n));
    let flat = h - sight.forward * dot(h, sight.forward);
    let rate = length(flat) * sight_footprint(sight, t);
    return rate * min(size, 1e37 / max(rate, 1.0));
}

// Cosine between a sight and the normal of a plane, away from 0 by at least 1e-6.
fn tilt_of(sight: Sight, n: vec3f) -> f32 {
    let across = dot(n, sight.ray.direction);
    return select(across, select(1e-6, -1e-6, across < 0.0), abs(across) < 1e-6);
}

// Pixels per unit of each coordinate on the plane with normal n at distance t: 1 over `screen_rate` of the unit
// vectors. Of these, |h|² is 1 - 2 n d/(n·d) + (d/(n·d))², by components, and what is seen of it lacks the square along
// the view; the difference does not cancel, because h is at right angles to the ray. Of no use for a coordinate that is
// constant there.
fn axis_spread(sight: Sight, t: f32, n: vec3f) -> vec3f {
    let lean = sight.ray.direction * (1.0 / tilt_of(sight, n));
    let ahead = sight.forward - lean * dot(n, sight.forward);
    let square = 1.0 + lean * (lean - 2.0 * n) - ahead * ahead;
    return inverseSqrt(max(square, vec3f(1e-12))) * (1.0 / max(sight_footprint(sight, t), 1e-37));
}

// Which coordinates change on a plane with normal n.
fn axes_across(n: vec3f) -> vec3<bool> {
    return abs(n) < vec3f(0.99);
}

// Distance along a ray to the plane n·p = offset; negative where they do not meet.
fn plane_distance(ray: Ray, n: vec3f, offset: f32) -> f32 {
    let rate = dot(n, ray.direction);
    let t = (offset - dot(n, ray.origin)) / select(rate, 1e-20, rate == 0.0);
    return select(t, -1.0, rate == 0.0);
}

// A plane through a box: `position` from -1, where it touches the box's far corner, over 0, through its centre, to 1.
// Returned as its offset n·p.
fn plane_offset(n: vec3f, center: vec3f, half_size: vec3f, position: f32) -> f32 {
    return dot(n, center) + position * dot(abs(n), half_size);
}

// The part of a ray's way through a box that is on the side n·p ≤ offset of a plane.
struct Kept {
    start: f32,
    end: f32,          // less than `start` where nothing is kept
    cut_first: bool,   // whether it begins at the plane
    cut_last: bool,    // whether it ends there
}

// `span` is where the ray is in the box, in front of the camera.
fn kept_part(ray: Ray, span: vec2f, n: vec3f, offset: f32) -> Kept {
    let rate = dot(n, ray.direction);
    if abs(rate) < 1e-7 {
        let inside = dot(n, ray.origin) <= offset;
        return Kept(span.x, select(span.x - 1.0, span.y, inside), false, false);
    }
    let t = (offset - dot(n, ray.origin)) / rate;
    if rate < 0.0 {
        return Kept(max(span.x, t), span.y, t > span.x, false);
    }
    return Kept(span.x, min(span.y, t), false, t < span.y);
}

// A position that swings by `sweep` to both sides in `period` seconds, kept in -1..1.
fn swept_position(position: f32, sweep: f32, period: f32) -> f32 {
    let turn = view.time / max(period, 1e-6);
    return clamp(position + sweep * sin(6.283185307179586 * (turn - floor(turn))), -1.0, 1.0);
}

// Coverage by the edges of the box on the plane with normal n, a face or one that cuts it, at distance t: that of the
// nearest one.
fn box_edges(sight: Sight, t: f32, n: vec3f, center: vec3f, half_size: vec3f, width: f32) -> f32 {
    let p = sight.ray.origin + t * sight.ray.direction;
    let gap = select(vec3f(1e30), max(half_size - abs(p - center), vec3f(0.0)), axes_across(n));
    let window = sample_window();
    // A unit of the plane is at least |n·d|/(1 + |n·d|) of it on the image. Few places are so near to an edge that more must
    // be known.
    if min(gap.x, min(gap.y, gap.z)) * abs(tilt_of(sight, n)) > (width + window) * sight_footprint(sight, t) {
        return 0.0;
    }
    let away = gap * axis_spread(sight, t, n);
    return line_coverage(min(min(away.x, min(away.y, away.z)), 1e9), width, window);
}

// Coverage by the lines at the multiples of `spacing` of each coordinate, on a plane.
fn coordinate_lines(sight: Sight, t: f32, n: vec3f, spacing: f32, width: f32) -> f32 {
    let u = (sight.ray.origin + t * sight.ray.direction) / spacing;
    let rate = 1.0 / (spacing * axis_spread(sight, t, n));
    let across = axes_across(n);
    var covered = 0.0;
    if across.x {
        covered = even_lines(u.x, rate.x, width);
    }
    if across.y {
        covered = max(covered, even_lines(u.y, rate.y, width));
    }
    if across.z {
        covered = max(covered, even_lines(u.z, rate.z, width));
    }
    return covered;
}

// Where coordinates are 0 on a plane: colour of the axis along the nearest such line, and coverage; of two that cover as
// much the first. x is red, y is green, z is blue; on a plane across an axis, the line where one of the other two
// coordinates is 0 is along the third.
fn axis_lines(sight: Sight, t: f32, n: vec3f, width: f32) -> vec4f {
    let p = sight.ray.origin + t * sight.ray.direction;
    let window = sample_window();
    // nearer ones cover no more
    let within = vec3f(0.5 * abs(width - window));
    let away = select(vec3f(1e9), max(abs(p) * axis_spread(sight, t, n), within), axes_across(n));
    let nearest = min(away.x, min(away.y, away.z));
    let not_x = select(vec3f(0.0, 0.0, 1.0), vec3f(0.0, 1.0, 0.0), away.y <= nearest);
    let zero = select(not_x, vec3f(1.0, 0.0, 0.0), away.x <= nearest);
    let along = abs(cross(n, zero));
    let colour = along.x * vec3f(0.55, 0.03, 0.02) + along.y * vec3f(0.02, 0.30, 0.03) + along.z * vec3f(0.02, 0.06, 0.55);
    return vec4f(colour, line_coverage(min(nearest, 1e9), width, window));
}

fn unit_axis(k: u32) -> vec3f {
    return vec3f(f32(k == 0u), f32(k == 1u), f32(k == 2u));
}

// A distance in units of which a pixel spans `rate`, in pixels.
fn pixels_away(offset: f32, rate: f32) -> f32 {
    return min(offset / max(rate, 1e-37), 1e9);
}

// The greatest of 1, 2, 5 times a power of ten that is not above x.
fn round_spacing(x: f32) -> f32 {
    let size = clamp(x, 1e-30, 1e30);
    let decade = pow(10.0, floor(log2(size) * 0.30102999566398120));
    let part = size / decade;
    return decade * select(select(select(select(0.5, 1.0, part >= 0.9999), 2.0, part >= 1.9999), 5.0, part >= 4.9999), 10.0, part >= 9.999);
}

// ---- Where the box stands ------------------------------------------------------------------------------------

// The sky, lighter at the horizon, which has the colour `background`.
fn sky_at(direction: vec3f, background: vec3f) -> vec3f {
    let height = clamp(direction.z, 0.0, 1.0);
    return background * mix(vec3f(1.0), vec3f(0.60, 0.68, 0.80), 1.0 - exp2(-2.5 * height));
}

// Distance along a ray to the ground that the box stands on, 0 where the ray sees the sky.
fn ground_hit(ray: Ray, center: vec3f, half_size: vec3f) -> f32 {
    let height = ray.origin.z - (center.z - half_size.z);
    if height > 0.0 && ray.direction.z < -1e-6 {
        return height / -ray.direction.z;
    }
    return 0.0;
}

// Distance along the ground from the centre, in sizes of the box.
fn ground_distance(p: vec3f, center: vec3f, half_size: vec3f) -> f32 {
    return length(p.xy - center.xy) / max(length(half_size), 1e-20);
}

// A point of the ground that a part `light` of the light reaches, fading into the sky.
fn ground_colour(p: vec3f, direction: vec3f, light: f32, center: vec3f, half_size: vec3f, background: vec3f) -> vec3f {
    let away = ground_distance(p, center, half_size);
    let haze = 1.0 - exp2(-0.012 * away * away);
    return mix(background * vec3f(0.90, 0.89, 0.87) * light, sky_at(direction, background), haze);
}

// Behind a box that stands on the ground: the ground, darker where the box touches it, and the sky.
fn stage_colour(ray: Ray, center: vec3f, half_size: vec3f, background: vec3f) -> vec3f {
    let t = ground_hit(ray, center, half_size);
    if t <= 0.0 {
        return sky_at(ray.direction, background);
    }
    let p = ray.origin + t * ray.direction;
    let reach = 0.30 * length(half_size.xy);
    let aside = length(max(abs(p.xy - center.xy) - half_size.xy, vec2f(0.0)));
    return ground_colour(p, ray.direction, 1.0 - 0.22 * exp2(-2.5 * aside / reach), center, half_size, background);
}

// What is behind the box: 0 the ground and the sky, 1 one colour, 2 nothing.
fn stage_at(backdrop: u32, ray: Ray, center: vec3f, half_size: vec3f, background: vec3f) -> vec4f {
    switch backdrop {
        case 0u: { return vec4f(stage_colour(ray, center, half_size, background), 1.0); }
        case 1u: { return vec4f(background, 1.0); }
        default: { return vec4f(); }
    }
}

// The edges at the face of the box at distance t, on a picture; `ink` is how they look.
fn with_edges(under: vec4f, sight: Sight, t: f32, center: vec3f, half_size: vec3f, width: f32, ink: Layer) -> vec4f {
    let n = box_normal(sight.ray.origin + t * sight.ray.direction, center, half_size);
    return layer_on(under, Layer(ink.colour, ink.opacity * box_edges(sight, t, n, center, half_size, width)));
}
