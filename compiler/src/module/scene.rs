//! A scene with a formula in it.

use naga::valid::ModuleInfo;
use naga::{Module, ScalarKind, StructMember, TypeInner};

use super::bounds::{Field, tell};
use super::column::Column;
use super::demand::Demand;
use super::{ModuleError, validate};
use crate::formula::Formula;
use crate::link::{Linker, Sources};
use crate::lower::Tier;
use crate::program::{Picture, SettingValue};
use crate::scene::{ENTRIES, Scene, TABLE, setting_component};
use crate::specialise::specialise;

/// A validated module with entry points `vertex_main`, `fragment_main`, `compute_main` and `linear_main`.
#[derive(Clone, Debug)]
pub struct SceneModule {
    /// The module.
    pub module: Module,
    /// What validation found out about it.
    pub info: ModuleInfo,
    /// Layout of the template's `Settings`.
    layout: Vec<Member>,
    /// Size of the settings' uniform in bytes, a multiple of 16, never 0.
    pub settings_size: usize,
    /// What the formula's numbers are computed with.
    pub tier: Tier,
    /// The formula of a scene that looks for its levels along rays.
    field: Option<Field>,
    /// The bytes of the settings and the samples per axis that it is made for, if it is made for some.
    fixed: Option<(Vec<u8>, u32)>,
    /// The words of the storage `mesh`, of a scene that has one: the host's to fill in. See `shaders/shared/mesh.wgsl`.
    pub mesh: Vec<[u32; 4]>,
}

/// Place of the samples per axis among the words of `struct View`: behind the centre, the size, the tile, the pixel and the
/// time.
const SAMPLES: usize = 8;

#[derive(Clone, Debug)]
struct Member {
    name: String,
    offset: usize,
    kind: ScalarKind,
    count: usize,
}

impl SceneModule {
    /// Splices a picture's formula into its scene: exactly the stubs of the template are compiled, what is not
    /// reached is left out, and the result is validated.
    ///
    /// # Errors
    /// The formula has no form that the scene needs, such as a missing derivative.
    pub fn new(picture: &Picture, tier: impl Into<Tier>) -> Result<Self, ModuleError> {
        let tier = tier.into();
        let mut module = Self::link(picture, tier)?;
        naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
        let info = validate(&module, tier.precision)?;
        let (layout, settings_size) = layout(picture.scene);
        Ok(Self {
            module,
            info,
            layout,
            settings_size,
            tier,
            field: Field::of(picture),
            fixed: None,
            mesh: Vec::new(),
        })
    }

    /// The scene for these settings and this number of samples per axis alone: a module in which they are constants, and which
    /// holds only what they need. Where settings change from frame to frame, the module itself is the one to use, which
    /// compiles once for all of them.
    ///
    /// # Errors
    /// [`ModuleError::Invalid`], which would be a mistake of ours.
    pub fn specialised(
        &self,
        settings: &[SettingValue],
        samples: u32,
    ) -> Result<Self, ModuleError> {
        let bytes = self.pack_settings(settings);
        let words: Vec<Option<u32>> = bytes
            .chunks_exact(4)
            .map(|word| word.try_into().ok().map(u32::from_le_bytes))
            .collect();
        let mut module = self.module.clone();
        if let Some(field) = &self.field {
            tell(&mut module, field, settings);
        }
        let mut view = [None; 12];
        view[SAMPLES] = Some(samples);
        specialise(&mut module, &[("settings", &words), ("view", &view)]);
        naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
        let info = validate(&module, self.tier.precision)?;
        Ok(Self {
            module,
            info,
            fixed: Some((bytes, samples)),
            ..self.clone()
        })
    }

    /// The bytes of the settings and the samples per axis that it is made for alone, if it is; else it is for any.
    #[must_use]
    pub fn made_for(&self) -> Option<(&[u8], u32)> {
        let (settings, samples) = self.fixed.as_ref()?;
        Some((settings, *samples))
    }

    /// The first step of [`Self::new`]: derivatives, lowering and linking, not yet compacted and validated.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn link(picture: &Picture, tier: impl Into<Tier>) -> Result<Module, ModuleError> {
        let tier = tier.into();
        let demand = Demand {
            formula: &picture.formula,
            colour: picture.colour.as_ref(),
            column: Column::of(&picture.settings),
            precision: tier.precision,
        };
        Self::fill(picture.scene.module(), demand, tier)
    }

    /// [`Self::link`] for any template.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn splice(template: &Module, formula: &Formula, tier: Tier) -> Result<Module, ModuleError> {
        let demand = Demand {
            formula,
            colour: None,
            column: None,
            precision: tier.precision,
        };
        Self::fill(template, demand, tier)
    }

    fn fill(template: &Module, mut demand: Demand<'_>, tier: Tier) -> Result<Module, ModuleError> {
        let sources = Sources::get(tier);
        let mut linker = Linker::new(vec![template, sources.entry, sources.shared, sources.math]);
        linker.link_entry_points(1, &mut demand)?;
        Ok(linker.out)
    }

    /// The bytes of the settings' uniform.
    #[must_use]
    pub fn pack_settings(&self, settings: &[SettingValue]) -> Vec<u8> {
        let mut bytes = vec![0; self.settings_size];
        for member in &self.layout {
            for k in 0..member.count {
                let at = member.offset + 4 * k;
                let value = setting_component(settings, &member.name, k);
                if let (Some(slot), Some(value)) = (bytes.get_mut(at..at + 4), value) {
                    slot.copy_from_slice(&encode(value, member.kind));
                }
            }
        }
        bytes
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "settings are range-checked; rounding to the shader's format is meant"
)]
fn encode(value: f64, kind: ScalarKind) -> [u8; 4] {
    match kind {
        ScalarKind::Sint => (value as i32).to_le_bytes(),
        ScalarKind::Uint | ScalarKind::Bool => (value as u32).to_le_bytes(),
        _ => (value as f32).to_le_bytes(),
    }
}

/// Members of the template's `Settings`, and the size of the uniform that holds them.
fn layout(scene: &Scene) -> (Vec<Member>, usize) {
    let module = scene.module();
    let settings = module
        .global_variables
        .iter()
        .find(|(_, g)| g.name.as_deref() == Some("settings"));
    let Some((_, settings)) = settings else {
        return (Vec::new(), 16);
    };
    let TypeInner::Struct { members, span } = &module.types[settings.ty].inner else {
        return (Vec::new(), 16);
    };
    let mut found = Vec::new();
    add_members(module, members, 0, &mut found);
    let members = found;
    (members, (*span as usize).next_multiple_of(16).max(16))
}

/// Members with a number or a vector, those of structures within among them.
fn add_members(module: &Module, members: &[StructMember], base: u32, out: &mut Vec<Member>) {
    for member in members {
        let offset = base + member.offset;
        let (kind, count) = match &module.types[member.ty].inner {
            TypeInner::Scalar(scalar) => (scalar.kind, 1),
            TypeInner::Vector { size, scalar } => (scalar.kind, *size as usize),
            // the table of the palette: vectors of four, without gaps
            TypeInner::Array { .. } if member.name.as_deref() == Some(TABLE) => {
                (ScalarKind::Float, 4 * ENTRIES)
            }
            TypeInner::Struct { members, .. } => {
                add_members(module, members, offset, out);
                continue;
            }
            _ => continue,
        };
        out.extend(member.name.clone().map(|name| Member {
            name,
            offset: offset as usize,
            kind,
            count,
        }));
    }
}
