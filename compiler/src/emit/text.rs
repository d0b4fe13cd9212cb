//! Writing modules with naga's writers.

use naga::back::{glsl, hlsl, msl, spv, wgsl};
use naga::valid::ModuleInfo;
use naga::{Module, ShaderStage};

/// A shading language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// WGSL.
    Wgsl,
    /// GLSL 4.50; of a scene, its fragment stage.
    Glsl,
    /// HLSL, shader model 5.1.
    Hlsl,
    /// The Metal shading language 2.0.
    Msl,
    /// SPIR-V 1.3, little-endian words.
    Spirv,
}

impl Target {
    /// Every target.
    pub const ALL: [Self; 5] = [Self::Wgsl, Self::Glsl, Self::Hlsl, Self::Msl, Self::Spirv];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::Msl => "msl",
            Self::Spirv => "spirv",
        }
    }
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
    let (options, pipeline) = (hlsl::Options::default(), hlsl::PipelineOptions::default());
    let mut out = String::new();
    hlsl::Writer::new(&mut out, &options, &pipeline)
        .write(module, info, None)
        .map_err(|e| e.to_string())?;
    Ok(out)
}

fn write_msl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let options = msl::Options {
        lang_version: (2, 0),
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
