//! The shader library is valid by itself and after a round trip through naga's WGSL writer.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::fs;
use std::path::Path;

fn library() -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders/math");
    let mut files: Vec<_> = fs::read_dir(folder)
        .expect("shaders/math")
        .map(|f| f.expect("a file").path())
        .collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "wgsl"));
    files.sort();
    files
        .iter()
        .map(|f| fs::read_to_string(f).expect("text"))
        .collect()
}

fn validate(source: &str) -> (naga::Module, naga::valid::ModuleInfo) {
    let module = naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    (module, info)
}

#[test]
fn shader_library_survives_a_round_trip() {
    let (module, info) = validate(&library());
    let flags = naga::back::wgsl::WriterFlags::empty();
    let again = naga::back::wgsl::write_string(&module, &info, flags).expect("WGSL");
    let (second, _) = validate(&again);
    assert_eq!(module.functions.len(), second.functions.len());
}

#[test]
fn shader_library_has_every_function() {
    let (module, _) = validate(&library());
    let has = |name: &str| {
        module
            .functions
            .iter()
            .any(|(_, f)| f.name.as_deref() == Some(name))
    };
    let real = "sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 expm1 log log2 log10 log1p pow \
        powi cbrt hypot hypot3 sinc mod fract round sign gamma lgamma digamma trigamma sincos";
    let complex = "mul div inverse abs arg exp log sqrt pow powi sin cos tan asin acos atan sinh cosh tanh asinh acosh \
        atanh square gamma digamma trigamma";
    for name in real.split_whitespace() {
        assert!(has(&format!("real_{name}")), "real_{name}");
    }
    for name in complex.split_whitespace() {
        assert!(has(&format!("complex_{name}")), "complex_{name}");
    }
}
