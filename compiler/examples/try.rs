use pullback_compiler::*;
fn main() {
    for m in [("math", link::math_module()), ("shared", link::shared_module()), ("entry", link::entry_module())] {
        println!("{} {} functions", m.0, m.1.functions.len());
    }
    for path in std::env::args().skip(1) {
        let text = std::fs::read_to_string(&path).unwrap_or(path.clone());
        let c = compile(&text);
        for d in &c.diagnostics { println!("{path}: {:?} {} {} | {} | {:?}", d.severity, d.code, d.message, d.span.text(&text), d.hint); }
        if let Some(p) = c.program {
            match p.scene_module(0, Default::default()) {
                Ok(m) => println!("{path}: ok {} functions", m.module.functions.len()),
                Err(e) => println!("{path}: {e:?}"),
            }
            for what in [EmitWhat::Value, EmitWhat::Gradient, EmitWhat::Derivative] {
                if let Ok(t) = p.emit(0, what, Target::Wgsl, Default::default()) { if std::env::var("SHOW").is_ok() { println!("{}", String::from_utf8_lossy(&t)); } }
            }
            for w in [What::Value, What::Gradient, What::Derivative] { match p.eval_module(0, w, Default::default()) { Ok(_) => {}, Err(e) if e[0].code=="wrong-demand" => {}, Err(e) => println!("{path}: {e:?}")} }
        }
    }
}
