// Numbers as text, in a font of 3 × 5 cells.

const LONGEST: u32 = 16u;

// Characters by number: digits, 10 minus, 11 point, 12 e. Four bits each, the first one in the lowest bits of `first`.
struct Text {
    first: u32,
    second: u32,  // from the ninth on
    count: u32,
}

// Five rows of three cells, the top left one in the highest of 15 bits.
fn glyph_cells(code: u32) -> u32 {
    switch code {
        case 0u: { return 0x7b6fu; }
        case 1u: { return 0x2c97u; }
        case 2u: { return 0x73e7u; }
        case 3u: { return 0x73cfu; }
        case 4u: { return 0x5bc9u; }
        case 5u: { return 0x79cfu; }
        case 6u: { return 0x79efu; }
        case 7u: { return 0x7252u; }
        case 8u: { return 0x7befu; }
        case 9u: { return 0x7bcfu; }
        case 10u: { return 0x01c0u; }
        case 11u: { return 0x0002u; }
        default: { return 0x0fe7u; }
    }
}

fn with_code(text: Text, code: u32) -> Text {
    let shifted = code << (4u * (text.count % 8u));
    if text.count < 8u {
        return Text(text.first | shifted, text.second, text.count + 1u);
    }
    if text.count < LONGEST {
        return Text(text.first, text.second | shifted, text.count + 1u);
    }
    return text;
}

fn code_at(text: Text, k: u32) -> u32 {
    return (select(text.first, text.second, k >= 8u) >> (4u * (k % 8u))) & 15u;
}

// A positive number as three digits, 100 to 999, and the power of ten of the first of them.
struct Decimal {
    digits: u32,
    exponent: i32,
}

fn decimal_of(x: f32) -> Decimal {
    var scaled = x;
    var shift = 0;
    if x < 1e-15 {
        scaled = x * 1e20;
        shift = -20;
    } else if x > 1e15 {
        scaled = x * 1e-20;
        shift = 20;
    }
    // floor(log10 x) may be off by one, which the digits tell
    var e = i32(floor(log2(scaled) * 0.30102999566));
    var m = round(over_power(scaled, 10.0, e - 2));
    if m >= 1000.0 {
        e += 1;
        m = round(over_power(scaled, 10.0, e - 2));
    } else if m < 100.0 {
        e -= 1;
        m = round(over_power(scaled, 10.0, e - 2));
    }
    return Decimal(u32(clamp(m, 100.0, 999.0)), e + shift);
}

// The k-th of the three digits; 0 beyond them.
fn digit_at(digits: u32, k: i32) -> u32 {
    switch k {
        case 0: { return digits / 100u; }
        case 1: { return (digits / 10u) % 10u; }
        case 2: { return digits % 10u; }
        default: { return 0u; }
    }
}

fn significant(digits: u32) -> i32 {
    if digits % 100u == 0u {
        return 1;
    }
    return select(3, 2, digits % 10u == 0u);
}

// Three significant digits without zeros at the end, with a power of ten below 1e-3 and from 1e6 on.
fn text_of_number(value: f32) -> Text {
    var text = Text();
    if value == 0.0 {
        return with_code(text, 0u);
    }
    if value < 0.0 {
        text = with_code(text, 10u);
    }
    let decimal = decimal_of(abs(value));
    let e = decimal.exponent;
    let plain = e >= -3 && e < 6;
    let point = select(0, e, plain);
    let last = max(significant(decimal.digits) - 1, point);
    // zeros before the first digit where the point stands in front of it
    for (var k = min(point, 0); k <= last; k++) {
        text = with_code(text, select(digit_at(decimal.digits, k), 0u, k < 0));
        if k == point && k < last {
            text = with_code(text, 11u);
        }
    }
    if plain {
        return text;
    }
    text = with_code(text, 12u);
    if e < 0 {
        text = with_code(text, 10u);
    }
    let size = u32(abs(e));
    if size >= 10u {
        text = with_code(text, size / 10u);
    }
    return with_code(text, size % 10u);
}

// Whether a number written at a place covers a point: `at` is the point as seen from the place, in pixels with y down;
// `cell` is a cell's side, and `anchor` which part of the text lies left of the place.
fn number_covers(at: vec2f, value: f32, cell: f32, anchor: f32) -> bool {
    let text = text_of_number(value);
    let width = 4.0 * f32(text.count) - 1.0;
    let place = floor(at / cell + vec2f(anchor * width, 2.5));
    if any(place < vec2f(0.0)) || place.x >= width || place.y >= 5.0 {
        return false;
    }
    let column = u32(place.x);
    if column % 4u == 3u {
        return false;
    }
    let bit = 14u - (u32(place.y) * 3u + column % 4u);
    return ((glyph_cells(code_at(text, column / 4u)) >> bit) & 1u) == 1u;
}
