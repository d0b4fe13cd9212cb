// surface: the level set f(x, y, z) = level inside a box that stands on the ground, lit, seen by an orbiting camera.
// z is up.
//
// Settings:
// | name            | type  | default           | range     | unit    | meaning |
// | box             | vec3f | 2 2 2             | >0        | world   | half size of the box |
// | center          | vec3f | 0 0 0             |           | world   | centre of the box |
// | level           | f32   | 0                 |           | value   | of f on the surface |
// | steps           | u32   | 160               | 8..4096   |         | samples along the diagonal of the box |
// | yaw             | f32   | 32                |           | degrees | of the camera around z, from +x towards +y |
// | pitch           | f32   | 24                | -89..89   | degrees | of the camera above the ground |
// | distance        | f32   | 0                 | 0..       | world   | from the camera to the centre; 0: the box fills the view |
// | fov             | f32   | 28                | 1..120    | degrees | field of view across the shorter side of the image |
// | light_yaw       | f32   | -50               |           | degrees | of the light around z, from the camera's yaw |
// | light_pitch     | f32   | 52                | -90..90   | degrees | of the light above the ground |
// | outside         | vec3f | 0.66 0.23 0.085   | 0..1      | linear  | colour of the side where f > level |
// | inside          | vec3f | 0.06 0.22 0.45    | 0..1      | linear  | colour of the side where f < level |
// | background      | vec3f | 0.80 0.82 0.85    | 0..1      | linear  | colour of the horizon |
// | isoline_spacing | f32   | 0.5               | 0..       | value   | between the lines on the walls; 0: only the surface's |
// | isoline_width   | f32   | 1.1               | 0..20     | pixels  | of the lines on the walls |
// | edge_width      | f32   | 1.4               | 0..20     | pixels  | of the box's edges; 0: none |
// | wall_opacity    | f32   | 1                 | 0..1      |         | of everything that is drawn on the walls |
// | occlusion       | f32   | 0.7               | 0..1      |         | darkening of hollows and of the ground |
// | shadow          | f32   | 0.6               | 0..1      |         | darkness of the shadow on the ground; 0: not computed |
//
// Colours are linear rgb. Where f is undefined there is no surface, and the walls are hatched. A sign change where f
// does not shrink towards the level (a pole, a jump) is no surface either.

struct View {
    center: vec2f,     // world coordinates of the centre of the whole image
    size: vec2f,       // whole image, pixels
    tile: vec2f,       // pixel of the whole image at this tile's top-left corner
    pixel: f32,        // world units per pixel
    time: f32,         // seconds
    samples: u32,      // supersamples per axis, >= 1
    zero: u32,         // always 0, but the shader compiler does not know
    tile_size: vec2u,  // this tile, pixels
}

struct Settings {
    box: vec3f,
    center: vec3f,
    level: f32,
    steps: u32,
    yaw: f32,
    pitch: f32,
    distance: f32,
    fov: f32,
    light_yaw: f32,
    light_pitch: f32,
    outside: vec3f,
    inside: vec3f,
    background: vec3f,
    isoline_spacing: f32,
    isoline_width: f32,
    edge_width: f32,
    wall_opacity: f32,
    occlusion: f32,
    shadow: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// f and df/dt at o + t d
fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f { return vec2f(); }
// (∂f/∂x, ∂f/∂y, ∂f/∂z, f)
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }

struct Ray {
    origin: vec3f,
    direction: vec3f,  // of length 1
}

fn is_nan(x: f32) -> bool { return false; }
fn is_finite(x: f32) -> bool { return false; }
fn length3_safe(v: vec3f) -> f32 { return 0.0; }
fn direction_or(v: vec3f, fallback: vec3f) -> vec3f { return vec3f(); }
fn line_coverage(offset: f32, width: f32, window: f32) -> f32 { return 0.0; }
fn line_train(u: f32, duty: f32, window: f32) -> f32 { return 0.0; }
fn hatch(pixel: vec2f, slope: f32, period: f32, duty: f32, window: f32) -> f32 { return 0.0; }
fn direction_from_angles(yaw: f32, pitch: f32) -> vec3f { return vec3f(); }
fn slope_per_pixel(size: vec2f, fov: f32) -> f32 { return 0.0; }
fn orbit_ray(pixel: vec2f, size: vec2f, aim: vec3f, yaw: f32, pitch: f32, distance: f32, fov: f32) -> Ray { return Ray(); }
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f { return vec2f(); }
fn box_normal(p: vec3f, center: vec3f, half_size: vec3f) -> vec3f { return vec3f(); }
fn wrap_diffuse(n: vec3f, l: vec3f, wrap: f32) -> f32 { return 0.0; }
fn blinn_specular(n: vec3f, l: vec3f, v: vec3f, exponent: f32) -> f32 { return 0.0; }
fn schlick_fresnel(cosine: f32, f0: f32) -> f32 { return 0.0; }

const DEGREE: f32 = 0.017453292519943295;
// Values are kept within ±LARGEST, so that differences and ratios of them are finite.
const LARGEST: f32 = 1e30;
const INK: vec3f = vec3f(0.012, 0.014, 0.02);

// ---- Finding the surface -------------------------------------------------------------------------------------

// f - level on the ray; nothing else of it counts where it is not valid.
struct Sample {
    t: f32,
    value: f32,
    slope: f32,
    valid: bool,
}

struct Hit {
    t: f32,
    found: bool,
    touching: bool,  // the ray touches the level without crossing it
}

const NO_HIT: Hit = Hit(0.0, false, false);

// The part of a ray inside of the box, from its entry on, so that f32 resolves it wherever the ray begins.
struct Path {
    ray: Ray,
    extent: f32,  // none where the ray misses the box
    count: u32,   // steps of a march
}

// `span` is from `box_span`; `steps` are for the diagonal of the box.
fn path_within(ray: Ray, span: vec2f, steps: u32) -> Path {
    let enter = max(span.x, 0.0);
    let extent = span.y - enter;
    return Path(Ray(ray.origin + enter * ray.direction, ray.direction), extent, step_count(extent, steps));
}

fn sample_ray(ray: Ray, t: f32) -> Sample {
    let raw = field_ray(ray.origin, ray.direction, t);
    let value = clamp(raw.x - settings.level, -LARGEST, LARGEST);
    let slope = select(clamp(raw.y, -LARGEST, LARGEST), 0.0, is_nan(raw.y));
    return Sample(t, value, slope, !is_nan(raw.x));
}

fn opposite(a: Sample, b: Sample) -> bool {
    return (a.value < 0.0) != (b.value < 0.0);
}

// The first hit on a path. The inner loop only walks, so that rays side by side walk together to where each has
// something to search, and then search together.
fn march(path: Path) -> Hit {
    if !(path.extent > 0.0) {
        return NO_HIT;
    }
    let ray = path.ray;
    let count = path.count;
    let step = path.extent / f32(count);
    var a: Sample;
    var b: Sample;
    var k = 0u;
    while k <= count {
        var promising = false;
        while k <= count && !promising {
            a = b;
            b = sample_ray(ray, f32(k) * step);
            promising = k > 0u && may_hit(a, b);
            k++;
        }
        if promising {
            let hit = search_step(ray, a, b);
            if hit.found {
                return hit;
            }
        }
    }
    return NO_HIT;
}

// Whether the step from a to b may hold the surface.
fn may_hit(a: Sample, b: Sample) -> bool {
    if a.valid && b.valid {
        return opposite(a, b) || may_dip(a, b);
    }
    return a.valid != b.valid;
}

// The first hit between two samples of which `may_hit` is true.
fn search_step(ray: Ray, a: Sample, b: Sample) -> Hit {
    var near = a;
    var far = b;
    if !a.valid {
        near = b;
        far = a;
    }
    if !far.valid {
        far = last_valid(ray, near, far.t);
    } else if !opposite(a, b) {
        let dip = search_dip(ray, a, b);
        if dip.touching {
            return Hit(dip.extremum.t, true, true);
        }
        far = dip.extremum;
    }
    if opposite(near, far) {
        return refine_crossing(ray, near, far);
    }
    return NO_HIT;
}

// Where f ceases to be defined between a valid sample and a bad place, by bisection from the valid side.
fn last_valid(ray: Ray, good: Sample, bad: f32) -> Sample {
    var edge = good;
    var beyond = bad;
    // Counted from view.zero, so that no driver unrolls what few rays need.
    for (var k = view.zero; k < 12u; k++) {
        let middle = sample_ray(ray, 0.5 * (edge.t + beyond));
        if middle.valid {
            edge = middle;
        } else {
            beyond = middle.t;
        }
    }
    return edge;
}

// Whether a step whose ends have the same sign may hold two crossings: both slopes lead towards the level, and the
// two tangents meet beyond it or within a tenth before it. For a convex |f| the tangents are a bound.
fn may_dip(a: Sample, b: Sample) -> bool {
    let side = select(1.0, -1.0, a.value < 0.0);
    let fall = -side * a.slope;
    let rise = side * b.slope;
    if fall <= 0.0 || rise <= 0.0 {
        return false;
    }
    let va = abs(a.value);
    let vb = abs(b.value);
    // Value where the tangents meet, times fall + rise; kept in range by dividing by the larger slope.
    let top = max(fall, rise);
    let f = fall / top;
    let r = rise / top;
    let met = vb * f + va * r - f * rise * (b.t - a.t);
    return met <= 0.1 * max(va, vb) * (f + r);
}

// What was found between two samples of the same sign: a sample beyond the level, or else the one nearest to it.
struct Dip {
    extremum: Sample,
    touching: bool,  // the nearest is the level, to rounding
}

// Looks for the extremum between two samples of the same sign by regula falsi on the slope (Illinois: Dowell and
// Jarratt 1971), until a sample lies beyond the level or the tangents show that none can.
fn search_dip(ray: Ray, a: Sample, b: Sample) -> Dip {
    var low = a;
    var high = b;
    var low_weight = 1.0;
    var high_weight = 1.0;
    var nearest = a;
    if abs(b.value) < abs(a.value) {
        nearest = b;
    }
    for (var k = 0; k < 10; k++) {
        let down = low_weight * abs(low.slope);
        let up = high_weight * abs(high.slope);
        let part = clamp(down / max(down + up, 1e-37), 0.02, 0.98);
        let middle = sample_ray(ray, mix(low.t, high.t, part));
        if !middle.valid {
            return Dip(a, false);
        }
        if opposite(a, middle) {
            return Dip(middle, false);
        }
        if abs(middle.value) <= abs(nearest.value) {
            nearest = middle;
        }
        if (middle.slope < 0.0) == (a.slope < 0.0) {
            low = middle;
            low_weight = 1.0;
            high_weight *= 0.5;
        } else {
            high = middle;
            high_weight = 1.0;
            low_weight *= 0.5;
        }
        if !may_dip(low, high) {
            break;
        }
    }
    // Even roots: the extremum equals the level to rounding.
    let size = max(abs(a.value), abs(b.value));
    return Dip(nearest, abs(nearest.value) <= 3e-7 * size);
}

// Root between two samples of opposite sign, to the resolution of f32, by Chandrupatla's method (Adv. Eng. Softw.
// 28, 1997): inverse quadratic interpolation where it is safe, bisection elsewhere. A sign change over which |f|
// does not shrink with the bracket is a pole or a jump and not found.
fn refine_crossing(ray: Ray, a: Sample, b: Sample) -> Hit {
    let before = max(abs(a.value), abs(b.value));
    var t1 = b.t;
    var f1 = b.value;
    var t2 = a.t;
    var f2 = a.value;
    var t3 = a.t;
    var f3 = a.value;
    var part = f1 / (f1 - f2);
    for (var k = 0; k < 48; k++) {
        let width = abs(t2 - t1);
        let tolerance = 2.4e-7 * max(abs(t1), abs(t2)) + 1e-30;
        if f1 == 0.0 || width <= 2.0 * tolerance {
            break;
        }
        let margin = min(tolerance / width, 0.5);
        let t = t1 + clamp(part, margin, 1.0 - margin) * (t2 - t1);
        let middle = sample_ray(ray, t);
        if !middle.valid {
            return NO_HIT;
        }
        if (middle.value < 0.0) == (f1 < 0.0) {
            t3 = t1;
            f3 = f1;
        } else {
            t3 = t2;
            f3 = f2;
            t2 = t1;
            f2 = f1;
        }
        t1 = middle.t;
        f1 = middle.value;
        part = next_part(t1, f1, t2, f2, t3, f3);
    }
    let after = select(max(abs(f1), abs(f2)), 0.0, f1 == 0.0);
    let t = select(t2, t1, abs(f1) <= abs(f2));
    return Hit(t, after < 0.25 * before, false);
}

// Where to look next between t1 (0) and t2 (1), given a third point with the sign of t1 or beyond t2.
fn next_part(t1: f32, f1: f32, t2: f32, f2: f32, t3: f32, f3: f32) -> f32 {
    if f1 == f2 || f3 == f2 || f3 == f1 || t3 == t2 || t1 == t2 {
        return 0.5;
    }
    let xi = (t1 - t2) / (t3 - t2);
    let phi = (f1 - f2) / (f3 - f2);
    if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
        return f1 / (f2 - f1) * (f3 / (f2 - f3)) + (t3 - t1) / (t2 - t1) * (f1 / (f3 - f1)) * (f2 / (f3 - f2));
    }
    return 0.5;
}

fn step_count(extent: f32, steps: u32) -> u32 {
    let diagonal = 2.0 * length(settings.box);
    return clamp(u32(ceil(extent / max(diagonal, 1e-20) * f32(steps))), 2u, max(steps, 2u));
}

// ---- Light ---------------------------------------------------------------------------------------------------

fn light_direction() -> vec3f {
    return direction_from_angles((settings.yaw + settings.light_yaw) * DEGREE, settings.light_pitch * DEGREE);
}

// First-order distance to the surface, world units: |f - level| / |∇f|; large where that is not known.
fn distance_estimate(jet: vec4f) -> f32 {
    let size = length3_safe(jet.xyz);
    if is_nan(jet.w) || is_nan(jet.x + jet.y + jet.z) || size <= 0.0 {
        return LARGEST;
    }
    return min(abs(jet.w - settings.level) / size, LARGEST);
}

// Openness of the surface to the sky, 0..1: the distance to the surface at a few points above it, compared with
// their height (A. Evans, "Fast approximations for global illumination on dynamic scenes", 2006).
fn openness(p: vec3f, n: vec3f, side: f32) -> f32 {
    let reach = 0.22 * min(settings.box.x, min(settings.box.y, settings.box.z));
    var closed = 0.0;
    for (var k = 1; k <= 3; k++) {
        let height = reach * f32(k) / 3.0;
        let q = p + height * n;
        if all(abs(q - settings.center) <= settings.box) {
            let jet = field_grad(q);
            let same_side = (jet.w - settings.level) * side > 0.0;
            let free = select(0.0, min(distance_estimate(jet) / height, 1.0), same_side);
            closed += (1.0 - free) * exp2(-f32(k));
        }
    }
    return 1.0 - settings.occlusion * clamp(closed, 0.0, 1.0);
}

// Light that reaches the eye from a surface of one colour: sky and ground light, a wrapped sun, and its highlight.
fn lit(colour: vec3f, n: vec3f, v: vec3f, open: f32) -> vec3f {
    let l = light_direction();
    let sky = mix(vec3f(0.24, 0.21, 0.19), vec3f(0.36, 0.40, 0.46), 0.5 + 0.5 * n.z);
    let sun = vec3f(1.06, 1.00, 0.91) * wrap_diffuse(n, l, 0.35) * mix(1.0, open, 0.6);
    let gloss = blinn_specular(n, l, v, 110.0) * 0.30 * open;
    let rim = (schlick_fresnel(abs(dot(n, v)), 0.03) - 0.03) * 0.30 * open;
    return colour * (sky * open + sun) + vec3f(gloss) + rim * settings.background;
}

// The surface at a hit.
fn surface_colour(path: Path, hit: Hit) -> vec3f {
    let ray = path.ray;
    let step = path.extent / f32(path.count);
    // Where the ray only touches the level the gradient vanishes; just before, it has the right direction.
    let t = hit.t - select(0.0, 0.02 * step, hit.touching);
    let p = ray.origin + t * ray.direction;
    let jet = field_grad(p);
    let gradient = direction_or(jet.xyz, -ray.direction);
    let toward_eye = dot(gradient, ray.direction) <= 0.0;
    let n = select(-gradient, gradient, toward_eye);
    let outer = toward_eye || hit.touching;
    let side = select(-1.0, 1.0, toward_eye);
    let open = openness(p, n, side);
    return lit(select(settings.inside, settings.outside, outer), n, -ray.direction, open);
}

// ---- The box -------------------------------------------------------------------------------------------------

// Distance on the screen of a line in a face, pixels. `offset` is the distance in the face, at right angles to the
// line along the unit vector `along`; seen at an angle it shrinks by |d·n| / |d × along|.
fn screen_distance(offset: f32, along: vec3f, n: vec3f, direction: vec3f, footprint: f32) -> f32 {
    let tilt = sqrt(max(1.0 - dot(direction, along) * dot(direction, along), 1e-8));
    return min(offset * abs(dot(direction, n)) / (tilt * footprint), 1e9);
}

// Coverage by the edges of the box at a point of one of its faces.
fn edge_coverage(p: vec3f, n: vec3f, direction: vec3f, footprint: f32) -> f32 {
    let gap = max(settings.box - abs(p - settings.center), vec3f(0.0));
    return max(
        edge_across(gap.x, vec3f(1.0, 0.0, 0.0), n, direction, footprint),
        max(
            edge_across(gap.y, vec3f(0.0, 1.0, 0.0), n, direction, footprint),
            edge_across(gap.z, vec3f(0.0, 0.0, 1.0), n, direction, footprint),
        ),
    );
}

// Coverage by the edge at distance `gap` along the axis `u` in a face; none where `u` is the face's own normal.
fn edge_across(gap: f32, u: vec3f, n: vec3f, direction: vec3f, footprint: f32) -> f32 {
    if abs(dot(n, u)) > 0.5 {
        return 0.0;
    }
    let away = screen_distance(gap, cross(n, u), n, direction, footprint);
    return line_coverage(away, settings.edge_width, sample_window());
}

// What is drawn on a face: colour and opacity.
struct Wall {
    colour: vec3f,
    opacity: f32,
}

// Puts ink of a colour and opacity on top.
fn paint(under: Wall, colour: vec3f, opacity: f32) -> Wall {
    let total = opacity + under.opacity * (1.0 - opacity);
    return Wall(mix(under.colour, colour, opacity / max(total, 1e-6)), total);
}

// Lines and tint on the face at p with normal n. `strength` tells the walls behind from those in front.
fn wall_at(p: vec3f, n: vec3f, direction: vec3f, footprint: f32, pixel: vec2f, behind: bool) -> Wall {
    let window = sample_window();
    let jet = field_grad(p);
    var wall = Wall(vec3f(1.0), 0.0);
    if is_nan(jet.w) {
        let opacity = select(0.12, 0.30, behind);
        return Wall(vec3f(0.45), opacity * hatch(pixel, 1.0, 7.0, 0.3, window));
    }
    let value = clamp(jet.w - settings.level, -LARGEST, LARGEST);
    let side = select(settings.outside, settings.inside, value < 0.0);
    if behind {
        wall = Wall(mix(side, vec3f(1.0), 0.5), 0.22);
    }
    let flat = jet.xyz - n * dot(jet.xyz, n);
    let slope = length3_safe(flat);
    if !is_finite(slope) || slope <= 0.0 {
        return wall;
    }
    let along = cross(n, flat / slope);
    // Change of value per pixel across the line.
    let rate = 1.0 / max(screen_distance(1.0 / slope, along, n, direction, footprint), 1e-30);
    if behind && settings.isoline_spacing > 0.0 {
        wall = paint(wall, mix(side, INK, 0.45), 0.5 * family_coverage(value, rate, window));
    }
    let away = min(abs(value) / max(rate, 1e-30), 1e9);
    let level_line = line_coverage(away, 2.0 * settings.isoline_width, window);
    if level_line > 0.0 && is_zero_near(p - flat / slope * (value / slope), value) {
        wall = paint(wall, INK, level_line * select(0.55, 0.85, behind));
    }
    return wall;
}

// Tells a zero from a pole by one Newton step, which ends at q: near a zero of order n it multiplies the value by
// (1 - 1/n)^n < 1/e, near a pole of order n by (1 + 1/n)^-n > 1/e.
fn is_zero_near(q: vec3f, value: f32) -> bool {
    let next = field_grad(q).w - settings.level;
    return is_finite(next) && abs(next) <= 0.36787944 * abs(value) + 1e-6 * abs(settings.level);
}

// Coverage by the isolines of the walls: lines at the multiples of 1, 5 and 25 spacings, each family vanishing
// where its lines come closer than a few pixels.
fn family_coverage(value: f32, rate: f32, window: f32) -> f32 {
    var covered = 0.0;
    var spacing = settings.isoline_spacing;
    for (var k = 0; k < 3; k++) {
        let u = value / spacing;
        let lines = min(rate / spacing, 1e9);
        // Past 2²² spacings f32 no longer resolves the place between two lines.
        if abs(u) < 4194304.0 {
            let sparse = 1.0 - smoothstep(0.10, 0.28, lines);
            covered = max(covered, sparse * line_train(u, lines * settings.isoline_width, lines * window));
        }
        spacing *= 5.0;
    }
    return covered;
}

// The faces of the box that the ray meets, over what lies behind them. The far one is hidden by the surface.
fn over_box(under: vec3f, ray: Ray, span: vec2f, hidden: bool, pixel: vec2f) -> vec3f {
    if span.y <= max(span.x, 0.0) {
        return under;
    }
    let pixel_slope = slope_per_pixel(view.size, clamp(settings.fov, 1.0, 120.0) * DEGREE);
    var colour = under;
    for (var face = view.zero; face < 2u; face++) {
        let behind = face == 0u;
        let t = select(span.x, span.y, behind);
        if t > 0.0 && !(behind && hidden) {
            colour = over_wall(colour, ray, t, pixel, pixel_slope, behind);
        }
    }
    return colour;
}

// The face of the box at distance t on the ray, over what lies behind it.
fn over_wall(under: vec3f, ray: Ray, t: f32, pixel: vec2f, pixel_slope: f32, behind: bool) -> vec3f {
    let p = ray.origin + t * ray.direction;
    let n = box_normal(p, settings.center, settings.box);
    let footprint = max(t * pixel_slope, 1e-30);
    let wall = wall_at(p, n, ray.direction, footprint, pixel, behind);
    let edge = edge_coverage(p, n, ray.direction, footprint);
    let colour = mix(under, wall.colour, wall.opacity * settings.wall_opacity);
    return mix(colour, INK, edge * select(0.8, 0.6, behind));
}

// ---- Ground and sky ------------------------------------------------------------------------------------------

fn ground_height() -> f32 {
    return settings.center.z - settings.box.z;
}

fn sky_colour(direction: vec3f) -> vec3f {
    let height = clamp(direction.z, 0.0, 1.0);
    return settings.background * mix(vec3f(1.0), vec3f(0.60, 0.68, 0.80), 1.0 - exp2(-2.5 * height));
}

// Light left at a point of the ground by the surface above it: the estimated distance to the surface from the
// nearest point of the box's floor, and on from there.
fn ground_openness(p: vec3f) -> f32 {
    let reach = 0.30 * length(settings.box.xy);
    let q = clamp(p, settings.center - settings.box, settings.center + settings.box);
    let aside = distance(p, q);
    let away = length(vec2f(min(distance_estimate(field_grad(q)), 1e9), 2.0 * aside));
    return 1.0 - settings.occlusion * (0.55 * exp2(-2.0 * away / reach) + 0.25 * exp2(-2.5 * aside / reach));
}

// The light's path to a point of the ground.
fn shadow_path(p: vec3f) -> Path {
    let l = light_direction();
    let span = box_span(p, l, settings.center, settings.box);
    return path_within(Ray(p, l), span, max(settings.steps / 2u, 8u));
}

// Where the shadow is looked for: not so far away that haze hides it.
fn may_be_shadowed(p: vec3f) -> bool {
    return settings.shadow > 0.0 && ground_distance(p) < 8.0;
}

// Distance along the ground from the centre, in sizes of the box.
fn ground_distance(p: vec3f) -> f32 {
    return length(p.xy - settings.center.xy) / max(length(settings.box), 1e-20);
}

fn ground_colour(p: vec3f, direction: vec3f, shadowed: bool) -> vec3f {
    let light = ground_openness(p) * (1.0 - settings.shadow * select(0.0, 0.55, shadowed));
    let away = ground_distance(p);
    let haze = 1.0 - exp2(-0.012 * away * away);
    return mix(settings.background * vec3f(0.90, 0.89, 0.87) * light, sky_colour(direction), haze);
}

// Distance to the ground on a ray, or 0 where the ray sees the sky.
fn ground_hit(ray: Ray) -> f32 {
    let height = ray.origin.z - ground_height();
    if height > 0.0 && ray.direction.z < -1e-6 {
        return height / -ray.direction.z;
    }
    return 0.0;
}

// ---- The picture ---------------------------------------------------------------------------------------------

// Side of one sample's share of a pixel, in pixels: the window of every filter here.
fn sample_window() -> f32 {
    return 1.0 / f32(max(view.samples, 1u));
}

fn camera_distance() -> f32 {
    if settings.distance > 0.0 {
        return settings.distance;
    }
    return 0.98 * length(settings.box) / sin(0.5 * clamp(settings.fov, 1.0, 120.0) * DEGREE);
}

fn camera_ray(pixel: vec2f) -> Ray {
    let pitch = clamp(settings.pitch, -89.0, 89.0) * DEGREE;
    let fov = clamp(settings.fov, 1.0, 120.0) * DEGREE;
    return orbit_ray(pixel, view.size, settings.center, settings.yaw * DEGREE, pitch, camera_distance(), fov);
}

fn shade(pixel: vec2f) -> vec4f {
    let ray = camera_ray(pixel);
    let span = box_span(ray.origin, ray.direction, settings.center, settings.box);
    let ground = ground_hit(ray);
    let ground_point = ray.origin + ground * ray.direction;
    // The eye's path, and then, where it ends on the ground, the light's. Drivers copy a function to where it is
    // called; the loop makes that one place.
    let sight = path_within(ray, span, settings.steps);
    var path = sight;
    var hit = NO_HIT;
    var shadowed = false;
    for (var leg = view.zero; leg < 2u; leg++) {
        let found = march(path);
        if leg > 0u {
            shadowed = found.found;
            break;
        }
        hit = found;
        if hit.found || ground <= 0.0 || !may_be_shadowed(ground_point) {
            break;
        }
        path = shadow_path(ground_point);
    }
    var colour: vec3f;
    if hit.found {
        colour = surface_colour(sight, hit);
    } else if ground > 0.0 {
        colour = ground_colour(ground_point, ray.direction, shadowed);
    } else {
        colour = sky_colour(ray.direction);
    }
    colour = over_box(colour, ray, span, hit.found, pixel);
    return vec4f(clamp(colour, vec3f(0.0), vec3f(1.0)), 1.0);
}
