// surface: the level set f(x, y, z) = level inside a box that stands on the ground, lit. z is up.
//
// Settings:
// | name            | type  | default           | range     | unit    | meaning |
// | box             | vec3f | 2 2 2             | >0        | world   | half size of the box |
// | center          | vec3f | 0 0 0             |           | world   | centre of the box |
// | level           | f32   | 0                 |           | value   | of f on the surface |
// | steps           | u32   | 160               | 8..4096   |         | samples along the diagonal of the box |
// | camera          |       |                   |           |         | where it is and how it sees |
// | light_yaw       | f32   | -50               |           | degrees | of the light around z |
// | light_pitch     | f32   | 52                | -90..90   | degrees | of the light above the ground |
// | light_from      | u32   | 0                 | 0..1      |         | where light_yaw begins: 0 the camera's yaw, 1 +x |
// | light_strength  | f32   | 1                 | 0..100    |         | of the sun |
// | ambient         | f32   | 1                 | 0..100    |         | strength of the light of sky and ground |
// | outside         | vec3f | 0.66 0.23 0.085   | 0..1      | linear  | colour of the side where f > level |
// | inside          | vec3f | 0.06 0.22 0.45    | 0..1      | linear  | colour of the side where f < level |
// | background      | vec3f | 0.80 0.82 0.85    | 0..1      | linear  | colour of the horizon |
// | backdrop        | u32   | 0                 | 0..2      |         | 0 ground and sky, 1 one colour, 2 nothing |
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

struct Camera {
    eye: vec3f,
    yaw: f32,
    aim: vec3f,
    pitch: f32,
    up: vec3f,
    distance: f32,
    fov: f32,
    extent: f32,
    camera: u32,
    projection: u32,
}

struct Settings {
    box: vec3f,
    center: vec3f,
    level: f32,
    steps: u32,
    camera: Camera,
    light_yaw: f32,
    light_pitch: f32,
    light_from: u32,
    light_strength: f32,
    ambient: f32,
    outside: vec3f,
    inside: vec3f,
    background: vec3f,
    backdrop: u32,
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

fn field(p: vec3f) -> f32 { return 0.0; }
// f and df/dt at o + t d
fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f { return vec2f(); }
// (∂f/∂x, ∂f/∂y, ∂f/∂z, f)
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }

struct Ray {
    origin: vec3f,
    direction: vec3f,  // of length 1
}

struct Sight {
    ray: Ray,
    forward: vec3f,
    slope: f32,
    parallel: bool,
    before: f32,
}

struct Lamp {
    toward: vec3f,
    strength: f32,
    surroundings: vec3f,
    ambient: f32,
}

struct Layer {
    colour: vec3f,
    opacity: f32,
}

fn is_nan(x: f32) -> bool { return false; }
fn is_finite(x: f32) -> bool { return false; }
fn length3_safe(v: vec3f) -> f32 { return 0.0; }
fn direction_or(v: vec3f, fallback: vec3f) -> vec3f { return vec3f(); }
fn sample_window() -> f32 { return 0.0; }
fn line_coverage(offset: f32, width: f32, window: f32) -> f32 { return 0.0; }
fn line_train(u: f32, duty: f32, window: f32) -> f32 { return 0.0; }
fn hatch(pixel: vec2f, slope: f32, period: f32, duty: f32, window: f32) -> f32 { return 0.0; }
fn pixels_away(offset: f32, rate: f32) -> f32 { return 0.0; }
fn sight_at(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight { return Sight(); }
fn screen_rate(sight: Sight, t: f32, n: vec3f, gradient: vec3f) -> f32 { return 0.0; }
fn light_toward(camera: Camera, yaw: f32, pitch: f32, origin: u32) -> vec3f { return vec3f(); }
fn lit_colour(colour: vec3f, n: vec3f, v: vec3f, open: f32, lamp: Lamp) -> vec3f { return vec3f(); }
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f { return vec2f(); }
fn box_normal(p: vec3f, center: vec3f, half_size: vec3f) -> vec3f { return vec3f(); }
fn layer_over(front: Layer, back: Layer) -> Layer { return Layer(); }
fn layer_on(under: vec4f, layer: Layer) -> vec4f { return vec4f(); }
fn edge_layer(sight: Sight, t: f32, n: vec3f, center: vec3f, half_size: vec3f, width: f32, behind: bool) -> Layer { return Layer(); }
fn sky_at(direction: vec3f, background: vec3f) -> vec3f { return vec3f(); }
fn ground_hit(ray: Ray, center: vec3f, half_size: vec3f) -> f32 { return 0.0; }
fn ground_distance(p: vec3f, center: vec3f, half_size: vec3f) -> f32 { return 0.0; }
fn ground_colour(p: vec3f, direction: vec3f, light: f32, center: vec3f, half_size: vec3f, background: vec3f) -> vec3f { return vec3f(); }

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
    count: f32,   // steps of a march
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

// What a search within a step looks for: where f ceases to be defined, which side of a sample the extremum is on, slopes at
// the ends of its step, the extremum, a root.
const EDGE: u32 = 0u;
const TURN: u32 = 1u;
const ENDS: u32 = 2u;
const DIP: u32 = 3u;
const CROSSING: u32 = 4u;
// It has ended, without a hit or with one.
const NOTHING: u32 = 5u;
const FOUND: u32 = 6u;

// A search between two samples: of the last valid one and a bad place; of the neighbours of one that is near to the level; of
// two around an extremum; of two around a root.
struct Search {
    mode: u32,
    count: u32,        // samples that it has taken
    t: f32,            // where the next one is wanted; of a hit, where that is
    low: Sample,       // a bad place, or a sample on the near side
    high: Sample,      // a sample on the far side
    third: Sample,     // the valid end of the step, or the sample nearest to the level
    low_weight: f32,   // of the Illinois method
    high_weight: f32,
    size: f32,         // greatest |f - level| before a search for an extremum or a root
    first: f32,        // width of the first bracket of a root
    touching: bool,    // of a hit
}

// The end of what has been walked over, where f is |f - level| of the side that the ray is on.
struct Walk {
    k: f32,       // number of the next sample
    side: f32,    // 1 or -1; 0 where f is undefined, or nothing has been walked over
    value: f32,   // f at the last sample
    older: f32,   // and at the one before it
}

// The first hit on a path. The inner loop only walks, by values alone, to where f changes its sign or, near the level,
// comes no nearer, so that rays side by side walk together to where each has something to search, and then search together,
// with slopes. Drivers copy a function to where it is called, and f may be long: each is called in one place.
fn march(path: Path) -> Hit {
    if !(path.extent > 0.0) {
        return NO_HIT;
    }
    let step = path.extent / path.count;
    let stride = step * path.ray.direction;
    var walk: Walk;
    while walk.k <= path.count {
        var value: f32;
        loop {
            value = field(path.ray.origin + walk.k * stride) - settings.level;
            let ahead = walk.side * value;
            if !(ahead > 0.0) | (walk.k >= path.count) {
                break;
            }
            // seldom true, and so not computed together with the rest
            if ahead >= walk.value {
                if turns(walk, ahead) {
                    break;
                }
            }
            walk = Walk(walk.k + 1.0, walk.side, ahead, walk.value);
        }
        var search = search_step(walk, value, step, walk.k >= path.count);
        while search.mode < NOTHING {
            search = searched(search, sample_ray(path.ray, search.t));
        }
        if search.mode == FOUND {
            return Hit(search.t, true, search.touching);
        }
        walk = walk_on(walk, value);
    }
    return NO_HIT;
}

// Whether f comes no nearer to the level after the last sample, and from there is no farther from it than from one of its
// neighbours. An extremum between them may then be beyond the level: a parabola goes an eighth as far.
fn turns(walk: Walk, ahead: f32) -> bool {
    return ahead >= walk.value && walk.value <= walk.older && is_close(walk, ahead);
}

fn is_close(walk: Walk, ahead: f32) -> bool {
    return walk.value <= max(ahead, walk.older) - walk.value;
}

// A walk over a sample in whose step nothing has been found.
fn walk_on(walk: Walk, value: f32) -> Walk {
    if is_nan(value) {
        return Walk(walk.k + 1.0, 0.0, 0.0, 0.0);
    }
    let side = select(1.0, -1.0, value < 0.0);
    return Walk(walk.k + 1.0, side, abs(value), select(abs(value), walk.value, side == walk.side));
}

// What is to be searched where a walk ends.
fn search_step(walk: Walk, value: f32, step: f32, last: bool) -> Search {
    let t = walk.k * step;
    let far = Sample(t, clamp(value, -LARGEST, LARGEST), 0.0, !is_nan(value));
    let near = Sample(t - step, clamp(walk.side * walk.value, -LARGEST, LARGEST), 0.0, walk.side != 0.0);
    if walk.k == 0.0 || !(near.valid || far.valid) {
        return nothing(Search());
    }
    if !near.valid {
        return edge_place(Search(EDGE, 0u, 0.0, near, far, far, 1.0, 1.0, 0.0, 0.0, false));
    }
    if !far.valid {
        return edge_place(Search(EDGE, 0u, 0.0, far, near, near, 1.0, 1.0, 0.0, 0.0, false));
    }
    if opposite(near, far) {
        return search_crossing(near, far, 0.0);
    }
    let ahead = walk.side * value;
    if turns(walk, ahead) {
        return search_turn(near, max(near.t - step, 0.0), t);
    }
    if last && ahead <= walk.value - ahead {
        return search_turn(far, near.t, t);
    }
    return nothing(Search());
}

// On which side of a sample |f - level| is least, between two places.
fn search_turn(middle: Sample, low: f32, high: f32) -> Search {
    var search = Search(TURN, 0u, middle.t, middle, middle, middle, 1.0, 1.0, 0.0, 0.0, false);
    search.low.t = low;
    search.high.t = high;
    return search;
}

// A search with the sample that it wanted.
fn searched(search: Search, found: Sample) -> Search {
    switch search.mode {
        case EDGE: { return searched_edge(search, found); }
        case TURN: { return searched_turn(search, found); }
        case ENDS: { return searched_end(search, found); }
        case DIP: { return searched_dip(search, found); }
        default: { return searched_crossing(search, found); }
    }
}

// The end of a search without a hit.
fn nothing(search: Search) -> Search {
    var next = search;
    next.mode = NOTHING;
    return next;
}

// Where f ceases to be defined between a bad place (low) and a valid sample (high), by bisection from the valid side.
fn edge_place(search: Search) -> Search {
    var next = search;
    next.t = 0.5 * (search.high.t + search.low.t);
    return next;
}

fn searched_edge(search: Search, found: Sample) -> Search {
    var next = search;
    if found.valid {
        next.high = found;
    } else {
        next.low = found;
    }
    next.count++;
    if next.count < 12u {
        return edge_place(next);
    }
    if opposite(next.third, next.high) {
        if next.third.t > next.high.t {
            return search_crossing(next.high, next.third, 0.0);
        }
        return search_crossing(next.third, next.high, 0.0);
    }
    return nothing(next);
}

// From a sample that is near to the level to the other end of the step that has the extremum, if there is one.
fn searched_turn(search: Search, found: Sample) -> Search {
    var next = search;
    let nearer_ahead = (found.value < 0.0) == (found.slope > 0.0);
    next.mode = ENDS;
    next.t = select(search.low.t, search.high.t, nearer_ahead);
    next.low = found;
    next.high = found;
    if !found.valid || next.t == found.t {
        return nothing(next);
    }
    return next;
}

fn searched_end(search: Search, found: Sample) -> Search {
    var next = search;
    if found.t < search.low.t {
        next.low = found;
    } else {
        next.high = found;
    }
    if !may_dip(next.low, next.high) {
        return nothing(next);
    }
    next.mode = DIP;
    next.size = max(abs(next.low.value), abs(next.high.value));
    next.third = next.low;
    if abs(next.high.value) < abs(next.low.value) {
        next.third = next.high;
    }
    return dip_place(next);
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

// Looks for the extremum between two samples of the same sign by regula falsi on the slope (Illinois: Dowell and
// Jarratt 1971), until a sample lies beyond the level or the tangents show that none can.
fn dip_place(search: Search) -> Search {
    let down = search.low_weight * abs(search.low.slope);
    let up = search.high_weight * abs(search.high.slope);
    let part = clamp(down / max(down + up, 1e-37), 0.02, 0.98);
    var next = search;
    next.t = mix(search.low.t, search.high.t, part);
    return next;
}

fn searched_dip(search: Search, found: Sample) -> Search {
    if !found.valid {
        return nothing(search);
    }
    if opposite(search.low, found) {
        return search_crossing(search.low, found, search.size);
    }
    var next = search;
    if abs(found.value) <= abs(next.third.value) {
        next.third = found;
    }
    if (found.slope < 0.0) == (search.low.slope < 0.0) {
        next.low = found;
        next.low_weight = 1.0;
        next.high_weight *= 0.5;
    } else {
        next.high = found;
        next.high_weight = 1.0;
        next.low_weight *= 0.5;
    }
    next.count++;
    if next.count < 10u && may_dip(next.low, next.high) {
        return dip_place(next);
    }
    // Even roots: the extremum equals the level to rounding.
    if abs(next.third.value) <= 3e-7 * search.size {
        next.mode = FOUND;
        next.t = next.third.t;
        next.touching = true;
        return next;
    }
    return nothing(next);
}

// Root between two samples of opposite sign, by Newton's method within the bracket of their signs, and bisection where that
// is slow. A sign change over which |f| does not shrink with the bracket is a pole or a jump and not found. `larger` is a
// value of |f - level| beside them.
fn search_crossing(a: Sample, b: Sample, larger: f32) -> Search {
    let size = max(larger, max(abs(a.value), abs(b.value)));
    let t = mix(a.t, b.t, clamp(a.value / (a.value - b.value), 0.001, 0.999));
    return Search(CROSSING, 0u, t, a, b, a, 1.0, 1.0, size, b.t - a.t, false);
}

fn searched_crossing(search: Search, found: Sample) -> Search {
    if !found.valid {
        return nothing(search);
    }
    var next = search;
    let on_near_side = !opposite(search.low, found);
    if on_near_side {
        next.low = found;
    } else {
        next.high = found;
    }
    next.count++;
    let before = search.high.t - search.low.t;
    let width = next.high.t - next.low.t;
    let place = found.t - found.value / select(found.slope, 1e-37, found.slope == 0.0);
    let inside = (place >= next.low.t) & (place <= next.high.t);
    let shrinks = abs(found.value) < 0.25 * search.size;
    // so near that what is left is the square of a small part of the first bracket
    if shrinks & inside & (abs(place - found.t) <= 0.001 * search.first) {
        next.mode = FOUND;
        next.t = place;
        return next;
    }
    let tolerance = 2.4e-7 * max(abs(next.low.t), abs(next.high.t)) + 1e-30;
    if next.count >= 48u || width <= 2.0 * tolerance {
        return crossing_end(next);
    }
    let least = min(abs(search.low.value), abs(search.high.value));
    let fast = (width <= 0.5 * before) | (abs(found.value) <= 0.25 * least);
    // a little further, so that the bracket closes
    let beyond = place + select(-tolerance, tolerance, on_near_side);
    let within = (beyond > next.low.t) & (beyond < next.high.t);
    next.t = select(0.5 * (next.low.t + next.high.t), beyond, fast & within);
    return next;
}

// The end that is nearer to the level, unless that is a pole or a jump.
fn crossing_end(search: Search) -> Search {
    var next = search;
    let low = abs(search.low.value);
    let high = abs(search.high.value);
    let after = select(max(low, high), 0.0, min(low, high) == 0.0);
    next.mode = select(NOTHING, FOUND, after < 0.25 * search.size);
    next.t = select(search.high.t, search.low.t, low <= high);
    return next;
}

fn step_count(extent: f32, steps: u32) -> f32 {
    let diagonal = 2.0 * length(settings.box);
    return clamp(ceil(extent / max(diagonal, 1e-20) * f32(steps)), 2.0, max(f32(steps), 2.0));
}

// ---- Light ---------------------------------------------------------------------------------------------------

fn light_direction() -> vec3f {
    return light_toward(settings.camera, settings.light_yaw, settings.light_pitch, settings.light_from);
}

fn lamp() -> Lamp {
    return Lamp(light_direction(), settings.light_strength, settings.background, settings.ambient);
}

// First-order distance to the surface, world units: |f - level| / |∇f|; large where that is not known.
fn distance_estimate(jet: vec4f) -> f32 {
    let size = length3_safe(jet.xyz);
    if is_nan(jet.w) || is_nan(jet.x + jet.y + jet.z) || size <= 0.0 {
        return LARGEST;
    }
    return min(abs(jet.w - settings.level) / size, LARGEST);
}

// The surface where a ray meets it.
struct Spot {
    n: vec3f,       // towards the eye
    side: f32,      // sign of f - level on the side of the eye
    outer: bool,
}

// Where a hit's surface is looked at. Where the ray only touches the level the gradient vanishes; just before, it has the
// right direction.
fn spot_point(path: Path, hit: Hit) -> vec3f {
    let step = path.extent / path.count;
    let t = hit.t - select(0.0, 0.02 * step, hit.touching);
    return path.ray.origin + t * path.ray.direction;
}

fn spot_at(jet: vec4f, direction: vec3f, touching: bool) -> Spot {
    let gradient = direction_or(jet.xyz, -direction);
    let toward_eye = dot(gradient, direction) <= 0.0;
    let n = select(-gradient, gradient, toward_eye);
    return Spot(n, select(-1.0, 1.0, toward_eye), toward_eye || touching);
}

// Height above the surface of the k-th point from which its openness is judged, k = 1 … 3.
fn open_height(k: u32) -> f32 {
    return 0.22 * min(settings.box.x, min(settings.box.y, settings.box.z)) * f32(k) / 3.0;
}

// What a point above the surface hides of the sky: the distance to the surface there compared with the height
// (A. Evans, "Fast approximations for global illumination on dynamic scenes", 2006).
fn hidden_sky(jet: vec4f, side: f32, k: u32) -> f32 {
    let same_side = (jet.w - settings.level) * side > 0.0;
    let free = select(0.0, min(distance_estimate(jet) / open_height(k), 1.0), same_side);
    return (1.0 - free) * exp2(-f32(k));
}

// What light needs of f and its gradient.
struct Light {
    jet: vec4f,    // at the base
    spot: Spot,    // what that makes of a hit
    closed: f32,   // sum of `hidden_sky`; 0 on the ground
}

// Looks at the surface, and from three points above it, or at the point of the box that is nearest to the ground, in one
// loop: drivers copy a function to where it is called, and f may be long.
fn look_at_base(base: vec3f, direction: vec3f, hit: Hit, on_ground: bool) -> Light {
    var light = Light();
    if !(hit.found || on_ground) {
        return light;
    }
    var p = base;
    for (var k = view.zero; k < 4u; k++) {
        if k == 0u || all(abs(p - settings.center) <= settings.box) {
            let jet = field_grad(p);
            if k == 0u {
                light.jet = jet;
                light.spot = spot_at(jet, direction, hit.touching);
            } else {
                light.closed += hidden_sky(jet, light.spot.side, k);
            }
        }
        if !hit.found {
            break;
        }
        p = base + open_height(k + 1u) * light.spot.n;
    }
    return light;
}

// The surface at a hit; `closed` is the sum of `hidden_sky`.
fn surface_colour(spot: Spot, direction: vec3f, closed: f32) -> vec3f {
    let open = 1.0 - settings.occlusion * clamp(closed, 0.0, 1.0);
    return lit_colour(select(settings.inside, settings.outside, spot.outer), spot.n, -direction, open, lamp());
}

// ---- The box -------------------------------------------------------------------------------------------------

// A point of a face of the box, as a ray sees it.
struct Face {
    p: vec3f,
    n: vec3f,
    t: f32,  // distance along the ray
    drawn: bool,
}

// The far face that a ray meets (`behind`), or the near one. The far one is hidden by the surface.
fn face_of(ray: Ray, span: vec2f, behind: bool, hidden: bool) -> Face {
    let t = select(span.x, span.y, behind);
    let p = ray.origin + t * ray.direction;
    let drawn = span.y > max(span.x, 0.0) && t > 0.0 && !(behind && hidden);
    return Face(p, box_normal(p, settings.center, settings.box), t, drawn);
}

// f on a face.
struct Trace {
    value: f32,    // f - level
    flat: vec3f,   // gradient in the face
    slope: f32,    // length of that; 0 where it is not known
    rate: f32,     // change of value per pixel across the lines
    line: f32,     // coverage by the line of the level, if it is one
}

fn trace_on(face: Face, value: f32, gradient: vec3f, sight: Sight) -> Trace {
    let flat = gradient - face.n * dot(gradient, face.n);
    let slope = length3_safe(flat);
    if !is_finite(slope) || slope <= 0.0 {
        return Trace(value, flat, 0.0, 0.0, 0.0);
    }
    let rate = screen_rate(sight, face.t, face.n, flat);
    let line = line_coverage(pixels_away(abs(value), rate), 2.0 * settings.isoline_width, sample_window());
    return Trace(value, flat, slope, rate, line);
}

// Where one Newton step ends.
fn newton_point(face: Face, trace: Trace) -> vec3f {
    return face.p - trace.flat / trace.slope * (trace.value / trace.slope);
}

// Tells a zero from a pole by f at the end of one Newton step: near a zero of order n that multiplies the value by
// (1 - 1/n)^n < 1/e, near a pole of order n by (1 + 1/n)^-n > 1/e.
fn is_zero_there(jet: vec4f, value: f32) -> bool {
    let next = jet.w - settings.level;
    return is_finite(next) && abs(next) <= 0.36787944 * abs(value) + 1e-6 * abs(settings.level);
}

// Lines and tint on a face. `behind` tells the walls behind from those in front, `crossed` whether the level's line is one.
fn wall_on(trace: Trace, undefined: bool, crossed: bool, pixel: vec2f, behind: bool) -> Layer {
    let window = sample_window();
    if undefined {
        let opacity = select(0.12, 0.30, behind);
        return Layer(vec3f(0.45), opacity * hatch(pixel, 1.0, 7.0, 0.3, window));
    }
    let side = select(settings.outside, settings.inside, trace.value < 0.0);
    var wall = Layer(vec3f(1.0), 0.0);
    if behind {
        wall = Layer(mix(side, vec3f(1.0), 0.5), 0.22);
    }
    if trace.slope <= 0.0 {
        return wall;
    }
    if behind && settings.isoline_spacing > 0.0 {
        wall = layer_over(Layer(mix(side, INK, 0.45), 0.5 * family_coverage(trace.value, trace.rate, window)), wall);
    }
    if crossed {
        wall = layer_over(Layer(INK, trace.line * select(0.55, 0.85, behind)), wall);
    }
    return wall;
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
fn over_box(under: vec4f, sight: Sight, span: vec2f, hidden: bool, pixel: vec2f) -> vec4f {
    var colour = under;
    for (var k = view.zero; k < 2u; k++) {
        let behind = k == 0u;
        let face = face_of(sight.ray, span, behind, hidden);
        if face.drawn {
            colour = over_wall(colour, face, sight, pixel, behind);
        }
    }
    return colour;
}

// A face of the box, over what lies behind it.
fn over_wall(under: vec4f, face: Face, sight: Sight, pixel: vec2f, behind: bool) -> vec4f {
    var trace: Trace;
    var undefined = false;
    var crossed = false;
    var p = face.p;
    // First at the face, and where the line of the level may be there, at the end of a Newton step.
    for (var k = view.zero; k < 2u; k++) {
        let jet = field_grad(p);
        if k > 0u {
            crossed = is_zero_there(jet, trace.value);
            break;
        }
        undefined = is_nan(jet.w);
        let value = clamp(jet.w - settings.level, -LARGEST, LARGEST);
        trace = trace_on(face, value, jet.xyz, sight);
        if undefined || !(trace.line > 0.0) {
            break;
        }
        p = newton_point(face, trace);
    }
    let wall = wall_on(trace, undefined, crossed, pixel, behind);
    let edge = edge_layer(sight, face.t, face.n, settings.center, settings.box, settings.edge_width, behind);
    return layer_on(layer_on(under, Layer(wall.colour, wall.opacity * settings.wall_opacity)), edge);
}

// ---- Ground and sky ------------------------------------------------------------------------------------------

// The point of the box's floor, or the box, that is nearest to a point of the ground.
fn nearest_in_box(p: vec3f) -> vec3f {
    return clamp(p, settings.center - settings.box, settings.center + settings.box);
}

// Light left at a point of the ground by the surface above it: the estimated distance to the surface from the
// nearest point of the box, where `jet` is taken, and on from there.
fn ground_openness(p: vec3f, jet: vec4f) -> f32 {
    let reach = 0.30 * length(settings.box.xy);
    let aside = distance(p, nearest_in_box(p));
    let away = length(vec2f(min(distance_estimate(jet), 1e9), 2.0 * aside));
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
    return settings.shadow > 0.0 && ground_distance(p, settings.center, settings.box) < 8.0;
}

fn lit_ground(p: vec3f, jet: vec4f, direction: vec3f, shadowed: bool) -> vec3f {
    let light = ground_openness(p, jet) * (1.0 - settings.shadow * select(0.0, 0.55, shadowed));
    return ground_colour(p, direction, light, settings.center, settings.box, settings.background);
}

// Behind all else: the sky, one colour, or nothing.
fn sky_behind(direction: vec3f) -> vec4f {
    let colour = select(settings.background, sky_at(direction, settings.background), settings.backdrop == 0u);
    return select(vec4f(colour, 1.0), vec4f(), settings.backdrop == 2u);
}

// ---- The picture ---------------------------------------------------------------------------------------------

fn shade(pixel: vec2f) -> vec4f {
    let sight = sight_at(pixel, settings.camera, settings.center, settings.box);
    let ray = sight.ray;
    let span = box_span(ray.origin, ray.direction, settings.center, settings.box);
    let ground = select(0.0, ground_hit(ray, settings.center, settings.box), settings.backdrop == 0u);
    let ground_point = ray.origin + ground * ray.direction;
    // The eye's path, and then, where it ends on the ground, the light's. Drivers copy a function to where it is
    // called; the loop makes that one place.
    let seen = path_within(ray, span, settings.steps);
    var path = seen;
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
    let base = select(nearest_in_box(ground_point), spot_point(seen, hit), hit.found);
    let light = look_at_base(base, ray.direction, hit, ground > 0.0);
    var colour: vec4f;
    if hit.found {
        colour = vec4f(surface_colour(light.spot, ray.direction, light.closed), 1.0);
    } else if ground > 0.0 {
        colour = vec4f(lit_ground(ground_point, light.jet, ray.direction, shadowed), 1.0);
    } else {
        colour = sky_behind(ray.direction);
    }
    colour = over_box(colour, sight, span, hit.found, pixel);
    return vec4f(clamp(colour.rgb, vec3f(0.0), vec3f(1.0)), colour.a);
}
