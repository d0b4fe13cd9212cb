//! Uniforms and storage.

use naga::{AddressSpace, ArraySize, StorageAccess, TypeInner};

use super::Translator;
use crate::executor::fault::Fault;
use crate::executor::lanes::Slot;
use crate::executor::program::{Buffer, Component};

/// Where a global variable is.
#[derive(Clone, Copy, Debug)]
pub(super) enum GlobalPlace {
    /// The first of its uniforms, and how many.
    Uniforms(Slot, u32),
    /// A buffer.
    Buffer(u32),
}

impl Translator<'_> {
    /// Gives every global variable that a program of ours may have its place.
    pub(super) fn declare_globals(&mut self) -> Result<(), Fault> {
        let module = self.module;
        for (handle, variable) in module.global_variables.iter() {
            let name = variable.name.clone().unwrap_or_default();
            let inner = &module.types[variable.ty].inner;
            let place = match variable.space {
                AddressSpace::Uniform => self.uniforms_of(&name, inner)?,
                AddressSpace::Storage { access } => match inner {
                    TypeInner::Array {
                        base,
                        size: ArraySize::Dynamic,
                        ..
                    } => self.buffer_of(name, &module.types[*base].inner)?,
                    _ if !access.contains(StorageAccess::STORE) => {
                        self.uniforms_of(&name, inner)?
                    }
                    _ => continue,
                },
                _ => continue,
            };
            self.globals.insert(handle, place);
        }
        Ok(())
    }

    fn uniforms_of(&mut self, name: &str, inner: &TypeInner) -> Result<GlobalPlace, Fault> {
        let count = self.shapes.inner_size(inner)?;
        let first = self.uniforms.len() as u32;
        self.uniforms.extend(std::iter::repeat_n(0, count as usize));
        let mut at = first;
        self.add_inputs(name.to_owned(), inner, &mut at)?;
        Ok(GlobalPlace::Uniforms(Slot::uniform(first), count))
    }

    fn add_inputs(&mut self, path: String, inner: &TypeInner, at: &mut u32) -> Result<(), Fault> {
        if let TypeInner::Struct { members, .. } = inner {
            let module = self.module;
            for member in members {
                let name = member.name.as_deref().unwrap_or_default();
                let inner = &module.types[member.ty].inner;
                self.add_inputs(format!("{path}.{name}"), inner, at)?;
            }
            return Ok(());
        }
        let mut forms = Vec::new();
        self.shapes.forms(inner, &mut forms)?;
        for (index, form) in forms.into_iter().enumerate() {
            let path = path.clone();
            self.inputs.push(Component {
                path,
                index,
                slot: Slot::uniform(*at),
                form,
            });
            *at += 1;
        }
        Ok(())
    }

    fn buffer_of(&mut self, name: String, element: &TypeInner) -> Result<GlobalPlace, Fault> {
        let mut forms = Vec::new();
        self.shapes.forms(element, &mut forms)?;
        let form = forms[0];
        if forms.iter().any(|&other| other != form) {
            return Err(Fault::unsupported("a buffer of different numbers"));
        }
        self.buffers.push(Buffer {
            name,
            stride: forms.len(),
            form,
        });
        Ok(GlobalPlace::Buffer(self.buffers.len() as u32 - 1))
    }
}
