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

struct Sample {
    k: f32,
    value: f32,
    slope: f32,
}

struct Search {
    state: u32,
    rounds: u32,
    k: f32,
    low: Sample,
    high: Sample,
    size: f32,
    weight: f32,
}

const SEARCH_TOUCHED: u32 = 6u;
const SEARCH_EDGED: u32 = 7u;

fn first_turn() -> u32 { return 0u; }
fn is_tame() -> bool { return false; }
fn bends_little() -> bool { return false; }
fn is_undefined(x: f32) -> bool { return false; }
fn turn_size(stride: vec3f) -> f32 { return 0.0; }
fn may_hold_turn(u: f32, w: f32, size: f32) -> bool { return false; }
fn is_searching(search: Search) -> bool { return false; }
fn has_met(search: Search) -> bool { return false; }
fn sample_of(k: f32, value: f32, level: f32) -> Sample { return Sample(); }
fn opposite(a: Sample, b: Sample) -> bool { return false; }
fn no_search() -> Search { return Search(); }
fn search_edge(valid: Sample, bad: f32) -> Search { return Search(); }
fn search_before_edge(ended: Search) -> Search { return Search(); }
fn search_turn(k: f32, low: f32, high: f32, size: f32) -> Search { return Search(); }
fn search_root(a: Sample, b: Sample, size: f32) -> Search { return Search(); }
fn search_on(search: Search, jet: vec2f, level: f32, count: f32, grain: f32) -> Search { return Search(); }

struct Hit {
    k: f32,          // where, in steps of the path
    t: f32,          // and in world units from its beginning, for those who measure depths
    found: bool,
    touching: bool,  // the ray touches the level without crossing it
}

const NO_HIT: Hit = Hit(0.0, 0.0, false, false);

// The part of a ray inside of the box, from its entry on, so that f32 resolves it wherever the ray begins: origin + k stride
// for k from 0 to count.
struct Path {
    origin: vec3f,
    stride: vec3f,
    count: f32,  // of steps; 0 where the ray misses the box
}

// `span` is from `box_span`; `steps` are for the diagonal of the box.
fn path_within(ray: Ray, span: vec2f, steps: u32) -> Path {
    let enter = max(span.x, 0.0);
    let extent = span.y - enter;
    if !(extent > 0.0) {
        return Path(ray.origin, ray.direction, 0.0);
    }
    let count = step_count(extent, steps);
    return Path(ray.origin + enter * ray.direction, extent / count * ray.direction, count);
}

fn step_count(extent: f32, steps: u32) -> f32 {
    let diagonal = 2.0 * length(settings.box);
    return clamp(ceil(extent / max(diagonal, 1e-20) * f32(steps)), 2.0, max(f32(steps), 2.0));
}

// The end of what has been walked over.
struct Walk {
    k: f32,       // number of the next sample
    value: f32,   // f - level at the last one; NaN where it is undefined
    below: bool,  // whether that is negative; not used where f bends little
    half: f32,    // f - level is between 0 and twice this at the next sample, unless something is to be searched; not used
                  // where f bends little
}

// The first hit on a path, to about the square of `grain`, in steps. The inner loop only walks, by values alone, to where f
// changes its sign or, near the level, comes no nearer, so that rays side by side walk together to where each has something
// to search, and then search together, with slopes. Most of a frame are its steps: they take few operations.
fn march(path: Path, grain: f32) -> Hit {
    if !(path.count > 0.0) {
        return NO_HIT;
    }
    let small = turn_size(path.stride);
    var walk = walk_begun();
    // ends: each turn goes at least one step on
    while walk.k <= path.count {
        var value: f32;
        // ends: each turn goes one step on
        loop {
            value = field(path.origin + walk.k * path.stride) - settings.level;
            if !goes_on(walk, value, path.count, small) {
                break;
            }
            walk = walk_on(walk, value);
        }
        var search = search_step(walk, value, path.count, small);
        walk = walk_from(walk, value);
        // ends: a search takes 12 samples and another 48 at most
        while is_searching(search) {
            let jet = field_ray(path.origin, path.stride, search.k);
            search = search_on(search, jet, settings.level, path.count, grain);
            if !is_tame() && search.state == SEARCH_EDGED {
                search = search_before_edge(search);
            }
        }
        if has_met(search) {
            return Hit(search.k, search.k * length(path.stride), true, search.state == SEARCH_TOUCHED);
        }
    }
    return NO_HIT;
}

// Before the first sample: as if f had come from afar, above the level. Where it is below there, the walk stops once.
fn walk_begun() -> Walk {
    return Walk(0.0, select(0.0, LARGEST, bends_little()), false, 0.0);
}

// Whether a walk goes on over a sample: f is on the same side there, nothing has been passed, and it is not the last one.
fn goes_on(walk: Walk, value: f32, count: f32, small: f32) -> bool {
    // by one comparison: it takes as long as several operations, and the loop waits for it
    if bends_little() {
        return (walk.value * value > small * small) & (walk.k < count);
    }
    return (abs(value - walk.half) < size_of_half(walk)) & (walk.k < count);
}

// Over a sample on the same side. Else let u, v, w be |f - level| at the one before, there and at the next one: v is an extremum
// where it is more than neither of the others, and then may be beyond the level between the samples where it is not more
// than half of their second difference u - 2 v + w. Two straight lines go beyond v by that at most, a parabola by an
// eighth of the difference.
fn walk_on(walk: Walk, value: f32) -> Walk {
    return Walk(walk.k + 1.0, value, walk.below, 2.0 * value - 0.5 * walk.value);
}

// Negative where the last sample came nearer to the level by more than three quarters.
fn size_of_half(walk: Walk) -> f32 {
    return select(walk.half, -walk.half, walk.below);
}

// Whether what a walk has come to, `value`, is where its last sample is such an extremum.
fn turns(walk: Walk, value: f32) -> bool {
    let last = abs(walk.value);
    let half = size_of_half(walk);
    return abs(value) >= last && abs(value) - half >= half && half <= 1.5 * last;
}

// Over a sample in whose step nothing has been found.
fn walk_from(walk: Walk, value: f32) -> Walk {
    let below = value < 0.0;
    if is_undefined(value) {
        return Walk(walk.k + 1.0, value, false, 0.0);
    }
    if is_lost(walk) || below != walk.below || walk.k == 0.0 {
        return Walk(walk.k + 1.0, value, below, 1.5 * value);
    }
    return walk_on(walk, value);
}

// Whether f is undefined where a walk is.
fn is_lost(walk: Walk) -> bool {
    return is_nan(walk.value);
}

// The sample where a walk ended.
fn last_of(walk: Walk) -> Sample {
    return sample_of(walk.k - 1.0, walk.value, 0.0);
}

// What is to be searched where a walk ends.
fn search_step(walk: Walk, value: f32, count: f32, small: f32) -> Search {
    let near = last_of(walk);
    let far = sample_of(walk.k, value, 0.0);
    if bends_little() {
        return search_known_step(near, far, small);
    }
    let is_valid = !is_nan(value);
    if walk.k == 0.0 || (is_lost(walk) && !is_valid) {
        return no_search();
    }
    if is_lost(walk) {
        return search_edge(far, near.k);
    }
    if !is_valid {
        return search_edge(near, far.k);
    }
    if opposite(near, far) {
        return search_root(near, far, 0.0);
    }
    if turns(walk, value) {
        return search_turn(near.k, max(near.k - 1.0, 0.0), far.k, 0.0);
    }
    if walk.k >= count && 3.0 * abs(value) <= abs(walk.value) {
        return search_turn(far.k, near.k, far.k, 0.0);
    }
    return no_search();
}

// The same where f bends little.
fn search_known_step(near: Sample, far: Sample, small: f32) -> Search {
    if far.k == 0.0 {
        return no_search();
    }
    if opposite(near, far) {
        return search_root(near, far, 0.0);
    }
    if may_hold_turn(near.value, far.value, small) {
        return search_turn(far.k, near.k, far.k, 0.0);
    }
    return no_search();
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
    let away = abs(jet.w - settings.level) / length3_safe(jet.xyz);
    return select(LARGEST, away, away < LARGEST);
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
    return path.origin + (hit.k - select(0.0, 0.02, hit.touching)) * path.stride;
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
    for (var k = first_turn(); k < 4u; k++) {
        let jet = field_grad(p);
        if k == 0u {
            light.jet = jet;
            if !hit.found {
                break;
            }
            light.spot = spot_at(jet, direction, hit.touching);
        } else {
            let is_inside = all(abs(p - settings.center) <= settings.box);
            light.closed += select(0.0, hidden_sky(jet, light.spot.side, k), is_inside);
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
}

// f on a face.
struct Trace {
    value: f32,    // f - level
    flat: vec3f,   // gradient in the face
    rate: f32,     // change of value per pixel across the lines; not above 0 where that is not known
    line: f32,     // coverage by the line of the level, if it is one
}

fn trace_on(face: Face, value: f32, gradient: vec3f, sight: Sight) -> Trace {
    let flat = gradient - face.n * dot(gradient, face.n);
    let rate = screen_rate(sight, face.t, face.n, flat);
    let line = line_coverage(pixels_away(abs(value), rate), 2.0 * settings.isoline_width, sample_window());
    return Trace(value, flat, rate, select(0.0, line, rate > 0.0));
}

// Where one Newton step ends.
fn newton_point(face: Face, trace: Trace) -> vec3f {
    let slope = length3_safe(trace.flat);
    return face.p - trace.flat / slope * (trace.value / slope);
}

// Tells a zero from a pole by f at the end of one Newton step: near a zero of order n that multiplies the value by
// (1 - 1/n)^n < 1/e, near a pole of order n by (1 + 1/n)^-n > 1/e.
fn is_zero_there(jet: vec4f, value: f32) -> bool {
    let next = jet.w - settings.level;
    return is_finite(next) && abs(next) <= 0.36787944 * abs(value) + 1e-6 * abs(settings.level);
}

// Lines and tint on a face, over what lies behind it. `behind` tells the walls behind from those in front, `crossed`
// whether the level's line is one.
fn wall_on(under: vec4f, trace: Trace, undefined: bool, crossed: bool, pixel: vec2f, behind: bool) -> vec4f {
    let window = sample_window();
    if undefined {
        let opacity = select(0.12, 0.30, behind);
        return layer_on(under, Layer(vec3f(0.45), opacity * hatch(pixel, 1.0, 7.0, 0.3, window)));
    }
    let side = select(settings.outside, settings.inside, trace.value < 0.0);
    var wall = under;
    if behind {
        wall = layer_on(wall, Layer(mix(side, vec3f(1.0), 0.5), 0.22));
        if settings.isoline_spacing > 0.0 && trace.rate > 0.0 {
            wall = layer_on(wall, Layer(mix(side, INK, 0.45), 0.5 * family_coverage(trace.value, trace.rate, window)));
        }
    }
    if crossed {
        wall = layer_on(wall, Layer(INK, trace.line * select(0.55, 0.85, behind)));
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
            covered = max(covered, sparse * isolines(u, lines, window));
        }
        // the lines of wider families are lines of this one
        if lines <= 0.10 {
            break;
        }
        spacing *= 5.0;
    }
    return covered;
}

// Coverage by lines at the integers of u, of which there are `lines` a pixel. Lines that are so thin that where they are
// drawn no two of them share a pixel are told from the nearest one alone.
fn isolines(u: f32, lines: f32, window: f32) -> f32 {
    if (settings.isoline_width + window) * 0.28 < 1.0 {
        return line_coverage(pixels_away(abs(u - floor(u + 0.5)), lines), settings.isoline_width, window);
    }
    return line_train(u, lines * settings.isoline_width, lines * window);
}

// The faces of the box that the ray meets, over what lies behind them. The far one is hidden by the surface.
fn over_box(under: vec4f, sight: Sight, span: vec2f, hidden: bool, pixel: vec2f) -> vec4f {
    var colour = under;
    if span.y <= max(span.x, 0.0) {
        return colour;
    }
    for (var k = first_turn(); k < 2u; k++) {
        let behind = k == 0u;
        let t = select(span.x, span.y, behind);
        if t > 0.0 && !(behind && hidden) {
            let p = sight.ray.origin + t * sight.ray.direction;
            colour = over_wall(colour, Face(p, box_normal(p, settings.center, settings.box), t), sight, pixel, behind);
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
    for (var k = first_turn(); k < 2u; k++) {
        let jet = field_grad(p);
        if k > 0u {
            crossed = is_zero_there(jet, trace.value);
            break;
        }
        undefined = is_undefined(jet.w);
        let value = clamp(jet.w - settings.level, -LARGEST, LARGEST);
        trace = trace_on(face, value, jet.xyz, sight);
        if undefined || !(trace.line > 0.0) {
            break;
        }
        p = newton_point(face, trace);
    }
    let wall = mix(under, wall_on(under, trace, undefined, crossed, pixel, behind), settings.wall_opacity);
    return layer_on(wall, edge_layer(sight, face.t, face.n, settings.center, settings.box, settings.edge_width, behind));
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
    var path = path_within(ray, span, settings.steps);
    var base = nearest_in_box(ground_point);
    var hit = NO_HIT;
    var shadowed = false;
    for (var leg = first_turn(); leg < 2u; leg++) {
        // for a shadow it is enough that there is a surface
        let found = march(path, select(1e-3, 0.5, leg > 0u));
        if leg > 0u {
            shadowed = found.found;
            break;
        }
        hit = found;
        if hit.found {
            base = spot_point(path, hit);
            break;
        }
        if ground <= 0.0 || !may_be_shadowed(ground_point) {
            break;
        }
        path = shadow_path(ground_point);
    }
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
    // opaque where nothing else is asked for: then no alpha is computed
    return vec4f(clamp(colour.rgb, vec3f(0.0), vec3f(1.0)), select(1.0, colour.a, settings.backdrop == 2u));
}
