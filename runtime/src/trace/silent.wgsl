// Recorders for a machine that sees every call by itself.

fn record_real(site: u32, value: f32) {}
fn record_vec2(site: u32, value: vec2f) {}
fn record_vec3(site: u32, value: vec3f) {}
fn record_vec4(site: u32, value: vec4f) {}
fn record_word(site: u32, value: u32) {}
fn record_integer(site: u32, value: i32) {}
fn record_truth(site: u32, value: bool) {}
