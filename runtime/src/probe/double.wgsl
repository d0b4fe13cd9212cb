// The format of `arithmetic.wgsl`: f64, two words a number, the low one first.

alias real = f64;

const LARGEST: real = 1.7976931348623157e308lf;
const WORDS: u32 = 2u;

fn load(index: u32) -> real {
    return bitcast<f64>((u64(rows[2u * index + 1u]) << 32u) | u64(rows[2u * index]));
}

fn store(index: u32, v: real) {
    let bits = bitcast<u64>(v);
    results[2u * index] = u32(bits & 0xfffffffflu);
    results[2u * index + 1u] = u32(bits >> 32u);
}

// The same number, but the shader compiler cannot know.
fn hide(v: real) -> real {
    return bitcast<f64>(bitcast<u64>(v) ^ u64(batch.y));
}

// The upper half of the significand.
fn upper_half(v: real) -> real {
    return bitcast<f64>(bitcast<u64>(v) & 0xfffffffff8000000lu);
}
