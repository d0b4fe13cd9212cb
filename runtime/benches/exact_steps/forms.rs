//! The forms that are compared.

use pullback_compiler::lower::Exactness;
use pullback_runtime::Gpu;
use pullback_runtime::decorate::can_decorate;
use pullback_runtime::kernel::Contraction;

/// One way to write the exact steps.
pub struct Form {
    pub name: String,
    pub steps: String,
    pub contraction: Contraction,
}

/// All forms that the adapter takes.
pub fn offered(gpu: &Gpu) -> Vec<Form> {
    let mut all = Vec::new();
    let mut add = |name: String, steps: String, contraction| {
        all.push(Form {
            name,
            steps,
            contraction,
        });
    };
    for form in Exactness::ALL {
        let text = form.wgsl().to_owned();
        if !form.is_decorated() {
            add(form.name().into(), text, Contraction::Allowed);
            continue;
        }
        let name = form.name().replace("decorated", "as written");
        add(name, text.clone(), Contraction::Allowed);
        if can_decorate(gpu) {
            add(form.name().into(), text, Contraction::Forbidden);
        }
    }
    all
}

/// What the recurrence is computed in: name, text, and whether it is decorated. First f32, the measure of the others.
pub fn formats(gpu: &Gpu, exact: &[Form]) -> Vec<(String, String, Contraction)> {
    let allowed = Contraction::Allowed;
    let single = include_str!("single.wgsl");
    let mut all = vec![("f32".to_owned(), single.to_owned(), allowed)];
    if can_decorate(gpu) {
        all.push((
            "f32, decorated".into(),
            single.into(),
            Contraction::Forbidden,
        ));
    }
    for form in exact {
        let text = format!("{}{}", form.steps, include_str!("pair.wgsl"));
        all.push((format!("pairs, {}", form.name), text, form.contraction));
    }
    let features = gpu.device().features();
    if features.contains(wgpu::Features::SHADER_F64) {
        all.push(("f64".into(), include_str!("double.wgsl").into(), allowed));
    }
    all
}
