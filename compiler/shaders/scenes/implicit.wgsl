// implicit: the curve f = 0 of a real function of the plane, as a line of constant width, and the sides of it by colour.
//
// How far the curve is follows from f, its gradient and its Hessian, along the gradient. With N = f/f′ and h = f f″/f′² the
// quadratic model has its root at 2 N / (1 + √(1 - 2 h)) for h ≤ 1/2; where f is like dᵐ, h is 1 - 1/m, so that m = 1/(1 - h)
// tells the multiplicity (E. Schröder 1870), and the root is at m N; Halley's method for f^(1/m) gives
// 2 m N / (1 + m (1 - h)), which is exact to third order at a root of multiplicity m.
//
// Where a sample may hold a zero and the model does not settle it, that is shown: curves that f touches without a change of
// sign (m even) have another colour, and where gradient and Hessian do not explain the value (a bend that is finer than the
// pixel, no multiplicity, no derivatives) there is a hatch. Settled means: the Newton-Kantorovich condition |f| ‖H‖ ≤ |∇f|²/2,
// under which there is a zero near and only one (L. Kantorovich 1948), both signs inside of the sample by the quadratic
// model, or a whole odd m.
//
// The model of a function that is made of branches (max, min, |x|, conditions) is that of one of them, whose zero may lie where
// another holds, as beyond a sharp corner. Such a function is asked again at the zero of the model, if that is near enough to be
// seen: where it still has its sign there, the curve is as much farther as value and slope there tell, and so on.
// Where a branch of small slope holds, nothing is known of a nearer zero of a steeper one: beside a corner such a line is thinner
// on that side.
//
// An undefined value (NaN) is a quiet grey hatch, an infinity the colour of its side with a hatch of the other slope.
// A constant is the colour of its side; where f and all its derivatives are 0 nothing is known about the curve.

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
    line_width: f32,
    fill: f32,
    above: vec3f,
    below: vec3f,
    ink: vec3f,
    touch: vec3f,
    doubt: vec3f,
    backdrop: u32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

struct Jet2 {
    value: f32,
    dx: f32,
    dy: f32,
    dxx: f32,
    dxy: f32,
    dyy: f32,
    branches: bool,
}

// f with its first and second derivatives at the offset from the view's centre, and whether these may jump
fn field_jet2(offset: vec2f) -> Jet2 { return Jet2(); }

fn is_nan(x: f32) -> bool { return false; }
fn is_finite(x: f32) -> bool { return false; }
fn magnify_tiny(x: f32) -> f32 { return 0.0; }
fn length2_safe(v: vec2f) -> f32 { return 0.0; }
fn offset_from_pixel(pixel: vec2f) -> vec2f { return vec2f(); }
fn sample_window() -> f32 { return 0.0; }
fn undefined_colour(pixel: vec2f) -> vec3f { return vec3f(); }
fn infinite_colour(pixel: vec2f, colour: vec3f) -> vec3f { return vec3f(); }
fn line_coverage(offset: f32, width: f32, window: f32) -> f32 { return 0.0; }
fn hatch(pixel: vec2f, slope: f32, period: f32, duty: f32, window: f32) -> f32 { return 0.0; }

// The second-order model of f around a sample, in pixels, turned so that f ≥ 0 at the sample, and scaled so that nothing
// overflows or underflows that matters.
struct Model {
    value: f32,     // at least 0
    slope: f32,     // length of the gradient, along which the axis points
    along: f32,     // second derivative along the gradient
    across: f32,    // second derivative across it
    mixed: f32,
    bend: Bend,
    known: bool,    // whether second derivatives are numbers
}

// The Hessian of f, turned as in the model.
struct Bend {
    least: f32,  // the lesser eigenvalue: how fast f bends towards 0 where it does so most
    norm: f32,   // the spectral norm
}

// What is known of the nearest zero.
struct Verdict {
    distance: f32,  // pixels
    touches: bool,  // f has one sign on both sides of it
    settled: bool,
    ahead: bool,    // it is where the gradient points, or the other way
}

const FAR: f32 = 1e9;

// How often a function of branches is asked on the way to a zero, at most.
const LOOKS: u32 = 6u;

// A root of multiplicity m is told from others where 1/(1 - h) is so near to a whole number, relatively.
const WHOLE: f32 = 0.2;
const MOST_MULTIPLE: f32 = 8.0;

fn scaled_by(jet: Jet2, factor: f32) -> Jet2 {
    return Jet2(
        jet.value * factor,
        jet.dx * factor,
        jet.dy * factor,
        jet.dxx * factor,
        jet.dxy * factor,
        jet.dyy * factor,
        jet.branches,
    );
}

// The derivatives per pixel, all as small as the largest allows.
fn per_pixel(jet: Jet2) -> Jet2 {
    let h = view.pixel;
    var out = Jet2(jet.value, jet.dx * h, jet.dy * h, jet.dxx * h * h, jet.dxy * h * h, jet.dyy * h * h, false);
    if !is_finite(abs(out.dxx) + abs(out.dxy) + abs(out.dyy)) {
        out = Jet2(out.value, out.dx, out.dy, 0.0, 0.0, 0.0, false);
    }
    var size = max(abs(out.value), max(abs(out.dx), abs(out.dy)));
    size = max(size, max(abs(out.dxx), max(abs(out.dxy), abs(out.dyy))));
    if size < 1e-18 {
        out = Jet2(
            magnify_tiny(out.value),
            magnify_tiny(out.dx),
            magnify_tiny(out.dy),
            magnify_tiny(out.dxx),
            magnify_tiny(out.dxy),
            magnify_tiny(out.dyy),
            false,
        );
        size = magnify_tiny(size);
    }
    if size > 1e18 {
        out = scaled_by(out, 1e-18);
        size *= 1e-18;
    }
    return scaled_by(out, 1.0 / max(size, 1e-30));
}

fn bend_of(unit: Jet2, side: f32) -> Bend {
    let middle = 0.5 * side * (unit.dxx + unit.dyy);
    let spread = length(vec2f(0.5 * (unit.dxx - unit.dyy), unit.dxy));
    return Bend(middle - spread, abs(middle) + spread);
}

// The model of f, of its derivatives per pixel.
fn model_of(jet: Jet2, unit: Jet2, slope: f32, side: f32, bend: Bend) -> Model {
    var n = vec2f(1.0, 0.0);
    if slope > 0.0 {
        n = vec2f(unit.dx, unit.dy) / slope;
    }
    let t = vec2f(-n.y, n.x);
    let to_n = vec2f(unit.dxx * n.x + unit.dxy * n.y, unit.dxy * n.x + unit.dyy * n.y);
    let to_t = vec2f(unit.dxx * t.x + unit.dxy * t.y, unit.dxy * t.x + unit.dyy * t.y);
    let known = is_finite(jet.dxx) && is_finite(jet.dxy) && is_finite(jet.dyy);
    return Model(abs(unit.value), slope, side * dot(n, to_n), side * dot(t, to_t), side * dot(n, to_t), bend, known);
}

// Whether f bends in one direction only: a family of parallel curves, such as a multiple one.
fn is_parallel(m: Model) -> bool {
    return max(abs(m.across), abs(m.mixed)) <= 0.25 * abs(m.along);
}

// Whether the quadratic model has two parallel zeros within `reach`: what is finer is not drawn.
fn is_crowded(m: Model, h: f32, reach: f32) -> bool {
    let root = m.slope * (1.0 + sqrt(max(1.0 - 2.0 * h, 0.0)));
    return is_parallel(m) && h <= 0.5 && root <= abs(m.along) * reach;
}

// Distance along the gradient where second derivatives count. `multiple` is 1/(1 - h), or 0 where h ≥ 1.
fn distance_along(m: Model, newton: f32, h: f32, multiple: f32) -> f32 {
    if h > 0.5 || (h > 0.44 && is_parallel(m)) {
        let order = max(round(multiple), 2.0);
        return select(2.0 * order * newton / (1.0 + order * (1.0 - h)), FAR, multiple <= 0.0);
    }
    return 2.0 * newton / (1.0 + sqrt(1.0 - 2.0 * h));
}

// Where the gradient says nothing: the value over the bend towards 0, if there is one.
fn critical(m: Model, reach: f32) -> Verdict {
    let bend = m.bend.least;
    if bend < 0.0 {
        return Verdict(sqrt(2.0 * m.value / -bend), false, true, false);
    }
    if m.value == 0.0 {
        return Verdict(0.0, bend > 0.0, m.bend.norm > 0.0, false);
    }
    return Verdict(FAR, false, m.value > 0.5 * reach * reach * m.bend.norm, false);
}

fn verdict_of(m: Model) -> Verdict {
    let reach = 0.7071067811865476 * sample_window();
    if m.slope * m.slope <= 1e-12 * m.value * m.bend.norm || m.slope == 0.0 {
        return critical(m, reach);
    }
    let newton = m.value / m.slope;
    let h = newton * (m.along / m.slope);
    let multiple = select(0.0, 1.0 / (1.0 - h), h < 1.0);
    let order = round(multiple);
    let distance = min(distance_along(m, newton, h, multiple), FAR);
    let none_near = m.value > reach * m.slope + 0.5 * reach * reach * m.bend.norm;
    // with a little room for rounding, as it holds with equality along the bisectors of a node
    let simple = m.value * m.bend.norm <= 0.51 * m.slope * m.slope;
    let is_whole = h > 0.4 && order >= 2.0 && order <= MOST_MULTIPLE && abs(multiple - order) <= WHOLE * order;
    let touches = is_whole && distance < FAR && (u32(order) & 1u) == 0u && h > 0.44 && m.bend.least > -0.2 * m.bend.norm;
    if none_near {
        return Verdict(distance, touches, true, true);
    }
    if !m.known || (!is_whole && is_crowded(m, h, 1.0)) {
        return Verdict(distance, false, false, true);
    }
    if simple && !touches {
        return Verdict(distance, false, true, true);
    }
    let both_signs = m.bend.least < 0.0 && m.value <= -0.5 * m.bend.least * reach * reach;
    if both_signs {
        let aside = sqrt(2.0 * m.value / -m.bend.least);
        return Verdict(min(distance, aside), false, true, distance <= aside);
    }
    // 1/(1 - h) is -p at a pole of order p: f changes its sign there, but has no zero
    let pole = -1.0 / (1.0 - h);
    let is_pole = h > 1.0 && pole <= MOST_MULTIPLE && abs(pole - round(pole)) <= WHOLE * pole;
    return Verdict(distance, touches, is_whole || is_pole, true);
}

// The colour of a side on paper, or on nothing, with its opacity, by which it is multiplied.
fn side_colour(value: f32) -> vec4f {
    let paper = select(vec4f(0.93, 0.92, 0.89, 1.0), vec4f(), settings.backdrop == 1u);
    return mix(paper, vec4f(select(settings.below, settings.above, value > 0.0), 1.0), settings.fill);
}

// Both sides by their shares of the sample; on a curve that f touches there is one side.
fn fill_colour(value: f32, verdict: Verdict) -> vec4f {
    if value == 0.0 {
        return 0.5 * (side_colour(1.0) + side_colour(-1.0));
    }
    let share = clamp(verdict.distance / sample_window(), 0.0, 0.5) + 0.5;
    return mix(side_colour(-value), side_colour(value), select(share, 1.0, verdict.touches));
}

// Pixels from the middle of a sample to what is still seen in it.
fn reach_of_line() -> f32 {
    return 0.5 * max(settings.line_width + sample_window(), 1.4142135623730951 * sample_window());
}

// What a sample tells.
struct Sight {
    colour: vec4f,     // where no line is near: of the sample
    near: bool,
    value: f32,        // of f
    verdict: Verdict,
    to_zero: vec2f,    // from where f was asked to the zero of the model, world units
}

fn plain_sight(colour: vec4f) -> Sight {
    return Sight(colour, false, 0.0, Verdict(FAR, false, true, false), vec2f());
}

fn sight_of(jet: Jet2, pixel: vec2f) -> Sight {
    if !is_finite(jet.value) {
        if is_nan(jet.value) {
            return plain_sight(vec4f(undefined_colour(pixel), 1.0));
        }
        let side = side_colour(jet.value);
        return plain_sight(vec4f(infinite_colour(pixel, side.rgb), infinite_colour(pixel, side.aaa).x));
    }
    if !(is_finite(jet.dx) & is_finite(jet.dy)) {
        return plain_sight(doubtful(side_colour(jet.value), pixel));
    }
    let unit = per_pixel(jet);
    let side = select(1.0, -1.0, unit.value < 0.0);
    let slope = length(vec2f(unit.dx, unit.dy));
    let bend = bend_of(unit, side);
    // most samples are so far from any zero of the model that neither line nor other side reaches them
    let reach = reach_of_line();
    if abs(unit.value) > reach * (slope + 0.5 * reach * bend.norm) {
        return plain_sight(side_colour(jet.value));
    }
    var verdict = verdict_of(model_of(jet, unit, slope, side, bend));
    verdict.ahead = verdict.ahead & (verdict.distance < reach);
    let downhill = -side * vec2f(unit.dx, unit.dy) / max(slope, 1e-30);
    return Sight(vec4f(), true, jet.value, verdict, verdict.distance * view.pixel * downhill);
}

// What is seen after a look at f at the zero of the model.
fn looked_again(sight: Sight, there: Jet2) -> Sight {
    var next = sight;
    next.verdict.ahead = false;
    let known = is_finite(there.value) && is_finite(there.dx) && is_finite(there.dy);
    if !known || (there.value > 0.0) != (sight.value > 0.0) {
        return next;
    }
    let gradient = vec2f(there.dx, there.dy);
    let slope = max(length2_safe(gradient), 1e-37);
    let away = abs(there.value) / slope;
    let further = min(away / view.pixel, FAR);
    next.verdict.distance += further;
    // not where the rest is no more than can be seen, or all of it is out of sight
    next.verdict.ahead = (further > 0.05) & (next.verdict.distance < reach_of_line());
    next.to_zero = select(-away, away, there.value < 0.0) * (gradient / slope);
    return next;
}

fn colour_of(sight: Sight, pixel: vec2f) -> vec4f {
    if !sight.near {
        return sight.colour;
    }
    let verdict = sight.verdict;
    let line = line_coverage(verdict.distance, settings.line_width, sample_window());
    let fill = fill_colour(sight.value, verdict);
    if !verdict.settled {
        return doubtful(fill, pixel);
    }
    return mix(fill, vec4f(select(settings.ink, settings.touch, verdict.touches), 1.0), line);
}

// Where the curve may be, or not.
fn doubtful(colour: vec4f, pixel: vec2f) -> vec4f {
    return mix(colour, vec4f(settings.doubt, 1.0), 0.35 + 0.45 * hatch(pixel, 1.0, 4.0, 0.5, sample_window()));
}

fn shade(pixel: vec2f) -> vec4f {
    var at = offset_from_pixel(pixel);
    var sight = Sight();
    for (var look = 0u; look < LOOKS; look++) {
        // at one place, as drivers copy the formula to each
        let jet = field_jet2(at);
        if look == 0u {
            sight = sight_of(jet, pixel);
        } else {
            sight = looked_again(sight, jet);
        }
        if !(jet.branches & sight.verdict.ahead) {
            break;
        }
        at += sight.to_zero;
    }
    let seen = colour_of(sight, pixel);
    // opaque on paper, whatever was rounded
    return vec4f(seen.rgb, select(1.0, seen.a, settings.backdrop == 1u));
}
