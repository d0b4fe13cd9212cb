//! Files for programs that take shaders of their own kind.

mod script;

use std::collections::BTreeMap;

use super::build::{Built, BuiltModule, build};
use super::header::header;
use super::parts::{Part, part};
use super::print::{Printed, comment};
use super::request::{Emission, EmitWhat, Emitted, ParamsAs};
use super::text::{listed, printed};
use super::{Target, demand};
use crate::ir::Ty;
use crate::module::ModuleError;
use crate::program::{ParamInfo, Picture, Program};
use crate::types::Type;

/// What a formula is to a picture of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A real function of the plane.
    Plane,
    /// A complex function.
    Complex,
    /// A density in space.
    Space,
}

impl Kind {
    fn of(picture: &Picture) -> Option<Self> {
        let formula = &picture.formula;
        let scalars = formula.scalars();
        match (scalars.as_slice(), formula.ty) {
            ([Ty::Real, Ty::Real], Type::Real) => Some(Self::Plane),
            ([Ty::Complex], Type::Complex | Type::Real) => Some(Self::Complex),
            ([Ty::Real, Ty::Real, Ty::Real], Type::Real) => Some(Self::Space),
            _ => None,
        }
    }

    /// The function that the picture calls.
    fn part(self) -> EmitWhat {
        match self {
            Self::Plane => EmitWhat::Gradient,
            Self::Complex => EmitWhat::Value,
            Self::Space => EmitWhat::Integral,
        }
    }
}

/// Everything that is put into a file.
pub(super) struct Hosted<'a> {
    program: &'a Program,
    picture: &'a Picture,
    emission: Emission,
    parts: Vec<Part>,
    built: BuiltModule,
    printed: Printed,
    /// Whether the module itself holds the parameters, as nodes of three.js.
    holds_parameters: bool,
}

/// The file for a host.
pub(super) fn emitted(
    program: &Program,
    picture: &Picture,
    emission: &Emission,
) -> Result<Emitted, ModuleError> {
    let mut emission = emission.clone();
    let draws = matches!(emission.target, Target::Shadertoy | Target::Godot);
    let mut kind = None;
    if draws {
        let of = Kind::of(picture).ok_or_else(|| {
            demand(
                "a whole shader is of a real function of two or three reals, or of a complex one",
            )
        })?;
        // the shader declares them, and hands them on
        emission.params = ParamsAs::Arguments;
        emission.parts = vec![of.part()];
        kind = Some(of);
    }
    // a uniform of WGSL would take a binding that is three.js's to give
    let is_tsl = emission.target == Target::Tsl && emission.params == ParamsAs::Uniform;
    if is_tsl {
        emission.params = ParamsAs::Arguments;
    }
    let holds_parameters = is_tsl && !program.params().is_empty();
    let values = (emission.params == ParamsAs::Constants).then(|| program.params());
    let parts: Vec<Part> = emission
        .parts
        .iter()
        .map(|&what| part(picture, what, values))
        .collect::<Result<_, _>>()?;
    let built = build(program, &parts, &emission)?;
    let printed = printed(&built, emission.target.dialect(), &emission)?;
    let hosted = Hosted {
        program,
        picture,
        emission,
        parts,
        built,
        printed,
        holds_parameters,
    };
    let text = match (hosted.emission.target, kind) {
        (Target::Shadertoy, Some(kind)) => hosted.shadertoy(kind),
        (Target::Godot, Some(kind)) => hosted.godot(kind),
        (Target::Three, _) => hosted.three(),
        (Target::Tsl, _) => hosted.tsl(),
        _ => hosted.bevy(),
    };
    let declared: BTreeMap<_, _> = hosted
        .printed
        .functions
        .iter()
        .map(|f| (f.handle, (f.name.clone(), f.signature.clone())))
        .collect();
    Ok(Emitted {
        bytes: text.into_bytes(),
        functions: listed(&hosted.built, &declared),
    })
}

impl Hosted<'_> {
    fn head(&self) -> String {
        let signature = |b: &Built| {
            let found = self.printed.functions.iter().find(|f| f.handle == b.handle);
            found.map(|f| f.signature.clone()).unwrap_or_default()
        };
        let signatures: Vec<String> = self.built.functions.iter().map(signature).collect();
        let head = header(
            &self.emission,
            &self.parts,
            &self.built.functions,
            &signatures,
        );
        comment(&head, "//")
    }

    fn base(&self) -> String {
        let own = &self.picture.formula.name;
        self.emission
            .name
            .clone()
            .unwrap_or_else(|| crate::lower::identifier(own))
    }

    /// WGSL with a path to import it by.
    fn bevy(&self) -> String {
        format!(
            "#define_import_path pullback::{}\n\n{}\n{}",
            self.base(),
            self.head(),
            self.printed.text()
        )
    }

    fn setting(&self, name: &str, otherwise: &str) -> String {
        let found = self.picture.settings.iter().find(|s| s.spec.name == name);
        let Some(value) = found.map(|s| s.value) else {
            return otherwise.to_owned();
        };
        match otherwise.split(',').count() {
            1 => format!("{:?}", value.x),
            2 => format!("{:?}, {:?}", value.x, value.y),
            _ => format!("{:?}, {:?}, {:?}", value.x, value.y, value.z),
        }
    }

    /// The names by which a whole shader knows the parameters, and what each is.
    fn params(&self) -> Vec<(String, &ParamInfo)> {
        let uses = self
            .built
            .functions
            .first()
            .map_or(&[][..], |f| &f.arguments);
        let named = self.program.params().iter().map(|param| {
            let name = self.emission.name_of(&param.name);
            (name, param)
        });
        named
            .filter(|(name, _)| uses.iter().any(|(used, _)| used == name))
            .map(|(name, param)| (format!("p_{name}"), param))
            .collect()
    }

    /// A call of the only function, at what the shader calls its point.
    fn call(&self, kind: Kind, time: &str) -> String {
        let Some(function) = self.built.functions.first() else {
            return String::new();
        };
        let printed = self.printed.functions.iter();
        let name = printed
            .filter(|f| f.handle == function.handle)
            .map(|f| f.name.clone())
            .next()
            .unwrap_or_default();
        let inputs = &self.parts[0].formula.inputs;
        let mut arguments: Vec<String> = match (kind, inputs.len()) {
            (Kind::Plane, 2) => vec!["p.x".to_owned(), "p.y".to_owned()],
            (Kind::Space, _) => ["o", "d", "a", "b"].map(str::to_owned).into(),
            _ => vec!["p".to_owned()],
        };
        let params = self.params();
        for (name, _) in function.arguments.iter().skip(inputs.len()) {
            let param = params.iter().find(|(p, _)| p[2..] == *name);
            arguments.push(match (param, name.as_str()) {
                (Some((uniform, _)), _) => uniform.clone(),
                (None, "pixel") => "pixel_size".to_owned(),
                (None, _) => time.to_owned(),
            });
        }
        format!("{name}({})", arguments.join(", "))
    }

    fn filled(&self, template: &str, kind: Kind, time: &str) -> String {
        let call = self.call(kind, time);
        let boxed = self.setting("box", "1.0, 1.0, 1.0");
        let value = match self.picture.formula.ty {
            Type::Real if kind == Kind::Complex => format!("vec2({call}, 0.0)"),
            _ => call.clone(),
        };
        let spacing = match self.setting("spacing", "0.25").as_str() {
            "0.0" => "0.25".to_owned(),
            known => known.to_owned(),
        };
        template
            .replace("/*CENTER*/", &self.setting("center", "0.0, 0.0"))
            .replace("/*HEIGHT*/", &self.setting("height", "4.0"))
            .replace("/*SPACING*/", &spacing)
            .replace("/*BOX*/", &boxed)
            .replace("/*GRADIENT*/", &call)
            .replace("/*INTEGRAL*/", &call)
            .replace("/*VALUE*/", &value)
    }

    fn shadertoy(&self, kind: Kind) -> String {
        let template = match kind {
            Kind::Plane => include_str!("shadertoy_plane.glsl"),
            Kind::Complex => include_str!("shadertoy_complex.glsl"),
            Kind::Space => include_str!("shadertoy_space.glsl"),
        };
        let mut out = self.head();
        out.push('\n');
        for (name, param) in self.params() {
            out.push_str(&format!(
                "const float {name} = {:?}; // from {:?} to {:?}\n",
                param.default, param.lo, param.hi
            ));
        }
        if !self.params().is_empty() {
            out.push('\n');
        }
        out.push_str(&self.printed.text());
        out.push('\n');
        out.push_str(&self.filled(template, kind, "iTime"));
        out
    }

    fn godot(&self, kind: Kind) -> String {
        let (begin, template) = match kind {
            Kind::Plane => (
                "shader_type canvas_item;\n",
                include_str!("godot_plane.gdshader"),
            ),
            Kind::Complex => (
                "shader_type canvas_item;\n",
                include_str!("godot_complex.gdshader"),
            ),
            Kind::Space => (
                "shader_type spatial;\nrender_mode unshaded, blend_add, cull_front, depth_test_disabled, fog_disabled;\n",
                include_str!("godot_space.gdshader"),
            ),
        };
        let mut out = format!("{begin}\n{}\n", self.head());
        for (name, param) in self.params() {
            let range = if param.lo.is_finite() && param.hi.is_finite() && param.lo < param.hi {
                format!(" : hint_range({:?}, {:?})", param.lo, param.hi)
            } else {
                String::new()
            };
            out.push_str(&format!(
                "uniform float {name}{range} = {:?};\n",
                param.default
            ));
        }
        if !self.params().is_empty() {
            out.push('\n');
        }
        out.push_str(&self.printed.text());
        out.push('\n');
        out.push_str(&self.filled(template, kind, "TIME"));
        out
    }
}
