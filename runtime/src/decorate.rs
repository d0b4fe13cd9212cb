//! SPIR-V whose arithmetic a driver must do as written.
//!
//! Shader compilers may reassociate and contract floating-point operations unless each is decorated with NoContraction
//! (Vulkan specification, "Precision and Operation of SPIR-V Instructions"). naga writes no such decorations; this adds
//! them to what it has written.

use std::borrow::Cow;

use naga::Module;
use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::ModuleInfo;

use crate::shader::CHECKS;
use crate::{Error, Gpu};

/// First word of every SPIR-V module.
const MAGIC: u32 = 0x0723_0203;
/// Words of the header.
const HEADER: usize = 5;
const OP_DECORATE: u32 = 71;
const NO_CONTRACTION: u32 = 42;

/// Whether a device takes decorated modules.
#[must_use]
pub fn can_decorate(gpu: &Gpu) -> bool {
    let features = gpu.device().features();
    gpu.adapter().backend == wgpu::Backend::Vulkan
        && features.contains(wgpu::Features::PASSTHROUGH_SHADERS)
}

/// Loads a module of ours, whose loops end, decorated: past wgpu, which would write SPIR-V without decorations. The bindings of each group must be
/// numbered from 0 without gaps, and pipelines need explicit layouts.
///
/// # Errors
/// [`Error::Invalid`] if the device takes no decorated modules or the module cannot be written, and the device's.
pub fn load(gpu: &Gpu, module: &Module, info: &ModuleInfo) -> Result<wgpu::ShaderModule, Error> {
    let invalid = |reason: &str| Error::Invalid {
        reason: format!("no decorated shader: {reason}"),
    };
    if !can_decorate(gpu) {
        return Err(invalid("the device takes no SPIR-V of ours"));
    }
    let words = write(module, info).map_err(|reason| invalid(&reason))?;
    let words = forbid_contraction(&words).ok_or_else(|| invalid("broken words"))?;
    gpu.guarded("loading a decorated shader", || {
        let entry = |entry: &naga::EntryPoint| wgpu::PassthroughShaderEntryPoint {
            name: entry.name.clone().into(),
            workgroup_size: entry.workgroup_size.into(),
        };
        let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
            label: Some("decorated"),
            entry_points: module.entry_points.iter().map(entry).collect(),
            spirv: Some(Cow::Owned(words)),
            ..Default::default()
        };
        // SAFETY: the words are naga's own output for a module that it has validated, with its checks of bounds, as wgpu has it
        // written, and the loops of our modules end (`shader::CHECKS`); the decorations that were added restrict the order of
        // roundings and touch neither memory nor control flow.
        #[allow(unsafe_code)]
        unsafe {
            gpu.device().create_shader_module_passthrough(descriptor)
        }
    })
}

/// What naga writes with the checks of [`CHECKS`].
fn write(module: &Module, info: &ModuleInfo) -> Result<Vec<u32>, String> {
    let restricted = BoundsCheckPolicy::Restrict;
    let options = spv::Options {
        lang_version: (1, 3),
        // wgpu turns the viewport, so positions stay as they are.
        flags: spv::WriterFlags::LABEL_VARYINGS | spv::WriterFlags::CLAMP_FRAG_DEPTH,
        bounds_check_policies: BoundsCheckPolicies {
            index: restricted,
            buffer: restricted,
            image_load: restricted,
            binding_array: BoundsCheckPolicy::Unchecked,
        },
        force_loop_bounding: CHECKS.force_loop_bounding,
        ..spv::Options::default()
    };
    spv::write_vec(module, info, &options, None).map_err(|error| error.to_string())
}

/// The module with NoContraction on every floating-point instruction that the specification allows it on; `None` if the
/// words are not a SPIR-V module.
#[must_use]
pub fn forbid_contraction(words: &[u32]) -> Option<Vec<u32>> {
    if words.first() != Some(&MAGIC) {
        return None;
    }
    let mut rest = words.get(HEADER..)?;
    let mut place = None;
    let mut decorations = Vec::new();
    while let [first, ..] = rest {
        let (opcode, length) = (first & 0xffff, (first >> 16) as usize);
        let instruction = rest.get(..length.max(1))?;
        if length == 0 {
            return None;
        }
        if place.is_none() && !precedes_types(opcode) {
            place = Some(words.len() - rest.len());
        }
        if is_float_arithmetic(opcode) {
            // After the type comes the result.
            let result = *instruction.get(2)?;
            decorations.extend([3 << 16 | OP_DECORATE, result, NO_CONTRACTION]);
        }
        rest = &rest[length..];
    }
    let (before, after) = words.split_at(place?);
    Some([before, &decorations, after].concat())
}

/// Whether an instruction belongs to the parts of a module up to the annotations: modes, debug information, decorations
/// (SPIR-V specification, 2.4 "Logical Layout of a Module").
fn precedes_types(opcode: u32) -> bool {
    matches!(opcode, 2..=7 | 10 | 11 | 14..=17 | 71..=75 | 330..=332 | 5632 | 5633)
}

/// Negation, sum, difference, product, quotient, remainders, and products of vectors and matrices.
fn is_float_arithmetic(opcode: u32) -> bool {
    matches!(opcode, 127 | 129 | 131 | 133 | 136 | 140..=148)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spirv(wgsl: &str) -> Vec<u32> {
        let module = naga::front::wgsl::parse_str(wgsl).unwrap();
        let info = naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::all(),
        )
        .validate(&module)
        .unwrap();
        naga::back::spv::write_vec(&module, &info, &naga::back::spv::Options::default(), None)
            .unwrap()
    }

    /// Opcodes in order.
    fn opcodes(words: &[u32]) -> Vec<u32> {
        let mut rest = &words[HEADER..];
        let mut found = Vec::new();
        while let [first, ..] = rest {
            found.push(first & 0xffff);
            rest = &rest[(first >> 16) as usize..];
        }
        found
    }

    const SHADER: &str = "
        @group(0) @binding(0) var<storage, read_write> x: array<f32>;
        @compute @workgroup_size(1) fn compute_main() {
            let v = vec2f(x[0], x[1]);
            x[2] = x[0] * x[1] + x[2] / -x[3];
            x[3] = dot(v * x[0], v) - f32(1u + u32(x[0]));
        }";

    #[test]
    fn every_float_instruction_is_decorated_once() {
        let plain = spirv(SHADER);
        let decorated = forbid_contraction(&plain).unwrap();
        let count = |words: &[u32]| {
            let opcodes = opcodes(words);
            let marks = opcodes.iter().filter(|&&op| op == OP_DECORATE).count();
            let sums = opcodes.iter().filter(|&&op| is_float_arithmetic(op));
            (marks, sums.count(), opcodes.len())
        };
        let (before, arithmetic, length) = count(&plain);
        assert!(arithmetic >= 7, "{arithmetic}");
        let expected = (before + arithmetic, arithmetic, length + arithmetic);
        assert_eq!(count(&decorated), expected);
    }

    #[test]
    fn decorations_stand_before_the_first_type() {
        let decorated = opcodes(&forbid_contraction(&spirv(SHADER)).unwrap());
        let last = decorated.iter().rposition(|&op| op == OP_DECORATE).unwrap();
        let first = decorated.iter().position(|&op| (19..=39).contains(&op));
        assert!(last < first.unwrap());
    }

    #[test]
    fn other_words_are_refused() {
        let whole = spirv(SHADER);
        let check = |words: &[u32]| assert_eq!(forbid_contraction(words), None);
        check(&[]);
        check(&[MAGIC]);
        check(&whole[1..]);
        // in the middle of the first instruction, which has two words
        check(&whole[..HEADER + 1]);
        check(&[&whole[..HEADER], &[0]].concat());
        check(&[&whole[..HEADER], &[u32::MAX]].concat());
        check(&[&whole[..HEADER], &[2 << 16 | 129, 1]].concat());
    }
}
