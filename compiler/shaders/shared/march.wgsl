// The levels of a function along a ray, in the order in which the ray meets them.
//
// The ray is sampled at equal steps, by values alone, and walked as long as they stay between the same two levels. Between two
// samples the levels are those that lie between their values. Where a sample is nearer to a level than both its neighbours,
// and so near that f may reach it in between, its extremum is looked for, too; where f bends little
// (search.wgsl), wherever there may be one. Where f ceases to be defined within a step, the step ends there. What is
// looked for within a step is one level after the other.

// The levels lowest + k spacing, 0 ≤ k < count.
struct Family {
    lowest: f32,
    spacing: f32,
    count: u32,
}

// The end of what has been searched of a ray, and how it goes on.
struct Walk {
    k: f32,         // the step at whose end the next sample is taken
    value: f32,     // f at the end of what has been searched
    older: f32,     // f a step before; where f bends little, the distance of `value` from the nearest level, or what is more than
                    // any where f has just left that level
    start: f32,     // behind this, what has been searched may hold extrema that have not been seen; in steps
    floor: f32,     // f between the levels around it is from this to below `ceiling`; where f is undefined, above that
    ceiling: f32,
    rising: bool,   // whether f comes up to there
    band: i32,      // number of levels at or below f
}

// ---- Walking -------------------------------------------------------------------------------------------------

// A walk from a sample at the beginning of a way, where it is known whether f rises.
fn walk_begun(value: f32, rising: bool, family: Family) -> Walk {
    var walk = walk_at(Walk(1.0, value, value, 0.0, 0.0, 0.0, rising, 0), value, family);
    walk.older = select(value, room_at(walk, value), bends_little());
    return walk;
}

// Whether f is undefined at the end of what has been searched.
fn is_lost(walk: Walk) -> bool {
    return !is_tame() && walk.floor > walk.ceiling;
}

// How far a sample is from the nearest level; negative where there are levels between it and the end of what has been searched.
fn room_at(walk: Walk, value: f32) -> f32 {
    return min(value - walk.floor, walk.ceiling - value);
}

// Whether a walk of `count` steps goes on over the next sample, because between both is nothing to be searched, and it is not
// the last one. Scenes walk in a loop of their own, so that rays side by side walk together to where each has something to
// search, and then search together. Most of a ray is such steps: what they take is a few comparisons.
fn walks_over(walk: Walk, value: f32, count: f32, small: f32) -> bool {
    if bends_little() {
        // by one comparison: a product of distances that is negative, or no more than that of small ones
        return (walk.older * room_at(walk, value) > small * small) & (walk.k < count);
    }
    if !((value >= walk.floor) & (value < walk.ceiling)) {
        return is_lost(walk) & is_nan(value) & (walk.k < count);
    }
    if (value > walk.value) != walk.rising {
        if may_turn(walk, value) {
            return false;
        }
    }
    return walk.k < count;
}

// Whether f, which comes nearer to a level up to the end of what has been searched and moves away from it after that, may
// reach it in between. Beyond the nearest of three samples it goes no farther than half the way from there to one of the others,
// unless it turns more often: that is what two straight lines do, and a parabola goes an eighth of the way.
fn may_turn(walk: Walk, value: f32) -> bool {
    let ahead = abs(level_beside(walk, walk.rising) - walk.value);
    return ahead <= 0.5 * max(abs(value - walk.value), abs(walk.value - walk.older));
}

// The next level above f, or that below.
fn level_beside(walk: Walk, upper: bool) -> f32 {
    return select(walk.floor, walk.ceiling, upper);
}

// A walk over the next sample.
fn walk_on(before: Walk, value: f32) -> Walk {
    var walk = before;
    walk.older = select(walk.value, room_at(walk, value), bends_little());
    walk.rising = value > walk.value;
    walk.value = value;
    walk.k += 1.0;
    return walk;
}

// A walk that goes on from a sample in whose step nothing has been met.
fn walk_from(before: Walk, value: f32, family: Family) -> Walk {
    var walk = walk_on(before, value);
    walk.older = select(walk.older, value, is_lost(before));
    walk = walk_at(walk, value, family);
    walk.older = select(walk.older, room_at(walk, value), bends_little());
    return walk;
}

// A walk that goes on from a level that has been met, above f before or below.
fn walk_behind(before: Walk, met: Search, upper: bool, family: Family) -> Walk {
    let touching = met.state == SEARCH_TOUCHED;
    var walk = before;
    walk.value = level_beside(before, upper);
    walk.older = select(walk.value, 1e30, bends_little());
    walk.rising = upper != touching;
    walk.start = met.k;
    walk.k = floor(met.k) + 1.0;
    return walk_in_band(walk, select(select(walk.band - 1, walk.band + 1, upper), walk.band, touching), family);
}

// A walk whose value has been replaced.
fn walk_at(before: Walk, value: f32, family: Family) -> Walk {
    if is_undefined(value) {
        var walk = before;
        // no value is between these
        walk.floor = 1.0;
        walk.ceiling = 0.0;
        return walk;
    }
    return walk_in_band(before, band_of(value, family), family);
}

fn walk_in_band(before: Walk, band: i32, family: Family) -> Walk {
    var walk = before;
    walk.band = band;
    walk.floor = select(family.lowest + f32(band - 1) * family.spacing, -3e38, band == 0);
    walk.ceiling = select(family.lowest + f32(band) * family.spacing, 3e38, band == i32(family.count));
    return walk;
}

// Number of levels at or below f.
fn band_of(value: f32, family: Family) -> i32 {
    return i32(clamp(floor((value - family.lowest) / family.spacing) + 1.0, 0.0, f32(family.count)));
}

// ---- What is to be searched where a walk has stopped ---------------------------------------------------------

// Looked for is the level above f, where `upper`, or that below.
struct Aim {
    search: Search,
    upper: bool,
}

// The place of the sample at the end of what has been searched.
fn end_of(walk: Walk) -> f32 {
    return max(walk.k - 1.0, walk.start);
}

// Less than this is as good as the level itself.
fn grain_of(family: Family) -> f32 {
    return 4e-3 * family.spacing;
}

// An extremum at the end of what has been searched, or, at the last sample, there; where f bends little, one in between.
fn aim_at_turn(walk: Walk, value: f32, count: f32, family: Family, small: f32) -> Aim {
    let grain = grain_of(family);
    if bends_little() {
        let upper = walk.ceiling - value < value - walk.floor;
        let near = abs(walk.value - level_beside(walk, upper));
        let room = room_at(walk, value);
        // where f has just come from a level within the step it does not turn to it
        if room < 0.0 || !may_hold_turn(near, room, small) || walk.start > walk.k - 1.0 {
            return Aim(no_search(), false);
        }
        return Aim(search_turn(walk.k, walk.k - 1.0, walk.k, grain), upper);
    }
    if is_lost(walk) || is_nan(value) {
        return Aim(no_search(), false);
    }
    let rises = value > walk.value;
    if rises != walk.rising && may_turn(walk, value) {
        return Aim(search_turn(end_of(walk), max(walk.k - 2.0, walk.start), walk.k, grain), walk.rising);
    }
    if walk.k >= count && abs(level_beside(walk, rises) - value) <= 0.5 * abs(value - walk.value) {
        return Aim(search_turn(walk.k, end_of(walk), walk.k, grain), rises);
    }
    return Aim(no_search(), false);
}

// The step up to the sample, or up to where f ceases to be defined.
fn aim_in_step(walk: Walk, value: f32, family: Family) -> Aim {
    let near = sample_of(end_of(walk), walk.value, 0.0);
    let far = sample_of(walk.k, value, 0.0);
    if !is_tame() && is_lost(walk) != is_nan(value) {
        if is_nan(value) {
            return Aim(search_edge(near, far.k), false);
        }
        return Aim(search_edge(far, near.k), false);
    }
    return aim_before(walk, far, family);
}

// Levels up to a sample of f itself.
fn aim_before(walk: Walk, far: Sample, family: Family) -> Aim {
    let near = end_of(walk);
    let upper = far.value >= walk.ceiling;
    if is_lost(walk) || near >= far.k || !(upper || far.value < walk.floor) {
        return Aim(no_search(), false);
    }
    let level = level_beside(walk, upper);
    return Aim(search_root(sample_of(near, walk.value, level), sample_of(far.k, far.value, level), grain_of(family)), upper);
}

// The level that a search is told about its samples; an edge is one of f itself.
fn goal_of(aim: Aim, walk: Walk) -> f32 {
    return select(level_beside(walk, aim.upper), 0.0, aim.search.state == SEARCH_EDGE);
}

// Whether a search within a step has ended where its rest is to be searched: at the edge of where f is defined, or at a pole
// or a jump.
fn has_rest(search: Search) -> bool {
    return !is_tame() && (search.state == SEARCH_EDGED || search.state == SEARCH_BROKEN);
}

// A walk up to where such a search has ended, if the rest lies behind that.
fn walk_to_rest(before: Walk, ended: Search, goal: f32, family: Family) -> Walk {
    if ended.state == SEARCH_EDGED && !is_lost(before) {
        return before;
    }
    var end = ended.high;
    if ended.state == SEARCH_EDGED {
        end = ended.low;
    }
    var walk = before;
    walk.value = end.value + goal;
    walk.start = end.k;
    return walk_at(walk, walk.value, family);
}

// What is to be searched of that rest.
fn aim_at_rest(before: Walk, walk: Walk, value: f32, ended: Search, family: Family) -> Aim {
    if ended.state == SEARCH_EDGED && !is_lost(before) {
        return aim_before(walk, ended.low, family);
    }
    if is_nan(value) {
        return Aim(no_search(), false);
    }
    return aim_before(walk, sample_of(walk.k, value, 0.0), family);
}
