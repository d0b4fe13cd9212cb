// How many turns loops make: one of `batch.z` turns, and one of two turns after it.

@group(0) @binding(0) var<storage, read> rows: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;
@group(0) @binding(2) var<uniform> batch: vec4u;

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= batch.x {
        return;
    }
    // Not to be known without making the turns (D. Knuth, W. Lewis: a linear congruential generator).
    var state = rows[id.x];
    var long = 0u;
    for (var k = batch.y; k < batch.z; k++) {
        state = state * 1664525u + 1013904223u;
        long += 1u + (state & batch.y);
    }
    var short = 0u;
    for (var k = batch.y; k < 2u; k++) {
        short++;
    }
    results[2u * id.x] = long;
    results[2u * id.x + 1u] = short;
}
