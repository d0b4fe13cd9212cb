// The levels of a function along a ray, in the order in which the ray meets them.
//
// The ray is sampled at equal steps, by values alone, and walked as long as they stay between the same two levels. Between two
// samples the levels are those that lie between their values, each bracketed by the signs of f - level and refined by Newton's
// method with the exact slope, kept within the bracket and helped by bisection where it is slow. Where a sample is nearer to
// a level than both its neighbours, and so near that f may reach it in between, slopes tell in which of both steps its
// extremum is, and that is looked for. A sign change over which |f - level| does not shrink with the bracket is a pole or
// a jump, and no level. Where f ceases to be defined within a step, the step ends there.
//
// A scene has one place that evaluates f where it walks, and one that evaluates f and its slope where it searches: it hands them
// to `walk_on` and `search_on`. What a search knows is forgotten where it ends, so that a walk carries little along.

// The levels lowest + k spacing, 0 ≤ k < count.
struct Family {
    lowest: f32,
    spacing: f32,
    count: u32,
}

// f on the ray; nothing else of it counts where it is not valid.
struct Probe {
    t: f32,
    u: f32,      // (f - lowest)/spacing
    slope: f32,  // du/dt; 0 where it is not known
    valid: bool,
}

// The end of what has been searched of a ray, and how it goes on.
struct Walk {
    k: f32,         // the step at whose end the next sample is taken
    value: f32,     // f at the end of what has been searched
    older: f32,     // f a step before
    start: f32,     // behind this, what has been searched may hold extrema that have not been seen
    floor: f32,     // f between the levels around it is from this to below `ceiling`
    ceiling: f32,
    rising: bool,   // whether f comes up to there
    lost: bool,     // whether f is undefined there
    band: i32,      // number of levels at or below f
}

// A search within a step.
struct Search {
    state: u32,
    t: f32,           // where f is to be evaluated next; of a level that is met, where that is
    level: i32,       // which is searched for, or met
    touching: bool,   // whether f only touches the level that is met
    band: i32,        // number of levels at or below f where the search began
    upper: bool,      // at a turn, whether it is a maximum
    near: Probe,      // ends of what is searched
    far: Probe,
    low: Probe,       // a narrower bracket
    high: Probe,
    nearest: Probe,   // the sample that is nearest to the level; the valid end of an edge
    low_weight: f32,
    high_weight: f32,
    before: f32,      // greatest distance from the level at the start
    rounds: u32,
}

const SEARCH_NOTHING: u32 = 0u;
const SEARCH_TURN: u32 = 1u;
const SEARCH_TURNED: u32 = 2u;
const SEARCH_EDGE: u32 = 3u;
const SEARCH_DIP: u32 = 4u;
const SEARCH_ROOT: u32 = 5u;
const SEARCH_MET: u32 = 6u;
// Values in spacings are kept within this, so that differences and ratios of them are finite.
const MARCH_LARGEST: f32 = 1e30;

// A way of this extent in equal steps.
struct Steps {
    count: f32,
    step: f32,
}

fn steps_over(extent: f32, count: u32) -> Steps {
    let steps = f32(max(count, 1u));
    return Steps(steps, extent / steps);
}

// ---- Walking -------------------------------------------------------------------------------------------------

// A walk from a sample at the beginning of a way, of which the slope is known, too.
fn walk_begun(value: f32, slope: f32, family: Family) -> Walk {
    let walk = Walk(1.0, value, value, 0.0, 0.0, 0.0, slope > 0.0, false, 0);
    return walk_in_band(walk, band_of(probe_of(0.0, value, family), family), family);
}

// Whether a walk goes on over the next sample, because between both is nothing to be searched, and it is not the last one.
// Scenes walk in a loop of their own, so that rays side by side walk together to where each has something to search, and then
// search together. Most of a ray is such steps: what they take is a few comparisons.
fn walks_over(walk: Walk, value: f32, steps: Steps) -> bool {
    if !((value >= walk.floor) & (value < walk.ceiling)) {
        return walk.lost & is_nan(value) & (walk.k < steps.count);
    }
    if (value > walk.value) != walk.rising {
        if may_turn(walk, value) {
            return false;
        }
    }
    return walk.k < steps.count;
}

// Whether f, which comes nearer to a level up to the end of what has been searched and moves away from it after that, may
// reach it in between. Beyond the nearest of three samples it goes no farther than from there to one of the others, unless it
// turns more often: a parabola goes an eighth of that.
fn may_turn(walk: Walk, value: f32) -> bool {
    let ahead = abs(select(walk.floor, walk.ceiling, walk.rising) - walk.value);
    return ahead <= max(abs(value - walk.value), abs(walk.value - walk.older));
}

// A walk over the next sample.
fn walk_on(before: Walk, value: f32) -> Walk {
    var walk = before;
    walk.older = walk.value;
    walk.rising = value > walk.value;
    walk.value = value;
    walk.k += 1.0;
    return walk;
}

// A walk that goes on from a sample in whose step nothing has been met.
fn walk_from(before: Walk, value: f32, family: Family) -> Walk {
    let far = probe_of(0.0, value, family);
    var walk = walk_on(before, value);
    walk.older = select(walk.older, value, before.lost);
    walk.lost = !far.valid;
    return walk_in_band(walk, band_of(far, family), family);
}

// A walk that goes on from a level that has been met.
fn walk_behind(before: Walk, met: Search, steps: Steps, family: Family) -> Walk {
    var walk = before;
    let rising = met.level >= met.band;
    walk.value = family.lowest + met.near.u * family.spacing;
    walk.older = walk.value;
    walk.rising = rising != met.touching;
    walk.lost = false;
    walk.start = met.near.t;
    walk.k = floor(walk.start / steps.step) + 1.0;
    walk.k += select(0.0, 1.0, walk.k * steps.step <= walk.start);
    let beyond = select(met.level, met.level + 1, rising);
    return walk_in_band(walk, select(beyond, met.band, met.touching), family);
}

fn walk_in_band(before: Walk, band: i32, family: Family) -> Walk {
    var walk = before;
    walk.band = band;
    walk.floor = select(family.lowest + f32(band - 1) * family.spacing, -3e38, band == 0);
    walk.ceiling = select(family.lowest + f32(band) * family.spacing, 3e38, band == i32(family.count));
    if walk.lost {
        // no value is between these
        walk.floor = 1.0;
        walk.ceiling = 0.0;
    }
    return walk;
}

// ---- Searching -----------------------------------------------------------------------------------------------

// A sample of which no slope is known.
fn probe_of(t: f32, value: f32, family: Family) -> Probe {
    return Probe(t, clamp((value - family.lowest) / family.spacing, -MARCH_LARGEST, MARCH_LARGEST), 0.0, !is_nan(value));
}

// A sample with numbers of which differences and ratios are finite.
fn probe_with_slope(t: f32, jet: vec2f, family: Family) -> Probe {
    var probe = probe_of(t, jet.x, family);
    let slope = jet.y / family.spacing;
    probe.slope = select(clamp(slope, -MARCH_LARGEST, MARCH_LARGEST), 0.0, is_nan(slope));
    return probe;
}

// Number of levels at or below f.
fn band_of(probe: Probe, family: Family) -> i32 {
    return i32(clamp(floor(probe.u) + 1.0, 0.0, f32(family.count)));
}

fn search_is_on(search: Search) -> bool {
    return search.state != SEARCH_NOTHING && search.state != SEARCH_MET;
}

// What is to be searched where a walk has stopped, in two parts: first for an extremum at the end of what has been searched,
// or, at the last sample, there; then for levels in the step up to the sample.
fn search_part(part: u32, walk: Walk, value: f32, steps: Steps, family: Family) -> Search {
    var search: Search;
    search.band = walk.band;
    search.near = probe_of(max((walk.k - 1.0) * steps.step, walk.start), walk.value, family);
    search.far = probe_of(walk.k * steps.step, value, family);
    if part == 0u {
        return search_turn(search, walk, value, steps);
    }
    return search_between(search, family);
}

fn search_turn(before: Search, walk: Walk, value: f32, steps: Steps) -> Search {
    var search = before;
    let rises = value > walk.value;
    if walk.lost || is_nan(value) {
        return search;
    }
    if rises != walk.rising && may_turn(walk, value) {
        search.state = SEARCH_TURN;
        search.t = search.near.t;
        search.upper = walk.rising;
        search.low.t = max((walk.k - 2.0) * steps.step, walk.start);
        search.high.t = search.far.t;
        return search;
    }
    let ahead = abs(select(walk.floor, walk.ceiling, rises) - value);
    if walk.k >= steps.count && ahead <= abs(value - walk.value) {
        search.state = SEARCH_TURN;
        search.t = search.far.t;
        search.upper = rises;
        search.low.t = search.near.t;
        search.high.t = search.far.t;
    }
    return search;
}

// Levels between two samples, of which the first is in the search's band.
fn search_between(before: Search, family: Family) -> Search {
    var search = before;
    search.state = SEARCH_NOTHING;
    if search.near.valid && search.far.valid {
        if band_of(search.far, family) != search.band {
            return root_between(search, search.near, search.far, family);
        }
    } else if search.near.valid != search.far.valid {
        return edge_between(search);
    }
    return search;
}

// Takes f and df/dt at search.t.
fn search_on(search: Search, jet: vec2f, steps: Steps, family: Family) -> Search {
    let probe = probe_with_slope(search.t, jet, family);
    switch search.state {
        case SEARCH_TURN: { return turn_on(search, probe); }
        case SEARCH_TURNED: { return turned_on(search, probe, family); }
        case SEARCH_EDGE: { return edge_on(search, probe, family); }
        case SEARCH_DIP: { return dip_on(search, probe, family); }
        default: { return root_on(search, probe, steps, family); }
    }
}

fn search_ended(before: Search) -> Search {
    var search = before;
    search.state = SEARCH_NOTHING;
    return search;
}

// ---- Where f ceases to be defined, by bisection from the valid side ------------------------------------------

fn edge_between(before: Search) -> Search {
    var search = before;
    search.state = SEARCH_EDGE;
    search.low = search.near;
    search.high = search.far;
    if !search.near.valid {
        search.low = search.far;
        search.high = search.near;
    }
    search.t = 0.5 * (search.low.t + search.high.t);
    return search;
}

fn edge_on(before: Search, probe: Probe, family: Family) -> Search {
    var search = before;
    if probe.valid {
        search.low = probe;
    } else {
        search.high = probe;
    }
    search.rounds++;
    search.t = 0.5 * (search.low.t + search.high.t);
    if search.rounds < 12u {
        return search;
    }
    search.rounds = 0u;
    if search.near.valid {
        search.far = search.low;
    } else {
        search.near = search.low;
        search.band = band_of(search.near, family);
    }
    return search_between(search, family);
}

// ---- Extrema between samples of one band ---------------------------------------------------------------------

// From a sample that is nearer to a level than its neighbours to the other end of the step with the extremum: to `low` or
// `high`.
fn turn_on(before: Search, probe: Probe) -> Search {
    var search = before;
    let back = search.low.t;
    let ahead = search.high.t;
    let is_ahead = (probe.slope > 0.0) == search.upper;
    search.state = SEARCH_TURNED;
    search.t = select(back, ahead, is_ahead);
    search.low = probe;
    search.high = probe;
    if !probe.valid || search.t == probe.t {
        return search_ended(search);
    }
    return search;
}

fn turned_on(before: Search, probe: Probe, family: Family) -> Search {
    var search = before;
    if probe.t < search.low.t {
        search.low = probe;
    } else {
        search.high = probe;
    }
    if !probe.valid || band_of(search.low, family) != search.band || band_of(search.high, family) != search.band {
        return search_ended(search);
    }
    search.level = dip_level(search.low, search.high, search.band, family);
    if search.level < 0 {
        return search_ended(search);
    }
    search.state = SEARCH_DIP;
    search.before = max(away(search, search.low), away(search, search.high));
    search.nearest = nearer_end(search);
    search.low_weight = 1.0;
    search.high_weight = 1.0;
    search.t = dip_guess(search);
    return search;
}

// The level that the slopes lead to and back from, or -1.
fn dip_level(a: Probe, b: Probe, band: i32, family: Family) -> i32 {
    if a.slope < 0.0 && b.slope > 0.0 && band > 0 && may_dip(a, b, band - 1) {
        return band - 1;
    }
    if a.slope > 0.0 && b.slope < 0.0 && band < i32(family.count) && may_dip(a, b, band) {
        return band;
    }
    return -1;
}

// Whether the tangents at a and b, which lead to the level and back, meet beyond it or within a tenth before it. Where
// the distance from the level is convex, they are a bound of it.
fn may_dip(a: Probe, b: Probe, level: i32) -> bool {
    let va = abs(a.u - f32(level));
    let vb = abs(b.u - f32(level));
    let top = max(abs(a.slope), abs(b.slope));
    let f = abs(a.slope) / top;
    let r = abs(b.slope) / top;
    // value where the tangents meet, times f + r
    let met = vb * f + va * r - f * abs(b.slope) * (b.t - a.t);
    return met <= 0.1 * max(va, vb) * (f + r);
}

// Regula falsi on the slope, with the weights of Illinois (Dowell and Jarratt 1971).
fn dip_guess(search: Search) -> f32 {
    let down = search.low_weight * abs(search.low.slope);
    let up = search.high_weight * abs(search.high.slope);
    return mix(search.low.t, search.high.t, clamp(down / max(down + up, 1e-37), 0.02, 0.98));
}

fn dip_on(before: Search, probe: Probe, family: Family) -> Search {
    var search = before;
    if !probe.valid {
        return search_ended(search);
    }
    if band_of(probe, family) != search.band {
        var root = root_between(search, search.low, probe, family);
        // beside the extremum f may hardly go beyond the level, and would be taken for noise there
        root.before = max(root.before, search.before);
        return root;
    }
    if away(search, probe) <= away(search, search.nearest) {
        search.nearest = probe;
    }
    if (probe.slope < 0.0) == (search.low.slope < 0.0) {
        search.low = probe;
        search.low_weight = 1.0;
        search.high_weight *= 0.5;
    } else {
        search.high = probe;
        search.high_weight = 1.0;
        search.low_weight *= 0.5;
    }
    search.rounds++;
    search.t = dip_guess(search);
    if search.rounds < 12u && may_dip(search.low, search.high, search.level) {
        return search;
    }
    // even roots: the extremum equals the level to rounding
    search.state = select(SEARCH_NOTHING, SEARCH_MET, away(search, search.nearest) <= 3e-7 * search.before);
    search.touching = true;
    search.near = search.nearest;
    search.t = search.nearest.t;
    return search;
}

// ---- Roots between samples of two bands ----------------------------------------------------------------------

fn root_between(before: Search, near: Probe, far: Probe, family: Family) -> Search {
    var search = before;
    search.state = SEARCH_ROOT;
    search.level = select(search.band - 1, search.band, band_of(far, family) > search.band);
    search.low = near;
    search.high = far;
    search.rounds = 0u;
    let a = away(search, near);
    let b = away(search, far);
    search.before = max(a, b);
    search.t = mix(near.t, far.t, clamp(a / max(a + b, 1e-37), 0.001, 0.999));
    return search;
}

// Distance from the level that is searched for, in spacings.
fn away(search: Search, probe: Probe) -> f32 {
    return abs(probe.u - f32(search.level));
}

// The end of the bracket that is nearer to the level.
fn nearer_end(search: Search) -> Probe {
    if away(search, search.low) <= away(search, search.high) {
        return search.low;
    }
    return search.high;
}

// Where Newton's step from a probe ends.
fn newton_place(search: Search, probe: Probe) -> f32 {
    return probe.t - (probe.u - f32(search.level)) / select(probe.slope, 1e-37, probe.slope == 0.0);
}

// The next place is that of Newton's step from the newest sample, and a little further, so that the bracket closes; the
// middle where that leaves the bracket, or the search is slow: where neither the bracket has become half as wide nor its nearer
// end a quarter as far from the level.
fn root_on(before: Search, probe: Probe, steps: Steps, family: Family) -> Search {
    var search = before;
    if !probe.valid {
        return search_ended(search);
    }
    let width = search.high.t - search.low.t;
    let least = min(away(search, search.low), away(search, search.high));
    let rising = search.level >= search.band;
    let place = newton_place(search, probe);
    let is_below = (probe.u < f32(search.level)) == rising;
    if is_below {
        search.low = probe;
    } else {
        search.high = probe;
    }
    search.rounds++;
    let inside = (place >= search.low.t) & (place <= search.high.t);
    // so near that a step more is as good as any
    let is_near = (away(search, probe) <= 1e-3 * search.before) & (abs(place - probe.t) <= 0.01 * steps.step);
    if is_near & inside & ((probe.slope > 0.0) == rising) {
        return root_met(search, probe, place);
    }
    let tolerance = 1.2e-7 * (abs(search.high.t) + steps.step * steps.count) + 1e-37;
    let fast = (search.high.t - search.low.t <= 0.5 * width) | (away(search, probe) <= 0.25 * least);
    let t = place + select(-2.0, 2.0, is_below) * tolerance;
    let within = (t > search.low.t) & (t < search.high.t);
    search.t = select(0.5 * (search.low.t + search.high.t), t, fast & within);
    if search.high.t - search.low.t > 8.0 * tolerance && search.rounds < 48u {
        return search;
    }
    return root_found(search, family);
}

fn root_met(before: Search, probe: Probe, t: f32) -> Search {
    var search = before;
    search.state = SEARCH_MET;
    search.touching = false;
    search.near = probe;
    search.t = t;
    return search;
}

// Both ends are as near as rays are resolved.
fn root_found(before: Search, family: Family) -> Search {
    var search = before;
    let after = max(away(search, search.low), away(search, search.high));
    if after < 0.25 * search.before || after < 1e-3 {
        let best = nearer_end(search);
        return root_met(search, best, clamp(newton_place(search, best), search.low.t, search.high.t));
    }
    // a pole or a jump
    search.near = search.high;
    search.band = band_of(search.near, family);
    return search_between(search, family);
}
