
alias real = f64;
fn real_to_words(x: real) -> vec2u { return vec2u(); }

fn record_double(site: u32, value: real) {
    let place = record_event(site, 2u);
    let words = real_to_words(value);
    trace[place] = words.x;
    trace[place + 1u] = words.y;
}
