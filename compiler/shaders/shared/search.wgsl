// Where f meets a level on a ray, between samples that are a step apart. Places on the ray are in steps of a march: it is
// origin + k stride.
//
// A search is told what to look for (`search_turn`, `search_edge`, `search_root`), says where it wants f and its slope
// (`k`, while `is_searching`), and is given them (`search_on`). A scene has one place that evaluates them, because drivers
// copy a function to where it is called, and f may be long; and what a search carries along is little, because every number
// of it takes a register from each ray of a GPU, walking or not.

// ---- What is known of f ---------------------------------------------------------------------------------------

// At least |f| and at least the norm of the matrix of second derivatives, everywhere in the scene's box; negative
// where nothing is known, the second one also where it would help no search. Shaders that are made for their settings are told
// (compiler/src/module/bounds.rs).
fn field_bounds() -> vec2f {
    return vec2f(-1.0);
}

// Whether f is known to be smooth in the box: then it is defined everywhere, and has no poles and no jumps.
fn is_tame() -> bool {
    return field_bounds().x >= 0.0;
}

// Whether x, a value of f in the box, says that f is undefined there.
fn is_undefined(x: f32) -> bool {
    return !is_tame() && is_nan(x);
}

// Whether f is tame and known to bend so little that values of samples tell of all extrema between them that reach a level.
fn bends_little() -> bool {
    return field_bounds().y >= 0.0;
}

// Where a loop of few turns begins that has the one place of something in it: at 0. Drivers copy functions to where they are
// called and loops once for each turn, and f may be long; so they must not know, unless f is short.
fn first_turn() -> u32 {
    return view.zero;
}

// A step between samples u and w of |f - level| has an extremum that reaches the level only if √u + √w is at most √(M/2), where
// f bends by no more than M in a step: at a distance s from it u is at most M s²/2, and w at most M (1 - s)²/2. Then the root
// of u w is at most M/8. This is that number, if f bends little; some is added for roundings.
fn turn_size(stride: vec3f) -> f32 {
    let bounds = field_bounds();
    return 0.1265 * bounds.y * dot(stride, stride) + 4e-6 * bounds.x;
}

// Whether a step may hold such an extremum.
fn may_hold_turn(u: f32, w: f32, size: f32) -> bool {
    return sqrt(abs(u)) + sqrt(abs(w)) <= 2.0 * sqrt(size);
}

// ---- Searches ------------------------------------------------------------------------------------------------

// f - level on the ray.
struct Sample {
    k: f32,
    value: f32,
    slope: f32,  // per step; 0 where it is not known
}

struct Search {
    state: u32,
    rounds: u32,   // samples that it has taken
    k: f32,        // where it wants the next one; of a hit, where that is
    low: Sample,   // the end of what is searched that is nearer to the eye; of an edge, the valid end
    high: Sample,  // the other end
    size: f32,     // greatest |f - level| of the samples that it began with; of an edge, f - level at the step's valid end
    weight: f32,   // of the slope at `low` against that at `high`; of an edge, where that end is; of a root, how wide the
                   // bracket was that it began with
}

// Looked for is which side of a sample an extremum is on, f at the other end of that side, an extremum, a root, where f
// ceases to be defined.
const SEARCH_TURN: u32 = 0u;
const SEARCH_ENDS: u32 = 1u;
const SEARCH_DIP: u32 = 2u;
const SEARCH_ROOT: u32 = 3u;
const SEARCH_EDGE: u32 = 4u;
// The search has ended: at a level that is crossed, or touched; at the edge of where f is defined, which is at `low`; at a pole or
// a jump between `low` and `high`; without anything.
const SEARCH_CROSSED: u32 = 5u;
const SEARCH_TOUCHED: u32 = 6u;
const SEARCH_EDGED: u32 = 7u;
const SEARCH_BROKEN: u32 = 8u;
const SEARCH_NOTHING: u32 = 9u;
// Values are kept within this, so that differences and ratios of them are finite.
const SEARCH_LARGEST: f32 = 1e34;

fn is_searching(search: Search) -> bool {
    return search.state <= SEARCH_EDGE;
}

fn has_met(search: Search) -> bool {
    return search.state == SEARCH_CROSSED || search.state == SEARCH_TOUCHED;
}

// A sample of which no slope is known.
fn sample_of(k: f32, value: f32, level: f32) -> Sample {
    return Sample(k, clamp(value - level, -SEARCH_LARGEST, SEARCH_LARGEST), 0.0);
}

// `jet` is f and its slope.
fn sample_with_slope(k: f32, jet: vec2f, level: f32) -> Sample {
    var sample = sample_of(k, jet.x, level);
    sample.slope = select(clamp(jet.y, -SEARCH_LARGEST, SEARCH_LARGEST), 0.0, is_undefined(jet.y));
    return sample;
}

fn opposite(a: Sample, b: Sample) -> bool {
    return (a.value < 0.0) != (b.value < 0.0);
}

fn no_search() -> Search {
    return search_ended(Search(), SEARCH_NOTHING);
}

fn search_ended(before: Search, state: u32) -> Search {
    var search = before;
    search.state = state;
    return search;
}

// Takes f and its slope at search.k, of a march of `count` steps. A level is met where Newton's step is no longer than the
// part `grain` of the bracket that the search began with.
fn search_on(search: Search, jet: vec2f, level: f32, count: f32, grain: f32) -> Search {
    let found = sample_with_slope(search.k, jet, level);
    if !is_tame() && search.state == SEARCH_EDGE {
        return searched_edge(search, found, !is_nan(jet.x));
    }
    if is_undefined(jet.x) {
        return search_ended(search, SEARCH_NOTHING);
    }
    switch search.state {
        case SEARCH_TURN: { return searched_turn(search, found); }
        case SEARCH_ENDS: { return searched_end(search, found); }
        case SEARCH_DIP: { return searched_dip(search, found); }
        default: { return searched_root(search, found, count, grain); }
    }
}

// ---- Where f ceases to be defined ----------------------------------------------------------------------------

// Between a sample and a place where f is not, by bisection.
fn search_edge(valid: Sample, bad: f32) -> Search {
    var search: Search;
    search.state = SEARCH_EDGE;
    search.low = valid;
    search.high.k = bad;
    search.k = 0.5 * (valid.k + bad);
    search.size = valid.value;
    search.weight = valid.k;
    return search;
}

// From the valid end of a step to the edge that has been found.
fn search_before_edge(ended: Search) -> Search {
    let edge = ended.low;
    let end = Sample(ended.weight, ended.size, 0.0);
    if !opposite(end, edge) {
        return no_search();
    }
    if end.k > edge.k {
        return search_root(edge, end, 0.0);
    }
    return search_root(end, edge, 0.0);
}

fn searched_edge(before: Search, found: Sample, valid: bool) -> Search {
    var search = before;
    if valid {
        search.low = found;
    } else {
        search.high.k = found.k;
    }
    search.rounds++;
    search.k = 0.5 * (search.low.k + search.high.k);
    search.state = select(SEARCH_EDGED, SEARCH_EDGE, search.rounds < 12u);
    return search;
}

// ---- Extrema between samples of the same sign ----------------------------------------------------------------

// An extremum next to k, where |f - level| is less than at `low` and `high`. It is of interest if it is nearer to the level
// than a part of `size`.
fn search_turn(k: f32, low: f32, high: f32, size: f32) -> Search {
    var search: Search;
    search.state = SEARCH_TURN;
    search.k = k;
    search.low.k = low;
    search.high.k = high;
    search.size = size;
    return search;
}

// From the sample to the other end of the step that has the extremum, if there is one.
fn searched_turn(before: Search, found: Sample) -> Search {
    var search = before;
    let is_ahead = (found.value < 0.0) == (found.slope > 0.0);
    search.k = select(before.low.k, before.high.k, is_ahead);
    search.low = found;
    search.high = found;
    search.state = select(SEARCH_ENDS, SEARCH_NOTHING, search.k == found.k);
    return search;
}

fn searched_end(before: Search, found: Sample) -> Search {
    var search = before;
    if found.k < before.low.k {
        search.low = found;
    } else {
        search.high = found;
    }
    if opposite(search.low, search.high) {
        return search_root(search.low, search.high, search.size);
    }
    if !may_dip(search.low, search.high) {
        return search_ended(search, SEARCH_NOTHING);
    }
    search.state = SEARCH_DIP;
    search.size = max(search.size, max(abs(search.low.value), abs(search.high.value)));
    search.weight = 1.0;
    search.k = dip_place(search);
    return search;
}

// Whether two samples of the same sign may have two crossings between them: both slopes lead towards the level, and
// the two tangents meet beyond it or within a tenth before it. For a convex |f - level| the tangents are a bound.
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
    let met = vb * f + va * r - f * rise * (b.k - a.k);
    return met <= 0.1 * max(va, vb) * (f + r);
}

// Regula falsi on the slope (Illinois: Dowell and Jarratt 1971), until a sample lies beyond the level or the tangents show
// that none can. `weight` is the quotient of that method's two weights, of which one is 1.
fn dip_place(search: Search) -> f32 {
    let down = search.weight * abs(search.low.slope);
    let both = down + abs(search.high.slope);
    let part = select(clamp(down / both, 0.02, 0.98), 0.5, both == 0.0);
    return mix(search.low.k, search.high.k, part);
}

fn searched_dip(before: Search, found: Sample) -> Search {
    if opposite(before.low, found) {
        return search_root(before.low, found, before.size);
    }
    var search = before;
    if (found.slope < 0.0) == (before.low.slope < 0.0) {
        search.low = found;
        search.weight = 2.0 * max(before.weight, 1.0);
    } else {
        search.high = found;
        search.weight = 0.5 * min(before.weight, 1.0);
    }
    search.rounds++;
    if search.rounds < 12u && may_dip(search.low, search.high) {
        search.k = dip_place(search);
        return search;
    }
    // Even roots: the extremum equals the level to rounding.
    let best = nearer_end(search);
    search.k = best.k;
    search.state = select(SEARCH_NOTHING, SEARCH_TOUCHED, abs(best.value) <= 3e-7 * search.size);
    return search;
}

fn nearer_end(search: Search) -> Sample {
    if abs(search.low.value) <= abs(search.high.value) {
        return search.low;
    }
    return search.high;
}

// ---- Roots between samples of opposite signs -----------------------------------------------------------------

// By Newton's method within the bracket of their signs, and bisection where that is slow. A sign change over which |f - level|
// does not shrink with the bracket is a pole or a jump. `size` is a value of it beside them, or what is a small one.
fn search_root(a: Sample, b: Sample, size: f32) -> Search {
    let k = mix(a.k, b.k, clamp(a.value / (a.value - b.value), 0.001, 0.999));
    return Search(SEARCH_ROOT, 0u, k, a, b, max(size, max(abs(a.value), abs(b.value))), b.k - a.k);
}

fn newton_place(sample: Sample) -> f32 {
    return sample.k - sample.value / select(sample.slope, 1e-37, sample.slope == 0.0);
}

fn searched_root(before: Search, found: Sample, count: f32, grain: f32) -> Search {
    var search = before;
    let is_below = !opposite(before.low, found);
    if is_below {
        search.low = found;
    } else {
        search.high = found;
    }
    search.rounds++;
    let width = search.high.k - search.low.k;
    let place = newton_place(found);
    let inside = (place >= search.low.k) & (place <= search.high.k);
    let shrinks = abs(found.value) < 0.25 * search.size;
    let leads = (found.slope != 0.0) & ((found.slope > 0.0) == (before.low.value < 0.0));
    // what is left is about the square of that
    if shrinks & leads & inside & (abs(place - found.k) <= grain * search.weight) {
        search.k = place;
        search.state = SEARCH_CROSSED;
        return search;
    }
    let tolerance = 1.2e-7 * (search.high.k + count);
    if search.rounds >= 48u || width <= 4.0 * tolerance {
        return root_ended(search);
    }
    let least = min(abs(before.low.value), abs(before.high.value));
    let fast = (width <= 0.5 * (before.high.k - before.low.k)) | (abs(found.value) <= 0.25 * least);
    // a little further, so that the bracket closes
    let beyond = place + select(-tolerance, tolerance, is_below);
    let within = (beyond > search.low.k) & (beyond < search.high.k);
    search.k = select(0.5 * (search.low.k + search.high.k), beyond, fast & within);
    return search;
}

// Both ends are as near as rays are resolved.
fn root_ended(before: Search) -> Search {
    var search = before;
    let after = max(abs(search.low.value), abs(search.high.value));
    search.state = select(SEARCH_BROKEN, SEARCH_CROSSED, after < 0.25 * search.size);
    search.k = clamp(newton_place(nearer_end(search)), search.low.k, search.high.k);
    return search;
}
