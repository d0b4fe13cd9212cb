//! A scene's settings by name, in the bytes of its uniform.

use naga::{Module, Scalar, ScalarKind, TypeInner};

/// Binding of the uniform in every scene module.
const BINDING: naga::ResourceBinding = naga::ResourceBinding {
    group: 0,
    binding: 2,
};

/// One member of a scene's `struct Settings`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SettingSlot {
    /// Its name in the shader, which is the setting's.
    pub name: String,
    /// Number of components: 1 for a number, 2 for a range, 3 or 4 for a colour or direction.
    pub components: usize,
    offset: usize,
    kind: ScalarKind,
}

/// The settings that the shader of `module` has; none if it reads none.
#[must_use]
pub fn slots(module: &Module) -> Vec<SettingSlot> {
    let uniform = module
        .global_variables
        .iter()
        .find(|(_, global)| global.binding == Some(BINDING));
    let Some((_, global)) = uniform else {
        return Vec::new();
    };
    let TypeInner::Struct { members, .. } = &module.types[global.ty].inner else {
        return Vec::new();
    };
    members
        .iter()
        .filter_map(|member| {
            let (components, scalar) = match module.types[member.ty].inner {
                TypeInner::Scalar(scalar) => (1, scalar),
                TypeInner::Vector { size, scalar } => (size as usize, scalar),
                _ => return None,
            };
            let Scalar { kind, width: 4 } = scalar else {
                return None;
            };
            Some(SettingSlot {
                name: member.name.clone()?,
                components,
                offset: member.offset as usize,
                kind,
            })
        })
        .collect()
}

impl SettingSlot {
    /// Puts `values`, one for each component, into the uniform's bytes; `false`, and nothing is changed, if their
    /// number is not that of the components or the bytes end before.
    #[must_use]
    pub fn write(&self, bytes: &mut [u8], values: &[f64]) -> bool {
        let room = bytes.get_mut(self.offset..self.offset + 4 * self.components);
        let (Some(room), true) = (room, values.len() == self.components) else {
            return false;
        };
        for (word, &value) in room.as_chunks_mut::<4>().0.iter_mut().zip(values) {
            *word = match self.kind {
                ScalarKind::Sint => (value.round() as i32).to_le_bytes(),
                ScalarKind::Uint => (value.round() as u32).to_le_bytes(),
                _ => (value as f32).to_le_bytes(),
            };
        }
        true
    }

    /// The values in the uniform's bytes, one for each component; none if the bytes end before.
    #[must_use]
    pub fn read(&self, bytes: &[u8]) -> Option<Vec<f64>> {
        let room = bytes.get(self.offset..self.offset + 4 * self.components)?;
        let number = |&word: &[u8; 4]| match self.kind {
            ScalarKind::Sint => f64::from(i32::from_le_bytes(word)),
            ScalarKind::Uint => f64::from(u32::from_le_bytes(word)),
            // By way of its decimal, so that 0.1 stays 0.1.
            _ => {
                let value = f32::from_le_bytes(word);
                value.to_string().parse().unwrap_or(f64::from(value))
            }
        };
        Some(room.as_chunks::<4>().0.iter().map(number).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_found_and_written() {
        let module = naga::front::wgsl::parse_str(
            "struct Settings { gain: f32, steps: u32, range: vec2f, tint: vec3f, on: i32 }
             @group(0) @binding(2) var<uniform> settings: Settings;",
        )
        .unwrap();
        let slots = slots(&module);
        let summary: Vec<_> = slots
            .iter()
            .map(|slot| (slot.name.as_str(), slot.components, slot.offset))
            .collect();
        assert_eq!(
            summary,
            [
                ("gain", 1, 0),
                ("steps", 1, 4),
                ("range", 2, 8),
                ("tint", 3, 16),
                ("on", 1, 28),
            ]
        );
        let mut bytes = [0; 32];
        assert!(slots[1].write(&mut bytes, &[7.0]));
        assert!(slots[2].write(&mut bytes, &[-1.0, 1.0]));
        assert!(slots[4].write(&mut bytes, &[-3.0]));
        assert_eq!(bytes[4..8], 7u32.to_le_bytes());
        assert_eq!(bytes[8..12], (-1f32).to_le_bytes());
        assert_eq!(bytes[28..], (-3i32).to_le_bytes());
        assert!(slots[0].write(&mut bytes, &[0.1]));
        assert_eq!(slots[0].read(&bytes), Some(vec![0.1]));
        assert_eq!(slots[4].read(&bytes), Some(vec![-3.0]));
        assert_eq!(slots[4].read(&bytes[..30]), None);
        assert!(!slots[0].write(&mut bytes, &[1.0, 2.0]));
        assert!(!slots[4].write(&mut bytes[..30], &[1.0]));
    }

    #[test]
    fn a_module_without_settings_has_none() {
        assert!(slots(&Module::default()).is_empty());
    }
}
