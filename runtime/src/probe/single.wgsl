// The format of `arithmetic.wgsl`: f32, one word a number.

alias real = f32;

const LARGEST: real = 3.4028234663852886e38;
const WORDS: u32 = 1u;

fn load(index: u32) -> real {
    return bitcast<f32>(rows[index]);
}

fn store(index: u32, v: real) {
    results[index] = bitcast<u32>(v);
}

// The same number, but the shader compiler cannot know.
fn hide(v: real) -> real {
    return bitcast<f32>(bitcast<u32>(v) ^ batch.y);
}

// The upper half of the significand.
fn upper_half(v: real) -> real {
    return bitcast<f32>(bitcast<u32>(v) & 0xfffff000u);
}
