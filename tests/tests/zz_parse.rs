//! Parse.
#[test]
fn parses() {
    let d = concat!(env!("CARGO_MANIFEST_DIR"), "/../compiler/shaders/wide/");
    let read = |n: &str| std::fs::read_to_string(format!("{d}{n}.wgsl")).unwrap();
    for front in [&["exact_hidden", "exact_dekker", "pair"][..], &["double"]] {
        let mut names: Vec<&str> = front.to_vec();
        names.extend([
            "real",
            "trigonometry",
            "power",
            "complex",
            "complex_waves",
            "complex_power",
            "pairs",
            "slope",
            "hash",
            "gamma",
            "complex_gamma",
            "polygamma",
        ]);
        let text: String = names.iter().map(|n| read(n)).collect();
        match naga::front::wgsl::parse_str(&text) {
            Err(e) => println!("{}", e.emit_to_string(&text)),
            Ok(m) => {
                let caps = naga::valid::Capabilities::all();
                if let Err(e) =
                    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), caps)
                        .validate(&m)
                {
                    println!("{}", e.emit_to_string(&text));
                }
            }
        }
    }
}
