//! Targets, and how modules are written for them: functions by our own printer, scenes by naga's writers.

use std::collections::BTreeMap;

use naga::back::{glsl, hlsl, msl, spv, wgsl};
use naga::valid::ModuleInfo;
use naga::{AddressSpace, Function, Handle, Module, ShaderStage, StorageAccess};

use super::build::BuiltModule;
use super::header::header;
use super::parts::Part;
use super::print::{Dialect, Printed, comment, print};
use super::request::{Emission, Emitted, EmittedFunction};
use crate::lower::{Format, LowerError};
use crate::module::ModuleError;

/// A language, or a program that takes code in one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Target {
    /// WGSL.
    Wgsl,
    /// Functions for GLSL 3.30, GLSL ES 3.00 and later ones; of a scene, its fragment stage in GLSL 4.50.
    Glsl,
    /// HLSL, shader model 5.1.
    Hlsl,
    /// The Metal shading language 2.0.
    Msl,
    /// SPIR-V 1.3, little-endian words.
    Spirv,
    /// C11.
    C,
    /// WGSL for Bevy and others with naga_oil: a module to `#import`.
    Bevy,
    /// An image shader for shadertoy.com.
    Shadertoy,
    /// A shader for Godot 4: of the canvas for formulas of the plane, spatial for densities in space.
    Godot,
    /// A JavaScript module with a GLSL chunk for three.js.
    Three,
    /// A JavaScript module with node functions for the WebGPU renderer of three.js.
    Tsl,
}

impl Target {
    /// Every target.
    pub const ALL: [Self; 11] = [
        Self::Wgsl,
        Self::Glsl,
        Self::Hlsl,
        Self::Msl,
        Self::Spirv,
        Self::C,
        Self::Bevy,
        Self::Shadertoy,
        Self::Godot,
        Self::Three,
        Self::Tsl,
    ];
    /// The shading languages, in which whole scenes can be written.
    pub const LANGUAGES: [Self; 5] = [Self::Wgsl, Self::Glsl, Self::Hlsl, Self::Msl, Self::Spirv];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::Msl => "msl",
            Self::Spirv => "spirv",
            Self::C => "c",
            Self::Bevy => "bevy",
            Self::Shadertoy => "shadertoy",
            Self::Godot => "godot",
            Self::Three => "three",
            Self::Tsl => "tsl",
        }
    }

    /// Whether it is a program with files of its own kind, rather than a language.
    pub(super) fn is_host(self) -> bool {
        matches!(
            self,
            Self::Bevy | Self::Shadertoy | Self::Godot | Self::Three | Self::Tsl
        )
    }

    /// The grammar of its texts; SPIR-V has none.
    pub(super) fn dialect(self) -> Dialect {
        match self {
            Self::Wgsl | Self::Bevy | Self::Tsl | Self::Spirv => Dialect::Wgsl,
            Self::Glsl | Self::Shadertoy | Self::Three => Dialect::Glsl,
            Self::Godot => Dialect::Godot,
            Self::Hlsl => Dialect::Hlsl,
            Self::Msl => Dialect::Msl,
            Self::C => Dialect::C,
        }
    }
}

/// What stands before the code in C. GCC knows the pragma as an option only, and warns of it.
const C_HEAD: &str = "
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#if !defined(__GNUC__) || defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif
";

/// The functions of a module as text, with what is said of them in front.
pub(super) fn functions(
    emission: &Emission,
    parts: &[Part],
    built: &BuiltModule,
) -> Result<Emitted, ModuleError> {
    let target = emission.target;
    if emission.precision.format() == Format::Double {
        // the readable printer writes single precision only
        let head = format!("functions of `{}` in 64 bits", parts[0].formula.name);
        let bytes = write(&built.module, &built.info, target, &head);
        return Ok(Emitted {
            bytes: bytes.map_err(ModuleError::Invalid)?,
            functions: listed(built, &BTreeMap::new()),
        });
    }
    let printed = printed(built, target.dialect(), emission)?;
    let declared: BTreeMap<_, _> = printed
        .functions
        .iter()
        .map(|f| (f.handle, (f.name.clone(), f.signature.clone())))
        .collect();
    let functions = listed(built, &declared);
    if target == Target::Spirv {
        let bytes = write(&built.module, &built.info, target, "");
        return Ok(Emitted {
            bytes: bytes.map_err(ModuleError::Invalid)?,
            functions,
        });
    }
    let signatures: Vec<String> = functions.iter().map(|f| f.signature.clone()).collect();
    let head = header(emission, parts, &built.functions, &signatures);
    let mut text = comment(&head, "//");
    text.push_str(match target {
        Target::C => C_HEAD,
        Target::Msl => "\n#include <metal_stdlib>\nusing namespace metal;\n",
        _ => "",
    });
    text.push('\n');
    text.push_str(&printed.text());
    Ok(Emitted {
        bytes: text.into_bytes(),
        functions,
    })
}

/// The functions in a dialect.
pub(super) fn printed(
    built: &BuiltModule,
    dialect: Dialect,
    emission: &Emission,
) -> Result<Printed, ModuleError> {
    let wanted: Vec<_> = built.functions.iter().map(|f| f.handle).collect();
    print(&built.module, &built.info, dialect, &wanted).map_err(|problem| {
        ModuleError::Lower(LowerError::Demand(format!(
            "`{}` has no form for {problem}",
            emission.target.name()
        )))
    })
}

/// What is told of the functions.
pub(super) fn listed(
    built: &BuiltModule,
    declared: &BTreeMap<Handle<Function>, (String, String)>,
) -> Vec<EmittedFunction> {
    let all = built.functions.iter();
    all.map(|function| {
        let known = declared.get(&function.handle).cloned();
        let own = &built.module.functions[function.handle];
        let (name, signature) =
            known.unwrap_or_else(|| (own.name.clone().unwrap_or_default(), String::new()));
        EmittedFunction {
            what: function.what,
            name,
            signature,
            returns: function.returns.clone(),
        }
    })
    .collect()
}

/// Writes a module; texts begin with a comment that says what they hold.
///
/// # Errors
/// What the language cannot say.
pub fn write(
    module: &Module,
    info: &ModuleInfo,
    target: Target,
    header: &str,
) -> Result<Vec<u8>, String> {
    let header = format!("// pullback {}: {header}\n", env!("CARGO_PKG_VERSION"));
    let text = match target {
        Target::Wgsl => {
            let flags = wgsl::WriterFlags::empty();
            header + &wgsl::write_string(module, info, flags).map_err(|e| e.to_string())?
        }
        // the version must be the first line
        Target::Glsl => write_glsl(module, info)?.replacen('\n', &format!("\n{header}"), 1),
        Target::Hlsl => header + &write_hlsl(module, info)?,
        Target::Msl => header + &write_msl(module, info)?,
        Target::Spirv => return write_spirv(module, info),
        other => return Err(format!("`{}` has no whole scenes", other.name())),
    };
    Ok(text.into_bytes())
}

fn write_glsl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let options = glsl::Options {
        version: glsl::Version::Desktop(450),
        binding_map: module
            .global_variables
            .iter()
            .filter_map(|(_, global)| global.binding)
            .filter_map(|at| Some((at, u8::try_from(at.binding).ok()?)))
            .collect(),
        ..glsl::Options::default()
    };
    let entry = module
        .entry_points
        .iter()
        .find(|e| e.stage == ShaderStage::Fragment)
        .ok_or("there is no fragment stage")?;
    let pipeline = glsl::PipelineOptions {
        shader_stage: entry.stage,
        entry_point: entry.name.clone(),
        multiview: None,
    };
    let policies = naga::proc::BoundsCheckPolicies::default();
    let mut out = String::new();
    glsl::Writer::new(&mut out, module, info, &options, &pipeline, policies)
        .and_then(|mut writer| writer.write())
        .map_err(|e| e.to_string())?;
    Ok(out)
}

fn write_hlsl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let options = hlsl::Options {
        // every loop of a scene ends by itself
        force_loop_bounding: false,
        ..hlsl::Options::default()
    };
    let pipeline = hlsl::PipelineOptions::default();
    let mut out = String::new();
    hlsl::Writer::new(&mut out, &options, &pipeline)
        .write(module, info, None)
        .map_err(|e| e.to_string())?;
    Ok(out)
}

/// Buffers of an entry point have the numbers of their bindings. The sizes of those that end in an array of any length are in
/// one more, behind the last.
fn msl_resources(module: &Module) -> msl::EntryPointResources {
    let bound = || {
        let globals = module.global_variables.iter().map(|(_, global)| global);
        globals.filter_map(|global| Some((global.space, global.binding?)))
    };
    let slot = |binding: u32| u8::try_from(binding).ok();
    let target = |(space, at): (AddressSpace, naga::ResourceBinding)| {
        let is_written = matches!(space, AddressSpace::Storage { access } if access.contains(StorageAccess::STORE));
        let target = msl::BindTarget {
            buffer: slot(at.binding),
            mutable: is_written,
            ..msl::BindTarget::default()
        };
        (at, target)
    };
    let last = bound().map(|(_, at)| at.binding).max();
    msl::EntryPointResources {
        resources: bound().map(target).collect(),
        immediates_buffer: None,
        sizes_buffer: slot(last.map_or(0, |last| last + 1)),
    }
}

fn write_msl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let entries = module.entry_points.iter();
    let options = msl::Options {
        lang_version: (2, 0),
        per_entry_point_map: entries
            .map(|entry| (entry.name.clone(), msl_resources(module)))
            .collect(),
        fake_missing_bindings: false,
        // every loop of a scene ends by itself
        force_loop_bounding: false,
        ..msl::Options::default()
    };
    msl::write_string(module, info, &options, &msl::PipelineOptions::default())
        .map(|(text, _)| text)
        .map_err(|e| e.to_string())
}

fn write_spirv(module: &Module, info: &ModuleInfo) -> Result<Vec<u8>, String> {
    let options = spv::Options {
        lang_version: (1, 3),
        ..spv::Options::default()
    };
    let words = spv::write_vec(module, info, &options, None).map_err(|e| e.to_string())?;
    Ok(words.into_iter().flat_map(u32::to_le_bytes).collect())
}
