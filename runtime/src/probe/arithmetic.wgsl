// What an adapter does to the arithmetic of a format, which stands in front. A row (a, b) in, `arithmetic.rs` has the
// order of what comes out.

@group(0) @binding(0) var<storage, read> rows: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;
@group(0) @binding(2) var<uniform> batch: vec4u;

fn comparisons(a: real, b: real) -> u32 {
    var seen = select(0u, 1u, a < b);
    seen |= select(0u, 2u, a <= b);
    seen |= select(0u, 4u, a == b);
    seen |= select(0u, 8u, a != b);
    seen |= select(0u, 16u, !(a < b));
    seen |= select(0u, 32u, a == a);
    seen |= select(0u, 64u, a > LARGEST);
    return seen;
}

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= batch.x {
        return;
    }
    let a = load(2u * id.x);
    let b = load(2u * id.x + 1u);
    let first = 22u * id.x;
    let none = real(0.0);

    // TwoSum as written, and hidden.
    let s = a + b;
    let t = s - a;
    store(first, s);
    store(first + 1u, (a - (s - t)) + (b - t));
    let sh = hide(a + b);
    let th = hide(sh - a);
    let uh = hide(sh - th);
    store(first + 2u, sh);
    store(first + 3u, hide(hide(a - uh) + hide(b - th)));

    // TwoProd by fma, and by halves, hidden.
    let p = hide(a * b);
    store(first + 4u, p);
    store(first + 5u, fma(a, b, -p));
    let ah = upper_half(a);
    let bh = upper_half(b);
    let al = hide(a - ah);
    let bl = hide(b - bh);
    let e = hide(hide(ah * bh) - p);
    let f = hide(e + hide(ah * bl));
    let g = hide(f + hide(al * bh));
    store(first + 6u, p);
    store(first + 7u, hide(g + hide(al * bl)));

    // Roundings.
    store(first + 8u, a + b);
    store(first + 9u, a - b);
    store(first + 10u, a * b);
    store(first + 11u, a / b);
    store(first + 12u, sqrt(a));
    // Not zero if the product is fused with the difference.
    store(first + 13u, a * b - p);

    // What compilers like to simplify.
    store(first + 14u, a + none);
    store(first + 15u, a * none);
    store(first + 16u, a - a);
    store(first + 17u, none - a);
    store(first + 18u, -a);
    store(first + 19u, abs(a));
    store(first + 20u, real(1.0) / a);
    results[(first + 21u) * WORDS] = comparisons(a, b);
}
