// What a traced shader calls to say what it has computed: events, each the number of its site from 1 and the words of its
// value, one after another, with zeros behind the last. One invocation traces; all others must have returned.
//
// No branch, and the place is kept in a register: drivers copy this to hundreds of sites, and take long to compile
// branches and accesses of memory.

@group(0) @binding(6) var<storage, read_write> trace: array<u32>;

// Words in use.
var<private> used: u32;

// Place of the words of a new event. When the buffer is full the last words of it are written again and again.
fn record_event(site: u32, words: u32) -> u32 {
    let place = min(used, TRACE_WORDS);
    used = place + words + 1u;
    trace[place] = site + 1u;
    return place + 1u;
}

fn record_real(site: u32, value: f32) {
    let place = record_event(site, 1u);
    trace[place] = bitcast<u32>(value);
}

fn record_vec2(site: u32, value: vec2f) {
    let place = record_event(site, 2u);
    trace[place] = bitcast<u32>(value.x);
    trace[place + 1u] = bitcast<u32>(value.y);
}

fn record_vec3(site: u32, value: vec3f) {
    let place = record_event(site, 3u);
    trace[place] = bitcast<u32>(value.x);
    trace[place + 1u] = bitcast<u32>(value.y);
    trace[place + 2u] = bitcast<u32>(value.z);
}

fn record_vec4(site: u32, value: vec4f) {
    let place = record_event(site, 4u);
    trace[place] = bitcast<u32>(value.x);
    trace[place + 1u] = bitcast<u32>(value.y);
    trace[place + 2u] = bitcast<u32>(value.z);
    trace[place + 3u] = bitcast<u32>(value.w);
}

fn record_word(site: u32, value: u32) {
    let place = record_event(site, 1u);
    trace[place] = value;
}

fn record_integer(site: u32, value: i32) {
    let place = record_event(site, 1u);
    trace[place] = bitcast<u32>(value);
}

fn record_truth(site: u32, value: bool) {
    let place = record_event(site, 1u);
    trace[place] = select(0u, 1u, value);
}
