//! Pointers: variables and parts of them.

use naga::{AddressSpace, Expression, Handle, TypeInner};

use super::body::{Body, Known};
use super::globals::GlobalPlace;
use super::{Parts, Translator};
use crate::executor::code::{Indexed, Inst, Op};
use crate::executor::fault::Fault;
use crate::executor::lanes::Slot;

/// What a pointer leads into.
#[derive(Clone, Copy, Debug)]
pub(super) enum Root {
    /// The first register of a local variable.
    Registers(Slot),
    /// The first uniform of a variable that nothing writes.
    Uniforms(Slot),
    Buffer(u32),
}

/// Where a pointer leads.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub root: Root,
    /// Components from the root on.
    pub offset: u32,
    /// Further components, which each lane may have others of.
    pub index: Option<Slot>,
    /// Components of what it leads to; 0 where the buffer knows.
    pub count: u32,
}

impl<'m> Translator<'m> {
    pub(super) fn pointer(
        &mut self,
        body: &mut Body<'m>,
        handle: Handle<Expression>,
    ) -> Result<Place, Fault> {
        if let Some(Known::Pointer(place)) = &body.known[handle.index()] {
            return Ok(*place);
        }
        match self.expression(body, handle)? {
            Known::Pointer(place) => Ok(place),
            Known::Value(_) => Err(Fault::unsupported("a store to a value")),
        }
    }

    /// A variable itself.
    pub(super) fn variable(
        &mut self,
        body: &Body<'m>,
        expression: &Expression,
    ) -> Result<Place, Fault> {
        let at_start = |root, count| Place {
            root,
            offset: 0,
            index: None,
            count,
        };
        match expression {
            Expression::LocalVariable(variable) => {
                let row = body.locals.get(variable.index());
                let row = row.ok_or_else(|| Fault::unsupported("a variable before its scope"))?;
                Ok(at_start(Root::Registers(row.first), row.count))
            }
            Expression::GlobalVariable(variable) => match self.globals.get(variable) {
                Some(&GlobalPlace::Uniforms(first, count)) => {
                    Ok(at_start(Root::Uniforms(first), count))
                }
                Some(&GlobalPlace::Buffer(k)) => Ok(at_start(Root::Buffer(k), 0)),
                None => Err(self.foreign(self.module.global_variables[*variable].space)),
            },
            _ => Err(Fault::unsupported("a pointer of this kind")),
        }
    }

    fn foreign(&self, space: AddressSpace) -> Fault {
        let words = match space {
            AddressSpace::Handle => "a texture or a sampler",
            AddressSpace::WorkGroup => "workgroup memory",
            AddressSpace::Private => "a private variable",
            _ => "a variable of this address space",
        };
        Fault::unsupported(words)
    }

    /// The type that a pointer leads to.
    fn pointee(&self, body: &Body<'m>, pointer: Handle<Expression>) -> Result<TypeInner, Fault> {
        match *self.inner(body, pointer) {
            TypeInner::Pointer { base, .. } => Ok(self.module.types[base].inner.clone()),
            TypeInner::ValuePointer {
                size: Some(size),
                scalar,
                ..
            } => Ok(TypeInner::Vector { size, scalar }),
            _ => Err(Fault::unsupported("a part of something without parts")),
        }
    }

    /// A part of what a pointer leads to.
    pub(super) fn pointer_part(
        &mut self,
        body: &mut Body<'m>,
        base: Handle<Expression>,
        index: u32,
    ) -> Result<Place, Fault> {
        let place = self.pointer(body, base)?;
        let inner = self.pointee(body, base)?;
        let (before, count) = self.shapes.part(&inner, index)?;
        // an element beyond the end of an array of known size is none
        if let (Some(elements), _) = self.shapes.elements(&inner).unwrap_or((None, 0))
            && index >= elements
        {
            return Err(Fault::unsupported("an index beyond the last element"));
        }
        Ok(Place {
            offset: place.offset.saturating_add(before),
            count,
            ..place
        })
    }

    /// An element of what a pointer leads to.
    pub(super) fn pointer_element(
        &mut self,
        body: &mut Body<'m>,
        base: Handle<Expression>,
        index: Handle<Expression>,
    ) -> Result<Place, Fault> {
        let place = self.pointer(body, base)?;
        let inner = self.pointee(body, base)?;
        let index = self.one(body, index)?;
        let (count, stride) = self.shapes.elements(&inner)?;
        let index = self.index(index, place.index, count, stride)?;
        Ok(Place {
            index: Some(index),
            count: stride,
            ..place
        })
    }

    /// Components to an element.
    fn index(
        &mut self,
        index: Slot,
        before: Option<Slot>,
        count: Option<u32>,
        stride: u32,
    ) -> Result<Slot, Fault> {
        let before = match before {
            Some(before) => before,
            None => self.constant(0),
        };
        self.indices.push(Indexed {
            count: count.map_or(u64::from(u32::MAX) + 1, u64::from),
            stride: stride.into(),
        });
        let place = self.indices.len() as u32 - 1;
        // not a uniform: what is read there is no uniform either
        let d = self.register()?;
        self.emit(Inst::new(Op::Index).to(d).of(index).and(before).at(place));
        Ok(d)
    }

    /// An element of a value.
    pub(super) fn value_element(
        &mut self,
        body: &mut Body<'m>,
        base: Handle<Expression>,
        index: Handle<Expression>,
    ) -> Result<Parts, Fault> {
        let parts = self.value(body, base)?;
        let index = self.one(body, index)?;
        let inner = self.inner(body, base).clone();
        let (count, stride) = self.shapes.elements(&inner)?;
        let first = self.frame.row(parts.len() as u32)?;
        for (k, &a) in (0..).zip(&parts) {
            let d = Slot::register(first.number() + k);
            self.temporaries.push(d);
            self.emit(Inst::new(Op::Copy).to(d).of(a));
        }
        let index = self.index(index, None, count, stride)?;
        self.load(&Place {
            root: Root::Registers(first),
            offset: 0,
            index: Some(index),
            count: stride,
        })
    }

    /// Reads what a pointer leads to.
    pub(super) fn load(&mut self, place: &Place) -> Result<Parts, Fault> {
        let mut parts = Vec::with_capacity(place.count as usize);
        for k in place.offset..place.offset + place.count {
            parts.push(match (place.root, place.index) {
                (Root::Uniforms(first), None) => Slot::uniform(first.number() + k),
                (Root::Registers(first), None) => {
                    let d = self.register()?;
                    let a = Slot::register(first.number() + k);
                    self.emit(Inst::new(Op::Copy).to(d).of(a));
                    d
                }
                (Root::Registers(first) | Root::Uniforms(first), Some(index)) => {
                    let d = self.register()?;
                    let inst = Inst::new(Op::LoadElement).to(d).of(index).and(first);
                    self.emit(inst.at(k));
                    d
                }
                (Root::Buffer(buffer), index) => {
                    let index = match index {
                        Some(index) => index,
                        None => self.constant(0),
                    };
                    let d = self.register()?;
                    let inst = Inst::new(Op::LoadBuffer).to(d).of(index).at(buffer);
                    self.emit(inst.and(Slot::uniform(k)));
                    d
                }
            });
        }
        Ok(parts)
    }

    /// Writes where a pointer leads.
    pub(super) fn store(&mut self, place: &Place, parts: &[Slot]) -> Result<(), Fault> {
        for (k, &value) in (place.offset..).zip(parts) {
            let inst = match (place.root, place.index) {
                (Root::Uniforms(_), _) => {
                    return Err(Fault::unsupported("a store to a uniform"));
                }
                (Root::Registers(first), None) => {
                    let d = Slot::register(first.number() + k);
                    Inst::new(Op::Store).to(d).of(value)
                }
                (Root::Registers(first), Some(index)) => Inst::new(Op::StoreElement)
                    .to(first)
                    .of(index)
                    .and(value)
                    .at(k),
                (Root::Buffer(buffer), index) => {
                    let index = match index {
                        Some(index) => index,
                        None => self.constant(0),
                    };
                    Inst::new(Op::StoreBuffer)
                        .of(index)
                        .and(value)
                        .with(Slot::uniform(k))
                        .at(buffer)
                }
            };
            self.emit(inst);
        }
        Ok(())
    }
}
